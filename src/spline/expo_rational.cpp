// SPDX-License-Identifier: Apache-2.0
// B = ∫_0^t φ / ∫_0^1 φ, φ = e^g, g(s) = −β |s−λ|^p s^(−α) (1−s)^(−αγ), p = α(1+γ).
//
// Panels [a−h, a+h] on which φ's Taylor series about a converges like 8^−k; what is left out is bounded by Cauchy's estimate
// |φ_k| ≤ M r^−k, r = 8h, where M bounds |φ| on the circle |z−a| = r by one of
//   α = γ = 1    g = β − β(λ²/z + (1−λ)²/(1−z)), whose real part is largest at a + r in each term;
//   near λ       |g| ≤ β (|a−λ|+r)^p / ((a−r)^α (1−a−r)^αγ) ≤ 2, so M ≤ e²;
//   elsewhere    g(z) = g(a) e^w with |w| ≤ W = −p ln(1−r/|a−λ|) − α ln(1−r/a) − αγ ln(1−r/(1−a)) ≤ 1 < π/2: Re g < 0, M ≤ 1.
// Unless p is an even integer φ is not analytic at λ: the panels shrink towards it and leave a gap in which φ(gap's end) ≤ φ ≤ 1.
// Towards 0 and 1 they end where s φ(s), which bounds the integral since φ increases up to λ, is below the precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "spline/smooth_b_function.h"

namespace patchproof::detail {
namespace {

constexpr double kRatio = 8;           // r / h
constexpr double kReach = 1.5;         // panels are evaluated for |y| ≤ kReach, t = a + h y
constexpr double kGap = 0x1p-30;       // half of what the panels leave free around λ
constexpr double kBitsPerTerm = 2.41;  // log2(kRatio / kReach), rounded down

bool is_integer(const Rational& x) { return denominator(x) == 1; }

// ln(1+δ) = δ − δ²/2 + …, after e^(what a double knows of the logarithm) is divided out.
Ball log(const Ball& x) {
  const Interval all = x.to_interval();
  const double guess = std::log(all.inf() + (all.sup() - all.inf()) / 2);  // halves of the smallest numbers are 0
  const Ball delta = x * exp(Ball(-guess)) - Ball(1);
  const Interval size = delta.to_interval();
  const double most = std::max(std::fabs(size.inf()), std::fabs(size.sup()));
  if (!(most < 0.5)) {  // a wide one: the logarithm grows
    PATCHPROOF_REQUIRES(0 < all.inf() && all.inf() < all.sup() && std::isfinite(all.sup()),
                        "log of a number that may be 0");
    const Interval low = log(Ball(all.inf())).to_interval(), high = log(Ball(all.sup())).to_interval();
    return ball_between(low.inf(), high.sup());
  }
  Ball sum, power(1);
  double rest = 1;
  int k = 0;
  do {
    power = power * delta;
    rest = rest * most * 1.001;
    ++k;
    sum += (k % 2 == 1 ? power : -power) / Ball(k);
  } while (rest > std::ldexp(1.0, -BallPrecision::current()));
  rest = rest * most * 2.01 + std::numeric_limits<double>::min();
  return Ball(guess) + sum + ball_between(-rest, rest);
}

// c^e for c > 0.
Ball power(const Ball& c, const Rational& e) {
  if (!is_integer(e)) return exp(Ball(e) * log(c));
  int n = abs(numerator(e)).convert_to<int>();
  Ball out(1), square = c;
  for (; n > 0; n /= 2, square = square * square)
    if (n % 2 == 1) out = out * square;
  return e < 0 ? Ball(1) / out : out;
}

// (c + d x)^e, d = ±1: coefficients C(e, k) c^(e−k) d^k. For an integer e ≥ 0 by whole powers, so that c may be around 0.
std::vector<Ball> power_series(const Ball& c, const Rational& e, bool falls, int n) {
  std::vector<Ball> out;
  const bool is_whole = is_integer(e) && e >= 0;
  const bool is_far = c.sign() == Sign::positive;
  Ball first = is_whole || !is_far ? Ball(1) : power(c, e), choose(1);
  const Ball step = is_far ? Ball(falls ? -1 : 1) / c : Ball(1);
  for (int k = 0; k <= n; ++k) {
    if (is_whole || !is_far) {
      const Rational rest = e - k;
      const Ball sign(falls && k % 2 == 1 ? -1 : 1);
      if (is_whole && rest < 0)
        out.emplace_back(0);
      else if (is_whole)
        out.push_back(sign * choose * power(c, rest));
      else {  // [0, upper]^rest, rest > 0
        const Interval all = c.to_interval();
        const double upper = all.sup() > 0 ? power(Ball(all.sup()), rest).to_interval().sup() : 0;
        out.push_back(sign * choose * ball_between(0, upper));
      }
      choose = choose * Ball(rest) / Ball(k + 1);
    } else {
      out.push_back(first);
      first = first * step * Ball(Rational((e - k) / (k + 1)));
    }
  }
  return out;
}

struct Panel {
  double begin, end, centre, half;
  std::vector<Ball> integral;  // ∫ from begin to centre + half·y, by powers of y
  Ball rest;                   // what is left out of it
  Ball before, after;          // ∫ from 0 to begin, and from end to 1
};

struct Panels {
  std::vector<Panel> all;
  Ball total;
};

class ExpoRational final : public SmoothBFunction {
 public:
  explicit ExpoRational(const BFunction::Intrinsic& x)
      : alpha_(x.alpha),
        beta_(x.beta),
        lambda_(x.lambda),
        other_(x.alpha * x.gamma),
        power_(x.alpha + other_),
        is_classic_(x.alpha == 1 && x.gamma == 1),
        is_analytic_(is_integer(power_) && numerator(power_) % 2 == 0),
        a_(nearest_double(alpha_)),
        b_(nearest_double(beta_)),
        c_(nearest_double(other_)),
        p_(nearest_double(power_)),
        l_(nearest_double(lambda_)) {}

