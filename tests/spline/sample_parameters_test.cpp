// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/sample_parameters.h"

#include <gtest/gtest.h>

#include <limits>

#include "patchproof/spline/least_squares.h"
#include "support/lar_curves.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class SampleParameters : public ScalarTest<T> {};
TYPED_TEST_SUITE(SampleParameters, ExactScalars, ScalarNames);

TYPED_TEST(SampleParameters, Law1_UniformKnots) {
  using T = TypeParam;
  EXPECT_EQ(uniform_clamped_knots<T>(3, 8).value().knots(), make_numbers<T>(numbers_of("0 0 0 0 1 2 3 4 5 5 5 5")));
  EXPECT_EQ(uniform_clamped_knots<T>(2, 4, make<T>("-1/3"_q), make<T>(1)).value().knots(),
            make_numbers<T>(numbers_of("-1/3 -1/3 -1/3 1/3 1 1 1")));
  EXPECT_EQ(uniform_clamped_knots<T>(0, 3).value().knots(), make_numbers<T>(numbers_of("0 1 2 3")));
  EXPECT_EQ(uniform_clamped_knots<T>(4, 5).value(), KnotVector<T>::bezier(4));
  EXPECT_EQ(uniform_clamped_knots<T>(-1, 5).error().code, ErrorCode::bad_degree);
  EXPECT_EQ(uniform_clamped_knots<T>(3, 3).error().code, ErrorCode::wrong_count);
  EXPECT_THROW((uniform_clamped_knots<T>(3, 4, T(1), T(1)).has_value()), contract_error);
}

TYPED_TEST(SampleParameters, Law2_UniformParameters) {
  using T = TypeParam;
  EXPECT_EQ(uniform_parameters(4, T(1), T(2)).value(), make_numbers<T>(numbers_of("1 4/3 5/3 2")));
  EXPECT_EQ(uniform_parameters(2, T(-1), T(2)).value(), make_numbers<T>(numbers_of("-1 2")));
}

// E-GERBS-04: with the printed spacing (t_n − t_d)/(m − 1), one sample divides by zero.
TYPED_TEST(SampleParameters, Erratum_E_GERBS_04_OneSampleHasNoStep) {
  using T = TypeParam;
  for (const std::size_t samples : {0u, 1u})
    EXPECT_EQ(uniform_parameters(samples, T(0), T(5)).error().code, ErrorCode::wrong_count);
}

TYPED_TEST(SampleParameters, Law3_ChordLength) {
  using T = TypeParam;
  const auto points = make_points<T>(points_of("0 0  3 4  3 4  3 9"));
  EXPECT_EQ(chord_length_parameters(points, T(0), T(1)).value(), make_numbers<T>(numbers_of("0 1/2 1/2 1")));
  EXPECT_EQ(chord_length_parameters(points, T(2), T(4)).value(), make_numbers<T>(numbers_of("2 3 3 4")));
  EXPECT_EQ(chord_length_parameters(make_points<T>(points_of("1 1  1 1")), T(0), T(1)).error().code,
            ErrorCode::singular_fit);
  EXPECT_EQ(chord_length_parameters(make_points<T>(points_of("1 1")), T(0), T(1)).error().code, ErrorCode::wrong_count);
}

TYPED_TEST(SampleParameters, Law3_ChordLengthNeverDecreases) {
  using T = TypeParam;
  RandomRationals random;
  const auto points = make_points<T>(random.points<3>(60));
  const auto at = chord_length_parameters(points, T(0), T(1)).value();
  EXPECT_EQ(at.front(), T(0));
  EXPECT_EQ(at.back(), T(1));
  EXPECT_TRUE(std::is_sorted(at.begin(), at.end()));
}

TYPED_TEST(SampleParameters, Law3_TooLongForDoubles) {
  using T = TypeParam;
  const T far = make<T>(from_double(std::numeric_limits<double>::max()));
  const std::vector<Vec<T, 1>> points{{{-far}}, {{far}}};
  EXPECT_EQ(chord_length_parameters(points, T(0), T(1)).error().code, ErrorCode::bad_number);
  const std::vector<Vec<T, 1>> back{{{T(0)}}, {{far}}, {{T(0)}}, {{far}}};
  EXPECT_EQ(chord_length_parameters(back, T(0), T(1)).error().code, ErrorCode::bad_number);
}

TYPED_TEST(SampleParameters, Law4_DeBoorsAverages) {
  using T = TypeParam;
  EXPECT_EQ(averaged_knots<T>(3, 7, make_numbers<T>(numbers_of("0 1 4 5 7 8 10"))).value().knots(),
            make_numbers<T>(numbers_of("0 0 0 0 10/3 16/3 20/3 10 10 10 10")));
  EXPECT_EQ(averaged_knots<T>(1, 3, make_numbers<T>(numbers_of("2 0 1/2 1/2"))).value().knots(),
            make_numbers<T>(numbers_of("0 0 1/2 2 2")));
  EXPECT_EQ(averaged_knots<T>(0, 3, make_numbers<T>(numbers_of("0 1 3"))).value().knots(),
            make_numbers<T>(numbers_of("0 1/2 2 3")));
  EXPECT_EQ(averaged_knots<T>(2, 3, make_numbers<T>(numbers_of("0 1 1"))).error().code, ErrorCode::wrong_count);
  EXPECT_EQ(averaged_knots<T>(0, 1, make_numbers<T>(numbers_of("1 1"))).error().code, ErrorCode::wrong_count);
  EXPECT_EQ(averaged_knots<T>(0, 1, make_numbers<T>(numbers_of("1 2"))).value().knots(),
            make_numbers<T>(numbers_of("1 2")));
}

TYPED_TEST(SampleParameters, Law4_NeverSingular) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 60; ++round) {
    const int degree = random.integer(0, 5), count = degree + random.integer(1, 8);
    std::vector<Rational> at = random.numbers(count + random.integer(1, 30));
    std::vector<Rational> different = at;
    std::sort(different.begin(), different.end());
    different.erase(std::unique(different.begin(), different.end()), different.end());
    const auto knots = averaged_knots<T>(degree, count, make_numbers<T>(at));
    ASSERT_EQ(knots.has_value(), different.size() >= 2 && static_cast<int>(different.size()) >= count);
    if (knots) {
      EXPECT_TRUE(match_samples(*knots, make_numbers<T>(at)).has_value());
    }
  }
}

}  // namespace
}  // namespace patchproof::test
