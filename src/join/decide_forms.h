// SPDX-License-Identifier: Apache-2.0
// The forms of fixed_g1.h over several joins at once: one body for doubles of any width and for residues modulo primes.
//
// L, the lanes:  D (L::kCount doubles, one join each), constant, add, subtract, multiply, fma (x y + z), fnma (z − x
//                y), abs, max, round; masks of lanes as bits: equal, greater, kAll; power_of_two_above.
// N, a number:   Number, Sum, zero, add_product(sum, x, y), close(sum), minus, twice, thrice.
//
// Templates only, on types of anonymous namespaces: every instruction set's file keeps its own copy, and none is shared
// by the linker. For the same reason nothing of namespace std is used here.
//
// ERROR OF THE FILTER  u = 2^-53, doubles rounded to nearest. Every computed coefficient is the exact sum with each
//   product of the expansion times at most r factors (1 + δ), |δ| ≤ u, if no operation underflows; so
//       |computed − exact| ≤ ((1 + u)^r − 1) · (sum of the sizes of the products) ≤ C · P · r u (1 + r u),
//   C a sum of binomials, P the permanent of the largest sizes of each coordinate. P is taken from the computed
//   coordinates, each of at least (1 − u)^2 times the exact one, and in at most ten more roundings. So (r + 1) u C P is
//   a bound while r < 100. Counting r:
//     polynomial  a = 3 fl(A − E), b: 2 each.  c = 2 fl(E_i+1 − E_i): 1.
//                 a × b: a chain of 8 products.  c · (a × b): a chain of 9.        det      r = 2 + 2 + 1 + 8 + 9 = 22
//                 n_A = c × a: 1 + 2, a chain of 6; n_B too.  A chain of 18.      n_A·n_B  r = 2 · 9 + 18 = 36
//     rational    E, A, B: 1 for weight times point, 1 for the binomial (not of E).
//                 E ∧ E_t: 1 + 1, 1 for the factor 3, a chain of 4: 7.  A ∧ B: 2 + 2, a chain of 8: 12.
//                 det: a chain of 30                                               det      r = 7 + 12 + 30 = 49
//                 n_A: 7 + 2, a chain of 12: 21; n_B too.  A chain of 24.         n_A·n_B  r = 2 · 21 + 24 = 66
//                 E_w S − S_w E, S = A + B: E 2, S 3, a chain of 8.                C1       r = 13
//   Underflow: an operation that underflows adds at most 2^-1075. Coordinates are scaled below 2^53, so that products
//   of weight and point are below 2^106 and of all other factors below 2^440; fewer than 2^12 operations each add below
//   2^-1075 · 2^440, and so does a coordinate that underflows by scaling. kUnderflow = 2^-600 is far above; of whole
//   numbers not even the smallest is missed by it. Where max |x| is not in kRange the filter says nothing.
#pragma once

namespace patchproof::decide {

constexpr double kUlp = 0x1p-53;
constexpr double kUnderflow = 0x1p-600;
constexpr double kLargestInRange = 0x1p900, kSmallestInRange = 0x1p-900;
constexpr int kWholeBits = 53;  // coordinates are scaled into [2^52, 2^53)

constexpr double kDeterminantError = 23 * kUlp, kSidesError = 37 * kUlp;
constexpr double kRationalDeterminantError = 50 * kUlp, kRationalSidesError = 67 * kUlp, kRationalC1Error = 14 * kUlp;

// Σ_{i+j+…=s} of the products of binomials: C(6, s), C(8, s), C(10, s).
constexpr double kSix[7] = {1, 6, 15, 20, 15, 6, 1};
constexpr double kEight[9] = {1, 8, 28, 56, 70, 56, 28, 8, 1};
constexpr double kTen[11] = {1, 10, 45, 120, 210, 252, 210, 120, 45, 10, 1};
// (1, 2, 4, 2, 1) of E ∧ E_t times C(6, ·); the same times (1, 2, 4, 2, 1) again.
constexpr double kMeeting[11] = {1, 8, 31, 76, 128, 152, 128, 76, 31, 8, 1};
constexpr double kNormals[15] = {1, 10, 51, 172, 421, 782, 1127, 1272, 1127, 782, 421, 172, 51, 10, 1};
constexpr double kBinomial[4] = {1, 3, 3, 1};

// Doubles as numbers of the forms below.
template <class L>
struct Doubles {
  using Number = typename L::D;
  using Sum = typename L::D;
  static Sum zero() { return L::constant(0); }
  static Sum add_product(Sum sum, Number x, Number y) { return L::fma(x, y, sum); }
  static Number close(Sum sum) { return sum; }
  static Number minus(Number x) { return L::subtract(L::constant(-0.0), x); }
  static Number twice(Number x) { return L::add(x, x); }
  static Number thrice(Number x) { return L::multiply(x, L::constant(3)); }
};

// out = x × y, forms of degrees P − 1 and Q − 1 in scaled Bernstein form.
template <class N, class V, int P, int Q>
void cross_forms(const N& n, const V (&x)[P][3], const V (&minus_x)[P][3], const V (&y)[Q][3], V (&out)[P + Q - 1][3]) {
#pragma GCC unroll 16
  for (int s = 0; s < P + Q - 1; ++s)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      typename N::Sum sum = n.zero();
#pragma GCC unroll 4
      for (int i = 0; i < P; ++i) {
        if (s - i < 0 || s - i >= Q) continue;
        sum = n.add_product(sum, x[i][k1], y[s - i][k2]);
        sum = n.add_product(sum, minus_x[i][k2], y[s - i][k1]);
      }
      out[s][k] = n.close(sum);
    }
}

