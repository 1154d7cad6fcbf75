// SPDX-License-Identifier: Apache-2.0
// Law 4 of reports: profiles.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/io_support.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/profile.h"
#include "patchproof/io/report.h"

namespace patchproof::test {
namespace {

using Json = nlohmann::json;

// Two squares that meet at x = 1 with a gap of 1/64 and an angle of 45°; and a kink of 45° inside the first,
// at its knot 1/2.
constexpr const char* kModel = R"({"format":"patchproof-model","version":1,UNITS"patches":[
  {"degree":[1,1],"knots":[[0,0,"1/2",1,1],[0,0,1,1]],
   "control_points":[[[-1,0,1],[-1,1,1]],[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
  {"degree":[1,1],"control_points":[[["65/64",0,0],["65/64",1,0]],[[2,0,"63/64"],[2,1,"63/64"]]]}]})";

ModelFile model(const std::string& units) {
  std::string text = kModel;
  text.replace(text.find("UNITS"), 5, units.empty() ? "" : "\"units\":\"" + units + "\",");
  return read_good(text, "model.json");
}

struct Printed {
  Json json;
  std::string table;
};
Printed report_of(const std::string& units, std::string_view profile, const Request& given = {}) {
  CertifyOptions options;
  options.match_length = 0.1;
  options.profile = find_profile(profile);
  options.given = given;
  options.request = tolerances_of(*options.profile, units, given).value();
  const Report report = certify_model(model(units), options);
  std::ostringstream json, table;
  write_json(json, report);
  write_table(table, report);
  return {Json::parse(json.str()), table.str()};
}

// code → verdict, of the join of this kind.
std::map<std::string, std::string> checks(const Json& document, const std::string& kind) {
  std::map<std::string, std::string> out;
  for (const Json& join : document["joins"])
    if (join["kind"] == kind)
      for (const Json& check : join["checks"]) out[check["code"]] = check["verdict"];
  return out;
}
using Checks = std::map<std::string, std::string>;

TEST(ReportProfile, Law4_JoinsAreJudgedByTheCriteriaOfTheirKind) {
  const Json d = report_of("mm", "mil-std-31000a").json;
  EXPECT_EQ(checks(d, "isoparametric"), (Checks{{"G-SH-LG", "fail"}, {"G-SU-NT", "fail"}}));
  EXPECT_EQ(checks(d, "knot-line"), (Checks{{"G-SU-NT", "fail"}}));
  EXPECT_EQ(d["verdict"], "fail");
  EXPECT_EQ(d["request"]["gap"], 0.01);
  EXPECT_EQ(d["request"]["angle_degrees"], 2);
  EXPECT_EQ(d["profile"]["name"], "mil-std-31000a");
  const Json& gap = d["profile"]["criteria"][0];
  EXPECT_EQ(gap["entity"], "gap_between_faces_related_to_an_edge");
  EXPECT_EQ(gap["joins"], 1);
  EXPECT_EQ(gap["fail"], 1);
}

TEST(ReportProfile, Law4_WhatCannotBeCheckedIsSaid) {
  const Printed out = report_of("mm", "mil-std-31000a");
  int unchecked = 0;
  for (const Json& criterion : out.json["profile"]["criteria"]) {
    unchecked += criterion["checked"] == false;
    EXPECT_EQ(criterion["checked"] == true, criterion.contains("pass"));
  }
  EXPECT_EQ(unchecked, 3);
  EXPECT_NE(out.table.find("G-FA-EG distance of an edge from its face, at most 0.01 mm: NOT CHECKED"),
            std::string::npos);
  EXPECT_NE(out.table.find("G-SH-LG gap between faces, at most 0.01 mm: 0 pass, 1 fail, 0 undecided"),
            std::string::npos);
}

TEST(ReportProfile, Law4_UnitsDecide) {
  EXPECT_EQ(checks(report_of("um", "class-c").json, "isoparametric")["G-SH-LG"], "pass");  // 1/64 µm
  EXPECT_EQ(checks(report_of("m", "class-c").json, "isoparametric")["G-SH-LG"], "fail");   // 15 mm
  EXPECT_EQ(checks(report_of("mm", "class-c").json, "isoparametric")["G-SH-LG"], "pass");  // 0.0156 of 0.05 mm
  EXPECT_EQ(report_of("mm", "class-c").json["input"]["notes"].size(), 0u);
  const Json unknown = report_of("", "class-c").json;
  ASSERT_EQ(unknown["input"]["notes"].size(), 1u);
  EXPECT_NE(unknown["input"]["notes"][0].get<std::string>().find("millimetres"), std::string::npos);
}

TEST(ReportProfile, Law4_GivenTolerancesReplaceThresholdsEverywhere) {
  Request given;
  given.gap_tolerance = 1;
  given.angle_tolerance = 60;
  const Json d = report_of("mm", "mil-std-31000a", given).json;
  EXPECT_EQ(d["verdict"], "pass");
  EXPECT_EQ(d["profile"]["criteria"][0]["compared_with"], 1);
  EXPECT_EQ(d["profile"]["criteria"][0]["threshold"], 0.01);
  given.angle_tolerance = 44;
  EXPECT_EQ(report_of("mm", "mil-std-31000a", given).json["verdict"], "fail");
}

TEST(ReportProfile, WithoutAProfileTheDocumentHasNone) {
  std::ostringstream json;
  write_json(json, certify_model(model("mm")));
  EXPECT_FALSE(Json::parse(json.str()).contains("profile"));
  EXPECT_EQ(json.str().find("checks"), std::string::npos);
}

// A square and, across x = 1, a wall: two faces of a part with a sharp edge.
CadModel sharp_part() {
  const auto patch = [](std::vector<Vec<Rational, 4>> net) {
    return BsplinePatch<Rational, 4>::make(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(1),
                                           std::move(net))
        .value();
  };
  const auto at = [](int x, int y, int z) {
    return Vec<Rational, 4>{{Rational(x), Rational(y), Rational(z), Rational(1)}};
  };
  const auto line = [](int u0, int v0, int u1, int v1) {
    return BsplineCurve<Rational, 3>::make(KnotVector<Rational>::bezier(1),
                                           {Vec<Rational, 3>{{Rational(u0), Rational(v0), Rational(1)}},
                                            Vec<Rational, 3>{{Rational(u1), Rational(v1), Rational(1)}}})
        .value();
  };
  CadModel model;
  model.path = "part.step";
  model.units = "mm";
  model.faces.push_back({"floor", "plane", patch({at(0, 0, 0), at(0, 1, 0), at(1, 0, 0), at(1, 1, 0)})});
  model.faces.push_back({"wall", "plane", patch({at(1, 0, 0), at(1, 1, 0), at(1, 0, 1), at(1, 1, 1)})});
  model.edges.push_back(
      {"edge 1", CadEdgeKind::shared, {{0, true, line(1, 0, 1, 1)}, {1, false, line(0, 0, 0, 1)}}, 1e-7, ""});
  return model;
}

TEST(ReportProfile, Law4_AnglesBetweenFacesAreJudgedOnlyWhereTheProfileLimitsThem) {
  const auto verdict = [](std::string_view name, double smooth_below) {
    CertifyOptions options;
    options.profile = find_profile(name);
    options.request = tolerances_of(*options.profile, "mm", {}).value();
    options.smooth_below = smooth_below;
    return certify_cad(sharp_part(), options).outcome();
  };
  EXPECT_EQ(verdict("mil-std-31000a", 180), Outcome::pass);
  EXPECT_EQ(verdict("class-a", 180), Outcome::fail);  // all edges are meant to be smooth
  EXPECT_EQ(verdict("class-a", 5), Outcome::pass);    // this one is meant to be sharp
}

}  // namespace
}  // namespace patchproof::test
