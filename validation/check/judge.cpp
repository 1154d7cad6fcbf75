// SPDX-License-Identifier: Apache-2.0
#include "validation/check/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace patchproof::validation {

std::string hex(double x) { return fmt::format("{:a} = {}", x, x); }

void merge(Tally& into, const Tally& more) {
  into.numbers += more.numbers;
  into.without_bound += more.without_bound;
  into.worst_ulp = std::max(into.worst_ulp, more.worst_ulp);
  into.worst_vector_ulp = std::max(into.worst_vector_ulp, more.worst_vector_ulp);
  if (more.worst_ratio > into.worst_ratio) {
    into.worst_ratio = more.worst_ratio;
    into.worst_place = more.worst_place;
  }
  if (into.violations == 0) into.violation = more.violation;
  into.violations += more.violations;
}

void Judge::record(const Deviation& d, bool holds, double ratio, const std::function<std::string()>& place,
                   const std::string& what) const {
  ++tally_.numbers;
  tally_.worst_ulp = std::max(tally_.worst_ulp, in_ulps(d, exact_));
  tally_.worst_vector_ulp = std::max(tally_.worst_vector_ulp, in_ulps(d, largest_));
  if (ratio > tally_.worst_ratio) {
    tally_.worst_ratio = ratio;
    tally_.worst_place = place();
  }
  if (holds) return;
  if (tally_.violations++ == 0)
    tally_.violation = fmt::format("{}: {}, exact {}", place(), what, hex(nearest_double(exact_)));
}

void Judge::number(double computed, double bound, const std::function<std::string()>& place) const {
  if (overflows(exact_)) return;
  const Deviation d = deviation(computed, exact_);
  if (std::isinf(bound)) {  // nothing is promised but a number or an error
    ++tally_.without_bound;
    return record(d, d.is_finite, 0, place, fmt::format("computed {}, not even a number", computed));
  }
  const bool holds = d.is_finite && bound >= 0 && d.modulus <= from_double(bound);
  const double ratio = d.modulus == Rational(0) ? 0 : bound > 0 ? nearest_double(d.modulus / from_double(bound)) : 1;
  record(d, holds, ratio, place, fmt::format("computed {}, bound {}", hex(computed), hex(bound)));
}

void Judge::enclosure(double lower, double upper, const std::function<std::string()>& place) const {
  if (overflows(exact_)) return;
  const auto what = [&] { return fmt::format("enclosure [{}, {}]", hex(lower), hex(upper)); };
  if (std::isnan(lower) || std::isnan(upper)) return record({false, Rational(0)}, false, 0, place, what());
  if (std::isinf(lower) || std::isinf(upper)) {
    const bool holds = (std::isinf(lower) ? lower < 0 : from_double(lower) <= exact_) &&
                       (std::isinf(upper) ? upper > 0 : from_double(upper) >= exact_);
    ++tally_.without_bound;
    return record({true, Rational(0)}, holds, 0, place, what());
  }
  const Rational a = from_double(lower), b = from_double(upper), half = (b - a) / Rational(2);
  const Deviation from_middle = deviation(0, Rational((a + b) / Rational(2) - exact_));
  const double ratio = half > Rational(0) ? nearest_double(from_middle.modulus / half) : 0;
  record({true, half}, a <= exact_ && exact_ <= b, ratio, place, what());
}

void Judge::nearest(double computed, const std::function<std::string()>& place) const {
  if (overflows(exact_)) return;
  const double right = nearest_double(exact_);
  const Deviation d = deviation(computed, exact_);
  record(d, computed == right, in_ulps(d, exact_) / 0.5, place, "computed " + hex(computed));
}

double perhaps_broken(const CheckOptions& options, const std::string& kernel, double computed) {
  if (kernel == options.broken_kernel)
    for (int i = 0; i < options.broken_by; ++i) computed = std::nextafter(computed, std::numeric_limits<double>::max());
  return computed;
}

bool is_negligible(const Vec<Rational, 4>& point, const std::vector<double>& weights, int degrees) {
  double largest = 0;
  for (const double w : weights) largest = std::max(largest, std::abs(w));
  const Rational w = point[3] < Rational(0) ? Rational(-point[3]) : point[3];
  return w < from_double(largest) * from_double(std::ldexp(3.0 * degrees + 3, degrees - 53));
}

void same_bits(Tally& tally, double a, double b, const std::function<std::string()>& place) {
  ++tally.numbers;
  if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) return;
  if (tally.violations++ == 0) tally.violation = fmt::format("{}: {} and {}", place(), hex(a), hex(b));
}

}  // namespace patchproof::validation