// Coefficient s of Σ_k x_k y_k.
template <class N, class V, int P, int Q, int K>
V dot_coefficient(const N& n, const V (&x)[P][K], const V (&y)[Q][K], int s) {
  typename N::Sum sum = n.zero();
#pragma GCC unroll 8
  for (int i = 0; i < P; ++i) {
    if (s - i < 0 || s - i >= Q) continue;
#pragma GCC unroll 6
    for (int k = 0; k < K; ++k) sum = n.add_product(sum, x[i][k], y[s - i][k]);
  }
  return n.close(sum);
}

// Plücker coordinates of x ∧ y: x_w y − y_w x, then x × y. Coordinate k pairs with k + 3 in the meeting condition.
constexpr int kLine[6][2] = {{3, 0}, {3, 1}, {3, 2}, {1, 2}, {2, 0}, {0, 1}};

// out = E ∧ E_t up to a factor: E0∧E1, 2 E0∧E2, E0∧E3 + 3 E1∧E2, 2 E1∧E3, E2∧E3.
template <class N, class V>
void edge_line(const N& n, const V (&e)[4][4], V (&out)[5][6]) {
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const int x = kLine[k][0], y = kLine[k][1];
    const auto wedge = [&](typename N::Sum sum, V px, V py, int q) {
      return n.add_product(n.add_product(sum, px, e[q][y]), n.minus(py), e[q][x]);
    };
    const auto twice = [&](int p, int q) {
      return n.close(
          n.add_product(n.add_product(n.zero(), n.twice(e[p][x]), e[q][y]), n.twice(n.minus(e[p][y])), e[q][x]));
    };
    const auto thrice = [&](typename N::Sum sum, int p, int q) {
      return n.add_product(n.add_product(sum, n.thrice(e[p][x]), e[q][y]), n.thrice(n.minus(e[p][y])), e[q][x]);
    };
    out[0][k] = n.close(wedge(n.zero(), e[0][x], e[0][y], 1));
    out[1][k] = twice(0, 2);
    out[2][k] = n.close(thrice(wedge(n.zero(), e[0][x], e[0][y], 3), 1, 2));
    out[3][k] = twice(1, 3);
    out[4][k] = n.close(wedge(n.zero(), e[2][x], e[2][y], 3));
  }
}

// out = A ∧ B, moment first, so that the meeting condition is one scalar product.
template <class N, class V>
void rung_lines(const N& n, const V (&a)[4][4], const V (&b)[4][4], V (&out)[7][6]) {
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const int x = kLine[k][0], y = kLine[k][1];
    V minus_a[4];
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) minus_a[i] = n.minus(a[i][y]);
#pragma GCC unroll 7
    for (int s = 0; s < 7; ++s) {
      typename N::Sum sum = n.zero();
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) {
        if (s - i < 0 || s - i > 3) continue;
        sum = n.add_product(sum, a[i][x], b[s - i][y]);
        sum = n.add_product(sum, minus_a[i], b[s - i][x]);
      }
      out[s][(k + 3) % 6] = n.close(sum);
    }
  }
}

// ---- polynomial joins ----------------------------------------------------------------------------------------------

template <class L>
struct Scale {
  typename L::D up, down;  // powers of two, up · down = 1
};

// The differences, each kind scaled by its own power of two (det is linear in each), and their largest sizes.
template <class L>
struct Differences {
  using D = typename L::D;
  D a[4][3], b[4][3], c[3][3];  // as rounded
  D scaled_a[4][3], scaled_b[4][3], scaled_c[3][3];
  D a_max[3], b_max[3], c_max[3];  // of the scaled ones
  Scale<L> scale_a, scale_b, scale_c;
  unsigned in_range;  // lanes where all is finite and every kind's largest number is in range
};

