// SPDX-License-Identifier: Apache-2.0
// Points together with a bound of their distance from the exact ones, or as enclosures. The points are the same bits as
// surface_kernels.h gives.
//
// Without weights the bound is a polynomial of its own, Σ m_ij |x|^i |y|^j, whose coefficients are the fourth numbers of
// the piece (error_bounds.h: pointwise). With weights it is the quotient's bound from those of numerator and denominator.
#pragma once

#include "kernels/error_bounds.h"
#include "kernels/surface_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

struct BoundedSinks {
  Sink point, lower, upper;
  double* bound;
  BoundedSinks(const SurfaceCall& call, std::size_t count)
      : point(call.out.point, count, false),
        lower(call.lower, count, false),
        upper(call.upper, count, false),
        bound(call.bound) {}
};

HWY_NOINLINE inline void put_numbers(V numbers, double* to, std::size_t count) {
  HWY_ALIGN double buffer[kLanes];
  hn::Store(numbers, D(), buffer);
  for (std::size_t i = 0; i < count; ++i) to[i] = buffer[i];
}

// kLanes points with their bounds, or the first `count` of them.
PATCHPROOF_INLINE void put_bounded(const BoundedSinks& out, const Lanes (&point)[3], V bound, std::size_t at,
                                   std::size_t count) {
  const bool whole = count >= static_cast<std::size_t>(kLanes);
  const auto put = [&](const Sink& sink, V x, V y, V z) {
    if (whole)
      sink.put(at, x, y, z);
    else
      sink.put_some(at, x, y, z, static_cast<int>(count));
  };
  put(out.point, point[0].v, point[1].v, point[2].v);
  if (out.bound != nullptr) {
    if (whole)
      hn::StoreU(bound, D(), out.bound + at);
    else
      put_numbers(bound, out.bound + at, count);
  }
  if (!out.lower.wanted()) return;
  // The ends are rounded too: by at most u(|point| + bound) each.
  const V two_units = hn::Set(D(), 2 * kUnitRoundoff);
  V low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    const V reach = hn::MulAdd(hn::Abs(point[k].v), two_units, hn::Mul(bound, hn::Set(D(), kBoundSlack)));
    // Nothing is known where the bound or the point is no number.
    const auto known = hn::And(hn::Lt(reach, hn::Inf(D())), hn::Lt(hn::Abs(point[k].v), hn::Inf(D())));
    low[k] = hn::IfThenElse(known, hn::Sub(point[k].v, reach), hn::Neg(hn::Inf(D())));
    high[k] = hn::IfThenElse(known, hn::Add(point[k].v, reach), hn::Inf(D()));
  }
  put(out.lower, low[0], low[1], low[2]);
  put(out.upper, high[0], high[1], high[2]);
}

// See error_bounds.h. +infinity where the denominator may be zero.
PATCHPROOF_INLINE V rational_bound(V numerator_error, V weight_error, const Lanes (&point)[3], V weight) {
  const V size = hn::Max(hn::Abs(point[0].v), hn::Max(hn::Abs(point[1].v), hn::Abs(point[2].v)));
  const V smallest = hn::Sub(hn::Abs(weight), weight_error),
          numerator = hn::MulAdd(size, weight_error, numerator_error);
  const V bound = hn::MulAdd(size, hn::Set(D(), 3 * kUnitRoundoff), hn::Div(numerator, smallest));
  const V safe = hn::MulAdd(bound, hn::Set(D(), kBoundSlack), hn::Set(D(), kUnderflow));
  return hn::IfThenElse(hn::And(hn::Gt(smallest, hn::Zero(D())), hn::Lt(safe, hn::Inf(D()))), safe, hn::Inf(D()));
}

template <bool Rational, int DegreeU, int DegreeV>
struct BoundedKernel {
  static constexpr bool kFixed = DegreeU >= 0;
  static constexpr int kNumbers = Rational ? 4 : 3;

