// SPDX-License-Identifier: Apache-2.0
// The same shapes in Open CASCADE: its verdicts, and ours about the CAD shape.  occt.cpp, or no_occt.cpp where it is absent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "patchproof/join/certificate.h"
#include "validation/verdicts/case.h"

namespace patchproof::verdicts {

// "7.6.3"; empty where Open CASCADE is absent.
std::optional<std::string> occt_version();

// Both patches become faces of one shell, their control points rounded to doubles, with one edge along a.u_max: its curve
// there is a's, its parameter curves are the lines u = u_max and u = u_min. Then
//   ContinuityOfFaces   BRepLib::ContinuityOfFaces(edge, a, b, 1e-10): "C0", "G1", "C1", "G2", …
//   EncodeRegularity    BRepLib::EncodeRegularity(edge, a, b), and what then stands on the edge
//   LocalAnalysis       LocalAnalysis_SurfaceContinuity at the middle of the edge, order G2, its own tolerances: those of
//                       "IsC0, IsG1, IsG2" that hold, "none", or "not done"
// Of several shapes the answers are counted: "C0 ×199, G1 ×1".
// REQUIRES occt_version().  ERRORS unsupported: Open CASCADE refuses the shape.
Result<Answers> ask_occt(const Case& c);

// The shapes written as one BREP file, read by read_cad_model and certified as its edges, in the order of the shapes.
// REQUIRES occt_version().  ERRORS cannot_open (no place for the file), those of read_cad_model.
Result<std::vector<Certificate>> certify_as_cad(const Case& c);

}  // namespace patchproof::verdicts
