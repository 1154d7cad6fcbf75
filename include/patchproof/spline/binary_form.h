// SPDX-License-Identifier: Apache-2.0
// Polynomials on [0, 1] as binary forms: f = Σ a_i t^i s^(n−i) with s = 1 − t.
//
// These are Bernstein polynomials whose coefficients carry the binomials, a_i = C(n,i)·b_i. Then products are plain
// convolutions and derivatives and degree elevation need no division, so a join polynomial can be formed in any Ring:
// Integer and Quadratic for proofs, Interval for filters. With x = t/s the a_i are also the monomial coefficients of a
// polynomial in x, which is how roots in (0,1) become positive roots and how common factors are divided out.
//
// ENSURES  (1) from_bernstein(b) equals Σ b_i B_i^n;  (2) + − × and derivative() equal the operations on polynomials;
//          (3) elevated(k) is the same polynomial;  (4) the empty form is the zero polynomial, of any degree;
//          (5) strip_ends divides by t^k s^l exactly;  (6) gcd divides every input, and inputs divided by it have gcd 1.
// SCALARS  R: Ring; gcd and divisions: ExactField.
// COST     product of degrees m and n: (m+1)(n+1) multiplications. In exact rings products, gcd and divisions throw
//          deadline_passed where a limit of deadline.h passes.
// SOURCE   R. Farouki, V. Rajan, Algorithms for polynomials in Bernstein form, CAGD 5 (1988) 1–26 (scaled basis).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/deadline.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/bernstein.h"

namespace patchproof {

template <Ring R>
class BinaryForm {
 public:
  BinaryForm() = default;  // zero
  explicit BinaryForm(std::vector<R> coefficients) : a_(std::move(coefficients)) {}
  static BinaryForm from_bernstein(std::vector<R> b);
  static BinaryForm constant(R value) { return BinaryForm(std::vector<R>{std::move(value)}); }

  bool is_empty() const { return a_.empty(); }
  int degree() const { return static_cast<int>(a_.size()) - 1; }  // −1 for the empty form
  const std::vector<R>& coefficients() const& { return a_; }
  std::vector<R> coefficients() && { return std::move(a_); }  // a reference into a temporary form would dangle
  const R& operator[](int i) const { return a_[i]; }

  // The same polynomial written with degree + k (multiplied by (s + t)^k).
  BinaryForm elevated(int k) const;
  BinaryForm derivative() const;  // d/dt
  // Σ a_i t^i s^(n−i). U: R itself or a scalar that R embeds into.
  template <Ring U>
  U operator()(const U& t) const;

  friend BinaryForm operator*(const BinaryForm& f, const BinaryForm& g) {
    if (f.is_empty() || g.is_empty()) return {};
    constexpr std::size_t kShort = 8;  // products of such forms are no longer than a look at the clock
    std::vector<R> r(f.a_.size() + g.a_.size() - 1);
    for (std::size_t i = 0; i < f.a_.size(); ++i) {
      if constexpr (ExactRing<R>)
        if (i == 0 || g.a_.size() > kShort) check_deadline();
      for (std::size_t j = 0; j < g.a_.size(); ++j) r[i + j] += f.a_[i] * g.a_[j];
    }
    return BinaryForm(std::move(r));
  }
  friend BinaryForm operator+(const BinaryForm& f, const BinaryForm& g) {
    if (f.is_empty()) return g;
    if (g.is_empty()) return f;
    if (f.degree() < g.degree()) return f.elevated(g.degree() - f.degree()) + g;
    if (g.degree() < f.degree()) return f + g.elevated(f.degree() - g.degree());
    BinaryForm r = f;
    for (std::size_t i = 0; i < r.a_.size(); ++i) r.a_[i] += g.a_[i];
    return r;
  }
  friend BinaryForm operator-(const BinaryForm& f) {
    BinaryForm r = f;
    for (R& a : r.a_) a = -a;
    return r;
  }
  friend BinaryForm operator-(const BinaryForm& f, const BinaryForm& g) { return f + (-g); }

