// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/certify.h"

#include <gtest/gtest.h>

#include <chrono>

#include "patchproof/join/edge_match.h"
#include "support/broken_joins.h"
#include "support/certificates.h"

namespace patchproof::test {
namespace {

template <ExactField T>
Certificate certify(const ValidJoin<T>& j, const Request& request = {}) {
  return certify_join(j.a, j.b, j.join, request);
}

void expect_exact_zero(const EnclosedMaximum& m) {
  EXPECT_EQ(m.lower, 0);
  EXPECT_EQ(m.upper, 0);
  EXPECT_TRUE(m.converged);
}

template <ExactField T>
void expect_valid(const ValidJoin<T>& j) {
  SCOPED_TRACE(j.name);
  const Certificate c = certify(j);
  EXPECT_EQ(c.c0.verdict, Verdict::proven);
  EXPECT_EQ(c.c1.verdict, j.c1 ? Verdict::proven : Verdict::refuted);
  EXPECT_EQ(c.c2.verdict, j.c2 ? Verdict::proven : Verdict::refuted);
  EXPECT_EQ(c.g1.verdict, Verdict::proven);
  EXPECT_EQ(c.ratio, j.ratio);
  EXPECT_EQ(c.orientation, Orientation::smooth);
  for (const EnclosedMaximum* m : {&c.gap, &c.angle, &c.plane_angle}) expect_exact_zero(*m);
  for (const ExactClass* e : {&c.c0, &c.c1, &c.c2, &c.g1})
    if (e->witness) expect_true_witness(j.a, j.b, j.join, *e->witness);
}

template <ExactField T>
void expect_broken(const ValidJoin<T>& valid) {
  SCOPED_TRACE(valid.name);
  for (const BrokenJoin<T>& broken : broken_joins(valid)) {
    SCOPED_TRACE(broken.name);
    const ValidJoin<T> j{broken.name, valid.a, broken.b, valid.join};
    const Certificate c = certify(j);
    EXPECT_EQ(c.c0.verdict, broken.c0 ? Verdict::refuted : Verdict::proven);
    EXPECT_EQ(c.c1.verdict, Verdict::refuted);
    EXPECT_EQ(c.c2.verdict, Verdict::refuted);
    if (broken.g1) {
      EXPECT_EQ(c.g1.verdict, Verdict::refuted);
    } else {  // the planes still agree; only the side may have changed
      EXPECT_EQ(c.g1.verdict, c.orientation == Orientation::smooth ? Verdict::proven : Verdict::refuted);
      expect_exact_zero(c.plane_angle);
      EXPECT_EQ(c.angle.upper, c.orientation == Orientation::smooth ? 0 : 180);
    }
    if (broken.c0) {
      EXPECT_GT(c.gap.upper, 0);
      ASSERT_TRUE(c.c0.witness);
    } else {
      expect_exact_zero(c.gap);
      ASSERT_TRUE(c.c1.witness);
      if (broken.g1) {
        EXPECT_GT(c.angle.upper, 0);
        EXPECT_TRUE(c.g1.witness);
      }
    }
    for (const ExactClass* e : {&c.c0, &c.c1, &c.c2, &c.g1})
      if (e->witness) expect_true_witness(j.a, j.b, j.join, *e->witness);
  }
}

TEST(Certify, Law1_ValidJoinsAreProven) {
  for (const auto& j : valid_joins()) expect_valid(j);
  for (const auto& j : valid_quadratic_joins()) expect_valid(j);
}

TEST(Certify, Law1_EveryMutationIsRefuted) {
  for (const auto& j : valid_joins()) expect_broken(j);
}

TEST(Certify, Law1_EveryMutationIsRefutedInQuadratic) {
  for (const auto& j : valid_quadratic_joins()) expect_broken(j);
}

TEST(Certify, Law1_MutationsOfTheFirstSideAreRefuted) {
  for (const auto& valid : valid_joins()) {
    if (valid.join.kind == JoinKind::t_junction) continue;  // A's control points may act outside the range
    SCOPED_TRACE(valid.name);
    const ValidJoin<Rational> swapped = swap_sides(valid);
    const auto broken = broken_joins(swapped);
    for (std::size_t i = 0; i < broken.size(); i += 5) {
      SCOPED_TRACE(broken[i].name);
      const Certificate c = certify_join(broken[i].b, valid.b, valid.join);
      EXPECT_EQ(c.c0.verdict, broken[i].c0 ? Verdict::refuted : Verdict::proven);
      EXPECT_EQ(c.c1.verdict, Verdict::refuted);
      if (broken[i].g1) {
        EXPECT_EQ(c.g1.verdict, Verdict::refuted);
      }
    }
  }
}

// Joins with a kink and with a gap, on [0, 1]: dyadic numbers, so that the places of bounds are exact parameters.
std::vector<ValidJoin<Rational>> measured_joins() {
  std::vector<ValidJoin<Rational>> out;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Surface<Rational> a = wavy_patch(3, 3, seed, 64, seed % 2 == 0);
    Surface<Rational> kinked = wavy_patch(3, 3, seed + 10, 64, seed % 2 == 0), apart = kinked;
    for (int j = 0; j < 4; ++j)
      kinked = with_point(kinked, net_index(kinked, edge_line(kinked, EdgeName::u_min), 0, j), a.point(3, j));
    // The inner rows go on beyond the edge.
    const auto beyond = [&](const Surface<Rational>& s) {
      std::vector<Vec<Rational, 4>> net = s.net();
      for (std::size_t i = 4; i < net.size(); ++i) net[i][0] += q(9) * net[i][3];
      return Surface<Rational>(s.knots(Direction::u), s.knots(Direction::v), std::move(net));
    };
    kinked = beyond(kinked);
    apart = map_points(kinked, [&](const Vec<Rational, 4>& h) {
      return Vec<Rational, 4>{{h[0] + h[3] * q(1, 1024), h[1], h[2] * q(1025, 1024), h[3]}};
    });
    // Folded: the inner rows come back over a.
    const Surface<Rational> folded = map_points(kinked, [&](const Vec<Rational, 4>& h) { return h; });
    std::vector<Vec<Rational, 4>> net = folded.net();
    for (std::size_t i = 4; i < net.size(); ++i) net[i][0] -= q(static_cast<int>(i / 4) * 6) * net[i][3];
    const Surface<Rational> back(folded.knots(Direction::u), folded.knots(Direction::v), std::move(net));
    const std::string n = std::to_string(seed);
    out.push_back({"kink " + n, a, kinked, edge_join(a, EdgeName::u_max, kinked, EdgeName::u_min)});
    out.push_back({"gap " + n, a, apart, edge_join(a, EdgeName::u_max, apart, EdgeName::u_min)});
    out.push_back({"folded " + n, a, back, edge_join(a, EdgeName::u_max, back, EdgeName::u_min)});
  }
  return out;
}

TEST(Certify, Law2_SamplesNeverExceedTheUpperBoundsAndTheLowerOnesAreAttained) {
  double largest = 0;
  for (const auto& j : measured_joins()) {
    SCOPED_TRACE(j.name);
    const Certificate c = certify(j);
    expect_bounds_hold(j.a, j.b, j.join, c, 200);
    expect_lower_bounds_attained(j.a, j.b, j.join, c);
    for (const EnclosedMaximum* m : {&c.gap, &c.angle, &c.plane_angle}) {
      EXPECT_TRUE(m->converged);
      EXPECT_LE(m->upper - m->lower, m->upper / 100);
    }
    EXPECT_LE(c.plane_angle.upper, 90);
    largest = std::max(largest, c.angle.lower);
  }
  EXPECT_GT(largest, 90) << "no join was folded";
}

TEST(Certify, Law2_BoundsHoldForBrokenJoinsOfEveryKind) {
  for (const auto& valid : valid_joins()) {
    SCOPED_TRACE(valid.name);
    for (const auto& broken : broken_joins(valid)) {
      if (broken.name.find("sign") == std::string::npos) continue;
      SCOPED_TRACE(broken.name);
      expect_bounds_hold(valid.a, broken.b, valid.join, certify_join(valid.a, broken.b, valid.join), 12);
    }
  }
}

TEST(Certify, Law2_WithinAndExceedsATolerance) {
  const ValidJoin<Rational> j = measured_joins()[1];
  const Certificate c = certify(j);
  ASSERT_GT(c.gap.lower, 0);
  Request request;
  request.gap_tolerance = c.gap.upper;
  EXPECT_EQ(judge(certify(j, request), request).outcome, Outcome::pass);
  request.gap_tolerance = c.gap.lower / 2;
  EXPECT_EQ(judge(certify(j, request), request).outcome, Outcome::fail);
}

TEST(Certify, Law3_ExactZerosAfterRefutedC1AreZero) {
  for (const auto& j : valid_joins())
    if (!j.c1) {
      const Certificate c = certify(j);
      expect_exact_zero(c.gap);
      expect_exact_zero(c.angle);
      EXPECT_TRUE(c.c1.witness);
    }
}

// ---- metamorphic: law 4 ---------------------------------------------------------------------------------------------

struct Expected {
  std::string change;
  ValidJoin<Rational> join;
  Rational length_factor = q(1);
  bool ratio_same = true, ratio_inverse = false, c2_same = true;
};

std::vector<Expected> changed(const ValidJoin<Rational>& j) {
  const auto with = [&](const Surface<Rational>& a, const Surface<Rational>& b) {
    ValidJoin<Rational> out{j.name, a, b, j.join, j.c1, j.c2, j.ratio};
    return out;
  };
  const auto mapped = [&](const AffineMap<Rational>& m) { return with(apply(m, j.a), apply(m, j.b)); };
  const Direction along_a = other(j.join.line_a.constant), along_b = other(j.join.line_b.constant);
  std::vector<Expected> out;
  out.push_back({"sides swapped", swap_sides(j), q(1), true, true});
  out.push_back({"both run backwards", run_backwards(j)});
  out.push_back({"degrees elevated", with(elevate_degree(elevate_degree(j.a, along_a), j.join.line_a.constant),
                                          elevate_degree(j.b, along_b, 2))});
  if (j.join.pairing.kind != PairingKind::rational_linear) {
    const auto inside = [](const KnotVector<Rational>& k, const Rational& x) {
      return Rational(k.domain_begin() + x * (k.domain_end() - k.domain_begin()));
    };
    out.push_back(
        {"knots inserted", with(insert_knot(j.a, along_a, inside(j.a.knots(along_a), q(2, 7))),
                                insert_knot(insert_knot(j.b, along_b, inside(j.b.knots(along_b), q(5, 11)), 2),
                                            other(along_b), inside(j.b.knots(other(along_b)), q(1, 9))))});
  }
  out.push_back({"translated", mapped(translation(Vec<Rational, 3>{{q(1000000), q(-1000000), q(1000001)}}))});
  out.push_back({"rotated", mapped(rotation(Quaternion<Rational>{q(1), {{q(2), q(-3), q(4)}}}))});
  const Rational large = q(1 << 20), small = q(1, 1 << 20);
  out.push_back({"scaled up", mapped(scaling(Vec<Rational, 3>{{large, large, large}})), large});
  out.push_back({"scaled down", mapped(scaling(Vec<Rational, 3>{{small, small, small}})), small});
  const auto homogeneous = [](const Surface<Rational>& s, const Rational& f) {
    return map_points(s, [&](const Vec<Rational, 4>& h) { return f * h; });
  };
  out.push_back({"weights times constants", with(homogeneous(j.a, q(-3)), homogeneous(j.b, q(1, 7)))});
  return out;
}

// [lower, upper] of both enclose one number.
void expect_overlap(const EnclosedMaximum& before, const EnclosedMaximum& after, const Rational& factor = q(1)) {
  ASSERT_TRUE(std::isfinite(before.upper) && std::isfinite(after.upper));
  EXPECT_LE(from_double(before.lower) * factor, from_double(after.upper));
  EXPECT_LE(from_double(after.lower), from_double(before.upper) * factor);
  EXPECT_EQ(before.upper == 0, after.upper == 0);
}

void expect_unchanged(const ValidJoin<Rational>& j) {
  SCOPED_TRACE(j.name);
  const Certificate before = certify(j);
  for (const Expected& e : changed(j)) {
    SCOPED_TRACE(e.change);
    const Certificate after = certify(e.join);
    EXPECT_EQ(after.c0.verdict, before.c0.verdict);
    EXPECT_EQ(after.c1.verdict, before.c1.verdict);
    EXPECT_EQ(after.c2.verdict, before.c2.verdict);
    EXPECT_EQ(after.g1.verdict, before.g1.verdict);
    EXPECT_EQ(after.orientation, before.orientation);
    std::optional<std::string> ratio = before.ratio;
    if (ratio && e.ratio_inverse) ratio = to_text(Rational(q(1) / *parse_scalar<Rational>(*ratio)));
    EXPECT_EQ(after.ratio, ratio);
    expect_overlap(before.gap, after.gap, e.length_factor);
    expect_overlap(before.angle, after.angle);
    expect_overlap(before.plane_angle, after.plane_angle);
  }
}

TEST(Certify, Law4_ValidJoinsStayProven) {
  for (const auto& j : valid_joins()) expect_unchanged(j);
}

TEST(Certify, Law4_KinksGapsAndFoldsStay) {
  for (const auto& j : measured_joins()) expect_unchanged(j);
}

TEST(Certify, Law4_ScaledByHundredsOfPowersOfTwo) {
  const Rational huge = from_double(0x1p400);
  for (const auto& j : measured_joins())
    for (const Rational& f : {huge, Rational(q(1) / huge)}) {
      SCOPED_TRACE(j.name);
      const AffineMap<Rational> m = scaling(Vec<Rational, 3>{{f, f, f}});
      const Certificate before = certify(j), after = certify_join(apply(m, j.a), apply(m, j.b), j.join);
      EXPECT_EQ(after.c0.verdict, before.c0.verdict);
      EXPECT_EQ(after.g1.verdict, before.g1.verdict);
      EXPECT_TRUE(after.gap.converged && after.angle.converged);
      expect_overlap(before.gap, after.gap, f);
      expect_overlap(before.angle, after.angle);
    }
}

TEST(Certify, Law4_SplitAndRejoinedIsC2) {
  for (unsigned seed = 1; seed <= 6; ++seed)
    for (const Direction d : {Direction::u, Direction::v}) {
      const Surface<Rational> s = wavy_patch(2 + seed % 3, 3, seed, 1000, seed % 2 == 0);
      const auto [a, b] = split(s, d, q(static_cast<int>(seed), 9));
      const bool u = d == Direction::u;
      const Certificate c = certify_join(
          a, b, edge_join(a, u ? EdgeName::u_max : EdgeName::v_max, b, u ? EdgeName::u_min : EdgeName::v_min));
      EXPECT_EQ(c.c2.verdict, Verdict::proven);
      EXPECT_EQ(c.g1.verdict, Verdict::proven);
      EXPECT_EQ(c.ratio, "1");
      expect_exact_zero(c.angle);
    }
}

// ---- laws 5 and 6, budgets ------------------------------------------------------------------------------------------

TEST(Certify, Law5_WithoutC0TheRestIsRefutedAndTheDeviationsSpeak) {
  const ValidJoin<Rational> j = measured_joins()[1];
  const Certificate c = certify(j);
  for (const ExactClass* e : {&c.c0, &c.c1, &c.c2, &c.g1}) EXPECT_EQ(e->verdict, Verdict::refuted);
  EXPECT_EQ(c.g1.reason, "not C0");
  EXPECT_GT(c.gap.lower, 0);
  EXPECT_GT(c.angle.lower, 0);
  EXPECT_FALSE(c.ratio);
}

TEST(Certify, Law5_ParallelFacesWithAGapHaveAngleZero) {
  const auto [a, b] = split(wavy_patch(3, 3), Direction::u, q(1, 2));
  const Surface<Rational> lifted = apply(translation(Vec<Rational, 3>{{q(0), q(0), q(1, 8)}}), b);
  const Certificate c = certify_join(a, lifted, edge_join(a, EdgeName::u_max, lifted, EdgeName::u_min));
  EXPECT_EQ(c.c0.verdict, Verdict::refuted);
  EXPECT_EQ(c.g1.verdict, Verdict::refuted);
  EXPECT_LE(c.gap.lower, 0.125);
  EXPECT_GE(c.gap.upper, 0.125);
  EXPECT_LE(c.gap.upper - c.gap.lower, 0.125 / 100);
  EXPECT_EQ(c.angle.lower, 0);
  EXPECT_LE(c.angle.upper, 1e-12);
}

TEST(Certify, Law6_ThreadsDoNotMatter) {
  const auto joins = measured_joins();
  std::vector<const Surface<Rational>*> patches;
  std::vector<Join<Rational>> all;
  for (const auto& j : joins) {
    all.push_back(j.join);
    all.back().patch_a = static_cast<int>(patches.size());
    all.back().patch_b = all.back().patch_a + 1;
    patches.push_back(&j.a);
    patches.push_back(&j.b);
  }
  const std::vector<Certificate> one = certify_joins(patches, all, {}, 1);
  std::atomic<int> calls{0};
  for (const int jobs : {0, 2, 8}) {
    const auto many = certify_joins(patches, all, {}, jobs, [&](std::size_t) { ++calls; });
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) expect_identical(one[i], many[i]);
  }
  EXPECT_GT(calls, 0);
  for (std::size_t i = 0; i < one.size(); ++i) expect_identical(one[i], certify(joins[i]));
  EXPECT_TRUE(certify_joins<Rational>({}, {}).empty());
}

TEST(Certify, NoBudgetEndsQuicklyAndNeverWrongly) {
  Request none;
  none.seconds_per_join = 0;
  auto joins = measured_joins();
  for (const auto& j : valid_joins()) joins.push_back(j);
  for (const auto& j : joins) {
    SCOPED_TRACE(j.name);
    const auto begin = std::chrono::steady_clock::now();
    const Certificate quick = certify(j, none);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 5);
    const Certificate full = certify(j);
    const std::array<std::pair<const ExactClass*, const ExactClass*>, 4> classes{
        {{&quick.c0, &full.c0}, {&quick.c1, &full.c1}, {&quick.c2, &full.c2}, {&quick.g1, &full.g1}}};
    for (const auto& [x, y] : classes)
      if (x->verdict != Verdict::undecided) {
        EXPECT_EQ(x->verdict, y->verdict);
      }
    expect_bounds_hold(j.a, j.b, j.join, quick, 20);
  }
}

}  // namespace
}  // namespace patchproof::test
