// SPDX-License-Identifier: Apache-2.0
// Points as if computed in twice the precision and then rounded, and which of them are certainly the doubles nearest to
// the exact ones.
//
// Coefficients are high + low, the local parameter is the exact difference u − centre in two doubles. Horner's rule in
// the high parts, its rounding errors recovered exactly (two_sum, two_product) and summed by Horner's rule again.
// Bounds: error_bounds.h. A rounded sum s of value + correction is the double nearest to the exact number when adding
// either end of the correction's interval to s gives s again.
// SOURCE  S. Graillat, P. Langlois, N. Louvet, Algorithms for accurate, validated and fast polynomial evaluation, Japan J.
//         Indust. Appl. Math. 26 (2009); A. Ziv, Fast evaluation of elementary mathematical functions with correctly
//         rounded last bit, ACM TOMS 17 (1991).
#pragma once

#include "kernels/error_bounds.h"
#include "kernels/surface_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

// The error-free pair of one operation on vectors of any tag.
template <class Tag, class Vec = hn::Vec<Tag>>
PATCHPROOF_INLINE Vec two_sum(Tag, Vec a, Vec b, Vec& error) {
  const Vec sum = hn::Add(a, b), part = hn::Sub(sum, a);
  error = hn::Add(hn::Sub(a, hn::Sub(sum, part)), hn::Sub(b, part));
  return sum;
}
// a·b − product exactly, product = fl(a·b).
template <class Tag, class Vec = hn::Vec<Tag>>
PATCHPROOF_INLINE Vec product_error(Tag tag, Vec a, Vec b, Vec product) {
#if HWY_NATIVE_FMA
  (void)tag;
  return hn::MulSub(a, b, product);
#else
  // T. Dekker: halves of 26 bits. Factors above 2^996 overflow; the caller sees a result that is not finite.
  const Vec splitter = hn::Set(tag, 134217729.0);
  const auto split = [&](Vec x, Vec& low) {
    const Vec big = hn::Mul(x, splitter), high = hn::Sub(big, hn::Sub(big, x));
    low = hn::Sub(x, high);
    return high;
  };
  Vec a_low, b_low;
  const Vec a_high = split(a, a_low), b_high = split(b, b_low);
  const Vec rest =
      hn::Sub(hn::Sub(hn::Sub(product, hn::Mul(a_high, b_high)), hn::Mul(a_low, b_high)), hn::Mul(a_high, b_low));
  return hn::Sub(hn::Mul(a_low, b_low), rest);
#endif
}

// One number of Horner's rule in vectors of Tag: value + correction.
template <class Tag>
struct Compensated {
  hn::Vec<Tag> value = hn::Zero(Tag()), correction = hn::Zero(Tag());

  // ← this · (x + x_low) + (c + c_low)
  PATCHPROOF_INLINE void push(int k, hn::Vec<Tag> c, hn::Vec<Tag> c_low, hn::Vec<Tag> x, hn::Vec<Tag> x_low) {
    const Tag tag;
    if (k == 0) {
      value = c;
      correction = c_low;
      return;
    }
    hn::Vec<Tag> sum_error;
    const auto product = hn::Mul(value, x), rounding = product_error(tag, value, x, product);
    const auto next = two_sum(tag, product, c, sum_error);
    const auto rest = hn::MulAdd(value, x_low, hn::Add(hn::Add(rounding, sum_error), c_low));
    correction = hn::MulAdd(correction, x, rest);
    value = next;
  }
};

// The rounded point and, bit by bit, which coordinates are not certainly correctly rounded.
struct Rounded {
  Lanes point[3];
};

