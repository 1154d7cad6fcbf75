// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/gerbs_join.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "patchproof/patch/affine.h"
#include "patchproof/patch/gerbs_outline.h"
#include "support/rational_literal.h"

namespace patchproof {
namespace {

using test::operator""_q;
using Surface = GerbsSurface<Rational, 4>;
using Local = LocalSurface<Rational, 4>;
using Point = Vec<Rational, 4>;

Surface::Axis axis(std::vector<Rational> breaks, bool closed = false) {
  return {gerbs_knots(std::move(breaks), closed).value(), closed};
}

// (R + r cos πv)(cos πu, sin πu), r sin πv
Local torus(const Rational& big, const Rational& small) {
  const Rational o(0), one(1);
  std::vector<Point> net(9, Point{{o, o, o, o}});  // rows 1, cos u, sin u; columns 1, cos v, sin v
  net[0] = {{o, o, o, one}};
  net[2] = {{o, o, small, o}};
  net[3] = {{big, o, o, o}};
  net[4] = {{small, o, o, o}};
  net[6] = {{o, big, o, o}};
  net[7] = {{o, small, o, o}};
  return Local::make(TrigonometricFunctions{1}, TrigonometricFunctions{1}, std::move(net)).value();
}

Surface closed_torus(const BFunction& b) {
  std::vector<Local> locals;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 2; ++q) locals.push_back(torus(Rational(4), Rational(p == 1 ? 2 : 1)));
  return Surface::make(b, axis({"0"_q, "1/2"_q, "3/2"_q, "2"_q}, true), axis({"0"_q, "1"_q, "2"_q}, true), locals)
      .value();
}

// z = x y / 4 and its like over [0, 4] × [0, 4], moved by `map`.
Local saddle(const AffineMap<Rational>& map) {
  std::vector<Point> net;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      net.push_back(apply(map, Point{{Rational(4 * i), Rational(4 * j), Rational(4 * i * j), Rational(1)}}));
  return BsplinePatch<Rational, 4>(KnotVector<Rational>::bezier(1, "0"_q, "4"_q),
                                   KnotVector<Rational>::bezier(1, "0"_q, "4"_q), net);
}

// Over [0, 2] × [0, 2] or [2, 4] × [0, 2]; all local surfaces are the saddle but those of the middle column, and those moved.
Surface half(const BFunction& b, int first, const AffineMap<Rational>& map, const AffineMap<Rational>& last_row) {
  std::vector<Local> locals;
  const AffineMap<Rational> up = translation(Vec<Rational, 3>{{"0"_q, "0"_q, "1/3"_q}});
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 3; ++q) {
      Local local = saddle(map);
      if (p == (first == 0 ? 1 : 0)) local = saddle(compose(last_row, map));
      locals.push_back(q == 1 ? local.map_points([&](const Point& x) { return apply(up, x); }) : local);
    }
  const Rational begin(first);
  return Surface::make(b, axis({begin, Rational(begin + Rational(2))}), axis({"0"_q, "1"_q, "2"_q}), locals).value();
}

AffineMap<Rational> nothing() { return translation(Vec<Rational, 3>{}); }

struct Sides {
  Surface a, b;
  BsplinePatch<Rational, 4> of_a = outline(a), of_b = outline(b);
  BlendedSide left() const { return {&of_a, &a}; }
  BlendedSide right() const { return {&of_b, &b}; }
};

Join<Rational> straight(const Rational& end_a, const Rational& begin_b) {
  Join<Rational> join;
  join.line_a = {Direction::u, end_a, Side::left};
  join.line_b = {Direction::u, begin_b, Side::right};
  join.pairing = {PairingKind::identity, {"0"_q, "2"_q}, {"0"_q, "2"_q}};
  return join;
}

// The largest gap and the largest angle (degrees) between the normals' directions at many parameters.
std::array<double, 2> sampled(const Surface& a, const Rational& u_a, const Surface& b, const Rational& u_b) {
  std::array<double, 2> out{};
  for (int k = 0; k <= 400; ++k) {
    const Rational v = Rational(k) / Rational(200);
    const auto frame = [&](const Surface& s, const Rational& u, Side side) {
      return partial_derivatives_at<double>(s, {u, v}, {side, k == 400 ? Side::left : Side::right}, nearest_double(u),
                                            nearest_double(v), 1, 1);
    };
    const auto x = frame(a, u_a, Side::left), y = frame(b, u_b, Side::right);
    const Vec<double, 3> gap = x.at(0, 0) - y.at(0, 0), m = cross(x.at(1, 0), x.at(0, 1)),
                         n = cross(y.at(1, 0), y.at(0, 1)), c = cross(m, n);
    out[0] = std::max(out[0], std::sqrt(dot(gap, gap)));
    out[1] = std::max(out[1], std::atan2(std::sqrt(dot(c, c)), dot(m, n)) * 180 / std::numbers::pi);
  }
  return out;
}

