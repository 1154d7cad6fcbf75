// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/b_function.h"

#include <gtest/gtest.h>

#include "patchproof/scalar/parse_scalar.h"
#include "support/b_function_vectors.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

Rational number(std::string_view text) { return *parse_scalar<Rational>(text); }
BFunction make_b(const std::string& text) { return *BFunction::parse(text); }
Rational factorial(int n) { return n <= 1 ? Rational(1) : n * factorial(n - 1); }

const char* const kExact[] = {
    "polynomial(0)", "polynomial(1)", "polynomial(2)", "polynomial(5)", "beta(2,1)",
    "beta(0,3)",     "rational(1)",   "rational(2)",   "rational(4)",   "bernstein(0,1/4,1/2,1)"};
const char* const kFlat[] = {"logistic", "expo-rational(1,1,1,1/2)", "expo-rational(1,1,1,1/3)",
                             "expo-rational(2,1,1,1/2)", "expo-rational(1,1,2,1/3)"};

// ---- (1) orders -----------------------------------------------------------------------------------------------------

TEST(BFunctionLaws, Law1_PolynomialEndDerivatives) {
  for (int n = 0; n <= 12; ++n) {
    const BFunction b = *BFunction::polynomial(n);
    const auto begin = derivatives(b, Rational(0), n + 1), end = derivatives(b, Rational(1), n + 1);
    for (int k = 1; k <= n; ++k) EXPECT_TRUE(begin[k] == 0 && end[k] == 0) << n;
    const Rational next = factorial(2 * n + 1) / factorial(n);
    EXPECT_EQ(begin[n + 1], next);
    EXPECT_EQ(end[n + 1], n % 2 == 0 ? next : Rational(-next));
    EXPECT_EQ(b.order(), n);
    Rational middle = factorial(2 * n + 1) / (factorial(n) * factorial(n));
    for (int k = 0; k < n; ++k) middle = middle / 4;
    EXPECT_EQ(derivatives(b, Rational(1) / 2, 1)[1], middle);
  }
}

TEST(BFunctionLaws, Law1_OrdersAreExactlyTheVanishingDerivatives) {
  for (const char* text : kExact) {
    const BFunction b = make_b(text);
    const int a = *b.order_at_begin(), e = *b.order_at_end();
    const auto begin = derivatives(b, Rational(0), a + 1), end = derivatives(b, Rational(1), e + 1);
    EXPECT_EQ(begin[0], 0) << text;
    EXPECT_EQ(end[0], 1) << text;
    for (int k = 1; k <= a; ++k) EXPECT_EQ(begin[k], 0) << text;
    for (int k = 1; k <= e; ++k) EXPECT_EQ(end[k], 0) << text;
    EXPECT_NE(begin[a + 1], 0) << text;
    EXPECT_NE(end[e + 1], 0) << text;
    EXPECT_EQ(b.order(), std::min(a, e));
  }
}

TEST(BFunctionLaws, Law1_FlatFunctionsHaveEveryOrder) {
  for (const char* text : kFlat) {
    const BFunction b = make_b(text);
    EXPECT_FALSE(b.order() || b.order_at_begin() || b.order_at_end()) << text;
    for (const int end : {0, 1}) {
      const auto exact = derivatives(b, Rational(end), 9);
      const auto ball = derivatives(b, Ball(end), 9);
      const auto rounded = derivatives(b, static_cast<double>(end), 3);
      for (int k = 0; k <= 9; ++k) {
        const Rational expected(k == 0 ? end : 0);
        EXPECT_EQ(exact[k], expected);
        EXPECT_TRUE(ball[k].contains(expected) && ball[k].to_interval().is_point());
        EXPECT_EQ(from_double(rounded[std::min(k, 3)]), k <= 3 ? expected : Rational(0));
      }
      EXPECT_TRUE(derivatives(b, Quadratic(end), 3)[0] == Quadratic(end));
    }
  }
}

// The words "first order" of the source mean one vanishing derivative: the degree is 3, and B″ is 6 and −6 at the ends.
TEST(BFunctionLaws, Law1_FirstOrderIsNotDegreeOne) {
  const BFunction b = *BFunction::polynomial(1);
  EXPECT_EQ(b.numerator().size(), 4U);
  EXPECT_EQ(derivatives(b, Rational(0), 2)[2], 6);
  EXPECT_EQ(derivatives(b, Rational(1), 2)[2], -6);
  EXPECT_EQ(BFunction::trigonometric().order(), 1);
  EXPECT_TRUE(BFunction() == b);
}

// ---- (2) symmetry, (3) monotonicity ---------------------------------------------------------------------------------

