// SPDX-License-Identifier: Apache-2.0
// Splines from data: the B-spline curve that comes nearest to given samples, exactly.
//
//   minimise  Σ_a w_a |C(τ_a) − s_a|²,     C = Σ_j N_j c_j
//   D c = Aᵀ W s,     D = Aᵀ W A,     A_{a,j} = N_j(τ_a),     D = L Δ Lᵀ
//
// A has p + 1 numbers that are not 0 in each row, so D is a band matrix, and L has its band. At the end of the domain, and
// only there, the functions are taken from the left (knot_vector.h).
//
// There is one solution when the samples are spread over the knots (Schoenberg and Whitney): when each N_j can be given a
// sample of its own, in order, at which it is positive. That depends on comparisons of parameters and knots only, is decided
// first, and its failure is an error that names control points, knots and samples. More samples than control points are not
// enough.
//
// With as many samples as control points the solution interpolates: C(τ_a) = s_a.
//
// ENSURES   (1) match_samples: result[j] is the index of a sample with N_j > 0, at strictly increasing parameters; an error
//               when there are no such samples, and then D is singular;
//           (2) the residuals are orthogonal to the columns of A:  Σ_a w_a N_j(τ_a) (C(τ_a) − s_a) = 0 for each j;
//           (3) samples of a spline on these knots give back its control points, whatever the weights;
//           (4) as many samples as control points: the curve goes through all of them;
//           (5) an affine map of the samples maps the control points;
//           (6) L Δ Lᵀ = D, Δ > 0: BandedLdlt solves exactly; it refuses a matrix with a pivot that is not positive.
// REQUIRES  BandedLdlt: entry(i, k) = D_{i,i−k}, 0 ≤ k ≤ min(i, p).
// ERRORS    wrong_count: not as many points or weights as parameters, or fewer samples than control points; for
//           interpolate_curve, also more.  outside_domain: a parameter.  bad_weight: a weight that is not positive.
//           singular_fit: as said.
// SCALARS   T: ExactField (Rational, Quadratic); match_samples: OrderedField.
// COST      O(m p²) to set up, O(n p²) to factor, O(n p) for each coordinate; the numbers of L grow by those of a row of D with
//           each row, so that time grows with the square of n and more. fit_double.h is for the thousands.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapters XIII–XIV; I. Schoenberg and A. Whitney 1953. Algorithm 1 and
//           equation (6) of "From B-Spline to GERBS Curve and Surface", corrected (docs/errata.md).
// NEIGHBOURS sample_parameters.h (parameters and knots), fit_double.h.
// TEST      tests/spline/least_squares_test.cpp, tests/validation/fits_test.cpp
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/error.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof {

template <OrderedField K, std::size_t N>
struct CurveSamples {
  std::vector<K> parameters;      // in any order, also repeated
  std::vector<Vec<K, N>> points;  // as many
  std::vector<K> weights = {};    // as many and positive; empty: all 1
};

// For each control point a sample that determines it.
template <OrderedField K>
Result<std::vector<std::size_t>> match_samples(const KnotVector<K>& knots, const std::vector<K>& parameters);

// A symmetric band matrix of n rows, its lower half, factored.
template <ExactField T>
class BandedLdlt {
 public:
  // entries[i·(p + 1) + k] = D_{i,i−k}; those with k > i are not read. Empty: not positive definite.
  static std::optional<BandedLdlt> factor(int size, int half_width, std::vector<T> entries);
  // D x = b.
  template <std::size_t N>
  std::vector<Vec<T, N>> solve(std::vector<Vec<T, N>> b) const;

 private:
  BandedLdlt(int size, int half_width, std::vector<T> entries)
      : size_(size), half_width_(half_width), entries_(std::move(entries)) {}
  T& at(int i, int k) { return entries_[static_cast<std::size_t>(i) * (half_width_ + 1) + k]; }
  const T& at(int i, int k) const { return entries_[static_cast<std::size_t>(i) * (half_width_ + 1) + k]; }

  int size_, half_width_;
  std::vector<T> entries_;  // L below the diagonal, Δ on it
};

// Knots and parameters, set up once for any number of samples at these parameters.
template <ExactField T>
class LeastSquares {
 public:
  static Result<LeastSquares> make(KnotVector<T> knots, std::vector<T> parameters, std::vector<T> weights = {});

  const KnotVector<T>& knots() const { return knots_; }
  std::size_t sample_count() const { return spans_.size(); }
  // The row of A for one sample: its p + 1 functions from N_{first} on.
  int first(std::size_t sample) const { return spans_[sample] - knots_.degree(); }
  const T& basis(std::size_t sample, int k) const { return basis_[sample * (knots_.degree() + 1) + k]; }

  // REQUIRES as many samples as parameters.
  template <std::size_t N>
  std::vector<Vec<T, N>> control_points(const std::vector<Vec<T, N>>& samples) const;

 private:
  LeastSquares(KnotVector<T> knots, std::vector<T> weights, BandedLdlt<T> normal, std::vector<int> spans,
               std::vector<T> basis)
      : knots_(std::move(knots)),
        weights_(std::move(weights)),
        normal_(std::move(normal)),
        spans_(std::move(spans)),
        basis_(std::move(basis)) {}

  KnotVector<T> knots_;
  std::vector<T> weights_;
  BandedLdlt<T> normal_;
  std::vector<int> spans_;
  std::vector<T> basis_;
};

template <ExactField T, std::size_t N>
Result<BsplineCurve<T, N>> fit_curve(const KnotVector<T>& knots, const CurveSamples<T, N>& samples);

// The curve through the samples, one for each control point.
template <ExactField T, std::size_t N>
Result<BsplineCurve<T, N>> interpolate_curve(const KnotVector<T>& knots, const CurveSamples<T, N>& samples);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <OrderedField K>
std::string number_text(const K& x) {
  return x == x ? to_text(x) : "not a number";  // of doubles
}

// The first and the last function that is positive at t, among those that live on the span. Inside a span all are; at a knot
// a function that only begins (or, from the left, ends) there is 0, unless it jumps.
template <OrderedField K>
std::pair<int, int> positive_functions(const KnotVector<K>& knots, int span, const K& t) {
  const int p = knots.degree();
  int first = span - p, last = span;
  while (last > span - p && !(knots[last] < t)) --last;
  if (t == knots[span + 1]) {  // the end of the domain, seen from the left
    last = span;
    while (first < span && !(t < knots[first + p + 1])) ++first;
  }
  return {first, last};
}

template <OrderedField K>
Error singular_fit(const KnotVector<K>& knots, int first, int last, const std::vector<K>& samples) {
  const K begin = std::max(knots[first], knots.domain_begin());
  const K end = std::min(knots[last + knots.degree() + 1], knots.domain_end());
  const bool one = first == last;
  std::string where = one ? "control point " + std::to_string(first)
                          : "control points " + std::to_string(first) + " to " + std::to_string(last);
  if (one && !(begin < end))
    return {ErrorCode::singular_fit, std::move(where), "its function is 0 on the whole domain: no sample determines it",
            "knots " + to_text(knots[first]) + " to " + to_text(knots[last + knots.degree() + 1])};
  std::string message = one ? "its function has no sample at which it is positive"
                            : "their functions need " + std::to_string(last - first + 1) +
                                  " samples at different parameters, and have " + std::to_string(samples.size());
  std::string values = "knots " + to_text(begin) + " to " + to_text(end) + "; samples at";
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(samples.size(), kShown); ++i) values += (i ? ", " : " ") + to_text(samples[i]);
  if (samples.empty()) values += " none";
  if (samples.size() > kShown) values += ", …";
  return {ErrorCode::singular_fit, std::move(where), std::move(message), std::move(values)};
}

