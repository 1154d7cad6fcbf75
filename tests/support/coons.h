// SPDX-License-Identifier: Apache-2.0
// Boundary data of Coons patches for tests.
#pragma once

#include "patchproof/patch/coons_patch.h"
#include "patchproof/patch/transfinite_calculus.h"
#include "support/transfinite.h"

namespace patchproof::test {

using Sides = FourSides<Rational, 3>;

// The four curves of test03 of the curves-and-surfaces module.
inline Sides reference_boundary() {
  return {bezier(0, {p(0, 0, 0), p(10, 0, 0)}),
          bezier(0, {p(0, 10, 0), p("5/2"_q, 10, 3), p(5, 10, -3), p("15/2"_q, 10, 3), p(10, 10, 0)}),
          bezier(1, {p(0, 0, 0), p(0, 0, 3), p(0, 10, 3), p(0, 10, 0)}),
          bezier(1, {p(10, 0, 0), p(10, 5, 3), p(10, 10, 0)})};
}

// The sides of a surface.
inline Sides sides_of(const Surface& s) {
  return {fix(s, 1, s.domain_begin(1)), fix(s, 1, s.domain_end(1)), fix(s, 0, s.domain_begin(0)),
          fix(s, 0, s.domain_end(0))};
}
// The derivatives of a surface across its sides.
inline Sides across_of(const Surface& s) {
  const Sides of_v = sides_of(derivative(s, 1)), of_u = sides_of(derivative(s, 0));
  return {of_v.v_min, of_v.v_max, of_u.u_min, of_u.u_max};
}

// A random tensor-product surface with inner knots over [a, b] × [c, d].
inline Surface random_patch(RandomRationals& random, const Rational& a, const Rational& b, const Rational& c,
                            const Rational& d) {
  const auto knots = [&](const Rational& begin, const Rational& end) {
    const int degree = random.integer(1, 3);
    std::vector<Rational> out(degree + 1, begin);
    for (int i = random.integer(0, 2); i > 0; --i)
      out.insert(out.end(), random.integer(1, degree), begin + (end - begin) * Rational(3 - i) / Rational(3));
    out.insert(out.end(), degree + 1, end);
    return knots_of(degree, out);
  };
  const KnotVector<Rational> u = knots(a, b), v = knots(c, d);
  return patch_over<2>(0, 1, BsplinePatch<Rational, 3>(u, v, random.points<3>(u.control_count() * v.control_count())));
}

}  // namespace patchproof::test
