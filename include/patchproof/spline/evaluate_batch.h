// SPDX-License-Identifier: Apache-2.0
// Curves at many parameters at once, in double, by SIMD kernels. (patch/evaluate_batch.h: the same for surfaces.)
//
//   C(t) = Σ w_i P_i N_{i,p}(t) / Σ w_i N_{i,p}(t),    C', C''
//
// A batch curve is prepared once: each polynomial piece is turned into a power series about a double near its middle, from
// the numbers given, in doubled precision, and rounded once. After that it never changes: any number of threads may use
// one without locks, and no call allocates (but for an error's text and for threads > 1).
//
// REQUIRES  rounding to nearest; output arrays do not overlap the parameters; any alignment, any count, 0 included.
// ENSURES   (1) |computed − exact| ≤ error_bound(derivative) in each coordinate, exact: the formula's value at the given
//           doubles; for points without weights that is at most 3(p + 1) · 2^-53 · 2^p · max |P| (1 + 2^-30) + 2^-1000;
//           (2) the same parameter gives the same bits: whatever its place, the count, the layout, the number
//           of threads, whether derivatives are asked for, and on every instruction set with fused multiply-add;
//           (3) both ends of the domain have values; at a knot `side` chooses the limit;  (4) a parameter outside the
//           domain, or NaN, or where the computed denominator is zero (it may be so where the exact one is smaller than its
//           rounding errors) ends the call with an error that names its index. Of the output, anything before that
//           index may be written, and nothing beyond its tile of 256 (with threads ≠ 1: anything).
// ERRORS    make: bad_degree, wrong_count, bad_number (NaN, infinite or overflowing), decreasing_knots, empty_domain.
//           evaluate: outside_domain, vanishing_weight.
// COST      see validation/bench; per value of degree p about 3(p + 1) fused operations on a vector of parameters.
// SOURCE    Horner's rule with derivatives: N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §5.2.
// NEIGHBOURS curve.h (the exact template, the oracle of the tests), patch/evaluate_batch.h.
// TEST      tests/spline/evaluate_batch_test.cpp checks (1)–(4).
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "patchproof/error.h"
#include "patchproof/instruction_set.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof {

// Where the vectors of one quantity go: the i-th to x[i·stride], y[i·stride], z[i·stride]. Empty: not wanted.
struct VectorArray {
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;
  std::ptrdiff_t stride = 1;

  // Three arrays of one coordinate each.
  static VectorArray separate(double* x, double* y, double* z) { return {x, y, z, 1}; }
  // xyzxyz…
  static VectorArray interleaved(double* xyz) { return {xyz, xyz + 1, xyz + 2, 3}; }
  // One field of an array of records that are `stride` doubles long.
  static VectorArray records(double* first, std::ptrdiff_t stride) { return {first, first + 1, first + 2, stride}; }

  bool wanted() const { return x != nullptr; }
  VectorArray from(std::ptrdiff_t i) const {
    return wanted() ? VectorArray{x + i * stride, y + i * stride, z + i * stride, stride} : *this;
  }
};

struct CurveData {
  int degree = 0;
  std::span<const double> knots;
  std::span<const double> points;   // x y z of each control point
  std::span<const double> weights;  // of each control point; empty: all 1
};

struct CurveOutput {
  VectorArray point, first, second;
};

struct CurveBatchOptions {
  Side side = Side::right;
  int threads = 1;                                        // 0: one per processor
  InstructionSet instructions = InstructionSet::fastest;  // REQUIRES is_available(instructions)
};

namespace kernels {
struct CurvePieces;
}

// Where parameters are: item i at u[i·stride], and v[i·stride] where there are two.
struct ParameterArray {
  const double* u = nullptr;
  const double* v = nullptr;
  std::size_t count = 0;
  std::ptrdiff_t stride = 1;

  // u v u v …
  static ParameterArray interleaved(const double* uv, std::size_t count) { return {uv, uv + 1, count, 2}; }
};

// What a call did.
struct BatchSummary {
  // Normals asked for where the computed S_u × S_v is 0, or below 2^-450 of its piece's size; they are written as 0 0 0.
  std::size_t undefined_normals = 0;
};

class BatchCurve {
 public:
  static Result<BatchCurve> make(const CurveData& data);

  double domain_begin() const;
  double domain_end() const;
  int degree() const;
  bool is_rational() const;

  // Of C, C', C'' (derivative 0, 1, 2): the largest of the pieces' bounds (kernels/error_bounds.h). +infinity where the
  // weights do not exceed the denominator's rounding errors.
  double error_bound(int derivative) const;

  // Item i at t[i]. Sorted parameters are fastest, any order is right.
  Result<BatchSummary> evaluate(std::span<const double> t, const CurveOutput& out,
                                const CurveBatchOptions& options = {}) const {
    return evaluate(ParameterArray{t.data(), nullptr, t.size()}, out, options);
  }
  Result<BatchSummary> evaluate(const ParameterArray& t, const CurveOutput& out,
                                const CurveBatchOptions& options = {}) const;

  const kernels::CurvePieces& pieces() const { return *pieces_; }

 private:
  explicit BatchCurve(std::shared_ptr<const kernels::CurvePieces> pieces) : pieces_(std::move(pieces)) {}
  std::shared_ptr<const kernels::CurvePieces> pieces_;
};

}  // namespace patchproof
