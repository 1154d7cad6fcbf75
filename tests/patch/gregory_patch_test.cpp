// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gregory_patch.h"

#include <gtest/gtest.h>

#include "support/gregory_patches.h"

namespace patchproof::test {
namespace {

using Patch = GregoryPatch<Rational>;
using Point3 = Vec<Rational, 3>;
using Point4 = Vec<Rational, 4>;

// S and its derivatives from the formulas of the header, by the definition of the B-spline basis, the derivatives of β written
// out, and the rules for quotients: no evaluation code of the library.
class Truth {
 public:
  explicit Truth(const Patch& patch) : patch_(patch) {
    from_u_ = ends(patch.u_surface(), Direction::v);
    const auto rows = ends(patch.v_surface(), Direction::u);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) from_v_[i][j] = rows[j][i];
  }
  const Patch::Net& from_u() const { return from_u_; }
  const Patch::Net& from_v() const { return from_v_; }

  // ∂^(k+l) S, k + l ≤ 2. Not at a corner, unless k = l = 0.
  Point3 operator()(const Rational& u, const Rational& v, int k, int l, Side su = Side::right,
                    Side sv = Side::right) const {
    const auto spline = [&](const BsplinePatch<Rational, 4>& s) {
      return quotient([&](int a, int b) { return derivative_by_definition(s, u, v, a, b, su, sv); }, k, l);
    };
    return spline(patch_.u_surface()) + spline(patch_.v_surface()) -
           quotient([&](int a, int b) { return c_surface(u, v, a, b); }, k, l);
  }

  // ∂^(k+l) of the homogeneous C surface, by Leibniz' rule.
  Point4 c_surface(const Rational& u, const Rational& v, int k, int l) const {
    Point4 sum;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int a = 0; a <= k; ++a)
          for (int b = 0; b <= l; ++b) {
            const Rational ways(a == 1 && k == 2 ? 2 : 1), ways_v(b == 1 && l == 2 ? 2 : 1);
            const Rational rest = ways * ways_v * cubic(i, k - a)(u) * cubic(j, l - b)(v);
            const Rational beta = share(i / 2, j / 2, u, v, a, b);
            const Rational other = a == 0 && b == 0 ? Rational(1 - beta) : Rational(-beta);
            sum += Rational(rest * beta) * from_u_[i][j] + Rational(rest * other) * from_v_[i][j];
          }
    return sum;
  }