void expect_bounds_hold(const Certificate& c, const std::array<double, 2>& sample) {
  EXPECT_LE(sample[0], c.gap.upper * (1 + 1e-12) + 1e-14);
  EXPECT_GE(sample[0] * (1 + 1e-3) + 1e-12, c.gap.lower);
  EXPECT_LE(sample[1], c.angle.upper * (1 + 1e-9) + 1e-7);
  EXPECT_GE(sample[1] * (1 + 1e-2) + 1e-9, c.angle.lower);
}

TEST(GerbsJoin, Law1_ASeamOfAClosedSurfaceIsAsSmoothAsItsBFunction) {
  for (const auto& [b, c2] :
       {std::pair(BFunction::trigonometric(), Verdict::undecided), std::pair(BFunction::logistic(), Verdict::proven),
        std::pair(BFunction::expo_rational().value(), Verdict::proven),
        std::pair(BFunction::polynomial(2).value(), Verdict::proven),
        std::pair(BFunction::polynomial(1).value(), Verdict::undecided)}) {
    SCOPED_TRACE(b.to_string());
    const Surface torus = closed_torus(b);
    const BsplinePatch<Rational, 4> near = outline(torus);
    const BlendedSide side{&near, &torus};
    for (const Direction d : {Direction::u, Direction::v}) {
      Join<Rational> join = straight("2"_q, "0"_q);
      join.line_a.constant = join.line_b.constant = d;
      const Certificate c = certify_blended_join(side, side, join);
      for (const ExactClass* of : {&c.c0, &c.c1, &c.g1}) EXPECT_EQ(of->verdict, Verdict::proven) << of->reason;
      EXPECT_EQ(c.c2.verdict, c2);
      EXPECT_EQ(c.gap.upper, 0);
      EXPECT_EQ(c.angle.upper, 0);
      EXPECT_EQ(c.orientation, Orientation::smooth);
    }
    // Run through backwards it is another join, of which nothing is proved, and points are far apart.
    Join<Rational> backwards = straight("2"_q, "0"_q);
    std::swap(backwards.pairing.b[0], backwards.pairing.b[1]);
    const Certificate c = certify_blended_join(side, side, backwards);
    EXPECT_EQ(c.c0.verdict, Verdict::refuted);
    EXPECT_GT(c.gap.lower, 1);
  }
}

TEST(GerbsJoin, Law1_EdgesMadeAlikeAreEqualWhateverTheBFunction) {
  for (const BFunction& b : {BFunction::trigonometric(), BFunction::logistic(), BFunction::expo_rational().value()}) {
    SCOPED_TRACE(b.to_string());
    const Sides s{half(b, 0, nothing(), nothing()), half(b, 2, nothing(), nothing())};
    const Certificate c = certify_blended_join(s.left(), s.right(), straight("2"_q, "2"_q));
    for (const ExactClass* of : {&c.c0, &c.c1, &c.g1}) EXPECT_EQ(of->verdict, Verdict::proven) << of->reason;
    EXPECT_EQ(c.c2.verdict, Verdict::undecided);
    EXPECT_EQ(c.gap.upper, 0);
    EXPECT_EQ(c.angle.upper, 0);
    EXPECT_EQ(c.ratio, "1");
  }
}

// A shear of the row at the edge that keeps the edge: C0 is proved, G1 refuted by the angle.
TEST(GerbsJoin, Law1And2_AKinkAlongAnEdgeThatIsEqual) {
  AffineMap<Rational> shear = nothing();  // z += (x − 2)/10: nothing happens where x = 2
  shear.linear[2][0] = "1/10"_q;
  shear.shift[2] = "-1/5"_q;
  for (const BFunction& b : {BFunction::trigonometric(), BFunction::logistic()}) {
    SCOPED_TRACE(b.to_string());
    const Sides s{half(b, 0, nothing(), nothing()), half(b, 2, nothing(), shear)};
    const Certificate c = certify_blended_join(s.left(), s.right(), straight("2"_q, "2"_q));
    EXPECT_EQ(c.c0.verdict, Verdict::proven) << c.c0.reason;
    EXPECT_EQ(c.c1.verdict, Verdict::refuted);
    EXPECT_EQ(c.g1.verdict, Verdict::refuted);
    EXPECT_EQ(c.gap.upper, 0);
    EXPECT_GT(c.angle.lower, 1);
    EXPECT_TRUE(c.angle.converged);
    expect_bounds_hold(c, sampled(s.a, "2"_q, s.b, "2"_q));
  }
}

TEST(GerbsJoin, Law2_AGapIsEnclosedAndRefutes) {
  for (const char* size : {"1/7", "1/1000000000"}) {
    const AffineMap<Rational> away =
        translation(Vec<Rational, 3>{{"0"_q, "0"_q, parse_scalar<Rational>(size).value()}});
    const BFunction b = BFunction::logistic();
    const Sides s{half(b, 0, nothing(), nothing()), half(b, 2, nothing(), away)};
    const Certificate c = certify_blended_join(s.left(), s.right(), straight("2"_q, "2"_q));
    EXPECT_EQ(c.c0.verdict, Verdict::refuted);
    EXPECT_TRUE(c.gap.converged);
    expect_bounds_hold(c, sampled(s.a, "2"_q, s.b, "2"_q));
  }
}

