// SPDX-License-Identifier: Apache-2.0
// GERBS curves: local curves blended by a B-function, and the blend of two curves.
//
//   f(t) = c_{i−1}(t) + B(w) (c_i(t) − c_{i−1}(t)),    w = (t − t_i)/(t_{i+1} − t_i),    t_i ≤ t ≤ t_{i+1}
//   f^(r) = c_{i−1}^(r) + Σ_j C(r,j) (t_{i+1} − t_i)^(−j) B^(j)(w) (c_i − c_{i−1})^(r−j)
//
// N local curves c_0 … c_{N−1} belong to knots t_0 … t_{N+1}: a knot vector of degree 1, with the domain [t_1, t_N]. c_i has its
// centre at t_{i+1} and is used on [t_i, t_{i+2}]. A closed curve of n local curves has period P = t_{n+1} − t_1, N = n + 1,
// c_n(t) = c_0(t − P), t_0 = t_1 − (t_{n+1} − t_n) and t_{n+2} = t_{n+1} + (t_2 − t_1). At a knot that stands twice inside the
// domain the curve jumps.
//
// The blend of a curve on [a, b] with one that begins ℓ before its end is the GERBS curve of these two, each twice: the first as
// it is until b − ℓ, then f = (1 − B) first + B second, then the second.
//
// REQUIRES  local curves whose weights have no zero where they are used.
// ENSURES   (1) derivatives_at is the formula above, in every order and scalar;  (2) Hermite: where B has order n and local
//           curves are Cⁿ, f^(r)(t_{i+1}) = c_i^(r)(t_{i+1}) from both sides, r ≤ n; so f is Cⁿ, as far as B is
//           (BFunction::smoothness);  (3) local curves that are all one
//           curve g give f = g;  (4) one affine map of all local curves maps f;  (5) closed curves end as they begin, with
//           n derivatives;  (6) blend: f is the first curve before the window, the second one after it.
// SCALARS   T: OrderedField, K: OrderedField; values in R: Field, where B and the local curves have values in R
//           (b_function.h, local_curve.h).
// ERRORS    wrong_count: local curves that do not fit the knots;  outside_domain: a local curve that ends inside its support;
//           not_closed: knots of a closed curve that do not repeat;  bad_window: see blend;  bad_number: a break that is not
//           finite;  bad_degree, decreasing_knots, empty_domain: as KnotVector.
// SOURCE    L. T. Dechevsky, A. Lakså, B. Bang, Expo-rational B-splines, Int. J. Pure Appl. Math. 27 (2006) 319–362.
// NEIGHBOURS gerbs_spline.h (as an ordinary spline; smoothness), patch/gerbs_surface.h.
// TEST      tests/spline/gerbs_curve_test.cpp checks (1)–(4), gerbs_curve_closed_test.cpp (5), (6) and the errors.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/b_function.h"
#include "patchproof/spline/local_curve.h"

namespace patchproof {

// The knots over these breaks t_1 … t_N: the ends twice, or, closed, continued by a period.
// ERRORS bad_number, decreasing_knots, empty_domain, wrong_count (fewer than two), not_closed (a closed curve of which an end
// stands twice).
template <OrderedField K>
Result<KnotVector<K>> gerbs_knots(std::vector<K> breaks, bool closed);

template <OrderedField T, std::size_t M, OrderedField K = knot_scalar_t<T>>
class GerbsCurve {
 public:
  using Local = LocalCurve<T, M, K>;

  // Closed: the first n local curves; the last is the first again.
  static Result<GerbsCurve> make(BFunction b, KnotVector<K> knots, std::vector<Local> locals, bool closed = false);
  // ERRORS bad_window unless 0 < overlap ≤ the shorter domain. The second curve is moved to where it begins.
  static Result<GerbsCurve> blend(BFunction b, const BsplineCurve<T, M, K>& first, const BsplineCurve<T, M, K>& second,
                                  const K& overlap);

  const BFunction& b_function() const { return b_; }
  const KnotVector<K>& knots() const { return knots_; }
  const std::vector<Local>& locals() const { return locals_; }  // N
  bool is_closed() const { return closed_; }
  const K& centre(int i) const { return knots_[i + 1]; }
  // The knots, and those of local curves where they are used: between them f is one formula.
  std::vector<K> breaks() const;
  // Whether values in exact numbers exist everywhere: neither a transcendental B-function nor trigonometric curves.
  bool is_exact() const {
    return b_.is_exact() &&
           std::none_of(locals_.begin(), locals_.end(), [](const Local& c) { return c.basis().is_trigonometric(); });
  }

