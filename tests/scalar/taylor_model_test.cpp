// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/taylor_model.h"

#include <gtest/gtest.h>

#include "patchproof/patch/rational_patch.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Model = TaylorModel<6>;
static_assert(Field<Model> && !OrderedField<Model> && !ExactRing<Model>);

// s = −1, −7/8, …, 1
template <class F>
void for_each_place(F f) {
  for (int i = -8; i <= 8; ++i) f(Rational(i) / Rational(8));
}
Model line(const Rational& centre, const Rational& radius) { return Model::variable(enclose(centre), enclose(radius)); }
double width(const Interval& x) { return x.sup() - x.inf(); }

void expect_contains(const Interval& x, const Rational& exact) {
  EXPECT_TRUE(from_double(x.inf()) <= exact && exact <= from_double(x.sup()))
      << "[" << x.inf() << ", " << x.sup() << "] misses " << exact;
}
void expect_contains(const Interval& x, const Ball& exact) {
  const Interval tight = exact.to_interval();
  EXPECT_TRUE(x.inf() <= tight.sup() && tight.inf() <= x.sup())
      << "[" << x.inf() << ", " << x.sup() << "] misses " << tight.inf();
}
template <class Exact>
void expect_encloses(const Model& model, const Rational& s, const Exact& exact) {
  expect_contains(model.value(enclose(s)), exact);
  expect_contains(model.range(), exact);
  expect_contains(model.bernstein_range(), exact);
}

class TaylorModels : public ::testing::Test {
 private:
  RoundingGuard guard_;
};

TEST_F(TaylorModels, Law1_RationalOperations) {
  RandomRationals random;
  for (int round = 0; round < 30; ++round) {
    const Rational a = random(), b = random(), r = random.unit(), q = random.unit();
    const auto formula = [&](const auto& x, const auto& y, const auto& seven) {
      return x * y * x + x * y / (y * y + seven) - (x - y) * (x - y) * x * x * y;
    };
    const Model model = formula(line(a, r), line(b, q), Model(7));
    for_each_place([&](const Rational& s) {
      expect_encloses(model, s, formula(Rational(a + r * s), Rational(b + q * s), Rational(7)));
    });
  }
}

TEST_F(TaylorModels, Law1_ElementaryFunctions) {
  RandomRationals random;
  for (int round = 0; round < 20; ++round) {
    const Rational a = random(), r = random.unit();
    const Model x = line(a, r), positive = x * x + Model(1);
    for_each_place([&](const Rational& s) {
      const Rational at = a + r * s;
      expect_encloses(sqrt(positive), s, sqrt(Ball(Rational(at * at + 1))));
      expect_encloses(exp(x / Model(8)), s, exp(Ball(Rational(at / 8))));
      expect_encloses(sin(x), s, sin(Ball(at)));
      expect_encloses(cos(x), s, cos(Ball(at)));
      expect_encloses(sin(x) * sin(x) + cos(x) * cos(x), s, Rational(1));
    });
  }
}

TEST_F(TaylorModels, Law1_WideOperandsStayEnclosed) {
  const Model wide = Model::variable(Interval(0.25), Interval(-3.0, 7.0)) + Model(Interval(-0.5, 0.5));
  for (const double slope : {-3.0, 0.5, 7.0})
    for (const double shift : {-0.5, 0.25})
      for_each_place([&](const Rational& s) {
        const Rational at = Rational(1) / 4 + from_double(slope) * s + from_double(shift);
        expect_encloses(wide * wide, s, Rational(at * at));
        expect_encloses(cos(wide), s, cos(Ball(at)));
        expect_encloses(sqrt(wide * wide), s, Rational(at < 0 ? Rational(-at) : at));
      });
}

// The bounds of the values are of order 1 in the radius, those of the difference from the polynomial of order N + 1.
TEST_F(TaylorModels, Law3_RemaindersShrinkWithTheOrder) {
  const auto remainder = [](double radius) {
    const Model x = Model::variable(Interval(1), Interval(radius));
    return width((sin(x) / (Model(2) + x * x) + sqrt(x + Model(3)) * exp(x)).remainder());
  };
  for (double radius = 0.5; radius > 0.05; radius /= 2)
    EXPECT_LE(remainder(radius / 2), remainder(radius) / 100) << radius;  // 2^7 = 128
}

// A surface at a curve in its parameters is a curve in space, enclosed as one.
TEST_F(TaylorModels, Law3_CompositionOfARationalSurfaceAndACurve) {
  RandomRationals random;
  const auto knots = KnotVector<Rational>::bezier(3);
  auto net = random.points<4>(16);
  for (auto& h : net) h[3] = Rational(30) + h[3];
  const BsplinePatch<Rational, 4> patch(knots, knots, net);
  const auto at = [&](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    const T u = t * t, v = T(1) - t * t * t;
    if constexpr (std::is_same_v<T, Rational>)
      return evaluate_rational(patch, u, v);
    else
      return project(evaluate_in_span<T>(patch, 3, 3, u, v));
  };
  double previous = 0;
  for (const Rational& radius : {Rational(Rational(1) / 4), Rational(Rational(1) / 8), Rational(Rational(1) / 16)}) {
    const auto model = at(line(Rational(1) / 2, radius));
    for_each_place([&](const Rational& s) {
      const auto exact = at(Rational(Rational(1) / 2 + radius * s));
      for (int c = 0; c < 3; ++c) expect_encloses(model[c], s, exact[c]);
    });
    const double excess = width(model[0].remainder());
    if (previous > 0) {
      EXPECT_LE(excess, previous / 60);
    }
    previous = excess;
  }
}

// Two formulas of one curve: the coefficients cancel, where intervals would leave the whole width.
TEST_F(TaylorModels, DifferencesCancelInTheCoefficients) {
  const Model x = line(3, Rational(1) / 16);
  const Model difference = (x + Model(1)) * (x + Model(1)) - (x * x + x + x + Model(1));
  EXPECT_LE(width(difference.range()), 1e-14);
  expect_contains(difference.range(), Rational(0));
}

TEST_F(TaylorModels, Law4_QuotientsByZeroAreAnything) {
  const Model x = line(0, 1);
  for (const Model& y : {Model(1) / x, Model(0) / Model(0), x / (x * x), Model(1) / Model(0)}) {
    EXPECT_EQ(y.range().inf(), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(y.range().sup(), std::numeric_limits<double>::infinity());
  }
  const Model far = Model::anything() * Model::anything() + exp(Model::anything()) - sin(Model::anything());
  EXPECT_FALSE(std::isnan(far.range().inf()) || std::isnan(far.range().sup()));
  EXPECT_EQ((Model(0) * Model::anything()).range().sup(), 0);
  EXPECT_THROW(sqrt(Model(-1)), contract_error);
  EXPECT_THROW(x.value(Interval(1.5)), contract_error);
}

TEST_F(TaylorModels, Law5_Signs) {
  using Traits = scalar_traits<Model>;
  EXPECT_EQ(Traits::sign(line(2, 1)), Sign::positive);
  EXPECT_EQ(Traits::sign(-line(2, 1)), Sign::negative);
  EXPECT_EQ(Traits::sign(line(1, 2)), std::nullopt);
  EXPECT_EQ(Traits::sign(Model(0)), Sign::zero);
}

}  // namespace
}  // namespace patchproof::test
