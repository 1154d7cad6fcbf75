// SPDX-License-Identifier: Apache-2.0
// Which edges of a set of patches meet: found from the geometry, in either direction, whole or in part.
//
// This decides only which edges are looked at; what is true of them is certified afterwards (certify.h). Distances here
// are ordinary doubles; parameters and pairings are then made exact:
//   * whole edges, equal or reversed, of any degrees and knots: the affine pairing of their ranges;
//   * edges that are the same curve under t → r t/(1 − t + r t): that pairing, r exact;
//   * edges that lie on each other but run differently: a monotone piecewise linear pairing, found numerically and frozen;
//   * T-junctions and partial overlaps: the end of one edge inside another, its parameter made exact when it is a knot or
//     a simple fraction of the edge;
//   * several patches on one edge: every pair;  * edges of one patch that meet: seams;
//   * lines inside a patch whose knots allow a kink or a gap (multiplicity ≥ degree).
// ENSURES  (1) every edge is in a join, or listed with its unmatched ranges, or collapsed;  (2) the result does not depend
//          on the order of the patches, up to naming;  (3) the lists are sorted.
// COST     O(n log n) for n edges of bounded overlap.
#pragma once

#include <functional>
#include <vector>

#include "patchproof/join/join.h"

namespace patchproof {

struct EdgeRange {
  int patch = 0;
  EdgeName edge = EdgeName::u_min;
  double begin = 0, end = 1;  // parameters of the edge
};

// An edge whose points all coincide.
struct CollapsedEdge {
  int patch = 0;
  EdgeName edge = EdgeName::u_min;
  bool exactly = false;  // every point is exactly the same; otherwise within 1e-9 of the diagonal and 1e-6 of its patch
  bool tangent_plane = false;  // proved: all limit normals at the point are parallel and equally oriented
};

template <ExactField T>
struct EdgeMatch {
  std::vector<Join<T>> joins;
  std::vector<EdgeRange> unmatched;
  std::vector<CollapsedEdge> collapsed;
  double diagonal = 0;  // of the box of all edges
  double length = 0;    // the match length used
};

// length: edges are looked at when their paired points are within it; 0 means 1e-6 of the diagonal, and never more than a
// tenth of the shorter edge.  is_edge(patch, edge): which edges there are; all, when it is empty.
template <ExactField T>
EdgeMatch<T> match_edges(const std::vector<const BsplinePatch<T, 4>*>& patches, double length = 0,
                         const std::function<bool(int, EdgeName)>& is_edge = {});

// The pairing of two whole edges, for joins that a file declares: affine, or rational linear when that makes them equal.
template <ExactField T>
Join<T> whole_edge_join(const std::vector<const BsplinePatch<T, 4>*>& patches, int patch_a, EdgeName edge_a,
                        int patch_b, EdgeName edge_b, bool reversed);

}  // namespace patchproof
