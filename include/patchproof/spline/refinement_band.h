// SPDX-License-Identifier: Apache-2.0
// Refinement as a matrix: each control point on finer knots is a convex combination of at most p + 1 old ones.
//
//   d'_i = Σ_k a_ik d_{f_i + k},  0 ≤ k ≤ p:  the blossom of one piece at the new knots (s_{i+1}, …, s_{i+p}).
//   On the span [t_m, t_{m+1}], f_i = m − p, begin with b_0 = 1; step r = 1, …, p takes one argument x and replaces
//     b_q by  (h_q − x)/(h_q − l_q) b_q + (x − l_{q−1})/(h_{q−1} − l_{q−1}) b_{q−1}
//   where l_q = t_{m−r+1+q}, h_q = t_{m+1+q}, and b_{−1} = b_r = 0 on the right. After p steps a_ik = b_k.
//
// ORDER  A blossom may take its arguments in any order; one order never extrapolates. Begin at a span [s_a, s_{a+1}] of
//   the new knots in [t_m, t_{m+1}] and take the neighbours s_{a+1}, … on the right, s_a, … on the left, so that after
//   r steps the arguments are s_{l+1}, …, s_{l+r}. Let e(j) be the place of t_j among the new knots. Then b_q ≠ 0
//   implies e(j) ≤ l and l + r + 1 ≤ e(j + r + 1) for j = m − r + q. It does for r = 0. Step to the right, x =
//   s_{l+r+1}: the term of (x − l) keeps j, and e(j + r + 2) > e(j + r + 1); the term of (h − x) leads to j − 1 and is
//   zero unless x < t_{j+r+1}, which stands behind x. Steps to the left likewise. Hence l_q ≤ x ≤ h_q wherever b_q ≠ 0:
//   all factors are in [0, 1], and what is zero is computed as zero. Elsewhere x is moved to the nearer end: 0 times
//   anything.
//
// ROUNDING  On doubles with unit roundoff u = 2^-53 a step costs each term at most 5 roundings of factors or sums of
//   one sign: two differences, a quotient, a product, a sum. So â_ik = a_ik (1 + θ) + ε, |θ| ≤ γ_{5p} = 5pu/(1 − 5pu),
//   where Σ_k |ε| ≤ (p + 1)(p + 2)/2 · 2^-1074 stems from underflow: in step r quotients and products add at most
//   2^-1075 to each factor and each term, Σ_q b_q ≤ 1 + γ, and the factors of one b_q sum to 1, so nothing is
//   magnified.
//
// REQUIRES  the same degree and domain; every old knot stands in the new ones at least as often; knots outside the
//           domain are the same. h − l does not overflow. Any multiplicity is legal, and knots may be unclamped.
// ENSURES   (1) over an exact scalar apply_band(refinement_band(t, s), d) are the points of refine(curve, s), those
//           without influence included;  (2) apply_band(bezier_band(t), d) are the points of extract_bezier(curve),
//           piece by piece;
//           (3) coefficients are ≥ 0 and sum to 1: exactly over exact scalars, on doubles up to γ_{5p} and ε;
//           (4) first does not decrease;  (5) coefficients of Tracked are those of double with an error bound, which
//           the bound above covers;  (6) neighbouring pieces of extract_bezier that meet (an inner knot of multiplicity
//           at most p) share the very same numbers there, on doubles too.
// SCALARS   T: Ring (Field when the knots are not exact), K: OrderedField.
// COST      p (p + 1) quotients a row at most.
// SOURCE    E. Cohen, T. Lyche, R. Riesenfeld, Discrete B-splines and subdivision techniques, CGIP 14 (1980) 87–111;
//           the blossom: L. Ramshaw, Blossoms are polar forms, CAGD 6 (1989) 323–358. The order of arguments is ours.
// NEIGHBOURS knot_insertion.h, bezier_extraction.h (one knot at a time, the oracle of the tests), patch/refine_batch.h.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include "patchproof/spline/knot_ratio.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof {

template <Ring T>
struct RefinementBand {
  int degree = 0, old_count = 0;
  std::vector<int> first;       // of each row: the old point that its first coefficient belongs to
  std::vector<T> coefficients;  // degree + 1 of each row

  int rows() const { return static_cast<int>(first.size()); }
  const T* row(int i) const { return coefficients.data() + static_cast<std::size_t>(i) * (degree + 1); }
};

