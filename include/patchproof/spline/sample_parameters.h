// SPDX-License-Identifier: Apache-2.0
// Where samples lie on a spline that is to be fitted to them, and the knots of that spline.
//
//   uniform knots      b … b, b + h, b + 2h, …, e … e,      p + 1 times at either end,  h = (e − b)/(n − p)
//   uniform samples    τ_a = b + a (e − b)/(m − 1),         a = 0 … m − 1
//   chord length       τ_a = b + (e − b) s_a/s_{m−1},       s_a the length of the polygon up to sample a, in double
//   averaged knots     inner knot j = (σ_j + … + σ_{j+p−1})/p,   j = 1 … n − p − 1;   σ_j the ⌊j (M − 1)/(n − 1)⌋-th of the M
//                      different sample parameters in increasing order; for degree 0 the middle of σ_{j−1} and σ_j
//
// Averaged knots are de Boor's rule for interpolation when n = M. When there are more samples, the same rule is applied to n
// of them, the first and the last included.
//
// REQUIRES  begin < end.
// ENSURES   (1) uniform_clamped_knots: n control points, all spans of one length, clamped at begin and end;
//           (2) uniform_parameters: equal steps, from exactly begin to exactly end;
//           (3) chord_length_parameters: never decreasing, from exactly begin to exactly end, each a double's distance along
//               the domain; samples that are one point have one parameter;
//           (4) averaged_knots: a fit on them to these samples is never singular (least_squares.h): t_j < σ_j < t_{j+p+1} for
//               inner j, because each knot is an average of p parameters that all lie on its own side of σ_j.
// ERRORS    bad_degree: a degree below 0.  wrong_count: fewer than p + 1 control points; one sample only; for averaged_knots
//           fewer different parameters than control points.  singular_fit: samples that are all one point.
//           bad_number: a polygon longer than the largest double.
// SCALARS   T: ExactField (Rational, Quadratic).
// COST      linear; averaged_knots sorts.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapter XIII (knot averages); equations (1) and (5) of "From B-Spline to
//           GERBS Curve and Surface", corrected (docs/errata.md).
// NEIGHBOURS least_squares.h (the fit), knot_vector.h.
// TEST      tests/spline/sample_parameters_test.cpp
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof {

// Clamped knots with equal spans. The default domain is [0, n − p], so that each span has length 1.
template <ExactField T>
Result<KnotVector<T>> uniform_clamped_knots(int degree, int count, const T& begin, const T& end);
template <ExactField T>
Result<KnotVector<T>> uniform_clamped_knots(int degree, int count) {
  return uniform_clamped_knots<T>(degree, count, T(0), T(std::max(1, count - degree)));
}

template <ExactField T>
Result<std::vector<T>> uniform_parameters(std::size_t samples, const T& begin, const T& end);

// N: 1, 2 or 3.
template <ExactField T, std::size_t N>
Result<std::vector<T>> chord_length_parameters(const std::vector<Vec<T, N>>& samples, const T& begin, const T& end);

// The parameters may stand in any order, and more than once.
template <ExactField T>
Result<KnotVector<T>> averaged_knots(int degree, int count, std::vector<T> parameters);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

inline std::optional<Error> check_counts(int degree, int count) {
  if (degree < 0) return Error{ErrorCode::bad_degree, "", "the degree is negative", std::to_string(degree)};
  if (count <= degree)
    return Error{ErrorCode::wrong_count, "",
                 "a spline of degree " + std::to_string(degree) + " has more control points than its degree",
                 std::to_string(count)};
  return std::nullopt;
}

}  // namespace detail

template <ExactField T>
Result<KnotVector<T>> uniform_clamped_knots(int degree, int count, const T& begin, const T& end) {
  PATCHPROOF_REQUIRES(begin < end, "uniform_clamped_knots: begin < end");
  if (auto error = detail::check_counts(degree, count)) return *error;
  const int spans = count - degree;
  std::vector<T> knots(degree + 1, begin);
  for (int j = 1; j < spans; ++j) knots.push_back(begin + (end - begin) * T(j) / T(spans));
  knots.resize(static_cast<std::size_t>(count) + degree + 1, end);
  return KnotVector<T>::make(degree, std::move(knots));
}

template <ExactField T>
Result<std::vector<T>> uniform_parameters(std::size_t samples, const T& begin, const T& end) {
  PATCHPROOF_REQUIRES(begin < end, "uniform_parameters: begin < end");
  if (samples < 2)
    return Error{ErrorCode::wrong_count, "", "equal steps need two samples or more", std::to_string(samples)};
  std::vector<T> out;
  const T step = (end - begin) / T(static_cast<int>(samples - 1));
  for (std::size_t a = 0; a < samples; ++a) out.push_back(begin + T(static_cast<int>(a)) * step);
  return out;
}

template <ExactField T, std::size_t N>
Result<std::vector<T>> chord_length_parameters(const std::vector<Vec<T, N>>& samples, const T& begin, const T& end) {
  static_assert(1 <= N && N <= 3);
  PATCHPROOF_REQUIRES(begin < end, "chord_length_parameters: begin < end");
  if (samples.size() < 2)
    return Error{ErrorCode::wrong_count, "", "a polygon has two samples or more", std::to_string(samples.size())};
  std::vector<double> length{double(0)};
  for (std::size_t a = 1; a < samples.size(); ++a) {
    double step = 0;
    for (std::size_t c = 0; c < N; ++c) step = std::hypot(step, nearest_double(T(samples[a][c] - samples[a - 1][c])));
    length.push_back(length.back() + step);
  }
  const double total = length.back();
  if (!std::isfinite(total))
    return Error{ErrorCode::bad_number, "", "the polygon of the samples is longer than the largest double", ""};
  if (total == 0) return Error{ErrorCode::singular_fit, "", "all samples are one point", ""};
  std::vector<T> out;
  for (const double s : length) out.push_back(begin + (end - begin) * T(from_double(s / total)));
  return out;
}

template <ExactField T>
Result<KnotVector<T>> averaged_knots(int degree, int count, std::vector<T> parameters) {
  if (auto error = detail::check_counts(degree, count)) return *error;
  std::sort(parameters.begin(), parameters.end());
  parameters.erase(std::unique(parameters.begin(), parameters.end()), parameters.end());
  const std::size_t different = parameters.size();
  if (different < 2 || different < static_cast<std::size_t>(count))
    return Error{ErrorCode::wrong_count, "",
                 std::to_string(count) + " control points need as many different parameters, and two at least",
                 std::to_string(different)};
  const auto chosen = [&](int j) -> const T& {
    return parameters[static_cast<std::size_t>(j) * (different - 1) / static_cast<std::size_t>(count - 1)];
  };
  std::vector<T> knots(degree + 1, parameters.front());
  for (int j = 1; j < count - degree; ++j) {
    T sum = degree == 0 ? chosen(j - 1) + chosen(j) : chosen(j);
    for (int i = 1; i < degree; ++i) sum += chosen(j + i);
    knots.push_back(sum / T(degree == 0 ? 2 : degree));
  }
  knots.resize(static_cast<std::size_t>(count) + degree + 1, parameters.back());
  return KnotVector<T>::make(degree, std::move(knots));
}

}  // namespace patchproof