TEST(BFunctionLaws, Law2_Symmetry) {
  for (const char* text : kExact) {
    const BFunction b = make_b(text);
    bool holds = true;
    for (int i = 0; i <= 40; ++i) {
      const Rational t = Rational(i) / 40;
      holds = holds && derivatives(b, t, 0)[0] + derivatives(b, Rational(1 - t), 0)[0] == 1;
    }
    EXPECT_EQ(b.is_symmetric(), holds) << text;
  }
  for (const char* text : kFlat) {
    const BFunction b = make_b(text);
    const Rational t = Rational(3) / 10;
    const Ball sum = derivatives(b, Ball(t), 0)[0] + derivatives(b, Ball(Rational(1 - t)), 0)[0];
    EXPECT_EQ(b.is_symmetric(), sum.contains(Rational(1))) << text;
  }
  EXPECT_TRUE(BFunction::trigonometric().is_symmetric());
}

TEST(BFunctionLaws, Law3_StrictlyIncreasing) {
  for (const char* text : kExact) {
    Rational last(-1);
    for (int i = 0; i <= 64; ++i) {
      const Rational value = derivatives(make_b(text), Rational(Rational(i) / 64), 0)[0];
      EXPECT_LT(last, value) << text;
      last = value;
    }
  }
  for (const char* text : {"trigonometric", "logistic", "expo-rational", "expo-rational(1,1,2,1/3)"}) {
    const BFunction b = make_b(text);
    Ball last(0);
    for (int i = 1; i < 64; ++i) {
      const auto at = derivatives(b, Ball(Rational(i) / 64), 1);
      EXPECT_EQ(at[1].sign(), Sign::positive) << text << " " << i;
      if (i > 56) continue;  // 1 − B may be smaller than 2^-128
      EXPECT_EQ((at[0] - last).sign(), Sign::positive) << text << " " << i;
      last = at[0];
    }
  }
}

// ---- (4) coefficients -----------------------------------------------------------------------------------------------

TEST(BFunctionLaws, Law4_NumeratorAndDenominator) {
  for (const char* text : kExact) {
    const BFunction b = make_b(text);
    for (int i = -3; i <= 13; ++i) {
      const Rational t = Rational(i) / 10;
      EXPECT_EQ(derivatives(b, t, 0)[0] * de_casteljau(b.denominator(), t), de_casteljau(b.numerator(), t)) << text;
    }
    EXPECT_EQ(b.is_polynomial(), b.denominator() == std::vector<Rational>{Rational(1)});
  }
}

TEST(BFunctionLaws, Law4_PolynomialIdentities) {  // the power form, and the integrand of beta
  for (int n = 0; n <= 6; ++n) {
    const auto choose = [](int a, int b) { return binomial_row<Rational>(a)[b]; };
    for (int i = 0; i <= 2 * n + 1; ++i) {
      const Rational t = Rational(i) / 7;
      Rational sum(0), power(1);
      for (int k = 0; k <= n; ++k) power = power * t;
      for (int j = 0; j <= n; ++j, power = power * t)
        sum += (j % 2 == 0 ? 1 : -1) * choose(n + j, j) * choose(2 * n + 1, n - j) * power;
      EXPECT_EQ(derivatives(*BFunction::polynomial(n), t, 0)[0], sum);
    }
  }
  const Rational t = Rational(2) / 7, s = 1 - t;
  const Rational slope = derivatives(*BFunction::beta(3, 2), t, 1)[1];
  EXPECT_EQ(slope, factorial(6) / (factorial(3) * factorial(2)) * t * t * t * s * s);
}

// ---- vectors --------------------------------------------------------------------------------------------------------

template <class T>
class BFunctionScalars : public ScalarTest<T> {};
using ExactFamilyScalars = ::testing::Types<Rational, Quadratic, Interval, Ball, Tracked>;
TYPED_TEST_SUITE(BFunctionScalars, ExactFamilyScalars, );

TYPED_TEST(BFunctionScalars, Law4_ExactVectorsInEveryScalar) {
  for (const ExactVector& v : kExactVectors) {
    SCOPED_TRACE(std::string(v.function) + " at " + v.t);
    const int order = static_cast<int>(v.derivatives.size()) - 1;
    const auto computed = derivatives(make_b(v.function), make<TypeParam>(number(v.t)), order);
    for (int k = 0; k <= order; ++k) expect_agrees(computed[k], number(v.derivatives[k]));
  }
}

