// SPDX-License-Identifier: Apache-2.0
// How smooth a patch is across the inner knots of one direction, over their whole length.
//
//   S is C^k across u = c exactly when all its isoparametric curves in u are. Polynomial patches: when the lines of the net
//   are, since the functions of v are independent. Rational ones: the jump of order k is, on each span in v, a polynomial of
//   degree 2q over a denominator without zero, so 2q + 1 isoparametric curves on each span decide.
//
// The affine patch is at least as smooth as the homogeneous net, and that as smooth as the knots promise: a line that is no
// smoother ends the search.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "patchproof/patch/boundary.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/smoothness.h"
#include "patchproof/spline/spline_domain.h"

namespace patchproof::cli {

template <OrderedField K>
struct PatchBreak {
  K value;
  int multiplicity, nominal;
  int actual;  // an order of Smoothness
};

namespace detail {

// The curves in direction d that decide, made when they are asked for.
template <ExactField T>
class DecidingLines {
 public:
  DecidingLines(const BsplinePatch<T, 4>& patch, bool is_rational, Direction d)
      : patch_(patch), is_rational_(is_rational), d_(d) {
    const KnotVector<T>& across = patch.knots(other(d));
    if (is_rational) {
      const std::vector<T> breaks = across.breaks();
      const int count = 2 * across.degree() + 1;
      for (std::size_t s = 0; s + 1 < breaks.size(); ++s)
        for (int j = 0; j < count; ++j)
          parameters_.push_back(breaks[s] + (breaks[s + 1] - breaks[s]) * T(j) / T(count));
    } else {
      const std::vector<int> dead = dead_control_points(across);
      for (int j = 0; j < across.control_count(); ++j)
        if (!std::binary_search(dead.begin(), dead.end(), j)) lines_of_net_.push_back(j);
    }
  }

  // The lowest order of any line; `floor`: none can be lower. Across an inner knot, or from the end to the begin.
  int worst_order_at(const T& break_value, int floor) {
    return worst(floor, [&](const BsplineCurve<T, 4>& line) {
      return is_rational_ ? smoothness_at_rational(line, break_value).order : smoothness_at(line, break_value).order;
    });
  }
  int worst_order_at_seam() {
    return worst(-1, [&](const BsplineCurve<T, 4>& line) {
      return is_rational_ ? closing_smoothness_rational(line).order : closing_smoothness(line).order;
    });
  }

 private:
  template <class OrderOf>
  int worst(int floor, OrderOf order_of) {
    int worst = kOneFunction;
    const std::size_t count = is_rational_ ? parameters_.size() : lines_of_net_.size();
    for (std::size_t i = 0; i < count && worst > floor; ++i) {
      const auto found = made_.try_emplace(i, std::nullopt).first;
      if (!found->second) found->second = make(i);
      worst = std::min(worst, order_of(*found->second));
    }
    return worst;
  }

  BsplineCurve<T, 4> make(std::size_t line) const {
    if (is_rational_) return cross_boundary_rows(patch_, IsoLine<T>{other(d_), parameters_[line], Side::right}, 0)[0];
    std::vector<Vec<T, 4>> points;
    for (int i = 0; i < patch_.count(d_); ++i)
      points.push_back(d_ == Direction::u ? patch_.point(i, lines_of_net_[line])
                                          : patch_.point(lines_of_net_[line], i));
    return {patch_.knots(d_), std::move(points)};
  }

  const BsplinePatch<T, 4>& patch_;
  bool is_rational_;
  Direction d_;
  std::vector<T> parameters_;
  std::vector<int> lines_of_net_;
  std::map<std::size_t, std::optional<BsplineCurve<T, 4>>> made_;
};

}  // namespace detail

// The inner breaks of direction d, in order. REQUIRES the denominator has no zero.
template <ExactField T>
std::vector<PatchBreak<T>> patch_smoothness(const BsplinePatch<T, 4>& patch, bool is_rational, Direction d) {
  std::vector<PatchBreak<T>> out;
  const KnotVector<T>& knots = patch.knots(d);
  const std::vector<T> breaks = knots.breaks();
  if (breaks.size() < 3) return out;
  detail::DecidingLines<T> of_net(patch, false, d), affine(patch, true, d);
  for (std::size_t b = 1; b + 1 < breaks.size(); ++b) {
    const int multiplicity = knots.multiplicity(breaks[b]), nominal = std::max(-1, knots.degree() - multiplicity);
    int worst = of_net.worst_order_at(breaks[b], nominal);
    if (is_rational && worst != kOneFunction) worst = affine.worst_order_at(breaks[b], worst);
    out.push_back({breaks[b], multiplicity, nominal, worst});
  }
  return out;
}

// The order with which the patch closes in direction d, −1 when it does not. REQUIRES the denominator has no zero.
template <ExactField T>
int closing_order(const BsplinePatch<T, 4>& patch, bool is_rational, Direction d) {
  return detail::DecidingLines<T>(patch, is_rational, d).worst_order_at_seam();
}

}  // namespace patchproof::cli
