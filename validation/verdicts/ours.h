// SPDX-License-Identifier: Apache-2.0
// What patchproof says of a case, and whether that is true.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "patchproof/join/certify.h"
#include "validation/verdicts/case.h"

namespace patchproof::verdicts {

// The exact shape decides classes; the shape in doubles, which is what Open CASCADE is asked about, has bounds of its own.
struct Ours {
  std::vector<Certificate> exact, rounded;  // of each shape
  int one_polynomial = 0;                   // how many shapes were decided to be C∞
};
Ours certify_case(const Case& c);

// "C2 proven" or "C0 proven, G1 refuted": the highest classes that hold and the lowest that do not; "" for a mixture.
std::string classes_in_words(const Certificate& certificate);

// Everything that is not true; empty when all is. Against the truth of the case: classes, orientation, that the bounds
// enclose the largest gap and angle. Against exact values of both shapes along the edge: no upper bound below a value, no
// lower bound that is not attained where it says so.
std::vector<std::string> complaints(const Case& c, const Ours& ours);

// The same of bounds of the rounded shapes found by other means: each must overlap with ours.
std::vector<std::string> disagreements(const std::vector<Certificate>& rounded, const std::vector<Certificate>& others);

}  // namespace patchproof::verdicts
