// SPDX-License-Identifier: Apache-2.0
// Values and derivatives of basis functions, found by an independent program in fractions: exactly equal in Rational, within
// their bounds in the other scalars.
#include <gtest/gtest.h>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/bspline_basis.h"
#include "support/lar_curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

struct Row {
  int degree;
  const char *knots, *t;
  char side;
  int order;
  const char* values;
};

constexpr Row rows[] = {
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "0", 'R', 0, "1 0 0 0 0 0 0 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "1/2", 'R', 0, "1/4 1/2 1/4 0 0 0 0 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "1", 'R', 0, "0 0 1 0 0 0 0 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "5/4", 'R', 0, "0 0 9/16 3/8 1/16 0 0 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "2", 'R', 0, "0 0 0 0 1 0 0 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "7/3", 'R', 0, "0 0 0 0 4/9 4/9 1/9 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "3", 'R', 0, "0 0 0 0 0 0 1 0 0"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "15/4", 'R', 0, "0 0 0 0 0 0 1/16 3/8 9/16"},
    {2, "0 0 0 1 1 2 2 3 3 4 4 4", "4", 'L', 0, "0 0 0 0 0 0 0 0 1"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "0", 'R', 0, "1 0 0 0 0 0 0 0"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "1/2", 'R', 0, "1/8 19/32 25/96 1/48 0 0 0 0"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "1", 'R', 0, "0 1/4 7/12 1/6 0 0 0 0"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "5/2", 'R', 0, "0 0 1/48 23/48 23/48 1/48 0 0"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "3", 'R', 0, "0 0 0 1/6 2/3 1/6 0 0"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "14/3", 'R', 0, "0 0 0 0 1/162 43/324 61/108 8/27"},
    {3, "0 0 0 0 1 2 3 4 5 5 5 5", "5", 'L', 0, "0 0 0 0 0 0 0 1"},
    {2, "0 1 2 3 4 5 6 7", "2", 'R', 0, "1/2 1/2 0 0 0"},
    {2, "0 1 2 3 4 5 6 7", "5/2", 'R', 0, "1/8 3/4 1/8 0 0"},
    {2, "0 1 2 3 4 5 6 7", "3", 'R', 0, "0 1/2 1/2 0 0"},
    {2, "0 1 2 3 4 5 6 7", "5", 'L', 0, "0 0 0 1/2 1/2"},
    {3, "0 0 0 0 1 1 1 1", "0", 'R', 0, "1 0 0 0"},
    {3, "0 0 0 0 1 1 1 1", "0", 'R', 1, "-3 3 0 0"},
    {3, "0 0 0 0 1 1 1 1", "0", 'R', 2, "6 -12 6 0"},
    {3, "0 0 0 0 1 1 1 1", "1/4", 'R', 0, "27/64 27/64 9/64 1/64"},
    {3, "0 0 0 0 1 1 1 1", "1/4", 'R', 1, "-27/16 9/16 15/16 3/16"},
    {3, "0 0 0 0 1 1 1 1", "1/4", 'R', 2, "9/2 -15/2 3/2 3/2"},
    {3, "0 0 0 0 1 1 1 1", "1/3", 'R', 0, "8/27 4/9 2/9 1/27"},
    {3, "0 0 0 0 1 1 1 1", "1/3", 'R', 1, "-4/3 0 1 1/3"},
    {3, "0 0 0 0 1 1 1 1", "1/3", 'R', 2, "4 -6 0 2"},
    {3, "0 0 0 0 1 1 1 1", "1/2", 'R', 0, "1/8 3/8 3/8 1/8"},
    {3, "0 0 0 0 1 1 1 1", "1/2", 'R', 1, "-3/4 -3/4 3/4 3/4"},
    {3, "0 0 0 0 1 1 1 1", "1/2", 'R', 2, "3 -3 -3 3"},
    {3, "0 0 0 0 1 1 1 1", "1", 'R', 0, "0 0 0 1"},
    {3, "0 0 0 0 1 1 1 1", "1", 'R', 1, "0 0 -3 3"},
    {3, "0 0 0 0 1 1 1 1", "1", 'R', 2, "0 6 -12 6"},
    {4, "0 0 0 0 0 1 1 1 1 1", "0", 'R', 0, "1 0 0 0 0"},
    {4, "0 0 0 0 0 1 1 1 1 1", "0", 'R', 1, "-4 4 0 0 0"},
    {4, "0 0 0 0 0 1 1 1 1 1", "0", 'R', 2, "12 -24 12 0 0"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/4", 'R', 0, "81/256 27/64 27/128 3/64 1/256"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/4", 'R', 1, "-27/16 0 9/8 1/2 1/16"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/4", 'R', 2, "27/4 -9 -3/2 3 3/4"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/3", 'R', 0, "16/81 32/81 8/27 8/81 1/81"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/3", 'R', 1, "-32/27 -16/27 8/9 20/27 4/27"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/3", 'R', 2, "16/3 -16/3 -4 8/3 4/3"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/2", 'R', 0, "1/16 1/4 3/8 1/4 1/16"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/2", 'R', 1, "-1/2 -1 0 1 1/2"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1/2", 'R', 2, "3 0 -6 0 3"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1", 'R', 0, "0 0 0 0 1"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1", 'R', 1, "0 0 0 -4 4"},
    {4, "0 0 0 0 0 1 1 1 1 1", "1", 'R', 2, "0 0 12 -24 12"},
};

template <class T>
class ReferenceBasis : public ScalarTest<T> {};
TYPED_TEST_SUITE(ReferenceBasis, AllScalars, ScalarNames);

TYPED_TEST(ReferenceBasis, EveryFunctionAtEveryPlace) {
  for (const Row& row : rows) {
    SCOPED_TRACE(std::string(row.knots) + " at " + row.t);
    const auto knots = KnotVector<Rational>::make(row.degree, numbers_of(row.knots)).value();
    const Rational t = numbers_of(row.t)[0];
    const int span = knots.find_span(t, row.side == 'L' ? Side::left : Side::right), first = span - row.degree;
    const std::vector<Rational> all = numbers_of(row.values);
    for (int i = 0; i < static_cast<int>(all.size()); ++i) {
      if (i < first || i > span) {
        EXPECT_EQ(all[i], 0);
      }
    }
    check<TypeParam>(std::vector<Rational>(all.begin() + first, all.begin() + span + 1),
                     [&]<class S>() { return basis_derivative_in_span<S>(knots, span, make<S>(t), row.order); });
  }
}

TEST(ReferenceBasisExact, BezierKnotsGiveBernsteinPolynomials) {
  for (const Row& row : rows) {
    const std::vector<Rational> knots = numbers_of(row.knots), all = numbers_of(row.values);
    if (static_cast<int>(knots.size()) != 2 * row.degree + 2) continue;
    EXPECT_EQ(bernstein_basis_derivative(row.degree, row.order, numbers_of(row.t)[0]), all);
  }
}

}  // namespace
}  // namespace patchproof::test