// Everything of samples but their points.
template <OrderedField K>
std::optional<Error> check_samples(const KnotVector<K>& knots, const std::vector<K>& parameters,
                                   const std::vector<K>& weights) {
  if (!weights.empty() && weights.size() != parameters.size())
    return Error{ErrorCode::wrong_count, "", std::to_string(parameters.size()) + " samples need as many weights",
                 std::to_string(weights.size())};
  for (std::size_t a = 0; a < weights.size(); ++a)
    if (!(K(0) < weights[a]))
      return Error{ErrorCode::bad_weight, "sample " + std::to_string(a), "its weight is not positive",
                   number_text(weights[a])};
  const auto matched = match_samples(knots, parameters);
  if (!matched) return matched.error();
  return std::nullopt;
}

template <OrderedField K, std::size_t N>
std::optional<Error> check_points(const CurveSamples<K, N>& samples) {
  if (samples.points.size() == samples.parameters.size()) return std::nullopt;
  return Error{ErrorCode::wrong_count, "", std::to_string(samples.points.size()) + " samples need as many parameters",
               std::to_string(samples.parameters.size())};
}

}  // namespace detail

template <OrderedField K>
Result<std::vector<std::size_t>> match_samples(const KnotVector<K>& knots, const std::vector<K>& parameters) {
  for (std::size_t a = 0; a < parameters.size(); ++a)
    if (!knots.in_domain(parameters[a]))
      return Error{ErrorCode::outside_domain, "sample " + std::to_string(a),
                   "its parameter lies outside the domain [" + to_text(knots.domain_begin()) + ", " +
                       to_text(knots.domain_end()) + "]",
                   detail::number_text(parameters[a])};
  const int n = knots.control_count();
  if (parameters.size() < static_cast<std::size_t>(n))
    return Error{ErrorCode::wrong_count, "", std::to_string(n) + " control points need as many samples or more",
                 std::to_string(parameters.size())};
  std::vector<std::size_t> order(parameters.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parameters[a] < parameters[b]; });
  order.erase(std::unique(order.begin(), order.end(),
                          [&](std::size_t a, std::size_t b) { return parameters[a] == parameters[b]; }),
              order.end());
  // For each function the samples at which it is positive, [begin, end) in order; both ends never decrease.
  std::vector<std::size_t> begin(n, order.size()), end(n, 0);
  for (std::size_t r = 0; r < order.size(); ++r) {
    const K& t = parameters[order[r]];
    const auto [first, last] = detail::positive_functions(knots, knots.find_span(t), t);
    for (int j = first; j <= last; ++j) {
      begin[j] = std::min(begin[j], r);
      end[j] = r + 1;
    }
  }
  // The first sample that is left to each function. When none is, the functions since the last one that skipped a sample
  // share too few.
  std::vector<std::size_t> out;
  std::size_t next = 0;
  int block = 0;
  for (int j = 0; j < n; ++j) {
    if (begin[j] >= next) block = j;
    next = std::max(next, begin[j]);
    if (next >= end[j]) {
      std::vector<K> shared;
      for (std::size_t r = begin[block]; r < end[j]; ++r) shared.push_back(parameters[order[r]]);
      return detail::singular_fit(knots, block, j, shared);
    }
    out.push_back(order[next++]);
  }
  return out;
}

