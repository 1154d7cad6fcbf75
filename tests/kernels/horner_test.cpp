// SPDX-License-Identifier: Apache-2.0
// The kernels' bodies on other numbers than lanes: on Rational they are the exact formula, on Tracked their running error
// stays below what Magnitude foretells.
#include "kernels/horner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/error_bounds.h"
#include "kernels/pieces.h"
#include "patchproof/patch/evaluate_batch.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/tracked.h"
#include "patchproof/spline/power_form.h"
#include "support/patches.h"
#include "validation/corpus/cases.h"

namespace patchproof {

// What the bodies need of a point, found by argument-dependent lookup.
template <class T>
Vec<T, 4> fma(const Vec<T, 4>& a, const T& x, const Vec<T, 4>& c) {
  return {{a[0] * x + c[0], a[1] * x + c[1], a[2] * x + c[2], a[3] * x + c[3]}};
}
template <class T>
Vec<T, 4> scale(const Vec<T, 4>& a, const T& x) {
  return {{a[0] * x, a[1] * x, a[2] * x, a[3] * x}};
}
// A power of two scales exactly; Tracked's product would count a rounding.
struct Power {
  double x;
  explicit Power(double value) : x(value) {}
  friend Power operator*(Power a, Power b) { return Power(a.x * b.x); }
};
Vec<Rational, 4> scale(const Vec<Rational, 4>& a, Power f) { return scale(a, from_double(f.x)); }
Vec<Tracked, 4> scale(const Vec<Tracked, 4>& a, Power f) {
  Vec<Tracked, 4> out;
  for (int k = 0; k < 4; ++k) out[k] = Tracked(a[k].value() * f.x, a[k].error() * f.x);
  return out;
}
template <class T>
struct WeightOf {
  T w;
};
template <class T>
WeightOf<T> weight_of(const Vec<T, 4>& a) {
  return {a[3]};
}
template <class T>
T reciprocal(const WeightOf<T>& weight) {
  return T(1) / weight.w;
}
template <class T>
Vec<T, 4> minus_product(const Vec<T, 4>& a, const Vec<T, 4>& s, const WeightOf<T>& weight) {
  return {{a[0] - s[0] * weight.w, a[1] - s[1] * weight.w, a[2] - s[2] * weight.w, a[3] - s[3] * weight.w}};
}

namespace {

template <class T, class Coefficient>
kernels::SurfaceJet<2, Vec<T, 4>> jet_at(int p, int q, const T& x, const T& y, Power factor_x, Power factor_y,
                                         Coefficient c) {
  kernels::HornerRows<2, Vec<T, 4>> rows;
  for (int j = q; j >= 0; --j) {
    kernels::Horner<2, Vec<T, 4>> row;
    for (int i = p; i >= 0; --i) row.push(p - i, c(i, j), x);
    rows.push(q - j, row.d, y);
  }
  return kernels::surface_jet<2>(rows, factor_x, factor_y);
}

TEST(KernelBodies, OnRationalTheyAreTheExactTemplate) {
  test::RandomRationals random(31);
  for (int p = 0; p <= 4; ++p)
    for (int q = 0; q <= 4; ++q) {
      const auto patch = test::random_patch<4>(random, p, p + 3, q, q + 2);
      const auto &ku = patch.knots(Direction::u), &kv = patch.knots(Direction::v);
      const Rational u = (ku.domain_begin() + ku.domain_end() * Rational(2)) / Rational(3);
      const Rational v = (kv.domain_begin() * Rational(4) + kv.domain_end()) / Rational(5);
      const int su = ku.find_span(u), sv = kv.find_span(v);
      const Rational cu = random(), cv = random(), gu(8), gv(2);
      const auto mu = basis_power_form<Rational>(ku, su, cu, gu), mv = basis_power_form<Rational>(kv, sv, cv, gv);
      const auto c = [&](int i, int j) {
        Vec<Rational, 4> sum;
        for (int a = 0; a <= p; ++a)
          for (int b = 0; b <= q; ++b)
            sum += (mu[i * (p + 1) + a] * mv[j * (q + 1) + b]) * patch.point(su - p + a, sv - q + b);
        return sum;
      };
      const auto jet = jet_at<Rational>(p, q, (u - cu) * gu, (v - cv) * gv, Power(8), Power(2), c);
      const int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
      const auto homogeneous = partial_derivatives(patch, u, v, 2, 2);
      for (int m = 0; m < 6; ++m) EXPECT_EQ(jet.d[m], homogeneous.at(order[m][0], order[m][1])) << p << q << m;
      if (jet.d[0][3] == Rational(0)) continue;
      const auto affine = rational_derivatives(patch, u, v, 2, 2);
      const auto divided = kernels::quotient<2>(jet);
      for (int m = 0; m < 6; ++m)
        for (int k = 0; k < 3; ++k) EXPECT_EQ(divided.d[m][k], affine.at(order[m][0], order[m][1])[k]) << p << q << m;
    }
}

TEST(KernelBodies, OnTrackedTheirErrorsStayWithinThePreparedBounds) {
  int compared = 0;
  double closest = 0;  // Tracked's error as a part of the bound
  for (const validation::SurfaceCase& c : validation::surface_cases({3, 4})) {
    const BatchSurface surface = *BatchSurface::make(c.data());
    const kernels::SurfacePieces& s = surface.pieces();
    for (int a = 0; a < s.u.count; a += 3)
      for (int b = 0; b < s.v.count; b += 2) {
        const kernels::PieceBounds& bounds = s.bounds[static_cast<std::size_t>(a) * s.v.count + b];
        const std::size_t piece = (static_cast<std::size_t>(a) * s.v.count + b) * s.piece;
        const auto coefficient = [&](int i, int j) {
          Vec<Tracked, 4> out;
          for (int k = 0; k < (s.rational ? 4 : 3); ++k) {
            const double high = s.high.data()[piece + s.at(i, j) + k], low = s.low.data()[piece + s.at(i, j) + k];
            out[k] = Tracked(high, std::fabs(low));
          }
          return out;
        };
        for (const double x : {-0.9375, 0.0, 0.3, 0.999})
          for (const double y : {-0.7, 0.25, 1.0}) {
            const auto parameter = [](double t) { return Tracked(t, 0x1p-53 * std::fabs(t)); };
            auto jet = jet_at<Tracked>(s.u.degree, s.v.degree, parameter(x * s.u.reach[a]), parameter(y * s.v.reach[b]),
                                       Power(s.u.scale[a]), Power(s.v.scale[b]), coefficient);
            if (s.rational) jet = kernels::quotient<2>(jet);
            for (int m = 0; m < 6; ++m)
              for (int k = 0; k < 3; ++k) {
                if (!std::isfinite(bounds.error[m])) continue;
                ASSERT_LE(jet.d[m][k].error(), bounds.error[m]) << c.group << "/" << c.name << " vector " << m;
                closest = std::max(closest, jet.d[m][k].error() / bounds.error[m]);
                ++compared;
              }
          }
      }
  }
  EXPECT_GT(compared, 10000);
  EXPECT_GT(closest, 0.2);  // the bounds are not idle
}

}  // namespace
}  // namespace patchproof
