// SPDX-License-Identifier: Apache-2.0
// How far triangles are from the surfaces that they stand for: measured at samples, alike for the meshes of anyone.
//
// Nothing but the corners' positions and the face of each triangle is used: their parameters are found again by projection, the
// three of a triangle starting from the place of its centre, so that seams do not mislead. At a pole a corner has many parameters: of
// 17 those count that give the least parametric distance.
#pragma once

#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <memory>
#include <vector>

#include "patchproof/mesh/watertight.h"

namespace patchproof::tessellation {

struct Foot {
  double u, v, distance;
};

// The surface of a face over the box of the face's parameters.
class FaceSurface {
 public:
  explicit FaceSurface(const TopoDS_Face& face);

  gp_Pnt at(double u, double v) const { return surface_->Value(u, v); }
  // The nearest point near (u, v), and from the nearest points of a grid.
  Foot descend(const gp_Pnt& point, double u, double v) const;
  Foot nearest(const gp_Pnt& point) const;

  // Parameters that a corner there may have: more than its own where a side of the box is one point (a pole).
  std::vector<Foot> alternatives(const Foot& foot) const;

 private:
  struct Node {
    double u, v;
    gp_Pnt at;
  };

  std::shared_ptr<BRepAdaptor_Surface> surface_;
  double begin_[2], end_[2];
  bool collapsed_[2][2];  // [k][s]: the side where parameter k is at its begin (s = 0) or end is one point
  std::vector<Node> grid_;
};

struct Measured {
  double to_surface = 0;  // largest distance from a sample of a triangle to the nearest point of its face's surface
  double to_mesh = 0;  // … from the surface's point at the sample's interpolated parameters to the nearest triangle
  double parametric = 0;  // … between the sample and that point: not less than either
  double corners = 0;     // … from a corner to the surface; part of all three

  double error() const { return std::max(to_surface, to_mesh); }
};

// At the 66 points of each triangle whose barycentric coordinates are tenths.
Measured measure(const CertifiedMesh& mesh, const std::vector<FaceSurface>& surfaces);

}  // namespace patchproof::tessellation