  std::vector<Ball> series(const Ball& t, int n) const override {
    std::vector<Ball> out{value(t)};
    if (n == 0) return out;
    const Ball total = panels()->total;
    const std::vector<Ball> f = density(t, n - 1);
    for (int k = 1; k <= n; ++k) out.push_back(f[k - 1] / (total * Ball(k)));
    return out;
  }
  std::optional<Kink> kink() const override {
    if (is_analytic_) return std::nullopt;
    const Interval l = Ball(lambda_).to_interval();
    return Kink{l.inf(), l.sup(), static_cast<int>(std::ceil(p_))};
  }
  std::vector<Ball> series_beside_kink(double low, double high, bool is_below, int n) const override {
    const int terms = std::min(n, kink()->smoothness) - 1;
    std::vector<Ball> out{Ball(0)};
    if (terms < 0) return out;
    const Ball t = ball_between(low, high), u = is_below ? Ball(lambda_) - t : t - Ball(lambda_);
    const Interval distance = u.to_interval();
    const Ball total = panels()->total;
    const std::vector<Ball> f = density_from(t, ball_between(0, std::max(distance.sup(), 0.0)), is_below, terms);
    for (int k = 0; k <= terms; ++k) out.push_back(f[k] / (total * Ball(k + 1)));
    return out;
  }
  double end_bound(int end, double s, int k) const override;
  // Within λ/2 and 1/2 of the end the circles of end_bound keep away from λ and from the other end.
  double reach(int end) const override { return std::min(end == 0 ? l_ : 1 - l_, 0.875) * 0.4999; }