 private:
  static Polynomial cubic(int i, int order) {
    std::vector<Rational> unit(4, Rational(0));
    unit[i] = 1;
    return from_bernstein(unit).derivative(order);
  }
  // Derivatives of β = b/(b + B).
  static Rational share(int p, int q, const Rational& u, const Rational& v, int k, int l) {
    const Rational x = p == 0 ? u : Rational(u - 1), y = q == 0 ? v : Rational(v - 1);
    const Rational b = x * x, b1 = 2 * x, c = y * y, c1 = 2 * y, s = b + c;
    if (k == 0 && l == 0) return b / s;
    if (k == 1 && l == 0) return b1 * c / (s * s);
    if (k == 0 && l == 1) return -b * c1 / (s * s);
    if (k == 2) return c * (2 * s - 2 * b1 * b1) / (s * s * s);
    if (l == 2) return -b * (2 * s - 2 * c1 * c1) / (s * s * s);
    return b1 * c1 * (b - c) / (s * s * s);
  }
  static Patch::Net ends(const BsplinePatch<Rational, 4>& s, Direction along) {
    const KnotVector<Rational>& t = s.knots(along);
    const int k = t.degree(), n = s.count(along) - 1;
    const auto at = [&](int row, int m) { return along == Direction::v ? s.point(row, m) : s.point(m, row); };
    const Rational first = Rational(k) / (3 * t[k + 1]), last = Rational(k) / (3 * (1 - t[n]));
    Patch::Net out;
    for (int row = 0; row < 4; ++row) {
      out[row][0] = at(row, 0);
      out[row][1] = at(row, 0) + first * (at(row, 1) - at(row, 0));
      out[row][2] = at(row, n) + last * (at(row, n - 1) - at(row, n));
      out[row][3] = at(row, n);
    }
    for (const int end : {0, 3}) {
      const int next = end == 0 ? 1 : 2;
      bool positive = true;
      Rational lambda(0);
      for (int row = 0; row < 4; ++row) {
        positive = positive && out[row][next][3] > 0;
        const Rational missing = Rational(1, 4) - out[row][next][3] / out[row][end][3];
        lambda = std::max(lambda, missing);
      }
      if (!positive)
        for (int row = 0; row < 4; ++row) out[row][next] += lambda * out[row][end];
    }
    return out;
  }
  template <class F>
  static Point3 quotient(F at, int k, int l) {
    const auto affine = [](const Point4& h) { return Point3{{h[0], h[1], h[2]}}; };
    const Point4 h = at(0, 0);
    const auto over = [&](const Point3& p) { return Rational(1 / h[3]) * p; };
    const Point3 s = over(affine(h));
    if (k == 0 && l == 0) return s;
    const Point4 hu = at(1, 0), hv = at(0, 1);
    const Point3 su = over(affine(hu) - hu[3] * s), sv = over(affine(hv) - hv[3] * s);
    if (k + l == 1) return k == 1 ? su : sv;
    const Point4 second = at(k, l);
    if (k == 1) return over(affine(second) - hu[3] * sv - hv[3] * su - second[3] * s);
    const Rational w = k == 2 ? hu[3] : hv[3];
    return over(affine(second) - Rational(2 * w) * (k == 2 ? su : sv) - second[3] * s);
  }

  const Patch& patch_;
  Patch::Net from_u_, from_v_;
};

// Knots, edges, the middle and places next to corners.
std::vector<Rational> parameters(const Patch& patch) {
  std::vector<Rational> out{0, 1, "1/3"_q, "1/1000000"_q, "999/1000"_q};
  for (const auto& t : {patch.u_surface().knots(Direction::v).breaks(), patch.v_surface().knots(Direction::u).breaks()})
    for (const Rational& x : t)
      if (0 < x && x < 1) out.push_back(x);
  return out;
}
bool is_corner(const Rational& u, const Rational& v) { return (u == 0 || u == 1) && (v == 0 || v == 1); }

TEST(GregoryPatch, Law1_TheCSurfaceAndItsWeights) {
  RandomRationals random;
  int raised = 0;
  for (int round = 0; round < 20; ++round) {
    const Patch patch = random_gregory_patch(random, {.rational = round > 2});
    const Truth truth(patch);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        EXPECT_EQ(patch.from_u()[i][j], truth.from_u()[i][j]) << i << j;
        EXPECT_EQ(patch.from_v()[i][j], truth.from_v()[i][j]) << i << j;
        EXPECT_GT(patch.from_u()[i][j][3], 0);
        EXPECT_GT(patch.from_v()[i][j][3], 0);
      }
    for (int i = 0; i < 4; ++i) raised += patch.from_u()[i][1][3] == patch.from_u()[i][0][3] / 4;
  }
  EXPECT_GT(raised, 0) << "λ was never needed";
}

