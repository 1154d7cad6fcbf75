// SPDX-License-Identifier: Apache-2.0
// The denominator of a rational patch: does w(u,v) = Σ w_ij N_i(u) N_j(v) have a zero anywhere on the closed domain?
//
// Weights may be negative or zero as long as w keeps away from zero; only w itself counts. Weights of one strict sign
// settle it at once (w is a convex combination of them). Otherwise each Bézier piece of w is halved until
//   all its Bernstein coefficients b_ij have one sign, with non-zero b at the four corners: then w ≠ 0 on the closed box,
//     for at an inner point every corner's basis function is positive, and on an edge those of its two corners are;
//   a corner value is zero, or two corner values have opposite signs: then w has a zero in the box;
//   the box is too small: the fraction with the smallest denominator near it is tried as a zero (this finds a touching
//     zero such as that of (3u − 1)²), and if it is none, the answer for this piece is `undecided`.
//
// ENSURES  (1) positive / negative: w has that strict sign at every point of the closed domain, from either side of every
//          knot;  (2) vanishes: the box `where` contains a zero of w; a box of one point is a zero itself;
//          (3) one_sign_per_piece: w has no zero, but jumps to the other sign across a knot of full multiplicity;
//          (4) the answer is unchanged by knot insertion, swapping u and v, reversal and scaling of w by a positive number
//          as long as it is decided;  (5) it ends: the work is bounded by `limits`.
// SCALARS  T: ExactField.
// ERRORS   none: what to do with a vanishing denominator is the caller's business (readers: vanishing_weight).
// COST     O(net) when the weights have one strict sign; otherwise Bézier extraction and at most limits.averages averages
//          of numbers.
// TEST     tests/patch/denominator_test.cpp checks (1)–(5).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/bspline_patch.h"

namespace patchproof {

enum class DenominatorSign { positive, negative, one_sign_per_piece, vanishes, undecided };

template <OrderedField K>
struct DenominatorVerdict {
  DenominatorSign sign;
  // vanishes: a box with a zero, or the zero itself;  undecided: a box where a zero could not be excluded;
  // otherwise the whole domain.
  ParameterBox<K> where;

