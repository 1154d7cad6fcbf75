// SPDX-License-Identifier: Apache-2.0
// GERBS curves as ordinary splines, and how smooth they are.
//
// With B = n/d (d = 1 for polynomials) and homogeneous local curves P, Q of weights w_P, w_Q, the piece between two knots is
//
//   F = (d − n) P + n Q                  where w_P = w_Q          degree deg B + max(deg P, deg Q)
//   F = (d − n) w_Q P + n w_P Q          otherwise                deg B + deg P + deg Q
//
// and pieces are multiplied by constants so that their weights meet.
//
// ENSURES   (1) to_spline: the same curve, exactly; inner knots stand as often as the homogeneous pieces need;
//           (2) smoothness: f is C^order at the break, and not of a higher order where `exact`; `jump` encloses the jump of the next
//           derivative, right minus left.
// SCALARS   T: ExactField, K: OrderedField that is exact.
// ERRORS    unsupported: a transcendental B-function or trigonometric local curves.
// COST      O(p³) for each break.
// NEIGHBOURS smoothness.h (exact jumps of the spline), piecewise.h.
// TEST      tests/spline/gerbs_spline_test.cpp checks (1)–(2).
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/scalar/ball.h"
#include "patchproof/spline/gerbs_curve.h"
#include "patchproof/spline/piecewise.h"
#include "patchproof/spline/smoothness.h"

