// SPDX-License-Identifier: Apache-2.0
// Joins of curves in reports, of one file and of several (tests/io/occt/read_curves_test.cpp has CAD files).
#include "patchproof/io/curve_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "io/io_support.h"

namespace patchproof::test {
namespace {

using Json = nlohmann::json;

ModelFile model(const std::string& curves, const std::string& name = "curves.json", const std::string& more = "") {
  return read_good(R"({"format": "patchproof-model", "version": 1, )" + more + R"("curves": [)" + curves + "]}", name);
}
std::string line(const std::string& from, const std::string& to, const std::string& name = "") {
  return R"({"name": ")" + name + R"(", "degree": 1, "control_points": [)" + from + ", " + to + "]}";
}
const std::string kFirst = line("[0, 0, 0]", "[1, 0, 0]", "first"), kFaster = line("[1, 0, 0]", "[3, 0, 0]", "faster"),
                  kCorner = line("[3, 0, 0]", "[3, 1, 0]", "corner");

Json json_of(const Report& report) {
  std::ostringstream out;
  write_json(out, report);
  return Json::parse(out.str());
}
std::string table_of(const Report& report) {
  std::ostringstream out;
  write_table(out, report);
  return out.str();
}
Report together(const std::vector<CurveFile>& files, const CertifyOptions& options = {}) {
  Result<Report> report = certify_curve_files(files, options);
  if (!report) throw std::runtime_error(report.error().text());
  return std::move(*report);
}

TEST(CurveFiles, Law1_EveryPairAndEveryFreeEnd) {
  const Json report = json_of(certify_model(model(kFirst + "," + kFaster + "," + kCorner)));
  ASSERT_EQ(report["curve_joins"].size(), 2u);
  const Json& faster = report["curve_joins"][0];
  EXPECT_EQ(faster["class"], "G2");
  EXPECT_EQ(faster["a"]["name"], "first");
  EXPECT_EQ(faster["a"]["end"], "end");
  EXPECT_EQ(faster["a"]["parameter"], "1");
  EXPECT_EQ(faster["b"]["curve"], 1);
  EXPECT_EQ(faster["exact"]["ratio"], "2");
  EXPECT_EQ(faster["exact"]["scaled_order"], "one function");
  EXPECT_EQ(faster["witness"]["C1"]["values"], Json({"-1", "0", "0"}));
  EXPECT_EQ(faster["gap_squared"], "0");
  EXPECT_EQ(faster["point"], Json({1.0, 0.0, 0.0}));
  EXPECT_FALSE(faster.contains("edge_class"));
  EXPECT_EQ(report["curve_joins"][1]["angle_degrees"], Json({{"lower", 90.0}, {"upper", 90.0}}));
  ASSERT_EQ(report["free_curve_ends"].size(), 2u);
  EXPECT_EQ(report["free_curve_ends"][1]["name"], "corner");
  EXPECT_EQ(report["curve_summary"]["curves"], 3);
  EXPECT_EQ(report["verdict"], "pass");
  const std::string table = table_of(certify_model(model(kFirst + "," + kFaster + "," + kCorner)));
  for (const char* text : {"3 curves", "first.end", "faster.begin", "G2 ×2", "2 joins of their ends: 1 C0; 1 G2",
                           "first.begin, corner.end"})
    EXPECT_NE(table.find(text), std::string::npos) << text << "\n" << table;
}

TEST(CurveFiles, WhatIsAskedOfCurves) {
  const ModelFile file = model(kFirst + "," + kFaster + "," + kCorner), smooth = model(kFirst + "," + kFaster);
  const auto outcome = [](const ModelFile& f, auto set) {
    CertifyOptions options;
    set(options);
    return certify_model(f, options).outcome();
  };
  const auto g1 = [](CertifyOptions& o) { o.request.require = Continuity::g1; };
  const auto c1 = [](CertifyOptions& o) { o.request.require = Continuity::c1; };
  const auto angle = [](CertifyOptions& o) { o.request.angle_tolerance = 1; };
  const auto curvature = [](CertifyOptions& o) { o.curvature_tolerance = 0.0; };
  EXPECT_EQ(outcome(file, g1), Outcome::fail);
  EXPECT_EQ(outcome(smooth, g1), Outcome::pass);
  EXPECT_EQ(outcome(smooth, c1), Outcome::fail);
  EXPECT_EQ(outcome(file, angle), Outcome::fail);
  EXPECT_EQ(outcome(smooth, angle), Outcome::pass);
  EXPECT_EQ(outcome(smooth, curvature), Outcome::pass);
  // y = x² and its tangent.
  const ModelFile bent =
      model(line("[-1, 0]", "[0, 0]") + R"(,{"degree": 2, "control_points": [[0, 0], [1, 0], [2, 4]]})");
  EXPECT_EQ(outcome(bent, curvature), Outcome::fail);
  EXPECT_EQ(outcome(bent, g1), Outcome::pass);
  // Nothing meets: nothing could be judged.
  EXPECT_EQ(outcome(model(kFirst), g1), Outcome::undecided);
  EXPECT_EQ(outcome(model(kFirst), [](CertifyOptions&) {}), Outcome::pass);
  // Beside patches curves are reported and not judged.
  const ModelFile beside =
      model(kFaster + "," + kCorner, "both.json",
            R"("patches": [{"degree": [1, 1], "control_points": [[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
                                 {"degree": [1, 1], "control_points": [[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]]]}], )");
  CertifyOptions options;
  g1(options);
  const Report report = certify_model(beside, options);
  EXPECT_EQ(report.outcome(), Outcome::pass);
  EXPECT_EQ(json_of(report)["curve_joins"].size(), 1u);
  EXPECT_EQ(json_of(report)["joins"].size(), 1u);
}

