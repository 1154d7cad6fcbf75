// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/fixed_integer.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

static_assert(Ring<FixedInteger<1>> && Ring<FixedInteger<4>> && !ExactRing<FixedInteger<4>> && !Field<FixedInteger<4>>);
static_assert(!std::constructible_from<FixedInteger<2>, double>, "no silent cutting off");
static_assert(!std::constructible_from<FixedInteger<1>, FixedInteger<2>>, "no silent narrowing");

Integer power(int k) { return Integer(1) << k; }

// The number of `limbs` words that is congruent to z.
Integer reduced(const Integer& z, int limbs) {
  Integer r;
  mpz_fdiv_r_2exp(r.backend().data(), z.backend().data(), 64ul * static_cast<unsigned long>(limbs));
  return r >= power(64 * limbs - 1) ? Integer(r - power(64 * limbs)) : r;
}

template <int N>
FixedInteger<N> fixed(const Integer& z) {
  FixedInteger<N> r;
  for (int i = 0; i < N; ++i) {
    Integer word;
    mpz_fdiv_q_2exp(word.backend().data(), z.backend().data(), 64ul * static_cast<unsigned long>(i));
    mpz_fdiv_r_2exp(word.backend().data(), word.backend().data(), 64);
    r.limb(i) = static_cast<std::uint64_t>(word);
  }
  return r;
}

template <int N>
Integer value(const FixedInteger<N>& x) {
  return embed<Integer>(x);
}

// The whole range: the ends, the ends of each word, and random numbers of every length.
template <int N>
std::vector<Integer> samples(WildNumbers& random) {
  std::vector<Integer> out{0, 1, -1, 2, -3, power(64 * N - 1) - 1, -power(64 * N - 1), 1 - power(64 * N - 1)};
  for (int k = 63; k < 64 * N - 1; k += k % 64 == 63 ? 1 : 63)
    for (const Integer& z : {power(k), Integer(power(k) - 1), Integer(-power(k)), Integer(-power(k) - 1)})
      out.push_back(z);
  for (int i = 0; i < 40; ++i) out.push_back(random.integer(1 + random.below(64 * N - 1)));
  return out;
}

template <class T>
class FixedIntegers : public ::testing::Test {};
using Widths = ::testing::Types<FixedInteger<1>, FixedInteger<2>, FixedInteger<3>, FixedInteger<5>, FixedInteger<8>>;
TYPED_TEST_SUITE(FixedIntegers, Widths);

template <int N>
constexpr int limbs_of(const FixedInteger<N>&) {
  return N;
}
template <class T>
constexpr int kLimbs = limbs_of(T());

TYPED_TEST(FixedIntegers, Law1_RingOperationsAgreeWithInteger) {
  constexpr int n = kLimbs<TypeParam>;
  WildNumbers random;
  const std::vector<Integer> all = samples<n>(random);
  for (const Integer& a : all) {
    const FixedInteger<n> x = fixed<n>(a);
    ASSERT_EQ(value(x), a);
    ASSERT_EQ(value(-x), reduced(-a, n));
    for (const Integer& b : all) {
      const FixedInteger<n> y = fixed<n>(b);
      ASSERT_EQ(value(x + y), reduced(a + b, n)) << a << " " << b;
      ASSERT_EQ(value(x - y), reduced(a - b, n)) << a << " " << b;
      ASSERT_EQ(value(x * y), reduced(a * b, n)) << a << " " << b;
    }
    FixedInteger<n> same = x;
    ASSERT_EQ(value(same += same), reduced(a + a, n));
    ASSERT_EQ(value(same -= same), Integer(0));
  }
}

