// SPDX-License-Identifier: Apache-2.0
// One face of a model while it is meshed: its loops, its points, its triangles and what is proved of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cells.h"
#include "trimmed_loops.h"

namespace patchproof {

// An edge and its samples.
struct EdgeMesh {
  std::vector<int> faces;  // of each use
  std::vector<bool> forward;
  std::vector<ParameterCurve> curves;
  double tolerance = 0;
  std::vector<double> t;      // increasing, the ends included
  std::vector<int> vertices;  // of each sample
};

struct FacePoint {
  Vec<double, 2> at;
  int vertex = -1;  // of an edge, or −1: the face's own
  Vec<double, 3> place{};
  double offset = 0;  // of the place from the surface there
};

// A segment of the border: between samples of an edge, or across a gap.
struct FaceSide {
  int a, b;                      // points
  int edge = -1;                 // −1: a gap
  double middle = 0;             // where the edge would be cut; of a gap between 0 and 1
  int joint = -1;                // of a gap
  std::array<double, 2> bend{};  // how far the curve leaves it
};

struct FaceTriangle {
  std::array<int, 3> corners;
  double chord = 0, angle = 0;
};

struct FaceMesh {
  std::string label, fault;  // fault: why it is left out
  SurfacePieces pieces;
  std::vector<DirectedUse> uses;
  std::vector<Joint> joints;
  std::vector<std::vector<double>> gaps;  // of each joint: where the gap is cut
  std::vector<Vec<double, 2>> inner;      // points of the face's own
  bool dirty = true;

  std::vector<FacePoint> points;
  std::vector<FaceSide> sides;
  std::vector<FaceTriangle> triangles;
  std::vector<std::pair<int, double>> cuts;  // asked for: edge and where

  void link(int self, const std::vector<EdgeMesh>& edges);
  // A bound of the bend of the parameter curve and of the surface along it, as a distance. REQUIRES a RoundingGuard alive.
  double along(const ParameterCurve& curve, double a, double b) const;
  void mesh(const std::vector<EdgeMesh>& edges, const std::vector<Vec<double, 3>>& places, const MeshRequest& request,
            const Triangulator& triangulator);
  // Those that the last mesh() asked for. False: none.
  bool add_points();

 private:
  void lay_border(const std::vector<EdgeMesh>& edges);
  void prove(FaceTriangle& t, const MeshRequest& request,
             const std::vector<std::pair<std::array<int, 2>, int>>& border);
  void ask(const FaceTriangle& t, const SurfaceHull& hull, double flat, const std::array<int, 3>& side_of, double lens,
           int lens_side, const MeshRequest& request);

  std::vector<Vec<double, 2>> wanted_;
  std::vector<std::pair<int, double>> wanted_gaps_;
};

}  // namespace patchproof
