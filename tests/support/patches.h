// SPDX-License-Identifier: Apache-2.0
// Patches for tests: random exact ones, the same in another scalar, and an exact proof that two surfaces are one.
#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof::test {

template <std::size_t N>
BsplinePatch<Rational, N> random_patch(RandomRationals& random, int p, int count_u, int q, int count_v) {
  return {make_knots<Rational>(p, random.knots(p, count_u)), make_knots<Rational>(q, random.knots(q, count_v)),
          random.points<N>(count_u * count_v)};
}

template <class T, std::size_t N>
BsplinePatch<T, N> make_patch(const BsplinePatch<Rational, N>& s) {
  return {make_knots<T>(s.degree(Direction::u), s.knots(Direction::u).knots()),
          make_knots<T>(s.degree(Direction::v), s.knots(Direction::v).knots()), make_points<T>(s.net())};
}

// ∂^(k+l) S / ∂u^k ∂v^l by multiplying out the definition of the basis, with no evaluation code of the library.
template <std::size_t N>
Vec<Rational, N> derivative_by_definition(const BsplinePatch<Rational, N>& s, const Rational& u, const Rational& v,
                                          int k, int l, Side side_u = Side::right, Side side_v = Side::right) {
  const auto values = [](const KnotVector<Rational>& knots, const Rational& t, int order, Side side) {
    const int span = knots.find_span(t, side);
    std::vector<Rational> out;
    for (int i = 0; i < knots.control_count(); ++i)
      out.push_back(bspline_piece(knots.knots(), i, knots.degree(), span).derivative(order)(t));
    return out;
  };
  const auto nu = values(s.knots(Direction::u), u, k, side_u), nv = values(s.knots(Direction::v), v, l, side_v);
  Vec<Rational, N> sum;
  for (std::size_t i = 0; i < nu.size(); ++i)
    for (std::size_t j = 0; j < nv.size(); ++j) sum += Rational(nu[i] * nv[j]) * s.point(i, j);
  return sum;
}

// count + 1 parameters, evenly spread from a to b.
inline std::vector<Rational> spread(const Rational& a, const Rational& b, int count) {
  std::vector<Rational> out;
  for (int i = 0; i <= count; ++i) out.push_back(a + (b - a) * Rational(i) / Rational(count));
  return out;
}

// Parameters that decide equality of splines: between any two neighbouring knots of either, more inner parameters than the
// higher degree (two polynomials of degree n that agree at n + 1 places are the same).
inline std::vector<Rational> deciding_parameters(const KnotVector<Rational>& a, const KnotVector<Rational>& b) {
  std::set<Rational> breaks;
  for (const auto* knots : {&a, &b})
    for (const Rational& t : knots->breaks()) breaks.insert(t);
  std::vector<Rational> out;
  for (auto low = breaks.begin(), high = std::next(low); high != breaks.end(); ++low, ++high) {
    const auto inside = spread(*low, *high, std::max(a.degree(), b.degree()) + 2);
    out.insert(out.end(), inside.begin() + 1, inside.end() - 1);
  }
  return out;
}

// The two patches are the same function on the same domain: proven, not sampled.
template <std::size_t N>
void expect_same_surface(const BsplinePatch<Rational, N>& a, const BsplinePatch<Rational, N>& b) {
  ASSERT_TRUE(a.domain() == b.domain());
  const auto vs = deciding_parameters(a.knots(Direction::v), b.knots(Direction::v));
  for (const Rational& u : deciding_parameters(a.knots(Direction::u), b.knots(Direction::u)))
    for (const Rational& v : vs) ASSERT_EQ(evaluate(a, u, v).c, evaluate(b, u, v).c) << "at u = " << u << ", v = " << v;
}

}  // namespace patchproof::test
