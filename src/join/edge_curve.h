// SPDX-License-Identifier: Apache-2.0
// An edge in doubles, for looking at it only: nothing here is certified.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "patchproof/patch/boundary.h"
#include "patchproof/scalar/quadratic.h"

namespace patchproof {

using Point3 = std::array<double, 3>;

inline double distance(const Point3& a, const Point3& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

// Some double next to x, fast.
inline double approximate(double x) { return x; }
template <ExactField T>
double approximate(const T& x) {
  return enclose(x).inf();
}

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

template <ExactField T>
EdgeCurve edge_curve(const BsplinePatch<T, 4>& patch, EdgeName edge) {
  const IsoLine<T> line = edge_line(patch, edge);
  const BsplineCurve<T, 4> row = std::move(cross_boundary_rows(patch, line, 0)[0]);
  std::vector<double> knots;
  for (const T& k : row.knots().knots()) knots.push_back(nearest_double(k));
  std::vector<Vec<double, 4>> points;
  for (const Vec<T, 4>& p : row.points())
    points.push_back({{approximate(p[0]), approximate(p[1]), approximate(p[2]), approximate(p[3])}});
  return EdgeCurve(KnotVector<double>::make_unchecked(row.degree(), std::move(knots)), std::move(points));
}

}  // namespace patchproof
