// SPDX-License-Identifier: Apache-2.0
// What the benchmarks race on: surfaces and curves of ordinary models, the same on every machine.
//
//   bezier_3x3, bezier_5x5, bezier_7x7    one polynomial patch of degree (p, p)
//   bspline_20x20, nurbs_20x20            bicubic, 20 × 20 control points, 17 × 17 pieces, knots with spans of 1 : 6
//   curve_100, nurbs_curve_100            cubic, 100 control points
#pragma once

#include "validation/corpus/cases.h"

namespace patchproof::validation {

std::vector<SurfaceCase> surface_workloads();  // without parameters
std::vector<CurveCase> curve_workloads();

// In [0, 1).
std::vector<double> random_parameters(std::size_t count, std::uint64_t seed);
// (i + 1/2) / count.
std::vector<double> even_parameters(std::size_t count);

// `count` new knots inside the spans, each in the middle of the longest part that is left.
std::vector<double> refining_knots(int degree, const std::vector<double>& knots, int count);

}  // namespace patchproof::validation
