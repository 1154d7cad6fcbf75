// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gerbs_motion.h"

#include <algorithm>
#include <cmath>

namespace patchproof::detail {

Vec<Rational, 3> rounded_to_24_bits(const Vec<double, 3>& p) {
  constexpr int kBits = 24, kSmallest = -1000;
  const double size = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  const int exponent = size > 0 ? std::max(std::ilogb(size), kSmallest) : 0;
  Vec<Rational, 3> out;
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = from_double(std::ldexp(std::nearbyint(std::ldexp(p[c], kBits - 1 - exponent)), exponent + 1 - kBits));
  return out;
}

}  // namespace patchproof::detail
