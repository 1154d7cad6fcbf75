// SPDX-License-Identifier: Apache-2.0
// Bodies of the two banded products, in highway's namespace of the instruction set that the including file is compiled
// for, so that no two sets share a function.
//
// Along v first. Two lines of the old net at a time are laid side by side, eight numbers for a pair of points (x y z w
// of both), so that a row of the band is one vector times a number for each tap. The refined lines go into a ring, from
// which each line of the result is summed along u, a whole line of numbers with a few factors: both directions stream.
// Each sum is c_0 x_0, then c_k x_k added by fused multiply-add in the order of k, in every place and on every path.
#pragma once

#include "hwy/highway.h"
#include "kernels/refine/refine.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::refine::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using Pair = hn::CappedTag<double, 8>;
using Quad = hn::CappedTag<double, 4>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
constexpr int kPairLanes = static_cast<int>(hn::MaxLanes(Pair())), kPairParts = 8 / kPairLanes;

// Two neighbouring lines of the old net, points [begin, end), side by side.
template <bool Rational>
HWY_INLINE void lay_pair(const Job& job, int line, int begin, int end, double* pair) {
  for (int half = 0; half < 2; ++half) {
    const int own = line + half < job.count_u ? line + half : line;  // the last line stands beside itself
    const std::size_t at = static_cast<std::size_t>(own) * job.count_v;
    const double* from = job.points + 3 * at;
    double* to = pair + 4 * half;
    for (int j = begin; j < end; ++j, to += 8) {
      const double w = Rational ? job.weights[at + j] : 0;
      for (int c = 0; c < 3; ++c) to[c] = Rational ? w * from[3 * j + c] : from[3 * j + c];
      to[3] = w;
    }
  }
}

// Two lines' worth of one refined point. When a point has 3 numbers the next point, or nobody, covers the fourth.
HWY_INLINE void store_pair(const hn::Vec<Pair>* sum, double* line0, double* line1) {
#if HWY_CAP_GE512
  const Quad q;
  hn::StoreU(hn::LowerHalf(q, sum[0]), q, line0);
  hn::StoreU(hn::UpperHalf(q, sum[0]), q, line1);
#else
  const Pair d;
  for (int i = 0; i < kPairParts / 2; ++i) hn::StoreU(sum[i], d, line0 + i * kPairLanes);
  for (int i = 0; i < kPairParts / 2; ++i) hn::StoreU(sum[kPairParts / 2 + i], d, line1 + i * kPairLanes);
#endif
}

// Rows [begin, end) of the band times the pair whose first point is `old`. Taps 0: as many as the band says.
template <int Taps, int Size>
HWY_INLINE void refine_pair(const Band& band, int begin, int end, const double* pair, int old, double* line0,
                            double* line1) {
  const Pair d;
  const int taps = Taps > 0 ? Taps : band.taps;
  const double* a = band.coefficients + static_cast<std::size_t>(begin) * taps;
  hn::Vec<Pair> sum[kPairParts];
  if constexpr (Taps > 0) {
    if (end - begin == Taps && band.first[begin] == band.first[end - 1]) {  // a Bézier piece: read its points once
      const double* x = pair + 8 * (band.first[begin] - old);
      hn::Vec<Pair> points[Taps][kPairParts];
      for (int k = 0; k < Taps; ++k)
        for (int i = 0; i < kPairParts; ++i) points[k][i] = hn::LoadU(d, x + 8 * k + i * kPairLanes);
      for (int j = 0; j < Taps; ++j, a += Taps) {
        for (int i = 0; i < kPairParts; ++i) sum[i] = hn::Mul(hn::Set(d, a[0]), points[0][i]);
        for (int k = 1; k < Taps; ++k)
          for (int i = 0; i < kPairParts; ++i) sum[i] = hn::MulAdd(hn::Set(d, a[k]), points[k][i], sum[i]);
        store_pair(sum, line0 + Size * j, line1 + Size * j);
      }
      return;
    }
  }
  for (int j = begin; j < end; ++j, a += taps, line0 += Size, line1 += Size) {
    const double* x = pair + 8 * (band.first[j] - old);
    const auto a0 = hn::Set(d, a[0]);
    for (int i = 0; i < kPairParts; ++i) sum[i] = hn::Mul(a0, hn::LoadU(d, x + i * kPairLanes));
    for (int k = 1; k < taps; ++k) {
      const auto ak = hn::Set(d, a[k]);
      for (int i = 0; i < kPairParts; ++i) sum[i] = hn::MulAdd(ak, hn::LoadU(d, x + 8 * k + i * kPairLanes), sum[i]);
    }
    store_pair(sum, line0, line1);
  }
}

