// SPDX-License-Identifier: Apache-2.0
// B-spline curves with every awkward kind of knots, and the question whether two of them are the same curve.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "patchproof/spline/curve.h"
#include "support/scalars.h"

namespace patchproof::test {

using PlaneCurve = BsplineCurve<Rational, 2>;

struct NamedCurve {
  std::string name;
  PlaneCurve curve;
};

// Random points on the given knots.
inline PlaneCurve curve_on(RandomRationals& random, int degree, const std::vector<Rational>& knots) {
  const auto k = KnotVector<Rational>::make(degree, knots).value();
  return PlaneCurve(k, random.points<2>(k.control_count()));
}

// All knots are doubles, so that every scalar can run them.
inline std::vector<NamedCurve> awkward_curves(RandomRationals& random) {
  const auto r = [](std::vector<int> numerators, int denominator = 1, int offset = 0) {
    std::vector<Rational> out;
    for (const int n : numerators) out.push_back(Rational(offset) + Rational(n) / Rational(denominator));
    return out;
  };
  const auto on = [&](int degree, const std::vector<Rational>& knots) { return curve_on(random, degree, knots); };
  const Rational tiny = Rational(1) / Rational(1 << 12);
  return {
      {"degree 0", on(0, r({0, 1, 3}))},
      {"degree 1, unclamped", on(1, r({-1, 0, 1, 3, 4}))},
      {"Bezier", on(3, r({0, 0, 0, 0, 1, 1, 1, 1}))},
      {"simple and double inner knots", on(3, r({0, 0, 0, 0, 1, 3, 3, 4, 4, 4, 4}))},
      {"inner knot of multiplicity p", on(2, r({0, 0, 0, 1, 1, 2, 2, 2}))},
      {"a jump: inner knot of multiplicity p + 1", on(2, r({0, 0, 0, 1, 1, 1, 2, 3, 3, 3}))},
      {"dead points: inner knot of multiplicity p + 3", on(2, r({0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2}))},
      {"dead points at both ends", on(2, r({0, 0, 0, 0, 0, 1, 2, 2, 2, 2}))},
      {"unclamped, uniform", on(3, r({-3, -2, -1, 0, 1, 2, 3, 4, 5}))},
      {"unclamped, repeated knots about the ends", on(3, r({-2, -1, 0, 0, 0, 1, 2, 2, 3, 3, 5}))},
      {"clamped at the begin only", on(3, r({0, 0, 0, 0, 1, 2, 4, 5, 7}))},
      {"domain from 1.40625", on(2, r({45, 45, 45, 50, 61, 61, 61}, 32))},
      {"knots about a million", on(3, r({0, 0, 0, 0, 1, 2, 2, 4, 4, 4, 4}, 4, 1000000))},
      {"a tiny span", on(2, {Rational(0), Rational(0), Rational(0), Rational(1), Rational(1) + tiny, Rational(2),
                             Rational(2), Rational(2)})},
  };
}

// Clamped with ends of multiplicity exactly p + 1 and no inner knot above: every control point has influence.
template <Ring T, std::size_t N, OrderedField K>
bool is_clean(const BsplineCurve<T, N, K>& c) {
  const std::vector<K>& t = c.knots().knots();
  for (std::size_t i = 0; i + c.degree() + 1 < t.size(); ++i)
    if (t[i] == t[i + c.degree() + 1]) return false;
  return c.knots().is_clamped();
}

template <OrderedField K>
std::vector<K> common_breaks(const KnotVector<K>& a, const KnotVector<K>& b) {
  const std::vector<K> of_a = a.breaks(), of_b = b.breaks();
  std::vector<K> out;
  std::set_union(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(out));
  return out;
}

// d + 1 parameters in [a, b], ends included: two polynomials of degree d that agree there are the same.
template <OrderedField K>
std::vector<K> enough_parameters(const K& a, const K& b, int d) {
  if (d == 0) return {a};
  std::vector<K> out;
  for (int i = 0; i <= d; ++i) out.push_back(K(a + (b - a) * (K(i) / K(d))));
  return out;
}

// The span whose piece is the curve on [a, b]. REQUIRES no break inside.
template <OrderedField K>
int span_over(const KnotVector<K>& knots, const K& a, const K& b) {
  return knots.find_span(K((a + b) / K(2)));
}

// The same domain and the same polynomial on every span, decided by de Boor's algorithm alone.
template <ExactField T, std::size_t N, ExactField K>
void expect_same_curve(const BsplineCurve<T, N, K>& a, const BsplineCurve<T, N, K>& b) {
  ASSERT_TRUE(a.knots().domain_begin() == b.knots().domain_begin() && a.knots().domain_end() == b.knots().domain_end())
      << "the domains differ";
  const std::vector<K> breaks = common_breaks(a.knots(), b.knots());
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const int in_a = span_over(a.knots(), breaks[i], breaks[i + 1]),
              in_b = span_over(b.knots(), breaks[i], breaks[i + 1]);
    for (const K& t : enough_parameters(breaks[i], breaks[i + 1], std::max(a.degree(), b.degree())))
      EXPECT_TRUE(evaluate_in_span<T>(a, in_a, t) == evaluate_in_span<T>(b, in_b, t))
          << "the curves differ on span " << i;
  }
}

// A knot in the interior of every span, every break, and the ends.
inline std::vector<Rational> places(const KnotVector<Rational>& knots) {
  std::vector<Rational> out = knots.breaks();
  for (std::size_t i = 0, count = out.size(); i + 1 < count; ++i)
    out.push_back((Rational(3) * out[i] + out[i + 1]) / Rational(4));
  return out;
}

}  // namespace patchproof::test
