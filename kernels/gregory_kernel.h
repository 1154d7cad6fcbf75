// SPDX-License-Identifier: Apache-2.0
// The C surface of a Gregory patch at one place, or at a vector of them: one body for doubles, vectors of doubles, Tracked and
// counters of roundings.
//
//   S^c = Σ_ij B_i(u) B_j(v) Q¹_ij + Σ_pq β_pq F_pq,    F_pq = Σ_{i,j of the quadrant} B_i(u) B_j(v) (Q⁰_ij − Q¹_ij)
//
// Every factor but the derivatives' own sums is a positive number with a small relative error, so that the error of a result
// is γ(n) times the moduli of the products (gregory_batch.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "kernels/horner.h"

namespace patchproof::kernels {

// Numbers of the C surface, each rounded once. Components of points: x y z w.
struct GregoryNets {
  double q[4][4][4];          // Q¹
  double inner[2][2][4];      // Q⁰ − Q¹ of the point next to the corner (p, q) on both sides
  double others[2][2][3][4];  // of the corner point, of the one after it along u, of the one along v
};

// How many roundings the factors of a result have seen at most.
struct Roundings {
  int n = 0;
  Roundings() = default;
  explicit Roundings(double) : n(1) {}
  explicit Roundings(int count) : n(count) {}
  friend Roundings operator+(Roundings a, Roundings b) { return Roundings(std::max(a.n, b.n) + 1); }
  friend Roundings operator-(Roundings a, Roundings b) { return a + b; }
  friend Roundings operator*(Roundings a, Roundings b) { return Roundings(a.n + b.n + 1); }
  friend Roundings operator/(Roundings a, Roundings b) { return Roundings(a.n + b.n + 1); }
};

// β and its derivatives, of the distances from the corner. (x, y) is no nearer to it than 2^-256.
template <class T>
struct Blend {
  T b, x, y, xx, xy, yy;
};

template <class T, int Order>
PATCHPROOF_INLINE Blend<T> blend_of(const T& x, const T& y) {
  const T s = x * x, t = y * y, r = T(1.0) / (s + t);
  const T sr = s * r, tr = t * r, xr = x * r, yr = y * r;
  Blend<T> out;
  out.b = sr;
  if constexpr (Order >= 1) {
    out.x = T(2.0) * (xr * tr);
    out.y = T(-2.0) * (yr * sr);
  }
  if constexpr (Order >= 2) {
    out.xx = (T(2.0) * tr) * ((t - T(3.0) * s) * r) * r;
    out.yy = (T(-2.0) * sr) * ((s - T(3.0) * t) * r) * r;
    out.xy = (T(4.0) * (x * yr)) * ((s - t) * r) * r;
  }
  return out;
}

// B_0 … B_3 and their derivatives; `back` is 1 − t.
template <class T>
struct CubicBasis {
  T b[4], d[4], dd[4];
};
template <class T, int Order>
PATCHPROOF_INLINE CubicBasis<T> cubic_basis(const T& t, const T& back) {
  CubicBasis<T> out;
  const T tt = t * t, bb = back * back, three = T(3.0);
  out.b[0] = bb * back, out.b[1] = three * (t * bb), out.b[2] = three * (tt * back), out.b[3] = tt * t;
  if constexpr (Order >= 1) {
    const T two = T(2.0);
    out.d[0] = T(-3.0) * bb, out.d[1] = three * (back * (back - two * t));
    out.d[2] = three * (t * (two * back - t)), out.d[3] = three * tt;
  }
  if constexpr (Order >= 2) {
    const T two = T(2.0), six = T(6.0);
    out.dd[0] = six * back, out.dd[1] = six * (t - two * back);
    out.dd[2] = six * (back - two * t), out.dd[3] = six * t;
  }
  return out;
}

// The sum of the products over a quadrant and its derivatives, one component.
template <class T>
struct QuadrantSum {
  T f, x, y, xx, xy, yy;
};

// S^c, S^c_u, S^c_v, S^c_uu, S^c_uv, S^c_vv; [vector][component]
template <class T>
using CSurfaceValues = std::array<std::array<T, 4>, 6>;

// Inner: only the inner points differ, and there are no weights. (u, v): for the basis; x, y: the distances from the ends,
// moved away from the corners.
template <class T, int Order, bool Inner>
PATCHPROOF_INLINE void c_surface(const GregoryNets& nets, const std::array<T, 2>& x, const std::array<T, 2>& y,
                                 CSurfaceValues<T>& out) {
  constexpr int kComponents = Inner ? 3 : 4;
  const CubicBasis<T> a = cubic_basis<T, Order>(x[0], x[1]), b = cubic_basis<T, Order>(y[0], y[1]);
  for (int c = 0; c < kComponents; ++c) {
    T row[4], row_v[4], row_vv[4];
    for (int i = 0; i < 4; ++i) {
      const double* q = &nets.q[i][0][c];
      const auto sum = [&](const T* f) PATCHPROOF_INLINE_LAMBDA {
        return (f[0] * T(q[0]) + f[1] * T(q[4])) + (f[2] * T(q[8]) + f[3] * T(q[12]));
      };
      row[i] = sum(b.b);
      if constexpr (Order >= 1) row_v[i] = sum(b.d);
      if constexpr (Order >= 2) row_vv[i] = sum(b.dd);
    }
    const auto sum = [&](const T* f, const T* r)
                         PATCHPROOF_INLINE_LAMBDA { return (f[0] * r[0] + f[1] * r[1]) + (f[2] * r[2] + f[3] * r[3]); };
    out[0][c] = sum(a.b, row);
    if constexpr (Order >= 1) out[1][c] = sum(a.d, row), out[2][c] = sum(a.b, row_v);
    if constexpr (Order >= 2) out[3][c] = sum(a.dd, row), out[4][c] = sum(a.d, row_v), out[5][c] = sum(a.b, row_vv);
  }
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) {
      const Blend<T> g = blend_of<T, Order>(x[p], y[q]);
      // The basis as seen from the corner: derivatives by the distances have the other sign at the far ends.
      const int i0 = 3 * p, i1 = 1 + p, j0 = 3 * q, j1 = 1 + q;
      const double su = p == 0 ? 1.0 : -1.0, sv = q == 0 ? 1.0 : -1.0;
      const auto add = [&](int c, const QuadrantSum<T>& f) PATCHPROOF_INLINE_LAMBDA {
        out[0][c] = out[0][c] + g.b * f.f;
        if constexpr (Order >= 1) {
          out[1][c] = out[1][c] + (g.b * f.x + T(su) * (g.x * f.f));
          out[2][c] = out[2][c] + (g.b * f.y + T(sv) * (g.y * f.f));
        }
        if constexpr (Order >= 2) {
          const T two = T(2.0);
          out[3][c] = out[3][c] + (g.b * f.xx + (T(su) * two * (g.x * f.x) + g.xx * f.f));
          out[5][c] = out[5][c] + (g.b * f.yy + (T(sv) * two * (g.y * f.y) + g.yy * f.f));
          out[4][c] =
              out[4][c] + ((g.b * f.xy + T(su * sv) * (g.xy * f.f)) + (T(sv) * (g.y * f.x) + T(su) * (g.x * f.y)));
        }
      };
      const auto term = [&](int i, int j) PATCHPROOF_INLINE_LAMBDA {
        QuadrantSum<T> f;
        f.f = a.b[i] * b.b[j];
        if constexpr (Order >= 1) f.x = a.d[i] * b.b[j], f.y = a.b[i] * b.d[j];
        if constexpr (Order >= 2) f.xx = a.dd[i] * b.b[j], f.xy = a.d[i] * b.d[j], f.yy = a.b[i] * b.dd[j];
        return f;
      };
      const auto scaled = [&](const QuadrantSum<T>& f, double by) PATCHPROOF_INLINE_LAMBDA {
        QuadrantSum<T> o;
        const T d = T(by);
        o.f = d * f.f;
        if constexpr (Order >= 1) o.x = d * f.x, o.y = d * f.y;
        if constexpr (Order >= 2) o.xx = d * f.xx, o.xy = d * f.xy, o.yy = d * f.yy;
        return o;
      };
      const QuadrantSum<T> inner = term(i1, j1);
      if constexpr (Inner) {
        for (int c = 0; c < 3; ++c) add(c, scaled(inner, nets.inner[p][q][c]));
      } else {
        const QuadrantSum<T> corner = term(i0, j0), along_u = term(i1, j0), along_v = term(i0, j1);
        for (int c = 0; c < 4; ++c) {
          const double(&d)[3][4] = nets.others[p][q];
          const QuadrantSum<T> f0 = scaled(inner, nets.inner[p][q][c]), f1 = scaled(corner, d[0][c]),
                               f2 = scaled(along_u, d[1][c]), f3 = scaled(along_v, d[2][c]);
          QuadrantSum<T> f;
          f.f = (f0.f + f1.f) + (f2.f + f3.f);
          if constexpr (Order >= 1) f.x = (f0.x + f1.x) + (f2.x + f3.x), f.y = (f0.y + f1.y) + (f2.y + f3.y);
          if constexpr (Order >= 2) {
            f.xx = (f0.xx + f1.xx) + (f2.xx + f3.xx);
            f.xy = (f0.xy + f1.xy) + (f2.xy + f3.xy);
            f.yy = (f0.yy + f1.yy) + (f2.yy + f3.yy);
          }
          add(c, f);
        }
      }
    }
}

// The largest number of roundings in a factor of any result, parameters exact and 1 − t rounded once.
template <int Order, bool Inner>
int roundings() {
  CSurfaceValues<Roundings> out;
  c_surface<Roundings, Order, Inner>({}, {Roundings(0), Roundings(1)}, {Roundings(0), Roundings(1)}, out);
  int n = 0;
  for (const auto& vector : out)
    for (const Roundings& r : vector) n = std::max(n, r.n);
  return n;
}

}  // namespace patchproof::kernels
