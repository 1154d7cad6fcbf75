// SPDX-License-Identifier: Apache-2.0
// Which span each parameter lies in, and its local coordinate.
#pragma once

#include "kernels/lanes.h"
#include "kernels/pieces.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

// Parameters are taken in tiles, whose spans and local coordinates stay in the first cache.
constexpr std::size_t kTile = 256;

// The number of leading parameters that lie in the domain.
inline std::size_t count_inside(const Axis& axis, const double* t, std::size_t count) {
  const V begin = hn::Set(D(), axis.begin), end = hn::Set(D(), axis.end);
  const auto inside = [&](V x) { return hn::And(hn::Ge(x, begin), hn::Le(x, end)); };  // false for NaN
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    if (!hn::AllTrue(D(), inside(hn::LoadU(D(), t + i)))) break;
  for (; i < count; ++i)
    if (!(t[i] >= axis.begin && t[i] <= axis.end)) break;
  return i;
}

// REQUIRES parameters in the domain, count ≤ kTile; room for kTile numbers; writes whole vectors.
inline void locate(const Axis& axis, bool from_left, const double* t, std::size_t count, std::int64_t* span,
                   double* x) {
  using I = hn::RebindToSigned<D>;
  const double* begins = axis.begins(from_left);
  const V magic = hn::Set(D(), 0x1p52), origin = hn::Set(D(), axis.begin), per_unit = hn::Set(D(), axis.per_unit);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const std::size_t left = count - i;
    const V at = left >= static_cast<std::size_t>(kLanes)
                     ? hn::LoadU(D(), t + i)
                     : hn::IfThenElse(hn::FirstN(D(), left), hn::MaskedLoad(hn::FirstN(D(), left), D(), t + i), origin);
    // Rounded to a whole number by the addition: any monotone index serves.
    const V rounded = hn::Add(hn::Mul(hn::Sub(at, origin), per_unit), magic);
    const auto bucket = hn::Sub(hn::BitCast(I(), rounded), hn::BitCast(I(), magic));
    auto s = hn::GatherIndex(I(), axis.first.data(), bucket);
    for (int step = 0; step < axis.steps; ++step) {
      const V next = hn::GatherIndex(D(), begins + 1, s);
      s = hn::Sub(s, hn::BitCast(I(), hn::VecFromMask(D(), hn::Ge(at, next))));  // a true mask is −1
    }
    hn::StoreU(s, I(), span + i);
    const V centre = hn::GatherIndex(D(), axis.centre.data(), s), scale = hn::GatherIndex(D(), axis.scale.data(), s);
    hn::StoreU(hn::Mul(hn::Sub(at, centre), scale), D(), x + i);
  }
}

// The length of the run of equal numbers that begins at `first`.
PATCHPROOF_INLINE std::size_t run_length(const std::int64_t* number, std::size_t first, std::size_t count) {
  std::size_t end = first + 1;
  while (end < count && number[end] == number[first]) ++end;
  return end - first;
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
