// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/curve_join.h"

#include <gtest/gtest.h>

#include <cmath>

#include "patchproof/scalar/quadratic.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/smoothness.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Curve = BsplineCurve<Rational, 4>;
using Triple = std::array<int, 3>;

Rational q(int n, int d = 1) { return Rational(n) / Rational(d); }

Curve bezier(const std::vector<Triple>& points, const Rational& scale = q(1), const Rational& offset = q(0),
             const Rational& begin = q(0), const Rational& end = q(1)) {
  std::vector<Vec<Rational, 4>> net;
  for (const Triple& p : points)
    net.push_back({{scale * q(p[0]) + offset, scale * q(p[1]) + offset, scale * q(p[2]) + offset, q(1)}});
  return Curve(KnotVector<Rational>::bezier(static_cast<int>(points.size()) - 1, begin, end), net);
}

// The same curve run backwards over the same domain.
template <ExactField T>
BsplineCurve<T, 4> reversed(const BsplineCurve<T, 4>& c) {
  std::vector<T> knots;
  for (auto k = c.knots().knots().rbegin(); k != c.knots().knots().rend(); ++k)
    knots.push_back(c.knots().domain_begin() + c.knots().domain_end() - *k);
  auto points = c.points();
  std::reverse(points.begin(), points.end());
  return BsplineCurve<T, 4>(KnotVector<T>::make(c.degree(), knots).value(), points);
}

template <ExactField T>
CurveCertificate join(const BsplineCurve<T, 4>& a, const BsplineCurve<T, 4>& b, CurveEnd a_end = CurveEnd::end,
                      CurveEnd b_end = CurveEnd::begin) {
  return certify_curve_join<T>({&a, a_end}, {&b, b_end});
}

std::string verdicts(const CurveCertificate& c) {
  std::string out;
  for (const CurveClass* k : {&c.c0, &c.c1, &c.c2, &c.g1, &c.g2})
    out += k->verdict == Verdict::proven ? '+' : k->verdict == Verdict::refuted ? '-' : '?';
  return out;  // C0 C1 C2 G1 G2
}

void expect_around(const std::optional<Enclosure>& e, double value, double relative = 1e-14) {
  ASSERT_TRUE(e);
  EXPECT_LE(e->lower, value * (1 + relative));
  EXPECT_GE(e->upper, value * (1 - relative));
  EXPECT_LE(e->upper - e->lower, std::ldexp(e->upper, -40));
}

const Curve kLine = bezier({{0, 0, 0}, {1, 0, 0}});

TEST(CurveJoin, Law1_TheSameLineAtAnotherSpeed) {
  const Curve faster = bezier({{1, 0, 0}, {4, 0, 0}});
  const CurveCertificate c = join(kLine, faster);
  EXPECT_EQ(verdicts(c), "+--++");
  EXPECT_EQ(class_name(c), "G2");
  EXPECT_EQ(c.order, 0);
  EXPECT_EQ(c.scaled_order, kOneFunction);
  EXPECT_EQ(c.ratio, "3");
  EXPECT_EQ(c.c1.quantity, "x' - y'");
  EXPECT_EQ(c.c1.values, (std::vector<std::string>{"-2", "0", "0"}));
  expect_around(c.speed_ratio, 3);
  expect_around(c.first_difference, 2);
  EXPECT_EQ(c.angle->upper, 0);
  EXPECT_EQ(c.curvature_difference->upper, 0);
  // Over a domain three times as long it is one function.
  const CurveCertificate same = join(kLine, bezier({{1, 0, 0}, {4, 0, 0}}, q(1), q(0), q(5), q(8)));
  EXPECT_EQ(class_name(same), "C∞");
  EXPECT_EQ(verdicts(same), "+++++");
}

