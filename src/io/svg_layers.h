// SPDX-License-Identifier: Apache-2.0
// Curves of a picture that lie on each other.
#pragma once

#include <vector>

#include "io/svg_page.h"

namespace patchproof {

using Polyline = std::vector<PagePoint>;

// For each component of each curve the lengths of its dashes and gaps, in turn; none: a whole line. Where a curve runs along
// earlier ones for a while (crossing them is nothing) it has gaps as wide as there are earlier ones, and they show through.
// No line has gaps when there are too many curves to tell them apart.
std::vector<std::vector<std::vector<double>>> dashes_of(const std::vector<std::vector<Polyline>>& curves);

}  // namespace patchproof
