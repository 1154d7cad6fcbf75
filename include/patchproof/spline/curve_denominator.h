// SPDX-License-Identifier: Apache-2.0
// The denominator of a rational curve: does W(t) = Σ w_i N_i(t) vanish anywhere on the closed domain, and where?
//
// Weights may be zero or negative; only W counts. Weights of one strict sign settle it at once (W is a convex combination of
// them, and control points without influence are not asked). Otherwise W is a polynomial of one variable on each span, whose
// roots are isolated by sign variations; so there is always an answer.
//
// ENSURES  (1) positive / negative: W has that strict sign on the whole domain, from either side of every knot;
//          (2) one_sign_per_piece: W has no zero, but jumps to the other sign across a knot of multiplicity ≥ p + 1;
//          (3) vanishes: `zeros` holds every zero of W once, in growing order. A break counts when the limit from either
//          side is zero. `begin` = `end` is the zero itself; otherwise exactly one zero lies strictly between, or W is 0 on
//          all of [begin, end];  (4) zeros at breaks and at fractions with a denominator up to 2^10, measured in the span,
//          are given exactly; the others in intervals of less than 2^−20 of their span;
//          (5) knot insertion and scaling of W leave the sign or flip it, and leave the zeros; reversal turns them round.
// SCALARS  T: ExactField that K embeds into. Zeros are numbers of T.
// ERRORS   none: what to do with a vanishing denominator is the caller's business (readers: vanishing_weight).
// COST     O(points) when the weights have one strict sign; otherwise O(p²) points and, when a sign varies, about 20 p²
//          additions for each root.
// SOURCE   G. Collins, A. Akritas, SYMSAC 1976, through real_roots.h.
// NEIGHBOURS patch/denominator.h (two variables, may stay undecided), homogeneous.h (evaluation where W ≠ 0).
#pragma once

#include <optional>
#include <vector>

#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/binary_form.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/real_roots.h"
#include "patchproof/spline/spline_domain.h"

namespace patchproof {

enum class CurveDenominatorSign { positive, negative, one_sign_per_piece, vanishes };

template <ExactField T>
struct DenominatorZero {
  T begin, end;
  bool everywhere = false;  // W is 0 on all of [begin, end]

  bool is_exact() const { return begin == end; }
};

template <ExactField T>
struct CurveDenominatorVerdict {
  CurveDenominatorSign sign;
  std::vector<DenominatorZero<T>> zeros;  // none unless `vanishes`

  bool is_nonzero() const { return sign != CurveDenominatorSign::vanishes; }
};

// The last component of the control points is the weight.
template <ExactField T, std::size_t N, OrderedField K>
CurveDenominatorVerdict<T> certify_denominator(const BsplineCurve<T, N, K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The fraction with the smallest denominator in the open interval (a, b); empty when it is not found in 24 steps of the
// continued fraction with quotients below 2^20. REQUIRES 0 ≤ a < b.
template <ExactField T>
std::optional<T> simplest_between(const T& a, const T& b, int steps = 24) {
  constexpr int kLargestQuotient = 1 << 20;
  if (steps == 0) return std::nullopt;
  int n = ceiling_up_to<T>(a, kLargestQuotient);
  if (T(n) == a) ++n;  // the smallest integer > a
  if (n > kLargestQuotient) return std::nullopt;
  if (T(n) < b) return T(n);
  const T whole(n - 1);  // whole ≤ a < b ≤ whole + 1
  const T low = T(1) / (b - whole);
  // 1/(a − whole) is the upper end; low + 2 is beyond the answer when that is infinite.
  const std::optional<T> rest = a == whole ? simplest_between<T>(low, low + T(2), steps - 1)
                                           : simplest_between<T>(low, T(1) / (a - whole), steps - 1);
  if (!rest) return std::nullopt;
  return whole + T(1) / *rest;
}

// Appends a zero unless it stands there already; an interval takes up what it touches.
template <ExactField T>
void add_zero(std::vector<DenominatorZero<T>>& zeros, DenominatorZero<T> zero) {
  if (!zeros.empty() && zeros.back().end == zero.begin && (zeros.back().is_exact() || zeros.back().everywhere)) {
    if (zero.is_exact()) return;
    if (zero.everywhere) {
      zeros.back() = {zeros.back().begin, zero.end, true};
      return;
    }
  }
  zeros.push_back(std::move(zero));
}

// The zeros of one piece on [begin, end], its ends included.
template <ExactField T>
void add_zeros(const BinaryForm<T>& w, const T& begin, const T& end, std::vector<DenominatorZero<T>>& zeros) {
  if (*is_zero(w)) return add_zero<T>(zeros, {begin, end, true});
  const auto at = [&](const T& x) -> T { return begin + (end - begin) * x; };
  const EndOrders ends = end_orders(w);
  if (ends.at_zero > 0) add_zero<T>(zeros, {begin, begin});
  for (const auto& [low, high] : isolate_roots<T>(w, T(1) / T(1 << 20))) {
    const std::optional<T> guess = low == high ? low : simplest_between<T>(low, high);
    if (guess && *scalar_traits<T>::sign(w(*guess)) == Sign::zero)
      add_zero<T>(zeros, {at(*guess), at(*guess)});
    else
      add_zero<T>(zeros, {at(low), at(high)});
  }
  if (ends.at_one > 0) add_zero<T>(zeros, {end, end});
}

}  // namespace detail

template <ExactField T, std::size_t N, OrderedField K>
CurveDenominatorVerdict<T> certify_denominator(const BsplineCurve<T, N, K>& curve) {
  const auto sign_of = [](const T& x) { return *scalar_traits<T>::sign(x); };
  bool any_positive = false, any_negative = false, any_zero = false;
  const auto note = [&](Sign s) {
    any_positive = any_positive || s == Sign::positive;
    any_negative = any_negative || s == Sign::negative;
    any_zero = any_zero || s == Sign::zero;
  };
  const auto verdict = [&] {
    return any_positive && any_negative ? CurveDenominatorSign::one_sign_per_piece
           : any_positive               ? CurveDenominatorSign::positive
                                        : CurveDenominatorSign::negative;
  };

  const std::vector<int> dead = dead_control_points(curve.knots());
  std::size_t next_dead = 0;
  std::vector<Vec<T, 1>> weights;
  for (const Vec<T, N>& point : curve.points()) {
    const bool is_dead = next_dead < dead.size() && dead[next_dead] == static_cast<int>(weights.size());
    if (is_dead)
      ++next_dead;
    else
      note(sign_of(point[N - 1]));
    weights.push_back({{point[N - 1]}});
  }
  if (!any_zero && !(any_positive && any_negative)) return {verdict(), {}};

  any_positive = any_negative = any_zero = false;
  std::vector<DenominatorZero<T>> zeros;
  for (const auto& piece : extract_bezier(BsplineCurve<T, 1, K>(curve.knots(), std::move(weights)))) {
    std::vector<T> w;
    for (const Vec<T, 1>& b : piece.points) w.push_back(b[0]);
    note(sign_of(w.front()));
    detail::add_zeros<T>(BinaryForm<T>::from_bernstein(std::move(w)), embed<T>(piece.begin), embed<T>(piece.end),
                         zeros);
  }
  if (!zeros.empty()) return {CurveDenominatorSign::vanishes, std::move(zeros)};
  return {verdict(), {}};
}

}  // namespace patchproof
