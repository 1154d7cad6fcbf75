// SPDX-License-Identifier: Apache-2.0
// What a batch curve or surface holds: its polynomial pieces as power series, laid out for the kernels. Plain data,
// immutable after it is prepared.
//
//   piece (a, b), x = (u − u.centre[a]) · u.scale[a], y likewise:  A(u,v) = Σ_ij c_ij x^i y^j,  |x|, |y| < 1
//
// with c_ij = (x, y, z, w) homogeneous; of a surface without weights the fourth number is that of its bound (bounded_kernels.h).
// Scales are powers of two, so that factors of derivatives are exact, and centres are doubles: the only rounding of x is
// that of u − centre.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace patchproof::kernels {

struct Axis {
  int degree = 0;
  int count = 0;                      // of spans
  double begin = 0, end = 0;          // the domain, closed
  std::vector<double> centre, scale;  // of each span
  std::vector<double> reach;          // the largest |x| in each span
  std::vector<int> knot_span;         // the span's number in the knot vector
  // Span s begins at right[s] for the limits from the right, at left[s] (the next double) for those from the left;
  // [count] is +infinity. The first is the domain's begin.
  std::vector<double> right, left;
  // Buckets of equal length: parameters with index(t) = floor((t − begin) · per_unit) = b lie in span first[b] or one of
  // the next `steps`.
  std::vector<std::int64_t> first;
  double per_unit = 0;
  int steps = 0;

  const double* begins(bool from_left) const { return (from_left ? left : right).data(); }
};

// How far a piece's numbers can be from exact ones anywhere in it: error_bounds.h derives them.
struct PieceBounds {
  // Of S, S_u, S_v, S_uu, S_uv, S_vv: bounds of the error in each coordinate. +infinity: the denominator may vanish.
  double error[6]{};
  // Of the homogeneous point (rational surfaces only).
  double numerator_error = 0, weight_error = 0;
  // Powers of two that bring S_u and S_v near 1.
  double normal_scale_u = 1, normal_scale_v = 1;
  // Of the compensated kernels' homogeneous coordinates x, y, z, w, before the last rounding.
  double compensated[4]{};
};

// Numbers at a multiple of 64 bytes.
class Coefficients {
 public:
  Coefficients() = default;
  explicit Coefficients(std::size_t count) : storage_(count + 8) {
    offset_ = (64 - reinterpret_cast<std::uintptr_t>(storage_.data()) % 64) % 64 / sizeof(double);
  }
  Coefficients(Coefficients&&) = default;  // the numbers stay where they are
  Coefficients& operator=(Coefficients&&) = default;
  const double* data() const { return storage_.data() + offset_; }
  double* data() { return storage_.data() + offset_; }

 private:
  std::vector<double> storage_;
  std::size_t offset_ = 0;
};

struct SurfacePieces {
  Axis u, v;
  bool rational = false;
  // In every piece the weights exceed the denominator's rounding errors: it needs no watching.
  bool safe_weights = true;
  int row = 0;             // numbers of one pair of rows of coefficients: 8 · (u.degree + 1)
  std::size_t piece = 0;   // numbers of one piece: row · ceil((v.degree + 1) / 2)
  Coefficients high, low;  // c rounded, and what rounding took away, rounded
  std::vector<PieceBounds> bounds;
  // The numbers given: the exact truth.
  std::vector<double> knots_u, knots_v, points, weights;

  // Offset of c_ij in its piece: rows j in pairs, so that a vector of eight numbers holds two of them.
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j / 2) * row + static_cast<std::size_t>(i) * 8 + (j & 1) * 4;
  }
  const double* coefficients(std::int64_t piece_u, std::int64_t piece_v) const {
    return high.data() + static_cast<std::size_t>(piece_u * v.count + piece_v) * piece;
  }
};

struct CurvePieces {
  Axis t;
  bool rational = false;
  bool safe_weights = true;
  Coefficients high;                // c_i of one piece: (x, y, z, w) at 4·i
  std::vector<PieceBounds> bounds;  // of C, C', C''
  std::vector<double> knots, points, weights;

  std::size_t piece() const { return 4 * (static_cast<std::size_t>(t.degree) + 1); }
};

}  // namespace patchproof::kernels