namespace patchproof {

template <ExactField T, std::size_t M, OrderedField K>
Result<BsplineCurve<T, M, K>> to_spline(const GerbsCurve<T, M, K>& curve);

template <std::size_t N, OrderedField K>
struct GerbsBreak {
  K t;
  int order;                             // kOneFunction: all derivatives agree
  bool exact;                            // false: at least of this order
  std::optional<Vec<Interval, N>> jump;  // of the derivative of order + 1; nothing where all agree
};

// At every break inside the domain, and where the B-function itself is not smooth (BFunction::smoothness). REQUIRES a RoundingGuard
// alive.
template <ExactField T, std::size_t M, OrderedField K>
std::vector<GerbsBreak<M - 1, K>> smoothness(const GerbsCurve<T, M, K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// B over [begin, end]: numerator and denominator.
template <Field T, OrderedField K>
std::array<Piecewise<T, 1, K>, 2> b_function_pieces(const BFunction& b, const K& begin, const K& end) {
  const auto piece = [&](const std::vector<Rational>& coefficients) {
    std::vector<Vec<T, 1>> points;
    for (const Rational& c : coefficients) points.push_back({{embed<T>(c)}});
    return Piecewise<T, 1, K>{{begin, end, std::move(points)}};
  };
  return {piece(b.numerator()), piece(b.denominator())};
}

template <Field T, std::size_t M, OrderedField K>
Piecewise<T, 1, K> weights_of(const Piecewise<T, M, K>& f) {
  Piecewise<T, 1, K> out;
  for (const auto& piece : f) {
    out.push_back({piece.begin, piece.end, {}});
    for (const Vec<T, M>& p : piece.points) out.back().points.push_back({{p[M - 1]}});
  }
  return out;
}

template <ExactField T, std::size_t N, OrderedField K>
bool are_equal(const Piecewise<T, N, K>& f, const Piecewise<T, N, K>& g) {
  for (const auto& piece : sum(f, scale(T(-1), g)))
    for (const Vec<T, N>& p : piece.points)
      if (!(p == Vec<T, N>{})) return false;
  return true;
}

// The homogeneous pieces of span i.
template <ExactField T, std::size_t M, OrderedField K>
Piecewise<T, M, K> span_pieces(const GerbsCurve<T, M, K>& curve, int i) {
  const K &begin = curve.knots()[i], &end = curve.knots()[i + 1];
  const auto local = [&](int k) {
    return window(Piecewise<T, M, K>(extract_bezier(curve.locals()[k].spline())), begin, end);
  };
  Piecewise<T, M, K> before = local(i - 1);
  if (curve.locals()[i - 1] == curve.locals()[i]) return before;
  Piecewise<T, M, K> after = local(i);
  const auto [n, d] = b_function_pieces<T>(curve.b_function(), begin, end);
  const Piecewise<T, 1, K> weight_before = weights_of(before), weight_after = weights_of(after);
  if (!are_equal(weight_before, weight_after)) {
    before = product(weight_after, before);
    after = product(weight_before, after);
  }
  return sum(product(sum(d, scale(T(-1), n)), before), product(n, after));
}

// Without the pieces' end where the neighbour says more: the factor that makes the weight at `at` equal to `wanted`.
template <ExactField T, std::size_t M>
void scale_weight(std::vector<Vec<T, M>>& points, const T& wanted) {
  const T factor = wanted / points.front()[M - 1];
  if (factor == T(1)) return;
  for (Vec<T, M>& p : points) p = factor * p;
}

}  // namespace detail

template <ExactField T, std::size_t M, OrderedField K>
Result<BsplineCurve<T, M, K>> to_spline(const GerbsCurve<T, M, K>& curve) {
  if (!curve.is_exact())
    return Error{ErrorCode::unsupported, "",
                 "this GERBS curve is no spline: its B-function or a local curve is transcendental",
                 curve.b_function().to_string()};
  Piecewise<T, M, K> all;
  for (int i = 1; i < curve.knots().control_count(); ++i)
    if (curve.knots()[i] < curve.knots()[i + 1])
      for (auto& piece : detail::span_pieces(curve, i)) {
        if (!all.empty()) detail::scale_weight(piece.points, all.back().points.back()[M - 1]);
        all.push_back(std::move(piece));
      }
  int degree = 0;
  for (const auto& piece : all) degree = std::max(degree, piece.degree());
  return joined_smoothly(elevate(std::move(all), degree));
}

namespace detail {

// How smooth local curve i is at t.
template <ExactField T, std::size_t M, OrderedField K>
int local_order(const GerbsCurve<T, M, K>& curve, int i, const K& t) {
  const auto& local = curve.locals()[i];
  if (local.basis().is_trigonometric()) return kOneFunction;
  const BsplineCurve<T, M, K> spline = local.spline();
  if (!(spline.knots().domain_begin() < t && t < spline.knots().domain_end())) return kOneFunction;
  return smoothness_at_rational(spline, t).order;
}

// The places λ inside spans where a B-function itself has only some derivatives, in order.
template <ExactField T, std::size_t M, OrderedField K>
std::vector<K> kinks_between_knots(const GerbsCurve<T, M, K>& curve) {
  std::vector<K> out;
  if (!curve.b_function().smoothness()) return out;
  const K lambda = embed<K>(curve.b_function().intrinsic().lambda);
  const KnotVector<K>& knots = curve.knots();
  for (int i = 1; i < knots.control_count(); ++i)
    if (knots[i] < knots[i + 1] && !(curve.locals()[i - 1] == curve.locals()[i]))
      out.push_back(knots[i] + lambda * (knots[i + 1] - knots[i]));
  return out;
}

// What the Hermite property and the smoothness of the local curves promise at a break.
template <ExactField T, std::size_t M, OrderedField K>
int promised_order(const GerbsCurve<T, M, K>& curve, const K& t) {
  const KnotVector<K>& knots = curve.knots();
  const int left = knots.find_span(t, Side::left), right = knots.find_span(t, Side::right);
  if (right > left + 1) return -1;  // a knot that stands twice
  if (right == left) return std::min(local_order(curve, left - 1, t), local_order(curve, left, t));
  return std::min(curve.b_function().order().value_or(kOneFunction), local_order(curve, left, t));
}

}  // namespace detail

template <ExactField T, std::size_t M, OrderedField K>
std::vector<GerbsBreak<M - 1, K>> smoothness(const GerbsCurve<T, M, K>& curve) {
  std::vector<GerbsBreak<M - 1, K>> out;
  const std::vector<K> breaks = curve.breaks();
  if (curve.is_exact()) {
    // The first jump is mostly that of the derivative after B's order; where it is not, the polynomials decide.
    const int likely = curve.b_function().order().value_or(0) + 1;
    std::optional<BsplineCurve<T, M, K>> spline;
    for (std::size_t k = 1; k + 1 < breaks.size(); ++k) {
      const K& t = breaks[k];
      const auto left = derivatives_at<T>(curve, t, Side::left, embed<T>(t), likely),
                 right = derivatives_at<T>(curve, t, Side::right, embed<T>(t), likely);
      int order = 0;
      while (order <= likely && left[order] == right[order]) ++order;
      GerbsBreak<M - 1, K> found{t, order - 1, true, std::nullopt};
      Vec<T, M - 1> jump{};
      if (order <= likely) {
        jump = right[order] - left[order];
      } else {
        if (!spline) spline = *to_spline(curve);
        const Smoothness<T, M - 1> here = smoothness_at_rational(*spline, t);
        found.order = here.order;
        jump = here.jump;
      }
      if (found.order != kOneFunction) {
        found.jump.emplace();
        for (std::size_t c = 0; c + 1 < M; ++c) (*found.jump)[c] = embed<Interval>(jump[c]);
      }
      out.push_back(std::move(found));
    }
    return out;
  }
  const std::vector<K> kinks = detail::kinks_between_knots(curve);
  for (const K& t : kinks) {
    const int i = curve.knots().find_span(t);
    const int order = std::min(
        {*curve.b_function().smoothness(), detail::local_order(curve, i - 1, t), detail::local_order(curve, i, t)});
    out.push_back({t, order, false, std::nullopt});
  }
  for (std::size_t k = 1; k + 1 < breaks.size(); ++k) {
    const K& t = breaks[k];
    if (std::binary_search(kinks.begin(), kinks.end(), t)) continue;
    GerbsBreak<M - 1, K> found{t, detail::promised_order(curve, t), true, std::nullopt};
    if (found.order != kOneFunction) {
      const auto next = [&](Side side) {
        return derivatives_at<Ball>(curve, t, side, embed<Ball>(t), found.order + 1).back();
      };
      const Vec<Ball, M - 1> left = next(Side::left), right = next(Side::right);
      found.exact = false;
      found.jump.emplace();
      for (std::size_t c = 0; c + 1 < M; ++c) {
        const Ball jump = right[c] - left[c];
        (*found.jump)[c] = jump.to_interval();
        const std::optional<Sign> sign = jump.sign();
        found.exact = found.exact || (sign && *sign != Sign::zero);
      }
    }
    out.push_back(std::move(found));
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return out;
}

}  // namespace patchproof
