// SPDX-License-Identifier: Apache-2.0
// Writing models: our JSON (docs/formats.md), with every number exact.
//
// Numbers are written as decimals where that is exact and short, else as strings: "1/3", "1/2*sqrt(2)". Knots are left out
// where they are Bézier knots on [0, 1]. A rational curve or patch is written with points and "weights", or, when a weight is
// zero, with homogeneous points, such as [w·x, w·y, w·z, w].
//
// REQUIRES curves of dimension 2 in the plane z = 0; solids that have `knots` and `controls`.
// ENSURES  (1) read_model_text(write_model_json(m)) gives m back: the same curves and patches with their names, knots and
//          homogeneous points, the same units and joins
//          (names and units in UTF-8; no number with more than kMaxDigits characters as a fraction: the reader refuses it);
//          (2) the same model gives the same bytes.
// NEIGHBOURS read.h
// TEST     tests/io/write_test.cpp checks (1)–(2).
#pragma once

#include <string>

#include "patchproof/io/model.h"

namespace patchproof {

// T: Rational or Quadratic.
template <ExactField T>
std::string write_model_json(const Model<T>& model);

}  // namespace patchproof
