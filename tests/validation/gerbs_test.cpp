// SPDX-License-Identifier: Apache-2.0
// Values, derivatives and jumps of GERBS curves and surfaces, found by an independent program in fractions
// (validation/vectors/gerbs.json), and what the source prints wrongly (errata E-GERBS-05 to 14).
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "patchproof/patch/gerbs_surface.h"
#include "patchproof/spline/gerbs_spline.h"
#include "patchproof/spline/reparametrize.h"
#include "support/polynomial.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using json = nlohmann::json;
using Curve = GerbsCurve<Rational, 3>;
using Local = LocalCurve<Rational, 3>;
using Surface = GerbsSurface<Rational, 4>;

const json& document() {
  static const json all =
      json::parse(std::ifstream(std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "validation/vectors/gerbs.json"));
  return all;
}
const json& object(const std::string& name) {
  for (const json& o : document().at("objects"))
    if (o.at("name") == name) return o;
  throw std::runtime_error(name);
}
Rational number(const json& x) { return parse_scalar<Rational>(x.get<std::string>()).value(); }
std::vector<Rational> numbers(const json& x) {
  std::vector<Rational> out;
  for (const json& y : x) out.push_back(number(y));
  return out;
}
BFunction of_order(int n) { return BFunction::polynomial(n).value(); }

// Powers as a Bézier curve: b_l = Σ_j C(l,j)/C(q,j) a_j after t = begin + (end − begin) x.
std::vector<Rational> bernstein(const Polynomial& powers, const Rational& begin, const Rational& end, int degree) {
  Polynomial a = powers.compose(Polynomial({begin, Rational(end - begin)}));
  a.c.resize(degree + 1, Rational(0));
  std::vector<Rational> out;
  for (int l = 0; l <= degree; ++l) {
    Rational sum(0), ratio(1);
    for (int j = 0; j <= l; ++j) {
      sum += ratio * a.c[j];
      if (j < degree) ratio = ratio * Rational(l - j) / Rational(degree - j);
    }
    out.push_back(sum);
  }
  return out;
}
BsplineCurve<Rational, 3> spline_of(const json& powers, const Rational& begin, const Rational& end) {
  const int degree = static_cast<int>(std::max<std::size_t>({2, powers[0].size(), powers[1].size()})) - 1;
  const auto x = bernstein(Polynomial(numbers(powers[0])), begin, end, degree),
             y = bernstein(Polynomial(numbers(powers[1])), begin, end, degree);
  std::vector<Vec<Rational, 3>> points;
  for (int l = 0; l <= degree; ++l) points.push_back({{x[l], y[l], 1}});
  return {KnotVector<Rational>::bezier(degree, begin, end), std::move(points)};
}
Local heart() {
  std::vector<Vec<Rational, 3>> points;
  for (const json& p : object("heart").at("coefficients"))
    points.push_back({{number(p[0]), number(p[1]), points.empty() ? 1 : 0}});
  return Local::trigonometric(std::move(points)).value();
}

Curve curve_of(const json& o) {
  if (o.at("kind") == "blend")
    return Curve::blend(of_order(o.at("order")), spline_of(o.at("first"), 0, 1), spline_of(o.at("second"), 0, 1),
                        Rational(1) - number(o.at("ratio")))
        .value();
  const auto knots = KnotVector<Rational>::make(1, numbers(o.at("knots"))).value();
  std::vector<Local> locals;
  if (o.at("kind") == "beating heart") {
    for (const json& by : o.at("translations"))
      locals.push_back(heart().map_points([x = number(by[0]), y = number(by[1])](const Vec<Rational, 3>& p) {
        return Vec<Rational, 3>{{p[0] + x * p[2], p[1] + y * p[2], p[2]}};
      }));
    return Curve::make(of_order(o.at("order")), knots, std::move(locals), true).value();
  }
  for (std::size_t i = 0; i < o.at("locals").size(); ++i)
    locals.push_back(spline_of(o.at("locals")[i], knots[static_cast<int>(i)], knots[static_cast<int>(i) + 2]));
  return Curve::make(of_order(o.at("order")), knots, std::move(locals), o.at("closed")).value();
}

