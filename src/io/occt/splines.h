// SPDX-License-Identifier: Apache-2.0
// B-splines of Open CASCADE as exact B-splines of ours.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/curve.h"

namespace patchproof::occt {

// The surface of a face. Periodic ones are clamped, over as many periods as the face's edges run through.
// ERRORS unsupported (no B-spline surface), bad_number, vanishing_weight, those of knots; `where` is empty.
Result<BsplinePatch<Rational, 4>> surface_of(const TopoDS_Face& face);

// The parameter curve of an edge on a face over its range, homogeneous.  ERRORS unsupported.
Result<BsplineCurve<Rational, 3>> parameters_of(const TopoDS_Edge& edge, const TopoDS_Face& face);

// The curve of an edge in space over its range, homogeneous. B-splines, Bézier curves and lines are taken exactly; others as Open
// CASCADE converts them, with another parameter (`converted`).
// ERRORS unsupported, bad_number, vanishing_weight, those of knots.
struct SpaceCurve {
  BsplineCurve<Rational, 4> curve;
  const char* kind;
  bool converted = false;
};
Result<SpaceCurve> curve_of(const TopoDS_Edge& edge);

}  // namespace patchproof::occt
