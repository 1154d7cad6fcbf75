// SPDX-License-Identifier: Apache-2.0
// Grids: for each u the rows of coefficients become one polynomial in v for each piece, then v runs in lanes. The same
// operations on each number as for scattered parameters.
#pragma once

#include "kernels/surface_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

constexpr int kLargestGridDegree = 31;  // along v; beyond, the row curve would not fit the buffer: a point at a time

template <int Order, bool Rational, int DegreeU, int DegreeV>
struct GridKernel {
  static constexpr bool kFixed = DegreeU >= 0;
  static constexpr int kNumbers = Rational ? 4 : 3;
  static constexpr int kGroups = 1;
  static constexpr int kRows = kFixed ? DegreeV + 1 : kLargestGridDegree + 1;
  using Buffer = double[Order + 1][kRows + 1][4];

  // The polynomials in y that S, ∂x S and ∂xx S/2 are at x.
  static PATCHPROOF_INLINE void row_curves(const SurfacePieces& s, const double* coefficients, double x,
                                           Buffer& buffer) {
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    for (int pair = 0; pair <= q / 2; ++pair) {
      Horner<Order, Octet> row;
      const double* from = coefficients + pair * row_length;
      for (int k = 0; k <= p; ++k) row.push(k, Octet::load(from + 8 * (p - k)), Scalar(x));
      for (int m = 0; m <= Order; ++m) row.d[m].store(buffer[m][2 * pair]);
    }
  }

  // v in one span: count parameters, results from `at` on.
  static HWY_NOINLINE bool run(const SurfacePieces& s, std::int64_t span_u, std::int64_t span_v, const Buffer& buffer,
                               const double* v, std::size_t count, std::size_t at, const SurfaceSinks& out,
                               std::size_t& undefined) {
    using Value = Points<kNumbers, kGroups>;
    const int q = kFixed ? DegreeV : s.v.degree;
    const V centre = hn::Set(D(), s.v.centre[span_v]), scale_v = hn::Set(D(), s.v.scale[span_v]);
    const Group<kGroups> factor_u(s.u.scale[span_u]), factor_v(s.v.scale[span_v]);
    Value fixed[kFixed ? Order + 1 : 1][kFixed ? DegreeV + 1 : 1];
    if constexpr (kFixed)
      for (int m = 0; m <= Order; ++m)
        for (int j = 0; j <= DegreeV; ++j) fixed[m][j] = Value::all(buffer[m][j]);
    const PieceBounds& bounds = s.bounds[static_cast<std::size_t>(span_u * s.v.count + span_v)];
    const NormalScale normal_scale{Lanes(bounds.normal_scale_u), Lanes(bounds.normal_scale_v)};
    auto vanishing = hn::FirstN(D(), 0);
    for (std::size_t i = 0; i < count; i += kLanes) {
      Group<kGroups> y;
      y.g[0] = local_lanes(v, i, count, centre, scale_v);
      HornerRows<Order, Value> rows;
      Value row[Order + 1];
      if constexpr (kFixed) {
#pragma GCC unroll 16
        for (int k = 0; k <= DegreeV; ++k) {
          for (int m = 0; m <= Order; ++m) row[m] = fixed[m][DegreeV - k];
          rows.push(k, row, y);
        }
      } else {
        for (int k = 0; k <= q; ++k) {
          for (int m = 0; m <= Order; ++m) row[m] = Value::all(buffer[m][q - k]);
          rows.push(k, row, y);
        }
      }
      SurfaceJet<Order, Value> jet = surface_jet<Order>(rows, factor_u, factor_v);
      if constexpr (Rational) {
        vanishing = hn::Or(vanishing, vanishes(jet.d[0].c[0][3].v, i, count));
        jet = quotient<Order>(jet);
        if (!s.safe_weights) vanishing = hn::Or(vanishing, overflowed(jet, 0, i, count));
      }
      put_lanes<Order>(out, normal_scale, jet, 0, at + i, count - i, undefined);
    }
    return s.safe_weights || hn::AllFalse(D(), vanishing);
  }

  static Progress all(const SurfacePieces& s, const SurfaceCall& call, const double* u, std::size_t count_u,
                      const double* v, std::size_t count_v) {
    const SurfaceSinks out(call.out, count_u * count_v, false);
    Progress progress;
    HWY_ALIGN double x[kTile];
    HWY_ALIGN double y[kTile];
    std::int64_t span_u[kTile], span_v[kTile];
    HWY_ALIGN Buffer buffer;
    for (std::size_t row0 = 0; row0 < count_u; row0 += kTile) {
      const std::size_t rows = count_u - row0 < kTile ? count_u - row0 : kTile;
      locate(s.u, call.left_u, u + row0, rows, span_u, x);
      for (std::size_t column0 = 0; column0 < count_v; column0 += kTile) {
        const std::size_t columns = count_v - column0 < kTile ? count_v - column0 : kTile;
        locate(s.v, call.left_v, v + column0, columns, span_v, y);
        for (std::size_t i = 0; i < rows; ++i)
          for (std::size_t j = 0; j < columns;) {
            const std::size_t length = run_length(span_v, j, columns), at = (row0 + i) * count_v + column0 + j;
            row_curves(s, s.coefficients(span_u[i], span_v[j]), x[i], buffer);
            if (!run(s, span_u[i], span_v[j], buffer, v + column0 + j, length, at, out, progress.undefined_normals))
              return {row0 * count_v, Stop::vanishing_weight, 0};  // an earlier item may lie in a later tile of columns
            j += length;
          }
      }
    }
    progress.good = count_u * count_v;
    return progress;
  }
};

// For degrees beyond the buffer: each row as scattered parameters.
inline Progress grid_by_points(const SurfacePieces& s, const SurfaceCall& call, const double* u, std::size_t count_u,
                               const double* v, std::size_t count_v) {
  Progress progress;
  double row[kTile];
  for (std::size_t i = 0; i < count_u; ++i) {
    for (double& x : row) x = u[i];
    for (std::size_t j = 0; j < count_v; j += kTile) {
      const std::size_t n = count_v - j < kTile ? count_v - j : kTile;
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i * count_v + j);
      SurfaceCall part = call;
      for (VectorArray SurfaceOutput::*out :
           {&SurfaceOutput::point, &SurfaceOutput::du, &SurfaceOutput::dv, &SurfaceOutput::normal, &SurfaceOutput::duu,
            &SurfaceOutput::duv, &SurfaceOutput::dvv})
        part.out.*out = (call.out.*out).from(at);
      const Progress done = surface(s, part, row, v + j, n);
      progress.undefined_normals += done.undefined_normals;
      if (done.stop != Stop::none) return {static_cast<std::size_t>(at) + done.good, done.stop, 0};
    }
  }
  progress.good = count_u * count_v;
  return progress;
}

// REQUIRES all parameters in the domain.
inline Progress grid(const SurfacePieces& s, const SurfaceCall& call, const double* u, std::size_t count_u,
                     const double* v, std::size_t count_v) {
  if (s.v.degree > kLargestGridDegree) return grid_by_points(s, call, u, count_u, v, count_v);
  return with_constants(s, order_of(call.out), [&]<int Order, bool Rational, int P, int Q_>() {
    return GridKernel<Order, Rational, P, Q_>::all(s, call, u, count_u, v, count_v);
  });
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
