// SPDX-License-Identifier: Apache-2.0
// The weighted joins of decide_forms.h: homogeneous rows, filter, sides and C1. The error analysis is there.
#pragma once

#include "join/decide_forms.h"

namespace patchproof::decide {

// Coordinates scaled by one power of two, weights by another (a diagonal map of space).
template <class L>
struct ScaledRows {
  typename L::D points[36], weights[12];
  Scale<L> scale_points, scale_weights;
  unsigned in_range;
};

template <class L, int Size>
unsigned scale_row(const typename L::D (&raw)[Size], typename L::D (&scaled)[Size], Scale<L>& scale) {
  using D = typename L::D;
  D total = L::constant(0), top = L::constant(0);
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i) {
    total = L::add(total, L::abs(raw[i]));
    top = L::max(top, L::abs(raw[i]));
  }
  L::scale_to_whole(top, scale.up, scale.down);
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i) scaled[i] = L::multiply(raw[i], scale.up);
  return L::greater(L::constant(kLargestInRange), total) & L::greater(top, L::constant(kSmallestInRange));
}

template <class L>
void take_scaled(const typename L::D (&x)[36], const typename L::D (&w)[12], ScaledRows<L>& out) {
  out.in_range = scale_row<L>(x, out.points, out.scale_points) & scale_row<L>(w, out.weights, out.scale_weights);
}

template <class L>
struct HomogeneousRows {
  typename L::D edge[4][4], a[4][4], b[4][4];     // a, b times binomials
  typename L::D edge_max[4], a_max[4], b_max[4];  // without binomials
};

template <class L>
void take_row(const ScaledRows<L>& rows, int which, bool cartesian, bool binomials, typename L::D (&row)[4][4],
              typename L::D (&largest)[4]) {
  using D = typename L::D;
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {
    largest[k] = L::constant(0);
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      const D w = rows.weights[4 * which + i];
      D h = w;
      if (k < 3) h = rows.points[12 * which + 3 * i + k];
      if (k < 3 && cartesian) h = L::multiply(h, w);
      largest[k] = L::max(largest[k], L::abs(h));
      row[i][k] = binomials && (i == 1 || i == 2) ? Doubles<L>::thrice(h) : h;
    }
  }
}

template <class L>
void take_homogeneous(const ScaledRows<L>& rows, bool cartesian, HomogeneousRows<L>& out) {
  take_row(rows, 0, cartesian, false, out.edge, out.edge_max);
  take_row(rows, 1, cartesian, true, out.a, out.a_max);
  take_row(rows, 2, cartesian, true, out.b, out.b_max);
}

// The bound of the error of coefficient s is kMeeting[s] times out.error.
template <class L>
void filter_rational(const HomogeneousRows<L>& h, unsigned in_range, const typename L::D (&line)[5][6],
                     Filtered<L>& out) {
  using D = typename L::D;
  const Doubles<L> n;
  D rungs[7][6];
  rung_lines(n, h.a, h.b, rungs);
  D permanent = L::constant(0);
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const int x = kLine[k][0], y = kLine[k][1], x2 = kLine[(k + 3) % 6][0], y2 = kLine[(k + 3) % 6][1];
    const D of_edge = L::multiply(L::add(h.edge_max[x], h.edge_max[x]), h.edge_max[y]);
    const D of_rungs = L::fma(h.a_max[x2], h.b_max[y2], L::multiply(h.a_max[y2], h.b_max[x2]));
    permanent = L::fma(of_edge, of_rungs, permanent);
  }
  out.error = L::fma(permanent, L::constant(kRationalDeterminantError), L::constant(kUnderflow));
  out.nonzero = 0;
#pragma GCC unroll 11
  for (int s = 0; s < 11; ++s) {
    out.value[s] = dot_coefficient(n, line, rungs, s);
    out.nonzero |= L::greater(L::abs(out.value[s]), L::multiply(out.error, L::constant(kMeeting[s])));
  }
  out.nonzero &= in_range;
}