 private:
  // φ's Taylor coefficients at t, which lies on one side of λ unless φ is analytic there.
  std::vector<Ball> density(const Ball& t, int n) const {
    const Ball u = t - Ball(lambda_);
    const bool is_below = !is_analytic_ && u.sign() == Sign::negative;
    return density_from(t, is_below ? -u : u, is_below, n);
  }
  std::vector<Ball> density_from(const Ball& t, const Ball& u, bool is_below, int n) const {
    std::vector<Ball> g;
    if (is_classic_) {
      const Ball back = Ball(-1) / t, on = Ball(1) / (Ball(1) - t), beta(beta_);
      Ball left = beta * Ball(lambda_ * lambda_) * back, right = -beta * Ball((1 - lambda_) * (1 - lambda_)) * on;
      for (int j = 0; j <= n; ++j, left = left * back, right = right * on) g.push_back(left + right);
      g[0] = beta * u * u * back * on;  // without the cancellation at λ
    } else {
      g = series_product(power_series(t, -alpha_, false, n), power_series(Ball(1) - t, -other_, true, n));
      g = series_product(g, power_series(u, power_, is_below, n));
      for (Ball& x : g) x = -(Ball(beta_) * x);
    }
    return series_exp(g);
  }
  double log_density(double s) const {  // about ln φ(s)
    return -b_ * std::pow(std::fabs(s - l_), p_) * std::pow(s, -a_) * std::pow(1 - s, -c_);
  }

  Ball value(const Ball& t) const;
  std::shared_ptr<const Panels> panels() const;
  Panels build() const;
  Panel panel(double begin, double end, int terms) const;
  std::optional<double> bound(double centre, double r) const;
  double step(double from, int direction) const;