template <bool Rational>
PATCHPROOF_INLINE void round_points(const Compensated<D> (&sum)[4], const V (&bound)[4], Rounded& out,
                                    unsigned char* undecided, int count) {
  const D d;
  V high[4], low[4];
  for (int k = 0; k < (Rational ? 4 : 3); ++k) high[k] = two_sum(d, sum[k].value, sum[k].correction, low[k]);
  HWY_ALIGN std::uint64_t flags[kLanes];
  auto all_decided = hn::FirstN(d, kLanes);
  V inverse = hn::Zero(d), smallest = inverse;
  if constexpr (Rational) {
    inverse = hn::Div(hn::Set(d, 1.0), high[3]);
    smallest = hn::Sub(hn::Abs(high[3]), hn::MulAdd(hn::Abs(high[3]), hn::Set(d, 4 * kUnitRoundoff), bound[3]));
  }
  for (int k = 0; k < 3; ++k) {
    V s, t, reach;
    if constexpr (Rational) {
      // q = fl(A · (1/w)), then the rest of the quotient from the residue A − q w. Its terms are at most 2u|A|, u|A| and
      // u|q w|, their roundings at most 10u²|A|, the product with 1/w at most 8u²|q|, and 1/w for its high part 4u²|q|.
      const V q = hn::Mul(high[k], inverse), product = hn::Mul(q, high[3]);
      const V residue = hn::Sub(hn::Sub(high[k], product), product_error(d, q, high[3], product));
      const V rest = hn::Mul(hn::NegMulAdd(q, low[3], hn::Add(residue, low[k])), inverse);
      s = two_sum(d, q, rest, t);
      reach = hn::MulAdd(hn::Abs(q), hn::Set(d, 64 * kUnitRoundoff * kUnitRoundoff),
                         hn::Div(hn::MulAdd(hn::Abs(q), bound[3], bound[k]), smallest));
      reach = hn::IfThenElse(hn::Gt(smallest, hn::Zero(d)), reach, hn::Inf(d));
    } else {
      s = high[k];
      t = low[k];
      reach = bound[k];
    }
    // t ± reach is rounded itself.
    reach = hn::MulAdd(hn::Abs(t), hn::Set(d, 4 * kUnitRoundoff), hn::Mul(reach, hn::Set(d, kBoundSlack)));
    const auto decided = hn::And(hn::Eq(hn::Add(s, hn::Add(t, reach)), s), hn::Eq(hn::Add(s, hn::Sub(t, reach)), s));
    all_decided = hn::And(all_decided, decided);
    out.point[k] = hn::Add(s, hn::Zero(d));  // no −0
  }
  const V yes = hn::Set(d, 1.0);
  hn::Store(hn::BitCast(hn::RebindToUnsigned<D>(), hn::IfThenZeroElse(all_decided, yes)), hn::RebindToUnsigned<D>(),
            flags);
  for (int i = 0; i < count; ++i) undecided[i] = flags[i] != 0;
}

template <bool Rational, int DegreeU, int DegreeV>
struct CompensatedKernel {
  static constexpr bool kFixed = DegreeU >= 0;
  static constexpr int kNumbers = Rational ? 4 : 3;

  static HWY_NOINLINE bool run(const SurfacePieces& s, std::int64_t span_u, std::int64_t span_v, const double* u,
                               const double* v, std::size_t count, std::size_t at, const Sink& out,
                               unsigned char* undecided) {
    const D d;
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    const std::size_t number = static_cast<std::size_t>(span_u * s.v.count + span_v);
    const double *high = s.high.data() + number * s.piece, *low = s.low.data() + number * s.piece;
    V bound[4];
    for (int k = 0; k < 4; ++k) bound[k] = hn::Set(d, s.bounds[number].compensated[k]);
    const V centre_u = hn::Set(d, s.u.centre[span_u]), scale_u = hn::Set(d, s.u.scale[span_u]);
    const V centre_v = hn::Set(d, s.v.centre[span_v]), scale_v = hn::Set(d, s.v.scale[span_v]);
    const auto local = [&](const double* t, std::size_t i, V centre, V scale, V& x_low) {
      const bool whole = count - i >= static_cast<std::size_t>(kLanes);
      const V at_t =
          whole ? hn::LoadU(d, t + i) : hn::IfThenElse(hn::FirstN(d, count - i), load_some(t + i, count - i), centre);
      const V difference = two_sum(d, at_t, hn::Neg(centre), x_low);
      x_low = hn::Mul(x_low, scale);
      return hn::Mul(difference, scale);
    };
    for (std::size_t i = 0; i < count; i += kLanes) {
      V x_low, y_low;
      const V x = local(u, i, centre_u, scale_u, x_low), y = local(v, i, centre_v, scale_v, y_low);
      Compensated<D> sum[4];
      for (int j = q; j >= 0; --j) {
        const std::size_t from = static_cast<std::size_t>(j / 2) * row_length + static_cast<std::size_t>(j & 1) * 4;
        Compensated<D> row[4];
#pragma GCC unroll 4
        for (int k = 0; k <= p; ++k)
#pragma GCC unroll 4
          for (int c = 0; c < kNumbers; ++c)
            row[c].push(k, hn::Set(d, high[from + 8 * (p - k) + c]), hn::Set(d, low[from + 8 * (p - k) + c]), x, x_low);
#pragma GCC unroll 4
        for (int c = 0; c < kNumbers; ++c) sum[c].push(q - j, row[c].value, row[c].correction, y, y_low);
      }
      Rounded result;
      const int valid = count - i < static_cast<std::size_t>(kLanes) ? static_cast<int>(count - i) : kLanes;
      round_points<Rational>(sum, bound, result, undecided + at + i, valid);
      if (valid == kLanes)
        out.put(at + i, result.point[0].v, result.point[1].v, result.point[2].v);
      else
        out.put_some(at + i, result.point[0].v, result.point[1].v, result.point[2].v, valid);
    }
    return true;  // a denominator near zero leaves its points undecided
  }