TEST(GregoryPatch, Law2To4_ValuesAndDerivativesByTheDefinition) {
  RandomRationals random;
  for (const bool rational : {false, true}) {
    const Patch patch = random_gregory_patch(random, {.rational = rational});
    const Truth truth(patch);
    const std::vector<Rational> at = parameters(patch);
    for (std::size_t a = 0; a < at.size(); ++a)
      for (std::size_t b = a % 4; b < at.size(); b += 4)
        for (const bool swap : {false, true}) {
          const Rational &u = at[swap ? b : a], &v = at[swap ? a : b];
          if (is_corner(u, v)) {
            EXPECT_EQ(evaluate(patch, u, v), project(derivative_by_definition(patch.u_surface(), u, v, 0, 0)));
            EXPECT_THROW((void)second_derivatives(patch, u, v), contract_error);
            continue;
          }
          const Side su = a % 2 == 0 ? Side::left : Side::right, sv = b % 2 == 0 ? Side::left : Side::right;
          const SurfaceFrame<Rational> s = frame(patch, u, v, su, sv);
          EXPECT_EQ(s.point, truth(u, v, 0, 0, su, sv));
          EXPECT_EQ(s.point, evaluate(patch, u, v, su, sv));
          EXPECT_EQ(s.du, truth(u, v, 1, 0, su, sv));
          EXPECT_EQ(s.dv, truth(u, v, 0, 1, su, sv));
          EXPECT_EQ(s.normal(), cross(s.du, s.dv));
          const SecondDerivatives<Rational> t = second_derivatives(patch, u, v, su, sv);
          EXPECT_EQ(t.duu, truth(u, v, 2, 0, su, sv));
          EXPECT_EQ(t.duv, truth(u, v, 1, 1, su, sv));
          EXPECT_EQ(t.dvv, truth(u, v, 0, 2, su, sv));
        }
  }
}

// Along rays into a corner S − corner − r (p S_u + q S_v) is O(r²): halving r about quarters it.
TEST(GregoryPatch, Law3_FramesAtCornersAreLimits) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  ASSERT_TRUE(corners_agree(patch));
  for (const int u : {0, 1})
    for (const int v : {0, 1}) {
      const SurfaceFrame<Rational> corner = frame(patch, Rational(u), Rational(v));
      for (const auto& [p, q] : std::vector<std::pair<int, int>>{{1, 0}, {0, 1}, {1, 1}, {1, 7}, {9, 2}}) {
        const auto rest = [&](const Rational& r) {
          const Rational du = (u ? -p : p) * r, dv = (v ? -q : q) * r;
          return evaluate(patch, Rational(u + du), Rational(v + dv)) - corner.point - du * corner.du - dv * corner.dv;
        };
        const Rational r = Rational(1, Integer(1) << 60);
        const Point3 at_r = rest(r), at_half = rest(r / 2);
        const Rational size = dot(at_r, at_r), of_half = 16 * dot(at_half, at_half);
        EXPECT_LT(size, r * r * r) << "not of second order";
        EXPECT_LT(abs(Rational(of_half - size)), size / 1000);
      }
    }
}

TEST(GregoryPatch, Law5_OnItsEdgesItIsTheSurfaceThatCarriesThem) {
  RandomRationals random;
  for (int round = 0; round < 4; ++round) {
    const Patch patch = random_gregory_patch(random, {.rational = round > 0});
    ASSERT_TRUE(corners_agree(patch));
    for (const Rational& t : parameters(patch))
      for (const int end : {0, 1}) {
        const auto expect = [&](const BsplinePatch<Rational, 4>& carrier, const Rational& u, const Rational& v) {
          const SurfaceFrame<Rational> s = frame(patch, u, v);
          const auto of_carrier = rational_derivatives(carrier, u, v, 1, 1);
          EXPECT_EQ(s.point, of_carrier.at(0, 0));
          EXPECT_EQ(s.du, of_carrier.at(1, 0));
          EXPECT_EQ(s.dv, of_carrier.at(0, 1));
        };
        expect(patch.u_surface(), end, t);
        expect(patch.v_surface(), t, end);
      }
  }
}

