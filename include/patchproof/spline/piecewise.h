// SPDX-License-Identifier: Apache-2.0
// Piecewise polynomials as lists of Bézier pieces, and their algebra: what a construction needs that adds, multiplies and
// cuts curves with different knots and degrees, before it is written as a B-spline.
//
//   f = (f_1, …, f_s) over breaks x_0 < x_1 < … < x_s,   f_i a Bézier curve on [x_{i−1}, x_i], all of one degree
//
// No smoothness is kept or assumed at the breaks; is_c1 asks for it.
//
// REQUIRES  pieces that follow each other without gaps, all of one degree, at least one; two operands over one range.
// ENSURES   (1) refine, elevate, window: the same functions, where they are defined;  (2) sum, scale, product: those of the
//           values;  (3) derivative: that of the values on each piece;  (4) part(f, a, b)(t) = f(a + (b − a) t) on [0, 1],
//           also for b < a, where it runs backwards;  (5) value: the polynomial of the piece to the given side of t;
//           (6) is_c1: exactly when values and first derivatives agree at every inner break;
//           (7) joined: the B-spline with these pieces, if they are C^(p−m) at the inner breaks (m = multiplicity);
//           (8) joined_smoothly: the B-spline with these pieces, each inner break as often as they need, 0 to p + 1 times.
// SCALARS   T: Field, K: OrderedField; is_c1: T ExactRing. Exact in exact scalars.
// COST      of refine: O(p³) combinations of points for each new break; window, part and value: O(log s) and the pieces they
//           need; the others one pass.
// NEIGHBOURS bezier_extraction.h (from a B-spline and back), product.h (of two B-splines, with their knots).
// TEST      tests/spline/piecewise_test.cpp checks (1)–(8).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/knot_ratio.h"

namespace patchproof {

template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
using Piecewise = std::vector<BezierPiece<T, N, K>>;

// x_0, …, x_s.
template <Ring T, std::size_t N, OrderedField K>
std::vector<K> breaks(const Piecewise<T, N, K>& f);

// The union of two increasing lists.
template <OrderedField K>
std::vector<K> common_breaks(const std::vector<K>& a, const std::vector<K>& b);

// f, cut also at those `at` that lie inside its range. REQUIRES `at` increasing.
template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> refine(const Piecewise<T, N, K>& f, const std::vector<K>& at);

// f, of at least this degree.
template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> elevate(Piecewise<T, N, K> f, int degree);

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> sum(const Piecewise<T, N, K>& f, const Piecewise<T, N, K>& g);

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> scale(const T& factor, Piecewise<T, N, K> f);

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> product(const Piecewise<T, 1, K>& f, const Piecewise<T, N, K>& g);

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> derivative(Piecewise<T, N, K> f);

// f on [begin, end] only. REQUIRES begin < end inside the range.
template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> window(const Piecewise<T, N, K>& f, const K& begin, const K& end);

// t → f(from + (to − from) t) on [0, 1]. REQUIRES from != to inside the range.
template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> part(const Piecewise<T, N, K>& f, const K& from, const K& to);

// The order-th derivative at t of the piece to that side. REQUIRES t in the range, order ≥ 0.
template <Field T, std::size_t N, OrderedField K>
Vec<T, N> value(const Piecewise<T, N, K>& f, const K& t, int order = 0, Side side = Side::right);

template <ExactRing T, std::size_t N, OrderedField K>
bool is_c1(const Piecewise<T, N, K>& f);

// As a B-spline whose inner breaks have this multiplicity. REQUIRES 1 ≤ multiplicity ≤ degree + 1.
template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> joined(const Piecewise<T, N, K>& f, int multiplicity);

template <ExactField T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> joined_smoothly(const Piecewise<T, N, K>& f);

// The knots of (8) for several functions at once: each inner break as often as one of them needs. REQUIRES at least one; equal
// breaks and degrees.
template <ExactField T, std::size_t N, OrderedField K>
KnotVector<K> smoothest_knots(const std::vector<Piecewise<T, N, K>>& functions);

// How many derivatives agree at the end of piece i: −1 where the values differ, the degree where both are one polynomial.
template <ExactField T, std::size_t N, OrderedField K>
int agreement(const Piecewise<T, N, K>& f, std::size_t i);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <Ring T, std::size_t M, std::size_t N, OrderedField K>
bool over_one_range(const Piecewise<T, M, K>& f, const Piecewise<T, N, K>& g) {
  return !f.empty() && !g.empty() && f.front().begin == g.front().begin && f.back().end == g.back().end;
}

// The piece to that side of t; the last or the first where there is none.
template <Ring T, std::size_t N, OrderedField K>
auto piece_at(const Piecewise<T, N, K>& f, const K& t, Side side) {
  return std::partition_point(f.begin(), f.end() - 1, [&](const BezierPiece<T, N, K>& piece) {
    return side == Side::right ? piece.end <= t : piece.end < t;
  });
}

}  // namespace detail