  Rational alpha_, beta_, lambda_, other_, power_;
  bool is_classic_, is_analytic_;
  double a_, b_, c_, p_, l_;
  mutable std::mutex mutex_;
  mutable std::map<int, std::shared_ptr<const Panels>> built_;
};

// Cauchy's estimate on circles of radius θs about s. α = γ = 1: Re g ≤ β − βλ²/((1+θ)s) − β(1−λ)². Otherwise the logarithm W of
// the head, with L = −ln(1−θ): s ≤ λ/2 and s ≤ 1/2 give W ≤ (p + α + αγ) L = 2pL = 1, and Re g ≤ −β (λ/2)^p s^−α cos(1)/e.
double ExpoRational::end_bound(int end, double s, int k) const {
  const double l = end == 0 ? l_ : 1 - l_, alpha = end == 0 ? a_ : c_;
  const int j = k - 1;
  double best = std::numeric_limits<double>::infinity();
  if (is_classic_) {
    const double lead = b_ * (1 - (1 - l) * (1 - l)) * (1 + 1e-9);
    for (const double theta : {0.125, 0.25, 0.5, 0.75, 0.9375})
      best = std::min(best, lead - j * std::log(theta) + log_peak(j, b_ * l * l * (1 - 1e-9) / (1 + theta), 1 / s));
  } else {
    const double theta = (1 - std::exp(-1 / (2 * p_))) * (1 - 1e-9);
    best =
        -j * std::log(theta) + log_peak(j / alpha, 0.198 * b_ * std::pow(l / 2, p_), std::pow(s, -alpha) * (1 - 1e-9));
  }
  const BallPrecision precision(96);
  return exp_up(best) * (Ball(1) / panels()->total).to_interval().sup() / k * (1 + 1e-9);
}

// ---- panels ---------------------------------------------------------------------------------------------------------

// At least |φ| on the circle of radius r about the centre; nothing when no estimate of the head applies.
std::optional<double> ExpoRational::bound(double a, double r) const {
  const double edge = std::min(a, 1 - a), u = std::fabs(a - l_) * (1 - 1e-9), slack = 1 + 1e-9;
  if (!(r < 0.95 * edge)) return std::nullopt;
  if (is_classic_)
    return exp_up(b_ * (1 - (l_ * l_ / (a + r) + (1 - l_) * (1 - l_) / (1 - a + r)) * (1 - 1e-9)) * (1 + 1e-9) + 1e-9);
  if (!is_analytic_ && !(r < 0.95 * u)) return std::nullopt;
  if (r < 0.95 * u) {
    const double w = -p_ * std::log1p(-r / u) - a_ * std::log1p(-r / a) - c_ * std::log1p(-r / (1 - a));
    if (w * slack <= 1) return 1;
  }
  const double g = b_ * std::pow(std::fabs(a - l_) + r, p_) * std::pow(a - r, -a_) * std::pow(1 - a - r, -c_);
  if (g * slack <= 2) return std::exp(2.0) * slack;
  return std::nullopt;
}

// The other end of a panel that begins (or ends) at `from`. Of few digits, so that the middle of a panel is a double.
double ExpoRational::step(double from, int direction) const {
  for (double h = std::min(from, 1 - from) / 4;; h *= 0.8) {
    PATCHPROOF_REQUIRES(h > 0x1p-1000, "expo-rational: panels do not end");
    int exponent;
    const double digits = std::frexp(from + direction * 2 * h, &exponent);
    const double to = std::ldexp(std::nearbyint(digits * 0x1p44) * 0x1p-44, exponent);
    const double centre = from / 2 + to / 2, half = std::fabs(to - from) / 2;
    if (half > 0 && bound(centre, kRatio * half)) return to;
  }
}

Panel ExpoRational::panel(double begin, double end, int terms) const {
  const double centre = begin / 2 + end / 2, half = end / 2 - begin / 2;
  Panel out{begin, end, centre, half, {}, {}, {}, {}};
  const double r = kRatio * half, q = kReach / kRatio;
  const double most = *bound(centre, r);
  const std::vector<Ball> f = density(Ball(centre), terms);
  Ball scale(half), at_begin;
  out.integral.emplace_back(0);
  for (int k = 0; k <= terms; ++k) {
    const Ball c = f[k] * scale / Ball(k + 1);
    out.integral.push_back(c);
    if (k % 2 == 0)
      at_begin = at_begin - c;
    else
      at_begin += c;
    scale = scale * Ball(half);
  }
  out.integral[0] = -at_begin;
  // Σ_{k > terms} M r^−k h^(k+1) (|y|^(k+1) + 1)/(k+1) ≤ 2 M h kReach q^(terms+1) / (1 − q), with room for the roundings
  const double rest =
      2.1 * most * half * kReach * std::pow(q, terms + 1) / (1 - q) + std::numeric_limits<double>::min();
  out.rest = ball_between(-rest, rest);
  return out;
}

Panels ExpoRational::build() const {
  const int bits = BallPrecision::current(), terms = static_cast<int>(bits / kBitsPerTerm) + 2;
  const double least = -0.6932 * bits;
  const double from = is_analytic_ ? l_ : l_ - kGap, to = is_analytic_ ? l_ : l_ + kGap;
  const auto round = [](double x) { return std::nearbyint(x * 0x1p44) * 0x1p-44; };
  Panels out;
  const double start = round(from), start_right = round(to);
  double x = start;
  while (std::log(x) + log_density(x) > least) {
    const double next = step(x, -1);
    out.all.push_back(panel(next, x, terms));
    x = next;
  }
  std::reverse(out.all.begin(), out.all.end());
  if (!is_analytic_) {  // the gap, as a panel: integral = (y + 1) h [φ at its ends, 1]
    const double centre = start / 2 + start_right / 2, half = start_right / 2 - start / 2;
    double missing = 0;  // most of 1 − φ; values are asked for |y| ≤ 1.5
    for (const double s : {start - half, start_right + half})
      missing = std::max(missing, (Ball(1) - density(Ball(s), 0)[0]).to_interval().sup());
    const Ball lower = Ball(1) - ball_between(0, missing);
    Panel gap{start, start_right, centre, half, {}, Ball(0), {}, {}};
    gap.integral = {Ball(half) * lower, Ball(half) * lower};
    out.all.push_back(std::move(gap));
  }
  x = start_right;
  while (1 - x > 0x1p-38 && std::log(1 - x) + log_density(x) > least) {
    const double next = step(x, +1);
    out.all.push_back(panel(x, next, terms));
    x = next;
  }
  const auto tail = [this](double edge, double distance) {
    const Ball whole = Ball(distance) * density(Ball(edge), 0)[0];
    return ball_between(0, whole.to_interval().sup());
  };
  const Ball first = tail(out.all.front().begin, out.all.front().begin), last = tail(x, 1 - x);
  const auto whole = [](const Panel& p) {
    Ball sum;
    for (const Ball& c : p.integral) sum += c;
    return sum + p.rest;
  };
  Ball sum = first;
  for (Panel& p : out.all) {
    p.before = sum;
    sum += whole(p);
  }
  out.total = sum + last;
  sum = last;
  for (auto p = out.all.rbegin(); p != out.all.rend(); ++p) {
    p->after = sum;
    sum += whole(*p);
  }
  return out;
}

std::shared_ptr<const Panels> ExpoRational::panels() const {
  const int bits = (BallPrecision::current() + 31) / 32 * 32 + 32;
  const std::lock_guard lock(mutex_);
  auto& place = built_[bits];
  if (!place) {  // the same panels, whoever asks first
    const RoundingGuard nearest(CGAL_FE_TONEAREST);
    const BallPrecision precision(bits);
    place = std::make_shared<const Panels>(build());
  }
  return place;
}

// Left of λ from the left, right of it as 1 − ∫ from the right: small values keep their digits.
Ball ExpoRational::value(const Ball& t) const {
  const auto table = panels();
  const Interval all = t.to_interval();
  const auto outside = [&](bool is_left, double s) {  // ∫_0^s φ ≤ s φ(s)
    if (s <= 0) return Ball(is_left ? 0 : 1);
    const double top =
        (Ball(s) * density(is_left ? Ball(s) : Ball(1) - Ball(s), 0)[0] / table->total).to_interval().sup();
    return is_left ? ball_between(0, top) : Ball(1) - ball_between(0, top);
  };
  if (all.sup() < table->all.front().begin) return outside(true, all.sup());
  if (all.inf() > table->all.back().end) return outside(false, std::nextafter(1 - all.inf(), 2));
  const double middle = all.inf() / 2 + all.sup() / 2;
  const auto after = std::lower_bound(table->all.begin(), table->all.end(), middle,
                                      [](const Panel& p, double x) { return p.end < x; });
  const Panel& p = after == table->all.end() ? table->all.back() : *after;
  if (all.inf() < p.centre - 1.45 * p.half || all.sup() > p.centre + 1.45 * p.half ||
      all.sup() - all.inf() > p.half / 4) {
    if (all.is_point()) return middle < 0.5 ? outside(true, p.begin) : outside(false, std::nextafter(1 - p.end, 2));
    return ball_between(value(Ball(all.inf())).to_interval().inf(), value(Ball(all.sup())).to_interval().sup());
  }
  const Ball y = (t - Ball(p.centre)) / Ball(p.half);
  Ball sum = p.integral.back();
  for (std::size_t k = p.integral.size() - 1; k-- > 0;) sum = sum * y + p.integral[k];
  sum = sum + p.rest;
  if (middle <= l_) return (p.before + sum) / table->total;
  Ball whole;
  for (const Ball& c : p.integral) whole += c;
  return Ball(1) - (p.after + (whole - sum)) / table->total;
}

}  // namespace

std::shared_ptr<const SmoothBFunction> make_expo_rational(const BFunction::Intrinsic& parameters) {
  return std::make_shared<const ExpoRational>(parameters);
}

}  // namespace patchproof::detail