template <ExactField T>
std::optional<BandedLdlt<T>> BandedLdlt<T>::factor(int size, int half_width, std::vector<T> entries) {
  PATCHPROOF_REQUIRES(size >= 0 && half_width >= 0 &&
                          entries.size() == static_cast<std::size_t>(size) * (static_cast<std::size_t>(half_width) + 1),
                      "BandedLdlt: half_width + 1 numbers in each row");
  BandedLdlt out(size, half_width, std::move(entries));
  for (int i = 0; i < size; ++i) {
    const int first = std::max(0, i - half_width);
    // Row i of L·Δ, then of L.
    for (int j = first; j < i; ++j)
      for (int l = std::max(first, j - half_width); l < j; ++l)
        out.at(i, i - j) += -(out.at(i, i - l) * out.at(j, j - l));
    for (int j = first; j < i; ++j) {
      const T scaled = out.at(i, i - j) / out.at(j, 0);
      out.at(i, 0) += -(scaled * out.at(i, i - j));
      out.at(i, i - j) = scaled;
    }
    if (scalar_traits<T>::sign(out.at(i, 0)) != Sign::positive) return std::nullopt;
  }
  return out;
}

template <ExactField T>
template <std::size_t N>
std::vector<Vec<T, N>> BandedLdlt<T>::solve(std::vector<Vec<T, N>> b) const {
  PATCHPROOF_REQUIRES(b.size() == static_cast<std::size_t>(size_), "BandedLdlt: as many numbers as rows");
  for (int i = 0; i < size_; ++i)
    for (int j = std::max(0, i - half_width_); j < i; ++j) b[i] += -(at(i, i - j) * b[j]);
  for (int i = size_ - 1; i >= 0; --i) {
    b[i] = (T(1) / at(i, 0)) * b[i];
    for (int j = i + 1; j < std::min(size_, i + half_width_ + 1); ++j) b[i] += -(at(j, j - i) * b[j]);
  }
  return b;
}

