// SPDX-License-Identifier: Apache-2.0
// B = 1/(1 + e^L), L = 1/t − 1/(1−t), through e^(−|L|) ≤ 1, so that nothing overflows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "spline/smooth_b_function.h"

namespace patchproof::detail {
namespace {

class Logistic final : public SmoothBFunction {
 public:
  // On the half where t ≤ 1/2: E = e^(−L), B = E/(1 + E). On the other half 1 − B is that of 1 − t.
  std::vector<Ball> series(const Ball& t, int n) const override {
    const Interval all = t.to_interval();
    const bool is_left = all.inf() + all.sup() <= 1;
    const Ball x = is_left ? t : Ball(1) - t;
    std::vector<Ball> g;  // −L about x
    Ball left = Ball(1) / x, right = Ball(1) / (Ball(1) - x);
    const Ball back = -left, on = right;
    left = -left;
    for (int j = 0; j <= n; ++j) {
      g.push_back(left + right);
      left = left * back;
      right = right * on;
    }
    const std::vector<Ball> e = series_exp(g);
    const Ball whole = Ball(1) + e[0];
    std::vector<Ball> out;
    for (int k = 0; k <= n; ++k) {  // B (1 + E) = E
      Ball rest = e[k];
      for (int j = 1; j <= k; ++j) rest = rest - e[j] * out[k - j];
      out.push_back(rest / whole);
    }
    if (is_left) return out;
    out[0] = Ball(1) - out[0];
    for (int k = 2; k <= n; k += 2) out[k] = -out[k];
    return out;
  }
  // On |z − s| ≤ θs: Re 1/z ≥ 1/((1+θ)s) and Re 1/(1−z) ≤ 1/(1−(1+θ)s), so |E| ≤ e^(1.3 − 1/((1+θ)s)) < 1/2 for s ≤ 1/8,
  // θ ≤ 3/4, and |B| ≤ 2|E|; then Cauchy's estimate |B_k| ≤ max |B| / (θs)^k. The function is symmetric.
  double end_bound(int, double s, int k) const override {
    double best = std::numeric_limits<double>::infinity();
    for (const double theta : {0.125, 0.25, 0.5, 0.75}) {
      const double bound = std::log(2.0) + 1.3 - k * std::log(theta) + log_peak(k, 1 / (1 + theta), 1 / s);
      best = std::min(best, bound);
    }
    return exp_up(best);
  }
  double reach(int) const override { return 0.125; }
};

}  // namespace

std::shared_ptr<const SmoothBFunction> make_logistic() { return std::make_shared<const Logistic>(); }

}  // namespace patchproof::detail
