// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gerbs_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "patchproof/patch/rational_patch.h"
#include "support/rational_literal.h"

namespace patchproof {
namespace {

using test::operator""_q;
using Surface = GerbsSurface<Rational, 4>;

// z = c (x − 1)(y − 2) on [0, 3] × [0, 3]
LocalSurface<Rational, 4> saddle(const Rational& c) {
  std::vector<Vec<Rational, 4>> net;
  for (const int x : {0, 3})
    for (const int y : {0, 3})
      net.push_back({{Rational(x), Rational(y), Rational(c * Rational((x - 1) * (y - 2))), Rational(1)}});
  const auto knots = KnotVector<Rational>::bezier(1, "0"_q, "3"_q);
  return BsplinePatch<Rational, 4>(knots, knots, std::move(net));
}

Surface surface(const BFunction& b, const Rational& inner) {
  const Surface::Axis axis{gerbs_knots<Rational>({"0"_q, "1"_q, "3"_q}, false).value()};
  std::vector<LocalSurface<Rational, 4>> locals;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) locals.push_back(saddle(p == 0 ? "1/2"_q : p == 1 && q == 1 ? inner : "1"_q));
  return Surface::make(b, axis, axis, locals).value();
}

void expect_near(const Vec<double, 3>& a, const Vec<double, 3>& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-13 * (1 + std::abs(b[c])));
}

TEST(GerbsOutline, Law1_ValuesAndFirstDerivativesAtTheNodes) {
  for (const BFunction& b : {BFunction::logistic(), BFunction::trigonometric(), BFunction::polynomial(1).value()}) {
    const Surface s = surface(b, "3"_q);
    const BsplinePatch<Rational, 4> near = outline(s);
    EXPECT_EQ(near.knots(Direction::u).breaks().size(), 17u);  // eight cells for each of two spans
    for (const char* u : {"0", "1/8", "1", "5/4", "3"})
      for (const char* v : {"0", "7/8", "2", "3"}) {
        const Rational x = parse_scalar<Rational>(u).value(), y = parse_scalar<Rational>(v).value();
        const auto of = partial_derivatives_at<double>(s, {x, y}, {Side::right, Side::right}, nearest_double(x),
                                                       nearest_double(y), 1, 1);
        const auto found = rational_derivatives(near, x, y, 1, 1);
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l) {
            Vec<double, 3> rounded;
            for (int c = 0; c < 3; ++c) rounded[c] = nearest_double(found.at(k, l)[c]);
            expect_near(rounded, of.at(k, l));
          }
      }
  }
  // The curve along an edge.
  const GerbsCurve<Rational, 4> curve = edge(surface(BFunction::logistic(), "3"_q), EdgeName::v_max);
  const BsplineCurve<Rational, 4> near = outline(curve);
  for (const char* t : {"0", "1/8", "1", "2", "3"}) {
    const Rational at = parse_scalar<Rational>(t).value();
    const auto of = derivatives_at<double>(curve, at, Side::right, nearest_double(at), 1);
    const auto found = rational_derivatives(near, at, 1);
    for (int k = 0; k < 2; ++k)
      expect_near({{nearest_double(found[k][0]), nearest_double(found[k][1]), nearest_double(found[k][2])}}, of[k]);
  }
}

TEST(GerbsOutline, Law2_AnEdgeDependsOnNothingBeyondIt) {
  const BsplinePatch<Rational, 4> a = outline(surface(BFunction::logistic(), "3"_q)),
                                  b = outline(surface(BFunction::logistic(), "-7"_q));
  const std::ptrdiff_t row = a.count(Direction::v);
  const auto equal = [](const Vec<Rational, 4>& p, const Vec<Rational, 4>& q) {
    for (int c = 0; c < 3; ++c)
      if (std::abs(nearest_double(Rational(p[c] - q[c]))) > 1e-14) return false;
    return true;
  };
  EXPECT_TRUE(std::equal(a.net().begin(), a.net().begin() + row, b.net().begin(), equal));  // u = 0
  EXPECT_TRUE(std::equal(a.net().end() - row, a.net().end(), b.net().end() - row, equal));  // u = 3
  EXPECT_FALSE(std::equal(a.net().begin(), a.net().end(), b.net().begin(), equal));
}

}  // namespace
}  // namespace patchproof
