// SPDX-License-Identifier: Apache-2.0
// Knot vectors: a degree p and knots t_0 ≤ t_1 ≤ … ≤ t_m, for n = m − p control points. The domain is [t_p, t_n].
//
// Any multiplicity is legal here, inside and at the ends, up to and beyond p + 1 (then some control points have no
// influence); knots may be unclamped, and the domain need not begin at 0. Knots are compared exactly: nothing is merged.
// Both ends belong to the domain. At a knot a spline has a value from either side; the side is an argument.
// NEIGHBOURS bspline_basis.h (the functions on these knots), curve.h, knot_insertion.h.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"

namespace patchproof {

// Which limit is meant at a knot. The first knot of the domain has only a right side, the last only a left one; there the
// other side is answered with the existing one.
enum class Side { left, right };

template <OrderedField K>
class KnotVector {
 public:
  // ERRORS   bad_degree: degree < 0.  wrong_count: fewer than 2(p + 1) knots.  decreasing_knots: names the first pair.
  //          empty_domain: t_p = t_n.
  static Result<KnotVector> make(int degree, std::vector<K> knots);
  // p + 1 times `begin`, p + 1 times `end`. REQUIRES begin < end.
  static KnotVector bezier(int degree, const K& begin = K(0), const K& end = K(1)) {
    PATCHPROOF_REQUIRES(degree >= 0 && begin < end, "KnotVector::bezier: degree >= 0 and begin < end");
    std::vector<K> knots(degree + 1, begin);
    knots.resize(2 * degree + 2, end);
    return KnotVector(degree, std::move(knots));
  }
  // REQUIRES what make() checks.
  static KnotVector make_unchecked(int degree, std::vector<K> knots) { return KnotVector(degree, std::move(knots)); }

  int degree() const { return degree_; }
  const std::vector<K>& knots() const { return knots_; }
  const K& operator[](int i) const { return knots_[i]; }
  // n, the number of control points.
  int control_count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  const K& domain_begin() const { return knots_[degree_]; }
  const K& domain_end() const { return knots_[control_count()]; }
  bool in_domain(const K& t) const { return domain_begin() <= t && t <= domain_end(); }

  // How often t stands in the knots (0 when it is none).
  int multiplicity(const K& t) const {
    const auto range = std::equal_range(knots_.begin(), knots_.end(), t);
    return static_cast<int>(range.second - range.first);
  }
  // The distinct knots of the domain, in order, ends included: the breaks between polynomial pieces.
  std::vector<K> breaks() const {
    std::vector<K> out(knots_.begin() + degree_, knots_.begin() + control_count() + 1);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  // The index i with p ≤ i < n, t_i < t_{i+1}, and t in [t_i, t_{i+1}] such that the piece of that span is the limit of the
  // spline at t from `side`. REQUIRES t in the domain. COST O(log m).
  int find_span(const K& t, Side side = Side::right) const;
  // Only the ends of the domain are knots at the ends, each at least p + 1 times.
  bool is_clamped() const {
    return multiplicity(domain_begin()) >= degree_ + 1 && multiplicity(domain_end()) >= degree_ + 1 &&
           knots_.front() == domain_begin() && knots_.back() == domain_end();
  }

  friend bool operator==(const KnotVector& a, const KnotVector& b) {
    return a.degree_ == b.degree_ && a.knots_ == b.knots_;
  }

 private:
  KnotVector(int degree, std::vector<K> knots) : degree_(degree), knots_(std::move(knots)) {}

  int degree_;
  std::vector<K> knots_;
};

// ---------------------------------------------------------------------------------------------------------------------

template <OrderedField K>
Result<KnotVector<K>> KnotVector<K>::make(int degree, std::vector<K> knots) {
  if (degree < 0) return Error{ErrorCode::bad_degree, "", "the degree is negative", std::to_string(degree)};
  if (knots.size() < 2 * (static_cast<std::size_t>(degree) + 1))
    return Error{ErrorCode::wrong_count, "",
                 "degree " + std::to_string(degree) + " needs at least " + std::to_string(2 * degree + 2) + " knots",
                 std::to_string(knots.size())};
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (knots[i] < knots[i - 1])
      return Error{ErrorCode::decreasing_knots, "",
                   "knot " + std::to_string(i) + " is smaller than knot " + std::to_string(i - 1), ""};
  KnotVector out(degree, std::move(knots));
  if (out.domain_begin() == out.domain_end())
    return Error{ErrorCode::empty_domain, "",
                 "the domain, from knot " + std::to_string(degree) + " to knot " + std::to_string(out.control_count()) +
                     ", is empty",
                 ""};
  return out;
}

template <OrderedField K>
int KnotVector<K>::find_span(const K& t, Side side) const {
  PATCHPROOF_REQUIRES(in_domain(t), "find_span: the parameter lies outside the domain");
  const auto first = knots_.begin() + degree_, last = knots_.begin() + control_count() + 1;
  // From the right: the last knot ≤ t; from the left: the last knot < t.
  auto it = side == Side::right ? std::upper_bound(first, last, t) : std::lower_bound(first, last, t);
  if (it == last) it = std::lower_bound(first, last, domain_end());     // t at the end: the last non-empty span
  if (it == first) it = std::upper_bound(first, last, domain_begin());  // t at the begin: the first non-empty span
  return static_cast<int>(it - knots_.begin()) - 1;
}

}  // namespace patchproof