// A number that fills a vector, filling one of the other size.
HWY_INLINE hn::Vec<D> same_in(D, hn::Vec<D> x) { return x; }
#if HWY_CAP_GE512
HWY_INLINE hn::Vec<Quad> same_in(Quad q, hn::Vec<D> x) { return hn::LowerHalf(q, x); }
#endif

// to[x] = Σ_k a_k lines[k][x] for x < size, for Rows rows of coefficients, whose results lie `stride` apart. The lines
// may be read a vector beyond their end. Taps 0: as many as `taps` says.
template <int Rows, int Taps>
struct LineSums {
  const double* const* lines;
  const double* a;
  int taps;
  std::size_t stride;
  const double* own[Taps > 0 ? Taps : 1];  // lines, where vector stores cannot be taken to change them
  hn::Vec<D> factor[Taps > 0 ? Rows : 1][Taps > 0 ? Taps : 1];

  HWY_INLINE LineSums(const double* const* from, const double* coefficients, int count, std::size_t apart)
      : lines(from), a(coefficients), taps(Taps > 0 ? Taps : count), stride(apart) {
    if constexpr (Taps > 0) {
      for (int k = 0; k < Taps; ++k) own[k] = lines[k];
      for (int r = 0; r < Rows; ++r)
        for (int k = 0; k < Taps; ++k) factor[r][k] = hn::Set(D(), a[r * Taps + k]);
    }
  }
  // All rows at the numbers from x on, as many as there are in a vector of Tag.
  template <class Tag>
  HWY_INLINE void at(Tag d, int x, double* to) const {
    if constexpr (Taps > 0) {
      hn::Vec<Tag> in[Taps];
      for (int k = 0; k < Taps; ++k) in[k] = hn::LoadU(d, own[k] + x);
      for (int r = 0; r < Rows; ++r) {
        auto sum = hn::Mul(same_in(d, factor[r][0]), in[0]);
        for (int k = 1; k < Taps; ++k) sum = hn::MulAdd(same_in(d, factor[r][k]), in[k], sum);
        hn::StoreU(sum, d, to + r * stride);
      }
    } else {
      auto sum = hn::Mul(hn::Set(d, a[0]), hn::LoadU(d, lines[0] + x));
      for (int k = 1; k < taps; ++k) sum = hn::MulAdd(hn::Set(d, a[k]), hn::LoadU(d, lines[k] + x), sum);
      hn::StoreU(sum, d, to);
    }
  }
  HWY_INLINE void operator()(int from, int size, double* to) const {
    const D d;
    int x = 0;
    for (; x + kLanes <= size; x += kLanes) at(d, from + x, to + x);
#if HWY_CAP_GE512
    if (x + 4 <= size) {
      at(Quad(), from + x, to + x);
      x += 4;
    }
#endif
    if (x == size) return;
    if (size >= kLanes) return at(d, from + size - kLanes, to + size - kLanes);  // once more some of those before
    if constexpr (kLanes > 1) {
      double last[Rows][kLanes];
      LineSums other = *this;
      other.stride = kLanes;
      other.at(d, from + x, last[0]);
      for (int r = 0; r < Rows; ++r)
        for (int i = 0; x + i < size; ++i) to[r * stride + x + i] = last[r][i];
    }
  }
};

// The columns of the result that are refined together: `chunks` pieces along v, or a part of one piece.
struct Columns {
  int begin = 0, rows = 0, chunks = 0;  // rows of each chunk
  int old = 0, old_end = 0;             // the old points they need
};

