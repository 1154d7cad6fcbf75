// SPDX-License-Identifier: Apache-2.0
// Which types the concepts accept and, more important, which they refuse.
#include "patchproof/scalar/concepts.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/scalar/tracked.h"

namespace patchproof {

// Componentwise arithmetic, as a SIMD register has it: no order, no sign, no conversion from int.
struct TwoLanes {
  std::array<double, 2> x{};
  explicit TwoLanes(double a) : x{a, a} {}
  friend TwoLanes operator+(TwoLanes a, TwoLanes b) { return a.x[0] += b.x[0], a.x[1] += b.x[1], a; }
  friend TwoLanes operator-(TwoLanes a, TwoLanes b) { return a.x[0] -= b.x[0], a.x[1] -= b.x[1], a; }
  friend TwoLanes operator*(TwoLanes a, TwoLanes b) { return a.x[0] *= b.x[0], a.x[1] *= b.x[1], a; }
};

// Opted in and able to do everything, but its product is a proxy, as in libraries with expression templates.
struct Lazy {
  Lazy() = default;
  explicit Lazy(int) {}
  struct Product {};
  friend Lazy operator+(Lazy, Lazy) { return {}; }
  friend Lazy operator-(Lazy, Lazy) { return {}; }
  friend Product operator*(Lazy, Lazy) { return {}; }
  friend Lazy operator-(Lazy) { return {}; }
  Lazy& operator+=(Lazy) { return *this; }
};
template <>
struct scalar_traits<Lazy> {
  static constexpr bool is_exact = true, is_field = true, is_ordered = true;
  static std::optional<Sign> sign(const Lazy&) { return Sign::zero; }
  using knot_scalar = double;
};

namespace {

template <class T>
constexpr int kRank = ExactField<T>     ? 4
                      : OrderedField<T> ? 3
                      : Field<T>        ? 2
                      : Ring<T>         ? 1
                                        : 0;

// Accepted, and no further than this.
static_assert(kRank<Rational> == 4 && ExactRing<Rational>);
static_assert(kRank<Quadratic> == 4 && ExactRing<Quadratic>);
static_assert(kRank<Integer> == 1 && ExactRing<Integer>, "Integer divides by cutting off: no Field");
static_assert(kRank<double> == 3 && !ExactRing<double>);
static_assert(kRank<Interval> == 2 && !ExactRing<Interval>, "an interval cannot answer == or <");
static_assert(kRank<Ball> == 2 && !ExactRing<Ball>);
static_assert(kRank<Tracked> == 2 && !ExactRing<Tracked>);
static_assert(!std::equality_comparable<Interval> && !std::equality_comparable<Ball> &&
              !std::equality_comparable<Tracked>);
static_assert(Lane<double> && Lane<TwoLanes> && Lane<Tracked> && Lane<Interval>);
static_assert(!Ring<TwoLanes>, "lanes have no sign");

// Refused.
static_assert(kRank<float> == 0 && kRank<long double> == 0 && kRank<int> == 0 && kRank<long> == 0 && kRank<bool> == 0);
static_assert(kRank<std::complex<double>> == 0);
static_assert(kRank<boost::multiprecision::mpq_rational> == 0, "expression templates");
static_assert(kRank<boost::multiprecision::mpz_int> == 0, "expression templates");
static_assert(kRank<CGAL::Gmpq> == 0 && kRank<CGAL::Interval_nt<true>> == 0, "not opted in");
static_assert(kRank<CGAL::Interval_nt_advanced> == 0, "not opted in: its default value is undefined");
static_assert(kRank<Lazy> == 0, "a product that is not a Lazy");
static_assert(kRank<const double*> == 0 && kRank<void> == 0 && kRank<double&> == 0);

// Conversions have names: nothing turns into a wider scalar by itself, and nothing turns into a narrower one at all.
static_assert(!std::is_convertible_v<double, Interval> && !std::is_convertible_v<double, Tracked> &&
              !std::is_convertible_v<double, Quadratic> && !std::is_convertible_v<double, Ball>);
static_assert(!std::is_convertible_v<Rational, Quadratic> && !std::is_convertible_v<Rational, Interval> &&
              !std::is_convertible_v<Rational, double> && !std::is_convertible_v<Interval, double>);
template <class To, class From>
concept Embeds = requires(const From x) {
  embedding<To, From>::apply(x);
};
static_assert(Embeds<Rational, double> && Embeds<Interval, double> && Embeds<Interval, Rational> &&
              Embeds<Interval, Integer> && Embeds<Interval, Quadratic> && Embeds<Ball, Rational> &&
              Embeds<Ball, Interval> && Embeds<Quadratic, Rational> && Embeds<Rational, Integer> &&
              Embeds<Tracked, double> && Embeds<Tracked, Rational>);
static_assert(!Embeds<Rational, Interval> && !Embeds<double, Interval> && !Embeds<double, Tracked> &&
              !Embeds<Rational, Quadratic> && !Embeds<Integer, Rational> && !Embeds<Interval, Ball>);

static_assert(std::is_same_v<knot_scalar_t<Integer>, Rational> && std::is_same_v<knot_scalar_t<Interval>, Rational> &&
              std::is_same_v<knot_scalar_t<Quadratic>, Quadratic> && std::is_same_v<knot_scalar_t<double>, double>);
static_assert(OrderedField<knot_scalar_t<Ball>> && OrderedField<knot_scalar_t<Tracked>> &&
              OrderedField<knot_scalar_t<Integer>>);

template <class T>
class Scalars : public ::testing::Test {};
using All = ::testing::Types<Rational, Integer, Quadratic, Interval, Ball, Tracked, double>;
TYPED_TEST_SUITE(Scalars, All);

// vec.h counts on it.
TYPED_TEST(Scalars, DefaultValueIsZero) {
  using T = TypeParam;
  const T x{};
  if constexpr (std::is_same_v<T, double>)
    EXPECT_EQ(x, 0);
  else
    EXPECT_EQ(scalar_traits<T>::sign(x), Sign::zero);
}

TYPED_TEST(Scalars, SignOfWholeNumbers) {
  using T = TypeParam;
  if constexpr (std::is_same_v<T, double>) {
    EXPECT_EQ(scalar_traits<double>::sign(1.0), std::nullopt) << "a rounded number proves nothing";
  } else {
    EXPECT_EQ(scalar_traits<T>::sign(T(7)), Sign::positive);
    EXPECT_EQ(scalar_traits<T>::sign(T(-7)), Sign::negative);
    EXPECT_EQ(scalar_traits<T>::sign(T(0)), Sign::zero);
  }
}

TYPED_TEST(Scalars, EmbeddingIntoItselfIsTheIdentity) {
  using T = TypeParam;
  const T x(5);
  const T y = embed<T>(x);
  if constexpr (!std::is_same_v<T, double>)
    EXPECT_EQ(scalar_traits<T>::sign(y), Sign::positive);
  else
    EXPECT_EQ(y, 5);
}

}  // namespace
}  // namespace patchproof
