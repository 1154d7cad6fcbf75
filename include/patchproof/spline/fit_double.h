// SPDX-License-Identifier: Apache-2.0
// Splines from data in double precision, with a proven bound of what the rounding did.
//
// The fit is that of least_squares.h, solved in doubles by a sparse band factorisation and refined. Each control point comes with
// a bound of its distance, coordinate by coordinate, from the control point of the exact least-squares curve of the same data.
// The bound is no estimate: everything in it is computed in intervals.
//
//   x  the doubles found,   r ∋ Aᵀ W (s − A x),   d a correction in doubles,   r' = r − D d
//   |x_j − c_j| ≤ |d_j| + σ_j ‖S r'‖₂ / λ,     λ ≤ the smallest eigenvalue of S D S,   S = diag(σ), powers of 2
//
// λ: for L and Δ ≥ 0 of any origin, S D S − α I = L Δ Lᵀ + E makes every eigenvalue of S D S at least α − ‖E‖; L and Δ are the
// doubles of a factorisation, and ‖E‖ is bounded in intervals by its largest sum of a row.
//
// A bound for the control points is one for the curves at every parameter: the functions are not negative and sum to 1.
//
// ENSURES   (1) |points[j][c] − exact[j][c]| ≤ errors[j][c] for the exact solution of the data as they are given (doubles count
//               as the numbers that they are), hence |Ĉ(t) − C(t)| ≤ largest_error in each coordinate, for all t;
//           (2) a fit that cannot be certified has infinite errors, and never small ones; is_certified() tells;
//           (3) what least_squares.h refuses is refused here with the same error.
// ERRORS    as fit_curve. bad_number: data that is not finite, or beyond the doubles.  singular_fit: also a fit whose solution
//           in doubles is not finite.
// SCALARS   K: double, Rational or Quadratic, of knots, parameters, weights and samples; the control points are doubles.
// COST      O(m p²), and O(n p²) some ten times.
// SOURCE    S. Rump, Verification of positive definiteness, BIT 46 (2006), for the shifted factorisation; the enclosure here
//           needs no analysis of its rounding. Eigen's SimplicialLDLT.
// NEIGHBOURS least_squares.h (exact), sample_parameters.h.
// TEST      tests/spline/fit_double_test.cpp
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/spline/least_squares.h"

namespace patchproof {

template <OrderedField K, std::size_t N>
struct CertifiedFit {
  BsplineCurve<double, N, K> curve;
  std::vector<Vec<double, N>> errors;  // of each control point; infinite where nothing is proven
  double inverse;                      // 1/λ, rounded up

  double largest_error() const {
    double out = 0;
    for (const Vec<double, N>& e : errors) out = std::max(out, *std::max_element(e.c.begin(), e.c.end()));
    return out;
  }
  bool is_certified() const { return largest_error() < std::numeric_limits<double>::infinity(); }
};

template <OrderedField K, std::size_t N>
Result<CertifiedFit<K, N>> fit_curve_double(const KnotVector<K>& knots, const CurveSamples<K, N>& samples);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The system in intervals.
struct SampledSystem {
  int degree, controls;
  std::vector<int> first;                     // function of each sample's row
  std::vector<Interval> basis;                // p + 1 for each sample
  std::vector<Interval> weights;              // one for each sample
  std::vector<std::vector<Interval>> values;  // for each coordinate one for each sample
};
struct CertifiedColumns {
  std::vector<std::vector<double>> points, errors;  // for each coordinate one for each control point
  double inverse;
};
Result<CertifiedColumns> solve_certified(const SampledSystem& system);

// The number in an interval with finite ends.
template <OrderedField K>
std::optional<Interval> enclose_finite(const K& x) {
  if constexpr (std::same_as<K, double>) {
    if (!std::isfinite(x)) return std::nullopt;
    return Interval(x);
  } else {
    const Interval out = embed<Interval>(x);
    if (!std::isfinite(out.inf()) || !std::isfinite(out.sup())) return std::nullopt;
    return out;
  }
}

template <OrderedField K>
Error beyond_doubles(std::string where, const K& x) {
  return {ErrorCode::bad_number, std::move(where), "a number beyond the doubles", number_text(x)};
}

}  // namespace detail

template <OrderedField K, std::size_t N>
Result<CertifiedFit<K, N>> fit_curve_double(const KnotVector<K>& knots, const CurveSamples<K, N>& samples) {
  if (auto error = detail::check_points(samples)) return *error;
  for (const K& t : knots.knots())
    if (!detail::enclose_finite(t)) return detail::beyond_doubles("knots", t);
  if (auto error = detail::check_samples(knots, samples.parameters, samples.weights)) return *error;
  detail::SampledSystem system{knots.degree(), knots.control_count(), {}, {}, {}, {}};
  system.values.resize(N);
  for (std::size_t a = 0; a < samples.points.size(); ++a) {
    const std::string where = "sample " + std::to_string(a);
    for (std::size_t c = 0; c < N; ++c) {
      const auto value = detail::enclose_finite(samples.points[a][c]);
      if (!value) return detail::beyond_doubles(where, samples.points[a][c]);
      system.values[c].push_back(*value);
    }
    const auto weight = samples.weights.empty() ? Interval(1) : detail::enclose_finite(samples.weights[a]);
    if (!weight) return detail::beyond_doubles(where, samples.weights[a]);
    system.weights.push_back(*weight);
    const int span = knots.find_span(samples.parameters[a]);
    system.first.push_back(span - knots.degree());
    const RoundingGuard guard;
    const std::vector<Interval> row = basis_in_span<Interval>(knots, span, samples.parameters[a]);
    system.basis.insert(system.basis.end(), row.begin(), row.end());
  }
  auto solved = detail::solve_certified(system);
  if (!solved) return solved.error();
  std::vector<Vec<double, N>> points(knots.control_count()), errors(knots.control_count());
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t j = 0; j < points.size(); ++j) {
      points[j][c] = solved->points[c][j];
      errors[j][c] = solved->errors[c][j];
    }
  return CertifiedFit<K, N>{BsplineCurve<double, N, K>(knots, std::move(points)), std::move(errors), solved->inverse};
}

}  // namespace patchproof