Surface surface_of(const json& o) {
  const auto axis = [&](int d) {
    return Surface::Axis{KnotVector<Rational>::make(1, numbers(o.at("knots")[d])).value(), o.at("closed")[d]};
  };
  const Surface::Axis u = axis(0), v = axis(1);
  std::vector<LocalSurface<Rational, 4>> locals;
  for (int p = 0; p < u.distinct(); ++p)
    for (int q = 0; q < v.distinct(); ++q) {
      // Bilinear, so the corners decide.
      std::vector<Vec<Rational, 4>> net;
      for (const Rational& x : {u.knots[p], u.knots[p + 2]})
        for (const Rational& y : {v.knots[q], v.knots[q + 2]}) {
          Vec<Rational, 4> point{{0, 0, 0, 1}};
          for (std::size_t c = 0; c < 3; ++c)
            for (const json& term : o.at("locals")[p][q][c]) {
              EXPECT_TRUE(term[0] <= 1 && term[1] <= 1);
              point[c] += number(term[2]) * (term[0] == 1 ? x : Rational(1)) * (term[1] == 1 ? y : Rational(1));
            }
          net.push_back(point);
        }
      locals.push_back(BsplinePatch<Rational, 4>(KnotVector<Rational>::bezier(1, u.knots[p], u.knots[p + 2]),
                                                 KnotVector<Rational>::bezier(1, v.knots[q], v.knots[q + 2]), net));
    }
  return Surface::make(of_order(o.at("order")), u, v, locals).value();
}

std::vector<Side> sides(const json& v) {
  const std::string side = v.value("side", "right");
  if (side == "both") return {Side::left, Side::right};
  return {side == "left" ? Side::left : Side::right};
}

// check(computed in R by f.operator()<R>(), expected) for each exact value.
template <class T>
long check_exact() {
  long count = 0;
  for (const json& v : document().at("vectors")) {
    const json& o = object(v.at("object"));
    const bool is_surface = o.at("kind") == "surface";
    if (!is_surface && o.at("kind") != "curve" && o.at("kind") != "blend") continue;
    SCOPED_TRACE(v.dump());
    for (const Side side : sides(v)) {
      const std::vector<Rational> at = numbers(v.at("at"));
      std::vector<Rational> expected;
      for (const json& value : v.at("values"))
        for (const json& x : value.at("value")) expected.push_back(number(x));
      count += static_cast<long>(expected.size());
      if (is_surface) {
        const Surface s = surface_of(o);
        check<T>(expected, [&]<class R>() {
          const auto d = partial_derivatives_at<R>(s, std::array<Rational, 2>{at[0], at[1]}, std::array{side, side},
                                                   embed<R>(at[0]), embed<R>(at[1]), 1, 1);
          std::vector<R> out;
          for (const json& value : v.at("values"))
            for (const std::size_t c : {0u, 1u, 2u}) out.push_back(d.at(value.at("order")[0], value.at("order")[1])[c]);
          return out;
        });
      } else {
        const Curve f = curve_of(o);
        check<T>(expected, [&]<class R>() {
          const auto d = derivatives_at<R>(f, at[0], side, embed<R>(at[0]), 2);
          std::vector<R> out;
          for (const json& value : v.at("values"))
            for (const std::size_t c : {0u, 1u}) out.push_back(d[value.at("order")[0].get<int>()][c]);
          return out;
        });
      }
    }
  }
  return count;
}

TEST(GerbsVectors, ExactNumbersAreEqual) { EXPECT_GT(check_exact<Rational>(), 800); }
TEST(GerbsVectors, IntervalsEnclose) {
  const RoundingGuard guard;
  EXPECT_GT(check_exact<Interval>(), 800);
}
TEST(GerbsVectors, DoublesStayWithinTheirBounds) { EXPECT_GT(check_exact<double>(), 800); }

TEST(GerbsVectors, TheConvertedSplinesHaveThePrintedPowers) {
  int count = 0;
  for (const json& o : document().at("objects")) {
    if (!o.contains("spans")) continue;
    const auto spline = to_spline(curve_of(o)).value();
    const auto breaks = spline.knots().breaks();
    for (std::size_t i = 0; i < o.at("spans").size(); ++i)
      for (const std::size_t c : {0u, 1u}) {
        const Polynomial powers(numbers(o.at("spans")[i][c]));
        for (int k = 0; k <= spline.degree(); ++k, ++count) {
          const Rational t = breaks[i] + (breaks[i + 1] - breaks[i]) * Rational(k) / Rational(spline.degree());
          EXPECT_EQ(evaluate(spline, t, k == 0 ? Side::right : Side::left)[c], powers(t));
        }
      }
  }
  EXPECT_GT(count, 100);
}

