// SPDX-License-Identifier: Apache-2.0
// Curves: runs of parameters in one piece by lanes, scattered ones a point at a time in a quad. Both do the same
// operations on each number.
#pragma once

#include "kernels/kernel_table.h"
#include "kernels/locate.h"
#include "kernels/sinks.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

struct CurveSinks {
  Sink d[3];
};

// Degree: a constant, or −1: any.
template <int Order, bool Rational, int Degree>
struct CurveKernel {
  static constexpr int kNumbers = Rational ? 4 : 3;
  static constexpr int kGroups = 1;

  // Parameters in one piece. False where the denominator vanishes.
  static bool run(const CurvePieces& c, std::int64_t span, const double* t, std::size_t count, std::size_t at,
                  const CurveSinks& out) {
    using Value = Points<kNumbers, kGroups>;
    const int degree = Degree >= 0 ? Degree : c.t.degree;
    const double* coefficients = c.high.data() + static_cast<std::size_t>(span) * c.piece();
    const V centre = hn::Set(D(), c.t.centre[span]), scale_t = hn::Set(D(), c.t.scale[span]);
    const Group<kGroups> factor(c.t.scale[span]);
    Value fixed[Degree >= 0 ? Degree + 1 : 1];
    if constexpr (Degree >= 0)
      for (int i = 0; i <= Degree; ++i) fixed[i] = Value::all(coefficients + 4 * i);
    auto vanishing = hn::FirstN(D(), 0);
    constexpr std::size_t kStep = static_cast<std::size_t>(kLanes) * kGroups;
    for (std::size_t i = 0; i < count; i += kStep) {
      Group<kGroups> x;
      for (int b = 0; b < kGroups; ++b) {
        x.g[b] = local_lanes(t, i + static_cast<std::size_t>(b) * kLanes, count, centre, scale_t);
      }
      Horner<Order, Value> h;
      if constexpr (Degree >= 0) {
#pragma GCC unroll 16
        for (int k = 0; k <= Degree; ++k) h.push(k, fixed[Degree - k], x);
      } else {
        for (int k = 0; k <= degree; ++k) h.push(k, Value::all(coefficients + 4 * (degree - k)), x);
      }
      CurveJet<Order, Value> jet = curve_jet<Order>(h, factor);
      if constexpr (Rational) {
        for (int b = 0; b < kGroups; ++b)
          vanishing = hn::Or(vanishing, vanishes(jet.d[0].c[b][3].v, i + b * kLanes, count));
        jet = quotient<Order>(jet);
        if (!c.safe_weights)
          for (int b = 0; b < kGroups; ++b) vanishing = hn::Or(vanishing, overflowed(jet, b, i + b * kLanes, count));
      }
      for (int b = 0; b < kGroups; ++b) {
        const std::size_t from = i + static_cast<std::size_t>(b) * kLanes;
        if (from >= count) break;
        for (int m = 0; m <= Order; ++m) {
          const auto& p = jet.d[m].c[b];
          if (from + kLanes <= count)
            out.d[m].put(at + from, p[0].v, p[1].v, p[2].v);
          else
            out.d[m].put_some(at + from, p[0].v, p[1].v, p[2].v, static_cast<int>(count - from));
        }
      }
    }
    return c.safe_weights || hn::AllFalse(D(), vanishing);
  }

  static bool scattered(const CurvePieces& c, const std::int64_t* span, const double* x, std::size_t count,
                        std::size_t at, const CurveSinks& out) {
    const int degree = Degree >= 0 ? Degree : c.t.degree;
    bool good = true;
    for (std::size_t i = 0; i < count; ++i) {
      const double* coefficients = c.high.data() + static_cast<std::size_t>(span[i]) * c.piece();
      const Scalar local(x[i]);
      Horner<Order, Quad> h;
#pragma GCC unroll 16
      for (int k = 0; k <= degree; ++k) h.push(k, Quad::load(coefficients + 4 * (degree - k)), local);
      CurveJet<Order, Quad> jet = curve_jet<Order>(h, Scalar(Order > 0 ? c.t.scale[span[i]] : 1.0));
      if constexpr (Rational) {
        if (!c.safe_weights) {
          double numbers[4];
          jet.d[0].store(numbers);
          good = good && (numbers[3] >= kSmallestWeight || numbers[3] <= -kSmallestWeight);
        }
        jet = quotient<Order>(jet);
        if (!c.safe_weights) good = good && !overflowed(jet);
      }
      for (int m = 0; m <= Order; ++m) out.d[m].put(at + i, jet.d[m]);
    }
    return good;
  }

  // A tile of scattered parameters; runs of one piece go by lanes.
  static Progress all(const CurvePieces& c, const CurveOutput& wanted, bool left, const double* t, std::size_t count) {
    const bool streamed = Order > 0 && c.t.count == 1;
    const CurveSinks out{{Sink(wanted.point, count, streamed), Sink(wanted.first, count, streamed),
                          Sink(wanted.second, count, streamed)}};
    Progress progress;
    std::int64_t span[kTile];
    HWY_ALIGN double x[kTile];
    for (std::size_t at = 0; at < count; at += kTile) {
      const std::size_t n = count - at < kTile ? count - at : kTile;
      const std::size_t inside = count_inside(c.t, t + at, n);
      if (inside < n) return {at + inside, Stop::outside_domain, 0};
      bool good = true;
      const std::int64_t only = c.t.count == 1 ? 0 : common_span(c.t, left, t + at, n);
      if (only >= 0) {
        good = run(c, only, t + at, n, at, out);
      } else {
        locate(c.t, left, t + at, n, span, x);
        const bool runs = mostly_runs(span, n);
        std::size_t pending = 0;  // scattered parameters before `i` that are not yet done
        for (std::size_t i = 0; runs && i < n;) {
          const std::size_t length = run_length(span, i, n);
          if (length >= 2 * static_cast<std::size_t>(kLanes)) {
            good = scattered(c, span + pending, x + pending, i - pending, at + pending, out) && good;
            good = run(c, span[i], t + at + i, length, at + i, out) && good;
            pending = i + length;
          }
          i += length;
        }
        good = scattered(c, span + pending, x + pending, n - pending, at + pending, out) && good;
      }
      if (!good) return {at, Stop::vanishing_weight, 0};
    }
    progress.good = count;
    hwy::FlushStream();  // streamed results are visible to whoever learns that the call has ended
    return progress;
  }
};

template <int Order, bool Rational>
Progress curve_of_order(const CurvePieces& c, const CurveOutput& out, bool left, const double* t, std::size_t count) {
  if (c.t.degree == 3) return CurveKernel<Order, Rational, 3>::all(c, out, left, t, count);
  return CurveKernel<Order, Rational, -1>::all(c, out, left, t, count);
}

inline Progress curve(const CurvePieces& c, const CurveOutput& out, bool left, const double* t, std::size_t count) {
  if (out.second.wanted())
    return c.rational ? curve_of_order<2, true>(c, out, left, t, count)
                      : curve_of_order<2, false>(c, out, left, t, count);
  if (out.first.wanted())
    return c.rational ? curve_of_order<1, true>(c, out, left, t, count)
                      : curve_of_order<1, false>(c, out, left, t, count);
  return c.rational ? curve_of_order<0, true>(c, out, left, t, count)
                    : curve_of_order<0, false>(c, out, left, t, count);
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
