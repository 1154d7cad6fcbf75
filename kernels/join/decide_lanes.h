// SPDX-License-Identifier: Apache-2.0
// The zero test of det modulo primes, and the ladder for the joins of one vector. Included by the file of each
// instruction set, with lanes L and residues M of an anonymous namespace; see decide_forms.h for why.
//
// M, residues modulo one prime 2^kBits − small < 2^kBits, with R = 2^(kBits + 4) at least, in Montgomery's form without
// a final subtraction: a number of M is any whole number below 16 p. close(sum) = (sum + m p) / R < sum / R + p.
//
// RANGES in units of p; kBits = 28, R = 2^32 is the narrower case: products of numbers below 16 p, sums below 240 p²
// (240 p² + 16 p · p ≤ 2^64), close(v p²) < (v / 16 + 1) p.
//   remainder r of a whole double: |r| < 0.51 p. number(r, m) = m r + 2 p:   m = ±1: 2.51   m = ±2: 3.02   m = ±3: 3.53
//   joined(high, low, m) = close(number(high, m) · (2^split mod p) + number(low, m)): 3.53 p · p + 4 p       → 1.3
//   polynomial  a × b: 8 products of 3.53 · 3.53 = 99.7         → 7.24;   det: 9 products of 7.24 · 3.02 = 196.8 → 13.3
//   rational    w x: 2.51 · 3.53 = 8.9 → 1.56; alone, times 1: 1.01.   minus: 2 p − x, below 2; twice 4; thrice 6.
//               E ∧ E_t: (1.56 + 2) 1.56 + (4.68 + 6) 1.56 = 22.3 → 2.4;   A ∧ B: 4 (1.56 + 2) 1.56 = 22.3 → 2.4
//               det: 30 products of 2.4 · 2.4 = 172.8           → 11.8
// x is a multiple of p if and only if x p⁻¹ mod R ≤ ⌊(R − 1) / p⌋, for x < R: x → x p⁻¹ is one to one modulo R.
//
// HOW MANY PRIMES  A join the filter did not refute has |det coefficient| ≤ 2 · its error bound, by the bound's
// meaning: far less than any bound from the size of the numbers. If the whole numbers of a, b, c are multiples of 2^i,
// 2^j, 2^k, det is a multiple of 2^(i+j+k). Let all |coefficients| / 2^(i+j+k) < 2^E. A product of n primes is above
// 2^(n kBits − 1); when that is at least 2^E, zero modulo all of them is zero. At most, with the terms of the permanents
// and the largest C:
//   polynomial  2 · 23 u · 70 · 6 · 2^(3 · 53) < 2^121, long ones < 2^(121 + 3 · 50)
//   rational    2 · 50 u · 152 · 24 · 2^(3 · 106 + 53) < 2^337, long ones < 2^(337 + 7 · 8);
//               homogeneous 2 · 50 u · 152 · 24 · 2^(4 · 53) < 2^178, long ones < 2^(178 + 4 · 50)
// 10 primes of 47 bits and 16 of 28 bits reach 2^447.
#pragma once

#include "kernels/join/decide_table.h"
#include "kernels/join/whole_numbers.h"

