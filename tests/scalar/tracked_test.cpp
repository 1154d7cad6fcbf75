// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/tracked.h"

#include <gtest/gtest.h>

#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

// A Tracked number and a true number within its bound.
struct Pair {
  Tracked tracked;
  Rational exact;
};

void expect_bound(const Tracked& t, const Rational& exact) {
  if (t.error() == kInfinity || !std::isfinite(t.value())) return;
  EXPECT_LE(abs(Rational(from_double(t.value()) - exact)), from_double(t.error()))
      << t.value() << " ± " << t.error() << " misses " << exact;
}

// Value and error of independent sizes; the true value at one end of the bound, or anywhere between.
Pair random_pair(WildNumbers& random, double value, double error) {
  const Rational share = Rational(random.below(9) - 4) / Rational(4);
  return {Tracked(value, error), from_double(value) + share * from_double(error)};
}

// All four operations: the value is that of double, and the bound holds in exact arithmetic.
void expect_laws(const Pair& a, const Pair& b) {
  const double x = a.tracked.value(), y = b.tracked.value();
  const Tracked sum = a.tracked + b.tracked, difference = a.tracked - b.tracked, product = a.tracked * b.tracked,
                quotient = a.tracked / b.tracked;
  const auto same = [](double p, double q) {
    return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q) || (std::isnan(p) && std::isnan(q));
  };
  EXPECT_TRUE(same(sum.value(), x + y) && same(difference.value(), x - y) && same(product.value(), x * y) &&
              same(quotient.value(), x / y) && same((-a.tracked).value(), -x));
  expect_bound(sum, a.exact + b.exact);
  expect_bound(difference, a.exact - b.exact);
  expect_bound(product, a.exact * b.exact);
  expect_bound(-a.tracked, -a.exact);
  if (b.exact != 0) expect_bound(quotient, a.exact / b.exact);
}

TEST(TrackedLaws, Law12_DoubleBitForBitAndTheBoundHolds) {
  WildNumbers random;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.moderate(), y = random.moderate();
    const double dx = std::fabs(std::ldexp(x, -random.below(60))), dy = std::fabs(std::ldexp(y, -random.below(60)));
    expect_laws(random_pair(random, x, random.below(3) ? dx : 0), random_pair(random, y, random.below(3) ? dy : 0));
  }
}

TEST(TrackedLaws, Law12_AnyExponents) {
  WildNumbers random;
  for (int i = 0; i < 20000; ++i) {
    const double dx = std::fabs(random.finite()), dy = std::fabs(random.finite());
    const double x = random.finite(), y = random.finite();
    expect_laws(random_pair(random, x, random.below(2) ? dx : 0), random_pair(random, y, random.below(2) ? dy : 0));
  }
}

TEST(TrackedLaws, Law12_Subnormals) {
  WildNumbers random;
  const auto tiny = [&](int spread) { return random.moderate(4) * std::ldexp(1.0, -1074 + random.below(spread)); };
  const auto some = [&](int spread) { return random.below(3) ? std::fabs(tiny(spread)) : 0.0; };
  for (int i = 0; i < 20000; ++i) {
    expect_laws(random_pair(random, tiny(80), some(60)), random_pair(random, tiny(80), some(60)));
    expect_laws(random_pair(random, tiny(80), some(60)), random_pair(random, random.moderate(4), some(1074)));
    const double root = std::ldexp(random.moderate(4), -511 - random.below(30));  // products around 2^-1022
    expect_laws(random_pair(random, root, some(600)), random_pair(random, random.moderate(4) * 0x1p-511, some(600)));
  }
}

TEST(TrackedLaws, Law2_ProductsThatRoundToTheSmallestNormal) {
  // (1 + 2^-52)(1 − 2^-52) = 1 − 2^-104 rounds to 1: exactly on the border of underflow, and not exact.
  const double above = std::ldexp(1 + 0x1p-52, -511), below = std::ldexp(1 - 0x1p-52, -511);
  EXPECT_EQ(above * below, kSmallestNormal);
  expect_laws({Tracked(above), from_double(above)}, {Tracked(below), from_double(below)});
  EXPECT_GT((Tracked(above) * Tracked(below)).error(), 0);
}

