// SPDX-License-Identifier: Apache-2.0
// The exact classes of a join on one piece: C0, C1 (and the ratio), C2, and what is needed for G1.
//
// With the forms of join_polynomials.h, s the parameter distance into each patch:
//     C0   N = 0                                       the same curve under the join's pairing
//     C1   C0 and Q = −P                               y_s = −x_s: equal cross-boundary derivatives as parametrised
//     ratio λ > 0  with  Q = −λ P                      C1 after scaling one patch's cross parameter by λ
//     C2   C1 and the second difference vanishes       y_ss = x_ss (x_st, x_tt follow from C1, C0)
//     G1   C0, and wherever t runs both sides have a normal, on one line, on opposite sides of the edge
// Normals are polynomial vectors; where they vanish, their exact common factor is divided out and the limit normal is used:
// n = t^k s^l F(t) n̂(t) with n̂ free of zeros on [0, 1]. If F changes sign, so does the surface's side there.
//
// ENSURES  (1) each answer is the statement above, decided in exact arithmetic;  (2) reduce_normal: n̂ has no zero on
//          [0, 1] when `zero_free`;  (3) answers do not depend on a positive factor in the rows of either side.
// SCALARS  R: ExactRing (Integer on cleared rows, Quadratic).
// SOURCE   the joins' homogeneous determinant: docs/mathematics.md, "Tangent planes".
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "patchproof/join/join_polynomials.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/spline/real_roots.h"

namespace patchproof {

template <ExactRing R>
bool vanishes(const BinaryForm<R>& f) {
  return *is_zero(f);
}
template <ExactRing R>
bool vanishes(const FormVector<R>& f) {
  return vanishes(f[0]) && vanishes(f[1]) && vanishes(f[2]);
}

template <ExactRing R>
bool is_c0(const JoinForms<R>& forms) {
  return vanishes(point_difference(forms.a, forms.b));
}

// How the cross-boundary derivatives compare. REQUIRES is_c0(forms).
template <ExactRing R>
struct CrossMatch {
  bool equal = false;                         // Q = −P
  bool determined = false;                    // some derivative is not zero, so a ratio is determined if there is one
  std::optional<std::pair<R, R>> ratio = {};  // λ = first / second, when Q = −λ P for one constant λ
};
template <ExactRing R>
CrossMatch<R> match_cross_derivatives(const JoinForms<R>& forms);

// REQUIRES is_c0(forms) and equal cross derivatives.
template <ExactRing R>
bool is_c2(const JoinForms<R>& forms) {
  return vanishes(second_difference(forms.a, forms.b));
}

// n = t^at_zero s^at_one F n̂.
template <ExactRing R>
struct ReducedNormal {
  FormVector<R> n;                                       // n̂; all empty when no normal was found up to second order
  BinaryForm<R> factor = BinaryForm<R>::constant(R(1));  // F
  EndOrders ends;
  NormalOrder order = NormalOrder::first;
  bool zero_free = false;

  bool found() const { return !vanishes(n); }
  bool has_factor() const { return factor.degree() > 0; }
};
// COST one interval test in the ordinary case; exact greatest common divisors when that cannot exclude zeros.
// REQUIRES a RoundingGuard alive.
template <ExactRing R>
ReducedNormal<R> reduce_normal(const SideForms<R>& side);

// Are both normals on one line for every t? REQUIRES is_c0(forms), both normals found.
template <ExactRing R>
bool is_coplanar(const JoinForms<R>& forms, const ReducedNormal<R>& a, const ReducedNormal<R>& b);

// The numbers in which values of forms over R are computed.
template <ExactRing R>
struct value_field {
  using type = R;
};
template <>
struct value_field<Integer> {
  using type = Rational;
};
template <ExactRing R>
using value_field_t = typename value_field<R>::type;

// The same polynomial over the field.
template <ExactRing R>
BinaryForm<value_field_t<R>> over_field(const BinaryForm<R>& f) {
  std::vector<value_field_t<R>> a;
  for (const R& c : f.coefficients()) a.push_back(embed<value_field_t<R>>(c));
  return BinaryForm<value_field_t<R>>(std::move(a));
}

// ---------------------------------------------------------------------------------------------------------------------

template <ExactRing R>
CrossMatch<R> match_cross_derivatives(const JoinForms<R>& forms) {
  const FormVector<R> p = cross_term(forms.a, forms.b), q = cross_term(forms.b, forms.a);
  CrossMatch<R> match;
  match.equal = vanishes(p + q);
  match.determined = !vanishes(p) || !vanishes(q);
  if (vanishes(p) || vanishes(q)) return match;
  // λ = −Q/P at the first coefficient where P is not zero; then Q_j P_0 = Q_0 P_j everywhere.
  R p0(0), q0(0);
  for (int c = 0; c < 3 && *scalar_traits<R>::sign(p0) == Sign::zero; ++c) {
    if (vanishes(p[c])) continue;
    const BinaryForm<R> pc = p[c].elevated(std::max(0, q[c].degree() - p[c].degree()));
    const BinaryForm<R> qc = q[c].elevated(std::max(0, p[c].degree() - q[c].degree()));
    int i = 0;
    while (*scalar_traits<R>::sign(pc[i]) == Sign::zero) ++i;
    p0 = pc[i];
    if (!qc.is_empty()) q0 = qc[i];
  }
  const FormVector<R> rest = BinaryForm<R>::constant(p0) * q - BinaryForm<R>::constant(q0) * p;
  if (vanishes(rest)) match.ratio = {-q0, p0};
  return match;
}

namespace detail {

// True when the enclosed vector polynomial certainly has no zero on [0, 1]: on every part of a subdivision all
// coefficients have a positive product with one direction.
bool certainly_zero_free(const std::vector<std::array<Interval, 3>>& bernstein);

template <ExactRing R>
std::vector<std::array<Interval, 3>> enclose_vector(const FormVector<R>& f) {
  const int degree = std::max({f[0].degree(), f[1].degree(), f[2].degree()});
  const std::vector<Interval> binomial = binomials<Interval>(degree);
  std::vector<std::array<Interval, 3>> out(degree + 1);
  std::array<std::vector<ScaledInterval>, 3> scaled;
  long exponent = std::numeric_limits<long>::min();
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < (f[c].is_empty() ? 0 : degree + 1); ++i) {
      scaled[c].push_back(enclose_scaled(f[c][i]));
      if (*scalar_traits<R>::sign(f[c][i]) != Sign::zero) exponent = std::max(exponent, scaled[c][i].exponent);
    }
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < scaled[c].size(); ++i)
      out[i][c] = scale_by_power_of_two(scaled[c][i].mantissa, scaled[c][i].exponent - exponent) / binomial[i];
  return out;
}

