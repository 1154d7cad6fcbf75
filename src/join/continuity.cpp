// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/continuity.h"

namespace patchproof::detail {
namespace {

using Coefficients = std::vector<std::array<Interval, 3>>;

bool in_open_half_space(const Coefficients& c) {
  const auto& middle = c[c.size() / 2];
  std::array<double, 3> r;  // any direction will do; the one of a middle coefficient is a good guess
  for (int i = 0; i < 3; ++i) r[i] = (middle[i].inf() + middle[i].sup()) / 2;
  for (const auto& x : c) {
    const Interval product = Interval(r[0]) * x[0] + Interval(r[1]) * x[1] + Interval(r[2]) * x[2];
    if (!(product.inf() > 0)) return false;
  }
  return true;
}

bool zero_free(const Coefficients& c, int depth) {
  if (in_open_half_space(c)) return true;
  if (depth == 0) return false;
  const std::size_t n = c.size();
  Coefficients left, right(c), row(c);
  const Interval half(0.5);
  for (std::size_t r = 0; r < n; ++r) {
    left.push_back(row[0]);
    right[n - 1 - r] = row[n - 1 - r];
    for (std::size_t j = 0; j + 1 < n - r; ++j)
      for (int k = 0; k < 3; ++k) row[j][k] = (row[j][k] + row[j + 1][k]) * half;
  }
  return zero_free(left, depth - 1) && zero_free(right, depth - 1);
}

}  // namespace

bool certainly_zero_free(const std::vector<std::array<Interval, 3>>& bernstein) {
  constexpr int kDepth = 12;  // beyond that, exact common divisors decide
  return zero_free(bernstein, kDepth);
}

}  // namespace patchproof::detail