TEST(GregoryPatch, Law5_TheTwistsAreThoseOfTheCarriers) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  const auto twists = corner_twists(patch);
  const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Rational tiny = Rational(1) / Rational(1 << 28);
  for (int k = 0; k < 4; ++k) {
    EXPECT_FALSE(twists[k].from_u == twists[k].from_v);
    const Rational u = corners[k][0], v = corners[k][1], du = u == 0 ? tiny : -tiny, dv = v == 0 ? tiny : -tiny;
    // S_u along the edge in v, and S_v along the edge in u, by difference quotients.
    const Point3 along_v = Rational(1 / dv) * (frame(patch, u, v + dv).du - frame(patch, u, v).du);
    const Point3 along_u = Rational(1 / du) * (frame(patch, u + du, v).dv - frame(patch, u, v).dv);
    const Point3 a = along_v - twists[k].from_u, b = along_u - twists[k].from_v;
    EXPECT_LT(dot(a, a), tiny);
    EXPECT_LT(dot(b, b), tiny);
  }
}

TEST(GregoryPatch, Law6_CornersAgreeUntilOneControlPointMoves) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  ASSERT_TRUE(corners_agree(patch));
  const Rational tiny = Rational(1) / Rational(1 << 30);
  const BsplinePatch<Rational, 4>& u = patch.u_surface();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < u.count(Direction::v); ++j) {
      std::vector<Point4> net = u.net();
      net[i * u.count(Direction::v) + j][1] += tiny;
      const auto moved = BsplinePatch<Rational, 4>(u.knots(Direction::u), u.knots(Direction::v), net);
      const int from_end = std::min(j, u.count(Direction::v) - 1 - j);
      const bool counts = from_end == 0 || (from_end == 1 && (i == 0 || i == 3));
      EXPECT_EQ(corners_agree(Patch::make(moved, patch.v_surface()).value()), !counts) << i << " " << j;
    }
}

// S^u + S^v − S^c is a sum of points with coefficients that sum to 1.
TEST(GregoryPatch, Law2_AffineMapsAndGauges) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  const auto mapped = [&](const Rational& factor, const Rational& offset) {
    return [=](const Point4& p) {
      return Point4{{factor * p[0] + offset * p[3], factor * p[1] - offset * p[3], factor * p[2] + p[3], p[3]}};
    };
  };
  for (const auto& [factor, offset] : std::vector<std::pair<Rational, Rational>>{
           {1, 1000000}, {"1/1000000000"_q, 0}, {1000000000, 3}, {"1/1000000000"_q, 1000000}}) {
    const Patch image = mapped_patch(patch, mapped(factor, offset));
    for (const Rational& x : {"1/3"_q, "1/1000000"_q, Rational(1)}) {
      const SurfaceFrame<Rational> a = frame(patch, x, "2/7"_q), b = frame(image, x, "2/7"_q);
      EXPECT_EQ(b.point, factor * a.point + Point3({offset, -offset, Rational(1)}));
      EXPECT_EQ(b.du, factor * a.du);
      EXPECT_EQ(b.dv, factor * a.dv);
    }
  }
  // Either surface times a number is the same surface.
  const auto times = [](const BsplinePatch<Rational, 4>& s, const Rational& c) {
    std::vector<Point4> net;
    for (const Point4& p : s.net()) net.push_back(c * p);
    return BsplinePatch<Rational, 4>(s.knots(Direction::u), s.knots(Direction::v), net);
  };
  const Patch both = Patch::make(times(patch.u_surface(), 3), times(patch.v_surface(), 3)).value();
  EXPECT_EQ(evaluate(both, "1/3"_q, "1/5"_q), evaluate(patch, "1/3"_q, "1/5"_q));
  // Of one of them alone the corner weights differ; the edges are what they were.
  const Patch one = Patch::make(times(patch.u_surface(), 3), patch.v_surface()).value();
  EXPECT_TRUE(corners_agree(one));
  EXPECT_EQ(frame(one, Rational(0), "1/5"_q).du, frame(patch, Rational(0), "1/5"_q).du);
  EXPECT_EQ(frame(one, "1/5"_q, Rational(1)).dv, frame(patch, "1/5"_q, Rational(1)).dv);
}