TEST(CurveFiles, Law2_FilesTakenTogetherAreOneModel) {
  const Report one = certify_model(model(kFirst + "," + kFaster + "," + kCorner));
  const Report several = together(
      {curves_of(model(kFirst, "here/first.json")), curves_of(model(kFaster + "," + kCorner, "there/rest.json"))});
  Json a = json_of(one)["curve_joins"], b = json_of(several)["curve_joins"];
  EXPECT_EQ(b[0]["a"]["file"], "here/first.json");
  EXPECT_EQ(b[0]["b"]["file"], "there/rest.json");
  for (Json* joins : {&a, &b})
    for (Json& join : *joins)
      for (const char* side : {"a", "b"}) join[side].erase("file");
  EXPECT_EQ(a, b);
  const Json report = json_of(several);
  ASSERT_EQ(report["curve_files"].size(), 2u);
  EXPECT_EQ(report["curve_files"][1]["file"], "there/rest.json");
  EXPECT_EQ(report["curve_files"][1]["sha256"].get<std::string>().size(), 64u);
  const std::string table = table_of(several);
  EXPECT_NE(table.find("first.json: first.end"), std::string::npos) << table;
  EXPECT_NE(table.find("rest.json: faster.begin"), std::string::npos) << table;
}

TEST(CurveFiles, Law2_SquareRootsAndFractionsTogether) {
  const ModelFile circle = model(
      R"({"degree": 2, "control_points": [[1, 0], [1, 1], [0, 1]], "weights": [1, "sqrt(2)/2", 1]})", "circle.json");
  const ModelFile tangent = model(line("[1, -3]", "[1, 0]"), "tangent.json");
  const ModelFile root3 = model(line("[0, 0]", "[\"sqrt(3)\", 0]"), "root.json");
  for (const auto& files :
       {std::vector{curves_of(tangent), curves_of(circle)}, std::vector{curves_of(circle), curves_of(tangent)}}) {
    const Report report = together(files);
    ASSERT_EQ(report.curves->joins.size(), 1u);
    EXPECT_EQ(class_name(report.curves->joins[0].certificate), "G1");
    EXPECT_EQ(report.curves->joins[0].certificate.ratio, "1/3*sqrt(2)");
  }
  const Result<Report> mixed = certify_curve_files({curves_of(circle), curves_of(tangent), curves_of(root3)});
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, ErrorCode::mixed_roots);
  EXPECT_EQ(mixed.error().where, "root.json");
}

TEST(CurveFiles, UnitsMustAgree) {
  const ModelFile mm = model(kFirst, "mm.json", R"("units": "mm", )"),
                  inch = model(kFaster, "inch.json", R"("units": "inch", )");
  const Result<Report> report = certify_curve_files({curves_of(mm), curves_of(inch)});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::usage);
  EXPECT_EQ(report.error().where, "inch.json");
  EXPECT_EQ(together({curves_of(model(kFirst)), curves_of(inch)}).units, "inch");
}

TEST(CurveFiles, TolerancesOfTheFileAndSharpCornersOfCadModels) {
  CadModel cad;
  cad.path = "wire.brep";
  cad.format = "brep";
  const auto segment = [](int x0, int y0, int x1, int y1) {
    const Rational one(1);
    return BsplineCurve<Rational, 4>::bezier(
        {{{Rational(x0), Rational(y0), Rational(0), one}}, {{Rational(x1), Rational(y1), Rational(0), one}}});
  };
  cad.curves = {{"edge 1", "line", segment(0, 0, 100, 0), {0, 3}},
                {"edge 2", "line", segment(104, 0, 200, 1), {1, 0.5}},
                {"edge 3", "line", segment(200, 1, 200, 90), {0.5, 0}}};
  CertifyOptions options;
  options.request.angle_tolerance = 0.7;
  const Report report = certify_cad(cad, options);
  ASSERT_EQ(report.curves->joins.size(), 2u);
  const ReportedCurveJoin &first = report.curves->joins[0], &second = report.curves->joins[1];
  EXPECT_EQ(first.certificate.gap.lower, 4);
  EXPECT_EQ(first.certificate.gap.upper, 4);
  EXPECT_EQ(first.edge_class, EdgeClass::kinked);
  EXPECT_EQ(second.edge_class, EdgeClass::sharp);
  EXPECT_EQ(report.outcome(), Outcome::pass);  // the corner is meant
  options.request.angle_tolerance = 0.5;
  EXPECT_EQ(certify_cad(cad, options).outcome(), Outcome::fail);
  options.request.angle_tolerance.reset();
  options.request.gap_tolerance = 3.9;
  EXPECT_EQ(certify_cad(cad, options).outcome(), Outcome::fail);
  cad.curves[1].tolerance[0] = 0.9;
  EXPECT_EQ(certify_cad(cad, {}).curves->joins.size(), 1u);
}

TEST(CurveFiles, Law3_TheReportDoesNotDependOnJobs) {
  std::string curves;
  for (int i = 0; i < 40; ++i)
    curves += (i ? "," : "") +
              line("[" + std::to_string(i) + ", 0]", "[" + std::to_string(i + 1) + ", " + std::to_string(i % 3) + "]");
  const ModelFile file = model(curves);
  std::vector<std::string> reports;
  for (const int jobs : {1, 2, 7}) {
    CertifyOptions options;
    options.jobs = jobs;
    reports.push_back(json_of(certify_model(file, options)).dump() + table_of(certify_model(file, options)));
  }
  EXPECT_EQ(reports[0], reports[1]);
  EXPECT_EQ(reports[0], reports[2]);
}

}  // namespace
}  // namespace patchproof::test
