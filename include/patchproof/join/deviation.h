// SPDX-License-Identifier: Apache-2.0
// The largest gap and the largest normal angle over a whole join, each enclosed: `lower` is attained at a witness
// parameter, `upper` is proved by Bernstein hulls and subdivision. Nothing here is sampled.
//
// Input are polynomials of the piece, already formed by symbolic cancellation (join_polynomials.h):
//     gap    g(t) = |N| / W                        N = point difference numerator, W = w_X w_Y > 0
//     angle  θ(t) = atan2(|C|, σ D) in [0°, 180°]  C = n_X × m, D = n_X · m, m = −n_Y; σ = sign of F
// F is 1 except where a factor that changes its sign was divided out of a normal; where F's sign is uncertain, both are
// taken. With B_j ≥ 0 the Bernstein basis and N = Σ B_j N_j etc.:
//     |N|/W ≤ max_j |N_j|/W_j                                       when all W_j > 0
//     θ ≤ max_j atan2(|C_j|, D_j)                                   when all D_j ≥ 0
//     θ ≤ max(90°, max_j atan2(r·C_j, D_j)) for any |r| ≤ 1         when all r·C_j ≥ 0
//     min(θ, 180° − θ) ≤ max_j atan2(|C_j|, |D_j|)                  when all D_j have one sign, else ≤ 90°
// and the hulls converge quadratically under subdivision.
//
// ENSURES  (1) lower ≤ sup ≤ upper;  (2) lower ≤ value at the witness;  (3) when `converged`, upper − lower ≤ 1 % of upper.
// REQUIRES a RoundingGuard alive.
#pragma once

#include <array>
#include <chrono>
#include <vector>

#include "patchproof/join/join_polynomials.h"
#include "patchproof/scalar/interval.h"

namespace patchproof {

// One Bernstein coefficient of the stacked polynomials: three components of N (of C), then W (D), then F.
using DeviationCoefficient = std::array<Interval, 5>;

struct DeviationPiece {
  std::vector<DeviationCoefficient> coefficients;
};

// plane_angle is the angle between the tangent planes, min(θ, 180° − θ) in [0°, 90°]: what tools report that do not know
// on which side the patches lie.
enum class Deviation { gap, angle, plane_angle };

// When to stop working on one join. Every limit ends in an honest `undecided`, never in a guess.
struct Budget {
  int nodes = 20000;   // subdivisions per bound: the same on every machine
  int tight_bits = 8;  // stop when (upper − lower) ≤ 2^−tight_bits · upper (angles: of their key)
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

struct DeviationBound {
  double lower = 0, upper = 0;  // gap: model units; angle: degrees
  int piece = 0;                // the witness of `lower`: a piece and a local parameter in [0, 1], a dyadic number
  double t = 0;
  bool converged = true;  // upper − lower ≤ 1 % of upper
};

// ERRORS none: an undefined quotient (0/0 in a hull) gives upper = +infinity (gap) or 180 (angle) and !converged.
// COST about 10 to 50 subdivisions of O(degree²) per piece when smooth.
DeviationBound bound_deviation(const std::vector<DeviationPiece>& pieces, Deviation what, const Budget& budget = {});

// Stacks N and W (C, D and F) as interval Bernstein coefficients; rational scale factors are removed rigorously.
// numerator and denominator may be over any ring that has enclose_scaled(), or Interval.
template <Ring R>
DeviationPiece deviation_piece(const FormVector<R>& numerator, const BinaryForm<R>& denominator,
                               const BinaryForm<R>& sign = BinaryForm<R>::constant(R(1)));

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

inline ScaledInterval enclose_scaled_in(const Interval& x) { return {x, 0}; }
template <ExactRing R>
ScaledInterval enclose_scaled_in(const R& x) {
  return enclose_scaled(x);
}

// Enclosures of the Bernstein coefficients of forms of one degree, with one common power of two.
std::vector<Interval> align(const std::vector<ScaledInterval>& scaled, long exponent);
long common_exponent(const std::vector<ScaledInterval>& scaled);

}  // namespace detail

template <Ring R>
DeviationPiece deviation_piece(const FormVector<R>& numerator, const BinaryForm<R>& denominator,
                               const BinaryForm<R>& sign) {
  const std::array<const BinaryForm<R>*, 5> forms{&numerator[0], &numerator[1], &numerator[2], &denominator, &sign};
  int degree = 0;
  for (const BinaryForm<R>* f : forms) degree = std::max(degree, f->degree());
  const std::vector<Interval> binomial = binomials<Interval>(degree);
  std::array<std::vector<ScaledInterval>, 5> scaled;
  for (int k = 0; k < 5; ++k) {
    if (forms[k]->is_empty()) {
      scaled[k].resize(degree + 1);
      continue;
    }
    const BinaryForm<R> full = forms[k]->elevated(degree - forms[k]->degree());
    for (int i = 0; i <= degree; ++i) {
      ScaledInterval x = detail::enclose_scaled_in(full[i]);
      x.mantissa = x.mantissa / binomial[i];
      scaled[k].push_back(x);
    }
  }
  // N and W (C and D) are scaled together, the larger to size one, so that only the quotient may leave the range of doubles.
  std::vector<ScaledInterval> quotient;
  for (int k = 0; k < 4; ++k) quotient.insert(quotient.end(), scaled[k].begin(), scaled[k].end());
  const long exponent = detail::common_exponent(quotient), sign_exponent = detail::common_exponent(scaled[4]);
  DeviationPiece piece;
  piece.coefficients.resize(degree + 1);
  for (int k = 0; k < 5; ++k) {
    const std::vector<Interval> column = detail::align(scaled[k], k < 4 ? exponent : sign_exponent);
    for (int i = 0; i <= degree; ++i) piece.coefficients[i][k] = column[i];
  }
  return piece;
}

}  // namespace patchproof
