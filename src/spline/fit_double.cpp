// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/fit_double.h"

#define EIGEN_MPL2_ONLY  // nothing under another licence
#include <Eigen/SparseCholesky>
#include <cmath>

namespace patchproof::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Numbers = std::vector<double>;
using Intervals = std::vector<Interval>;
using Sparse = Eigen::SparseMatrix<double>;
using Factored = Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;

// A symmetric band matrix: at(i, k) is the entry (i, i − k).
struct Band {
  int size, width;  // width: diagonals, the main one included
  Intervals entries;

  Band(int n, int w) : size(n), width(w), entries(static_cast<std::size_t>(n) * w) {}
  Interval& at(int i, int k) { return entries[static_cast<std::size_t>(i) * width + k]; }
  const Interval& at(int i, int k) const { return entries[static_cast<std::size_t>(i) * width + k]; }
};

double middle(const Interval& x) { return x.inf() / 2 + x.sup() / 2; }
double largest(const Interval& x) { return std::max(std::fabs(x.inf()), std::fabs(x.sup())); }
bool is_finite(const Numbers& x) {
  return std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); });
}

// Eᵢ for |x| about 2^Eᵢ; 0 for 0.
int exponent_of(double x) {
  int e = 0;
  std::frexp(x, &e);
  return std::isfinite(x) && x != 0 ? e : 0;
}

// The system with weights and values of about 1, and its matrix D with a diagonal of about 1: row and column j are multiplied
// by 2^−scale[j].
struct Scaled {
  SampledSystem system;
  Band normal;
  std::vector<int> scale;
  std::vector<int> value_scale;  // of each coordinate
};

// Aᵀ W y. REQUIRES a RoundingGuard.
Intervals weighted_sums(const SampledSystem& s, const Intervals& y) {
  Intervals out(s.controls);
  const int width = s.degree + 1;
  for (std::size_t a = 0; a < y.size(); ++a) {
    const Interval weighted = s.weights[a] * y[a];
    for (int k = 0; k < width; ++k) out[s.first[a] + k] += s.basis[a * width + k] * weighted;
  }
  return out;
}

Scaled scaled(SampledSystem s) {
  double heaviest = 0;
  for (const Interval& w : s.weights) heaviest = std::max(heaviest, w.sup());
  for (Interval& w : s.weights) w = scale_by_power_of_two(w, -exponent_of(heaviest));
  std::vector<int> value_scale;
  for (Intervals& column : s.values) {
    double top = 0;
    for (const Interval& v : column) top = std::max(top, largest(v));
    value_scale.push_back(exponent_of(top));
    for (Interval& v : column) v = scale_by_power_of_two(v, -value_scale.back());
  }
  const int width = s.degree + 1;
  Band normal(s.controls, width);
  {
    const RoundingGuard guard;
    for (std::size_t a = 0; a < s.first.size(); ++a)
      for (int k = 0; k < width; ++k) {
        const Interval weighted = s.weights[a] * s.basis[a * width + k];
        for (int l = 0; l <= k; ++l) normal.at(s.first[a] + k, k - l) += weighted * s.basis[a * width + l];
      }
  }
  std::vector<int> scale;
  for (int i = 0; i < s.controls; ++i) scale.push_back(exponent_of(middle(normal.at(i, 0))) / 2);
  for (int i = 0; i < s.controls; ++i)
    for (int k = 0; k < width && k <= i; ++k)
      normal.at(i, k) = scale_by_power_of_two(normal.at(i, k), -scale[i] - scale[i - k]);
  return {std::move(s), std::move(normal), std::move(scale), std::move(value_scale)};
}

// The doubles in the middle of D, less shift on the diagonal.
Sparse middle_of(const Band& band, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < band.size; ++i)
    for (int k = 0; k < band.width && k <= i; ++k)
      entries.emplace_back(i, i - k, middle(band.at(i, k)) - (k == 0 ? shift : 0));
  Sparse out(band.size, band.size);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Numbers solve(const Factored& factored, const Numbers& right) {
  const Eigen::Map<const Eigen::VectorXd> b(right.data(), static_cast<Eigen::Index>(right.size()));
  const Eigen::VectorXd x = factored.solve(b);
  return {x.data(), x.data() + x.size()};
}

