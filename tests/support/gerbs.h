// SPDX-License-Identifier: Apache-2.0
// GERBS curves with random exact local curves, and their derivatives by another way than the library's: all factors are
// multiplied as power series about the parameter, B-spline pieces by the recursion over all knots.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "patchproof/spline/gerbs_curve.h"
#include "support/polynomial.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {

inline BFunction b_function(const std::string& text) { return BFunction::parse(text).value(); }

inline const std::vector<std::string> kExactB{
    "polynomial(0)", "polynomial(1)", "polynomial(3)", "beta(2,1)",
    "beta(0,2)",     "rational(1)",   "rational(2)",   "bernstein(0,1/4,1/2,1)"};
inline const std::vector<std::string> kFlatB{"logistic", "expo-rational(1,1,1,1/2)", "expo-rational(1,1,1,1/3)"};
inline const std::vector<std::string> kTranscendentalB{"trigonometric", "logistic", "expo-rational(1,1,1,1/2)",
                                                       "expo-rational(1,1,1,1/3)"};

// ---- power series ---------------------------------------------------------------------------------------------------

// f(t + x) = Σ c_k x^k + …
template <class R>
using Jet = std::vector<R>;

template <class R>
Jet<R> operator*(const Jet<R>& a, const Jet<R>& b) {
  Jet<R> out(a.size(), R(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; i + j < a.size(); ++j) out[i + j] = out[i + j] + a[i] * b[j];
  return out;
}
template <class R>
Jet<R> operator/(const Jet<R>& a, const Jet<R>& b) {
  Jet<R> out;
  for (std::size_t k = 0; k < a.size(); ++k) {
    R rest = a[k];
    for (std::size_t j = 1; j <= k; ++j) rest = rest - b[j] * out[k - j];
    out.push_back(rest / b[0]);
  }
  return out;
}

inline Rational factorial(int n) {
  Rational out(1);
  for (int k = 2; k <= n; ++k) out *= Rational(k);
  return out;
}

template <class R>
Jet<R> jet_of(const Polynomial& p, const Rational& t, int order) {
  Jet<R> out;
  for (int k = 0; k <= order; ++k) out.push_back(embed<R>(Rational(p.derivative(k)(t) / factorial(k))));
  return out;
}

// B((t − a)/(b − a))
template <class R>
Jet<R> jet_of(const BFunction& b, const Rational& begin, const Rational& end, const Rational& t, int order) {
  const Rational h = end - begin, w = (t - begin) / h;
  Jet<R> out;
  if (b.is_exact()) {
    out = jet_of<R>(from_bernstein(b.numerator()), w, order) / jet_of<R>(from_bernstein(b.denominator()), w, order);
  } else if constexpr (Transcendental<R>) {
    out = derivatives(b, embed<R>(w), order);
    for (int k = 0; k <= order; ++k) out[k] = out[k] / embed<R>(factorial(k));
  }
  R power(1);
  for (R& x : out) {
    x = x * power;
    power = power / embed<R>(h);
  }
  return out;
}

// Coordinates of a local curve, of the piece to that side of `inside`.
template <class R, std::size_t M>
std::vector<Jet<R>> jets_of(const LocalCurve<Rational, M>& local, const Rational& inside, Side side, const Rational& t,
                            int order) {
  const Rational place = inside - local.shift(), x = t - local.shift();
  std::vector<Jet<R>> sums(M, Jet<R>(order + 1, R(0)));
  const auto add = [&](const Jet<R>& f, const Vec<Rational, M>& p) {
    for (std::size_t c = 0; c < M; ++c)
      for (int k = 0; k <= order; ++k) sums[c][k] = sums[c][k] + embed<R>(p[c]) * f[k];
  };
  if (const auto* knots = local.basis().knots()) {
    const int span = knots->find_span(place, side);
    for (int i = span - knots->degree(); i <= span; ++i)
      add(jet_of<R>(bspline_piece(knots->knots(), i, knots->degree(), span), x, order), local.points()[i]);
  } else if constexpr (Transcendental<R>) {
    for (std::size_t l = 0; l < local.points().size(); ++l) {
      const int frequency = static_cast<int>(l + 1) / 2;
      Jet<R> f;
      R factor(1);
      for (int k = 0; k <= order; ++k) {  // the k-th derivative of cosine is the cosine a quarter turn on
        const auto cs = cos_sin_pi(embed<R>(Rational(Rational(frequency) * x + Rational(k) / Rational(2))));
        f.push_back(factor * cs[l > 0 && l % 2 == 0 ? 1 : 0] / embed<R>(factorial(k)));
        factor = factor * R(frequency) * pi<R>();
      }
      add(f, local.points()[l]);
    }
  }
  std::vector<Jet<R>> out;
  for (std::size_t c = 0; c + 1 < M; ++c) out.push_back(sums[c] / sums[M - 1]);
  return out;
}

// f, f′, … in R: Rational where all is exact, Ball elsewhere.
template <class R, std::size_t M>
std::vector<Vec<R, M - 1>> reference_derivatives(const GerbsCurve<Rational, M>& curve, const Rational& inside,
                                                 Side side, const Rational& t, int order) {
  const std::vector<Rational>& knots = curve.knots().knots();
  int i = 1;  // the first or last span that holds `inside` to that side
  while (i + 1 < curve.knots().control_count() &&
         !(side == Side::right ? knots[i] <= inside && inside < knots[i + 1]
                               : knots[i] < inside && inside <= knots[i + 1]) &&
         !(side == Side::left && inside == curve.knots().domain_begin() && knots[i] < knots[i + 1]))
    ++i;
  while (!(knots[i] < knots[i + 1])) --i;
  const Jet<R> b = jet_of<R>(curve.b_function(), knots[i], knots[i + 1], t, order);
  Jet<R> a = b;
  for (R& x : a) x = -x;
  a[0] = a[0] + R(1);
  const auto before = jets_of<R>(curve.locals()[i - 1], inside, side, t, order),
             after = jets_of<R>(curve.locals()[i], inside, side, t, order);
  std::vector<Vec<R, M - 1>> out(order + 1);
  for (std::size_t c = 0; c + 1 < M; ++c) {
    const Jet<R> first = a * before[c], second = b * after[c];
    for (int k = 0; k <= order; ++k) out[k][c] = embed<R>(factorial(k)) * (first[k] + second[k]);
  }
  return out;
}

// ---- data -----------------------------------------------------------------------------------------------------------

enum class Weights { one, common, different };

// A spline on [begin, end] with `inner` knots inside, the first of them double. No weight is 1 unless all are.
template <std::size_t M>
BsplineCurve<Rational, M> random_spline(RandomRationals& random, const Rational& begin, const Rational& end, int degree,
                                        int inner, Weights weights) {
  std::vector<Rational> knots(degree + 1, begin);
  for (int k = 1; k <= inner; ++k)
    knots.insert(knots.end(), k == 1 && degree >= 2 ? 2 : 1, begin + (end - begin) * Rational(k) / Rational(4));
  knots.insert(knots.end(), degree + 1, end);
  const auto k = KnotVector<Rational>::make(degree, std::move(knots)).value();
  std::vector<Vec<Rational, M>> points;
  for (int i = 0; i < k.control_count(); ++i) {
    Vec<Rational, M> p = random.point<M>();
    p[M - 1] = weights == Weights::one      ? Rational(1)
               : weights == Weights::common ? Rational(3) / Rational(2)
                                            : Rational(random.integer(3, 7)) / Rational(2);
    for (std::size_t c = 0; c + 1 < M; ++c) p[c] = p[c] * p[M - 1];
    points.push_back(p);
  }
  return {k, std::move(points)};
}

template <std::size_t M = 3>
GerbsCurve<Rational, M> random_gerbs(RandomRationals& random, const BFunction& b, const std::vector<Rational>& breaks,
                                     bool closed, Weights weights = Weights::one, int inner = 1) {
  const KnotVector<Rational> knots = gerbs_knots(breaks, closed).value();
  std::vector<LocalCurve<Rational, M>> locals;
  for (int i = 0; i < knots.control_count() - (closed ? 1 : 0); ++i)
    locals.push_back(
        random_spline<M>(random, knots[i], knots[i + 2], weights == Weights::one ? 1 + i % 3 : 2, inner, weights));
  return GerbsCurve<Rational, M>::make(b, knots, std::move(locals), closed).value();
}

// Breaks of the curve and a place between any two, with the sides that exist there.
template <std::size_t M>
std::vector<std::pair<Rational, Side>> sided_places(const GerbsCurve<Rational, M>& curve) {
  const std::vector<Rational> at = curve.breaks();
  std::vector<std::pair<Rational, Side>> out;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i > 0) out.push_back({at[i], Side::left});
    if (i + 1 == at.size()) break;
    out.push_back({at[i], Side::right});
    out.push_back({Rational((at[i] + Rational(3) * at[i + 1]) / Rational(4)), Side::right});
  }
  return out;
}

// Both hold the same number.
inline void expect_overlap(const Ball& x, const Ball& y) {
  const auto sign = Ball(x - y).sign();
  EXPECT_TRUE(!sign || *sign == Sign::zero)
      << x.to_interval().inf() << " … and " << y.to_interval().inf() << " … are apart";
}
template <std::size_t N>
void expect_overlap(const std::vector<Vec<Ball, N>>& x, const std::vector<Vec<Ball, N>>& y) {
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t r = 0; r < x.size(); ++r)
    for (std::size_t c = 0; c < N; ++c) {
      SCOPED_TRACE("derivative " + std::to_string(r) + ", coordinate " + std::to_string(c));
      expect_overlap(x[r][c], y[r][c]);
    }
}

// The width, as a double.
inline double width(const Ball& x) {
  const Interval i = Ball(x - x).to_interval();
  return i.sup();
}

}  // namespace patchproof::test
