// SPDX-License-Identifier: Apache-2.0
// What the tests of complexes ask of them: do the cells fit together, and what do they fill?
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "patchproof/mesh/cell_complex.h"
#include "patchproof/mesh/extrude.h"
#include "patchproof/scalar/rational.h"

namespace patchproof::test {

inline Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

// +1 or −1: the parity of the permutation that sorts distinct numbers.
inline int parity(std::vector<int> v) {
  int sign = 1;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = i + 1; j < v.size(); ++j)
      if (v[j] < v[i]) sign = -sign;
  return sign;
}

// By definition, without facets.h: for each facet (its corners sorted) the signs with which simplices contain it.
template <class K, std::size_t N>
std::map<std::vector<int>, std::vector<int>> facet_signs(const CellComplex<K, N>& complex) {
  std::map<std::vector<int>, std::vector<int>> out;
  for (std::size_t c = 0; c < complex.cell_count(); ++c)
    for (int i = 0; i <= complex.dimension; ++i) {
      std::vector<int> facet(complex.cell(c).begin(), complex.cell(c).end());
      facet.erase(facet.begin() + i);
      const int sign = (i % 2 == 0 ? 1 : -1) * parity(facet);
      std::sort(facet.begin(), facet.end());
      out[facet].push_back(sign);
    }
  return out;
}

// Every facet belongs to one simplex, or to two with opposite signs. Returns how many belong to one.
template <class K, std::size_t N>
int expect_facets_fit(const CellComplex<K, N>& complex) {
  int single = 0;
  for (const auto& [facet, signs] : facet_signs(complex)) {
    if (signs.size() == 1) ++single;
    EXPECT_LE(signs.size(), 2u);
    EXPECT_TRUE(signs.size() == 1 || signs[0] == -signs[1]);
  }
  return single;
}

template <std::size_t N>
Rational total_volume(const CellComplex<Rational, N>& complex) {
  Rational sum(0);
  for (std::size_t c = 0; c < complex.cell_count(); ++c) sum += signed_volume(complex, c);
  return sum;
}

template <std::size_t N>
bool all_positive(const CellComplex<Rational, N>& complex) {
  for (std::size_t c = 0; c < complex.cell_count(); ++c)
    if (!(Rational(0) < signed_volume(complex, c))) return false;
  return true;
}

}  // namespace patchproof::test