// Every knot of `old` stands in `finer`, and the others of `finer` are inside the domain; the same degree and domain.
template <OrderedField K>
bool is_refinement(const KnotVector<K>& old, const KnotVector<K>& finer);

// From control points on `old` to those on `finer`. REQUIRES is_refinement(old, finer).
template <Ring T, OrderedField K>
RefinementBand<T> refinement_band(const KnotVector<K>& old, const KnotVector<K>& finer);

// From control points to the Bézier points of the pieces, p + 1 rows for each non-empty span of the domain, in order.
template <Ring T, OrderedField K>
RefinementBand<T> bezier_band(const KnotVector<K>& knots);

// d' of the formula. P: T or a vector of T. REQUIRES old_count points.
template <Ring T, class P>
std::vector<P> apply_band(const RefinementBand<T>& band, const std::vector<P>& points);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Step r of the blossom on the span that begins at *knot: r numbers b become r + 1. r: int, or a constant.
template <Ring T, OrderedField K, class R>
inline void blossom_step(const K* knot, R r, const K& argument, T* b) {
  T carried(0);
  for (int q = 0; q < r; ++q) {
    const K &low = knot[q + 1 - r], &high = knot[q + 1];
    if (!(argument < high)) {  // also where b_q is 0; factors 0 and 1 need no arithmetic
      const T all = b[q];
      b[q] = carried;
      carried = all;
    } else if (!(low < argument)) {
      b[q] = q == 0 ? b[q] : carried + b[q];
      carried = T(0);
    } else {
      const T rest = knot_ratio<T>(argument, high, low) * b[q], moved = knot_ratio<T>(argument, low, high) * b[q];
      b[q] = q == 0 ? rest : carried + rest;
      carried = moved;
    }
  }
  b[r] = carried;
}

// The blossom at argument(1), …, argument(p) to `row`. P: the degree when known to the compiler, or 0.
template <int P, Ring T, OrderedField K, class Argument>
inline void blossom_row(const K* knot, int p, Argument argument, T* row) {
  if constexpr (P > 0) {
    std::array<T, P + 1> b;
    b[0] = T(1);
    [&]<int... R>(std::integer_sequence<int, R...>) {
      (blossom_step(knot, std::integral_constant<int, R + 1>(), argument(R + 1), b.data()), ...);
    }
    (std::make_integer_sequence<int, P>());
    std::move(b.begin(), b.end(), row);
  } else {
    row[0] = T(1);
    for (int r = 1; r <= p; ++r) blossom_step(knot, r, argument(r), row);
  }
}

template <Ring T, OrderedField K>
struct BandBuilder {
  const KnotVector<K>& old;
  RefinementBand<T> band;

  BandBuilder(const KnotVector<K>& knots, std::size_t rows) : old(knots) {
    band.degree = old.degree();
    band.old_count = old.control_count();
    band.first.reserve(rows);
    band.coefficients.resize(rows * (old.degree() + 1), T(0));
  }
  T* next_row() { return band.coefficients.data() + band.first.size() * (band.degree + 1); }
  // A row that copies an old point.
  void copy(int j) {
    const int first = std::max(band.first.empty() ? 0 : band.first.back(), j - band.degree);
    next_row()[j - first] = T(1);
    band.first.push_back(first);
  }
  // The blossom on span m at argument(1), …, argument(p).
  template <int P = 0, class Argument>
  void blossom(int m, Argument argument) {
    blossom_row<P>(old.knots().data() + m, band.degree, argument, next_row());
    band.first.push_back(m - band.degree);
  }

  // Row i whose new knots hold no span of the domain: the same numbers as inserting one knot after the other.
  void row_without_influence(const KnotVector<K>& finer, int i) {
    const int p = band.degree, added = finer.control_count() - old.control_count();
    const auto first_of = [](const KnotVector<K>& knots, const K& t) {
      return static_cast<int>(std::lower_bound(knots.knots().begin(), knots.knots().end(), t) - knots.knots().begin());
    };
    const K &low = finer[i], &high = finer[i + p + 1];
    const bool right = !(low < old.domain_end());
    const K& t = right ? old.domain_end() : high;  // where the row's knots touch the domain
    const int copies = old.multiplicity(t);
    if (low == high) {  // points that had no influence before keep their places, seen from the outside of the limit
      const int place = i - first_of(finer, t) - (right ? finer.multiplicity(t) - copies : 0);
      if (place >= 0 && place < copies - p - 1) return copy(first_of(old, t) + place);
    } else if (right) {
      if (first_of(finer, t) + finer.multiplicity(t) - i <= copies) return copy(i - added);
    } else if (i + p + 2 - first_of(finer, t) <= copies) {
      return copy(i);
    }
    // The limit from inside the domain: copies of t first, then the knots outside, from the inner to the outer.
    if (right)
      blossom(old.find_span(t, Side::left), [&](int r) -> const K& { return finer[i + r]; });
    else
      blossom(old.find_span(t, Side::right), [&](int r) -> const K& { return finer[i + p + 1 - r]; });
  }
};

