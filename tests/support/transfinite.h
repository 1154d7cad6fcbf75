// SPDX-License-Identifier: Apache-2.0
// Transfinite maps for tests, in few words.
#pragma once

#include <string>
#include <vector>

#include "patchproof/patch/transfinite.h"
#include "patchproof/scalar/parse_scalar.h"
#include "support/scalars.h"

namespace patchproof::test {

using Surface = TransfiniteMap<Rational, 2, 3>;
using Function = TransfiniteMap<Rational, 2, 1>;

// "1919/512"
inline Rational operator""_q(const char* text, std::size_t length) {
  return parse_scalar<Rational>(std::string_view(text, length)).value();
}

// "(1919/512, 429/128, 95/512)" without the brackets
inline Vec<Rational, 3> p(const Rational& x, const Rational& y, const Rational& z) { return {{x, y, z}}; }

// The Bézier blend of points or maps in coordinate s.
template <std::size_t D = 2>
TransfiniteMap<Rational, D, 3> bezier(std::size_t s, std::vector<TransfiniteMap<Rational, D, 3>> controls,
                                      const Rational& begin = Rational(0), const Rational& end = Rational(1)) {
  return TransfiniteMap<Rational, D, 3>::bezier(s, std::move(controls), begin, end).value();
}

inline KnotVector<Rational> knots_of(int degree, const std::vector<Rational>& knots) {
  return KnotVector<Rational>::make(degree, knots).value();
}

template <std::size_t D>
ParameterPlace<Rational, D> place_of(const std::array<Rational, D>& at, Side side = Side::right) {
  return {at, side};
}

// A random map of two parameters over [begin, end]²: blends on awkward knots, sums and products, `depth` deep.
inline Surface random_surface(RandomRationals& random, int depth, const Rational& begin = Rational(0),
                              const Rational& end = Rational(1)) {
  const auto knots = [&] {
    const int degree = random.integer(1, 2);
    std::vector<Rational> out(degree + 1, begin);
    for (int i = random.integer(0, 2); i > 0; --i)
      out.insert(out.end(), random.integer(1, degree + 1), begin + (end - begin) * Rational(3 - i) / Rational(4));
    out.insert(out.end(), degree + 1, end);
    return knots_of(degree, out);
  };
  if (depth == 0) return random.point<3>();
  const auto inner = [&] { return random_surface(random, random.integer(0, depth - 1), begin, end); };
  switch (random.integer(0, 3)) {
    case 0: return inner() + inner();
    case 1: return product(coordinate_function<Rational, 2>(random.integer(0, 1), begin, end), inner());
    default: {
      const KnotVector<Rational> k = knots();
      std::vector<Surface> controls;
      for (int i = 0; i < k.control_count(); ++i) controls.push_back(inner());
      return Surface::blend(random.integer(0, 1), k, std::move(controls)).value();
    }
  }
}

// The surface of test02 of the curves-and-surfaces module: four Bézier curves in u, blended in v.
inline Surface four_curves() {
  return bezier(1, {bezier(0, {p(0, 0, 0), p(10, 0, 0)}), bezier(0, {p(0, 2, 0), p(8, 3, 0), p(9, 2, 0)}),
                    bezier(0, {p(0, 4, 1), p(7, 5, -1), p(8, 5, 1), p(12, 4, 0)}),
                    bezier(0, {p(0, 6, 0), p(9, 6, 3), p(10, 6, -1)})});
}

}  // namespace patchproof::test
