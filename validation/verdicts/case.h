// SPDX-License-Identifier: Apache-2.0
// cases.json: the shapes, what is true of them, and what Open CASCADE 7.6 answered.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/verdicts/shape.h"

namespace patchproof::verdicts {

// What mathematics says of each shape of a case, as it stands in exact numbers.
struct Truth {
  std::map<std::string, std::string>
      classes;                         // "C0", "C1", "C2", "G1" → "proven" (it holds) or "refuted" (it does not)
  std::string orientation;             // "" where it is not asked
  bool one_polynomial = false;         // C∞: both patches are one polynomial
  std::array<Rational, 2> gap, angle;  // the largest gap and angle (degrees) lie between these; equal when exact
  std::optional<double> rounded_angle_below;  // degrees: what the angle of the rounded shape is certified to be below
};

// Open CASCADE's answers, as texts (occt.h), one for all shapes or counted: "C0 ×199, G1 ×1".
struct Answers {
  std::string continuity_of_faces, encoded, local_analysis;
  friend bool operator==(const Answers&, const Answers&) = default;
};

struct Case {
  std::string id, title, state;  // state: the truth in words
  std::string note;              // what can be said only in words
  std::vector<Shape> shapes;
  Truth truth;
  double edge_tolerance = 0;        // of the edge that Open CASCADE is given
  std::array<bool, 2> wrong{};      // is its recorded answer wrong? of BRepLib, of LocalAnalysis
  std::optional<Answers> recorded;  // for versions 7.6
};

struct CaseOptions {
  std::uint64_t seed = 1;
  int count = 200;  // of random shapes
};

// ERRORS cannot_open, syntax (the file is not as it should be), those of read_shape; bad_number.
Result<std::vector<Case>> read_cases(const std::string& path, const CaseOptions& options = {});

}  // namespace patchproof::verdicts