namespace patchproof::kernels::lanes {

constexpr double kStage = 3.53, kCross = 8 * kStage * kStage / 16 + 1, kWeighted = 2.51 * kStage / 16 + 1;
constexpr double kWedge = ((kWeighted + 2) + 3 * (kWeighted + 2)) * kWeighted, kPlucker = kWedge / 16 + 1;
static_assert(8 * kStage * kStage < 240 && 9 * kCross * 3.02 < 240 && 9 * kCross * 3.02 / 16 + 1 < 16);
static_assert(kWeighted < 2 && 4 * (kWeighted + 2) * kWeighted <= kWedge && kWedge < 240);
static_assert(kStage + 1e-6 < 16 && (kStage + 1e-6) / 16 + 1 < kWeighted, "joined numbers are smaller than others");
static_assert(30 * kPlucker * kPlucker < 240 && 30 * kPlucker * kPlucker / 16 + 1 < 16);

template <class L>
int largest_exponent(typename L::D x) {  // the least e with x < 2^e for all lanes, e ≥ −1021
  double all[L::kCount], largest = 0;
  L::store(all, x);
  for (int i = 0; i < L::kCount; ++i) largest = all[i] > largest ? all[i] : largest;
  unsigned long long bits;
  __builtin_memcpy(&bits, &largest, sizeof bits);
  return static_cast<int>(bits >> 52) - 1022;
}

template <class M>
int primes_for(int exponent) {
  return exponent <= 0 ? 0 : (exponent + 1 + M::kBits - 1) / M::kBits;
}

// ---- polynomial ----------------------------------------------------------------------------------------------------

// The same numbers in one row.
template <class D, int P>
D (&flat(D (&x)[P][3]))
[3 * P] {
  return reinterpret_cast<D(&)[3 * P]>(x);
}

// Sufficient for decide_fixed_g1 to take the join, so that every instruction set answers alike. Coordinates are at most
// t (1 + 4 u), t = max |E| + max |a| + max |b|, so below 2^h for an h with 2^(h-2) < t; entries are 0 or above 2^-69 t,
// so above 2^(h-71), and multiples of 2^(h-71-52). Those are its 123 bits. REQUIRES they are in range.
template <class L>
unsigned fits_fixed(const typename L::D (&x)[36], const Differences<L>& d) {
  using D = typename L::D;
  const D a = L::multiply(L::max(L::max(d.a_max[0], d.a_max[1]), d.a_max[2]), d.scale_a.down);
  const D b = L::multiply(L::max(L::max(d.b_max[0], d.b_max[1]), d.b_max[2]), d.scale_b.down);
  D edge = L::constant(0), least = L::constant(__builtin_inf());
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) edge = L::max(edge, L::abs(x[i]));
#pragma GCC unroll 36
  for (int i = 0; i < 36; ++i) least = L::least_size(least, x[i]);
  return L::greater(least, L::multiply(L::add(edge, L::add(a, b)), L::constant(0x1p-69)));
}

// The differences as whole numbers.
template <class L>
struct WholeDifferences {
  Whole<L, 12> a, b;
  Whole<L, 9> c;
  typename L::D error_a[12], error_b[12];  // of the rounded differences, when long
  bool is_long = false;
};

template <class L>
unsigned take_short(const typename L::D (&x)[36], const Differences<L>& d, unsigned wanted, WholeDifferences<L>& w) {
  typename L::I seen = see_long<L>(L::no_bits(), flat(d.a), flat(d.scaled_a), d.scale_a);
  seen = see_long<L>(seen, flat(d.b), flat(d.scaled_b), d.scale_b);
  seen = see_long<L>(seen, flat(d.c), flat(d.scaled_c), d.scale_c);
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) {
    seen = see_rounding<L>(seen, flat(d.a)[i], x[12 + i], x[i]);
    seen = see_rounding<L>(seen, flat(d.b)[i], x[24 + i], x[i]);
    if (i < 9) seen = see_rounding<L>(seen, flat(d.c)[i], x[i + 3], x[i]);
  }
  const unsigned lanes = wanted & L::without(seen);
  take_short(flat(d.scaled_a), w.a);
  take_short(flat(d.scaled_b), w.b);
  take_short(flat(d.scaled_c), w.c);
  return lanes;
}

template <class L>
unsigned take_long(const typename L::D (&x)[36], const Differences<L>& d, unsigned wanted, WholeDifferences<L>& w) {
  typename L::D error_c[9];
  for (int i = 0; i < 12; ++i) {
    w.error_a[i] = difference_error<L>(flat(d.a)[i], x[12 + i], x[i]);
    w.error_b[i] = difference_error<L>(flat(d.b)[i], x[24 + i], x[i]);
    if (i < 9) error_c[i] = difference_error<L>(flat(d.c)[i], x[i + 3], x[i]);
  }
  w.is_long = true;
  return wanted & split_long(flat(d.a), flat(d.scaled_a), d.scale_a, kSplit, w.a) &
         split_long(flat(d.b), flat(d.scaled_b), d.scale_b, kSplit, w.b) &
         split_long(flat(d.c), flat(d.scaled_c), d.scale_c, kSplit, w.c) &
         add_errors(w.error_a, d.scale_a, kSplit, w.a) & add_errors(w.error_b, d.scale_b, kSplit, w.b) &
         add_errors(error_c, d.scale_c, kSplit, w.c);
}