template <ExactField T>
Result<LeastSquares<T>> LeastSquares<T>::make(KnotVector<T> knots, std::vector<T> parameters, std::vector<T> weights) {
  if (auto error = detail::check_samples(knots, parameters, weights)) return *error;
  const int n = knots.control_count(), width = knots.degree() + 1;
  std::vector<int> spans;
  std::vector<T> basis, normal(static_cast<std::size_t>(n) * width, T(0));
  for (std::size_t a = 0; a < parameters.size(); ++a) {
    const int span = knots.find_span(parameters[a]);
    spans.push_back(span);
    const std::vector<T> row = basis_in_span<T>(knots, span, parameters[a]);
    for (int k = 0; k < width; ++k) {
      const T weighted = weights.empty() ? row[k] : weights[a] * row[k];
      for (int l = 0; l <= k; ++l)
        normal[static_cast<std::size_t>(span - width + 1 + k) * width + (k - l)] += weighted * row[l];
    }
    basis.insert(basis.end(), row.begin(), row.end());
  }
  auto factored = BandedLdlt<T>::factor(n, width - 1, std::move(normal));
  PATCHPROOF_REQUIRES(factored.has_value(), "LeastSquares: matched samples have a positive definite matrix");
  return LeastSquares(std::move(knots), std::move(weights), std::move(*factored), std::move(spans), std::move(basis));
}

template <ExactField T>
template <std::size_t N>
std::vector<Vec<T, N>> LeastSquares<T>::control_points(const std::vector<Vec<T, N>>& samples) const {
  PATCHPROOF_REQUIRES(samples.size() == sample_count(), "LeastSquares: as many samples as parameters");
  std::vector<Vec<T, N>> right(knots_.control_count());
  for (std::size_t a = 0; a < samples.size(); ++a)
    for (int k = 0; k <= knots_.degree(); ++k)
      right[first(a) + k] += (weights_.empty() ? basis(a, k) : weights_[a] * basis(a, k)) * samples[a];
  return normal_.solve(std::move(right));
}

template <ExactField T, std::size_t N>
Result<BsplineCurve<T, N>> fit_curve(const KnotVector<T>& knots, const CurveSamples<T, N>& samples) {
  if (auto error = detail::check_points(samples)) return *error;
  const auto solver = LeastSquares<T>::make(knots, samples.parameters, samples.weights);
  if (!solver) return solver.error();
  return BsplineCurve<T, N>(knots, solver->control_points(samples.points));
}

template <ExactField T, std::size_t N>
Result<BsplineCurve<T, N>> interpolate_curve(const KnotVector<T>& knots, const CurveSamples<T, N>& samples) {
  if (samples.points.size() != static_cast<std::size_t>(knots.control_count()))
    return Error{
        ErrorCode::wrong_count, "",
        "a curve with " + std::to_string(knots.control_count()) + " control points goes through as many samples",
        std::to_string(samples.points.size())};
  return fit_curve(knots, samples);
}

}  // namespace patchproof