 private:
  GerbsCurve(BFunction b, KnotVector<K> knots, std::vector<Local> locals, bool closed)
      : b_(std::move(b)), knots_(std::move(knots)), locals_(std::move(locals)), closed_(closed) {}

  BFunction b_;
  KnotVector<K> knots_;
  std::vector<Local> locals_;
  bool closed_;
};

// f(t), f′(t), …, of the formula that is the limit at `inside` from `side`; t of any scalar. REQUIRES `inside` in the domain.
template <Field R, OrderedField T, std::size_t M, OrderedField K>
std::vector<Vec<R, M - 1>> derivatives_at(const GerbsCurve<T, M, K>& curve, const K& inside, Side side, const R& t,
                                          int order);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <OrderedField K>
bool is_finite(const K& x) {
  return x - x == K(0);
}

// t_0 and t_{N+1} of a closed curve.
template <OrderedField K>
std::pair<K, K> closed_ends(const std::vector<K>& breaks) {
  const std::size_t n = breaks.size();
  return {K(breaks[0] - (breaks[n - 1] - breaks[n - 2])), K(breaks[n - 1] + (breaks[1] - breaks[0]))};
}

template <OrderedField K>
std::optional<Error> not_closed_knots(const KnotVector<K>& knots) {
  const std::vector<K> breaks(knots.knots().begin() + 1, knots.knots().end() - 1);
  const auto [first, last] = closed_ends(breaks);
  if (first < breaks.front() && breaks.back() < last && first == knots.knots().front() && last == knots.knots().back())
    return std::nullopt;
  if (!(first < breaks.front() && breaks.back() < last))
    return Error{ErrorCode::not_closed, "", "the first and the last span of a closed direction are not empty",
                 to_text(breaks[0]) + " … " + to_text(breaks[1]) + " and " + to_text(breaks[breaks.size() - 2]) +
                     " … " + to_text(breaks.back())};
  return Error{ErrorCode::not_closed, "",
               "the first and the last knot of a closed direction repeat the spans at its ends",
               to_text(knots.knots().front()) + " … " + to_text(knots.knots().back()) + " instead of " +
                   to_text(first) + " … " + to_text(last)};
}

// The local curves or rows of one direction: their number, or why it is another.
template <OrderedField K>
std::optional<Error> wrong_local_count(const KnotVector<K>& knots, bool closed, std::size_t count,
                                       const std::string& what) {
  if (knots.degree() != 1)
    return Error{ErrorCode::bad_degree, "", "the knots of a GERBS have degree 1", std::to_string(knots.degree())};
  if (closed)
    if (auto error = not_closed_knots(knots)) return error;
  const int needed = knots.control_count() - (closed ? 1 : 0);
  if (static_cast<int>(count) == needed) return std::nullopt;
  return Error{ErrorCode::wrong_count, "",
               std::to_string(knots.knots().size() - 2) + (closed ? " closed" : "") + " knots need " +
                   std::to_string(needed) + " " + what,
               std::to_string(count)};
}

// Where local i of one direction is used: its support, cut to the domain.
template <OrderedField K>
std::pair<K, K> used_on(const KnotVector<K>& knots, int i) {
  return {std::max(knots[i], knots.domain_begin()), std::min(knots[i + 2], knots.domain_end())};
}

// Σ_j C(r,j) h^(−j) B^(j)(w): what a factor B(w) does to derivatives, by j: C(r, j) is left to the caller.
template <Field R, OrderedField K>
std::vector<R> blend_derivatives(const BFunction& b, const K& begin, const K& end, const R& t, int order) {
  std::vector<R> out = derivatives(b, knot_ratio<R>(t, begin, end), order);
  const R rate = knot_rate<R>(1, begin, end);
  R power(1);
  for (R& x : out) {
    x = power * x;
    power = power * rate;
  }
  return out;
}

}  // namespace detail

