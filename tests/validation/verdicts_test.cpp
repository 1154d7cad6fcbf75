// SPDX-License-Identifier: Apache-2.0
// The table of validation/verdicts: our verdicts against the truth, Open CASCADE's against what is recorded of it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "patchproof/io/read.h"
#include "patchproof/scalar/parse_scalar.h"
#include "validation/verdicts/occt.h"
#include "validation/verdicts/table.h"

namespace patchproof::verdicts {
namespace {

const std::filesystem::path kRoot = PATCHPROOF_SOURCE_DIR;
const std::filesystem::path kFolder = kRoot / "validation/verdicts";

std::vector<Case> cases(int count) { return read_cases((kFolder / "cases.json").string(), {1, count}).value(); }

Case case_named(const std::string& id, int count = 3) {
  for (Case& c : cases(count))
    if (c.id == id) return std::move(c);
  throw std::invalid_argument(id);
}

std::string lines(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + '\n';
  return all;
}

TEST(Verdicts, OursAreTrue) {
  std::set<std::string> ids;
  for (const Case& c : cases(25)) {
    EXPECT_TRUE(ids.insert(c.id).second) << c.id;
    EXPECT_EQ(lines(complaints(c, certify_case(c))), "") << c.id;
  }
  EXPECT_EQ(ids.size(), 16u);
}

void expect_tight(const EnclosedMaximum& bound, double value) {
  EXPECT_LE(bound.lower, value * (1 + 1e-15));
  EXPECT_GE(bound.upper, value * (1 - 1e-15));
  EXPECT_LE(bound.upper - bound.lower, 1e-10 * value);  // certify_join promises 1e-2
}

TEST(Verdicts, BoundsAreTheKnownValues) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  expect_tight(certify_case(case_named("kink_at_end")).exact[0].angle, 45);
  expect_tight(certify_case(case_named("kink_between_samples")).exact[0].angle, std::atan(3.0) * kDegrees);
  expect_tight(certify_case(case_named("slight_kink_everywhere")).exact[0].angle, std::atan(1e-6) * kDegrees);
  const EnclosedMaximum gap = certify_case(case_named("parallel_gap")).exact[0].gap;
  EXPECT_EQ(gap.lower, 0.5);
  EXPECT_EQ(gap.upper, 0.5);
  const EnclosedMaximum fold = certify_case(case_named("fold_back_cusp")).exact[0].angle;
  EXPECT_EQ(fold.lower, 180);
  EXPECT_EQ(fold.upper, 180);
}

TEST(Verdicts, AFalseTruthIsNoticed) {
  for (const char* id : {"kink_between_samples", "splits_moved_1e6", "perpendicular_cylinders"}) {
    SCOPED_TRACE(id);
    const Case good = case_named(id);
    const Ours ours = certify_case(good);
    ASSERT_EQ(lines(complaints(good, ours)), "");
    for (const char* name : {"C0", "C1", "C2", "G1"}) {
      Case c = good;
      std::string& verdict = c.truth.classes[name];
      verdict = verdict == "proven" ? "refuted" : "proven";
      EXPECT_NE(lines(complaints(c, ours)), "") << name;
    }
    Case c = good;
    c.truth.gap = {Rational(1) / Rational(10), Rational(1) / Rational(10)};
    EXPECT_NE(lines(complaints(c, ours)), "");
    c = good;
    c.truth.angle[0] = c.truth.angle[1] = c.truth.angle[1] + Rational(1) / Rational(1000000);
    EXPECT_NE(lines(complaints(c, ours)), "");
    c = good;
    c.truth.orientation = "cusp";
    EXPECT_NE(lines(complaints(c, ours)), "");
    c = good;
    c.truth.rounded_angle_below = 1e-30;
    EXPECT_NE(lines(complaints(c, ours)), "");
  }
  Case kink = case_named("kink_everywhere");
  kink.truth.one_polynomial = true;
  EXPECT_NE(lines(complaints(kink, certify_case(kink))), "");
}

TEST(Verdicts, FalseBoundsAreNoticed) {
  for (const char* id : {"kink_between_samples", "splits_moved_1e6", "perpendicular_cylinders"}) {
    SCOPED_TRACE(id);
    const Case c = case_named(id, 1);
    const Ours good = certify_case(c);
    ASSERT_EQ(lines(complaints(c, good)), "");
    Ours ours = good;
    ours.rounded[0].angle.upper *= 0.5;  // below a value along the edge
    EXPECT_NE(lines(complaints(c, ours)), "");
    ours = good;
    ours.rounded[0].angle.lower *= 1.001;  // above the value at its witness
    EXPECT_NE(lines(complaints(c, ours)), "");
    std::vector<Certificate> others = good.rounded;
    EXPECT_EQ(lines(disagreements(good.rounded, others)), "");
    others[0].angle.lower = others[0].angle.upper = 90;
    EXPECT_NE(lines(disagreements(good.rounded, others)), "");
    others = good.rounded;
    others[0].g1.verdict = Verdict::undecided;
    EXPECT_NE(lines(disagreements(good.rounded, others)), "");
    EXPECT_NE(lines(disagreements(good.rounded, {})), "");
  }
}

TEST(Shapes, SplitsAreOnePolynomialAndOneUnitLessIsNot) {
  const auto shapes = random_splits(7, 20, Rational(1), Rational(1000)),
             others = random_splits(8, 1, Rational(1), Rational(1000));
  EXPECT_FALSE(shapes[0].a.net() == others[0].a.net());
  EXPECT_FALSE(shapes[0].a.net() == shapes[1].a.net());
  for (const Shape& s : shapes) {
    EXPECT_TRUE(is_one_polynomial(s));
    auto net = s.b.net();
    net[10][2] += parse_scalar<Rational>("1e-40").value();
    EXPECT_FALSE(is_one_polynomial({s.a, {s.b.knots(Direction::u), s.b.knots(Direction::v), net}}));
    EXPECT_FALSE(is_one_polynomial(in_doubles(s)));
  }
  EXPECT_FALSE(is_one_polynomial(case_named("kink_at_end").shapes[0]));         // two pieces
  EXPECT_FALSE(is_one_polynomial(case_named("plane_and_cylinder").shapes[0]));  // weights
  EXPECT_FALSE(is_one_polynomial(case_named("parabola_and_plane_same_speed").shapes[0]));
}

TEST(Shapes, DoublesAreThoseOfTheReader) {
  for (const char* name : {"examples/seven/perpendicular_cylinders.json", "examples/seven/split_moved_1e6.json",
                           "examples/seven/kink_between_samples.json"}) {
    const Shape rounded = in_doubles(read_shape((kRoot / name).string()).value());
    const ModelFile file = read_model((kRoot / name).string(), Decimals::binary64).value();
    const auto& model = std::get<Model<Rational>>(file.model);
    EXPECT_EQ(rounded.a.net(), model.patches[0].surface.net()) << name;
    EXPECT_EQ(rounded.b.net(), model.patches[1].surface.net()) << name;
    EXPECT_EQ(rounded.b.knots(Direction::v).knots(), model.patches[1].surface.knots(Direction::v).knots()) << name;
    EXPECT_EQ(in_doubles(rounded).a.net(), rounded.a.net()) << name;
  }
}

ErrorCode code_of(const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "verdicts_bad_cases.json";
  std::ofstream(path) << text;
  const auto result = read_cases(path.string());
  std::filesystem::remove(path);
  EXPECT_FALSE(result) << text;
  return result ? ErrorCode::usage : result.error().code;
}

TEST(Cases, BadFilesAreErrors) {
  EXPECT_EQ(read_cases("absent.json").error().code, ErrorCode::cannot_open);
  EXPECT_EQ(code_of(""), ErrorCode::syntax);
  EXPECT_EQ(code_of("{\"cases\": ["), ErrorCode::syntax);
  EXPECT_EQ(code_of("{\"cases\": []}"), ErrorCode::wrong_count);
  EXPECT_EQ(code_of("{\"cases\": [{\"id\": 7}]}"), ErrorCode::syntax);
  const std::string begin = "{\"cases\": [{\"id\": \"x\", \"title\": \"\", \"state\": \"\", ",
                    occt =
                        "\"occt\": {\"wrong\": [], \"7.6\": {\"ContinuityOfFaces\": \"\", \"EncodeRegularity\": \"\", "
                        "\"LocalAnalysis\": \"\"}}, ",
                    truth =
                        "\"true\": {\"C0\": \"proven\", \"C1\": \"proven\", \"C2\": \"proven\", \"G1\": \"proven\", "
                        "\"gap\": \"0\", \"angle\": \"0\"}, ";
  const auto with = [](std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
  };
  const std::string model = "\"model\": \"absent.json\"}]}";
  EXPECT_EQ(code_of(begin + occt + truth + model), ErrorCode::cannot_open);
  EXPECT_EQ(code_of(begin + occt + with(truth, "\"C2\": \"proven\"", "\"C2\": \"perhaps\"") + model),
            ErrorCode::syntax);
  EXPECT_EQ(code_of(begin + occt + with(truth, "\"0\"", "\"nan\"") + model), ErrorCode::syntax);
  EXPECT_EQ(code_of(begin + with(occt, "[]", "[\"Someone\"]") + truth + model), ErrorCode::syntax);
  EXPECT_EQ(read_shape((kRoot / "examples/cup.json").string()).error().code, ErrorCode::wrong_count);
  EXPECT_EQ(read_shape((kRoot / "examples/torus_q.json").string()).has_value(), false);
}

// With Open CASCADE 7.6: its answers are those recorded, and the table in the README is the one of today. One test: all of
// it takes seconds.
TEST(Verdicts, TableStandsInTheReadme) {
  const auto version = occt_version();
  if (!version) GTEST_SKIP() << "Open CASCADE is not installed: its answers are not looked at";
  if (version->rfind("7.6", 0) != 0)
    GTEST_SKIP() << "Open CASCADE " << *version << ": the recorded answers are those of 7.6";
  std::vector<Row> rows;
  for (Case& c : cases(CaseOptions().count)) {
    rows.push_back(examine(std::move(c)));
    const Row& row = rows.back();
    SCOPED_TRACE(row.about.id);
    EXPECT_EQ(lines(row.complaints), "");
    EXPECT_EQ(lines(row.notes), "");
    ASSERT_TRUE(row.occt && row.cad && row.about.recorded);
    EXPECT_EQ(row.occt->continuity_of_faces, row.about.recorded->continuity_of_faces);
    EXPECT_EQ(row.occt->encoded, row.about.recorded->encoded);
    EXPECT_EQ(row.occt->local_analysis, row.about.recorded->local_analysis);
    EXPECT_EQ(row.cad->size(), row.about.shapes.size());
  }
  std::ostringstream table, document;
  write_table(table, rows);
  std::ifstream readme(kFolder / "README.md");
  const std::string text(std::istreambuf_iterator<char>(readme), {});
  EXPECT_NE(text.find(table.str()), std::string::npos) << "the README has another table than:\n" << table.str();

  write_json(document, rows, {});
  const auto json = nlohmann::json::parse(document.str());
  EXPECT_EQ(json.at("open_cascade"), *version);
  ASSERT_EQ(json.at("cases").size(), rows.size());
  for (const auto& line : json["cases"]) {
    EXPECT_EQ(line.at("open_cascade"), line.at("open_cascade_recorded"));
    EXPECT_TRUE(line.at("patchproof").at("complaints").empty());
    for (const char* which : {"exact", "rounded", "as_cad_file"})
      EXPECT_LE(line["patchproof"].at(which).at("angle_degrees").at("lower"),
                line["patchproof"][which]["angle_degrees"].at("upper"));
  }
}

TEST(Verdicts, WordsOfACertificate) {
  Certificate c;
  c.c0.verdict = Verdict::proven;
  c.g1.verdict = c.c1.verdict = Verdict::refuted;
  EXPECT_EQ(classes_in_words(c), "C0 proven; G1, C1 refuted; C2 undecided");
  Certificate d = c;
  c.gap.lower = 1, c.gap.upper = 4;
  d.gap.lower = 2, d.gap.upper = 3;
  EXPECT_EQ(largest({c, d}, &Certificate::gap), (std::array<double, 2>{2, 4}));
}

TEST(Verdicts, TableRoundsOutward) {
  Row row;
  Certificate c;
  c.gap.lower = 1.2345678, c.gap.upper = 2.3456712;
  c.angle.lower = c.angle.upper = 45;
  row.ours.exact = row.ours.rounded = {c};
  row.complaints = {"something"};
  std::ostringstream table;
  write_table(table, {row});
  EXPECT_NE(table.str().find("[1.23456, 2.34568]"), std::string::npos) << table.str();
  EXPECT_NE(table.str().find("| 45 "), std::string::npos) << table.str();
  EXPECT_NE(table.str().find("WRONG: something"), std::string::npos) << table.str();
}

}  // namespace
}  // namespace patchproof::verdicts