// build.operator()<P>() for the degree p, P = 0 when no loop is unrolled for it.
template <class Build>
auto for_degree(int p, Build build) {
  switch (p) {
    case 1: return build.template operator()<1>();
    case 2: return build.template operator()<2>();
    case 3: return build.template operator()<3>();
    case 4: return build.template operator()<4>();
    case 5: return build.template operator()<5>();
    default: return build.template operator()<0>();
  }
}

}  // namespace detail

template <OrderedField K>
bool is_refinement(const KnotVector<K>& old, const KnotVector<K>& finer) {
  if (old.degree() != finer.degree() || old.domain_begin() != finer.domain_begin() ||
      old.domain_end() != finer.domain_end())
    return false;
  auto next = old.knots().begin();
  for (const K& t : finer.knots())
    if (next != old.knots().end() && *next == t)
      ++next;
    else if (!old.in_domain(t))
      return false;
  return next == old.knots().end();
}

template <Ring T, OrderedField K>
RefinementBand<T> refinement_band(const KnotVector<K>& old, const KnotVector<K>& finer) {
  PATCHPROOF_REQUIRES(is_refinement(old, finer), "refinement_band: the new knots do not refine the old ones");
  return detail::for_degree(old.degree(), [&]<int P>() {
    const int p = old.degree(), rows = finer.control_count();
    const K *s = finer.knots().data(), *t = old.knots().data();
    detail::BandBuilder<T, K> builder(old, rows);
    int a = 0, m = p;
    for (int i = 0; i < rows; ++i) {
      // [s_a, s_{a+1}]: the first span of the domain among the knots of the row.
      a = std::max(a, i);
      while (a <= i + p && !(s[a] < s[a + 1] && old.domain_begin() <= s[a] && s[a + 1] <= old.domain_end())) ++a;
      if (a > i + p) {
        builder.row_without_influence(finer, i);
        continue;
      }
      while (!(s[a] < t[m + 1])) ++m;
      // Outwards: s_{a+1}, …, s_{i+p}, then s_a, …, s_{i+1}.
      const int right = i + p - a;
      builder.template blossom<P>(m, [&](int r) -> const K& { return s[r <= right ? a + r : i + p + 1 - r]; });
    }
    return std::move(builder.band);
  });
}

template <Ring T, OrderedField K>
RefinementBand<T> bezier_band(const KnotVector<K>& knots) {
  return detail::for_degree(knots.degree(), [&]<int P>() {
    const int p = knots.degree();
    int pieces = 0;
    for (int m = p; m < knots.control_count(); ++m) pieces += knots[m] < knots[m + 1] ? 1 : 0;
    detail::BandBuilder<T, K> builder(knots, static_cast<std::size_t>(pieces) * (p + 1));
    for (int m = p; m < knots.control_count(); ++m)
      for (int j = 0; j <= p && knots[m] < knots[m + 1]; ++j)
        builder.template blossom<P>(m, [&](int r) -> const K& { return r <= j ? knots[m + 1] : knots[m]; });
    return std::move(builder.band);
  });
}

template <Ring T, class P>
std::vector<P> apply_band(const RefinementBand<T>& band, const std::vector<P>& points) {
  PATCHPROOF_REQUIRES(static_cast<int>(points.size()) == band.old_count,
                      "apply_band: the band is for another point count");
  std::vector<P> out;
  out.reserve(band.rows());
  for (int i = 0; i < band.rows(); ++i) {
    const T* a = band.row(i);
    P sum = a[0] * points[band.first[i]];
    for (int k = 1; k <= band.degree; ++k) sum += a[k] * points[band.first[i] + k];
    out.push_back(std::move(sum));
  }
  return out;
}

}  // namespace patchproof
