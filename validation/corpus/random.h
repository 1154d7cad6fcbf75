// SPDX-License-Identifier: Apache-2.0
// Random numbers that are the same on every machine: the standard fixes its engines, but not its distributions.
#pragma once

#include <cstddef>
#include <cstdint>

namespace patchproof::validation {

// SOURCE G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, OOPSLA 2014 (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // In [low, high), a multiple of (high − low)·2^-53, rounded.
  double between(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  // In [low, high].
  int integer(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
  bool coin() { return bits() >> 63; }
  template <class Container>
  const auto& one_of(const Container& c) {
    return c[static_cast<std::size_t>(bits() % c.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace patchproof::validation
