// SPDX-License-Identifier: Apache-2.0
// An edge in doubles, for looking at it only: nothing here is certified.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "patchproof/patch/boundary.h"
#include "patchproof/scalar/quadratic.h"

namespace patchproof {

using Point3 = std::array<double, 3>;

inline double distance(const Point3& a, const Point3& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

// A double next to mantissa · 2^exponent = x, for numbers of any size.
struct Approximate {
  double mantissa = 0;
  long exponent = 0;
  double scaled(long by) const {
    const long e = exponent + by;
    return e > 2000 ? std::ldexp(mantissa, 2000) : e < -3000 ? 0.0 : std::ldexp(mantissa, static_cast<int>(e));
  }
};
inline Approximate approximate(const Rational& x) {
  long n = 0, d = 0;
  const double numerator = mpz_get_d_2exp(&n, mpq_numref(x.backend().data()));
  const double denominator = mpz_get_d_2exp(&d, mpq_denref(x.backend().data()));
  return numerator == 0 ? Approximate{} : Approximate{numerator / denominator, n - d};
}
inline Approximate approximate(const Quadratic& x) {
  const ScaledInterval s = enclose_scaled(x);
  return {s.mantissa.inf(), s.exponent};
}

// Where doubles are used: x_frame = (x − origin) · 2^−exponent, exact before rounding, so that the model's place and size do
// not matter. In it the model has a size near one.
template <ExactField T>
struct Frame {
  Vec<T, 3> origin;
  long exponent = 0;

  // The homogeneous point in the frame, all components times 2^weight_exponent.
  Vec<double, 4> operator()(const Vec<T, 4>& h, long weight_exponent) const {
    Vec<double, 4> out;
    for (int c = 0; c < 3; ++c) out[c] = approximate(T(h[c] - origin[c] * h[3])).scaled(weight_exponent - exponent);
    out[3] = approximate(h[3]).scaled(weight_exponent);
    return out;
  }
};

// The exponent of the largest weight.
template <ExactField T>
long weight_exponent(const std::vector<Vec<T, 4>>& points) {
  long largest = std::numeric_limits<long>::min();
  for (const Vec<T, 4>& p : points) {
    const Approximate w = approximate(p[3]);
    if (w.mantissa != 0) largest = std::max(largest, w.exponent);
  }
  return largest == std::numeric_limits<long>::min() ? 0 : largest;
}

// Control points with a smaller share of the largest weight tell little about where the surface is.
inline constexpr double kNotableWeight = 0x1p-10;

// The boundary curve of one edge, parametrised by [0, 1] whatever the knots.
class EdgeCurve {
 public:
  EdgeCurve(const KnotVector<double>& knots, std::vector<Vec<double, 4>> points)
      : knots_(knots), points_(std::move(points)), begin_(knots.domain_begin()), end_(knots.domain_end()) {}

  Point3 operator()(double unit) const {
    const double t = std::clamp(begin_ + unit * (end_ - begin_), begin_, end_);
    const int p = knots_.degree(), span = knots_.find_span(t);
    std::vector<Vec<double, 4>> d(points_.begin() + (span - p), points_.begin() + (span + 1));
    for (int r = 1; r <= p; ++r)
      for (int j = p; j >= r; --j) {
        const double lower = knots_[span - p + j], upper = knots_[span + j - r + 1];
        d[j] = d[j - 1] + (t - lower) / (upper - lower) * (d[j] - d[j - 1]);
      }
    return {d[p][0] / d[p][3], d[p][1] / d[p][3], d[p][2] / d[p][3]};
  }

  // The unit parameter in [from, to] whose point is nearest to q, and its distance.
  std::pair<double, double> nearest(const Point3& q, double from = 0, double to = 1) const {
    const int samples = 16 * (knots_.control_count() - knots_.degree()) + 16;
    double best = from, best_distance = distance((*this)(from), q);
    for (int i = 1; i <= samples; ++i) {
      const double t = from + (to - from) * i / samples, d = distance((*this)(t), q);
      if (d < best_distance) best = t, best_distance = d;
    }
    // Golden-section search around the best sample.
    const double golden = (std::sqrt(5.0) - 1) / 2, step = (to - from) / samples;
    double a = std::max(from, best - step), b = std::min(to, best + step);
    for (int i = 0; i < 60 && b - a > 1e-15; ++i) {
      const double x = b - golden * (b - a), y = a + golden * (b - a);
      if (distance((*this)(x), q) <= distance((*this)(y), q))
        b = y;
      else
        a = x;
    }
    const double refined = (a + b) / 2, d = distance((*this)(refined), q);
    return d < best_distance ? std::pair{refined, d} : std::pair{best, best_distance};
  }

  const std::vector<Vec<double, 4>>& points() const { return points_; }

 private:
  KnotVector<double> knots_;
  std::vector<Vec<double, 4>> points_;
  double begin_, end_;
};

// Are a over [a0, a1] and b over [b0, b1] within `near` of each other, at equal shares of both, for more than `shortest`?
inline bool run_together(const EdgeCurve& a, double a0, double a1, const EdgeCurve& b, double b0, double b1,
                         double near, double shortest) {
  constexpr int kSteps = 8;
  double length = 0;
  Point3 last = a(a0);
  for (int i = 1; i <= kSteps; ++i) {
    const double s = double(i) / kSteps;
    const Point3 p = a(a0 + s * (a1 - a0));
    if (!(distance(p, b(b0 + s * (b1 - b0))) <= near)) return false;
    length += distance(last, p);
    last = p;
  }
  return length > shortest;
}

template <ExactField T>
EdgeCurve edge_curve(const BsplinePatch<T, 4>& patch, EdgeName edge, const Frame<T>& frame) {
  const IsoLine<T> line = edge_line(patch, edge);
  const BsplineCurve<T, 4> row = std::move(cross_boundary_rows(patch, line, 0)[0]);
  // Knots relative to the domain: where it lies and how long it is does not matter either.
  const T begin = row.knots().domain_begin(), length = row.knots().domain_end() - begin;
  std::vector<double> knots;
  for (const T& k : row.knots().knots()) knots.push_back(nearest_double(T((k - begin) / length)));
  const long exponent = weight_exponent(row.points());
  std::vector<Vec<double, 4>> points;
  for (const Vec<T, 4>& p : row.points()) points.push_back(frame(p, -exponent));
  return EdgeCurve(KnotVector<double>::make_unchecked(row.degree(), std::move(knots)), std::move(points));
}

}  // namespace patchproof
