// SPDX-License-Identifier: Apache-2.0
// Doubles as whole numbers times one power of two, and how far this is exact. Included by decide_lanes.h.
//
//   short  y = x · scale is whole, |y| < 2^53
//   long   x + error, the exact value of a rounded x, is (high · 2^split + low) / (scale · 2^split) with whole high,
//          |high| ≤ 2^53, and whole low, |low| ≤ 2^split ≤ 2^50
// Scales by powers of two are exact unless the result underflows; then scaling back does not give the same.
#pragma once

#include "join/decide_rational_forms.h"

namespace patchproof::kernels::lanes {

using namespace patchproof::decide;

// Of differences: anything decide_fixed_g1 takes. Of points that weights multiply: both together are to fit its 123
// bits.
constexpr int kSplit = 50, kSplitOfProducts = 8;

template <class L, int Size>
struct Whole {
  typename L::D high[Size], low[Size];
};

// Bits are left in `seen` for lanes with an entry that is not short. REQUIRES they are in range.
template <class L, int Size>
typename L::I see_long(typename L::I seen, const typename L::D (&x)[Size], const typename L::D (&scaled)[Size],
                       const Scale<L>& scale) {
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i) seen = L::differences(seen, L::multiply(L::round(scaled[i]), scale.down), x[i]);
  return seen;
}
template <class L, int Size>
void take_short(const typename L::D (&scaled)[Size], Whole<L, Size>& out) {
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i) out.high[i] = scaled[i];
}

// high = round(y), low = (y − high) 2^split, |low| ≤ 2^(split−1): the difference is exact, as high is one of the two
// whole numbers next to y or y itself.
template <class L, int Size>
unsigned split_long(const typename L::D (&x)[Size], const typename L::D (&scaled)[Size], const Scale<L>& scale,
                    int split, Whole<L, Size>& out) {
  using D = typename L::D;
  const D up = L::constant(static_cast<double>(1LL << split));
  unsigned whole = L::kAll;
  for (int i = 0; i < Size; ++i) {
    out.high[i] = L::round(scaled[i]);
    out.low[i] = L::multiply(L::subtract(scaled[i], out.high[i]), up);
    whole &= L::equal(L::round(out.low[i]), out.low[i]) & L::equal(L::multiply(scaled[i], scale.down), x[i]);
  }
  return whole;
}
// Adds |error| ≤ ulp(x) / 2, so that |error · scale · 2^split| ≤ 2^(split−1).
template <class L, int Size>
unsigned add_errors(const typename L::D (&error)[Size], const Scale<L>& scale, int split, Whole<L, Size>& out) {
  using D = typename L::D;
  const D two = L::constant(static_cast<double>(1LL << split));
  const D up = L::multiply(scale.up, two),
          down = L::multiply(scale.down, L::constant(1.0 / static_cast<double>(1LL << split)));
  unsigned whole = L::kAll;
  for (int i = 0; i < Size; ++i) {
    const D low = L::round(L::multiply(error[i], up));
    whole &= L::equal(L::multiply(low, down), error[i]);
    out.low[i] = L::add(out.low[i], low);
  }
  return whole;
}
// 2^this divides all numbers of all lanes (of lanes that are not whole, what rounding leaves: then it may be less):
// short ones, or long ones by their low parts.
template <class L, int Size>
int common_zeros(const Whole<L, Size>& w, bool is_long, int split) {
  typename L::I bits = L::no_bits();
  if (is_long) {
    for (int i = 0; i < Size; ++i) bits = L::collect_small_bits(bits, w.low[i]);
    return L::trailing_zeros(bits, split);
  }
#pragma GCC unroll 36
  for (int i = 0; i < Size; ++i) bits = L::collect_bits(bits, w.high[i]);
  return L::trailing_zeros(bits, L::kZerosSeen);
}

// Bits are left in `seen` when d = fl(a − e) is not exact, see is_middle; and sometimes for a zero's sign.
template <class L>
typename L::I see_rounding(typename L::I seen, typename L::D d, typename L::D a, typename L::D e) {
  return L::differences(L::differences(seen, L::add(d, e), a), L::subtract(a, d), e);
}
// (a − e) − d, exactly: D. E. Knuth, The Art of Computer Programming 2, 4.2.2.
template <class L>
typename L::D difference_error(typename L::D d, typename L::D a, typename L::D e) {
  const typename L::D z = L::subtract(d, a);
  return L::subtract(L::subtract(a, L::subtract(d, z)), L::add(e, z));
}

}  // namespace patchproof::kernels::lanes
