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

// Local coordinates of kLanes parameters; those beyond the end get the centre.
PATCHPROOF_INLINE V local_lanes(const double* t, std::size_t from, std::size_t count, V centre, V scale) {
  if (from + kLanes <= count) return hn::Mul(hn::Sub(hn::LoadU(D(), t + from), centre), scale);
  if (from >= count) return hn::Zero(D());
  const auto valid = hn::FirstN(D(), count - from);
  return hn::Mul(hn::IfThenElseZero(valid, hn::Sub(load_some(t + from, count - from), centre)), scale);
}

// |w| below this (weights are scaled to at most 1) is taken for a zero of the denominator.
constexpr double kSmallestWeight = 0x1p-900;
// Of lanes that hold parameters from, from + 1, …, those before `count`.
PATCHPROOF_INLINE auto vanishes(V weight, std::size_t from, std::size_t count) {
  const std::size_t left = from < count ? count - from : 0;
  const auto valid = hn::FirstN(D(), left < static_cast<std::size_t>(kLanes) ? left : kLanes);
  return hn::AndNot(hn::Ge(hn::Abs(weight), hn::Set(D(), kSmallestWeight)), valid);
}

// The quotient is no number in double, of the lanes as above (the denominator was not zero, but next to nothing).
template <class Jet>
PATCHPROOF_INLINE auto overflowed(const Jet& jet, int group, std::size_t from, std::size_t count) {
  V zero_or_nan = hn::Zero(D());  // 0 · x is 0 for numbers only
  for (const auto& vector : jet.d)
    for (int k = 0; k < 3; ++k) zero_or_nan = hn::MulAdd(vector.c[group][k].v, hn::Zero(D()), zero_or_nan);
  const std::size_t left = from < count ? count - from : 0;
  return hn::AndNot(hn::Eq(zero_or_nan, hn::Zero(D())),
                    hn::FirstN(D(), left < static_cast<std::size_t>(kLanes) ? left : kLanes));
}
template <class Jet>
PATCHPROOF_INLINE bool overflowed(const Jet& jet) {
  double zero_or_nan = 0;
  for (const Quad& vector : jet.d) {
    double numbers[4];
    vector.store(numbers);
    for (int k = 0; k < 3; ++k) zero_or_nan += numbers[k] * 0;
  }
  return zero_or_nan != 0;
}

// Steps: a constant, or −1: axis.steps.
template <int Steps>
void locate_with(const Axis& axis, bool from_left, const double* t, std::size_t count, std::int64_t* span, double* x) {
  const double *begins = axis.begins(from_left), *centre = axis.centre.data(), *scale = axis.scale.data();
  const std::int64_t* first = axis.first.data();
  const double origin = axis.begin, per_unit = axis.per_unit;
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t s = first[static_cast<std::int64_t>((t[i] - origin) * per_unit)];
    for (int step = 0; step < (Steps >= 0 ? Steps : axis.steps); ++step) s += t[i] >= begins[s + 1];
    span[i] = s;
    x[i] = (t[i] - centre[s]) * scale[s];
  }
}
// REQUIRES parameters in the domain, count ≤ kTile. One at a time: a few dependent loads from small tables each, which
// processors overlap well; their gather instructions are slower where they are microcode.
inline void locate(const Axis& axis, bool from_left, const double* t, std::size_t count, std::int64_t* span,
                   double* x) {
  switch (axis.steps) {
    case 0: return locate_with<0>(axis, from_left, t, count, span, x);
    case 1: return locate_with<1>(axis, from_left, t, count, span, x);
    default: return locate_with<-1>(axis, from_left, t, count, span, x);
  }
}

// The span that holds all of the parameters, or −1: that of the smallest one, if it is that of the largest.
inline std::int64_t common_span(const Axis& axis, bool from_left, const double* t, std::size_t count) {
  double ends[2] = {t[0], t[0]};
  std::size_t i = 0;
  if (count >= static_cast<std::size_t>(kLanes)) {
    V low = hn::LoadU(D(), t), high = low;
    for (i = kLanes; i + kLanes <= count; i += kLanes) {
      low = hn::Min(low, hn::LoadU(D(), t + i));
      high = hn::Max(high, hn::LoadU(D(), t + i));
    }
    HWY_ALIGN double lows[kLanes];
    HWY_ALIGN double highs[kLanes];
    hn::Store(low, D(), lows);
    hn::Store(high, D(), highs);
    for (int k = 0; k < kLanes; ++k) {
      if (lows[k] < ends[0]) ends[0] = lows[k];
      if (highs[k] > ends[1]) ends[1] = highs[k];
    }
  }
  for (; i < count; ++i) {
    if (t[i] < ends[0]) ends[0] = t[i];
    if (t[i] > ends[1]) ends[1] = t[i];
  }
  std::int64_t span[2];
  double x[2];
  locate(axis, from_left, ends, 2, span, x);
  return span[0] == span[1] ? span[0] : -1;
}

// Do runs of one piece cover most of a tile?
PATCHPROOF_INLINE bool mostly_runs(const std::int64_t* piece, std::size_t count) {
  std::int64_t equal = 0;
  for (std::size_t i = 1; i < count; ++i) equal += piece[i] == piece[i - 1];
  return 2 * static_cast<std::size_t>(equal) >= count;
}

// The length of the run of equal numbers that begins at `first`.
PATCHPROOF_INLINE std::size_t run_length(const std::int64_t* number, std::size_t first, std::size_t count) {
  std::size_t end = first + 1;
  while (end < count && number[end] == number[first]) ++end;
  return end - first;
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
