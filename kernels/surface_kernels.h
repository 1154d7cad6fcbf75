// SPDX-License-Identifier: Apache-2.0
// Surfaces at scattered parameters: runs in one piece by lanes, single ones a point at a time in quads and octets. Both
// sum each row in x first and the rows in y, with the same operations on each number, so both give the same bits.
#pragma once

#include "kernels/curve_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

struct SurfaceSinks {
  Sink d[6];  // S, S_u, S_v, S_uu, S_uv, S_vv
  Sink normal;

  SurfaceSinks(const SurfaceOutput& out, std::size_t count, bool whole_vectors)
      : normal(out.normal, count, whole_vectors) {
    const VectorArray arrays[6] = {out.point, out.du, out.dv, out.duu, out.duv, out.dvv};
    for (int m = 0; m < 6; ++m) d[m] = Sink(arrays[m], count, whole_vectors);
  }
};

// kLanes results (or the first `count`) of one group to their places.
template <int Order, class Jet>
PATCHPROOF_INLINE void put_lanes(const SurfaceSinks& out, const NormalScale& normal_scale, const Jet& jet, int group,
                                 std::size_t at, std::size_t count, std::size_t& undefined) {
  const bool whole = count >= static_cast<std::size_t>(kLanes);
#pragma GCC unroll 6
  for (int m = 0; m < Jet::kCount; ++m) {
    const auto& p = jet.d[m].c[group];
    if (whole)
      out.d[m].put(at, p[0].v, p[1].v, p[2].v);
    else
      out.d[m].put_some(at, p[0].v, p[1].v, p[2].v, static_cast<int>(count));
  }
  if constexpr (Order >= 1) {
    if (!out.normal.wanted()) return;
    const auto &a = jet.d[1].c[group], &b = jet.d[2].c[group];
    Lanes n[3];
    unit_normal({a[0], a[1], a[2]}, {b[0], b[1], b[2]}, normal_scale, n);
    const int valid = whole ? kLanes : static_cast<int>(count);
    undefined += undefined_among(n, valid);
    if (whole)
      out.normal.put(at, n[0].v, n[1].v, n[2].v);
    else
      out.normal.put_some(at, n[0].v, n[1].v, n[2].v, valid);
  }
}

// Takes the parameters tile by tile: run(span_u, span_v, u, v, count, at) for those in one piece, scattered(span_u, span_v,
// x, y, count, at) for the others; both say whether all denominators were good.
template <class Run, class Scattered>
Progress for_tiles(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v, std::size_t count,
                   const Run& run, const Scattered& scattered) {
  const bool one_piece = s.u.count == 1 && s.v.count == 1;
  std::int64_t span_u[kTile], span_v[kTile], piece[kTile];
  HWY_ALIGN double x[kTile];
  HWY_ALIGN double y[kTile];
  for (std::size_t at = 0; at < count; at += kTile) {
    const std::size_t n = count - at < kTile ? count - at : kTile;
    const std::size_t inside = count_inside(s.v, v + at, count_inside(s.u, u + at, n));
    if (inside < n) return {at + inside, Stop::outside_domain, 0};
    bool good = true;
    if (one_piece) {
      good = run(0, 0, u + at, v + at, n, at);
    } else {
      locate(s.u, call.left_u, u + at, n, span_u, x);
      locate(s.v, call.left_v, v + at, n, span_v, y);
      for (std::size_t i = 0; i < n; ++i) piece[i] = span_u[i] * s.v.count + span_v[i];
      const bool runs = mostly_runs(piece, n);
      std::size_t pending = 0;  // scattered parameters before `i` that are not yet done
      const auto flush = [&](std::size_t end) {
        if (pending < end)
          good = scattered(span_u + pending, span_v + pending, x + pending, y + pending, end - pending, at + pending) &&
                 good;
      };
      for (std::size_t i = 0; runs && i < n;) {
        const std::size_t length = run_length(piece, i, n);
        if (length >= 2 * static_cast<std::size_t>(kLanes)) {
          flush(i);
          good = run(span_u[i], span_v[i], u + at + i, v + at + i, length, at + i) && good;
          pending = i + length;
        }
        i += length;
      }
      flush(n);
    }
    if (!good) return {at, Stop::vanishing_weight, 0};
  }
  return {count, Stop::none, 0};
}

// Degrees: constants, or −1: any.
template <int Order, bool Rational, int DegreeU, int DegreeV>
struct SurfaceKernel {
  static constexpr bool kFixed = DegreeU >= 0;
  static constexpr int kNumbers = Rational ? 4 : 3;
  static constexpr int kGroups = 1;