TEST(TrackedLaws, Law2_UncertainDivisors) {
  WildNumbers random;
  // The divisor is known to a few last places only, so errors are magnified; the quotient underflows.
  for (int i = 0; i < 20000; ++i) {
    const double b = std::fabs(random.moderate(4)) * std::ldexp(1.0, -random.below(1000));
    const double known = b * (1 - std::ldexp(1.0, -1 - random.below(49)));
    for (double a : {kTiniest, 5 * kTiniest, b * 0x1p-1000, b, random.finite()})
      expect_laws(random_pair(random, a, random.below(2) ? kTiniest : 0), random_pair(random, b, known));
  }
  EXPECT_EQ((Tracked(1.0) / Tracked(0.0)).error(), kInfinity);
  EXPECT_EQ((Tracked(1.0) / Tracked(1.0, 1.0)).error(), kInfinity);
  EXPECT_EQ((Tracked(1.0) / Tracked(1.0, 2.0)).error(), kInfinity);
  EXPECT_EQ((Tracked(0.0) / Tracked(0.0)).error(), kInfinity);
}

TEST(TrackedLaws, Law2_NothingIsKnownAfterOverflow) {
  const Tracked huge(kLargest), unknown = Tracked(1.0) / Tracked(0.0, 1.0), zero;
  for (const Tracked& t :
       {huge + huge, huge * huge, huge / Tracked(kTiniest), huge * huge - huge * huge, zero * unknown, unknown * zero,
        unknown - unknown, zero * (huge * huge), unknown / huge, huge / unknown}) {
    EXPECT_EQ(t.error(), kInfinity);
    EXPECT_EQ(scalar_traits<Tracked>::sign(t), std::nullopt);
  }
  EXPECT_THROW(Tracked(1.0, -1.0), contract_error);
  EXPECT_THROW(Tracked(1.0, std::nan("")), contract_error);
}

TEST(TrackedLaws, Law2_ExactZerosStayExact) {
  const Tracked zero, x(0.1, 0.001);
  for (const Tracked& t : {zero * x, x * zero, zero / Tracked(3.0), zero + zero, zero - zero}) {
    EXPECT_EQ(t.value(), 0);
    EXPECT_EQ(t.error(), 0);
    EXPECT_EQ(scalar_traits<Tracked>::sign(t), Sign::zero);
  }
}

TEST(TrackedLaws, Law2_BoundsAreNotIdle) {
  // The bound of one rounded operation on exact inputs is at most 1 unit in the last place, not merely some number.
  WildNumbers random;
  for (int i = 0; i < 1000; ++i) {
    const double x = random.moderate(), y = random.moderate();
    if (x == 0 || y == 0) continue;
    for (const Tracked& t : {Tracked(x) + Tracked(y), Tracked(x) * Tracked(y), Tracked(x) / Tracked(y)})
      EXPECT_LE(t.error(), std::fabs(t.value()) * 0x1.00001p-53 + 2 * kTiniest);
  }
}

TEST(TrackedLaws, Law12_LongComputations) {
  WildNumbers random;
  for (int i = 0; i < 500; ++i) {  // Horner, then a quotient and a cancellation
    Tracked t(random.moderate(3)), x(random.moderate(2));
    double value = t.value();
    Rational exact = from_double(value);
    for (int k = 0; k < 12; ++k) {
      const double c = random.moderate(3);
      t = t * x + Tracked(c);
      value = value * x.value() + c;
      exact = exact * from_double(x.value()) + from_double(c);
    }
    const Tracked result = (t - Tracked(value)) + t / Tracked(3.0);
    EXPECT_EQ(result.value(), (value - value) + value / 3.0);
    expect_bound(t, exact);
    expect_bound(result, exact - from_double(value) + exact / Rational(3));
  }
}

TEST(Tracked, EmbeddingOfRationals) {
  WildNumbers random;
  for (int i = 0; i < 3000; ++i) {
    const Rational x = scaled(random.rational(70), random.below(2120) - 1090);
    expect_bound(embed<Tracked>(x), x);
    const double d = random.finite();
    EXPECT_EQ(embed<Tracked>(from_double(d)).error(), 0);
  }
  for (long e = -1080; e < -1070; ++e) expect_bound(embed<Tracked>(power_of_two(e)), power_of_two(e));
}

TEST(Tracked, SignOnlyWhenCertain) {
  using traits = scalar_traits<Tracked>;
  EXPECT_EQ(traits::sign(Tracked(1.0, 0.5)), Sign::positive);
  EXPECT_EQ(traits::sign(Tracked(-1.0, 0.5)), Sign::negative);
  EXPECT_EQ(traits::sign(Tracked(1.0, 1.0)), std::nullopt);
  EXPECT_EQ(traits::sign(Tracked(0.0, kTiniest)), std::nullopt);
  EXPECT_EQ(traits::sign(Tracked(0.0)), Sign::zero);
}

}  // namespace
}  // namespace patchproof::test
