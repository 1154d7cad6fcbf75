// SPDX-License-Identifier: Apache-2.0
// NURBS boundary Gregory patches at many parameters at once, in double.
//
//   S = S^u + S^v − S^c and its derivatives as in gregory_patch.h; normal (S_u × S_v) / |S_u × S_v|
//
// S^u and S^v come from the kernels of evaluate_batch.h, for the control points, weights and knots of the two surfaces rounded to
// the nearest doubles: u_surface() and v_surface(). S^c is that of the patch itself, so that it stays as smooth at the corners
// as corners that agree make it; it comes from one body on vectors of 8 parameters. A batch is prepared once and never
// changes afterwards: any number of threads may use one without locks.
//
// With weights the homogeneous S^c is not tame next to the corners: within 2^-10 of them values are found exactly and rounded.
//
// REQUIRES  make: corners_agree(patch). Rounding to nearest; outputs do not overlap the parameters; any alignment, any count, 0
//           included.
// ENSURES   (1) |computed − exact| ≤ error_bound() in each coordinate, for points always, for derivatives where is_polynomial();
//           exact: at the given doubles the value of u_surface() plus that of v_surface() less that of the patch's S^c;
//           (2) the same (u,v) gives the same bits, whatever its place, the count, the layout, the number of threads, whatever
//           else is asked for, and on every instruction set with fused multiply-add;
//           (3) every parameter of the closed square has finite values; within 2^-256 of a corner second derivatives are those at
//           that distance on the same ray, in the corner on the ray in the middle;  (4) at a knot the side chooses the limit;
//           (5) a parameter outside [0, 1], or NaN, ends the call with an error that names its index. Anything may have been
//           written before it;  (6) is_polynomial: every weight is 1 (then Q⁰ and Q¹ differ in the four inner points only).
// ERRORS    make: bad_number (a number is not finite in double), and the other errors of BatchSurface::make. evaluate:
//           outside_domain, vanishing_weight.
// COST      validation/bench measures it; make: some hundred microseconds.
// SOURCE    the bound: S^c is a sum of products of rounded numbers; the same body run on counters of roundings gives their
//           largest number n, and the moduli of the products sum up to
//             point  m + s/5,    S_u, S_v  6 m + 2 s,    S_uu, S_vv  24 m + 27 s,    S_uv  36 m + 27 s,
//           m = max |Q¹|, s = Σ_pq |Q⁰ − Q¹| of the inner points; then |error of S^c| ≤ γ(n) times that.
// NEIGHBOURS evaluate_batch.h, gregory_patch.h (the exact template, the oracle of the test).
// TEST      tests/patch/gregory_batch_test.cpp checks (1)–(6).
#pragma once

#include <memory>
#include <span>

#include "patchproof/patch/evaluate_batch.h"
#include "patchproof/patch/gregory_patch.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

namespace kernels {
struct GregoryPieces;
}

class BatchGregory {
 public:
  static Result<BatchGregory> make(const GregoryPatch<Rational>& patch);

  const GregoryPatch<Rational>& patch() const;
  // Of doubles.
  const BsplinePatch<Rational, 4>& u_surface() const;
  const BsplinePatch<Rational, 4>& v_surface() const;
  bool is_polynomial() const;
  // +infinity where nothing is known in advance: derivatives unless is_polynomial().
  double error_bound(SurfaceVector vector) const;

  // Item i at (u[i], v[i]), in any order. REQUIRES as many u as v.
  Result<BatchSummary> evaluate(std::span<const double> u, std::span<const double> v, const SurfaceOutput& out,
                                const SurfaceBatchOptions& options = {}) const;

 private:
  explicit BatchGregory(std::shared_ptr<const kernels::GregoryPieces> pieces) : pieces_(std::move(pieces)) {}
  std::shared_ptr<const kernels::GregoryPieces> pieces_;
};

}  // namespace patchproof
