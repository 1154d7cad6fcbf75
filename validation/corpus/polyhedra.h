// SPDX-License-Identifier: Apache-2.0
// Polyhedra by their corners and faces, and ways to make others from them.
#pragma once

#include <array>
#include <vector>

namespace patchproof::validation {

struct SolidFaces {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>> faces;  // counter-clockwise from outside
};

SolidFaces regular_icosahedron();

// Each vertex cut off at a third of its edges.
SolidFaces truncated(const SolidFaces& old);

// Each face made smaller, with new ones where there were edges and vertices.
SolidFaces expanded(const SolidFaces& old);

}  // namespace patchproof::validation
