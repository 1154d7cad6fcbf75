// SPDX-License-Identifier: Apache-2.0
// The shapes about which Open CASCADE and this project are asked: two patches along one edge, exact.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/join/join.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/rational.h"

namespace patchproof::verdicts {

// b goes on where a ends: a.u_max is paired with b.u_min, points of equal v.  REQUIRES equal ranges of v.
struct Shape {
  BsplinePatch<Rational, 4> a, b;
};

// The first two patches of a model file, their decimals exact.
// ERRORS those of read_model; wrong_count (not two patches); unsupported (numbers not rational, ranges of v not equal).
Result<Shape> read_shape(const std::string& path);

// Every knot, weight and Cartesian coordinate as its nearest double: what a CAD system holds of it.
Shape in_doubles(const Shape& shape);

Join<Rational> join_of(const Shape& shape);

// One random bicubic patch, scaled and moved along (1, 1, 1), and cut at a random u by de Casteljau's algorithm, in
// fractions: both parts are one polynomial, so they join C∞.  ENSURES the same shapes on every machine.
std::vector<Shape> random_splits(std::uint64_t seed, int count, const Rational& scale, const Rational& offset);

// Are both patches one polynomial each, and is it the same polynomial? Then they join C∞. Decided by its values at
// (p + 1)(q + 1) parameters, p and q the larger degrees.  False as well for patches with several pieces.
bool is_one_polynomial(const Shape& shape);

}  // namespace patchproof::verdicts
