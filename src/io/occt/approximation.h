// SPDX-License-Identifier: Apache-2.0
// How far the B-spline that Open CASCADE puts for an offset surface is from it.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "patchproof/io/cad.h"

namespace patchproof::occt {

// Of a face before and after the conversion. No bound is certified: `length` is the figure that Open CASCADE has for its
// approximation, where that can be made again, or what samples find, if that is more; `degrees` is what samples find.
struct SurfaceApproximation {
  Approximation whole;
  double figure = 0;  // that of Open CASCADE; 0: none
};
SurfaceApproximation approximation_of(const TopoDS_Face& before, const TopoDS_Face& after);

// The same along an edge of the face after the conversion.
Approximation approximation_along(const TopoDS_Edge& edge, const TopoDS_Face& before, const TopoDS_Face& after,
                                  double figure);

}  // namespace patchproof::occt