TEST(BFunctionVectors, Law4_DoublesAndModels) {
  for (const ExactVector& v : kExactVectors) {
    const int order = static_cast<int>(v.derivatives.size()) - 1;
    const auto tracked = derivatives(make_b(v.function), make<Tracked>(number(v.t)), order);
    const auto computed = derivatives(make_b(v.function), nearest_double(number(v.t)), order);
    expect_same_bits(computed, tracked);
    const RoundingGuard guard;
    const auto models = derivatives(make_b(v.function), TaylorModel<4>(enclose(number(v.t))), order);
    for (int k = 0; k <= order; ++k) expect_agrees(models[k].range(), number(v.derivatives[k]));
  }
}

TEST(BFunctionVectors, Law5_EnclosedVectors) {
  for (const EnclosedVector& v : kEnclosedVectors) {
    SCOPED_TRACE(std::string(v.function) + " at " + v.t);
    const BFunction b = make_b(v.function);
    const int order = static_cast<int>(v.derivatives.size()) - 1;
    const auto balls = derivatives(b, Ball(number(v.t)), order);
    const auto rounded = derivatives(b, nearest_double(number(v.t)), order);
    const RoundingGuard guard;
    const auto intervals = derivatives(b, enclose(number(v.t)), order);
    for (int k = 0; k <= order; ++k) {
      const Ball low(number(v.derivatives[k].first)), high(number(v.derivatives[k].second));
      EXPECT_NE((balls[k] - low).sign(), Sign::negative) << k;
      EXPECT_NE((high - balls[k]).sign(), Sign::negative) << k;
      const Interval x = intervals[k];
      EXPECT_TRUE(x.inf() <= high.to_interval().sup() && low.to_interval().inf() <= x.sup()) << k;
      EXPECT_LE(x.sup() - x.inf(), 1e-13 * (1 + std::fabs(x.sup()))) << k;
      const double error = double_error(b, k) + 1e-13 * (1 + std::fabs(x.sup()));  // t is rounded, too
      EXPECT_TRUE(low.to_interval().inf() - error <= rounded[k] && rounded[k] <= high.to_interval().sup() + error) << k;
    }
  }
}

TEST(BFunctionVectors, Law5_TrigonometricAtAnEighthTurn) {  // (2 − √2)/4
  const Ball exact = (Ball(2) - sqrt(Ball(2))) / Ball(4);
  EXPECT_FALSE((derivatives(BFunction::trigonometric(), Ball(0.25), 0)[0] - exact).sign().has_value());
}

// ---- (8) texts, (9) errors ------------------------------------------------------------------------------------------

TEST(BFunctionLaws, Law8_TextsReadBack) {
  std::vector<std::string> texts(std::begin(kExact), std::end(kExact));
  texts.insert(texts.end(), std::begin(kFlat), std::end(kFlat));
  texts.push_back("trigonometric");
  for (const std::string& text : texts) {
    const BFunction b = make_b(text);
    EXPECT_EQ(b.to_string(), text);
    EXPECT_TRUE(make_b(b.to_string()) == b);
    EXPECT_EQ(b == make_b("polynomial(2)"), text == "polynomial(2)");
  }
  EXPECT_EQ(make_b("expo-rational").to_string(), "expo-rational(1,1,1,1/2)");
  EXPECT_EQ(make_b("bernstein(0,0,1,1)").to_string(), "polynomial(1)");
  EXPECT_EQ(make_b("bernstein(0,1/3,2/3,1)").to_string(), "polynomial(0)");
}

ErrorCode code_of(const Result<BFunction>& b) { return b ? ErrorCode::cannot_open : b.error().code; }

TEST(BFunctionLaws, Law9_ParametersOutOfRange) {
  const Rational half = Rational(1) / 2, one(1);
  for (const int order : {-1, BFunction::kMaxOrder + 1, 1000000000}) {
    EXPECT_EQ(code_of(BFunction::polynomial(order)), ErrorCode::usage);
    EXPECT_EQ(code_of(BFunction::beta(1, order)), ErrorCode::usage);
    EXPECT_EQ(code_of(BFunction::rational(order)), ErrorCode::usage);
  }
  for (const Rational& bad : {Rational(0), Rational(-1), Rational(1000)}) {
    EXPECT_EQ(code_of(BFunction::expo_rational(bad, one, one, half)), ErrorCode::usage);
    EXPECT_EQ(code_of(BFunction::expo_rational(one, bad, one, half)), ErrorCode::usage);
    EXPECT_EQ(code_of(BFunction::expo_rational(one, one, bad, half)), ErrorCode::usage);
  }
  for (const Rational& bad : {Rational(0), Rational(1), Rational(-1), Rational(1) / 1000}) {
    EXPECT_EQ(code_of(BFunction::expo_rational(one, one, one, bad)), ErrorCode::usage);
    EXPECT_NE(BFunction::expo_rational(one, one, one, bad).error().where.find("lambda"), std::string::npos);
  }
}