  // Proven to have no zero.
  bool is_nonzero() const { return sign != DenominatorSign::vanishes && sign != DenominatorSign::undecided; }
};

struct DenominatorLimits {
  int halvings = 20;          // per direction, at most 30
  long averages = 1'000'000;  // of numbers, per patch
};

// The last component of the control points is the weight.
template <ExactField T, std::size_t N, OrderedField K>
DenominatorVerdict<K> certify_denominator(const BsplinePatch<T, N, K>& patch, const DenominatorLimits& limits = {});

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// A Bézier piece of the denominator, halved du times in u and dv times in v: [iu, iu + 1] / 2^du × [iv, iv + 1] / 2^dv.
template <Ring T>
struct HalvedPiece {
  BezierPatch<T, 1> net;
  long iu = 0, iv = 0;
  int du = 0, dv = 0;
};

template <OrderedField K>
K at_fraction(const K& begin, const K& end, long numerator, long denominator) {
  return begin + (end - begin) * K(static_cast<int>(numerator)) / K(static_cast<int>(denominator));
}

template <Ring T, OrderedField K>
ParameterBox<K> box_of(const ParameterBox<K>& whole, const HalvedPiece<T>& piece) {
  const long nu = 1L << piece.du, nv = 1L << piece.dv;
  return {
      at_fraction(whole.u_begin, whole.u_end, piece.iu, nu), at_fraction(whole.u_begin, whole.u_end, piece.iu + 1, nu),
      at_fraction(whole.v_begin, whole.v_end, piece.iv, nv), at_fraction(whole.v_begin, whole.v_end, piece.iv + 1, nv)};
}

// The fraction with the smallest denominator in [low, high] / n, found by descending the Stern–Brocot tree; empty when it
// lies deeper than 64 levels. REQUIRES low < high, 0 < n ≤ 2^30, and a part of [0, 1] between them.
inline std::optional<std::pair<long, long>> simplest_fraction(long low, long high, long n) {
  if (low <= 0) return std::pair(0L, 1L);
  if (high >= n) return std::pair(1L, 1L);
  std::pair<long, long> below{0, 1}, above{1, 1};
  for (int level = 0; level < 64; ++level) {
    const std::pair<long, long> middle{below.first + above.first, below.second + above.second};
    if (middle.first * n < low * middle.second)
      below = middle;
    else if (middle.first * n > high * middle.second)
      above = middle;
    else
      return middle;
  }
  return std::nullopt;
}

// All coefficients have the sign s or are zero.
template <ExactField T>
bool no_coefficient_against(const BezierPatch<T, 1>& net, Sign s) {
  for (const Vec<T, 1>& b : net.net()) {
    const Sign sign = *scalar_traits<T>::sign(b[0]);
    if (sign != s && sign != Sign::zero) return false;
  }
  return true;
}

// The verdict on one Bézier piece over `whole`; positive, negative, vanishes or undecided.
template <ExactField T, OrderedField K>
DenominatorVerdict<K> certify_piece(const BezierPatch<T, 1>& piece, const ParameterBox<K>& whole,
                                    const DenominatorLimits& limits, long& averages_left) {
  const auto sign_of = [](const T& x) { return *scalar_traits<T>::sign(x); };
  const Sign expected = sign_of(piece.point(0, 0)[0]);
  std::vector<HalvedPiece<T>> open;
  open.push_back({piece});
  while (!open.empty()) {
    const HalvedPiece<T> box = std::move(open.back());
    open.pop_back();
    const int p = box.net.degree(Direction::u), q = box.net.degree(Direction::v);
    const ParameterBox<K> here = box_of(whole, box);
    for (const int i : {0, p})
      for (const int j : {0, q}) {
        const Sign corner = sign_of(box.net.point(i, j)[0]);
        if (corner == expected && corner != Sign::zero) continue;
        if (corner != Sign::zero) return {DenominatorSign::vanishes, here};
        const K& u = i == 0 ? here.u_begin : here.u_end;
        const K& v = j == 0 ? here.v_begin : here.v_end;
        return {DenominatorSign::vanishes, {u, u, v, v}};
      }
    if (no_coefficient_against(box.net, expected)) continue;

    const bool can_u = p > 0 && box.du<limits.halvings, can_v = q> 0 && box.dv < limits.halvings;
    if ((!can_u && !can_v) || averages_left <= 0) {
      // A box beside the zero may stay open as well as the one around it, so look a little further.
      const auto x = simplest_fraction(box.iu - 1, box.iu + 2, 1L << box.du);
      const auto y = simplest_fraction(box.iv - 1, box.iv + 2, 1L << box.dv);
      if (x && y) {
        const T a = T(static_cast<int>(x->first)) / T(static_cast<int>(x->second));
        const T b = T(static_cast<int>(y->first)) / T(static_cast<int>(y->second));
        if (sign_of(evaluate(piece, a, b)[0]) == Sign::zero) {
          const K u = at_fraction(whole.u_begin, whole.u_end, x->first, x->second);
          const K v = at_fraction(whole.v_begin, whole.v_end, y->first, y->second);
          return {DenominatorSign::vanishes, {u, u, v, v}};
        }
      }
      return {DenominatorSign::undecided, here};
    }
    const Direction d = can_u && (!can_v || box.du <= box.dv) ? Direction::u : Direction::v;
    averages_left -= static_cast<long>(p + 1) * (q + 1) * (d == Direction::u ? p : q) / 2 + 1;
    auto [first, second] = split(box.net, d, T(1) / T(2));
    HalvedPiece<T> low{std::move(first), box.iu, box.iv, box.du, box.dv}, high = low;
    high.net = std::move(second);
    for (HalvedPiece<T>* half : {&low, &high}) {
      long& index = d == Direction::u ? half->iu : half->iv;
      index = 2 * index + (half == &high ? 1 : 0);
      ++(d == Direction::u ? half->du : half->dv);
    }
    open.push_back(std::move(high));
    open.push_back(std::move(low));
  }
  return {expected == Sign::positive ? DenominatorSign::positive : DenominatorSign::negative, whole};
}

}  // namespace detail

template <ExactField T, std::size_t N, OrderedField K>
DenominatorVerdict<K> certify_denominator(const BsplinePatch<T, N, K>& patch, const DenominatorLimits& limits) {
  PATCHPROOF_REQUIRES(limits.halvings >= 0 && limits.halvings <= 30, "certify_denominator: 0 to 30 halvings");
  const ParameterBox<K> domain = patch.domain();
  bool positive = true, negative = true;
  for (const Vec<T, N>& p : patch.net()) {
    const Sign sign = *scalar_traits<T>::sign(p[N - 1]);
    positive = positive && sign == Sign::positive;
    negative = negative && sign == Sign::negative;
    if (!positive && !negative) break;
  }
  if (positive) return {DenominatorSign::positive, domain};
  if (negative) return {DenominatorSign::negative, domain};

  const auto weights = map_points(patch, [](const Vec<T, N>& p) { return Vec<T, 1>{{p[N - 1]}}; });
  std::optional<ParameterBox<K>> undecided;
  long averages_left = limits.averages;
  for (const auto& piece : extract_bezier(weights)) {
    const DenominatorVerdict<K> verdict = detail::certify_piece(piece.bezier, piece.box, limits, averages_left);
    if (verdict.sign == DenominatorSign::vanishes) return verdict;
    if (verdict.sign == DenominatorSign::undecided && !undecided) undecided = verdict.where;
    positive = positive || verdict.sign == DenominatorSign::positive;
    negative = negative || verdict.sign == DenominatorSign::negative;
  }
  if (undecided) return {DenominatorSign::undecided, *undecided};
  if (positive && negative) return {DenominatorSign::one_sign_per_piece, domain};
  return {positive ? DenominatorSign::positive : DenominatorSign::negative, domain};
}

}  // namespace patchproof
