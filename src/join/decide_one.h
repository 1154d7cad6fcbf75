// SPDX-License-Identifier: Apache-2.0
// Parts of decide_join that the kernels and the tests of the filter's bounds take too.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "patchproof/join/decide_batch.h"
#include "patchproof/scalar/interval.h"

namespace patchproof::decide {

// One lane: the operations of the vectors, so that the filter answers alike in all of them.
struct OneLane {
  using D = double;
  static constexpr int kCount = 1;
  static constexpr unsigned kAll = 1;
  static D constant(double x) { return x; }
  static D add(D x, D y) { return x + y; }
  static D subtract(D x, D y) { return x - y; }
  static D multiply(D x, D y) { return x * y; }
  static D fma(D x, D y, D z) { return std::fma(x, y, z); }
  static D fnma(D x, D y, D z) { return std::fma(-x, y, z); }
  static D abs(D x) { return std::fabs(x); }
  static D max(D x, D y) { return x > y ? x : y; }
  static unsigned equal(D x, D y) { return x == y; }
  static unsigned greater(D x, D y) { return x > y; }
  static void scale_to_whole(D top, D& up, D& down) {
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(top) & 0x7ff0000000000000;
    up = std::bit_cast<double>((std::uint64_t{2 * 1023 + 52} << 52) - exponent);
    down = std::bit_cast<double>(exponent - (std::uint64_t{52} << 52));
  }
};

// The filter's bounds suppose rounding to nearest, and callers may hold a RoundingGuard, which is seen in the register
// of the vector unit only: std::fegetround does not tell.
class NearestGuard {
 private:
  RoundingGuard guard_{CGAL_FE_TONEAREST};
};

// Are weights different from each other, so that the join is a rational one?
bool is_weighted(const BicubicJoinRows& rows);
// The edge rows hold the same numbers.
bool same_edge(const BicubicJoinRows& rows, const BicubicEdge& other);
// C1 of a join whose sides share the edge, in exact numbers.
bool exact_c1(const BicubicJoinRows& rows);

}  // namespace patchproof::decide
