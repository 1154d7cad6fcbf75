// SPDX-License-Identifier: Apache-2.0
// GERBS curves and patches of our JSON: read, written, expanded, certified; and every way to get them wrong.
#include <gtest/gtest.h>

#include "io/gerbs_splines.h"
#include "io/io_support.h"
#include "patchproof/io/read.h"
#include "patchproof/io/report.h"
#include "patchproof/io/write.h"
#include "support/rational_literal.h"

namespace patchproof {
namespace {

using test::operator""_q;

std::string document(const std::string& section, const std::string& element) {
  return R"json({"format": "patchproof-model", "version": 1, ")json" + section + R"json(": [)json" + element + "]}";
}
// Four local lines over [0, 4].
const std::string kLine = R"json({"degree": 1, "knots": [0, 0, 4, 4], "control_points": [[0, 0], [4, 8]]})json";
std::string curve(const std::string& b, const std::string& locals, const std::string& more = "") {
  return R"json({"b_function": ")json" + b + R"json(", "knots": [0, 1, 2, 4])json" + more + R"json(, "locals": [)json" +
         locals + "]}";
}
std::string four(const std::string& second) {
  return kLine + ", " + second + R"json(, {"same_as": 0}, {"same_as": 1})json";
}

// A closed ring in u, straight in v.
std::string ring(const std::string& b, const std::string& height = "0") {
  return R"json({"name": "ring", "b_function": ")json" + b +
         R"json(", "knots": [[0, 1, 2], [0, 1]], "closed": [true, false], "locals": [
    {"degree": [1, 1], "trigonometric": "u", "knots": [[], [0, 0, 1, 1]],
     "control_points": [[[0, 0, 0], [0, 0, 1]], [[2, 0, 0], [2, 0, 0]], [[0, 2, 0], [0, 2, 0]]]},
    {"same_as": 0}, {"same_as": 0, "map": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, )json" +
         height + R"json(]]}, {"same_as": 2}]})json";
}

Result<ModelFile> read(const std::string& text) { return read_model_text(text, "model.json"); }
Model<Rational> model_of(const std::string& text) { return std::get<Model<Rational>>(read(text).value().model); }

TEST(GerbsModel, CurvesAndPatchesAreReadAndWrittenWithoutLoss) {
  for (
      const std::string& text :
      {document("gerbs_curves",
                curve("polynomial(2)",
                      four(R"json({"same_as": 0, "map": [[1, 0, 0, 1], [0, "3/5", 0, -2], [0, 0, 1, 0]]})json"))),
       document(
           "gerbs_curves",
           curve(
               "bernstein(0,1/3,1)",
               four(
                   R"json({"degree": 2, "knots": [0, 0, 0, 4, 4, 4], "control_points": [[0, 0], [1, 1], [2, 0]], "weights": [1, 2, 1]})json"))),
       document("gerbs_patches", ring("expo-rational(1,2,1,1/3)", "\"1/7\""))}) {
    const Model<Rational> model = model_of(text);
    const std::string written = write_model_json(model);
    const Model<Rational> again = model_of(written);
    EXPECT_EQ(write_model_json(again), written);
    ASSERT_EQ(again.gerbs_curves.size(), model.gerbs_curves.size());
    ASSERT_EQ(again.gerbs_patches.size(), model.gerbs_patches.size());
    for (std::size_t i = 0; i < model.gerbs_curves.size(); ++i)
      for (const char* t : {"0", "1/3", "1", "7/3", "4"}) {
        const Rational at = parse_scalar<Rational>(t).value();
        EXPECT_EQ(derivatives_at<Rational>(again.gerbs_curves[i].curve, at, Side::right, at, 3),
                  derivatives_at<Rational>(model.gerbs_curves[i].curve, at, Side::right, at, 3));
      }
    for (std::size_t i = 0; i < model.gerbs_patches.size(); ++i)
      EXPECT_EQ(again.gerbs_patches[i].surface.local(1, 0), model.gerbs_patches[i].surface.local(1, 0));
  }
}

TEST(GerbsModel, ABlendIsTheFirstCurveThenTheSecond) {
  const Model<Rational> model = model_of(document("gerbs_curves", R"json({"b_function": "polynomial(1)", "blend": {
  "overlap" : "1/2", "first" : {"degree" : 2, "control_points" : [ [ 0, 0 ], [ "1/2", 0 ], [ 1, 1 ] ]}, "second" : {
    "degree" : 2, "control_points" : [ [ "1/2", 1 ], [ 1, 1 ], [ "3/2", 0 ] ]
  }}})json"));
  const auto& c = model.gerbs_curves.at(0).curve;
  const auto at = [&](const Rational& t) { return derivatives_at<Rational>(c, t, Side::right, t, 0)[0]; };
  EXPECT_EQ(at("1/4"_q), (Vec<Rational, 3>{{"1/4"_q, "1/16"_q, "0"_q}}));
  EXPECT_EQ(at("5/4"_q), (Vec<Rational, 3>{{"5/4"_q, "7/16"_q, "0"_q}}));  // 1 − (3/4)²
  EXPECT_EQ(c.knots().domain_end(), "3/2"_q);
}

TEST(GerbsModel, ExactOnesAreExpandedUnderTheirNumbersOthersOutlined) {
  const std::string exact = curve("polynomial(2)", four(kLine)), other = curve("logistic", four(kLine));
  const SplineModel<Rational> made = gerbs_to_splines(model_of(document("gerbs_curves", exact + ", " + other)));
  EXPECT_EQ(made.model.curves.size(), 2u);
  EXPECT_EQ(made.outlined_curves, std::vector<std::size_t>{1});
  EXPECT_FALSE(has_gerbs(made.model));
  // A degree that splines of files do not have.
  const SplineModel<Rational> high =
      gerbs_to_splines(model_of(document("gerbs_curves", curve("polynomial(40)", four(kLine)))));
  EXPECT_EQ(high.outlined_curves, std::vector<std::size_t>{0});
}

const ReportedJoin& only_join(const Report& report) {
  if (report.joins.size() != 1) throw std::runtime_error("one join is expected");
  return report.joins.front();
}

TEST(GerbsModel, SeamsOfTranscendentalPatchesAreProvedInAReport) {
  for (const char* b : {"trigonometric", "expo-rational"}) {
    const Report report = certify_model(read(document("gerbs_patches", ring(b, "\"1/7\""))).value());
    const Certificate& c = only_join(report).certificate;
    EXPECT_EQ(only_join(report).kind, JoinKind::seam);
    EXPECT_EQ(c.c1.verdict, Verdict::proven);
    EXPECT_EQ(c.g1.verdict, Verdict::proven);
    EXPECT_EQ(c.gap.upper, 0);
    EXPECT_EQ(report.unmatched.size(), 2u);
  }
}

TEST(GerbsModel, DeclaredJoinsMayNameThem) {
  std::string text = document("gerbs_patches", ring("trigonometric"));
  text.pop_back();
  const auto with = [&](const char* patch) {
    return text + R"json(, "joins": [{"a": {"patch": 0, "edge": "u_min"}, "b": {"patch": )json" + patch +
           R"json(, "edge": "u_max"}}]})json";
  };
  EXPECT_EQ(only_join(certify_model(read(with("0")).value())).certificate.c0.verdict, Verdict::proven);
  EXPECT_EQ(read(with("1")).error().code, ErrorCode::bad_reference);
}

struct Bad {
  std::string text;
  ErrorCode code;
  std::string place;  // part of the message
};

TEST(GerbsModel, EveryFaultIsNamed) {
  const auto curves = [](const std::string& c) { return document("gerbs_curves", c); };
  const auto blend = [&](const std::string& overlap, const std::string& more = "") {
    const std::string line = R"json({"degree": 1, "control_points": [[0, 0], [1, 0]]})json";
    return curves(R"json({"b_function": "polynomial(1)", "blend": {"overlap": )json" + overlap +
                  R"json(, "first": )json" + line + R"json(, "second": )json" + line + "}" + more + "}");
  };
  const std::string trig = R"json({"degree": 1, "trigonometric": "t", "control_points": [[0, 0], [1, 0], [0, 1]])json";
  const Bad all[] = {
      {curves(curve("polynomial(-1)", four(kLine))), ErrorCode::usage, "/gerbs_curves/0/b_function"},
      {curves(curve("no such", four(kLine))), ErrorCode::syntax, "/gerbs_curves/0/b_function"},
      {curves(curve("bernstein(0,2,-1,1)", four(kLine))), ErrorCode::not_monotone, "/gerbs_curves/0/b_function"},
      {curves(curve("polynomial(1)", kLine)), ErrorCode::wrong_count, "4 local curves"},
      {curves(
           curve("polynomial(1)", kLine + ", " + kLine + ", " + kLine + ", " + kLine, R"json(, "closed": true)json")),
       ErrorCode::wrong_count, "3 local curves"},
      {curves(curve("polynomial(1)", four(R"json({"degree": 1, "control_points": [[0, 0], [1, 1]]})json"))),
       ErrorCode::outside_domain, "local curve 1"},
      {curves(curve("polynomial(1)", four(R"json({"same_as": 1})json"))), ErrorCode::bad_reference,
       "/gerbs_curves/0/locals/1/same_as"},
      {curves(curve("polynomial(1)", four(R"json({"same_as": 0, "degree": 1})json"))), ErrorCode::syntax,
       "/gerbs_curves/0/locals/1"},
      {curves(curve("polynomial(1)", four(R"json({"same_as": 0, "map": [[1, 0, 0, 0], [0, 1, 0, 0]]})json"))),
       ErrorCode::wrong_count, "/gerbs_curves/0/locals/1/map"},
      {curves(
           curve("polynomial(1)", four(R"json({"same_as": 0, "map": [[1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]})json"))),
       ErrorCode::wrong_count, "/map/0"},
      {curves(curve("polynomial(1)",
                    four(R"json({"same_as": 0, "map": [[1, 0, 0, "x"], [0, 1, 0, 0], [0, 0, 1, 0]]})json"))),
       ErrorCode::bad_number, "/map/0/3"},
      {curves(curve("polynomial(1)", four(trig + R"json(, "weights": [1, 1, 1]})json"))), ErrorCode::unsupported,
       "/gerbs_curves/0/locals/1"},
      {curves(curve("polynomial(1)", four(trig + R"json(, "knots": [0, 0, 1, 1]})json"))), ErrorCode::bad_degree,
       "/gerbs_curves/0/locals/1"},
      {curves(
           curve("polynomial(1)",
                 four(R"json({"degree": 1, "trigonometric": "x", "control_points": [[0, 0], [1, 0], [0, 1]]})json"))),
       ErrorCode::syntax, "trigonometric"},
      {curves(curve("polynomial(1)",
                    four(R"json({"degree": 1, "trigonometric": "t", "control_points": [[0, 0], [1, 0]]})json"))),
       ErrorCode::wrong_count, "/gerbs_curves/0/locals/1"},
      {curves(R"json({"b_function": "polynomial(1)", "locals": []})json"), ErrorCode::syntax, "knots"},
      {curves(R"json({"b_function": "polynomial(1)", "knots": [0, 1]})json"), ErrorCode::syntax, "locals"},
      {curves(R"json({"b_function": "polynomial(1)", "knots": [0, 2, 1], "locals": []})json"),
       ErrorCode::decreasing_knots, "/gerbs_curves/0/knots/2"},
      {curves(R"json({"b_function": "polynomial(1)", "knots": [1, 1], "locals": []})json"), ErrorCode::empty_domain,
       "/gerbs_curves/0/knots"},
      {curves(R"json({"b_function": "polynomial(1)", "knots": [1], "locals": []})json"), ErrorCode::wrong_count,
       "/gerbs_curves/0/knots"},
      {curves(R"json({"b_function": "polynomial(1)", "closed": true, "knots": [0, 0, 1], "locals": []})json"),
       ErrorCode::not_closed, "/gerbs_curves/0/knots"},
      {curves(curve("polynomial(1)", four(R"json({"same_as": 0, "trigonometric": "t"})json"))), ErrorCode::syntax,
       "/gerbs_curves/0/locals/1"},
      {curves(
           curve("polynomial(1)",
                 four(R"json({"degree": 1, "trigonometric": "tt", "control_points": [[0, 0], [1, 0], [0, 1]]})json"))),
       ErrorCode::syntax, "twice"},
      {curves(curve("polynomial(1)",
                    four(R"json({"same_as": 0, "map": [["1e301", 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, "1e301"]]})json"))),
       ErrorCode::bad_number, "/map"},
      {curves(R"json({"b_function": "polynomial(1)", "knots": ["1e20", "100000000000000000001"], "locals": []})json"),
       ErrorCode::bad_number, "/gerbs_curves/0/knots/1"},
      {blend("0"), ErrorCode::bad_window, "0 of 1 and 1"},
      {blend("2"), ErrorCode::bad_window, "2 of 1 and 1"},
      {blend("\"-1/2\""), ErrorCode::bad_window, "-1/2"},
      {blend("\"nan\""), ErrorCode::bad_number, "/blend/overlap"},
      {blend("\"1/2\"", R"json(, "knots": [0, 1])json"), ErrorCode::syntax, "/gerbs_curves/0"},
      {document("gerbs_patches", R"json({"b_function": "polynomial(1)", "knots": [[0, 1]], "locals": []})json"),
       ErrorCode::wrong_count, "/gerbs_patches/0/knots"},
      {document(
           "gerbs_patches",
           R"json({"b_function": "polynomial(1)", "knots": [[0, 1], [0, 1]], "closed": [true], "locals": []})json"),
       ErrorCode::wrong_count, "/gerbs_patches/0/closed"},
      {document("gerbs_patches", R"json({"b_function": "polynomial(1)", "knots": [[0, 1], [0, 1]], "locals": []})json"),
       ErrorCode::wrong_count, "2 x 2"},
  };
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.text);
    const Result<ModelFile> made = read(bad.text);
    ASSERT_FALSE(made.has_value());
    EXPECT_EQ(made.error().code, bad.code) << made.error().text();
    EXPECT_NE(made.error().text().find(bad.place), std::string::npos) << made.error().text();
    EXPECT_NE(made.error().text().find("model.json"), std::string::npos) << made.error().text();
  }
}

}  // namespace
}  // namespace patchproof
