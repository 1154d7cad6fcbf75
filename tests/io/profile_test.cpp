// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace patchproof {
namespace {

const Profile& profile(std::string_view name) {
  const Profile* found = find_profile(name);
  if (!found) throw std::runtime_error("no such profile");
  return *found;
}

TEST(Profile, Law1_NamesAreUniqueAndEveryProfileJudgesSomething) {
  std::set<std::string_view> names;
  for (const Profile& p : all_profiles()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_EQ(find_profile(p.name), &p);
    EXPECT_FALSE(p.source.empty());
    EXPECT_TRUE(std::any_of(p.criteria.begin(), p.criteria.end(),
                            [](const Criterion& c) { return c.quantity != Quantity::unchecked; }));
    for (const Criterion& c : p.criteria) {
      EXPECT_GT(c.threshold, 0);
      // SASIG's pattern: G-SU-NT.
      ASSERT_EQ(c.code.size(), 7u);
      EXPECT_EQ(c.code.substr(0, 2), "G-");
      EXPECT_EQ(c.quantity == Quantity::gap, c.code.ends_with("LG") && c.code != "G-CU-LG");
    }
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"mil-std-31000a", "vda4955", "catia", "class-a", "class-b", "class-c"}));
  EXPECT_EQ(find_profile("list"), nullptr);
  EXPECT_EQ(find_profile(""), nullptr);
}

TEST(Profile, Law2_OneThresholdForEachQuantity) {
  for (const Profile& p : all_profiles()) {
    const Request request = tolerances_of(p, "mm", {}).value();
    for (const Criterion& c : p.criteria) {
      if (c.quantity == Quantity::unchecked) continue;
      EXPECT_EQ(c.quantity == Quantity::gap ? request.gap_tolerance : request.angle_tolerance, c.threshold) << p.name;
    }
  }
}

TEST(Profile, Law2_LengthsAreGivenInTheModelsUnits) {
  const auto gap = [](std::string_view unit) {
    return *tolerances_of(profile("class-a"), unit, {}).value().gap_tolerance;
  };
  EXPECT_EQ(gap("mm"), 0.01);
  EXPECT_EQ(gap(""), 0.01);
  EXPECT_EQ(gap("mm (file: inch)"), 0.01);  // the reader has converted
  EXPECT_EQ(gap("m"), 0.01 / 1000);
  EXPECT_EQ(gap("Meter"), 0.01 / 1000);
  EXPECT_EQ(gap("inches"), 0.01 / 25.4);
  EXPECT_EQ(gap("um"), 0.01 / 0.001);
  EXPECT_EQ(*tolerances_of(profile("class-a"), "m", {}).value().angle_tolerance, 0.1);
}

TEST(Profile, Law2_WhatIsAskedIsKept) {
  Request asked;
  asked.gap_tolerance = 7;
  const Request request = tolerances_of(profile("catia"), "parsec", asked).value();  // no length is converted
  EXPECT_EQ(request.gap_tolerance, 7);
  EXPECT_EQ(request.angle_tolerance, 0.01);
  asked.angle_tolerance = 3;
  EXPECT_EQ(tolerances_of(profile("catia"), "mm", asked).value().angle_tolerance, 3);
}

TEST(Profile, UnknownUnitsAreRefused) {
  const Result<Request> request = tolerances_of(profile("catia"), "parsec", {});
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().code, ErrorCode::usage);
  EXPECT_NE(request.error().text().find("parsec"), std::string::npos);
  EXPECT_FALSE(millimetres_per("s"));
  EXPECT_FALSE(millimetres_per("ms"));
}

TEST(Profile, Law3_TolerancesCountWhereACriterionSpeaksOfTheJoin) {
  const Profile& mil = profile("mil-std-31000a");  // gaps between faces, angles inside surfaces
  const Request request = tolerances_of(mil, "mm", {}).value();
  const Request trimmed = request_at(mil, JoinKind::trimmed, {}, request);
  EXPECT_EQ(trimmed.gap_tolerance, 0.01);
  EXPECT_FALSE(trimmed.angle_tolerance);
  const Request inside = request_at(mil, JoinKind::knot_line, {}, request);
  EXPECT_FALSE(inside.gap_tolerance);
  EXPECT_EQ(inside.angle_tolerance, 2);
  for (const JoinKind kind : {JoinKind::isoparametric, JoinKind::t_junction, JoinKind::seam}) {
    EXPECT_EQ(request_at(mil, kind, {}, request).gap_tolerance, 0.01);
    EXPECT_EQ(request_at(mil, kind, {}, request).angle_tolerance, 2);
  }
  Request given;
  given.angle_tolerance = 3;
  const Request all = tolerances_of(mil, "mm", given).value();
  EXPECT_EQ(request_at(mil, JoinKind::trimmed, given, all).angle_tolerance, 3);
}

}  // namespace
}  // namespace patchproof