  // Parameters in one piece. False where the denominator vanishes.
  static HWY_NOINLINE bool run(const SurfacePieces& s, std::int64_t span_u, std::int64_t span_v, const double* u,
                               const double* v, std::size_t count, std::size_t at, const SurfaceSinks& out,
                               std::size_t& undefined) {
    using Value = Points<kNumbers, kGroups>;
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    const double* coefficients = s.coefficients(span_u, span_v);
    const V centre_u = hn::Set(D(), s.u.centre[span_u]), scale_u = hn::Set(D(), s.u.scale[span_u]);
    const V centre_v = hn::Set(D(), s.v.centre[span_v]), scale_v = hn::Set(D(), s.v.scale[span_v]);
    const Group<kGroups> factor_u(s.u.scale[span_u]), factor_v(s.v.scale[span_v]);
    const PieceBounds& bounds = s.bounds[static_cast<std::size_t>(span_u * s.v.count + span_v)];
    const NormalScale normal_scale{Lanes(bounds.normal_scale_u), Lanes(bounds.normal_scale_v)};
    auto vanishing = hn::FirstN(D(), 0);
    constexpr std::size_t kStep = static_cast<std::size_t>(kLanes) * kGroups;
    for (std::size_t i = 0; i < count; i += kStep) {
      Group<kGroups> x, y;
#pragma GCC unroll 4
      for (int b = 0; b < kGroups; ++b) {
        x.g[b] = local_lanes(u, i + b * kLanes, count, centre_u, scale_u);
        y.g[b] = local_lanes(v, i + b * kLanes, count, centre_v, scale_v);
      }
      HornerRows<Order, Value> rows;
      const auto push_row = [&](int j) PATCHPROOF_INLINE_LAMBDA {
        Horner<Order, Value> row;
        const double* from = coefficients + (j / 2) * row_length + (j & 1) * 4;
        if constexpr (kFixed) {
#pragma GCC unroll 16
          for (int k = 0; k <= DegreeU; ++k) row.push(k, Value::all(from + 8 * (DegreeU - k)), x);
        } else {
          for (int k = 0; k <= p; ++k) row.push(k, Value::all(from + 8 * (p - k)), x);
        }
        rows.push(q - j, row.d, y);
      };
      if constexpr (kFixed) {
#pragma GCC unroll 16
        for (int j = DegreeV; j >= 0; --j) push_row(j);
      } else {
        for (int j = q; j >= 0; --j) push_row(j);
      }
      SurfaceJet<Order, Value> jet = surface_jet<Order>(rows, factor_u, factor_v);
      if constexpr (Rational) {
#pragma GCC unroll 4
        for (int b = 0; b < kGroups; ++b)
          vanishing = hn::Or(vanishing, vanishes(jet.d[0].c[b][3].v, i + b * kLanes, count));
        jet = quotient<Order>(jet);
        if (!s.safe_weights)
          for (int b = 0; b < kGroups; ++b) vanishing = hn::Or(vanishing, overflowed(jet, b, i + b * kLanes, count));
      }
#pragma GCC unroll 4
      for (int b = 0; b < kGroups; ++b) {
        const std::size_t from = i + static_cast<std::size_t>(b) * kLanes;
        if (from < count) put_lanes<Order>(out, normal_scale, jet, b, at + from, count - from, undefined);
      }
    }
    return s.safe_weights || hn::AllFalse(D(), vanishing);
  }

  // One point at a time; `piece` are the numbers of their pieces.
  static HWY_NOINLINE bool scattered(const SurfacePieces& s, const std::int64_t* span_u, const std::int64_t* span_v,
                                     const double* x, const double* y, std::size_t count, std::size_t at,
                                     const SurfaceSinks& out, std::size_t& undefined) {
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    bool good = true;
    HWY_ALIGN double du[3][kTile];  // for the normals
    HWY_ALIGN double dv[3][kTile];
    for (std::size_t i = 0; i < count; ++i) {
      const double* coefficients = s.coefficients(span_u[i], span_v[i]);
      const Scalar local_x(x[i]), local_y(y[i]);
      HornerRows<Order, Quad> rows;
      const auto push_rows = [&](int pair) PATCHPROOF_INLINE_LAMBDA {
        Horner<Order, Octet> row;
        const double* from = coefficients + pair * row_length;
        if constexpr (kFixed) {
#pragma GCC unroll 16
          for (int k = 0; k <= DegreeU; ++k) row.push(k, Octet::load(from + 8 * (DegreeU - k)), local_x);
        } else {
          for (int k = 0; k <= p; ++k) row.push(k, Octet::load(from + 8 * (p - k)), local_x);
        }
        Quad half[Order + 1];
        if (2 * pair + 1 <= q) {
          for (int m = 0; m <= Order; ++m) half[m] = row.d[m].template half<1>();
          rows.push(q - (2 * pair + 1), half, local_y);
        }
        for (int m = 0; m <= Order; ++m) half[m] = row.d[m].template half<0>();
        rows.push(q - 2 * pair, half, local_y);
      };
      if constexpr (kFixed) {
#pragma GCC unroll 16
        for (int pair = DegreeV / 2; pair >= 0; --pair) push_rows(pair);
      } else {
        for (int pair = q / 2; pair >= 0; --pair) push_rows(pair);
      }
      SurfaceJet<Order, Quad> jet =
          surface_jet<Order>(rows, Scalar(s.u.scale[span_u[i]]), Scalar(s.v.scale[span_v[i]]));
      if constexpr (Rational) {
        if (!s.safe_weights) {
          double numbers[4];
          jet.d[0].store(numbers);
          good = good && (numbers[3] >= kSmallestWeight || numbers[3] <= -kSmallestWeight);
        }
        jet = quotient<Order>(jet);
        if (!s.safe_weights) good = good && !overflowed(jet);
      }
#pragma GCC unroll 6
      for (int m = 0; m < SurfaceJet<Order, Quad>::kCount; ++m) out.d[m].put(at + i, jet.d[m]);
      if constexpr (Order >= 1)
        if (out.normal.wanted()) {
          const PieceBounds& bounds = s.bounds[static_cast<std::size_t>(span_u[i] * s.v.count + span_v[i])];
          double a[4], b[4];
          scale(jet.d[1], Scalar(bounds.normal_scale_u)).store(a);
          scale(jet.d[2], Scalar(bounds.normal_scale_v)).store(b);
          for (int k = 0; k < 3; ++k) {
            du[k][i] = a[k];
            dv[k][i] = b[k];
          }
        }
    }
    if constexpr (Order >= 1)
      if (out.normal.wanted()) put_normals(du, dv, count, at, out, undefined);
    return good;
  }

