// SPDX-License-Identifier: Apache-2.0
// From control points and knots to pieces.h.
#pragma once

#include "kernels/pieces.h"
#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::kernels {

Result<SurfacePieces> prepare(const SurfaceData& data);
Result<CurvePieces> prepare(const CurveData& data);

}  // namespace patchproof::kernels