// About the smallest eigenvalue, by inverse iteration.
double estimated_smallest_eigenvalue(const Factored& factored, int size) {
  Numbers v(size);
  for (int i = 0; i < size; ++i) v[i] = (i % 2 ? -1 : 1) * (1 + (i * 7 % 13) / 16.0);
  double smallest = 0;
  for (int step = 0; step < 12; ++step) {
    const Numbers w = solve(factored, v);
    double vv = 0, vw = 0, top = 0;
    for (int i = 0; i < size; ++i) {
      vv += v[i] * v[i];
      vw += v[i] * w[i];
      top = std::max(top, std::fabs(w[i]));
    }
    smallest = vv / vw;
    if (!(top > 0 && top < kInfinity && smallest < kInfinity)) return 0;
    for (int i = 0; i < size; ++i) v[i] = w[i] / top;
  }
  return smallest;
}

// An upper bound of the largest sum of a row of |D − α I − L Δ Lᵀ|; infinite when L leaves the band or Δ is not positive.
double defect(const Band& band, double shift, const Factored& factored) {
  const Eigen::VectorXd delta = factored.vectorD();
  if (!(delta.array() > 0).all()) return kInfinity;
  std::vector<double> lower(static_cast<std::size_t>(band.size) * band.width, 0.0);  // L_{i, i−k}
  const auto at = [&](int i, int k) -> double& { return lower[static_cast<std::size_t>(i) * band.width + k]; };
  for (int i = 0; i < band.size; ++i) at(i, 0) = 1;
  const auto& l = factored.matrixL().nestedExpression();
  for (int column = 0; column < l.outerSize(); ++column)
    for (std::remove_cvref_t<decltype(l)>::InnerIterator it(l, column); it; ++it) {
      const int k = static_cast<int>(it.row()) - column;
      if (k == 0) continue;
      if (k < 0 || k >= band.width || !std::isfinite(it.value())) return kInfinity;
      at(static_cast<int>(it.row()), k) = it.value();
    }
  if (!delta.allFinite()) return kInfinity;
  const RoundingGuard guard;
  Intervals sums(band.size);
  for (int i = 0; i < band.size; ++i)
    for (int k = 0; k < band.width && k <= i; ++k) {
      Interval e = band.at(i, k);
      if (k == 0) e -= Interval(shift);
      const int j = i - k;
      for (int c = std::max(0, i - band.width + 1); c <= j; ++c)
        e -= Interval(at(i, i - c)) * Interval(delta[c]) * Interval(at(j, j - c));
      const double size = largest(e);
      if (!(size < kInfinity)) return kInfinity;
      sums[i] += Interval(size);
      if (k > 0) sums[j] += Interval(size);
    }
  double out = 0;
  for (const Interval& s : sums) out = std::max(out, s.sup());
  return out;
}

// An upper bound of the norm of D⁻¹; infinite when D is not proven positive definite.
double inverse_bound(const Band& band, double estimate) {
  double alpha = estimate / 4 * 3;
  for (int attempt = 0; attempt < 12 && alpha > 0; ++attempt, alpha /= 2) {
    const Factored factored(middle_of(band, alpha));
    if (factored.info() != Eigen::Success) continue;
    const double wrong = defect(band, alpha, factored);
    if (!(wrong < alpha)) continue;
    const RoundingGuard guard;
    const Interval smallest = Interval(alpha) - Interval(wrong);
    if (smallest.inf() > 0) return (Interval(1) / Interval(smallest.inf())).sup();
  }
  return kInfinity;
}

// S Aᵀ W (s − A S x), x the unknowns in the scaling of D.
Intervals residual(const Scaled& s, std::size_t coordinate, const Numbers& x) {
  const RoundingGuard guard;
  const int width = s.system.degree + 1;
  Intervals control;
  for (std::size_t j = 0; j < x.size(); ++j) control.push_back(scale_by_power_of_two(Interval(x[j]), -s.scale[j]));
  Intervals y = s.system.values[coordinate];
  for (std::size_t a = 0; a < y.size(); ++a)
    for (int k = 0; k < width; ++k) y[a] -= s.system.basis[a * width + k] * control[s.system.first[a] + k];
  Intervals out = weighted_sums(s.system, y);
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = scale_by_power_of_two(out[j], -s.scale[j]);
  return out;
}

