// SPDX-License-Identifier: Apache-2.0
// Writing models: our JSON (docs/formats.md), with every number exact; .g2, STEP, IGES and BREP with doubles.
//
// Numbers are written as decimals where that is exact and short, else as strings: "1/3", "1/2*sqrt(2)". Knots are left out
// where they are Bézier knots on [0, 1]. A rational curve or patch is written with points and "weights", or, when a weight is
// zero, with homogeneous points, such as [w·x, w·y, w·z, w].
//
// REQUIRES curves of dimension 2 in the plane z = 0; solids that have `knots` and `controls`.
// ENSURES  (1) read_model_text(write_model_json(m)) gives m back: the same curves and patches with their names, knots and
//          homogeneous points, the same units and joins
//          (names and units in UTF-8; no number with more than kMaxDigits characters as a fraction: the reader refuses it);
//          (2) the same model gives the same bytes;
//          (3) in the formats of doubles a number is written as a decimal that reads back as the nearest double (so, the same
//          number where it is a double or a decimal of at most 15 digits), in .g2 as its shortest decimal when that is exact;
//          (4) what these formats cannot hold is said in notes, and is an error where the geometry would change: knots that
//          are different and have one nearest double, a number that becomes 0 or infinite, for Open CASCADE a weight that is
//          not positive, a jump, a degree above 25;
//          (5) with_splines_only: a B-spline patch with positive weights in place of each Gregory patch, behind the other patches
//          and so with its number, with its edges, nearly (gregory_approximate.h); a note says how nearly, by upper bounds.
//          The formats of doubles are written so, never with the exact patch's zero weights.
// ERRORS   unsupported, bad_number; `where` is "patch 3", "curve 0".
// NEIGHBOURS read.h, cad.h
// TEST     tests/io/write_test.cpp checks (1)–(2), tests/io/write_doubles_test.cpp (3)–(4), tests/io/splines_only_test.cpp (5),
//          tests/io/occt/write_cad_test.cpp those of CAD formats.
#pragma once

#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"

namespace patchproof {

// T: Rational or Quadratic.
template <ExactField T>
std::string write_model_json(const Model<T>& model);

struct WrittenModel {
  std::string bytes;
  std::vector<std::string> notes;  // what was left out or rounded
};

// How many cells along each side of a Gregory patch its approximation has (gregory_approximate.h).
inline constexpr int kApproximationCells = 8;

template <ExactField T>
struct SplinesOnly {
  Model<T> model;
  std::vector<std::string> notes;
};
template <ExactField T>
Result<SplinesOnly<T>> with_splines_only(Model<T> model, int cells = kApproximationCells);

// GoTools' and SISL's .g2: curves, then patches.
template <ExactField T>
Result<WrittenModel> write_model_g2(const Model<T>& model);

// A face for each patch, untrimmed, and an edge for each curve, in millimetres (BREP: in the model's numbers).
// Only in the target patchproof::occt.
enum class CadFormat { step, iges, brep };
template <ExactField T>
Result<WrittenModel> write_model_cad(const Model<T>& model, CadFormat format);

}  // namespace patchproof