// All non-empty components written with one degree.
template <ExactRing R>
void level_degrees(FormVector<R>& f) {
  const int degree = std::max({f[0].degree(), f[1].degree(), f[2].degree()});
  for (BinaryForm<R>& c : f)
    if (!c.is_empty()) c = c.elevated(degree - c.degree());
}

// From the field back to the ring, times one positive constant.
template <ExactRing R>
FormVector<R> to_ring(const FormVector<value_field_t<R>>& f) {
  if constexpr (std::is_same_v<R, value_field_t<R>>) {
    return f;
  } else {
    Integer denominator(1);
    for (const auto& component : f)
      for (const Rational& x : component.coefficients())
        mpz_lcm(denominator.backend().data(), denominator.backend().data(), mpq_denref(x.backend().data()));
    FormVector<R> out;
    for (int c = 0; c < 3; ++c) {
      std::vector<R> a;
      for (const Rational& x : f[c].coefficients())
        a.push_back(numerator(x) * (denominator / boost::multiprecision::denominator(x)));
      out[c] = BinaryForm<R>(std::move(a));
    }
    return out;
  }
}

}  // namespace detail

template <ExactRing R>
ReducedNormal<R> reduce_normal(const SideForms<R>& side) {
  ReducedNormal<R> reduced;
  FormVector<R> n = normal(side);
  if (vanishes(n)) {
    reduced.order = NormalOrder::second;
    n = normal(side, NormalOrder::second);
    if (vanishes(n)) return reduced;
  }
  for (BinaryForm<R>& c : n)
    if (vanishes(c)) c = BinaryForm<R>();
  detail::level_degrees(n);
  reduced.ends = {1 << 20, 1 << 20};
  for (const BinaryForm<R>& c : n) {
    if (c.is_empty()) continue;
    const EndOrders orders = end_orders(c);
    reduced.ends.at_zero = std::min(reduced.ends.at_zero, orders.at_zero);
    reduced.ends.at_one = std::min(reduced.ends.at_one, orders.at_one);
  }
  for (BinaryForm<R>& c : n) c = strip_ends(c, reduced.ends);
  reduced.zero_free = detail::certainly_zero_free(detail::enclose_vector(n));
  if (!reduced.zero_free) {
    using F = value_field_t<R>;
    const FormVector<F> f{over_field(n[0]), over_field(n[1]), over_field(n[2])};
    const BinaryForm<F> common = gcd(gcd(f[0], f[1]), f[2]);
    if (common.degree() > 0) {
      n = detail::to_ring<R>(
          {divide_exactly(f[0], common), divide_exactly(f[1], common), divide_exactly(f[2], common)});
      reduced.factor = detail::to_ring<R>({common, BinaryForm<F>(), BinaryForm<F>()})[0];
    }
    reduced.zero_free = true;  // components without a common factor have no common root
  }
  reduced.n = std::move(n);
  return reduced;
}

template <ExactRing R>
bool is_coplanar(const JoinForms<R>& forms, const ReducedNormal<R>& a, const ReducedNormal<R>& b) {
  if (a.order == NormalOrder::first && b.order == NormalOrder::first) return vanishes(coplanarity(forms.a, forms.b));
  return vanishes(cross(a.n, b.n));
}

}  // namespace patchproof