// Far from the origin and tiny: nothing may be proved that is false, and bounds still hold.
TEST(GerbsJoin, Law2_FarAwayAndTiny) {
  AffineMap<Rational> far = translation(Vec<Rational, 3>{{"1000000"_q, "-1000000"_q, "1000000"_q}}), tiny = nothing();
  for (int i = 0; i < 3; ++i) tiny.linear[i][i] = "1/1099511627776"_q;
  for (const AffineMap<Rational>& map : {far, tiny}) {
    const BFunction b = BFunction::expo_rational().value();
    AffineMap<Rational> shear = nothing();
    shear.linear[2][1] = "1/50"_q;
    const Sides s{half(b, 0, map, nothing()), half(b, 2, map, shear)};
    const Certificate c = certify_blended_join(s.left(), s.right(), straight("2"_q, "2"_q));
    EXPECT_EQ(c.c0.verdict, Verdict::refuted);
    EXPECT_LE(c.gap.lower, c.gap.upper);
    EXPECT_LT(c.gap.upper, 1e7);
  }
}

// A tube around the z axis, closed in v, of another radius in its second half; `special` stands for the second row.
Surface tube(const BFunction& b, const std::vector<Rational>& breaks, const Rational& second,
             const Local* special = nullptr) {
  const auto ring = [](const Rational& radius) {
    std::vector<Point> net(6, Point{});  // rows: linear in u; columns 1, cos v, sin v
    for (int i = 0; i < 2; ++i) {
      net[3 * i] = {{"0"_q, "0"_q, Rational(2 * i), "1"_q}};
      net[3 * i + 1] = {{radius, "0"_q, "0"_q, "0"_q}};
      net[3 * i + 2] = {{"0"_q, radius, "0"_q, "0"_q}};
    }
    return Local::make(KnotVector<Rational>::bezier(1, "0"_q, "2"_q), TrigonometricFunctions{1}, std::move(net))
        .value();
  };
  std::vector<Local> locals;
  for (std::size_t p = 0; p < breaks.size(); ++p)
    for (int q = 0; q < 2; ++q)
      locals.push_back(special && p == 1 ? *special : ring(2 * p < breaks.size() ? "2"_q : second));
  return Surface::make(b, axis(breaks), axis({"0"_q, "1"_q, "2"_q}, true), locals).value();
}

TEST(GerbsJoin, Law3_ATearInsideIsListedAndRefuted) {
  const std::vector<Rational> torn{"0"_q, "1"_q, "1"_q, "2"_q};
  for (const BFunction& b : {BFunction::trigonometric(), BFunction::logistic()}) {
    const auto lines = certify_inner_lines(tube(b, torn, "3"_q));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].join.line_a.value, "1"_q);
    EXPECT_EQ(lines[0].certificate.c0.verdict, Verdict::refuted);
    EXPECT_GT(lines[0].certificate.gap.lower, 0.999);
    // Where both sides happen to agree nothing is claimed.
    const auto whole = certify_inner_lines(tube(b, torn, "2"_q));
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].certificate.c0.verdict, Verdict::undecided);
    EXPECT_TRUE(certify_inner_lines(tube(b, {"0"_q, "1"_q, "2"_q}, "3"_q)).empty());
  }
  // A B-function of order 0 leaves a kink at each centre.
  const auto kinks = certify_inner_lines(tube(BFunction::polynomial(0).value(), {"0"_q, "1"_q, "2"_q}, "3"_q));
  ASSERT_GE(kinks.size(), 1u);
  EXPECT_EQ(kinks[0].join.line_a.value, "1"_q);
  EXPECT_EQ(kinks[0].certificate.g1.verdict, Verdict::refuted);
  EXPECT_EQ(kinks[0].certificate.c0.verdict, Verdict::undecided);
}

TEST(GerbsJoin, Law3_ACreaseOfALocalSurfaceIsListed) {
  std::vector<Point> net(9, Point{});  // of radius 2, 3, 2 at u = 0, 1/2, 2
  for (int i = 0; i < 3; ++i) {
    const Rational radius(i == 1 ? 3 : 2), height = i == 0 ? "0"_q : i == 1 ? "1/2"_q : "2"_q;
    net[3 * i] = {{"0"_q, "0"_q, height, "1"_q}};
    net[3 * i + 1] = {{radius, "0"_q, "0"_q, "0"_q}};
    net[3 * i + 2] = {{"0"_q, radius, "0"_q, "0"_q}};
  }
  const Local creased = Local::make(KnotVector<Rational>::make(1, {"0"_q, "0"_q, "1/2"_q, "2"_q, "2"_q}).value(),
                                    TrigonometricFunctions{1}, std::move(net))
                            .value();
  const auto lines = certify_inner_lines(tube(BFunction::logistic(), {"0"_q, "1"_q, "2"_q}, "2"_q, &creased));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].join.line_a.value, "1/2"_q);
  EXPECT_EQ(lines[0].certificate.g1.verdict, Verdict::refuted);
  EXPECT_GT(lines[0].certificate.angle.lower, 1);
}

}  // namespace
}  // namespace patchproof
