// SPDX-License-Identifier: Apache-2.0
// Knot insertion and Bézier extraction of whole surfaces and curves in double, by SIMD kernels.
//
//   d'_ij = Σ_k Σ_l a_ik b_jl d_{f_i + k, g_j + l}     0 ≤ k ≤ p, 0 ≤ l ≤ q
//
// a and b are the bands of spline/refinement_band.h, one for each direction; they depend on the knots only. A
// refinement is prepared once and used for any number of nets on these knots, by any number of threads. Any number of
// knots goes in at once, at the cost of two banded products; the lines along v are refined first.
// Rational surfaces: homogeneous points (w x, w y, w z, w). The products w x of the doubles given are rounded once,
// then the four numbers are refined like any others.
//
// REQUIRES  rounding to nearest; output and input do not overlap.
// ENSURES   (1) |computed − exact| ≤ γ_N S + U for every number written, where exact is the formula in exact arithmetic
//             on the knots, points and weights given, S = Σ Σ a_ik b_jl |d_kl| ≤ D, the largest |d|,
//             N = 6(p + q) + 2, for w x, w y, w z one more,   γ_N = N u/(1 − N u),  u = 2^-53,
//             U = ((p + 2)² + (q + 2)²)(1 + D) 2^-1074.
//           Why: a coefficient carries 5p roundings and what underflow took, 2^-1074 (p + 1)(p + 2)/2 in each row
//           (refinement_band.h); a term of the product is rounded once when multiplied and at most p times when added,
//           losing at most (p + 1) 2^-1075 to underflow; likewise for q; all coefficients are ≥ 0 and sum to 1, so the
//           second product magnifies nothing. The number of knots inserted does not enter.
//           (2) the bounds returned are those of (1) with D for S, D ≤ largest |w| · largest |x|;
//           (3) the same bits on every instruction set with fused multiply-add, and for any net around a point: its
//             numbers depend only on the (p + 1)(q + 1) old points of the formula;
//           (4) neighbouring Bézier pieces share the very same numbers along their common edge when the knot between
//             them has a multiplicity of at most the degree;
//           (5) the formula over Rational is patch_knots.h's and bezier_patch.h's, points without influence included.
//           Any multiplicity is legal, and knots may be unclamped.
// ERRORS    make…: bad_degree, wrong_count, decreasing_knots, empty_domain; bad_number: a knot is not finite, or their
//           range overflows; outside_domain: a new knot is outside the domain or NaN.
//           apply: wrong_count; bad_number: a number is not finite, or products w x may exceed 2^1022. Nothing is
//           written.
// COST      see validation/bench. apply works in less than 80 KiB for degrees up to 6, whatever the size of the net; it
//           allocates them once when they are more than 16 KiB.
// NEIGHBOURS patch_knots.h, bezier_patch.h (the exact templates, the oracle of the tests), evaluate_batch.h.
// TEST      tests/patch/refine_batch_test.cpp checks (1)–(5).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/instruction_set.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/refinement_band.h"

namespace patchproof {

// At least |computed − exact| of every number of one result.
struct RefinementBounds {
  double coordinate = 0;  // of x, y, z, or of w x, w y, w z
  double weight = 0;
};

class SurfaceRefinement {
 public:
  struct Knots {
    int degree_u = 0, degree_v = 0;
    std::span<const double> knots_u, knots_v;
  };

  // The surface on finer knots: each of new_u, new_v, in any order, is inserted once.
  static Result<SurfaceRefinement> make_insertion(const Knots& knots, std::span<const double> new_u,
                                                  std::span<const double> new_v);
  // The Bézier patches of the non-empty spans.
  static Result<SurfaceRefinement> make_bezier(const Knots& knots);

  // 1 for an insertion; for Bézier patches the number of spans.
  int pieces(Direction d) const { return axis(d).pieces; }
  // Of one piece.
  int count(Direction d) const { return axis(d).band.rows() / axis(d).pieces; }
  // Of an insertion: the knots. Of Bézier patches: the ends of their spans, pieces + 1 numbers.
  const std::vector<double>& knots(Direction d) const { return axis(d).knots; }
  const RefinementBand<double>& band(Direction d) const { return axis(d).band; }
  std::size_t point_count() const {
    return static_cast<std::size_t>(u_.band.rows()) * static_cast<std::size_t>(v_.band.rows());
  }

  // The net of every piece, one after the other, those along v running fastest; within a net j, along v, runs fastest.
  // points: x y z each; weights: none, or one for each point, and then the output is w x, w y, w z, w.
  // REQUIRES  out.size() == point_count() · (3 or 4), is_available(instructions).
  Result<RefinementBounds> apply(std::span<const double> points, std::span<const double> weights, std::span<double> out,
                                 InstructionSet instructions = InstructionSet::fastest) const;

 private:
  friend class CurveRefinement;
  struct Axis {
    RefinementBand<double> band;
    std::vector<double> knots;
    int pieces;
  };
  SurfaceRefinement(Axis u, Axis v) : u_(std::move(u)), v_(std::move(v)) {}
  const Axis& axis(Direction d) const { return d == Direction::u ? u_ : v_; }
  static Result<Axis> insertion_axis(int degree, std::span<const double> knots, std::span<const double> added);
  static Result<Axis> bezier_axis(int degree, std::span<const double> knots);

  Axis u_, v_;
};

// The same for curves; in the bounds p = 0.
class CurveRefinement {
 public:
  static Result<CurveRefinement> make_insertion(int degree, std::span<const double> knots,
                                                std::span<const double> added);
  static Result<CurveRefinement> make_bezier(int degree, std::span<const double> knots);

  int pieces() const { return line_.pieces(Direction::v); }
  int count() const { return line_.count(Direction::v); }
  const std::vector<double>& knots() const { return line_.knots(Direction::v); }
  std::size_t point_count() const { return line_.point_count(); }
  Result<RefinementBounds> apply(std::span<const double> points, std::span<const double> weights, std::span<double> out,
                                 InstructionSet instructions = InstructionSet::fastest) const {
    return line_.apply(points, weights, out, instructions);
  }

 private:
  explicit CurveRefinement(SurfaceRefinement line) : line_(std::move(line)) {}
  SurfaceRefinement line_;  // one line of a net
};

// From (w x, w y, w z, w) to x y z and w, as evaluate_batch.h takes them: x is the quotient, rounded once more.
// REQUIRES homogeneous.size() == 4 n, points.size() == 3 n, weights.size() == n.
void divide_by_weights(std::span<const double> homogeneous, std::span<double> points, std::span<double> weights);

}  // namespace patchproof
