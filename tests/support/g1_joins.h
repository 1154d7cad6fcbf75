// SPDX-License-Identifier: Apache-2.0
// Families of bicubic joins that are exactly G1, of given bit lengths, for tests and benchmarks of the exact decisions.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "patchproof/join/fixed_g1.h"

namespace patchproof::test {

// Coordinates are whole multiples of 2^-unit, about 40 in size: behind_b needs unit + 4 + 6 bits.
struct G1Family {
  int unit = 40;
  bool reflected = false;  // C1
  int weight_bits = 0;     // 0: polynomial; else weights in [1/2, 2), one for each column of control points
};

inline constexpr G1Family kD24{17, false, 0}, kD53{40, false, 0}, kC1{43, true, 0}, kR53{17, true, 24},
    kR106{43, true, 53};

// B − E = −λ (A − E) + β E_t, λ one of 1/2, 1, 3/2, 2, and β linear, small multiples of 3/8.
inline BicubicJoinRows make_g1_join(std::mt19937_64& random, const G1Family& family) {
  const auto below = [&](std::uint64_t n) { return static_cast<double>(random() % n); };
  const auto whole = [&](double range) {
    const double steps = std::ldexp(2 * range, family.unit);
    return std::ldexp(std::floor(below(static_cast<std::uint64_t>(steps))), -family.unit) - range;
  };
  BicubicJoinRows rows;
  const double lambda = family.reflected ? 1 : (below(4) + 1) / 2;
  const double beta0 = family.reflected ? 0 : 3 * (below(7) - 3) / 8,
               beta1 = family.reflected ? 0 : 3 * (below(7) - 3) / 8;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      const double base = k == 1 ? 10 * i : 0;
      rows.edge[i][k] = base + whole(3);
      rows.behind_a[i][k] = base + whole(3) - (k == 0 ? 10 : 0);
    }
  const auto& e = rows.edge;
  for (int k = 0; k < 3; ++k) {
    const double c0 = e[1][k] - e[0][k], c1 = e[2][k] - e[1][k], c2 = e[3][k] - e[2][k];
    const double tangent[4] = {beta0 * c0, (2 * beta0 * c1 + beta1 * c0) / 3, (beta0 * c2 + 2 * beta1 * c1) / 3,
                               beta1 * c2};
    for (int i = 0; i < 4; ++i) rows.behind_b[i][k] = e[i][k] - lambda * (rows.behind_a[i][k] - e[i][k]) + tangent[i];
  }
  if (family.weight_bits > 0) {
    rows.weights.emplace();
    for (int i = 0; i < 4; ++i) {
      const double steps = std::ldexp(1.0, family.weight_bits - 1);
      const double w = std::floor(steps / 2 + below(static_cast<std::uint64_t>(steps * 3 / 2))) / steps;
      for (auto& row : *rows.weights) row[i] = w;
    }
  }
  return rows;
}

inline std::vector<BicubicJoinRows> make_g1_joins(const G1Family& family, int count, std::uint64_t seed = 5) {
  std::mt19937_64 random(seed);
  std::vector<BicubicJoinRows> joins;
  for (int i = 0; i < count; ++i) joins.push_back(make_g1_join(random, family));
  return joins;
}

// One coordinate moved: by one unit in the last place, or by `step`.
inline void spoil(BicubicJoinRows& rows, double step = 0) {
  double& x = rows.behind_b[2][2];
  x = step == 0 ? std::nextafter(x, 1e9) : x + step;
}

// Shrinks the model in z by 2^bits: an affine map, so the join is what it was.
inline void flatten(BicubicJoinRows& rows, int bits) {
  for (auto* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
    for (auto& point : *row) point[2] = std::ldexp(point[2], -bits);
}

}  // namespace patchproof::test