template <bool Long, class L, class M>
unsigned nonzero_polynomial(const M& m, const WholeDifferences<L>& w) {
  using I = typename M::Number;
  I a[4][3], minus_a[4][3], b[4][3], c[3][3], normal[7][3];
#pragma GCC unroll 12
  for (int e = 0; e < 12; ++e) {
    const int i = e / 3, k = e % 3;
    if constexpr (Long) {
      a[i][k] = m.joined(m.remainder(w.a.high[e]), m.remainder(w.a.low[e]), kBinomial[i]);
      minus_a[i][k] = m.minus(a[i][k]);
      b[i][k] = m.joined(m.remainder(w.b.high[e]), m.remainder(w.b.low[e]), kBinomial[i]);
      if (i < 3) c[i][k] = m.joined(m.remainder(w.c.high[e]), m.remainder(w.c.low[e]), i == 1 ? 2 : 1);
    } else {
      const typename L::D of_a = m.remainder(w.a.high[e]);
      a[i][k] = m.number(of_a, kBinomial[i]);
      minus_a[i][k] = m.number(of_a, -kBinomial[i]);
      b[i][k] = m.number(m.remainder(w.b.high[e]), kBinomial[i]);
      if (i < 3) c[i][k] = m.number(m.remainder(w.c.high[e]), i == 1 ? 2 : 1);
    }
  }
  cross_forms(m, a, minus_a, b, normal);
  unsigned nonzero = 0;
#pragma GCC unroll 9
  for (int s = 0; s < 9; ++s) nonzero |= m.nonzero(dot_coefficient(m, normal, c, s));
  return nonzero;
}

template <class L>
unsigned c1_polynomial(const Differences<L>& d, const WholeDifferences<L>& w) {
  unsigned c1 = L::kAll;
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) c1 &= L::equal(flat(d.a)[i], Doubles<L>::minus(flat(d.b)[i]));
  if (w.is_long)
    for (int i = 0; i < 12; ++i) c1 &= L::equal(w.error_a[i], Doubles<L>::minus(w.error_b[i]));
  return c1;
}

template <class L, class M>
LaneAnswers decide_polynomial(const double* const* points, Depth depth) {
  using D = typename L::D;
  D x[36];
  L::template load<36>(points, x);
  Differences<L> d;
  take_differences<L>(x, d);
  WeightedForms<L> forms;
  apply_binomials<L>(d, forms);
  Filtered<L> filtered;
  filter_polynomial<L>(d, forms, filtered);
  LaneAnswers answers;
  answers.filter = filtered.nonzero;
  unsigned left = d.in_range & ~filtered.nonzero;
  if (depth == Depth::filter || left == 0) return answers;
  left &= fits_fixed<L>(x, d);
  WholeDifferences<L> w;
  unsigned exact = take_short<L>(x, d, left, w);
  if (exact != left) exact = take_long<L>(x, d, left, w);
  if (exact == 0) return answers;

  const int split = w.is_long ? kSplit : 0;
  const int zeros = common_zeros(w.a, w.is_long, split) + common_zeros(w.b, w.is_long, split) +
                    common_zeros(w.c, w.is_long, split) - 3 * split;
  const D bound = L::multiply(exact == L::kAll ? filtered.error : L::keep(filtered.error, exact), L::constant(2 * 70));
  const int primes = primes_for<M>(largest_exponent<L>(bound) - zeros);
  if (primes > M::kPrimes) return answers;
  unsigned nonzero = 0;
  for (int q = 0; q < primes && nonzero != exact; ++q) {
    const M m(q, split);
    nonzero |= exact & (w.is_long ? nonzero_polynomial<true>(m, w) : nonzero_polynomial<false>(m, w));
  }
  answers.modular = nonzero;
  answers.coplanar = exact & ~nonzero;
  if (depth == Depth::zero_test || answers.coplanar == 0) return answers;

  answers.opposed = answers.coplanar & opposed_polynomial<L>(d, forms);
  answers.c1 = answers.coplanar & c1_polynomial<L>(d, w);
  answers.not_c1 = answers.coplanar & ~answers.c1;
  return answers;
}

// ---- rational ------------------------------------------------------------------------------------------------------

template <class L>
struct WholeRows {
  Whole<L, 36> points;
  Whole<L, 12> weights;
  bool is_long = false;
  int split = 0;
};