template <Ring T, std::size_t N, OrderedField K>
std::vector<K> breaks(const Piecewise<T, N, K>& f) {
  PATCHPROOF_REQUIRES(!f.empty(), "breaks: no pieces");
  std::vector<K> out{f.front().begin};
  for (const BezierPiece<T, N, K>& piece : f) out.push_back(piece.end);
  return out;
}

template <OrderedField K>
std::vector<K> common_breaks(const std::vector<K>& a, const std::vector<K>& b) {
  std::vector<K> out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> refine(const Piecewise<T, N, K>& f, const std::vector<K>& at) {
  Piecewise<T, N, K> out;
  auto next = at.begin();
  for (const BezierPiece<T, N, K>& piece : f) {
    std::vector<K> cuts{piece.begin};
    while (next != at.end() && !(piece.begin < *next)) ++next;
    for (; next != at.end() && *next < piece.end; ++next) cuts.push_back(*next);
    if (cuts.size() == 1) {
      out.push_back(piece);
      continue;
    }
    cuts.push_back(piece.end);
    std::vector<Vec<T, N>> rest = piece.points;
    for (std::size_t i = 1; i + 1 < cuts.size(); ++i) {
      BezierHalves<Vec<T, N>> halves = split(rest, knot_ratio<T>(cuts[i], cuts[i - 1], piece.end));
      out.push_back({cuts[i - 1], cuts[i], std::move(halves.left)});
      rest = std::move(halves.right);
    }
    out.push_back({cuts[cuts.size() - 2], piece.end, std::move(rest)});
  }
  return out;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> elevate(Piecewise<T, N, K> f, int degree) {
  for (BezierPiece<T, N, K>& piece : f)
    piece.points = elevate_degree(std::move(piece.points), std::max(0, degree - piece.degree()));
  return f;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> sum(const Piecewise<T, N, K>& f, const Piecewise<T, N, K>& g) {
  PATCHPROOF_REQUIRES((detail::over_one_range<T, N, N, K>(f, g)), "sum: the ranges differ");
  const int degree = std::max(f.front().degree(), g.front().degree());
  Piecewise<T, N, K> out = elevate(refine(f, breaks(g)), degree);
  const Piecewise<T, N, K> other = elevate(refine(g, breaks(f)), degree);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (int j = 0; j <= degree; ++j) out[i].points[j] += other[i].points[j];
  return out;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> scale(const T& factor, Piecewise<T, N, K> f) {
  for (BezierPiece<T, N, K>& piece : f)
    for (Vec<T, N>& p : piece.points) p = factor * p;
  return f;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> product(const Piecewise<T, 1, K>& f, const Piecewise<T, N, K>& g) {
  PATCHPROOF_REQUIRES((detail::over_one_range<T, 1, N, K>(f, g)), "product: the ranges differ");
  const Piecewise<T, 1, K> factors = refine(f, breaks(g));
  Piecewise<T, N, K> out = refine(g, breaks(f));
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::vector<T> factor;
    for (const Vec<T, 1>& c : factors[i].points) factor.push_back(c[0]);
    out[i].points = product(factor, out[i].points);
  }
  return out;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> derivative(Piecewise<T, N, K> f) {
  for (BezierPiece<T, N, K>& piece : f) {
    const T rate = knot_rate<T>(1, piece.begin, piece.end);
    piece.points = hodograph(piece.points);
    for (Vec<T, N>& p : piece.points) p = rate * p;
  }
  return f;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> window(const Piecewise<T, N, K>& f, const K& begin, const K& end) {
  PATCHPROOF_REQUIRES(f.front().begin <= begin && begin < end && end <= f.back().end, "window: outside the range");
  auto first = detail::piece_at(f, begin, Side::right), last = first;
  while (last != f.end() && last->begin < end) ++last;
  Piecewise<T, N, K> out;
  for (BezierPiece<T, N, K>& piece : refine(Piecewise<T, N, K>(first, last), std::vector<K>{begin, end}))
    if (begin <= piece.begin && piece.end <= end) out.push_back(std::move(piece));
  return out;
}

template <Field T, std::size_t N, OrderedField K>
Piecewise<T, N, K> part(const Piecewise<T, N, K>& f, const K& from, const K& to) {
  const bool backwards = to < from;
  Piecewise<T, N, K> out = backwards ? window(f, to, from) : window(f, from, to);
  const K length = to - from;
  for (BezierPiece<T, N, K>& piece : out) {
    piece.begin = (piece.begin - from) / length;
    piece.end = (piece.end - from) / length;
    if (!backwards) continue;
    std::swap(piece.begin, piece.end);
    std::reverse(piece.points.begin(), piece.points.end());
  }
  if (backwards) std::reverse(out.begin(), out.end());
  return out;
}

template <Field T, std::size_t N, OrderedField K>
Vec<T, N> value(const Piecewise<T, N, K>& f, const K& t, int order, Side side) {
  PATCHPROOF_REQUIRES(f.front().begin <= t && t <= f.back().end, "value: outside the range");
  const BezierPiece<T, N, K>& piece = *detail::piece_at(f, t, side);
  if (order <= 1 && piece.degree() >= 1 && (t == piece.begin || t == piece.end)) {
    const std::vector<Vec<T, N>>& q = piece.points;
    const bool at_end = t == piece.end;
    if (order == 0) return at_end ? q.back() : q.front();
    return knot_rate<T>(piece.degree(), piece.begin, piece.end) *
           (at_end ? q[q.size() - 1] - q[q.size() - 2] : q[1] - q[0]);
  }
  Vec<T, N> out = derivative(piece.points, knot_ratio<T>(t, piece.begin, piece.end), order);
  for (int k = 0; k < order; ++k) out = knot_rate<T>(1, piece.begin, piece.end) * out;
  return out;
}

template <ExactRing T, std::size_t N, OrderedField K>
bool is_c1(const Piecewise<T, N, K>& f) {
  for (std::size_t i = 0; i + 1 < f.size(); ++i)
    for (const int order : {0, 1})
      if (!(value(f, f[i].end, order, Side::left) == value(f, f[i].end, order, Side::right))) return false;
  return true;
}

template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> joined(const Piecewise<T, N, K>& f, int multiplicity) {
  const int p = f.front().degree();
  PATCHPROOF_REQUIRES(1 <= multiplicity && multiplicity <= p + 1, "joined: a multiplicity of 1 … degree + 1");
  std::vector<K> knots(p + 1, f.front().begin);
  for (std::size_t i = 0; i + 1 < f.size(); ++i) knots.insert(knots.end(), multiplicity, f[i].end);
  knots.insert(knots.end(), p + 1, f.back().end);
  if (p - 1 <= multiplicity &&
      multiplicity <= p) {  // the Bézier points, without the joints that their neighbours decide
    std::vector<Vec<T, N>> points;
    for (std::size_t i = 0; i < f.size(); ++i)
      points.insert(points.end(), f[i].points.begin() + (i == 0 ? 0 : 1),
                    f[i].points.end() - (i + 1 < f.size() && multiplicity == p - 1 ? 1 : 0));
    return BsplineCurve<T, N, K>(KnotVector<K>::make_unchecked(p, std::move(knots)), std::move(points));
  }
  return join_pieces(f, KnotVector<K>::make_unchecked(p, std::move(knots)));
}

template <ExactField T, std::size_t N, OrderedField K>
int agreement(const Piecewise<T, N, K>& f, std::size_t i) {
  const K& t = f[i].end;
  int order = 0;
  while (order <= f[i].degree() && value(f, t, order, Side::left) == value(f, t, order, Side::right)) ++order;
  return order - 1;
}

template <ExactField T, std::size_t N, OrderedField K>
KnotVector<K> smoothest_knots(const std::vector<Piecewise<T, N, K>>& functions) {
  const Piecewise<T, N, K>& one = functions.front();
  const int p = one.front().degree();
  std::vector<K> knots(p + 1, one.front().begin);
  for (std::size_t i = 0; i + 1 < one.size(); ++i) {
    int order = p;
    for (const Piecewise<T, N, K>& f : functions)
      if (order >= 0) order = std::min(order, agreement(f, i));
    knots.insert(knots.end(), p - order, one[i].end);
  }
  knots.insert(knots.end(), p + 1, one.back().end);
  return KnotVector<K>::make_unchecked(p, std::move(knots));
}

template <ExactField T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> joined_smoothly(const Piecewise<T, N, K>& f) {
  return join_pieces(f, smoothest_knots(std::vector<Piecewise<T, N, K>>{f}));
}

}  // namespace patchproof
