// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "patchproof/deadline.h"
#include "patchproof/scalar/ball.h"

namespace patchproof {
namespace detail {

long common_exponent(const std::vector<ScaledInterval>& scaled) {
  long exponent = std::numeric_limits<long>::min();
  for (const ScaledInterval& x : scaled)
    if (x.mantissa.sup() != 0 || x.mantissa.inf() != 0) exponent = std::max(exponent, x.exponent);
  return exponent == std::numeric_limits<long>::min() ? 0 : exponent;
}

std::vector<Interval> align(const std::vector<ScaledInterval>& scaled, long exponent) {
  std::vector<Interval> out;
  out.reserve(scaled.size());
  for (const ScaledInterval& x : scaled)
    out.push_back(x.exponent == exponent ? x.mantissa : scale_by_power_of_two(x.mantissa, x.exponent - exponent));
  return out;
}

}  // namespace detail

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Pseudo-angles: q(θ) = sin θ/(sin θ + cos θ) up to 90°, 2 − q(180° − θ) beyond. Monotone, in [0, 2], free of trigonometry.
constexpr double kStraight = 1, kHalfTurn = 2;

Interval norm(const DeviationCoefficient& c) {
  constexpr double kSmall = 0x1p-400, kLarge = 0x1p400;  // between them no square leaves the range of doubles
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max({size, c[k].sup(), -c[k].inf()});
  if (size == 0 || size == kInfinity || (kSmall < size && size < kLarge))
    return sqrt(square(c[0]) + square(c[1]) + square(c[2]));
  const int exponent = std::ilogb(size);
  const auto scaled = [&](int k) { return scale_by_power_of_two(c[k], -exponent); };
  return scale_by_power_of_two(sqrt(square(scaled(0)) + square(scaled(1)) + square(scaled(2))), exponent);
}

// Encloses y/(x + y) for non-negative x, y, not both zero.
Interval fraction(double y, double x) {
  if (!(x < kInfinity && y < kInfinity)) return Interval(0.0, 1.0);
  const Interval yi(y), xi(x);
  return yi / (xi + yi);
}

double pseudo_angle_upper(const Interval& y, const Interval& x) {
  if (x.inf() >= 0) return x.inf() + y.sup() > 0 ? std::min(fraction(y.sup(), x.inf()).sup(), kStraight) : kHalfTurn;
  const double yl = std::max(y.inf(), 0.0);
  return yl > 0 ? std::min((Interval(1.0) + fraction(-x.inf(), yl)).sup(), kHalfTurn) : kHalfTurn;
}

double pseudo_angle_lower(const Interval& y, const Interval& x) {
  const double yl = std::max(y.inf(), 0.0);
  if (x.sup() > 0) return yl > 0 ? std::max(fraction(yl, x.sup()).inf(), 0.0) : 0.0;
  if (!(y.sup() > 0)) return x.sup() < 0 ? kHalfTurn : 0.0;  // (0, 0) says nothing
  return x.sup() < 0 ? (Interval(1.0) + fraction(-x.sup(), y.sup())).inf() : (yl > 0 ? kStraight : 0.0);
}

using Coefficients = std::vector<DeviationCoefficient>;

double gap_upper(const Coefficients& c) {
  double upper = 0;
  for (const DeviationCoefficient& x : c) {
    if (!(x[3].inf() > 0)) return kInfinity;
    upper = std::max(upper, (norm(x) / x[3]).sup());
  }
  return upper;
}

double gap_lower(const DeviationCoefficient& x) { return x[3].inf() > 0 ? std::max((norm(x) / x[3]).inf(), 0.0) : 0.0; }

// Hull bound of the pseudo-angle with D taken as orientation · D.
double angle_upper(const Coefficients& c, int orientation) {
  const auto x_of = [orientation](const DeviationCoefficient& k) { return orientation > 0 ? k[3] : -k[3]; };
  const bool below_90 = std::all_of(c.begin(), c.end(), [&](const auto& k) { return x_of(k).inf() >= 0; });
  double upper = 0;
  bool any = false;
  if (below_90) {
    for (const DeviationCoefficient& k : c) {
      const Interval y = norm(k), x = x_of(k);
      if (y.sup() == 0 && x.inf() == 0) continue;  // the zero vector satisfies every half-plane condition
      any = true;
      upper = std::max(upper, pseudo_angle_upper(y, x));
    }
    // Every polynomial value lies in the cone of its coefficients; if they could all be zero nothing is known.
    return any ? upper : kHalfTurn;
  }
  // r: any vector of length at most one; the direction of the middle coefficient, shortened to be safe.
  const DeviationCoefficient& middle = c[c.size() / 2];
  const double length = norm(middle).sup();
  if (!(length > 0) || !(length < kInfinity)) return kHalfTurn;
  std::array<Interval, 3> r;
  for (int i = 0; i < 3; ++i) r[i] = Interval((middle[i].inf() + middle[i].sup()) / 2) / Interval(length);
  const double r_length = sqrt(square(r[0]) + square(r[1]) + square(r[2])).sup();
  const Interval shorten = r_length > 1 ? Interval(1.0) / Interval(r_length) : Interval(1.0);
  upper = kStraight;
  for (const DeviationCoefficient& k : c) {
    const Interval y = shorten * (r[0] * k[0] + r[1] * k[1] + r[2] * k[2]), x = x_of(k);
    if (!(y.inf() >= 0)) return kHalfTurn;
    if (x.inf() >= 0) continue;
    upper = std::max(upper, pseudo_angle_upper(y, x));
  }
  return upper;
}

// The factor F's sign over the node: +1, −1, or 0 when it may be either.
int sign_of_factor(const Coefficients& c) {
  bool positive = true, negative = true;
  for (const DeviationCoefficient& k : c) {
    positive = positive && k[4].inf() >= 0;
    negative = negative && k[4].sup() <= 0;
  }
  return positive ? 1 : negative ? -1 : 0;
}

double upper_bound(const Coefficients& c, Deviation what) {
  if (what == Deviation::gap) return gap_upper(c);
  if (what == Deviation::plane_angle) {
    const bool all_below = std::all_of(c.begin(), c.end(), [](const auto& k) { return k[3].sup() <= 0; });
    return std::min(angle_upper(c, all_below ? -1 : 1), kStraight);
  }
  const int sign = sign_of_factor(c);
  const double upper = sign != 0 ? angle_upper(c, sign) : std::max(angle_upper(c, 1), angle_upper(c, -1));
  return upper;
}

double lower_bound(const DeviationCoefficient& x, Deviation what) {
  if (what == Deviation::gap) return gap_lower(x);
  if (what == Deviation::plane_angle)  // at least the smaller of the two angles that the enclosures allow
    return std::min(pseudo_angle_lower(norm(x), x[3]), pseudo_angle_lower(norm(x), -x[3]));
  if (x[4].inf() > 0) return pseudo_angle_lower(norm(x), x[3]);
  if (x[4].sup() < 0) return pseudo_angle_lower(norm(x), -x[3]);
  return 0;
}

struct Node {
  double upper;
  int piece, depth;
  double begin, end;  // dyadic
  Coefficients c;
  bool operator<(const Node& o) const {  // the queue's top has the largest bound; ties by place, for determinism
    return upper != o.upper ? upper < o.upper : piece != o.piece ? piece > o.piece : begin > o.begin;
  }
};

std::pair<Coefficients, Coefficients> halves(const Coefficients& c) {
  Coefficients left, right(c), row(c);
  const std::size_t n = c.size();
  left.reserve(n);
  const Interval half(0.5);
  for (std::size_t r = 0; r < n; ++r) {
    left.push_back(row[0]);
    right[n - 1 - r] = row[n - 1 - r];
    for (std::size_t j = 0; j + 1 < n - r; ++j)
      for (int k = 0; k < 5; ++k) row[j][k] = (row[j][k] + row[j + 1][k]) * half;
  }
  return {std::move(left), std::move(right)};
}

// Pseudo-angle to degrees, rounded outward: tan θ = q/(1 − q) below 90°, mirrored beyond.
double degrees(double q, bool upward) {
  if (q <= 0) return 0;
  if (q >= kHalfTurn) return 180;
  if (q == kStraight) return 90;
  const Ball p = q < kStraight ? Ball(q) : Ball(2) - Ball(q);
  Ball angle = atan(p / (Ball(1) - p)) * Ball(180) / Ball::pi();
  if (q > kStraight) angle = Ball(180) - angle;
  const Interval d = angle.to_interval();
  return upward ? d.sup() : d.inf();
}

}  // namespace

