// SPDX-License-Identifier: Apache-2.0
// Surfaces at many parameters at once, in double, by SIMD kernels.
//
//   S(u,v) = Σ w_ij P_ij N_{i,p}(u) N_{j,q}(v) / Σ w_ij N_{i,p}(u) N_{j,q}(v)
//   S_u, S_v, S_uu, S_uv, S_vv;   normal (S_u × S_v) / |S_u × S_v|
//
// Bézier patches are B-spline patches with Bézier knots. A batch surface is prepared once: each polynomial piece becomes a
// power series about doubles near the middle of its spans, computed from the numbers given in doubled precision and
// rounded once. After that it never changes: any number of threads may use one without locks, and no call allocates (but
// for an error's text, threads ≠ 1, and points that only exact arithmetic can round).
//
// REQUIRES  rounding to nearest; outputs do not overlap the parameters; any alignment, any count, 0 included.
// ENSURES   (1) |computed − exact| ≤ error_bound() in each coordinate, exact: the formula's value at the given doubles;
//           for points without weights that is at most 3(p + q + 1) · 2^-53 · 2^(p+q) · max |P| (1 + 2^-30) + 2^-1000;
//           (2) the same (u,v) gives the same bits: whatever its place, the count, the layout, scattered or grid, the
//           number of threads, whatever else is asked for, and on every instruction set with fused multiply-add;
//           (3) both ends of the domain have values; at a knot the side chooses the limit;  (4) a parameter outside the
//           domain, or NaN, or where the computed denominator is zero (it may be so where the exact one is smaller than its
//           rounding errors) ends the call with an error that names its index. Of the output, anything before that
//           index may be written, and nothing beyond its tile of 256 (with threads ≠ 1: anything);
//           (5) |point − exact| ≤ bound[i] in each coordinate (evaluate_bounded);  (6) lower[i] ≤ exact ≤ upper[i]
//           (evaluate_interval);  (7) evaluate_correctly_rounded: the double nearest to the exact coordinate, the even one
//           of two;  (8) evaluate_compensated: as if in twice the precision, then rounded: for degrees up to 8 the error
//           is at most (1/2 + 2^-20) ulp for values above 2^-900 where the moduli of the terms sum up to at most 2^20 times
//           the value.
// ERRORS    make: bad_degree, wrong_count, bad_number (NaN, infinite, overflowing), decreasing_knots, empty_domain.
//           evaluate…: outside_domain, vanishing_weight.
// COST      validation/bench measures it. make: a few microseconds for each polynomial piece of degree (3, 3).
// NEIGHBOURS bspline_patch.h, rational_patch.h (the exact templates, the oracle of the tests), error_bounds.h.
// TEST      tests/patch/evaluate_batch_test.cpp checks (1)–(6), correctly_rounded_test.cpp (7), (8); patchproof validate
//           all of them over a larger corpus.
#pragma once

#include <memory>
#include <span>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/evaluate_batch.h"

namespace patchproof {

struct SurfaceData {
  int degree_u = 0, degree_v = 0;
  std::span<const double> knots_u, knots_v;
  std::span<const double> points;   // x y z of each control point, j (along v) running fastest
  std::span<const double> weights;  // of each control point; empty: all 1
};

enum class SurfaceVector { point, du, dv, duu, duv, dvv };

// What is wanted, and where it goes. Only what is asked for is computed.
struct SurfaceOutput {
  VectorArray point, du, dv, normal, duu, duv, dvv;
};

struct SurfaceBatchOptions {
  Side side_u = Side::right, side_v = Side::right;
  int threads = 1;                                        // 0: one per processor
  InstructionSet instructions = InstructionSet::fastest;  // REQUIRES is_available(instructions)
};

namespace kernels {
struct SurfacePieces;
}

class BatchSurface {
 public:
  static Result<BatchSurface> make(const SurfaceData& data);

  ParameterBox<double> domain() const;
  int degree(Direction d) const;
  bool is_rational() const;

  // Of evaluate and evaluate_grid, everywhere: the largest of the pieces' bounds (kernels/error_bounds.h). +infinity where
  // the weights do not exceed the denominator's rounding errors: evaluate_bounded knows more there.
  double error_bound(SurfaceVector vector) const;

  // Item i at (u[i], v[i]), in any order.
  Result<BatchSummary> evaluate(const ParameterArray& at, const SurfaceOutput& out,
                                const SurfaceBatchOptions& options = {}) const;
  // Item i · v.size() + j at (u[i], v[j]).
  Result<BatchSummary> evaluate_grid(std::span<const double> u, std::span<const double> v, const SurfaceOutput& out,
                                     const SurfaceBatchOptions& options = {}) const;
  // bound[i] ≥ |computed − exact| in each coordinate of point i; +infinity where the denominator may be zero.
  Result<BatchSummary> evaluate_bounded(const ParameterArray& at, const VectorArray& point, double* bound,
                                        const SurfaceBatchOptions& options = {}) const;
  Result<BatchSummary> evaluate_interval(const ParameterArray& at, const VectorArray& lower, const VectorArray& upper,
                                         const SurfaceBatchOptions& options = {}) const;
  Result<BatchSummary> evaluate_compensated(const ParameterArray& at, const VectorArray& point,
                                            const SurfaceBatchOptions& options = {}) const;
  Result<BatchSummary> evaluate_correctly_rounded(const ParameterArray& at, const VectorArray& point,
                                                  const SurfaceBatchOptions& options = {}) const;

  // The same of parameters in two lists. REQUIRES as many u as v.
  using List = std::span<const double>;
  Result<BatchSummary> evaluate(List u, List v, const SurfaceOutput& out,
                                const SurfaceBatchOptions& options = {}) const {
    return evaluate(lists(u, v), out, options);
  }
  Result<BatchSummary> evaluate_bounded(List u, List v, const VectorArray& point, double* bound,
                                        const SurfaceBatchOptions& options = {}) const {
    return evaluate_bounded(lists(u, v), point, bound, options);
  }
  Result<BatchSummary> evaluate_interval(List u, List v, const VectorArray& lower, const VectorArray& upper,
                                         const SurfaceBatchOptions& options = {}) const {
    return evaluate_interval(lists(u, v), lower, upper, options);
  }
  Result<BatchSummary> evaluate_compensated(List u, List v, const VectorArray& point,
                                            const SurfaceBatchOptions& options = {}) const {
    return evaluate_compensated(lists(u, v), point, options);
  }
  Result<BatchSummary> evaluate_correctly_rounded(List u, List v, const VectorArray& point,
                                                  const SurfaceBatchOptions& options = {}) const {
    return evaluate_correctly_rounded(lists(u, v), point, options);
  }

  const kernels::SurfacePieces& pieces() const { return *pieces_; }

 private:
  static ParameterArray lists(List u, List v) {
    PATCHPROOF_REQUIRES(u.size() == v.size(), "batch evaluation: as many u as v");
    return {u.data(), v.data(), u.size()};
  }
  explicit BatchSurface(std::shared_ptr<const kernels::SurfacePieces> pieces) : pieces_(std::move(pieces)) {}
  std::shared_ptr<const kernels::SurfacePieces> pieces_;
};

}  // namespace patchproof