// n = D × X + X_w M, the normal of the plane through the line (D, M) and X.
template <class L>
void plane_normals(const typename L::D (&line)[5][6], const typename L::D (&x)[4][4], typename L::D (&out)[8][3]) {
  using D = typename L::D;
#pragma GCC unroll 8
  for (int s = 0; s < 8; ++s)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      D sum = L::constant(0);
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) {
        const int r = s - i;
        if (r < 0 || r > 4) continue;
        sum = L::fma(line[r][k1], x[i][k2], sum);
        sum = L::fnma(line[r][k2], x[i][k1], sum);
        sum = L::fma(line[r][3 + k], x[i][3], sum);
      }
      out[s][k] = sum;
    }
}

// Lanes where n_A · n_B < 0 for certain in every coefficient. REQUIRES they are in range, edge weights positive.
template <class L>
unsigned opposed_rational(const HomogeneousRows<L>& h, const typename L::D (&line)[5][6]) {
  using D = typename L::D;
  D n_a[8][3], n_b[8][3], edge[6];
  plane_normals<L>(line, h.a, n_a);
  plane_normals<L>(line, h.b, n_b);
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k)
    edge[k] = L::multiply(L::add(h.edge_max[kLine[k][0]], h.edge_max[kLine[k][0]]), h.edge_max[kLine[k][1]]);
  const auto size = [&](const D(&x)[4], int k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    return L::fma(edge[k1], x[k2], L::fma(edge[k2], x[k1], L::multiply(edge[3 + k], x[3])));
  };
  D permanent = L::constant(0);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) permanent = L::fma(size(h.a_max, k), size(h.b_max, k), permanent);
  const D error = L::fma(permanent, L::constant(-kRationalSidesError), L::constant(-kUnderflow));
  const Doubles<L> n;
  unsigned opposed = L::kAll;
#pragma GCC unroll 15
  for (int s = 0; s < 15; ++s)
    opposed &= L::greater(L::multiply(error, L::constant(kNormals[s])), dot_coefficient(n, n_a, n_b, s));
  return opposed;
}

// a + b = 2 e in exact numbers. The sum s = fl(a + b) is exact if and only if fl(s − a) = b and fl(s − b) = a: an error
// is a multiple of the smaller unit in the last place of a and b, so one of the two would differ by at least its own
// unit.
template <class L>
unsigned is_middle(typename L::D e, typename L::D a, typename L::D b) {
  const typename L::D s = L::add(a, b);
  return L::equal(s, L::add(e, e)) & L::equal(L::subtract(s, a), b) & L::equal(L::subtract(s, b), a);
}

// Sufficient for C1: E is the middle of A and B, with equal weights if they multiply the points.
template <class L>
unsigned reflected(const ScaledRows<L>& rows, bool cartesian) {
  unsigned yes = L::kAll;
#pragma GCC unroll 12
  for (int i = 0; i < 12; ++i) yes &= is_middle<L>(rows.points[i], rows.points[12 + i], rows.points[24 + i]);
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    const typename L::D e = rows.weights[i], a = rows.weights[4 + i], b = rows.weights[8 + i];
    yes &= cartesian ? L::equal(e, a) & L::equal(e, b) : is_middle<L>(e, a, b);
  }
  return yes;
}

// Lanes where E_w S − S_w E, S = A + B, is certainly not zero: not C1. REQUIRES they are in range.
template <class L>
unsigned certainly_not_c1(const HomogeneousRows<L>& h) {
  using D = typename L::D;
  D edge[4][4], sum[4][4];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
      edge[i][k] = i == 1 || i == 2 ? Doubles<L>::thrice(h.edge[i][k]) : h.edge[i][k];
      sum[i][k] = L::add(h.a[i][k], h.b[i][k]);
    }
  const D weight = L::add(h.a_max[3], h.b_max[3]);
  unsigned nonzero = 0;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const D size = L::fma(h.edge_max[3], L::add(h.a_max[k], h.b_max[k]), L::multiply(weight, h.edge_max[k]));
    const D error = L::fma(size, L::constant(kRationalC1Error), L::constant(kUnderflow));
#pragma GCC unroll 7
    for (int s = 0; s < 7; ++s) {
      D value = L::constant(0);
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) {
        if (s - i < 0 || s - i > 3) continue;
        value = L::fma(edge[i][3], sum[s - i][k], value);
        value = L::fnma(edge[i][k], sum[s - i][3], value);
      }
      nonzero |= L::greater(L::abs(value), L::multiply(error, L::constant(kSix[s])));
    }
  }
  return nonzero;
}

}  // namespace patchproof::decide