template <int TapsU, int TapsV, bool Rational>
HWY_INLINE void refine_columns(const Job& job, const Columns& c) {
  constexpr int kSize = Rational ? 4 : 3;
  const Band &u = job.u, &v = job.v;
  const int slots = ring_lines(u.taps), padded = padded_size(c.rows * kSize);
  const std::size_t apart = line_size(v, kSize);
  double *ring = job.scratch, *pair = ring + slots * apart;
  const auto slot = [&](int line) HWY_ATTR { return ring + (line & (slots - 1)) * apart; };

  const std::size_t line_size = static_cast<std::size_t>(v.group) * kSize, piece_size = u.group * line_size;
  const int piece_v = c.begin / v.group;
  double* to = job.out + piece_v * piece_size + static_cast<std::size_t>(c.begin - piece_v * v.group) * kSize;
  const std::size_t pieces_v = v.rows / v.group;

  int ready = 0;
  const auto make_ready = [&](int lines) HWY_ATTR {
    for (; ready < lines; ready += 2) {
      lay_pair<Rational>(job, ready, c.old, c.old_end, pair);
      for (int k = 0; k < c.chunks; ++k) {
        const int begin = c.begin + k * c.rows;
        refine_pair<TapsV, kSize>(v, begin, begin + c.rows, pair, c.old, slot(ready) + k * padded,
                                  slot(ready + 1) + k * padded);
      }
    }
  };
  const auto sum_rows = [&](const auto& sums, double* line) HWY_ATTR {
    for (int k = 0; k < c.chunks; ++k) sums(k * padded, c.rows * kSize, line + k * piece_size);
  };
  for (int i = 0; i < u.rows; to += (pieces_v - 1) * piece_size)  // piece by piece along u
    for (const int piece_end = i + u.group; i < piece_end;) {
      make_ready(u.first[i] + u.taps);
      for (int k = 0; k < u.taps; ++k) job.lines[k] = slot(u.first[i] + k);
      const double* a = u.coefficients + static_cast<std::size_t>(i) * u.taps;
      if constexpr (TapsU > 0) {
        if (i + TapsU <= piece_end && u.first[i] == u.first[i + TapsU - 1]) {  // a Bézier piece
          sum_rows(LineSums<TapsU, TapsU>(job.lines, a, TapsU, line_size), to);
          i += TapsU;
          to += TapsU * line_size;
          continue;
        }
      }
      sum_rows(LineSums<1, TapsU>(job.lines, a, u.taps, line_size), to);
      ++i;
      to += line_size;
    }
}

// Tiles of whole pieces when these are short (one needs no more old points than there is room for: those of a Bézier
// piece are v.taps, an insertion has no more old points than new), otherwise of parts of a piece.
template <int TapsU, int TapsV, bool Rational>
void refine_tiles(const Job& job) {
  const Band& v = job.v;
  const bool whole = v.group <= kTileRows;
  const int step = whole ? v.group : 1;
  for (int begin = 0; begin < v.rows;) {
    const int last = whole ? v.rows : (begin / v.group + 1) * v.group;
    int end = begin + step;
    while (end + step <= last && end + step - begin <= kTileRows &&
           v.first[end + step - 1] + v.taps - v.first[begin] <= tile_points(v.taps))
      end += step;
    Columns c;
    c.begin = begin;
    c.rows = whole ? v.group : end - begin;
    c.chunks = whole ? (end - begin) / v.group : 1;
    c.old = v.first[begin];
    c.old_end = v.first[end - 1] + v.taps;
    refine_columns<TapsU, TapsV, Rational>(job, c);
    begin = end;
  }
}

template <int Taps>
void refine_with(const Job& job) {
  const bool both = job.u.taps == Taps;
  if (job.weights != nullptr)
    both ? refine_tiles<Taps, Taps, true>(job) : refine_tiles<0, Taps, true>(job);
  else
    both ? refine_tiles<Taps, Taps, false>(job) : refine_tiles<0, Taps, false>(job);
}

inline void refine(const Job& job) {
  switch (job.v.taps) {
    case 2: return refine_with<2>(job);
    case 3: return refine_with<3>(job);
    case 4: return refine_with<4>(job);
    case 6: return refine_with<6>(job);
    default: return job.weights != nullptr ? refine_tiles<0, 0, true>(job) : refine_tiles<0, 0, false>(job);
  }
}

inline double largest(const double* x, std::size_t count) {
  const D d;
  const hn::RebindToSigned<D> whole;
  auto most = hn::Zero(whole);  // as whole numbers |x| are ordered alike, and NaN is above all
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) most = hn::Max(most, hn::BitCast(whole, hn::Abs(hn::LoadU(d, x + i))));
  double parts[kLanes], out = 0;
  hn::StoreU(hn::BitCast(d, most), d, parts);
  for (int k = 0; k < kLanes; ++k) out = out != out || parts[k] <= out ? out : parts[k];
  for (; i < count; ++i) {
    const double size = x[i] < 0 ? -x[i] : x[i];
    out = out != out || size <= out ? out : size;
  }
  return out;
}

constexpr Table table() { return {&refine, &largest}; }

}  // namespace patchproof::kernels::refine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