template <class L, int P>
unsigned scale_forms(const typename L::D (&raw)[P][3], typename L::D (&scaled)[P][3], typename L::D (&largest)[3],
                     Scale<L>& scale) {
  using D = typename L::D;
  D total = L::constant(0);  // infinite or not a number when an entry is
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    largest[k] = L::constant(0);
#pragma GCC unroll 4
    for (int i = 0; i < P; ++i) {
      largest[k] = L::max(largest[k], L::abs(raw[i][k]));
      total = L::add(total, L::abs(raw[i][k]));
    }
  }
  const D top = L::max(L::max(largest[0], largest[1]), largest[2]);
  L::scale_to_whole(top, scale.up, scale.down);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    largest[k] = L::multiply(largest[k], scale.up);
#pragma GCC unroll 4
    for (int i = 0; i < P; ++i) scaled[i][k] = L::multiply(raw[i][k], scale.up);
  }
  return L::greater(L::constant(kLargestInRange), total) & L::greater(top, L::constant(kSmallestInRange));
}

// x: edge, behind_a, behind_b, as in BicubicJoinRows.
template <class L>
void take_differences(const typename L::D (&x)[36], Differences<L>& d) {
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const int e = 3 * i + k;
      d.a[i][k] = L::subtract(x[12 + e], x[e]);
      d.b[i][k] = L::subtract(x[24 + e], x[e]);
      if (i < 3) d.c[i][k] = L::subtract(x[e + 3], x[e]);
    }
  d.in_range = scale_forms<L>(d.a, d.scaled_a, d.a_max, d.scale_a) &
               scale_forms<L>(d.b, d.scaled_b, d.b_max, d.scale_b) &
               scale_forms<L>(d.c, d.scaled_c, d.c_max, d.scale_c);
}

template <class L>
struct WeightedForms {  // times binomials
  typename L::D a[4][3], minus_a[4][3], b[4][3], c[3][3], minus_c[3][3];
};
template <class L>
void apply_binomials(const Differences<L>& d, WeightedForms<L>& f) {
  using R = Doubles<L>;
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const bool inner = i == 1 || i == 2;
      f.a[i][k] = inner ? R::thrice(d.scaled_a[i][k]) : d.scaled_a[i][k];
      f.minus_a[i][k] = R::minus(f.a[i][k]);
      f.b[i][k] = inner ? R::thrice(d.scaled_b[i][k]) : d.scaled_b[i][k];
      if (i == 3) continue;
      f.c[i][k] = i == 1 ? R::twice(d.scaled_c[i][k]) : d.scaled_c[i][k];
      f.minus_c[i][k] = R::minus(f.c[i][k]);
    }
}

// Coefficient s of det, and the bound of its error is kEight[s] times `error`.
template <class L>
struct Filtered {
  typename L::D value[11], error;
  unsigned nonzero;  // lanes where some coefficient is certainly not zero
};

template <class L>
void filter_polynomial(const Differences<L>& d, const WeightedForms<L>& f, Filtered<L>& out) {
  using D = typename L::D;
  const Doubles<L> n;
  D normal[7][3];
  cross_forms(n, f.a, f.minus_a, f.b, normal);
  D permanent = L::constant(0);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const D minor = L::fma(d.a_max[k1], d.b_max[k2], L::multiply(d.a_max[k2], d.b_max[k1]));
    permanent = L::fma(d.c_max[k], minor, permanent);
  }
  out.error = L::fma(permanent, L::constant(kDeterminantError), L::constant(kUnderflow));
  out.nonzero = 0;
#pragma GCC unroll 9
  for (int s = 0; s < 9; ++s) {
    out.value[s] = dot_coefficient(n, normal, f.c, s);
    out.nonzero |= L::greater(L::abs(out.value[s]), L::multiply(out.error, L::constant(kEight[s])));
  }
  out.nonzero &= d.in_range;
}

// Lanes where n_A · n_B < 0 for certain in every coefficient. REQUIRES they are in range.
template <class L>
unsigned opposed_polynomial(const Differences<L>& d, const WeightedForms<L>& f) {
  using D = typename L::D;
  const Doubles<L> n;
  D n_a[6][3], n_b[6][3];
  cross_forms(n, f.c, f.minus_c, f.a, n_a);
  cross_forms(n, f.c, f.minus_c, f.b, n_b);
  D permanent = L::constant(0);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const D of_a = L::fma(d.c_max[k1], d.a_max[k2], L::multiply(d.c_max[k2], d.a_max[k1]));
    const D of_b = L::fma(d.c_max[k1], d.b_max[k2], L::multiply(d.c_max[k2], d.b_max[k1]));
    permanent = L::fma(of_a, of_b, permanent);
  }
  const D error = L::fma(permanent, L::constant(-kSidesError), L::constant(-kUnderflow));
  unsigned opposed = L::kAll;
#pragma GCC unroll 11
  for (int s = 0; s < 11; ++s)
    opposed &= L::greater(L::multiply(error, L::constant(kTen[s])), dot_coefficient(n, n_a, n_b, s));
  return opposed;
}

}  // namespace patchproof::decide