TEST(BFunctionLaws, Law9_PolynomialsThatAreNoBFunctions) {
  // t − 2t²(1−t) has slope 1 − 4t + 6t², with no real root; t − 4t²(1−t) has slope 1 − 8t + 12t², with roots 1/6 and 1/2.
  const auto minus = [](int c) { return std::vector<Rational>{0, Rational(1) / 3, Rational(2 - c) / 3, 1}; };
  EXPECT_TRUE(BFunction::from_polynomial(minus(2)).has_value());
  const auto turning = BFunction::from_polynomial(minus(4));
  ASSERT_EQ(code_of(turning), ErrorCode::not_monotone);
  EXPECT_NE(turning.error().values.find("between"), std::string::npos) << turning.error().text();
  EXPECT_EQ(code_of(BFunction::from_polynomial({0, 2, -1, 1})), ErrorCode::not_monotone);
  EXPECT_EQ(code_of(BFunction::from_polynomial({0, Rational(3) / 2, 1})), ErrorCode::not_monotone);
  EXPECT_EQ(code_of(BFunction::from_polynomial({0, Rational(-1) / 2, 1})), ErrorCode::not_monotone);
  EXPECT_EQ(code_of(BFunction::from_polynomial({Rational(1) / 2, 1})), ErrorCode::not_monotone);
  EXPECT_EQ(code_of(BFunction::from_polynomial({0, 2})), ErrorCode::not_monotone);
  EXPECT_EQ(code_of(BFunction::from_polynomial({1})), ErrorCode::usage);
  EXPECT_EQ(code_of(BFunction::from_polynomial({})), ErrorCode::usage);
  EXPECT_EQ(code_of(BFunction::from_polynomial(std::vector<Rational>(1000, Rational(1)))), ErrorCode::usage);
  // A slope that touches 0 inside is no harm: 1/2 + 4 (t − 1/2)³ has the slope 12 (t − 1/2)².
  EXPECT_TRUE(BFunction::from_polynomial({0, 1, 0, 1}).has_value());
  // A dip of 10^-12 is found.
  const Rational dip = Rational(1) / Rational(1000000000000);
  EXPECT_EQ(code_of(BFunction::from_polynomial({0, 1 + dip, -dip, 1})), ErrorCode::not_monotone);
}

TEST(BFunctionLaws, Law9_TextsThatAreNoBFunctions) {
  for (const char* text : {"",
                           "(",
                           ")",
                           "poly",
                           "polynomial",
                           "polynomial()",
                           "polynomial(1",
                           "polynomial(1,2)",
                           "polynomial(1/2)",
                           "polynomial(x)",
                           "beta(1)",
                           "rational(1)2",
                           "logistic()",
                           "trigonometric(1)",
                           "expo-rational(1)",
                           "expo-rational(1,1,1,1/0)",
                           "bernstein",
                           "bernstein()",
                           "polynomial(99999999999999999999)",
                           "polynomial(1e3)",
                           "expo-rational(1,1,1,1)",
                           "bernstein(0,2,-1,1)"})
    EXPECT_FALSE(BFunction::parse(text).has_value()) << text;
  EXPECT_FALSE(BFunction::parse("bernstein(" + std::string(100000, ',') + ")").has_value());
}

TEST(BFunctionLaws, Law9_Contracts) {
  const BFunction trigonometric = BFunction::trigonometric(), logistic = BFunction::logistic();
  EXPECT_THROW(derivatives(logistic, Rational(Rational(1) / 2), 0), contract_error);
  EXPECT_THROW(derivatives(trigonometric, Rational(0), 2), contract_error);
  EXPECT_EQ(derivatives(trigonometric, Rational(1), 1)[0], 1);
  EXPECT_THROW(derivatives(logistic, Tracked(0.5), 0), contract_error);
  EXPECT_THROW(derivatives(logistic, 0.5, -1), contract_error);
  EXPECT_THROW(derivatives(BFunction(), 0.5, 1000000000), contract_error);
  EXPECT_THROW(derivatives(logistic, 1.5, 0), contract_error);
  EXPECT_THROW(derivatives(logistic, std::nan(""), 0), contract_error);
  EXPECT_THROW(logistic.numerator(), contract_error);
  EXPECT_THROW(trigonometric.smooth(), contract_error);
}

}  // namespace
}  // namespace patchproof::test
