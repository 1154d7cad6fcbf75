// SPDX-License-Identifier: Apache-2.0
// GERBS curves and patches on their way to a drawing: they are drawn as they are, at points in double, with marks and lines
// at their own knots. Their numbers come after those of the model's other curves, and before those of Gregory patches.
#pragma once

#include "io/drawing.h"

namespace patchproof {

// draw() for models with GERBS curves and patches. At most so many cells along each side of a span, unless the options say
// how many.
template <ExactField T>
Result<Drawing> draw_with_gerbs(const Model<T>& model, const PlotOptions& options, int most_cells = 24);

}  // namespace patchproof
