// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/cardinal.h"

#include <gtest/gtest.h>

#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;

Rational q(int n, int d = 1) { return Rational(n) / Rational(d); }
KnotVector<Rational> knots_of(int degree, const Numbers& knots) {
  return KnotVector<Rational>::make(degree, knots).value();
}

// Averages of degree successive knots: they determine a spline (Greville's abscissae).
Numbers averages(const KnotVector<Rational>& knots) {
  Numbers out;
  for (int i = 0; i < knots.control_count(); ++i) {
    Rational sum(0);
    for (int j = 1; j <= knots.degree(); ++j) sum += knots[i + j];
    out.push_back(sum / Rational(knots.degree()));
  }
  return out;
}

const KnotVector<Rational> spaces[] = {
    KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(5, q(-3), q(7)),
    knots_of(3, {q(0), q(0), q(0), q(0), q(1), q(2), q(2), q(4), q(4), q(4), q(4)}),
    knots_of(2, {q(1000000), q(1000000), q(1000000), q(1000001), q(1000002), q(1000002), q(1000002)})};

TEST(Cardinal, Law1_OneAtTheOwnSite) {
  for (const auto& knots : spaces) {
    const Numbers sites = averages(knots);
    const auto a = cardinal_controls(knots, sites).value();
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const Numbers n = basis(knots, sites[k]);
      for (std::size_t i = 0; i < sites.size(); ++i) {
        Rational value(0);
        for (std::size_t m = 0; m < n.size(); ++m) value += n[m] * a[m][i];
        EXPECT_EQ(value, q(i == k ? 1 : 0));
      }
    }
  }
}

TEST(Cardinal, Law2_SplinesAreReproduced) {
  RandomRationals random;
  for (const auto& knots : spaces) {
    const Numbers sites = averages(knots), controls = random.numbers(knots.control_count());
    const auto a = cardinal_controls(knots, sites).value();
    for (std::size_t m = 0; m < controls.size(); ++m) {
      Rational row_sum(0), control(0);
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const Numbers n = basis(knots, sites[i]);
        Rational value(0);
        for (std::size_t l = 0; l < n.size(); ++l) value += n[l] * controls[l];
        control += a[m][i] * value;
        row_sum += a[m][i];
      }
      EXPECT_EQ(control, controls[m]);
      EXPECT_EQ(row_sum, q(1));
    }
  }
}

// Degree 2 at 0, 1/3, 1: L_1 = 9/2 t (1 − t), whose middle Bézier point is 9/4.
TEST(Cardinal, Law1_LagrangeOnBezierKnots) {
  const auto a = cardinal_controls(KnotVector<Rational>::bezier(2), {q(0), q(1, 3), q(1)}).value();
  EXPECT_EQ(a[0][1], q(0));
  EXPECT_EQ(a[1][1], q(9, 4));
  EXPECT_EQ(a[1][0], q(-1));
  EXPECT_EQ(a[2][1], q(0));
}

TEST(Cardinal, BadSitesAreNamed) {
  const auto knots = knots_of(1, {q(0), q(0), q(1), q(2), q(2)});
  EXPECT_EQ(cardinal_controls(knots, {q(0), q(1)}).error().code, ErrorCode::wrong_count);
  EXPECT_EQ(cardinal_controls(knots, {q(0), q(1), q(3)}).error().code, ErrorCode::outside_domain);
  EXPECT_EQ(cardinal_controls(knots, {q(0), q(1), q(1)}).error().code, ErrorCode::usage);
  // All in the first span: N_2 is zero at every site.
  EXPECT_EQ(cardinal_controls(knots, {q(0), q(1, 2), q(1)}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace patchproof::test