TEST(CurveJoin, Law1_KinksCuspsAndGaps) {
  const CurveCertificate kink = join(kLine, bezier({{1, 0, 0}, {2, 1, 0}}));
  EXPECT_EQ(verdicts(kink), "+----");
  EXPECT_EQ(class_name(kink), "C0");
  expect_around(kink.angle, 45);
  EXPECT_EQ(kink.g1.values, (std::vector<std::string>{"0", "0", "-1"}));
  EXPECT_EQ(join(kLine, bezier({{1, 0, 0}, {1, 0, 7}})).angle->lower, 90);
  expect_around(join(kLine, bezier({{1, 0, 0}, {0, 1, 0}})).angle, 135);
  expect_around(join(kLine, bezier({{1, 0, 0}, {1000001, 1, 0}})).angle, std::atan(1e-6) * 180 / M_PI);
  expect_around(join(kLine, bezier({{1, 0, 0}, {-3, 3, 0}})).angle, 180 - std::atan(0.75) * 180 / M_PI);

  const CurveCertificate cusp = join(kLine, bezier({{1, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(class_name(cusp), "C0, cusp");
  EXPECT_EQ(cusp.angle->lower, 180);
  EXPECT_EQ(cusp.angle->upper, 180);
  EXPECT_EQ(cusp.g1.values, (std::vector<std::string>{"1"}));
  EXPECT_FALSE(cusp.ratio);

  const CurveCertificate gap = join(kLine, bezier({{1, 3, 4}, {2, 3, 4}}));
  EXPECT_EQ(verdicts(gap), "-----");
  EXPECT_EQ(class_name(gap), "gap");
  EXPECT_EQ(gap.gap_squared, "25");
  EXPECT_EQ(gap.c0.values, (std::vector<std::string>{"0", "-3", "-4"}));
  expect_around(gap.gap, 5);
  EXPECT_EQ(gap.angle->upper, 0);  // the bounds speak on
  EXPECT_EQ(gap.order, -1);
}

TEST(CurveJoin, Law1_OneCurveCutInTwo) {
  RandomRationals random;
  for (const int degree : {1, 2, 3, 5}) {
    std::vector<Vec<Rational, 4>> net;
    for (const auto& p : random.points<3>(degree + 1)) net.push_back({{p[0], p[1], p[2], q(1)}});
    for (const bool rational : {false, true}) {
      if (rational)
        for (std::size_t i = 0; i < net.size(); ++i) net[i][3] = q(static_cast<int>(i) + 1);
      const auto [left, right] = split(Curve::bezier(net), q(1, 3));
      EXPECT_EQ(class_name(join(left, right)), "C∞") << degree;
      EXPECT_EQ(join(left, right).gap_squared, "0");
      // The control point next to the cut moved by 2^-52.
      auto points = right.points();
      points[1][1] += q(1) / Rational(std::int64_t{1} << 52);
      const CurveCertificate moved = join(left, Curve(right.knots(), points));
      EXPECT_EQ(verdicts(moved).substr(0, 3), "+--");
      EXPECT_GT(moved.first_difference.lower, 0);
    }
  }
  // At a simple knot of a cubic: C2, not C3.
  std::vector<Vec<Rational, 4>> net;
  for (const auto& p : random.points<3>(5)) net.push_back({{p[0], p[1], p[2], q(1)}});
  const std::vector<Rational> knots{q(0), q(0), q(0), q(0), q(1), q(3), q(3), q(3), q(3)};
  const auto [left, right] = split(Curve(KnotVector<Rational>::make(3, knots).value(), net), q(1));
  EXPECT_EQ(class_name(join(left, right)), "C2");
  EXPECT_EQ(class_name(join(left, right, CurveEnd::begin, CurveEnd::end)), "gap");
}

TEST(CurveJoin, Law1_SecondDerivativesAndCurvatures) {
  // y = x² from the right of the origin; on the left the line, −x², x², x²/9 run three times as fast, x³.
  const Curve right = bezier({{0, 0, 0}, {1, 0, 0}, {2, 4, 0}});
  const CurveCertificate flat = join(bezier({{-2, 0, 0}, {0, 0, 0}}), right);
  EXPECT_EQ(verdicts(flat), "++-+-");
  EXPECT_EQ(class_name(flat), "C1");
  expect_around(flat.curvature[1], 2);
  expect_around(flat.curvature_difference, 2);
  expect_around(flat.second_difference, 8);
  EXPECT_FALSE(flat.second_angle);
  EXPECT_EQ(flat.g2.values, (std::vector<std::string>{"0", "-2", "0"}));
  const CurveCertificate turned = join(bezier({{-2, -4, 0}, {-1, 0, 0}, {0, 0, 0}}), right);
  EXPECT_EQ(class_name(turned), "C1");
  expect_around(turned.curvature_difference, 4);
  EXPECT_EQ(turned.second_angle->lower, 180);
  EXPECT_EQ(class_name(join(bezier({{-2, 4, 0}, {-1, 0, 0}, {0, 0, 0}}), right)), "C∞");
  const CurveCertificate fast = join(bezier({{-6, 36, 0}, {-3, 0, 0}, {0, 0, 0}}), right);
  EXPECT_EQ(class_name(fast), "G2");
  EXPECT_EQ(fast.ratio, "1/3");
  EXPECT_EQ(fast.scaled_order, kOneFunction);
  // The same point, tangent, speed and curvature, another tangential acceleration: G2 and C1, not C2.
  const CurveCertificate pushed = join(bezier({{-5, 4, 0}, {-1, 0, 0}, {0, 0, 0}}), right);
  EXPECT_EQ(verdicts(pushed), "++-++");
  EXPECT_EQ(class_name(pushed), "G2, C1");
}

TEST(CurveJoin, Law1_ZeroEndSpeed) {
  // (t², t³) through its cusp and back on the other branch: both leave along x.
  const Curve up = bezier({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, 3, 0}}),
              down = bezier({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, -3, 0}});
  const CurveCertificate cusp = join(up, down, CurveEnd::begin, CurveEnd::begin);
  EXPECT_EQ(cusp.first, (std::array<int, 2>{2, 2}));
  EXPECT_EQ(class_name(cusp), "C∞, cusp");  // (t², −t³) for negative t is (t², t³): one polynomial, and it turns back
  EXPECT_EQ(cusp.angle->lower, 180);
  EXPECT_FALSE(cusp.speed_ratio);
  EXPECT_FALSE(cusp.curvature[0]);  // infinite: 3t³ grows like a power below 4
  // A straight line that starts at rest goes on smoothly from a line that does not.
  const CurveCertificate rest = join(bezier({{-1, 0, 0}, {0, 0, 0}}), bezier({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(verdicts(rest), "+--++");
  EXPECT_EQ(class_name(rest), "G2");
  EXPECT_FALSE(rest.ratio);
  // (t², t⁴) is the parabola y = x²: its curvature is 2.
  const Curve square = bezier({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {6, 6, 0}});
  const CurveCertificate slow = join(bezier({{-12, 24, 0}, {-6, 0, 0}, {0, 0, 0}}), square);
  EXPECT_EQ(slow.first, (std::array<int, 2>{1, 2}));
  expect_around(slow.curvature[0], 1.0 / 3);
  expect_around(slow.curvature[1], 1.0 / 3);
  EXPECT_EQ(class_name(slow), "G2");
  // A curve that is a point has no tangent.
  const CurveCertificate point = join(kLine, bezier({{1, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(verdicts(point), "+--??");
  EXPECT_FALSE(point.angle);
  EXPECT_EQ(class_name(point), "C0, no tangent");
}

TEST(CurveJoin, Law1_QuarterCirclesInQuadraticNumbers) {
  using Quad = BsplineCurve<Quadratic, 4>;
  const Quadratic one(1), zero(0), h(q(0), q(1, 2), 2);
  const Quad first = Quad::bezier({{{one, zero, zero, one}}, {{h, h, zero, h}}, {{zero, one, zero, one}}});
  const Quad second = Quad::bezier({{{zero, one, zero, one}}, {{-h, h, zero, h}}, {{-one, zero, zero, one}}});
  const CurveCertificate c = join(first, second);
  EXPECT_EQ(class_name(c), "G2, C1");
  EXPECT_EQ(c.ratio, "1");
  expect_around(c.curvature[0], 1);
  EXPECT_EQ(c.curvature_difference->upper, 0);
  EXPECT_EQ(c.gap_squared, "0");
  const auto [left, right] = split(first, Quadratic(q(1, 2)));
  EXPECT_EQ(class_name(join(left, right)), "C∞");
  // A circle of half the radius from the inside: the tangent goes on, the curvature is twice as large.
  const Quadratic two = one + one;
  const Quad small =
      Quad::bezier({{{zero, one, zero, one}}, {{-h / two, h, zero, h}}, {{-one / two, one / two, zero, one}}});
  const CurveCertificate jump = join(first, small);
  EXPECT_EQ(class_name(jump), "G1");
  EXPECT_EQ(jump.ratio, "1/2");
  expect_around(jump.curvature_difference, 1);
}

TEST(CurveJoin, Law1_ClosedCurvesJoinThemselves) {
  const Curve drop = bezier({{0, 0, 0}, {3, 3, 0}, {-3, 3, 0}, {0, 0, 0}});
  const CurveCertificate c = join(drop, drop);
  EXPECT_EQ(class_name(c), "C0");
  EXPECT_EQ(c.angle->lower, 90);
  EXPECT_EQ(c.gap_squared, "0");
  EXPECT_THROW(join(drop, drop, CurveEnd::end, CurveEnd::end), contract_error);
}

TEST(CurveJoin, Law3_ExchangeAndReversalChangeNothing) {
  RandomRationals random;
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Vec<Rational, 4>> nets[2];
    for (auto& net : nets)
      for (const auto& p : random.points<3>(4)) net.push_back({{p[0], p[1], p[2], q(1)}});
    nets[1][0] = nets[0][3];
    if (trial % 3 > 0) nets[1][1] = nets[0][3] + q(trial % 3) * (nets[0][3] - nets[0][2]);
    const Curve a = Curve::bezier(nets[0]), b = Curve::bezier(nets[1]);
    const CurveCertificate c = join(a, b);
    const Curve ra = reversed(a), rb = reversed(b);
    for (const CurveCertificate& other :
         {join(b, a, CurveEnd::begin, CurveEnd::end), join(ra, b, CurveEnd::begin, CurveEnd::begin),
          join(a, rb, CurveEnd::end, CurveEnd::end), join(ra, rb, CurveEnd::begin, CurveEnd::end)}) {
      EXPECT_EQ(verdicts(c), verdicts(other));
      EXPECT_EQ(c.order, other.order);
      EXPECT_EQ(c.angle->lower, other.angle->lower);
      EXPECT_EQ(c.angle->upper, other.angle->upper);
      EXPECT_EQ(c.first_difference.upper, other.first_difference.upper);
      EXPECT_EQ(c.second_difference.upper, other.second_difference.upper);
      EXPECT_EQ(c.curvature_difference->lower, other.curvature_difference->lower);
    }
    EXPECT_EQ(class_name(c), trial % 3 == 0 ? "C0" : trial % 3 == 1 ? "C1" : "G1");
    const CurveCertificate back = join(b, a, CurveEnd::begin, CurveEnd::end);
    EXPECT_LE(c.speed_ratio->lower * back.speed_ratio->lower, 1);
    EXPECT_GE(c.speed_ratio->upper * back.speed_ratio->upper, 1);
  }
}

TEST(CurveJoin, Law2_Law4_OffsetsAndScales) {
  const std::vector<Triple> parabola{{-5, 4, 0}, {-1, 0, 0}, {0, 0, 0}}, arc{{0, 0, 0}, {1, 1, 0}, {2, 7, 3}};
  const CurveCertificate c = join(bezier(parabola), bezier(arc));
  EXPECT_EQ(verdicts(c), "+----");
  const Rational tiny = q(1) / Rational(std::int64_t{1} << 60);
  for (const Rational& scale : {q(1), tiny, Rational(tiny * tiny * tiny), Rational(1) / tiny})
    for (const Rational& offset : {q(0), q(1000000), Rational(q(1) / tiny)}) {
      const CurveCertificate other = join(bezier(parabola, scale, offset), bezier(arc, scale, offset));
      const double s = nearest_double(scale);
      EXPECT_EQ(verdicts(other), verdicts(c));
      EXPECT_EQ(other.angle->lower, c.angle->lower);
      EXPECT_EQ(other.angle->upper, c.angle->upper);
      expect_around(other.angle, 45);
      expect_around(other.first_difference, s * c.first_difference.upper);
      expect_around(other.second_difference, s * c.second_difference.upper);
      expect_around(other.curvature_difference, c.curvature_difference->upper / s);
    }
  // A gap far below the last digit of the coordinates.
  const Curve shifted = bezier({{1, 0, 0}, {2, 0, 0}}, q(1), tiny);
  expect_around(join(kLine, shifted).gap, std::sqrt(3) * 0x1p-60);
}

TEST(CurveJoin, Law5_ClassesWithinTolerances) {
  const Rational tiny = q(1) / Rational(std::int64_t{1} << 40);
  const CurveCertificate near = join(kLine, bezier({{1, 0, 0}, {2, 0, 0}}, q(1), tiny));
  EXPECT_EQ(class_name(near), "gap");
  EXPECT_EQ(class_within(near, {}), "");
  EXPECT_EQ(class_within(near, {0.0, 0.0, 0.0}), "apart");
  EXPECT_EQ(class_within(near, {1e-6, {}, {}}), "G0");
  EXPECT_EQ(class_within(near, {1e-6, 0.0, {}}), "G1");
  EXPECT_EQ(class_within(near, {1e-6, 1e-3, 0.0}), "G2");
  const CurveCertificate kink = join(kLine, bezier({{1, 0, 0}, {1001, 1, 0}}));
  EXPECT_EQ(class_within(kink, {0.0, 0.05, {}}), "G0");
  EXPECT_EQ(class_within(kink, {0.0, 0.06, {}}), "G1");
  EXPECT_EQ(class_within(kink, {0.0, (kink.angle->lower + kink.angle->upper) / 2, {}}), "G0?");
  const CurveCertificate point = join(kLine, bezier({{1, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(class_within(point, {0.0, 180.0, {}}), "G0?");

  Request request;
  EXPECT_EQ(judge(near, request).outcome, Outcome::pass);
  request.gap_tolerance = 1e-6;
  request.angle_tolerance = 0.0;
  EXPECT_EQ(judge(near, request, 0.0).outcome, Outcome::pass);
  EXPECT_EQ(judge(kink, request).outcome, Outcome::fail);
  EXPECT_NE(judge(kink, request).reason.find("tangent angle"), std::string::npos);
  EXPECT_EQ(judge(point, request).outcome, Outcome::undecided);
  request = {};
  request.require = Continuity::g1;
  EXPECT_EQ(judge(near, request).outcome, Outcome::fail);
  EXPECT_EQ(judge(point, request).outcome, Outcome::undecided);
  request.require = Continuity::c0;
  EXPECT_EQ(judge(kink, request).outcome, Outcome::pass);
}

std::string listed(const CurveEndMatch& match) {
  std::string out;
  const auto name = [](const EndOfCurve& e) { return std::to_string(e.curve) + (e.end == CurveEnd::end ? "e" : "b"); };
  for (const auto& [a, b] : match.pairs) out += name(a) + name(b) + " ";
  out += "|";
  for (const EndOfCurve& e : match.free) out += " " + name(e);
  return out;
}

TEST(CurveJoin, Law6_EndsThatMeet) {
  const Curve next = bezier({{1, 0, 0}, {2, 0, 0}}), against = bezier({{3, 0, 0}, {2, 0, 0}});
  const Curve loop = bezier({{9, 0, 0}, {12, 3, 0}, {6, 3, 0}, {9, 0, 0}});
  const CurveEndMatch match = match_curve_ends<Rational>({&kLine, &next, &against, &loop});
  EXPECT_EQ(listed(match), "0e1b 1e2e 3e3b | 0b 2b");
  EXPECT_EQ(listed(match_curve_ends<Rational>({&next, &kLine})), "1e0b | 0e 1b");
  EXPECT_FALSE(match.crowded);
  // Exactly at the length, and one unit in the last place below it.
  const Curve apart = bezier({{1, 3, 4}, {2, 3, 4}});
  EXPECT_EQ(listed(match_curve_ends<Rational>({&kLine, &apart}, 5)), "0e1b | 0b 1e");
  EXPECT_EQ(listed(match_curve_ends<Rational>({&kLine, &apart}, std::nextafter(5, 0))), "| 0b 0e 1b 1e");
  EXPECT_EQ(listed(match_curve_ends<Rational>({&kLine, &apart}, 0, {{0, 2}, {3, 0}})), "0e1b | 0b 1e");
  EXPECT_EQ(listed(match_curve_ends<Rational>({&kLine, &apart}, 0, {{0, 2}, {2.99, 0}})), "| 0b 0e 1b 1e");
  // Beside a far larger curve a small one does not close itself by the default length.
  const Curve huge = bezier({{100000000, 0, 0}, {900000000, 0, 0}});
  EXPECT_EQ(listed(match_curve_ends<Rational>({&kLine, &huge})), "| 0b 0e 1b 1e");
  EXPECT_EQ(listed(match_curve_ends<Rational>({})), "|");
}

TEST(CurveJoin, Law6_CrowdsAreCutShortAndSaid) {
  const std::vector<const Curve*> crowd(3000, &kLine);
  const CurveEndMatch match = match_curve_ends<Rational>(crowd);
  EXPECT_TRUE(match.crowded);
  EXPECT_LE(match.pairs.size(), crowd.size() * kMostPartners);
  EXPECT_GE(match.pairs.size(), crowd.size());
}

}  // namespace
}  // namespace patchproof::test