template <int N, int M>
void expect_wide_products_exact() {
  WildNumbers random;
  const std::vector<Integer> left = samples<N>(random), right = samples<M>(random);
  for (const Integer& a : left)
    for (const Integer& b : right) {
      const FixedInteger<N> x = fixed<N>(a);
      const FixedInteger<M> y = fixed<M>(b);
      ASSERT_EQ(value(multiply_wide(x, y)), Integer(a * b)) << a << " " << b;
      const Integer s = random.integer(64 * (N + M + 1) - 1);
      FixedInteger<N + M + 1> sum = fixed<N + M + 1>(s);
      add_product(sum, x, y);
      ASSERT_EQ(value(sum), reduced(s + a * b, N + M + 1));
      FixedInteger<N + M> tight = fixed<N + M>(s);
      subtract_product(tight, x, y);
      ASSERT_EQ(value(tight), reduced(s - a * b, N + M));
      subtract_product(sum, x, y);
      ASSERT_EQ(value(sum), s);
    }
}

TEST(FixedInteger, Law2And3_WideProductsNeverOverflow) {
  expect_wide_products_exact<1, 1>();
  expect_wide_products_exact<2, 1>();
  expect_wide_products_exact<1, 3>();
  expect_wide_products_exact<2, 2>();
  expect_wide_products_exact<4, 3>();
  expect_wide_products_exact<6, 6>();
}

TEST(FixedInteger, Law2_ProductsByHalvesAreTheSame) {
  WildNumbers random;
  const detail::Word ones = ~detail::Word{0};
  EXPECT_EQ(detail::multiply_words_by_halves(ones, ones, ones, ones).high, ones);
  EXPECT_EQ(detail::multiply_words_by_halves(ones, ones, ones, ones).low, ones);
  for (int i = 0; i < 1000; ++i) {
    const auto word = [&] { return static_cast<detail::Word>(Integer(abs(random.integer(64)))) >> random.below(64); };
    const detail::Word a = word(), b = word(), c = word(), d = word();
    const detail::WordPair p = detail::multiply_words(a, b, c, d), q = detail::multiply_words_by_halves(a, b, c, d);
    ASSERT_EQ(Integer(q.high) * power(64) + Integer(q.low), Integer(a) * Integer(b) + Integer(c) + Integer(d));
    ASSERT_TRUE(p.low == q.low && p.high == q.high);
  }
}

TYPED_TEST(FixedIntegers, Law4_WideningKeepsTheValue) {
  constexpr int n = kLimbs<TypeParam>;
  WildNumbers random;
  for (const Integer& a : samples<n>(random)) {
    ASSERT_EQ(value(FixedInteger<n + 1>(fixed<n>(a))), a);
    ASSERT_EQ(value(FixedInteger<n + 4>(fixed<n>(a))), a);
  }
  EXPECT_EQ(value(FixedInteger<n>(-7)), -7);
  EXPECT_EQ(value(FixedInteger<n>(std::numeric_limits<std::int64_t>::min())), -power(63));
}

TYPED_TEST(FixedIntegers, Law5_Shifts) {
  constexpr int n = kLimbs<TypeParam>;
  WildNumbers random;
  for (const Integer& a : samples<n>(random))
    for (const int k : {0, 1, 31, 63, 64, 65, 127, 128, 64 * n - 1, random.below(64 * n)}) {
      if (k >= 64 * n) continue;
      Integer below;
      mpz_fdiv_q_2exp(below.backend().data(), a.backend().data(), static_cast<unsigned long>(k));
      ASSERT_EQ(value(fixed<n>(a) << k), reduced(a * power(k), n)) << a << " " << k;
      ASSERT_EQ(value(fixed<n>(a).shifted_down(k)), below) << a << " " << k;
    }
}

TYPED_TEST(FixedIntegers, Law6_SignAndSize) {
  constexpr int n = kLimbs<TypeParam>;
  WildNumbers random;
  for (const Integer& a : samples<n>(random)) {
    ASSERT_EQ(scalar_traits<FixedInteger<n>>::sign(fixed<n>(a)), scalar_traits<Integer>::sign(a)) << a;
    const int k = fixed<n>(a).magnitude_bits();
    ASSERT_TRUE(-power(k) <= a && a < power(k)) << a;
    if (k > 0) {
      ASSERT_FALSE(-power(k - 1) <= a && a < power(k - 1)) << a;
    }
  }
}

}  // namespace
}  // namespace patchproof::test