  // One point at a time in quads; the last step by lanes.
  static HWY_NOINLINE bool scattered(const SurfacePieces& s, const std::int64_t* span_u, const std::int64_t* span_v,
                                     const double* u, const double* v, std::size_t count, std::size_t at,
                                     const Sink& out, unsigned char* undecided) {
    const int p = kFixed ? DegreeU : s.u.degree, q = kFixed ? DegreeV : s.v.degree;
    const std::size_t row_length = kFixed ? 8 * (DegreeU + 1) : s.row;
    HWY_ALIGN double value[4][kTile];
    HWY_ALIGN double correction[4][kTile];
    HWY_ALIGN double bounds[4][kTile];
    const auto difference = [](double t, double centre, double scale, double& low) {
      const double sum = t - centre, part = sum - t;
      low = ((t - (sum - part)) + (-centre - part)) * scale;
      return sum * scale;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t number = static_cast<std::size_t>(span_u[i] * s.v.count + span_v[i]);
      const double *high = s.high.data() + number * s.piece, *low = s.low.data() + number * s.piece;
      double x_low, y_low;
      const double x = difference(u[i], s.u.centre[span_u[i]], s.u.scale[span_u[i]], x_low);
      const double y = difference(v[i], s.v.centre[span_v[i]], s.v.scale[span_v[i]], y_low);
      const auto x8 = hn::Set(O(), x), x8_low = hn::Set(O(), x_low);
      const auto y4 = hn::Set(Q(), y), y4_low = hn::Set(Q(), y_low);
      Compensated<Q> sum[kQuadParts];
      for (int pair = q / 2; pair >= 0; --pair) {
        const std::size_t from = static_cast<std::size_t>(pair) * row_length;
        Compensated<O> row[kOctetParts];
#pragma GCC unroll 4
        for (int k = 0; k <= p; ++k)
#pragma GCC unroll 8
          for (int c = 0; c < kOctetParts; ++c) {
            const std::size_t place = from + 8 * (p - k) + c * kOctetLanes;
            row[c].push(k, hn::LoadU(O(), high + place), hn::LoadU(O(), low + place), x8, x8_low);
          }
        Octet values, corrections;
        for (int c = 0; c < kOctetParts; ++c) {
          values.part[c] = row[c].value;
          corrections.part[c] = row[c].correction;
        }
        const auto push = [&](int j, const Quad& r, const Quad& e) {
          for (int c = 0; c < kQuadParts; ++c) sum[c].push(q - j, r.part[c], e.part[c], y4, y4_low);
        };
        if (2 * pair + 1 <= q) push(2 * pair + 1, values.half<1>(), corrections.half<1>());
        push(2 * pair, values.half<0>(), corrections.half<0>());
      }
      Quad r, e;
      for (int c = 0; c < kQuadParts; ++c) {
        r.part[c] = sum[c].value;
        e.part[c] = sum[c].correction;
      }
      double values[4], corrections[4];
      r.store(values);
      e.store(corrections);
      for (int k = 0; k < 4; ++k) {
        value[k][i] = values[k];
        correction[k][i] = corrections[k];
        bounds[k][i] = s.bounds[number].compensated[k];
      }
    }
    for (std::size_t i = 0; i < count; i += kLanes) {
      const int valid = count - i < static_cast<std::size_t>(kLanes) ? static_cast<int>(count - i) : kLanes;
      Compensated<D> sum[4];
      V bound[4];
      for (int k = 0; k < 4; ++k) {
        sum[k] = {hn::LoadU(D(), value[k] + i), hn::LoadU(D(), correction[k] + i)};
        bound[k] = hn::LoadU(D(), bounds[k] + i);
      }
      Rounded result;
      round_points<Rational>(sum, bound, result, undecided + at + i, valid);
      out.put_some(at + i, result.point[0].v, result.point[1].v, result.point[2].v, valid);
    }
    return true;
  }

  static Progress all(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v,
                      std::size_t count, unsigned char* undecided) {
    const Sink out(call.out.point, 0, false);
    return for_tiles(
        s, call, u, v, count,
        [&](std::int64_t span_u, std::int64_t span_v, const double* us, const double* vs, std::size_t n,
            std::size_t at) { return run(s, span_u, span_v, us, vs, n, at, out, undecided); },
        [&](const std::int64_t* span_u, const std::int64_t* span_v, const double*, const double*, std::size_t n,
            std::size_t at) { return scattered(s, span_u, span_v, u + at, v + at, n, at, out, undecided); });
  }
};

inline Progress compensated(const SurfacePieces& s, const SurfaceCall& call, const double* u, const double* v,
                            std::size_t count, unsigned char* undecided) {
  const bool cubic = s.u.degree == 3 && s.v.degree == 3;
  if (s.rational)
    return cubic ? CompensatedKernel<true, 3, 3>::all(s, call, u, v, count, undecided)
                 : CompensatedKernel<true, -1, -1>::all(s, call, u, v, count, undecided);
  return cubic ? CompensatedKernel<false, 3, 3>::all(s, call, u, v, count, undecided)
               : CompensatedKernel<false, -1, -1>::all(s, call, u, v, count, undecided);
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
