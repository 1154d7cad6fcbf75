// SPDX-License-Identifier: Apache-2.0
// Models as pictures and as meshes.
//
//   svg   curves with control polygon and knots; patches and the
//         faces of solids shaded, with isoparametric lines; or, with `basis`, the graphs of
//         the B-spline functions (and R_i = w_i N_i / Σ w_j N_j where there are weights) over their knots
//   obj, stl, vtu, glb   the tessellated model: mesh_files.h
//
// Gregory patches are drawn as they are, not as the patches of gregory_expand.h; their control nets are those of the U and V
// surfaces. Normals: unit vectors of one length at the edges of patches and, from both sides, at the lines of their knots, where
// two of them show that the patch has a crease. Sections: where the surfaces meet planes z = const, evenly spread.
//
// A curve in the plane is drawn in its plane with axes; everything else in one orthographic view, z up, patches from back
// to front. Polynomial pieces of degree 1 to 3 are exact Bézier commands of SVG, the others polylines. A control point of
// weight 0 is a vector and is drawn as one. Colours read on light and on dark ground; nothing is fetched from elsewhere.
//
// ENSURES  (1) an svg has one path for each component of each curve, broken where the curve jumps; a polynomial piece of
//              degree ≤ 3 is one command with its Bézier points, to 1/100 of a page unit;
//          (2) all coordinates of the picture lie within its viewBox;  (3) the same model and options give the same bytes;
//          (4) basis: one line for each function and component, for each distinct knot vector drawn;
//          (5) a mesh file holds the curves, patches and solids of the model in order, one part for each component; unless one
//              is asked for, patches that are controls of a solid are left out of pictures of the geometry and of mesh files;
//          (6) basis: every function is named, beside its line or, with its support, below the panel;
//          (7) where a curve runs along an earlier one it is dashed, so that both are seen;
//          (8) normals: those of the exact derivatives, from the left and from the right;  (9) sections: lines in those planes.
// ERRORS   bad_reference: no such curve or patch;  usage: nothing to draw, a picture with too many cells, or lines in an stl;
//          what tessellate and mesh_files.h say.
// NEIGHBOURS mesh_files.h, read.h.
// TEST     tests/io/plot_test.cpp checks (1)–(5), plot_solids_test.cpp (5), plot_legibility_test.cpp (2), (6),
//          (7), plot_gregory_test.cpp (5), (8), (9) with Gregory patches.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "patchproof/error.h"
#include "patchproof/io/model.h"

namespace patchproof {

enum class PlotFormat { svg, obj, stl, vtu, glb };

// "svg" or ".svg", in any case, to the format.
std::optional<PlotFormat> plot_format(std::string_view name);

struct PlotOptions {
  std::string title;                             // above the picture
  bool basis = false;                            // the functions instead of the geometry; svg only
  std::optional<bool> control{};                 // control polygons and nets; empty: of curves only
  std::optional<int> cells{};                    // in each span; empty: chosen
  std::optional<int> curve{}, patch{}, solid{};  // only this one, from 0; Gregory patches after the others
  bool normals = false;                          // not in stl
  std::optional<int> sections{};                 // how many; not in stl
};

// The bytes of the file. T: Rational or Quadratic.
template <ExactField T>
Result<std::string> plot(const Model<T>& model, PlotFormat format, const PlotOptions& options = {});

}  // namespace patchproof
