// SPDX-License-Identifier: Apache-2.0
#include "spline/smooth_b_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchproof::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kIntervalBits = 96;  // of the Balls behind Interval and double
constexpr double kBesideEnds = 1.0 / 64;

// t cut to [0, 1], beyond which B goes on as 0 and 1, with all derivatives: a square root cuts off what is negative.
Ball cut(const Ball& t) {
  const Interval all = t.to_interval();
  if (all.sup() < 0) return Ball(0);
  if (all.inf() > 1) return Ball(1);
  Ball x = t;
  if (all.inf() < 0) {
    const Ball root = sqrt(x);
    x = root * root;
  }
  if (all.sup() > 1) {
    const Ball root = sqrt(Ball(1) - x);
    x = Ball(1) - root * root;
  }
  return x;
}
Interval cut(const Interval& t) { return Interval(std::clamp(t.inf(), 0.0, 1.0), std::clamp(t.sup(), 0.0, 1.0)); }

bool meets_kink(const SmoothBFunction& b, double low, double high) {
  const auto kink = b.kink();
  return kink && low <= kink->above && high >= kink->below;
}
// May the formula be evaluated there as a whole?
bool is_narrow(const SmoothBFunction& b, double low, double high) {
  return low > 0 && high < 1 && high - low <= std::min(low, 1 - high) / 16 && !meets_kink(b, low, high);
}

// How far the bounds beside an end are used: as long as they are large, the formula says more. A power of 2 below most.
double length_of_end(const SmoothBFunction& b, int end, int order) {
  double s = kBesideEnds;
  const auto is_small = [&] {
    for (int k = 1; k <= order; ++k)
      if (b.end_bound(end, s, k) > 1) return false;
    return true;
  };
  while (s > b.reach(end) || (s > 0x1p-16 && !is_small())) s /= 2;
  return s;
}

struct Range {
  double low = kInfinity, high = -kInfinity;
  void include(double from, double to) { low = std::min(low, from), high = std::max(high, to); }
};

// B_1 … B_order on [low, high] ⊂ [0, 1], piece by piece: the ends by their bounds, beside a kink from both sides.
std::vector<Range> ranges(const SmoothBFunction& b, double low, double high, int order) {
  std::vector<Range> out(order + 1);
  double from = low, to = high;
  if (from < kBesideEnds && from < length_of_end(b, 0, order)) {
    const double s = std::min(to, length_of_end(b, 0, order));
    for (int k = 1; k <= order; ++k) out[k].include(-b.end_bound(0, s, k), b.end_bound(0, s, k));
    from = s;
  }
  if (1 - to < kBesideEnds && 1 - to < length_of_end(b, 1, order)) {
    const double s = std::min(std::nextafter(1 - from, 2), length_of_end(b, 1, order));
    for (int k = 1; k <= order; ++k) out[k].include(-b.end_bound(1, s, k), b.end_bound(1, s, k));
    to = std::nextafter(1 - s, 2);  // rather a little twice than a gap
  }
  const auto kink = b.kink();
  const auto include = [&](const std::vector<Ball>& piece) {
    for (int k = 1; k <= order; ++k) {
      const Interval x = k < static_cast<int>(piece.size()) ? piece[k].to_interval() : Interval(-kInfinity, kInfinity);
      out[k].include(x.inf(), x.sup());
    }
  };
  for (bool is_first = true; from < to || is_first; is_first = false) {
    if (from > to) break;  // all is bounded already
    if (from == to && (from == 0 || from == 1)) break;
    const double next = std::min(to, from + std::min(from, 1 - from) / 18);
    if (meets_kink(b, from, next)) {
      if (kink->has_below(from)) include(b.series_beside_kink(from, kink->above, true, order));
      include(b.series_beside_kink(kink->below, std::max(next, kink->above), false, order));
    } else {
      include(b.series(ball_between(from, next), order));
    }
    from = next;
  }
  return out;
}

std::vector<Interval> wide_coefficients(const SmoothBFunction& b, const Interval& t, int order) {
  const BallPrecision precision(kIntervalBits);
  const auto value = [&b](double x) {
    if (x <= 0 || x >= 1) return Interval(x <= 0 ? 0 : 1);
    const Interval y = b.series(Ball(x), 0)[0].to_interval();
    return Interval(std::max(y.inf(), 0.0), std::min(y.sup(), 1.0));
  };
  std::vector<Interval> out{Interval(value(t.inf()).inf(), value(t.sup()).sup())};
  if (order == 0) return out;
  const std::vector<Range> all = ranges(b, t.inf(), t.sup(), order);
  for (int k = 1; k <= order; ++k) {
    const double low = k == 1 ? std::max(all[k].low, 0.0) : all[k].low;
    out.push_back(all[k].low <= all[k].high ? Interval(low, all[k].high) : Interval(0));
  }
  return out;
}

