// SPDX-License-Identifier: Apache-2.0
// Which ends of curves meet: candidates from a grid of cells, decided exactly.
#include <algorithm>
#include <cmath>
#include <map>

#include "patchproof/join/curve_join.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {
namespace {

constexpr double kDefaultReach = 1e-6;  // of the diagonal

template <ExactField T>
struct End {
  EndOfCurve of;
  Vec<T, 3> point;
  std::array<double, 3> near{};  // the point in doubles
  double tolerance = 0;
  double own_reach = 0;  // of the match length, for a curve as small as this
  double tenth = 0;      // of the size of its curve
  std::vector<int> partners = {};
  bool crowded = false;
};

double finite(double x) { return std::clamp(x, -1e300, 1e300); }

// The box of the control points; the exact points of a curve with positive weights lie in it.
template <ExactField T>
double diagonal_of(const std::vector<const BsplineCurve<T, 4>*>& curves) {
  std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  bool any = false;
  for (const auto* curve : curves)
    for (const Vec<T, 4>& p : curve->points()) {
      if (*scalar_traits<T>::sign(p[3]) == Sign::zero) continue;
      any = true;
      for (int c = 0; c < 3; ++c) {
        const double x = finite(nearest_double(T(p[c] / p[3])));
        low[c] = std::min(low[c], x), high[c] = std::max(high[c], x);
      }
    }
  return any ? std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) : 0;
}

using Cell = std::array<double, 3>;

}  // namespace

template <ExactField T>
CurveEndMatch match_curve_ends(const std::vector<const BsplineCurve<T, 4>*>& curves, double length,
                               const std::vector<std::array<double, 2>>& tolerances) {
  PATCHPROOF_REQUIRES(tolerances.empty() || tolerances.size() == curves.size(),
                      "match_curve_ends: tolerances of every curve");
  CurveEndMatch match;
  match.diagonal = diagonal_of(curves);
  match.length = length > 0 ? length : kDefaultReach * match.diagonal;
  std::vector<End<T>> ends;
  double reach = match.length, farthest = 0, widest = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double tenth = diagonal_of<T>({curves[i]}) / 10;
    const double own_reach = length > 0 ? length : std::min(match.length, tenth);
    for (const CurveEnd e : {CurveEnd::begin, CurveEnd::end}) {
      const KnotVector<T>& knots = curves[i]->knots();
      const bool begin = e == CurveEnd::begin;
      End<T> end{{static_cast<int>(i), e},
                 evaluate_rational(*curves[i], begin ? knots.domain_begin() : knots.domain_end(),
                                   begin ? Side::right : Side::left),
                 {},
                 tolerances.empty() ? 0 : tolerances[i][!begin]};
      for (int c = 0; c < 3; ++c) {
        end.near[c] = finite(nearest_double(end.point[c]));
        farthest = std::max(farthest, std::fabs(end.near[c]));
      }
      widest = std::max(widest, end.tolerance);
      end.own_reach = own_reach;
      end.tenth = tenth;
      ends.push_back(std::move(end));
    }
  }
  reach = std::max(reach, 2 * widest);
  // Cells so wide that ends within reach lie in neighbouring ones, whatever the rounding of `near` and of quotients.
  const double width = std::max({2 * reach, std::ldexp(farthest, -40), 1e-300});
  const auto cell_of = [&](const End<T>& end) {
    return Cell{std::floor(end.near[0] / width), std::floor(end.near[1] / width), std::floor(end.near[2] / width)};
  };
  const auto within = [&](const End<T>& a, const End<T>& b) {
    double allowed = std::max(std::min(a.own_reach, b.own_reach), a.tolerance + b.tolerance);
    if (a.of.curve == b.of.curve) allowed = std::min(allowed, a.tenth);
    const Vec<T, 3> d = a.point - b.point;
    const T limit = T(from_double(allowed));
    return !(limit * limit < dot(d, d));
  };
  struct Candidates {
    std::vector<int> ends;
    bool crowded = false;  // some were taken out: they have no room for further partners
  };
  std::map<Cell, Candidates> cells;
  const auto is_full = [&](int i) { return ends[i].partners.size() >= kMostPartners; };
  const int count = static_cast<int>(ends.size());
  for (int i = 0; i < count; ++i) {
    End<T>& end = ends[i];
    const Cell own = cell_of(end);
    for (double dx = -1; dx <= 1; ++dx)
      for (double dy = -1; dy <= 1; ++dy)
        for (double dz = -1; dz <= 1; ++dz) {
          const auto found = cells.find({own[0] + dx, own[1] + dy, own[2] + dz});
          if (found == cells.end()) continue;
          end.crowded = end.crowded || found->second.crowded;
          for (const int j : found->second.ends) {
            if (is_full(i)) end.crowded = true;
            if (is_full(i)) break;
            if (!within(end, ends[j])) continue;
            if (is_full(j)) {
              end.crowded = true;
              continue;
            }
            end.partners.push_back(j);
            ends[j].partners.push_back(i);
          }
        }
    match.crowded = match.crowded || end.crowded;
    // An end that is full is no candidate any more: a crowd costs no more than others.
    Candidates& mine = cells[own];
    mine.ends.push_back(i);
    if (mine.ends.size() > kMostPartners && std::erase_if(mine.ends, is_full) > 0) mine.crowded = true;
  }
  for (int i = 0; i < count; ++i) {
    std::sort(ends[i].partners.begin(), ends[i].partners.end());
    if (ends[i].partners.empty() && !ends[i].crowded) match.free.push_back(ends[i].of);
    for (const int j : ends[i].partners) {
      if (j < i) continue;
      const bool turned = ends[i].of.end == CurveEnd::begin && ends[j].of.end == CurveEnd::end;
      match.pairs.emplace_back(ends[turned ? j : i].of, ends[turned ? i : j].of);
    }
  }
  return match;
}

template CurveEndMatch match_curve_ends(const std::vector<const BsplineCurve<Rational, 4>*>&, double,
                                        const std::vector<std::array<double, 2>>&);
template CurveEndMatch match_curve_ends(const std::vector<const BsplineCurve<Quadratic, 4>*>&, double,
                                        const std::vector<std::array<double, 2>>&);

}  // namespace patchproof
