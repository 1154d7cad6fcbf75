// SPDX-License-Identifier: Apache-2.0
// Patches made from curves, expanded exactly to B-spline patches.
#pragma once

#include "raw_spline.h"

namespace patchproof {

// A curve, or one shrunk to a point.
template <ExactField T>
struct ControlCurve {
  ModelCurve<T> curve;
  bool is_point = false;
};

// The exact counterpart of RawConstruction.
template <ExactField T>
struct Construction {
  RawConstruction::Kind kind = RawConstruction::Kind::coons;
  std::map<std::string, std::vector<ControlCurve<T>>> curves;
  std::map<std::string, std::vector<T>> parameters;
  std::optional<KnotVector<T>> blending;
  bool along_u = true;
};

template <ExactField T>
struct ExpandedConstruction {
  BsplinePatch<T, 4> surface;
  bool is_rational = false;  // then its denominator is yet to be looked at
  std::string kind;          // "bilinearly blended Coons patch"
};

// A limit of the work: boxes between knots, times the square of the control points of each, times curves,
// times the length of the longest number where that is long.
inline constexpr double kMaxExpansion = 5e6;
// And of the equations that give a Gordon surface its blending functions: curves along one direction to the fourth, times the
// digits of a parameter.
inline constexpr double kMaxSystem = 4e6;

// T: Rational or Quadratic.
// ERRORS  those of coons_patch.h, transfinite.h and gordon_surface.h;  wrong_count: some of the four derivatives across;
//         unsupported: rational curves in a bicubically blended or a Gordon patch, and more work than kMaxExpansion;
//         bad_degree: an expansion of a degree above kMaxDegree. `where` names a corner or is empty.
template <ExactField T>
Result<ExpandedConstruction<T>> expand(const Construction<T>& construction);

}  // namespace patchproof
