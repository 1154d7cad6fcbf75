// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/cleared.h"

#include <chrono>

#include "support/scalars.h"

namespace patchproof::test {
namespace {

Rational fraction(int p, int q) { return Rational(p) / Rational(q); }

template <class T>
class ClearedNet : public ScalarTest<T> {};
TYPED_TEST_SUITE(ClearedNet, AllScalars, ScalarNames);

const std::vector<Rational> kParameters = {
    0, 1, fraction(1, 2), fraction(1, 3), fraction(-5, 7), fraction(22, 7), 1000000, fraction(123456789, 1000000007)};

TEST(Cleared, Law1_least_common_denominator) {
  const std::vector<Rational> values = {fraction(1, 6), fraction(-3, 4), Rational(0), Rational(5)};
  const auto cleared = clear_denominators(values);
  EXPECT_EQ(cleared.scale, 12);
  EXPECT_EQ(cleared.integers, (std::vector<Integer>{2, -9, 0, 60}));
  EXPECT_EQ(restore(cleared), values);

  const std::vector<Vec<Rational, 2>> points = {{{fraction(-1, 10), Rational(2)}}, {{fraction(7, 15), fraction(1, 4)}}};
  const auto net = clear_denominators(points);
  EXPECT_EQ(net.scale, 60);
  EXPECT_EQ(net.integers[0], (Vec<Integer, 2>{{-6, 120}}));
  EXPECT_EQ(net.integers[1], (Vec<Integer, 2>{{28, 15}}));
  EXPECT_EQ(restore(net), points);

  EXPECT_EQ(clear_denominators(std::vector<Rational>{}).scale, 1);
  EXPECT_EQ(clear_denominators(std::vector<Rational>{3, -4}).scale, 1);
}

TEST(Cleared, Law1_round_trip_of_random_data) {
  RandomRationals random;
  for (int i = 0; i < 50; ++i) {
    const auto points = random.points<4>(random.integer(1, 16));
    const auto net = clear_denominators(points);
    EXPECT_EQ(restore(net), points);
    EXPECT_GT(net.scale, 0);
    // Least: no prime can be taken out of scale and integers together.
    Integer common = net.scale;
    for (const auto& p : net.integers)
      for (const Integer& x : p.c) common = gcd(common, x);
    EXPECT_EQ(common, 1);
  }
  // Doubles and a wide range of sizes.
  const std::vector<Rational> wild = {from_double(0.1), from_double(0x1p-1074), from_double(0x1.fffffffffffffp+1023)};
  EXPECT_EQ(restore(clear_denominators(wild)), wild);
  EXPECT_EQ(clear_denominators(wild).scale, Integer(1) << 1074);
}

TEST(Cleared, Law2_homogeneous_de_casteljau_is_the_sum) {
  RandomRationals random;
  for (int degree = 0; degree <= 6; ++degree) {
    const std::vector<Rational> b = random.numbers(degree + 1);
    const Rational s = random(), t = random();
    Rational sum(0);
    const std::vector<Rational> binomials = binomial_row<Rational>(degree);
    for (int i = 0; i <= degree; ++i) {
      Rational term = binomials[i] * b[i];
      for (int k = 0; k < degree - i; ++k) term = term * s;
      for (int k = 0; k < i; ++k) term = term * t;
      sum += term;
    }
    EXPECT_EQ(homogeneous_de_casteljau(b, s, t), sum);
    EXPECT_EQ(homogeneous_de_casteljau(b, Rational(1 - t), t), de_casteljau(b, t));
  }
}

TYPED_TEST(ClearedNet, Law2_in_every_scalar) {
  RandomRationals random;
  for (int degree = 0; degree <= 6; ++degree) {
    const auto b = random.points<3>(degree + 1);
    const Rational s = random.unit(), t = random.unit();
    check<TypeParam>(homogeneous_de_casteljau(b, s, t),
                     [&]<class S>() { return homogeneous_de_casteljau(make_points<S>(b), make<S>(s), make<S>(t)); });
  }
}

TEST(Cleared, Law3_integers_answer_like_rationals) {
  RandomRationals random;
  for (int degree = 0; degree <= 8; ++degree) {
    const auto numbers = random.numbers(degree + 1);
    const auto points = random.points<3>(degree + 1);
    const auto cleared_numbers = clear_denominators(numbers);
    const auto cleared_points = clear_denominators(points);
    for (const Rational& t : kParameters) {
      EXPECT_EQ(evaluate(cleared_numbers, t), de_casteljau(numbers, t));
      EXPECT_EQ(evaluate(cleared_points, t), de_casteljau(points, t));
    }
  }
}

// What the integers are for; the figures are recorded, not judged.
TEST(Cleared, Speed_is_recorded) {
  RandomRationals random;
  const auto points = random.points<3>(6);
  const auto cleared = clear_denominators(points);
  std::vector<Rational> parameters;
  for (int i = 0; i < 500; ++i) parameters.push_back(fraction(i, 997));
  const auto seconds = [&](auto&& evaluate_at) {
    const auto start = std::chrono::steady_clock::now();
    Rational sum(0);
    for (const Rational& t : parameters) sum = evaluate_at(t)[0];
    return std::pair(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), sum);
  };
  const auto [rational_time, rational] = seconds([&](const Rational& t) { return de_casteljau(points, t); });
  const auto [integer_time, integer] = seconds([&](const Rational& t) { return evaluate(cleared, t); });
  EXPECT_EQ(integer, rational);
  RecordProperty("rational_over_integer", std::to_string(rational_time / integer_time));
  std::printf("degree 5 in space: Integer %.1f times as fast as Rational\n", rational_time / integer_time);
}

TEST(Cleared, Contracts) {
  EXPECT_THROW(homogeneous_de_casteljau(std::vector<Rational>{}, Rational(1), Rational(1)), contract_error);
  EXPECT_THROW(evaluate(clear_denominators(std::vector<Rational>{}), Rational(1)), contract_error);
}

}  // namespace
}  // namespace patchproof::test
