// SPDX-License-Identifier: Apache-2.0
// Doubles of flat B-functions: on each panel the Taylor polynomials of B, B′, B″ and B‴ about its centre, a proved error each.
//
// Error of one value = Lagrange's remainder max|B^(k+16)| h^16/16! (enclosed over the panel) + what the coefficients lost when
// they were rounded + Horner's rule, Σ (2j + 1) 2^-53 |c_j|. The argument (t − centre)/h of the polynomial is exact: h is a power
// of two, and t and the centre are nearer to each other than a factor of 2.
#include <algorithm>
#include <cmath>

#include "spline/smooth_b_function.h"

namespace patchproof::detail {
namespace {

constexpr int kBits = 96;
constexpr double kUnit = 0x1p-53, kSlack = 1.001;
constexpr double kFlat = 0x1p-70;   // below it a derivative beside an end is said to be 0
constexpr double kSmall = 0x1p-36;  // half of the smallest panels, beside a kink

// The double in the middle, and how far the enclosed number may be from it.
double middle(const Ball& x, double& distance) {
  const Interval all = x.to_interval();
  const double m = all.inf() / 2 + all.sup() / 2;
  distance = std::max(all.sup() - m, m - all.inf()) * kSlack;
  return m;
}
double magnitude(const Interval& x) { return std::max(std::fabs(x.inf()), std::fabs(x.sup())); }

double value_at(const SmoothBFunction& b, double t) {
  double unused;
  return std::clamp(middle(smooth_coefficients(b, Ball(t), 0)[0], unused), 0.0, 1.0);
}

// The largest 2^-m beside an end where the function and its first derivatives are below kFlat.
double flat_end(const SmoothBFunction& b, int end) {
  double s = 0.25;
  for (;; s /= 2) {
    if (s > b.reach(end)) continue;
    if (s < 0x1p-40) return s;                             // hardly flat; the error says how much
    double factor = 1, most = s * b.end_bound(end, s, 1);  // B(s) ≤ s max B′
    for (int k = 1; k < DoubleTable::kDerivatives; ++k) most = std::max(most, (factor *= k) * b.end_bound(end, s, k));
    if (most <= kFlat) return s;
  }
}

}  // namespace

DoubleTable::DoubleTable(const SmoothBFunction& b) {
  const BallPrecision precision(kBits);
  const double begin = flat_end(b, 0), end = 1 - flat_end(b, 1);
  for (int k = 0; k < kDerivatives; ++k) {
    double factor = 1;
    for (int j = 2; j <= k; ++j) factor *= j;
    for (const int side : {0, 1}) {
      const double s = side == 0 ? begin : 1 - end;
      error_[k] =
          std::max(error_[k], (k == 0 ? s * b.end_bound(side, s, 1) : factor * b.end_bound(side, s, k)) * kSlack);
    }
  }
  const auto kink = b.kink();
  for (double x = begin; x < end;) {
    double h = 0.25;
    const auto fits = [&] {
      const double to = x + 2 * h;
      if (to > end || std::fmod(x, 2 * h) != 0 || 2 * h > std::min(x, 1 - to) / 8) return false;
      if (!kink || h <= kSmall) return true;
      return (to < kink->below && 2 * h <= (kink->below - to) / 2) ||
             (x > kink->above && 2 * h <= (x - kink->above) / 2);
    };
    while (!fits()) h /= 2;
    const bool is_flat = kink && h <= kSmall;
    is_flat ? add_flat(b, x, x + 2 * h) : add(b, x, x + 2 * h);
    x += 2 * h;
  }
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    panels_[i].value_begin = i == 0 ? value_at(b, panels_[i].begin) : panels_[i - 1].value_end;
    panels_[i].value_end = std::max(panels_[i].value_begin, value_at(b, panels_[i].end));
  }
}

void DoubleTable::add(const SmoothBFunction& b, double begin, double end) {
  Panel p{begin, end, (begin + end) / 2, (end - begin) / 2, 0, 0, {}};
  const std::vector<Ball> at = b.series(Ball(p.centre), kDegree + kDerivatives);
  const std::vector<Ball> on = b.series(ball_between(begin, end), kDegree + kDerivatives);
  std::array<double, kDerivatives> errors;
  bool is_good = true;
  for (int k = 0; k < kDerivatives; ++k) {
    Ball ratio(1), power(1);  // (k + j)!/j!, h^j
    for (int i = 2; i <= k; ++i) ratio = ratio * Ball(i);
    double error = kUnit;  // of the values to which the panel is cut
    for (int j = 0; j <= kDegree + 1; ++j) {
      const Ball scale = ratio * power;
      if (j > kDegree) {
        const double rest = magnitude((scale * on[k + j]).to_interval());
        is_good = is_good && rest <= kUnit * std::max(1.0, std::fabs(p.c[k][0]));
        error += rest * kSlack;
        break;
      }
      double lost;
      const double c = p.c[k][j] = middle(scale * at[k + j], lost);
      error += lost + (2 * j + 1) * kUnit * std::fabs(c) * kSlack;
      ratio = ratio * Ball(k + j + 1) / Ball(j + 1);
      power = power * Ball(p.half);
    }
    errors[k] = error * kSlack;
  }
  if (!is_good && p.half > 0x1p-16) {
    add(b, begin, p.centre);
    return add(b, p.centre, end);
  }
  for (int k = 0; k < kDerivatives; ++k) error_[k] = std::max(error_[k], errors[k]);
  panels_.push_back(p);
}

// So short that a line does for B, and a number for each derivative.
void DoubleTable::add_flat(const SmoothBFunction& b, double begin, double end) {
  Panel p{begin, end, (begin + end) / 2, (end - begin) / 2, 0, 0, {}};
  const std::vector<Interval> on = smooth_coefficients(b, Interval(begin, end), kDerivatives - 1);
  double lost, factor = 1;
  p.c[0][0] = middle(smooth_coefficients(b, Ball(p.centre), 0)[0], lost);
  double error = lost + kUnit * 3;
  for (int k = 1; k < kDerivatives; ++k) {
    factor *= k;
    if (!std::isfinite(on[k].inf()) || !std::isfinite(on[k].sup())) {
      error_[k] = std::numeric_limits<double>::infinity();
      continue;
    }
    p.c[k][0] = factor * middle(Ball(on[k]), lost);
    error_[k] = std::max(error_[k], factor * (lost + kUnit * magnitude(on[k])) * kSlack);
    if (k > 1) continue;
    p.c[0][1] = p.c[1][0] * p.half;
    error += (lost + 4 * kUnit * magnitude(on[1])) * p.half;
  }
  error_[0] = std::max(error_[0], error * kSlack);
  panels_.push_back(p);
}

std::vector<double> DoubleTable::derivatives(double t, int order) const {
  std::vector<double> out(order + 1);
  if (t < panels_.front().begin) return out;
  if (t > panels_.back().end) {
    out[0] = 1;
    return out;
  }
  const auto after =
      std::lower_bound(panels_.begin(), panels_.end(), t, [](const Panel& p, double x) { return p.end < x; });
  const Panel& p = *after;
  const double y = (t - p.centre) / p.half;
  for (int k = 0; k <= order; ++k) {
    double sum = p.c[k][kDegree];
    for (int j = kDegree; j-- > 0;) sum = sum * y + p.c[k][j];
    out[k] = sum;
  }
  out[0] = std::clamp(out[0], p.value_begin, p.value_end);
  return out;
}

}  // namespace patchproof::detail
