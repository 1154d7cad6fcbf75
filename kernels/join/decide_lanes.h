// SPDX-License-Identifier: Apache-2.0
// The zero test of det modulo primes, and the ladder for the joins of one vector. Included by the file of each instruction
// set, with lanes L and residues M of an anonymous namespace; see decide_forms.h for why.
//
// M, residues modulo one prime 2^kBits − small < 2^kBits, with R = 2^(kBits + 4) at least, in Montgomery's form without a
// final subtraction: a number of M is any whole number below 16 p. close(sum) = (sum + m p) / R < sum / R + p.
//
// RANGES in units of p; kBits = 28, R = 2^32 is the narrower case: products of numbers below 16 p, sums below 240 p²
// (240 p² + 16 p · p ≤ 2^64), close(v p²) < (v / 16 + 1) p.
//   remainder r of a whole double: |r| < 0.51 p. number(r, m) = m r + 2 p:   m = ±1: 2.51   m = ±2: 3.02   m = ±3: 3.53
//   polynomial  a × b: 8 products of 3.53 · 3.53 = 99.7         → 7.24;   det: 9 products of 7.24 · 3.02 = 196.8 → 13.3
//   rational    w x: 2.51 · 3.53 = 8.9 → 1.56; alone, times 1: 1.01.   minus: 2 p − x, below 2; twice 4; thrice 6.
//               E ∧ E_t: (1.56 + 2) 1.56 + (4.68 + 6) 1.56 = 22.3 → 2.4;   A ∧ B: 4 (1.56 + 2) 1.56 = 22.3 → 2.4
//               det: 30 products of 2.4 · 2.4 = 172.8           → 11.8
// x is a multiple of p if and only if x p⁻¹ mod R ≤ ⌊(R − 1) / p⌋, for x < R: x → x p⁻¹ is one to one modulo R.
//
// HOW MANY PRIMES  A join the filter did not refute has |det coefficient| ≤ 2 · its error bound, by the bound's meaning: far
// less than any bound from the size of the numbers. If the whole numbers of a, b, c are multiples of 2^i, 2^j, 2^k, det is
// a multiple of 2^(i+j+k). Let all |coefficients| / 2^(i+j+k) < 2^E. A product of n primes is above 2^(n kBits − 1); when
// that is at least 2^E, zero modulo all of them is zero. At most, by 53-bit numbers:
//   polynomial  2 · 23 u · 70 · 6 · 2^159 < 2^121;   rational  2 · 50 u · 152 · 12 · 2^(4 · 106) < 2^388.
#pragma once

#include "join/decide_rational_forms.h"
#include "kernels/join/decide_table.h"

namespace patchproof::kernels::lanes {

using namespace patchproof::decide;

constexpr double kStage = 3.53, kCross = 8 * kStage * kStage / 16 + 1, kWeighted = 2.51 * kStage / 16 + 1;
constexpr double kWedge = ((kWeighted + 2) + 3 * (kWeighted + 2)) * kWeighted, kPlucker = kWedge / 16 + 1;
static_assert(8 * kStage * kStage < 240 && 9 * kCross * 3.02 < 240 && 9 * kCross * 3.02 / 16 + 1 < 16);
static_assert(kWeighted < 2 && 4 * (kWeighted + 2) * kWeighted <= kWedge && kWedge < 240);
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

// Lanes where every entry is (a whole number) / scale. Collects the numbers' bits. REQUIRES they are in range.
template <class L, int Size>
unsigned are_whole(const typename L::D (&raw)[Size], const typename L::D (&scaled)[Size], typename L::D inverse) {
  unsigned whole = L::kAll;
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i)  // a scaled entry that underflowed differs, scaled back
    whole &= L::equal(L::multiply(L::round(scaled[i]), inverse), raw[i]);
  return whole;
}
// How often 2 divides all numbers of all lanes, at most.
template <class L, int Size>
int common_zeros(const typename L::D (&whole)[Size]) {
  typename L::I bits = L::no_bits();
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i) bits = L::collect_bits(bits, whole[i]);
  return L::trailing_zeros(bits);
}
template <class L, int Size>
void keep(typename L::D (&x)[Size], unsigned lanes) {
  for (int i = 0; i < Size; ++i) x[i] = L::keep(x[i], lanes);
}

// a − e = d exactly? See is_middle.
template <class L>
unsigned is_difference(typename L::D d, typename L::D a, typename L::D e) {
  return L::equal(L::add(d, e), a) & L::equal(L::subtract(a, d), e);
}

// ---- polynomial ----------------------------------------------------------------------------------------------------

// Sufficient for decide_fixed_g1 to take the join, so that every instruction set answers alike: all coordinates are below
// t = max |E| + max |a| + max |b|; entries of E are 0 or at least 2^-66 t, so whole multiples of 2^(-66-53) t; so are a and b
// as multiples of 2^-53 of their largest, if that is at least 2^-66 t. That is 121 bits, of 123. REQUIRES they are in range.
template <class L>
unsigned fits_fixed(const typename L::D (&x)[36], const Differences<L>& d) {
  using D = typename L::D;
  const D a = L::multiply(L::max(L::max(d.a_max[0], d.a_max[1]), d.a_max[2]), d.inverse_a);
  const D b = L::multiply(L::max(L::max(d.b_max[0], d.b_max[1]), d.b_max[2]), d.inverse_b);
  D e = L::constant(0);
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) e = L::max(e, L::abs(x[i]));
  const D least = L::multiply(L::add(e, L::add(a, b)), L::constant(0x1p-66));
  unsigned fits = L::greater(a, least) & L::greater(b, least);
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) fits &= L::greater(L::abs(x[i]), least) | L::equal(x[i], L::constant(0));
  return fits;
}

