// SPDX-License-Identifier: Apache-2.0
// Time limits, counted in looks at them instead of seconds: the same on every machine.
#include "patchproof/deadline.h"

#include <gtest/gtest.h>

#include "patchproof/join/certify.h"
#include "patchproof/join/trimmed_join.h"
#include "patchproof/parallel.h"
#include "support/broken_joins.h"
#include "support/certificates.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

TEST(Deadline, Law1_LimitsHoldForTheirScope) {
  EXPECT_FALSE(has_deadline_passed());
  EXPECT_NO_THROW(check_deadline());
  {
    const DeadlineScope past(DeadlineScope::Clock::now() - std::chrono::seconds(1));
    EXPECT_THROW(check_deadline(), deadline_passed);
    const DeadlineScope later(seconds_from_now(1000));  // the outer limit holds on
    EXPECT_TRUE(has_deadline_passed());
  }
  EXPECT_FALSE(has_deadline_passed());
  const DeadlineScope future(seconds_from_now(1e300));
  EXPECT_NO_THROW(check_deadline());
}

TEST(Deadline, Law2_ChecksAreCounted) {
  const auto scope = DeadlineScope::after_checks(3);
  for (int i = 0; i < 3; ++i) EXPECT_NO_THROW(check_deadline());
  for (int i = 0; i < 3; ++i) EXPECT_THROW(check_deadline(), deadline_passed);
  EXPECT_EQ(scope.checks(), 6);
}

TEST(Deadline, Law3_ARaisedFlagStopsItsThreadAndTheThreadsItUses) {
  std::atomic<bool> flag{false};
  {
    const StopScope scope(&flag);
    EXPECT_FALSE(has_deadline_passed());
    const StopScope none(nullptr);  // the innermost counts
    flag = true;
    EXPECT_FALSE(has_deadline_passed());
  }
  {
    const StopScope scope(&flag);
    EXPECT_THROW(check_deadline(), deadline_passed);
    EXPECT_TRUE(DeadlineScope::has_passed());
    EXPECT_THROW(for_each_item(2, 5, [](std::size_t) { FAIL() << "an item began"; }), stop_requested);
  }
  EXPECT_FALSE(has_deadline_passed());

  flag = false;
  const StopScope scope(&flag);
  std::atomic<int> begun{0}, stopped{0};
  EXPECT_THROW(for_each_item(2, 1000,
                             [&](std::size_t) {
                               if (++begun == 10) flag = true;
                               if (has_deadline_passed()) ++stopped;
                             }),
               stop_requested);
  EXPECT_GE(stopped, 1);
  EXPECT_LT(begun, 1000);
}

TEST(ForEachItem, Law1_EveryItemOnce) {
  for (const int jobs : {0, 1, 3}) {
    std::vector<std::atomic<int>> calls(1000);
    for_each_item(jobs, calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& n : calls) EXPECT_EQ(n, 1);
  }
  for_each_item(0, 0, [](std::size_t) { FAIL(); });
  EXPECT_THROW(for_each_item(-1, 1, [](std::size_t) {}), contract_error);
}

TEST(ForEachItem, Law2_WhatAnItemThrowsComesOut) {
  EXPECT_THROW(for_each_item(2, 100,
                             [](std::size_t i) {
                               if (i == 7) throw std::out_of_range("7");
                             }),
               std::out_of_range);
}

// Two polynomials of degree 20 with a common factor of degree 10.
std::pair<BinaryForm<Rational>, BinaryForm<Rational>> with_common_factor() {
  RandomRationals random;
  const auto form = [&] {
    std::vector<Rational> a;
    for (int i = 0; i <= 10; ++i) a.push_back(random.point<1>()[0]);
    return BinaryForm<Rational>(a);
  };
  const auto common = form();
  return {common * form(), common * form()};
}

TEST(Deadline, AGreatestCommonDivisorStopsAtTheNextCheck) {
  const auto [f, g] = with_common_factor();
  long all = 0;
  {
    const auto scope = DeadlineScope::after_checks(1'000'000);
    EXPECT_EQ(gcd(f, g).degree(), 10);
    all = scope.checks();
  }
  // Ten remainders, each with a look for every coefficient: no step between two looks is longer than a coefficient's.
  EXPECT_GE(all, 10 * 10);
  for (long checks = 0; checks < all; ++checks) {
    const auto scope = DeadlineScope::after_checks(checks);
    EXPECT_THROW((void)gcd(f, g), deadline_passed);
    EXPECT_EQ(scope.checks(), checks + 1);
  }
}