TEST(GerbsVectors, JumpsOfTheNextDerivative) {
  const RoundingGuard guard;
  int count = 0;
  for (const json& j : document().at("jumps")) {
    SCOPED_TRACE(j.dump());
    const Curve f = curve_of(object(j.at("object")));
    const int order = j.at("order");
    const Rational t = number(j.at("at"));
    const auto left = derivatives_at<Rational>(f, t, Side::left, t, order + 1),
               right = derivatives_at<Rational>(f, t, Side::right, t, order + 1);
    for (int r = 0; r <= order; ++r) EXPECT_EQ(left[r], right[r]);
    for (const std::size_t c : {0u, 1u}) EXPECT_EQ(Rational(right.back()[c] - left.back()[c]), number(j.at("jump")[c]));
    for (const auto& here : smoothness(f))
      if (here.t == t) {
        EXPECT_EQ(here.order, order);
        ++count;
      }
  }
  EXPECT_EQ(count, 14);
}

// At angles whose cosine and sine are rational: the angle is enclosed, and the derivatives by it are exact.
TEST(GerbsVectors, TheHeart) {
  int count = 0;
  for (const json& v : document().at("vectors")) {
    if (!v.contains("cosine and sine")) continue;
    SCOPED_TRACE(v.dump());
    const auto cs = numbers(v.at("cosine and sine"));
    const Ball t = cs[0] == -1 ? Ball(1) : Ball(2) * atan(Ball(Rational(cs[1] / (Rational(1) + cs[0])))) / Ball::pi();
    const auto d = derivatives_at<Ball>(heart(), Rational(0), Side::right, t, 2);
    Ball scale(1);
    for (int r = 0; r <= 2; ++r) {
      for (const std::size_t c : {0u, 1u}) {
        expect_agrees(Ball(d[r][c] / scale), number(v.at("values")[r].at("value")[c]));
        ++count;
      }
      scale = scale * Ball::pi();
    }
  }
  EXPECT_EQ(count, 48);
}

TEST(GerbsVectors, TheHeartBeatsAndItsKnots) {
  const auto knots = numbers(object("heart_knots").at("knots"));
  EXPECT_EQ(gerbs_knots(std::vector<Rational>(knots.begin() + 1, knots.end() - 1), true).value().knots(), knots);
  int count = 0;
  for (const json& v : document().at("vectors")) {
    const json& o = object(v.at("object"));
    const bool beats = o.at("kind") == "beating heart";
    if (!beats && o.at("kind") != "heart knots") continue;
    SCOPED_TRACE(v.dump());
    const Rational t = number(v.at("at")[0]);
    const auto still = derivatives_at<Ball>(heart(), t, Side::right, Ball(t), 0)[0];
    const Side side = t == 2 ? Side::left : Side::right;
    const auto p = beats ? derivatives_at<Ball>(curve_of(o), t, side, Ball(t), 0)[0] : still;
    const auto rounded = beats ? derivatives_at<double>(curve_of(o), t, side, nearest_double(t), 0)[0]
                               : derivatives_at<double>(heart(), t, Side::right, nearest_double(t), 0)[0];
    for (const std::size_t c : {0u, 1u}) {
      const json& bounds = v.at("values")[0].at("value")[c];
      const Rational low = number(bounds[0]), high = number(bounds[1]);
      // Both hold the number, so neither lies beside the other; and ours is narrow.
      EXPECT_NE(Ball(p[c] - Ball(high)).sign(), Sign::positive);
      EXPECT_NE(Ball(p[c] - Ball(low)).sign(), Sign::negative);
      EXPECT_LT(Ball(p[c] - p[c]).to_interval().sup(), 1e-28);
      EXPECT_NEAR(rounded[c], nearest_double(low), 1e-13);
      if (beats) {
        EXPECT_TRUE(Ball(p[c] - still[c]).contains(number(v.at("displacement")[c])));
      }
      ++count;
    }
  }
  EXPECT_EQ(count, 32);
}

}  // namespace
}  // namespace patchproof::test