TEST(GregoryPatch, Errors) {
  const auto make = [](int degree_u, std::vector<Rational> u, int degree_v, std::vector<Rational> v,
                       const Rational& weight = 1, int place = -1) {
    const auto surface = [&](int p, const std::vector<Rational>& s, int q, const std::vector<Rational>& t, bool bad) {
      const auto ku = KnotVector<Rational>::make(p, s).value(), kv = KnotVector<Rational>::make(q, t).value();
      std::vector<Point4> net;
      for (int i = 0; i < ku.control_count(); ++i)
        for (int j = 0; j < kv.control_count(); ++j) net.push_back({{i, j, i * j, 1}});
      if (bad && place >= 0) net[place][3] = weight;
      return BsplinePatch<Rational, 4>(ku, kv, net);
    };
    const std::vector<Rational> cubic{0, 0, 0, 0, 1, 1, 1, 1};
    const auto good = surface(3, cubic, 3, cubic, false), bad = surface(degree_u, u, degree_v, v, true);
    const auto swapped = surface(degree_v, v, degree_u, u, false);
    const auto a = Patch::make(bad, good), b = Patch::make(good, swapped);
    if (place < 0) {
      EXPECT_EQ(a.has_value(), b.has_value());
      if (!a) {
        EXPECT_EQ(a.error().code, b.error().code);
        EXPECT_NE(a.error().message.find("the U surface"), std::string::npos);
        EXPECT_NE(b.error().message.find("the V surface"), std::string::npos);
      }
    }
    return a ? std::optional<ErrorCode>() : std::optional<ErrorCode>(a.error().code);
  };
  const std::vector<Rational> cubic{0, 0, 0, 0, 1, 1, 1, 1}, half{"1/2"_q};
  const auto knots = [](int ends, int inner) {
    std::vector<Rational> out(ends, Rational(0));
    out.insert(out.end(), inner, "1/2"_q);
    out.insert(out.end(), ends, Rational(1));
    return out;
  };
  EXPECT_EQ(make(3, cubic, 3, cubic), std::nullopt);
  EXPECT_EQ(make(3, cubic, 1, {0, 0, 1, 1}), std::nullopt);
  EXPECT_EQ(make(3, cubic, 4, knots(5, 4)), std::nullopt);
  EXPECT_EQ(make(2, {0, 0, 0, 1, 1, 1}, 3, cubic), ErrorCode::bad_degree);
  EXPECT_EQ(make(4, knots(5, 0), 3, cubic), ErrorCode::bad_degree);
  EXPECT_EQ(make(3, knots(4, 1), 3, cubic), ErrorCode::bad_degree) << "two pieces across";
  EXPECT_EQ(make(3, cubic, 0, {0, 1}), ErrorCode::bad_degree);
  EXPECT_EQ(make(3, cubic, 3, {0, 0, 0, 0, 2, 2, 2, 2}), ErrorCode::domains_differ);
  EXPECT_EQ(make(3, {-1, -1, -1, -1, 1, 1, 1, 1}, 3, cubic), ErrorCode::domains_differ);
  EXPECT_EQ(make(3, cubic, 3, {-1, 0, 0, 0, 1, 1, 1, 1}), ErrorCode::domains_differ) << "unclamped";
  EXPECT_EQ(make(3, cubic, 3, {0, 0, 0, 0, 0, 1, 1, 1, 1}), ErrorCode::domains_differ) << "a knot too many";
  EXPECT_EQ(make(3, cubic, 3, knots(4, 4)), ErrorCode::bad_multiplicity);
  for (const int place : {0, 3, 4, 15})  // at the ends of rows, whatever is next to them
    for (const Rational& weight : {Rational(0), Rational(-1), "-1/1000000000000"_q})
      EXPECT_EQ(make(3, cubic, 3, cubic, weight, place), ErrorCode::bad_weight);
  for (const int place : {1, 2, 5, 14})  // next to them λ helps
    EXPECT_EQ(make(3, cubic, 3, cubic, -5, place), std::nullopt);
}

}  // namespace
}  // namespace patchproof::test