  static HWY_NOINLINE bool run(const SurfacePieces& s, std::int64_t span_u, std::int64_t span_v, const double* u,
                               const double* v, std::size_t count, std::size_t at, const BoundedSinks& out) {
    using Value = Points<kNumbers, 1>;
    using Bound = Points<1, 1>;
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    const double* coefficients = s.coefficients(span_u, span_v);
    const PieceBounds& bounds = s.bounds[static_cast<std::size_t>(span_u * s.v.count + span_v)];
    const V centre_u = hn::Set(D(), s.u.centre[span_u]), scale_u = hn::Set(D(), s.u.scale[span_u]);
    const V centre_v = hn::Set(D(), s.v.centre[span_v]), scale_v = hn::Set(D(), s.v.scale[span_v]);
    const V numerator_error = hn::Set(D(), bounds.numerator_error), weight_error = hn::Set(D(), bounds.weight_error);
    auto vanishing = hn::FirstN(D(), 0);
    for (std::size_t i = 0; i < count; i += kLanes) {
      Group<1> x, y, size_x, size_y;
      x.g[0] = local_lanes(u, i, count, centre_u, scale_u);
      y.g[0] = local_lanes(v, i, count, centre_v, scale_v);
      size_x.g[0] = hn::Abs(x.g[0].v);
      size_y.g[0] = hn::Abs(y.g[0].v);
      HornerRows<0, Value> rows;
      Horner<0, Bound> bound_rows;
#pragma GCC unroll 16
      for (int j = q; j >= 0; --j) {
        const double* from = coefficients + (j / 2) * row_length + (j & 1) * 4;
        Horner<0, Value> row;
        Horner<0, Bound> bound_row;
#pragma GCC unroll 16
        for (int k = 0; k <= p; ++k) {
          row.push(k, Value::all(from + 8 * (p - k)), x);
          if constexpr (!Rational) bound_row.push(k, Bound::all(from + 8 * (p - k) + 3), size_x);
        }
        rows.push(q - j, row.d, y);
        if constexpr (!Rational) bound_rows.push(q - j, bound_row.d[0], size_y);
      }
      SurfaceJet<0, Value> jet = surface_jet<0>(rows, Group<1>(1.0), Group<1>(1.0));
      if constexpr (Rational) {
        const V weight = jet.d[0].c[0][3].v;
        vanishing = hn::Or(vanishing, vanishes(weight, i, count));
        jet = quotient<0>(jet);
        const auto& c = jet.d[0].c[0];
        const Lanes point[3] = {c[0], c[1], c[2]};
        put_bounded(out, point, rational_bound(numerator_error, weight_error, point, weight), at + i, count - i);
      } else {
        put_bounded(out, jet.d[0].c[0], bound_rows.d[0].c[0][0].v, at + i, count - i);
      }
    }
    return s.safe_weights || hn::AllFalse(D(), vanishing);
  }

  static HWY_NOINLINE bool scattered(const SurfacePieces& s, const std::int64_t* span_u, const std::int64_t* span_v,
                                     const double* x, const double* y, std::size_t count, std::size_t at,
                                     const BoundedSinks& out) {
    using Parameter = std::conditional_t<Rational, Scalar, SignedScalar>;
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    bool good = true;
    HWY_ALIGN double number[4][kTile];     // x, y, z, and the bound or the weight
    HWY_ALIGN double of_numerator[kTile];  // errors
    HWY_ALIGN double of_weight[kTile];
    for (std::size_t i = 0; i < count; ++i) {
      const double* coefficients = s.coefficients(span_u[i], span_v[i]);
      const Parameter local_x{x[i]}, local_y{y[i]};
      HornerRows<0, Quad> rows;
#pragma GCC unroll 16
      for (int pair = q / 2; pair >= 0; --pair) {
        Horner<0, Octet> row;
        const double* from = coefficients + pair * row_length;
#pragma GCC unroll 16
        for (int k = 0; k <= p; ++k) row.push(k, Octet::load(from + 8 * (p - k)), local_x);
        if (2 * pair + 1 <= q) {
          const Quad half[1] = {row.d[0].template half<1>()};
          rows.push(q - (2 * pair + 1), half, local_y);
        }
        const Quad half[1] = {row.d[0].template half<0>()};
        rows.push(q - 2 * pair, half, local_y);
      }
      double numbers[4];
      if constexpr (Rational) {
        SurfaceJet<0, Quad> jet;
        jet.d[0] = rows.value.d[0];
        rows.value.d[0].store(numbers);
        number[3][i] = numbers[3];
        const PieceBounds& bounds = s.bounds[static_cast<std::size_t>(span_u[i] * s.v.count + span_v[i])];
        of_numerator[i] = bounds.numerator_error;
        of_weight[i] = bounds.weight_error;
        if (!s.safe_weights) good = good && (numbers[3] >= kSmallestWeight || numbers[3] <= -kSmallestWeight);
        quotient<0>(jet).d[0].store(numbers);
      } else {
        rows.value.d[0].store(numbers);
        number[3][i] = numbers[3];
      }
      for (int k = 0; k < 3; ++k) number[k][i] = numbers[k];
    }
    for (std::size_t i = 0; i < count; i += kLanes) {
      const Lanes point[3] = {hn::LoadU(D(), number[0] + i), hn::LoadU(D(), number[1] + i),
                              hn::LoadU(D(), number[2] + i)};
      V bound = hn::LoadU(D(), number[3] + i);
      if constexpr (Rational)
        bound = rational_bound(hn::LoadU(D(), of_numerator + i), hn::LoadU(D(), of_weight + i), point, bound);
      put_bounded(out, point, bound, at + i, count - i);
    }
    return good;
  }

  static Progress all(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v,
                      std::size_t count) {
    const BoundedSinks out(call, count);
    return for_tiles(
        s, call, u, v, count,
        [&](std::int64_t span_u, std::int64_t span_v, const double* us, const double* vs, std::size_t n,
            std::size_t at) { return run(s, span_u, span_v, us, vs, n, at, out); },
        [&](const std::int64_t* span_u, const std::int64_t* span_v, const double* x, const double* y, std::size_t n,
            std::size_t at) { return scattered(s, span_u, span_v, x, y, n, at, out); });
  }
};

inline Progress bounded(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v,
                        std::size_t count) {
  return with_constants(s, 0, [&]<int Order, bool Rational, int P, int Q_>() {
    static_assert(Order >= 0);
    return BoundedKernel<Rational, P, Q_>::all(s, call, u, v, count);
  });
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