std::vector<Interval> end_values(double t, int order) {
  std::vector<Interval> out(order + 1);
  out[0] = Interval(static_cast<int>(t));
  return out;
}

}  // namespace

std::vector<Interval> smooth_coefficients(const SmoothBFunction& b, const Interval& t, int order) {
  const Interval x = cut(t);
  if (x.is_point() && (x.inf() == 0 || x.inf() == 1)) return end_values(x.inf(), order);
  if (!is_narrow(b, x.inf(), x.sup())) return wide_coefficients(b, x, order);
  const BallPrecision precision(kIntervalBits);
  std::vector<Interval> out;
  for (const Ball& c : b.series(Ball(x), order)) out.push_back(c.to_interval());
  out[0] = Interval(std::max(out[0].inf(), 0.0), std::min(out[0].sup(), 1.0));
  return out;
}

std::vector<Ball> smooth_coefficients(const SmoothBFunction& b, const Ball& t, int order) {
  const BallPrecision precision(std::max(BallPrecision::current(), kIntervalBits));
  const Ball x = cut(t);
  const Interval all = cut(x.to_interval());
  if (is_narrow(b, all.inf(), all.sup())) return b.series(x, order);
  std::vector<Ball> out;
  const bool is_end = all.is_point() && (all.inf() == 0 || all.inf() == 1);
  for (const Interval& c : is_end ? end_values(all.inf(), order) : wide_coefficients(b, all, order))
    out.emplace_back(c);
  return out;
}

std::vector<double> smooth_derivatives(const SmoothBFunction& b, double t, int order) {
  PATCHPROOF_REQUIRES(0 <= t && t <= 1, "derivatives: t lies outside [0, 1]");
  const auto kink = b.kink();
  PATCHPROOF_REQUIRES(!kink || order <= kink->smoothness, "derivatives: the B-function is not that smooth");
  std::vector<double> out = b.table().derivatives(t, std::min(order, DoubleTable::kDerivatives - 1));
  if (order < DoubleTable::kDerivatives) return out;
  const BallPrecision precision(kIntervalBits);
  const std::vector<Ball> all = smooth_coefficients(b, Ball(t), order);
  Ball factorial(1);
  for (int k = 1; k <= order; ++k) {
    factorial = factorial * Ball(k);
    if (k < DoubleTable::kDerivatives) continue;
    const Interval x = (factorial * all[k]).to_interval();
    out.push_back(x.inf() / 2 + x.sup() / 2);
  }
  return out;
}

const DoubleTable& SmoothBFunction::table() const {
  std::call_once(once_, [this] {  // the same table, whoever asks first
    const RoundingGuard nearest(CGAL_FE_TONEAREST);
    table_ = std::make_unique<const DoubleTable>(*this);
  });
  return *table_;
}

// ---- numbers --------------------------------------------------------------------------------------------------------

std::vector<Ball> series_product(const std::vector<Ball>& a, const std::vector<Ball>& b) {
  std::vector<Ball> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; i + j < a.size(); ++j) out[i + j] += a[i] * b[j];
  return out;
}

// f′ = g′ f:  k f_k = Σ_{j=1..k} j g_j f_{k−j}
std::vector<Ball> series_exp(const std::vector<Ball>& g) {
  std::vector<Ball> f{exp(g[0])}, slope;
  for (std::size_t j = 0; j < g.size(); ++j) slope.push_back(Ball(static_cast<int>(j)) * g[j]);
  for (std::size_t k = 1; k < g.size(); ++k) {
    Ball sum;
    for (std::size_t j = 1; j <= k; ++j) sum += slope[j] * f[k - j];
    f.push_back(sum / Ball(static_cast<int>(k)));
  }
  return f;
}

double log_peak(double power, double kappa, double y0) {
  const double y = std::max(std::min(y0, 1e300), power / kappa);
  return (power > 0 ? power * std::log(y) : 0) - kappa * y;
}

double exp_up(double logarithm) {
  const double slack = 1e-9 * std::fabs(logarithm) + 1e-9;
  return std::max(std::exp(logarithm + slack), std::numeric_limits<double>::min());
}

}  // namespace patchproof::detail
