// SPDX-License-Identifier: Apache-2.0
// Joins of trimmed faces: two surfaces, and on each a curve in its parameters, run through together by one parameter t.
//
//   gap    g(t) = | S_a(c_a(t)) − S_b(c_b(t)) |
//   angle  θ(t) = the angle in [0°, 180°] between the faces' normals, ±S_u × S_v at c_a(t) and c_b(t)
//
// Both are enclosed over the whole range of t. S∘c is evaluated at Taylor models of t (scalar/taylor_model.h), so the
// differences are formed on coefficients; their Bernstein hulls are bounded by deviation.h, and pieces are halved where
// that is not yet tight. A piece lies between knots of both surfaces; where a parameter curve crosses or follows a knot
// line, pieces that cannot be told apart are taken on every polynomial they may belong to.
//
// A whole edge along which both parameter curves are straight, on an edge of its surface's domain, and run at constant speed is
// an isoparametric join (join.h): to_isoparametric recognises it, and certify_join decides it exactly.
//
// Where a normal vanishes at an end, its limit is taken. Where it would, but for rounding (2⁻³⁰ of its length amid the edge),
// it points anywhere at the end itself: that end, 2⁻²⁴ of the edge, is left out of the angles, and said in `poles`.
//
// REQUIRES  denominators without a zero on the domains; parameter curves over the same range. Where a curve leaves its
//           surface's domain (by rounding), the surface's outermost polynomials are continued: see `outside`.
// ENSURES   (1) lower ≤ sup ≤ upper; lower is attained at `t`;  (2) exactly equal edges give lower = 0, and an upper bound
//           of the size of the rounding errors;  (3) swapping or reversing both sides gives the same enclosures up to
//           rounding;  (4) where to_isoparametric answers, certify_join's bounds and these overlap.
// ERRORS    none: what is not bounded ends as upper = +infinity (gap) or 180 (angle), not converged.
// COST      about 0.3 ms for each piece of a pair of bicubic surfaces; budget.nodes halvings at most, and
//           four for each knot of the parameter curves.
// TEST      tests/join/trimmed_join_test.cpp checks (1)–(4).
#pragma once

#include <optional>
#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/join/deviation.h"
#include "patchproof/join/join.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/patch/gerbs_surface.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

// A face along an edge. Where it is a GERBS surface that is no spline, bounds are those of `gerbs`, and `surface` only tells its
// domain, and about where it lies.
struct TrimmedSide {
  const BsplinePatch<Rational, 4>* surface;
  BsplineCurve<Rational, 3> parameters;  // homogeneous (w·u, w·v, w)
  bool flipped = false;                  // the face's normal is −S_u × S_v
  const GerbsSurface<Rational, 4>* gerbs = nullptr;
};

struct TrimmedJoin {
  TrimmedSide a, b;
};

struct TrimmedBound {
  double lower = 0, upper = 0;  // gap: model units;  angles: degrees
  Rational t;                   // the witness of `lower`
  bool converged = true;  // upper − lower ≤ 1 % of upper, or upper below 2⁻³⁶ of the edge's size, 2⁻³⁴ degrees
};

// An end of the edge where a side has no normal.
struct TrimmedPole {
  char side;            // 'a' or 'b'
  Rational begin, end;  // of t: the end itself, or the range that is left out of the angles
  bool left_out;
};

struct TrimmedBounds {
  TrimmedBound gap, angle, plane_angle;
  double outside = 0;  // how far a parameter curve leaves the domain of its surface, at least: found where pieces end
  std::vector<TrimmedPole> poles;
};

// REQUIRES (debug) a RoundingGuard alive.
TrimmedBounds bound_trimmed(const TrimmedJoin& join, const Budget& budget = {});

// The same join as two edges of the surfaces' domains, whole or in part, when the parameter curves run along them within
// `slack` of the domains' lengths (rounding leaves them there: 2⁻⁴⁰ is that). The pairing is then that of the edges.
std::optional<Join<Rational>> to_isoparametric(const TrimmedJoin& join, const Rational& slack = Rational(0));

// Where a tolerance of the gap is asked for and paired points are farther apart, `lower` is the distance of one of them from the
// whole other edge: a bound that no pairing enters. Only that exceeds a tolerance.
// What can be said of the join: by certify_join where it is isoparametric, else the bounds (rung "taylor"). Bounds prove no
// class; a gap with a lower bound above 0 refutes C0, with exact values at the witness.
Certificate certify_trimmed(const TrimmedJoin& join, const Request& request = {});

}  // namespace patchproof
