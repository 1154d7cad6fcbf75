// SPDX-License-Identifier: Apache-2.0
// Joins of curves, of one file or of several taken together: which ends meet, what is proved of them, what is asked.
//
// Ends meet when they lie within the match length (CertifyOptions::match_length, or 1e-6 of the diagonal) or within the sum of
// the file's tolerances at them (STEP, IGES, BREP: those of the vertices); join/curve_join.h has the rule. Parametric classes (C) are
// those of the parameters in the files; geometric ones (G) do not depend on them.
//
// Asked are, of models that hold only curves, the class, the gap, the tangent angle and the curvature difference of the request;
// beside patches curves are reported and nothing is asked of them; a profile speaks of surfaces. Joins between curves of CAD files
// have an EdgeClass by their tangent angle, and sharp ones are meant: of them only C0 and the gap are asked, as of sharp edges.
//
// ENSURES  (1) the reports of certify_model, certify_cad and certify_curve_files list every pair of ends that meet, and every end
//          that meets none;  (2) files taken together give the joins of their curves written into one file, each side with its
//          file;  (3) the report does not depend on the number of jobs.
// ERRORS   mixed_roots: files with different square roots.  usage: files whose units differ.
// TEST     tests/io/curve_files_test.cpp
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/model.h"
#include "patchproof/io/report.h"

namespace patchproof {

template <ExactField T>
struct CurveOfFile {
  std::string name;
  BsplineCurve<T, 4> curve;
  std::array<double, 2> tolerance{};  // of the file, at its begin and its end
  bool is_outline = false;            // stands for a GERBS curve that is no spline: its ends are not looked at
};

struct CurveFile {
  ReportedFile file;
  std::string units;
  std::vector<std::string> notes;
  bool is_cad = false;
  std::variant<std::vector<CurveOfFile<Rational>>, std::vector<CurveOfFile<Quadratic>>> curves;
};

CurveFile curves_of(const ModelFile& file);
CurveFile curves_of(const CadModel& model);

// The curves of all files as one model. REQUIRES at least one file.
Result<Report> certify_curve_files(const std::vector<CurveFile>& files, const CertifyOptions& options = {});

}  // namespace patchproof