 private:
  std::vector<R> a_;
};

// C(n,0), …, C(n,n) in R, for every n: from int where that is exact, else by Pascal's additions.
template <Ring R>
std::vector<R> binomials(int n) {
  constexpr int kLargestInInt = 30;
  if (n > kLargestInInt) return binomial_row<R>(n);
  std::vector<R> row;
  row.reserve(n + 1);
  long long c = 1;
  for (int k = 0; k <= n; ++k) {
    row.push_back(R(static_cast<int>(c)));
    c = c * (n - k) / (k + 1);
  }
  return row;
}

// Is the polynomial zero? Empty: this scalar cannot tell.
template <Ring R>
std::optional<bool> is_zero(const BinaryForm<R>& f) {
  bool certain = true;
  for (const R& a : f.coefficients()) {
    const std::optional<Sign> sign = scalar_traits<R>::sign(a);
    if (sign && *sign != Sign::zero) return false;
    certain = certain && sign.has_value();
  }
  return certain ? std::optional<bool>(true) : std::nullopt;
}

// Number of vanishing coefficients at the start (the power of t that divides f) and at the end (the power of s).
struct EndOrders {
  int at_zero = 0, at_one = 0;
};
// REQUIRES f is not the zero polynomial.
template <ExactRing R>
EndOrders end_orders(const BinaryForm<R>& f) {
  const auto zero = [](const R& a) { return *scalar_traits<R>::sign(a) == Sign::zero; };
  const std::vector<R>& a = f.coefficients();
  const int n = f.degree();
  EndOrders orders;
  while (orders.at_zero <= n && zero(a[orders.at_zero])) ++orders.at_zero;
  PATCHPROOF_REQUIRES(orders.at_zero <= n, "end_orders: the zero polynomial vanishes to every order");
  while (zero(a[n - orders.at_one])) ++orders.at_one;
  return orders;
}

// f / (t^k s^l). REQUIRES that this is a polynomial.
template <Ring R>
BinaryForm<R> strip_ends(const BinaryForm<R>& f, const EndOrders& orders) {
  if (f.is_empty()) return f;
  const std::vector<R>& a = f.coefficients();
  return BinaryForm<R>(std::vector<R>(a.begin() + orders.at_zero, a.end() - orders.at_one));
}

// Greatest common divisor up to a constant factor; the empty form when both are zero.
template <ExactField R>
BinaryForm<R> gcd(const BinaryForm<R>& f, const BinaryForm<R>& g);

// f / g. REQUIRES g divides f, g not zero.
template <ExactField R>
BinaryForm<R> divide_exactly(const BinaryForm<R>& f, const BinaryForm<R>& g);

// ---------------------------------------------------------------------------------------------------------------------

template <Ring R>
BinaryForm<R> BinaryForm<R>::from_bernstein(std::vector<R> b) {
  const int n = static_cast<int>(b.size()) - 1;
  if (n < 2) return BinaryForm(std::move(b));
  const std::vector<R> c = binomials<R>(n);
  for (int i = 1; i < n; ++i) b[i] = c[i] * b[i];
  return BinaryForm(std::move(b));
}

template <Ring R>
BinaryForm<R> BinaryForm<R>::elevated(int k) const {
  BinaryForm r = *this;
  if (r.is_empty()) return r;
  for (; k > 0; --k) {
    r.a_.push_back(R(0));
    for (std::size_t i = r.a_.size() - 1; i > 0; --i) r.a_[i] += r.a_[i - 1];
  }
  return r;
}

template <Ring R>
BinaryForm<R> BinaryForm<R>::derivative() const {
  const int n = degree();
  if (n <= 0) return {};
  std::vector<R> d;
  d.reserve(n);
  for (int i = 0; i < n; ++i) d.push_back(R(i + 1) * a_[i + 1] - R(n - i) * a_[i]);
  return BinaryForm(std::move(d));
}

template <Ring R>
template <Ring U>
U BinaryForm<R>::operator()(const U& t) const {
  if (is_empty()) return U(0);
  // Horner's rule in t, carrying the power of s along.
  const U s = U(1) - t;
  U value = embed<U>(a_.back()), power = s;
  for (int i = degree() - 1; i >= 0; --i) {
    value = value * t + embed<U>(a_[i]) * power;
    power = power * s;
  }
  return value;
}

namespace detail {

// Polynomials in x = t/s, lowest coefficient first, without zero leading coefficients.
template <ExactField R>
void trim(std::vector<R>& p) {
  while (!p.empty() && *scalar_traits<R>::sign(p.back()) == Sign::zero) p.pop_back();
}

// p mod q, with the quotient. REQUIRES q trimmed and not empty.
template <ExactField R>
std::vector<R> divide(std::vector<R>& p, const std::vector<R>& q) {
  std::vector<R> quotient(p.size() >= q.size() ? p.size() - q.size() + 1 : 0);
  while (p.size() >= q.size()) {
    const std::size_t shift = p.size() - q.size();
    const R factor = p.back() / q.back();
    quotient[shift] = factor;
    check_deadline();
    for (std::size_t i = 0; i + 1 < q.size(); ++i) p[shift + i] = p[shift + i] - factor * q[i];
    p.pop_back();
    trim(p);
  }
  return quotient;
}

// Euclid's algorithm to its end. Monic remainders keep the numbers of a field small.
template <ExactField R>
std::vector<R> last_remainder(std::vector<R> p, std::vector<R> q) {
  while (!q.empty()) {
    const R lead = q.back();
    check_deadline();
    for (R& c : q) c = c / lead;
    divide(p, q);
    std::swap(p, q);
  }
  return p;
}

// Divides by the content. REQUIRES not empty.
inline void make_primitive(std::vector<Integer>& p) {
  Integer content(0);
  for (const Integer& c : p) {
    check_deadline();
    mpz_gcd(content.backend().data(), content.backend().data(), c.backend().data());
  }
  for (Integer& c : p) mpz_divexact(c.backend().data(), c.backend().data(), content.backend().data());
}

// Over Q the same on primitive integer polynomials, by pseudo-division: fractions would be reduced at every step.
inline std::vector<Rational> last_remainder(std::vector<Rational> p, std::vector<Rational> q) {
  const auto cleared = [](const std::vector<Rational>& f) {
    Integer common(1);
    for (const Rational& c : f)
      mpz_lcm(common.backend().data(), common.backend().data(), mpq_denref(c.backend().data()));
    std::vector<Integer> out;
    for (const Rational& c : f) out.push_back(numerator(c) * Integer(common / denominator(c)));
    if (!out.empty()) make_primitive(out);
    return out;
  };
  std::vector<Integer> a = cleared(p), b = cleared(q);
  while (!b.empty()) {
    while (a.size() >= b.size()) {
      const std::size_t shift = a.size() - b.size();
      const Integer top = a.back(), lead = b.back();
      for (std::size_t i = 0; i + 1 < a.size(); ++i) a[i] = i < shift ? lead * a[i] : lead * a[i] - top * b[i - shift];
      a.pop_back();
      while (!a.empty() && a.back() == 0) a.pop_back();
      if (!a.empty()) make_primitive(a);
    }
    std::swap(a, b);
  }
  std::vector<Rational> out;
  for (const Integer& c : a) out.push_back(Rational(c));
  return out;
}

}  // namespace detail

template <ExactField R>
BinaryForm<R> gcd(const BinaryForm<R>& f, const BinaryForm<R>& g) {
  if (*is_zero(f)) return *is_zero(g) ? BinaryForm<R>() : g;
  if (*is_zero(g)) return f;
  // Powers of s are invisible in x: take them out and put the common one back.
  const int at_one = std::min(end_orders(f).at_one, end_orders(g).at_one);
  std::vector<R> p = f.coefficients(), q = g.coefficients();
  detail::trim(p);
  detail::trim(q);
  p = detail::last_remainder(std::move(p), std::move(q));
  for (int i = 0; i < at_one; ++i) p.push_back(R(0));
  return BinaryForm<R>(std::move(p));
}

template <ExactField R>
BinaryForm<R> divide_exactly(const BinaryForm<R>& f, const BinaryForm<R>& g) {
  if (*is_zero(f)) return {};
  const int degree = f.degree() - g.degree();
  std::vector<R> p = f.coefficients(), q = g.coefficients();
  detail::trim(p);
  detail::trim(q);
  std::vector<R> quotient = detail::divide(p, q);
  PATCHPROOF_REQUIRES(p.empty() && static_cast<int>(quotient.size()) <= degree + 1, "divide_exactly: not a divisor");
  quotient.resize(degree + 1);
  return BinaryForm<R>(std::move(quotient));
}

}  // namespace patchproof
