// SPDX-License-Identifier: Apache-2.0
#include "validation/bench/arena.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace patchproof::bench {
namespace {

// Aligned as vectors and non-temporal stores like it best.
std::span<double> aligned(std::size_t count) {
  constexpr std::size_t kPage = std::size_t{1} << 21;
  const std::size_t bytes = (count * sizeof(double) + kPage - 1) / kPage * kPage;
  const std::span<double> out(static_cast<double*>(std::aligned_alloc(kPage, bytes)), count);
  std::fill(out.begin(), out.end(), 0.0);
  return out;  // for the life of the program
}

std::span<const double> copied(const std::vector<double>& numbers) {
  const std::span<double> out = aligned(numbers.size());
  std::copy(numbers.begin(), numbers.end(), out.begin());
  return out;
}

std::vector<double> sorted(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

std::span<const double> random_u() {
  static const std::span<const double> u = copied(validation::random_parameters(kItems, 1));
  return u;
}
std::span<const double> random_v() {
  static const std::span<const double> v = copied(validation::random_parameters(kItems, 2));
  return v;
}
std::span<const double> sorted_u() {
  static const std::span<const double> u = copied(sorted(validation::random_parameters(kItems, 1)));
  return u;
}
std::span<const double> grid_line() {
  static const std::span<const double> line = copied(validation::even_parameters(kGridSide));
  return line;
}
std::span<double> room() {
  static const std::span<double> all = aligned(kItems * 18);
  return all;
}

}  // namespace patchproof::bench
