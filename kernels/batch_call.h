// SPDX-License-Identifier: Apache-2.0
// What all batch calls share: threads, and errors that name the first bad parameter.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "kernels/kernel_table.h"
#include "patchproof/parallel.h"

namespace patchproof::batch {

// Items a thread takes at a time: a multiple of the tiles of all kernels and of all vectors.
constexpr std::size_t kShare = std::size_t{1} << 14;

// Kernels take parameters in lists. Others are gathered in blocks that stay in the nearest cache: a whole number of tiles each.
// body(u, v, begin, count) → kernels::Progress.
template <class Body>
kernels::Progress in_lists(const ParameterArray& at, std::size_t begin, std::size_t count, const Body& body) {
  if (at.stride == 1) return body(at.u + begin, at.v == nullptr ? nullptr : at.v + begin, begin, count);
  constexpr std::size_t kBlock = 1024;
  double u[kBlock], v[kBlock];
  kernels::Progress all;
  for (std::size_t done = 0; done < count; done += kBlock) {
    const std::size_t n = std::min(kBlock, count - done);
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(begin + done) * at.stride;
    for (std::size_t i = 0; i < n; ++i) {
      const std::ptrdiff_t place = first + static_cast<std::ptrdiff_t>(i) * at.stride;
      u[i] = at.u[place];
      if (at.v != nullptr) v[i] = at.v[place];
    }
    const kernels::Progress block = body(u, at.v == nullptr ? nullptr : v, begin + done, n);
    all.undefined_normals += block.undefined_normals;
    all.good += block.good;
    all.stop = block.stop;
    if (all.stop != kernels::Stop::none) break;
  }
  return all;
}

// part(begin, count) → kernels::Progress for a range of items, whole shares but for the last one and for single items;
// describe(i): item i's parameters, for the error.
template <class Part, class Describe>
Result<BatchSummary> run(std::size_t count, std::size_t share, int threads, const Part& part,
                         const Describe& describe) {
  PATCHPROOF_REQUIRES(threads >= 0, "batch evaluation: the number of threads is not negative");
  kernels::Progress all;
  std::size_t first_bad = count;
  if (threads == 1 || count <= share) {
    all = part(0, count);
    if (all.stop != kernels::Stop::none) first_bad = all.good;
  } else {
    std::vector<kernels::Progress> shares(count / share + (count % share != 0 ? 1 : 0));
    for_each_item(threads, shares.size(),
                  [&](std::size_t s) { shares[s] = part(s * share, std::min(share, count - s * share)); });
    for (std::size_t s = 0; s < shares.size() && all.stop == kernels::Stop::none; ++s) {
      all.undefined_normals += shares[s].undefined_normals;
      all.stop = shares[s].stop;
      if (all.stop != kernels::Stop::none) first_bad = s * share + shares[s].good;
    }
  }
  if (all.stop == kernels::Stop::none) return BatchSummary{all.undefined_normals};
  // A zero of the denominator is known to its tile only, and may stand before a parameter outside the domain in it.
  constexpr std::size_t kLargestTile = 4096;
  if (all.stop == kernels::Stop::outside_domain) first_bad -= std::min(first_bad, kLargestTile);
  while (first_bad + 1 < count) {
    const kernels::Stop stop = part(first_bad, 1).stop;
    if (stop != kernels::Stop::none) all.stop = stop;
    if (stop != kernels::Stop::none) break;
    ++first_bad;
  }
  const bool outside = all.stop == kernels::Stop::outside_domain;
  return Error{outside ? ErrorCode::outside_domain : ErrorCode::vanishing_weight,
               "parameter " + std::to_string(first_bad),
               outside ? "the parameter lies outside the domain"
                       : "the denominator is zero, or too small for double, at this parameter",
               describe(first_bad)};
}

}  // namespace patchproof::batch
