// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/certificate.h"

#include <gtest/gtest.h>

#include <limits>

namespace patchproof::test {
namespace {

constexpr std::array<Verdict, 3> kVerdicts{Verdict::proven, Verdict::refuted, Verdict::undecided};

Outcome outcome_of(Verdict v) {
  return v == Verdict::proven ? Outcome::pass : v == Verdict::refuted ? Outcome::fail : Outcome::undecided;
}
// fail outranks undecided outranks pass.
Outcome worst(std::initializer_list<Outcome> all) {
  Outcome out = Outcome::pass;
  for (const Outcome o : all)
    if (o == Outcome::fail || (o == Outcome::undecided && out == Outcome::pass)) out = o;
  return out;
}

EnclosedMaximum between(double lower, double upper) { return {lower, upper, {}, true}; }

TEST(Certificate, NothingAskedPassesWhateverIsTrue) {
  for (const Verdict v : kVerdicts) {
    Certificate c;
    c.c0 = c.c1 = c.c2 = c.g1 = {v, "", std::nullopt};
    c.gap = between(1, std::numeric_limits<double>::infinity());
    c.angle = between(0, 180);
    EXPECT_EQ(judge(c, {}).outcome, Outcome::pass);
    EXPECT_TRUE(judge(c, {}).reason.empty());
  }
}

TEST(Certificate, EveryCombinationOfClassGapAndAngle) {
  const std::array<std::pair<EnclosedMaximum, Outcome>, 5> bounds{
      {{between(0, 0), Outcome::pass},
       {between(0.5, 1), Outcome::pass},  // upper = tolerance
       {between(0.5, 2), Outcome::undecided},
       {between(1, 2), Outcome::undecided},  // lower = tolerance
       {between(1.5, 2), Outcome::fail}}};
  int seen = 0;
  for (const Continuity asked : {Continuity::c0, Continuity::c1, Continuity::g1})
    for (const Verdict v : kVerdicts)
      for (const auto& [gap, gap_outcome] : bounds)
        for (const auto& [angle, angle_outcome] : bounds)
          for (int mask = 0; mask < 8; ++mask) {
            Certificate c;
            (asked == Continuity::c0 ? c.c0 : asked == Continuity::c1 ? c.c1 : c.g1) = {v, "the class", std::nullopt};
            c.gap = gap;
            c.angle = angle;
            Request request;
            if (mask & 1) request.require = asked;
            if (mask & 2) request.gap_tolerance = 1;
            if (mask & 4) request.angle_tolerance = 1;
            const Judgement j = judge(c, request);
            EXPECT_EQ(j.outcome,
                      worst({mask & 1 ? outcome_of(v) : Outcome::pass, mask & 2 ? gap_outcome : Outcome::pass,
                             mask & 4 ? angle_outcome : Outcome::pass}));
            EXPECT_EQ(j.reason.empty(), j.outcome == Outcome::pass);
            ++seen;
          }
  EXPECT_EQ(seen, 3 * 3 * 25 * 8);
}

TEST(Certificate, TheReasonBelongsToTheOutcome) {
  Certificate c;
  c.g1 = {Verdict::undecided, "no normal", std::nullopt};
  c.gap = between(3, 4);
  Request request;
  request.require = Continuity::g1;
  EXPECT_EQ(judge(c, request).reason, "no normal");
  request.gap_tolerance = 1;
  EXPECT_EQ(judge(c, request).reason, "the gap exceeds the tolerance");
  request.gap_tolerance = 3.5;
  EXPECT_EQ(judge(c, request).reason, "no normal");  // undecided twice: the first reason stays
}

TEST(Certificate, OnlyTheClassAskedForCounts) {
  Certificate c;
  c.c0.verdict = Verdict::proven;
  c.c1 = c.c2 = c.g1 = {Verdict::refuted, "a kink", std::nullopt};
  Request request;
  request.require = Continuity::c0;
  EXPECT_EQ(judge(c, request).outcome, Outcome::pass);
  request.require = Continuity::c1;
  EXPECT_EQ(judge(c, request).outcome, Outcome::fail);
  c.g1.verdict = Verdict::proven;
  request.require = Continuity::g1;
  EXPECT_EQ(judge(c, request).outcome, Outcome::pass);
}

TEST(Certificate, NoUpperBoundIsNeverWithin) {
  Certificate c;
  c.gap = between(0, std::numeric_limits<double>::infinity());
  Request request;
  request.gap_tolerance = 1e300;
  EXPECT_EQ(judge(c, request).outcome, Outcome::undecided);
  request.gap_tolerance = 0;
  c.gap = between(0, 0);
  EXPECT_EQ(judge(c, request).outcome, Outcome::pass);
  c.gap = between(std::numeric_limits<double>::denorm_min(), 1);
  EXPECT_EQ(judge(c, request).outcome, Outcome::fail);
}

TEST(Certificate, Names) {
  EXPECT_STREQ(to_string(Verdict::proven), "proven");
  EXPECT_STREQ(to_string(Verdict::refuted), "refuted");
  EXPECT_STREQ(to_string(Verdict::undecided), "undecided");
  EXPECT_STREQ(to_string(Orientation::smooth), "smooth");
  EXPECT_STREQ(to_string(Orientation::cusp), "cusp");
  EXPECT_STREQ(to_string(Orientation::mixed), "mixed");
  EXPECT_STREQ(to_string(Orientation::unknown), "unknown");
  EXPECT_STREQ(to_string(Outcome::pass), "pass");
  EXPECT_STREQ(to_string(Outcome::fail), "fail");
  EXPECT_STREQ(to_string(Outcome::undecided), "undecided");
}

}  // namespace
}  // namespace patchproof::test