Numbers middles(const Intervals& x) {
  Numbers out;
  for (const Interval& v : x) out.push_back(middle(v));
  return out;
}

// |x − exact| ≤ |d| + ‖r − D d‖₂ · inverse, in the scaling of D.
Numbers error_bounds(const Band& normal, Intervals r, const Numbers& d, double inverse) {
  const std::size_t n = r.size();
  if (!is_finite(d) || !(inverse < kInfinity)) return Numbers(n, kInfinity);
  const RoundingGuard guard;
  for (int i = 0; i < normal.size; ++i)
    for (int k = 0; k < normal.width && k <= i; ++k) {
      r[i] -= normal.at(i, k) * Interval(d[i - k]);
      if (k > 0) r[i - k] -= normal.at(i, k) * Interval(d[i]);
    }
  Interval squares(0);
  for (const Interval& v : r) {
    if (!(largest(v) < kInfinity)) return Numbers(n, kInfinity);
    squares += square(Interval(largest(v)));
  }
  if (!(squares.sup() < kInfinity)) return Numbers(n, kInfinity);
  const Interval rest = Interval(sqrt(Interval(squares.sup())).sup()) * Interval(inverse);
  Numbers out;
  for (const double v : d) out.push_back((Interval(std::fabs(v)) + Interval(0, rest.sup())).sup());
  return out;
}

}  // namespace

Result<CertifiedColumns> solve_certified(const SampledSystem& system) {
  const Scaled s = scaled(system);
  const std::size_t n = s.scale.size();
  const Error not_finite{ErrorCode::singular_fit, "",
                         "doubles cannot hold the solution of this fit; exact arithmetic can",
                         std::to_string(n) + " control points"};
  const Factored factored(middle_of(s.normal, 0));
  if (factored.info() != Eigen::Success) return not_finite;
  const double estimate = estimated_smallest_eigenvalue(factored, static_cast<int>(n));
  CertifiedColumns out{{}, {}, estimate > 0 ? inverse_bound(s.normal, estimate) : kInfinity};
  for (std::size_t c = 0; c < s.system.values.size(); ++c) {
    Numbers x(n, 0.0), points;
    double before = kInfinity;
    for (int step = 0; step < 8; ++step) {  // refine as long as that helps
      const Numbers d = solve(factored, middles(residual(s, c, x)));
      double step_size = 0;
      for (const double v : d) step_size = std::max(step_size, std::fabs(v));
      if (step == 0 && !is_finite(d)) return not_finite;
      if (!is_finite(d) || !(step_size < before / 2)) break;
      for (std::size_t j = 0; j < n; ++j) x[j] += d[j];
      before = step_size;
    }
    if (!is_finite(x)) return not_finite;
    // The doubles that are handed out are the ones that are judged, rounding at the end of their range included.
    for (std::size_t j = 0; j < n; ++j) points.push_back(std::ldexp(x[j], s.value_scale[c] - s.scale[j]));
    if (!is_finite(points)) return not_finite;
    bool same = true;
    for (std::size_t j = 0; j < n; ++j) {
      x[j] = std::ldexp(points[j], s.scale[j] - s.value_scale[c]);
      same = same && std::ldexp(x[j], s.value_scale[c] - s.scale[j]) == points[j];
    }
    const Intervals r = residual(s, c, x);
    const Numbers d = solve(factored, middles(r));
    Numbers errors = error_bounds(s.normal, r, d, same ? out.inverse : kInfinity);
    for (std::size_t j = 0; j < n; ++j)
      if (errors[j] < kInfinity)
        errors[j] = scale_by_power_of_two(Interval(errors[j]), s.value_scale[c] - s.scale[j]).sup();
    out.points.push_back(std::move(points));
    out.errors.push_back(std::move(errors));
  }
  return out;
}

}  // namespace patchproof::detail