  static void put_normals(const double (&du)[3][kTile], const double (&dv)[3][kTile], std::size_t count, std::size_t at,
                          const SurfaceSinks& out, std::size_t& undefined) {
    for (std::size_t i = 0; i < count; i += kLanes) {
      const int valid = count - i < static_cast<std::size_t>(kLanes) ? static_cast<int>(count - i) : kLanes;
      Lanes a[3], b[3], n[3];
      for (int k = 0; k < 3; ++k) {
        a[k] = hn::Load(D(), du[k] + i);
        b[k] = hn::Load(D(), dv[k] + i);
      }
      unit_normal(a, b, {Lanes(1.0), Lanes(1.0)}, n);  // scaled before
      undefined += undefined_among(n, valid);
      out.normal.put_some(at + i, n[0].v, n[1].v, n[2].v, valid);
    }
  }

  static Progress all(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v,
                      std::size_t count) {
    // Points alone are written fastest through the cache, more numbers past it.
    const SurfaceSinks out(call.out, count, Order > 0 && s.u.count == 1 && s.v.count == 1);
    std::size_t undefined = 0;
    Progress progress = for_tiles(
        s, call, u, v, count,
        [&](std::int64_t span_u, std::int64_t span_v, const double* us, const double* vs, std::size_t n,
            std::size_t at) { return run(s, span_u, span_v, us, vs, n, at, out, undefined); },
        [&](const std::int64_t* span_u, const std::int64_t* span_v, const double* x, const double* y, std::size_t n,
            std::size_t at) { return scattered(s, span_u, span_v, x, y, n, at, out, undefined); });
    progress.undefined_normals = undefined;
    hwy::FlushStream();  // streamed results are visible to whoever learns that the call has ended
    return progress;
  }
};

// The order of derivatives that a call needs.
inline int order_of(const SurfaceOutput& out) {
  if (out.duu.wanted() || out.duv.wanted() || out.dvv.wanted()) return 2;
  return out.du.wanted() || out.dv.wanted() || out.normal.wanted() ? 1 : 0;
}

// Calls f.operator()<Order, Rational, DegreeU, DegreeV>() with the constants of the call; common degrees have kernels of
// their own.
template <int Order, bool Rational, class F>
Progress with_degrees(const SurfacePieces& s, F f) {
  if (s.u.degree == 3 && s.v.degree == 3) return f.template operator()<Order, Rational, 3, 3>();
  if constexpr (kLanes >= 4 && Order < 2) {  // narrow vectors gain less than the code costs
    if (s.u.degree == 2 && s.v.degree == 2) return f.template operator()<Order, Rational, 2, 2>();
    if constexpr (!Rational) {
      if (s.u.degree == 5 && s.v.degree == 5) return f.template operator()<Order, Rational, 5, 5>();
      if (s.u.degree == 7 && s.v.degree == 7) return f.template operator()<Order, Rational, 7, 7>();
    }
  }
  return f.template operator()<Order, Rational, -1, -1>();
}
template <class F>
Progress with_constants(const SurfacePieces& s, int order, F f) {
  switch (order) {
    case 0: return s.rational ? with_degrees<0, true>(s, f) : with_degrees<0, false>(s, f);
    case 1: return s.rational ? with_degrees<1, true>(s, f) : with_degrees<1, false>(s, f);
    default: return s.rational ? with_degrees<2, true>(s, f) : with_degrees<2, false>(s, f);
  }
}

inline Progress surface(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v,
                        std::size_t count) {
  return with_constants(s, order_of(call.out), [&]<int Order, bool Rational, int P, int Q_>() {
    return SurfaceKernel<Order, Rational, P, Q_>::all(s, call, u, v, count);
  });
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
