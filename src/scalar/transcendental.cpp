// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/transcendental.h"

#include <algorithm>
#include <cmath>

#include "patchproof/contract.h"

namespace patchproof::detail {
namespace {

// x = turns/2 + rest with |rest| ≤ 1/4, turns modulo 4. Both steps are exact: fmod always is, and the difference of x and
// a multiple of 1/2 that is as near has no more digits than x.
struct Reduced {
  int turns;
  double rest;
};
Reduced reduce(double x) {
  const double small = std::fmod(x, 2.0);
  int turns = 0;
  double rest = small;
  while (rest > 0.25) rest -= 0.5, ++turns;
  while (rest < -0.25) rest += 0.5, --turns;
  return {(turns % 4 + 4) % 4, rest};
}

// (cos, sin) of π (rest + turns/2) from those of π rest.
template <class R>
std::array<R, 2> turned(const R& c, const R& s, int turns) {
  switch (turns) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

// (−1)^k π^(2k)/(2k)! and (−1)^k π^(2k+1)/(2k+1)!, rounded to nearest.
struct Series {
  static constexpr int kTerms = 9;
  double c[kTerms + 1], s[kTerms];
  Series() {
    const BallPrecision precision(128);
    Ball term(1);
    for (int k = 0; k <= 2 * kTerms; ++k) {
      if (k > 0) term = term * Ball::pi() / Ball(k);
      const double value = middle(k / 2 % 2 == 0 ? term : -term);
      if (k % 2 == 0)
        c[k / 2] = value;
      else
        s[k / 2] = value;
    }
  }
  static double middle(const Ball& x) {
    const Interval all = x.to_interval();  // one or two neighbouring doubles
    const double low = all.inf(), high = all.sup();
    const Sign below = (x - Ball(low) - (Ball(high) - x)).sign().value_or(Sign::negative);
    return below == Sign::positive ? high : low;
  }
};

// Is x the point k/2? Then k modulo 4.
std::optional<int> half_turns(const Interval& x) {
  if (!x.is_point() || !std::isfinite(x.inf())) return std::nullopt;
  const Reduced r = reduce(x.inf());
  return r.rest == 0 ? std::optional(r.turns) : std::nullopt;
}

}  // namespace

double Circular<double>::pi() {
  static const double value = [] {  // whatever precision the first caller has
    const BallPrecision precision(128);
    return Series::middle(Ball::pi());
  }();
  return value;
}

// |error| ≤ 2^-51: the terms left out are below 10^-17, the sums of the rest are dominated by their first terms, π r ≤ 0.8 and
// 1, which meet three roundings (coefficient, sum, product); the others are smaller by z ≤ 1/16 at least times 5/π.
std::array<double, 2> Circular<double>::cos_sin_pi(double x) {
  PATCHPROOF_REQUIRES(std::isfinite(x), "cos_sin_pi: NaN and infinity are no angles");
  static const Series series;
  const Reduced r = reduce(x);
  const double z = r.rest * r.rest;
  double c = series.c[Series::kTerms], s = series.s[Series::kTerms - 1];
  for (int k = Series::kTerms; k-- > 0;) c = series.c[k] + z * c;
  for (int k = Series::kTerms - 1; k-- > 0;) s = series.s[k] + z * s;
  return turned(c, r.rest * s, r.turns);
}

Interval Circular<Interval>::pi() { return Ball::pi().to_interval(); }

std::array<Interval, 2> Circular<Interval>::cos_sin_pi(const Interval& x) {
  if (!std::isfinite(x.inf()) || !std::isfinite(x.sup())) return {Interval(-1.0, 1.0), Interval(-1.0, 1.0)};
  const BallPrecision precision(128);
  const std::array<Ball, 2> out = Circular<Ball>::cos_sin_pi(Ball(x));
  const auto cut = [](const Interval& y) { return Interval(std::max(y.inf(), -1.0), std::min(y.sup(), 1.0)); };
  return {cut(out[0].to_interval()), cut(out[1].to_interval())};
}

Ball Circular<Ball>::pi() { return Ball::pi(); }

// About the multiple of 1/2 that is nearest to the middle, so that results near 0 keep their digits.
std::array<Ball, 2> Circular<Ball>::cos_sin_pi(const Ball& x) {
  const Interval all = x.to_interval();
  if (const std::optional<int> turns = half_turns(all)) return turned(Ball(1), Ball(0), *turns);
  if (!(std::fabs(all.inf()) < 0x1p50 && std::fabs(all.sup()) < 0x1p50))
    return {cos(Ball::pi() * x), sin(Ball::pi() * x)};
  const double nearest = std::nearbyint(all.inf() + all.sup());  // twice the middle
  const Ball rest = x - Ball(nearest / 2);
  const int turns = static_cast<int>(std::fmod(nearest, 4.0));
  const Ball angle = Ball::pi() * rest;
  return turned(cos(angle), sin(angle), (turns + 4) % 4);
}

}  // namespace patchproof::detail