template <class L>
unsigned exact_polynomial(const typename L::D (&x)[36], const Differences<L>& d) {
  using D = typename L::D;
  unsigned exact = L::kAll;
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const int e = 3 * i + k;
      exact &= is_difference<L>(d.a[i][k], x[12 + e], x[e]) & is_difference<L>(d.b[i][k], x[24 + e], x[e]);
      if (i < 3) exact &= is_difference<L>(d.c[i][k], x[e + 3], x[e]);
    }
  using Four = const D(&)[12];
  using Three = const D(&)[9];
  return exact & are_whole<L>(reinterpret_cast<Four>(d.a), reinterpret_cast<Four>(d.scaled_a), d.inverse_a) &
         are_whole<L>(reinterpret_cast<Four>(d.b), reinterpret_cast<Four>(d.scaled_b), d.inverse_b) &
         are_whole<L>(reinterpret_cast<Three>(d.c), reinterpret_cast<Three>(d.scaled_c), d.inverse_c);
}

template <class L, class M>
unsigned nonzero_polynomial(const M& m, const Differences<L>& d) {
  using I = typename M::Number;
  I a[4][3], minus_a[4][3], b[4][3], c[3][3], normal[7][3];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const typename L::D of_a = m.remainder(d.scaled_a[i][k]);
      a[i][k] = m.number(of_a, kBinomial[i]);
      minus_a[i][k] = m.number(of_a, -kBinomial[i]);
      b[i][k] = m.number(m.remainder(d.scaled_b[i][k]), kBinomial[i]);
      if (i < 3) c[i][k] = m.number(m.remainder(d.scaled_c[i][k]), i == 1 ? 2 : 1);
    }
  cross_forms(m, a, minus_a, b, normal);
  unsigned nonzero = 0;
#pragma GCC unroll 9
  for (int s = 0; s < 9; ++s) nonzero |= m.nonzero(dot_coefficient(m, normal, c, s));
  return nonzero;
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
  const unsigned left = d.in_range & ~filtered.nonzero;
  if (depth == Depth::filter || left == 0) return answers;
  const unsigned exact = left & fits_fixed<L>(x, d) & exact_polynomial<L>(x, d);
  if (exact == 0) return answers;

  using Four = D(&)[12];
  using Three = D(&)[9];
  Four a = reinterpret_cast<Four>(d.scaled_a), b = reinterpret_cast<Four>(d.scaled_b);
  Three c = reinterpret_cast<Three>(d.scaled_c);
  if (exact != L::kAll) {  // other lanes may hold anything
    keep<L>(a, exact), keep<L>(b, exact), keep<L>(c, exact);
    filtered.error = L::keep(filtered.error, exact);
  }
  const int zeros = common_zeros<L>(a) + common_zeros<L>(b) + common_zeros<L>(c);
  const int primes = primes_for<M>(largest_exponent<L>(L::multiply(filtered.error, L::constant(2 * 70))) - zeros);
  unsigned nonzero = 0;
  for (int q = 0; q < primes && nonzero != exact; ++q) nonzero |= exact & nonzero_polynomial<L>(M(q), d);
  answers.modular = nonzero;
  answers.coplanar = exact & ~nonzero;
  if (depth == Depth::zero_test || answers.coplanar == 0) return answers;

  answers.opposed = answers.coplanar & opposed_polynomial<L>(d, forms);
  unsigned c1 = answers.coplanar;
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) c1 &= L::equal(d.a[i][k], Doubles<L>::minus(d.b[i][k]));  // the differences are exact
  answers.c1 = c1;
  answers.not_c1 = answers.coplanar & ~c1;
  return answers;
}

// ---- rational ------------------------------------------------------------------------------------------------------

template <class L, class M>
unsigned nonzero_rational(const M& m, const ScaledRows<L>& rows, bool cartesian) {
  using I = typename M::Number;
  I h[3][4][4], line[5][6], rungs[7][6];
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r)
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      const double binomial = r == 0 ? 1 : kBinomial[i];
      const I w = m.number(m.remainder(rows.weights[4 * r + i]), binomial);
      h[r][i][3] = m.close(m.add_product(m.zero(), w, m.one()));
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k) {
        const typename L::D x = m.remainder(rows.points[12 * r + 3 * i + k]);
        h[r][i][k] = cartesian ? m.close(m.add_product(m.zero(), m.number(x, 1), w))
                               : m.close(m.add_product(m.zero(), m.number(x, binomial), m.one()));
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
  const unsigned exact =
      left & are_whole<L>(x, rows.points, rows.inverse_points) & are_whole<L>(w, rows.weights, rows.inverse_weights);
  if (exact == 0) return answers;

  if (exact != L::kAll) {
    keep<L>(rows.points, exact), keep<L>(rows.weights, exact);
    filtered.error = L::keep(filtered.error, exact);
  }
  const int zeros = 3 * common_zeros<L>(rows.points) + (cartesian ? 4 : 1) * common_zeros<L>(rows.weights);
  const int primes = primes_for<M>(largest_exponent<L>(L::multiply(filtered.error, L::constant(2 * 152))) - zeros);
  unsigned nonzero = 0;
  for (int q = 0; q < primes && nonzero != exact; ++q) nonzero |= exact & nonzero_rational<L>(M(q), rows, cartesian);
  answers.modular = nonzero;
  answers.coplanar = exact & ~nonzero;
  if (depth == Depth::zero_test || answers.coplanar == 0) return answers;

  answers.opposed = answers.coplanar & opposed_rational<L>(h, line);
  answers.c1 = answers.coplanar & reflected<L>(rows, cartesian);
  if (answers.c1 != answers.coplanar) answers.not_c1 = answers.coplanar & ~answers.c1 & certainly_not_c1<L>(h);
  return answers;
}

}  // namespace patchproof::kernels::lanes