DeviationBound bound_deviation(const std::vector<DeviationPiece>& pieces, Deviation what, const Budget& budget) {
  constexpr int kMaxDepth = 45;  // dyadic parameters stay exact, and intervals cannot shrink further
  double lower = 0, pruned = 0;
  DeviationBound bound;
  std::priority_queue<Node> queue;
  const auto try_witness = [&](const DeviationCoefficient& x, int piece, double t) {
    const double value = lower_bound(x, what);
    if (value > lower) lower = value, bound.piece = piece, bound.t = t;
  };
  const auto push = [&](Coefficients c, int piece, int depth, double begin, double end) {
    const double upper = upper_bound(c, what);
    if (upper <= lower || depth >= kMaxDepth) {
      pruned = std::max(pruned, upper);
      return;
    }
    queue.push({upper, piece, depth, begin, end, std::move(c)});
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    try_witness(pieces[i].coefficients.front(), static_cast<int>(i), 0);
    try_witness(pieces[i].coefficients.back(), static_cast<int>(i), 1);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) push(pieces[i].coefficients, static_cast<int>(i), 0, 0, 1);
  constexpr std::size_t kWork = 4096;
  std::size_t work = kWork;
  int nodes = 0;
  const auto too_wide = [&](double upper) {
    return upper == kInfinity || upper - lower > std::ldexp(upper, -budget.tight_bits);
  };
  while (!queue.empty() && too_wide(queue.top().upper)) {
    if (++nodes > budget.nodes) break;
    // Halving costs the square of the degree: a look at the clock must cost little beside it, and not come too late.
    work += queue.top().c.size() * queue.top().c.size();
    if (work > kWork) {
      work = 0;
      if (has_deadline_passed() || std::chrono::steady_clock::now() > budget.deadline) break;
    }
    const Node node = queue.top();
    queue.pop();
    auto [left, right] = halves(node.c);
    const double middle = (node.begin + node.end) / 2;
    try_witness(left.back(), node.piece, middle);
    push(std::move(left), node.piece, node.depth + 1, node.begin, middle);
    push(std::move(right), node.piece, node.depth + 1, middle, node.end);
  }
  double upper = std::max(lower, pruned);
  if (!queue.empty()) upper = std::max(upper, queue.top().upper);
  bound.lower = what == Deviation::gap ? lower : degrees(lower, false);
  bound.upper = what == Deviation::gap ? upper : degrees(upper, true);
  bound.converged = bound.upper - bound.lower <= bound.upper / 100 && bound.upper < kInfinity;
  return bound;
}

}  // namespace patchproof
