// SPDX-License-Identifier: Apache-2.0
// From control points and knots to pieces.h.
#pragma once

#include <string>

#include "kernels/pieces.h"
#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::kernels {

Result<SurfacePieces> prepare(const SurfaceData& data);
Result<CurvePieces> prepare(const CurveData& data);

// For messages: also numbers that are none.
std::string number_text(double x);

}  // namespace patchproof::kernels
