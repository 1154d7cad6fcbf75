// SPDX-License-Identifier: Apache-2.0
// Joins at edges of GERBS surfaces that are no splines: with a transcendental B-function, or trigonometric local surfaces.
//
// Classes are proved from what the surfaces are made of:
//   a seam of a closed direction    both ends are one formula: Cⁿ for B of order n, all n for infinite order, as far as the
//                                   local surfaces are smooth there
//   two edges of one make           equal B-functions and knots, and local curves along the edge that are equal, exactly: C⁰;
//                                   the same of their derivatives across it: C¹; derivatives that differ by a constant: G¹
// and gap and angle are enclosed over the whole edge by Taylor models (trimmed_join.h). A lower bound above 0 refutes.
//
// Inside such a surface there may be lines where it is torn (a knot that stands twice), where its B-function of order 0 leaves a kink,
// or where a local surface has a knot that allows one. certify_inner_lines lists those that are not proved to be C1: G1 by the exact
// classes of the local surfaces, refuted by limits from both sides that differ at some place, or undecided.
//
// ENSURES  (1) proven and refuted are theorems;  (2) lower ≤ sup ≤ upper, of gap and angles;
//          (3) certify_inner_lines: across every inner line that is not listed the surface is C1.
// REQUIRES what trimmed_join.h does. COST about a millisecond for each piece of an edge.
// TEST     tests/join/gerbs_join_test.cpp checks (1)–(3).
#pragma once

#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/join/join.h"
#include "patchproof/patch/gerbs_surface.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

// A spline, or a GERBS surface with its outline (patch/gerbs_outline.h).
struct BlendedSide {
  const BsplinePatch<Rational, 4>* surface;
  const GerbsSurface<Rational, 4>* gerbs = nullptr;
};

Certificate certify_blended_join(const BlendedSide& a, const BlendedSide& b, const Join<Rational>& join,
                                 const Request& request = {});

struct InnerLine {
  Join<Rational> join;  // of the surface with itself; patch_a and patch_b are left to the caller
  Certificate certificate;
};
std::vector<InnerLine> certify_inner_lines(const GerbsSurface<Rational, 4>& surface, const Request& request = {});

// Each of them, on `jobs` threads (0: one per processor). Joins refer to `surfaces` by their index.
std::vector<Certificate> certify_blended_joins(const std::vector<BlendedSide>& surfaces,
                                               const std::vector<Join<Rational>>& joins, const Request& request = {},
                                               int jobs = 0);

}  // namespace patchproof