void expect_consistent(const ExactClass& quick, const ExactClass& full) {
  if (quick.verdict == Verdict::undecided) {
    EXPECT_NE(quick.reason, "");
  } else {
    EXPECT_EQ(quick.verdict, full.verdict);
  }
}
void expect_wider(const EnclosedMaximum& quick, const EnclosedMaximum& full) {
  EXPECT_LE(quick.lower, full.upper);
  EXPECT_LE(full.lower, quick.upper);
}
void expect_consistent(const Certificate& quick, const Certificate& full) {
  expect_consistent(quick.c0, full.c0);
  expect_consistent(quick.c1, full.c1);
  expect_consistent(quick.c2, full.c2);
  expect_consistent(quick.g1, full.g1);
  expect_wider(quick.gap, full.gap);
  expect_wider(quick.angle, full.angle);
  expect_wider(quick.plane_angle, full.plane_angle);
}

// Runs `work` with the limit at every place where it can be, or at many.
template <class Work>
void expect_honest_at_every_limit(Work work, long looks_after) {
  long all = 0;
  Certificate full;
  {
    const auto scope = DeadlineScope::after_checks(1'000'000'000);
    full = work();
    all = scope.checks();
  }
  ASSERT_GT(all, 0);
  for (long checks = 0; checks < all; checks += 1 + all / 60) {
    SCOPED_TRACE(checks);
    const auto scope = DeadlineScope::after_checks(checks);
    expect_consistent(work(), full);
    EXPECT_LE(scope.checks(), checks + looks_after);
  }
}

TEST(Deadline, ExactJoinsEndUndecidedWhereverTheTimeIsUp) {
  for (const auto& valid : valid_joins()) {
    SCOPED_TRACE(valid.name);
    expect_honest_at_every_limit([&] { return certify_join(valid.a, valid.b, valid.join); }, 20);
    const auto broken = broken_joins(valid).front();
    SCOPED_TRACE(broken.name);
    expect_honest_at_every_limit([&] { return certify_join(valid.a, broken.b, valid.join); }, 20);
  }
  for (const auto& valid : valid_quadratic_joins())
    expect_honest_at_every_limit([&] { return certify_join(valid.a, valid.b, valid.join); }, 20);
}

TEST(Deadline, NoTimeIsUndecided) {
  Request none;
  none.seconds_per_join = 0;
  const auto valid = valid_joins().front();
  const Certificate c = certify_join(valid.a, valid.b, valid.join, none);
  for (const ExactClass* e : {&c.c0, &c.c1, &c.c2, &c.g1}) {
    EXPECT_EQ(e->verdict, Verdict::undecided);
    EXPECT_EQ(e->reason, "the time for one join is up");
  }
  EXPECT_FALSE(c.gap.converged);
  EXPECT_FALSE(c.angle.converged);
  EXPECT_EQ(c.gap.lower, 0);
}

using Patch = BsplinePatch<Rational, 4>;
using Curve = BsplineCurve<Rational, 3>;

// Along a curve across the inner knots of two sheets, the second raised by `height`.
TEST(Deadline, TrimmedJoinsEndUndecidedWhereverTheTimeIsUp) {
  const auto k = KnotVector<Rational>::make(2, {q(0), q(0), q(0), q(1, 3), q(1), q(1), q(1)}).value();
  const auto sheet = [&](const Rational& height) {
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) net.push_back({{q(i), q(j), height * q(i * j % 3), q(1)}});
    return Patch(k, k, net);
  };
  const auto uv = [](const Rational& u, const Rational& v) { return Vec<Rational, 3>{{u, v, q(1)}}; };
  const Curve curve = Curve::bezier({uv(q(1, 10), q(1, 10)), uv(q(9, 10), q(1, 5)), uv(q(1, 2), q(9, 10))});
  const Patch a = sheet(q(1, 4)), b = sheet(q(1, 3));
  for (const Patch* other : {&a, &b}) {
    const TrimmedJoin join{{&a, curve, false}, {other, curve, false}};
    // Once the time is up, every piece there is takes a look, three times.
    expect_honest_at_every_limit([&] { return certify_trimmed(join); }, 2000);
    const RoundingGuard guard;
    const auto scope = DeadlineScope::after_checks(0);
    const TrimmedBounds none = bound_trimmed(join);
    EXPECT_EQ(none.gap.lower, 0);
    EXPECT_EQ(none.gap.upper, std::numeric_limits<double>::infinity());
    EXPECT_EQ(none.angle.upper, 180);
    EXPECT_EQ(none.plane_angle.upper, 90);
    EXPECT_FALSE(none.gap.converged || none.angle.converged || none.plane_angle.converged);
  }
}

}  // namespace
}  // namespace patchproof::test
