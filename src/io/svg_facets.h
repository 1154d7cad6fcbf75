// SPDX-License-Identifier: Apache-2.0
// Patches and the faces of solids on the page: shaded facets from back to front, and control nets.
#pragma once

#include <vector>

#include "io/drawing.h"
#include "io/svg_page.h"
#include "io/svg_view.h"

namespace patchproof {

void draw_facets(pugi::xml_node root, const std::vector<PatchDrawing>& patches, const View& view);
void draw_net(pugi::xml_node root, const PatchDrawing& patch, const View& view);

// Whether lines of the knots run between the edges.
bool has_inner_knots(const PatchDrawing& patch);

}  // namespace patchproof
