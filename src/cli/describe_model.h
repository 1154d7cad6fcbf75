// SPDX-License-Identifier: Apache-2.0
// What `patchproof info` says about the curves and patches of a model: knots, components, exact smoothness at each knot,
// control points without influence, the sign of denominators.
#pragma once

#include <string>

#include "patchproof/io/model.h"

namespace patchproof::cli {

std::string describe(const Model<Rational>& model);
std::string describe(const Model<Quadratic>& model);

}  // namespace patchproof::cli
