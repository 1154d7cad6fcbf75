// SPDX-License-Identifier: Apache-2.0
// Vector operations that our kernels need for one item, counted from the bodies in kernels/horner.h: with them and the
// measured time of one operation (roofline.h) a lower bound of the time is known.
//
// Horner's rule for degree p takes p fused operations for the value, p − 1 more for the first derivative, p − 2 more for
// the second: horner(p, order). A surface sums q + 1 rows in x, then the rows of values (and of x-derivatives of lower
// order) in y. Not counted: finding the span, permutations and stores.
#pragma once

#include <algorithm>

#include "validation/corpus/cases.h"
#include "validation/peers/compare.h"

namespace patchproof::bench {

struct Operations {
  double simple = 0;            // multiply, add, multiply-add
  double divide = 0, root = 0;  // divisions, square roots
};

constexpr int horner(int p, int order) {
  int sum = 0;
  for (int m = 0; m <= order; ++m) sum += std::max(p - m, 0);
  return sum;
}
constexpr int order_of(peers::Quantities q) {
  return q == peers::Quantities::points ? 0 : q == peers::Quantities::second ? 2 : 1;
}
constexpr int rows_along_v(int q, int order) {
  int sum = 0;
  for (int m = 0; m <= order; ++m) sum += horner(q, order - m);
  return sum;
}

// What follows the sums, for each lane: factors of derivatives, the quotient, the normal.
inline Operations finish(bool rational, peers::Quantities what, int vectors) {
  Operations out;
  const int order = order_of(what), numbers = rational ? 4 : 3;
  out.simple += numbers * (vectors - 1.0);
  if (rational) {
    // S = A·(1/w); each first derivative 3 fused and 3 products, each second one 9 and 3.
    out.divide += 1;
    out.simple += 3 + (order >= 1 ? 2 * 6 : 0) + (order >= 2 ? 3 * 12 : 0);
  }
  if (what == peers::Quantities::normals) {
    out.simple += 6 + 6 + 3 + 3;  // scaling, cross product, its square, times 1/length
    out.divide += 1;
    out.root += 1;
  }
  return out;
}
inline Operations per_item(Operations lanes_of_items, int lanes) {
  return {lanes_of_items.simple / lanes, lanes_of_items.divide / lanes, lanes_of_items.root / lanes};
}

// One item of a surface. Scattered over several pieces: a point at a time, four numbers in a vector, two rows in eight.
inline Operations surface_operations(const validation::SurfaceCase& s, peers::Arrangement arrangement,
                                     peers::Quantities what, int lanes) {
  const int p = s.degree_u, q = s.degree_v, order = order_of(what);
  const int vectors = what == peers::Quantities::normals ? 3 : peers::surface_vectors(what);
  const bool rational = !s.weights.empty();
  const bool one_piece =
      static_cast<int>(s.knots_u.size()) == 2 * (p + 1) && static_cast<int>(s.knots_v.size()) == 2 * (q + 1);
  if (arrangement == peers::Arrangement::scattered && !one_piece) {
    const double quads = std::max(1, 4 / lanes), octets = std::max(1, 8 / lanes);
    Operations out;
    out.simple = (q + 2) / 2 * horner(p, order) * octets + rows_along_v(q, order) * quads + (vectors - 1) * quads;
    if (rational) {
      out.divide = 1;
      out.simple += (1 + (order >= 1 ? 2 * 2 : 0) + (order >= 2 ? 3 * 4 : 0)) * quads;
    }
    return out;
  }
  Operations all = finish(rational, what, vectors);
  // On a grid the rows are summed once for a whole line of items, and u is not touched.
  const bool grid = arrangement == peers::Arrangement::grid;
  const int rows = grid ? 0 : (q + 1) * horner(p, order), local = grid ? 2 : 4;
  all.simple += (rational ? 4 : 3) * (rows_along_v(q, order) + rows) + local;
  return per_item(all, lanes);
}

// One item of a curve: sorted parameters run in lanes, others a point at a time.
inline Operations curve_operations(const validation::CurveCase& c, bool sorted, peers::Quantities what, int lanes) {
  const int order = order_of(what), vectors = peers::curve_vectors(what);
  const bool rational = !c.weights.empty();
  if (!sorted) {
    const double quads = std::max(1, 4 / lanes);
    return {(horner(c.degree, order) + vectors - 1 + (rational ? 1 + 2 * order : 0)) * quads, rational ? 1.0 : 0.0, 0};
  }
  Operations all;
  const int numbers = rational ? 4 : 3;
  all.simple = numbers * (horner(c.degree, order) + vectors - 1) + 2;
  if (rational) {
    all.divide = 1;
    all.simple += 3 + (order >= 1 ? 6 : 0) + (order >= 2 ? 12 : 0);
  }
  return per_item(all, lanes);
}

}  // namespace patchproof::bench
