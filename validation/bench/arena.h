// SPDX-License-Identifier: Apache-2.0
// Parameters and room for results, shared by all benchmarks, made when first used.
#pragma once

#include <span>
#include <vector>

#include "validation/corpus/workloads.h"

namespace patchproof::bench {

inline constexpr std::size_t kItems = 1'000'000, kGridSide = 1000;

// Random numbers in [0, 1).
std::span<const double> random_u();
std::span<const double> random_v();
// random_u in increasing order.
std::span<const double> sorted_u();
// Of a grid with kItems points.
std::span<const double> grid_line();
// 18 numbers for each item, aligned to pages; written once, so that they are there.
std::span<double> room();

}  // namespace patchproof::bench