template <OrderedField K>
Result<KnotVector<K>> gerbs_knots(std::vector<K> breaks, bool closed) {
  if (breaks.size() < 2)
    return Error{ErrorCode::wrong_count, "", "a GERBS needs at least two knots", std::to_string(breaks.size())};
  for (std::size_t i = 0; i < breaks.size(); ++i)
    if (!detail::is_finite(breaks[i]))
      return Error{ErrorCode::bad_number, "", "a knot of a GERBS is not a finite number",
                   "number " + std::to_string(i)};
  const auto [first, last] = closed ? detail::closed_ends(breaks) : std::pair(breaks.front(), breaks.back());
  breaks.insert(breaks.begin(), first);
  breaks.push_back(last);
  Result<KnotVector<K>> out = KnotVector<K>::make(1, std::move(breaks));
  if (out && closed)
    if (auto error = detail::not_closed_knots(*out)) return *error;
  return out;
}

template <OrderedField T, std::size_t M, OrderedField K>
Result<GerbsCurve<T, M, K>> GerbsCurve<T, M, K>::make(BFunction b, KnotVector<K> knots, std::vector<Local> locals,
                                                      bool closed) {
  if (auto error = detail::wrong_local_count(knots, closed, locals.size(), "local curves")) return *error;
  if (closed) locals.push_back(locals.front().shifted(K(knots.domain_end() - knots.domain_begin())));
  for (std::size_t i = 0; i < locals.size(); ++i) {
    const auto [begin, end] = detail::used_on(knots, static_cast<int>(i));
    if (!locals[i].covers(begin, end))
      return Error{ErrorCode::outside_domain, "",
                   "local curve " + std::to_string(i) + " is not defined everywhere it is used",
                   to_text(begin) + " … " + to_text(end)};
  }
  return GerbsCurve(std::move(b), std::move(knots), std::move(locals), closed);
}

template <OrderedField T, std::size_t M, OrderedField K>
Result<GerbsCurve<T, M, K>> GerbsCurve<T, M, K>::blend(BFunction b, const BsplineCurve<T, M, K>& first,
                                                       const BsplineCurve<T, M, K>& second, const K& overlap) {
  const K begin = first.knots().domain_begin(), meet = first.knots().domain_end(),
          length = second.knots().domain_end() - second.knots().domain_begin();
  if (!(K(0) < overlap) || meet - begin < overlap || length < overlap)
    return Error{ErrorCode::bad_window, "", "two curves are blended over a part of both, which is not empty",
                 (detail::is_finite(overlap) ? to_text(overlap) : "no number") + " of " + to_text(K(meet - begin)) +
                     " and " + to_text(length)};
  const K from = meet - overlap, end = from + length;
  const Local a(first), z = Local(second).shifted(K(from - second.knots().domain_begin()));
  std::vector<K> breaks;
  std::vector<Local> locals;
  const auto add = [&](const K& at, const Local& local) {
    breaks.push_back(at);
    locals.push_back(local);
  };
  if (begin < from) add(begin, a);
  add(from, a);
  add(meet, z);
  if (meet < end) add(end, z);
  return make(std::move(b), *gerbs_knots(std::move(breaks), false), std::move(locals));
}

template <OrderedField T, std::size_t M, OrderedField K>
std::vector<K> GerbsCurve<T, M, K>::breaks() const {
  std::vector<K> out = knots_.breaks();
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    const auto [begin, end] = detail::used_on(knots_, static_cast<int>(i));
    for (const K& t : locals_[i].breaks_between(begin, end)) out.push_back(t);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

template <Field R, OrderedField T, std::size_t M, OrderedField K>
std::vector<Vec<R, M - 1>> derivatives_at(const GerbsCurve<T, M, K>& curve, const K& inside, Side side, const R& t,
                                          int order) {
  const int i = curve.knots().find_span(inside, side);
  const auto &before = curve.locals()[i - 1], &after = curve.locals()[i];
  std::vector<Vec<R, M - 1>> out = derivatives_at<R>(before, inside, side, t, order);
  if (before == after) return out;
  std::vector<Vec<R, M - 1>> difference = derivatives_at<R>(after, inside, side, t, order);
  for (int r = 0; r <= order; ++r) difference[r] = difference[r] - out[r];
  const std::vector<R> b =
      detail::blend_derivatives(curve.b_function(), curve.knots()[i], curve.knots()[i + 1], t, order);
  for (int r = 0; r <= order; ++r) {
    const std::vector<R> choose = binomial_row<R>(r);
    for (int j = 0; j <= r; ++j) out[r] += (choose[j] * b[j]) * difference[r - j];
  }
  return out;
}

}  // namespace patchproof
