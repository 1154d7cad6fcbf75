// SPDX-License-Identifier: Apache-2.0
// The exact values of a case, by the templates on Rational, and how far a double is from them.
//
// ENSURES  (1) values are those of rational_derivatives on the patch or curve whose homogeneous points are the exact
//          products of the case's doubles;  (2) a unit normal lies within 2^-200 of the recorded Rational;
//          (3) ulp(x) is the distance from the double nearest to |x| to the next larger one; 2^-1074 for x = 0.
// COST     about 0.1 ms for a point of degree (3, 3) with its derivatives.
// TEST     tests/validation/corpus_test.cpp checks (1)–(3).
#pragma once

#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/curve.h"
#include "validation/corpus/cases.h"

namespace patchproof::validation {

using ExactVector = Vec<Rational, 3>;

// S, S_u, S_v, S_uu, S_uv, S_vv; a normal is held apart: it may not exist.
inline constexpr int kPoint = 0, kDu = 1, kDv = 2, kDuu = 3, kDuv = 4, kDvv = 5, kSurfaceVectors = 6;

struct SurfaceTruth {
  std::array<ExactVector, kSurfaceVectors> vectors;
  ExactVector normal;       // S_u × S_v over its length; 0 where that is 0
  bool has_normal = false;  // S_u × S_v ≠ 0
};

using CurveTruth = std::array<ExactVector, 3>;  // C, C', C''

BsplinePatch<Rational, 4> exact_patch(const SurfaceData& data);
BsplineCurve<Rational, 4> exact_curve(const CurveData& data);

// `derivatives`: 0 points only, 1 first ones and normals too, 2 all.
SurfaceTruth exact_values(const BsplinePatch<Rational, 4>& patch, double u, double v, Side side, int derivatives);
CurveTruth exact_values(const BsplineCurve<Rational, 4>& curve, double t, Side side, int derivatives);

// A case with all its values.
struct KnownSurface {
  SurfaceCase data;
  std::vector<SurfaceTruth> scattered, grid;  // grid item i · grid_v.size() + j
};
struct KnownCurve {
  CurveCase data;
  std::vector<CurveTruth> values;
};
// In the order given, computed in parallel.
std::vector<KnownSurface> with_truth(std::vector<SurfaceCase> cases);
std::vector<KnownCurve> with_truth(std::vector<CurveCase> cases);

Rational ulp(const Rational& x);

// |computed − exact|, infinite for NaN and infinities.
struct Deviation {
  bool is_finite = true;
  Rational modulus;
};
Deviation deviation(double computed, const Rational& exact);

// The deviation in units of ulp(x): infinite only when it is not finite.
double in_ulps(const Deviation& d, const Rational& x);

// The coordinate of largest modulus.
Rational largest_coordinate(const ExactVector& v);

// Beyond the largest double: no kernel can write it.
bool overflows(const Rational& x);

}  // namespace patchproof::validation