template <class L>
unsigned take_whole(const typename L::D (&x)[36], const typename L::D (&w)[12], const ScaledRows<L>& rows,
                    bool cartesian, unsigned wanted, WholeRows<L>& out) {
  const typename L::I seen = see_long<L>(L::no_bits(), x, rows.points, rows.scale_points);
  const unsigned lanes = wanted & L::without(see_long<L>(seen, w, rows.weights, rows.scale_weights));
  if (lanes == wanted) {
    take_short(rows.points, out.points);
    take_short(rows.weights, out.weights);
    return lanes;
  }
  out.is_long = true;
  out.split = cartesian ? kSplitOfProducts : kSplit;
  return wanted & split_long(x, rows.points, rows.scale_points, out.split, out.points) &
         split_long(w, rows.weights, rows.scale_weights, out.split, out.weights);
}

template <bool Long, class L, class M>
unsigned nonzero_rational(const M& m, const WholeRows<L>& rows, bool cartesian) {
  using I = typename M::Number;
  I h[3][4][4], line[5][6], rungs[7][6];
  const auto number = [&](const auto& whole, int i, double factor) {
    if constexpr (Long)
      return m.joined(m.remainder(whole.high[i]), m.remainder(whole.low[i]), factor);
    else
      return m.number(m.remainder(whole.high[i]), factor);
  };
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r)
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      const double binomial = r == 0 ? 1 : kBinomial[i];
      const I w = number(rows.weights, 4 * r + i, binomial);
      h[r][i][3] = m.close(m.add_product(m.zero(), w, m.one()));
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k) {
        const int e = 12 * r + 3 * i + k;
        h[r][i][k] = m.close(cartesian ? m.add_product(m.zero(), number(rows.points, e, 1), w)
                                       : m.add_product(m.zero(), number(rows.points, e, binomial), m.one()));
      }
    }
  edge_line(m, h[0], line);
  rung_lines(m, h[1], h[2], rungs);
  unsigned nonzero = 0;
#pragma GCC unroll 11
  for (int s = 0; s < 11; ++s) nonzero |= m.nonzero(dot_coefficient(m, line, rungs, s));
  return nonzero;
}

template <class L, class M>
LaneAnswers decide_rational(const double* const* points, const double* const* weights, bool cartesian, Depth depth) {
  using D = typename L::D;
  D x[36], w[12], line[5][6];
  L::template load<36>(points, x);
  L::template load<12>(weights, w);
  ScaledRows<L> rows;
  take_scaled<L>(x, w, rows);
  HomogeneousRows<L> h;
  take_homogeneous<L>(rows, cartesian, h);
  edge_line(Doubles<L>(), h.edge, line);
  Filtered<L> filtered;
  filter_rational<L>(h, rows.in_range, line, filtered);
  LaneAnswers answers;
  answers.filter = filtered.nonzero;
  const unsigned left = rows.in_range & ~filtered.nonzero;
  if (depth == Depth::filter || left == 0) return answers;
  WholeRows<L> whole;
  const unsigned exact = take_whole<L>(x, w, rows, cartesian, left, whole);
  if (exact == 0) return answers;

  // det takes three coordinates, and the weights once, or four times if they multiply the points.
  const int times = cartesian ? 4 : 1;
  const int zeros = 3 * common_zeros(whole.points, whole.is_long, whole.split) +
                    times * common_zeros(whole.weights, whole.is_long, whole.split) - (3 + times) * whole.split;
  const D bound = L::multiply(exact == L::kAll ? filtered.error : L::keep(filtered.error, exact), L::constant(2 * 152));
  const int primes = primes_for<M>(largest_exponent<L>(bound) - zeros);
  if (primes > M::kPrimes) return answers;
  unsigned nonzero = 0;
  for (int q = 0; q < primes && nonzero != exact; ++q) {
    const M m(q, whole.split);
    nonzero |= exact & (whole.is_long ? nonzero_rational<true>(m, whole, cartesian)
                                      : nonzero_rational<false>(m, whole, cartesian));
  }
  answers.modular = nonzero;
  answers.coplanar = exact & ~nonzero;
  if (depth == Depth::zero_test || answers.coplanar == 0) return answers;

  answers.opposed = answers.coplanar & opposed_rational<L>(h, line);
  answers.c1 = answers.coplanar & reflected<L>(rows, cartesian);
  if (answers.c1 != answers.coplanar) answers.not_c1 = answers.coplanar & ~answers.c1 & certainly_not_c1<L>(h);
  return answers;
}

}  // namespace patchproof::kernels::lanes
