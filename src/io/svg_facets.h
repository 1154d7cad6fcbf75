// SPDX-License-Identifier: Apache-2.0
// Patches and the faces of solids on the page: shaded facets from back to front, and control nets.
#pragma once

#include <vector>

#include "io/drawing.h"
#include "io/svg_page.h"
#include "io/svg_view.h"

namespace patchproof {

// With the sections at these levels.
void draw_facets(pugi::xml_node root, const std::vector<PatchDrawing>& patches, const std::vector<double>& levels,
                 const View& view);
void draw_net(pugi::xml_node root, const PatchDrawing& patch, const View& view);

// Lines of this length, those from the left over those from the right.
void draw_normals(pugi::xml_node root, const std::vector<DrawnNormal>& normals, double length, const View& view);
inline const std::string kFromLeft = "#b03a9b", kFromRight = "#2f8f4e", kSection = "#c2662d";

// Whether lines of the knots run between the edges.
bool has_inner_knots(const PatchDrawing& patch);

}  // namespace patchproof
