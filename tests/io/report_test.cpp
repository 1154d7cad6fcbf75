// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "io/io_support.h"

namespace patchproof::test {
namespace {

using Json = nlohmann::json;

ModelFile example(const std::string& name) {
  const std::string path = std::string(PATCHPROOF_SOURCE_DIR) + "/examples/" + name;
  return read_good(bytes_of(path), name);
}
std::string json_of(const Report& r) {
  std::ostringstream out;
  write_json(out, r);
  return out.str();
}
std::string table_of(const Report& r, const TableStyle& style = {}) {
  std::ostringstream out;
  write_table(out, r, style);
  return out.str();
}
std::set<std::string> keys(const Json& object) {
  std::set<std::string> out;
  for (const auto& [key, value] : object.items()) out.insert(key);
  return out;
}
using Keys = std::set<std::string>;

void expect_bound(const Json& b, double most) {
  EXPECT_EQ(keys(b), (Keys{"lower", "upper", "at", "tight"}));
  EXPECT_LE(b["lower"].get<double>(), b["upper"].get<double>());
  EXPECT_GE(b["lower"].get<double>(), 0);
  EXPECT_LE(b["upper"].get<double>(), most);
  EXPECT_EQ(keys(b["at"]), (Keys{"a", "b", "point"}));
  EXPECT_TRUE(b["at"]["a"].size() == 2 && b["at"]["b"].size() == 2 && b["at"]["point"].size() == 3);
}

TEST(Report, Law1_TheDocumentHasEveryField) {
  CertifyOptions options;
  options.request.require = Continuity::g1;
  options.request.gap_tolerance = 1e-6;
  const Json d = Json::parse(json_of(certify_model(example("cup.json"), options)));
  EXPECT_EQ(keys(d), (Keys{"tool", "version", "schema", "input", "request", "joins", "unmatched_edges",
                           "collapsed_edges", "summary", "verdict"}));
  EXPECT_EQ(d["tool"], "patchproof");
  EXPECT_EQ(d["schema"], 1);
  for (const char* key : {"file", "sha256", "format", "decimals", "patches", "joins"})
    EXPECT_TRUE(d["input"].contains(key)) << key;
  EXPECT_EQ(d["input"]["patches"], 35);
  EXPECT_EQ(d["input"]["joins"], d["joins"].size());
  EXPECT_EQ(d["input"]["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(d["request"]["require"], "G1");
  EXPECT_EQ(d["request"]["gap"], 1e-6);
  EXPECT_TRUE(d["request"]["angle_degrees"].is_null());
  int id = 0;
  std::map<std::string, int> verdicts;
  for (const Json& j : d["joins"]) {
    EXPECT_EQ(j["id"], ++id);
    for (const char* key : {"a", "b", "kind", "reversed", "exact", "gap", "angle_degrees", "orientation", "degenerate",
                            "rung", "pairing", "verdict", "witness", "reason"})
      EXPECT_TRUE(j.contains(key)) << key;
    for (const char* side : {"a", "b"}) {
      for (const char* key : {"patch", "edge", "range"}) EXPECT_TRUE(j[side].contains(key)) << key;
      EXPECT_EQ(j[side]["range"].size(), 2u);
    }
    EXPECT_EQ(keys(j["exact"]), (Keys{"C0", "C1", "C2", "G1", "ratio"}));
    for (const char* c : {"C0", "C1", "C2", "G1"}) {
      EXPECT_TRUE((Keys{"proven", "refuted", "undecided"}).count(j["exact"][c]));
      if (j["exact"][c] == "refuted") {
        EXPECT_TRUE(j["reasons"].contains(c)) << c;
      }
    }
    if (j["exact"]["C0"] == "refuted") {
      EXPECT_TRUE(j["witness"]["C0"]["values"].size() == 3);
    }
    expect_bound(j["gap"], std::numeric_limits<double>::max());
    expect_bound(j["angle_degrees"], 180);
    EXPECT_TRUE((Keys{"smooth", "cusp", "mixed"}).count(j["orientation"]));
    ++verdicts[j["verdict"]];
  }
  EXPECT_EQ(d["summary"]["pass"], verdicts["pass"]);
  EXPECT_EQ(d["summary"]["fail"], verdicts["fail"]);
  EXPECT_EQ(d["summary"]["undecided"], verdicts["undecided"]);
  EXPECT_GT(verdicts["fail"], 0);
  EXPECT_EQ(d["verdict"], "fail");
  EXPECT_TRUE(d["summary"].contains("worst_gap") && d["summary"].contains("worst_angle_degrees"));
}

TEST(Report, Law1_TheBytesDoNotDependOnTheJobs) {
  for (const char* name : {"cup.json", "sphere_octants.json", "cylinder.json", "seven/fold_back_cusp.json"}) {
    const ModelFile file = example(name);
    std::set<std::string> documents, tables;
    for (const int jobs : {1, 2, 8, 0}) {
      CertifyOptions options;
      options.jobs = jobs;
      const Report r = certify_model(file, options);
      documents.insert(json_of(r));
      tables.insert(table_of(r));
    }
    EXPECT_EQ(documents.size(), 1u) << name;
    EXPECT_EQ(tables.size(), 1u) << name;
  }
}

TEST(Report, Law2_TheTableListsEveryJoinAndTheWorstFirst) {
  const Report r = certify_model(example("cup.json"));
  const std::string table = table_of(r), quiet = table_of(r, {true, false});
  std::vector<int> ids;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    std::smatch m;
    if (std::regex_search(line, m, std::regex("^ *(\\d+) +\\S+ +\\S"))) ids.push_back(std::stoi(m[1]));
  }
  ids.resize(std::min(ids.size(), r.joins.size()));  // the summary follows
  ASSERT_EQ(ids.size(), r.joins.size());
  EXPECT_EQ(std::set<int>(ids.begin(), ids.end()).size(), r.joins.size());
  for (std::size_t i = 0; i + 1 < ids.size(); ++i)
    EXPECT_GE(r.joins[ids[i] - 1].certificate.angle.upper, r.joins[ids[i + 1] - 1].certificate.angle.upper);
  EXPECT_LT(quiet.size(), table.size());
  EXPECT_EQ(quiet.find("underside1"), std::string::npos);
  EXPECT_NE(quiet.find("65 joins"), std::string::npos);
  EXPECT_EQ(table.find('\x1b'), std::string::npos);
  EXPECT_NE(table_of(r, {false, true}).find('\x1b'), std::string::npos);
}

// A report of one join whose largest gap is in [lower, upper].
Report with_gap(double lower, double upper) {
  Report r;
  r.patch_names = {"a", "b"};
  ReportedJoin j;
  j.id = 1;
  j.a.edge = j.b.edge = "u_min";
  j.b.patch = 1;
  j.certificate.c0.verdict = Verdict::refuted;
  j.certificate.gap = {lower, upper, {}, true};
  r.joins.push_back(j);
  return r;
}

TEST(Report, Law3_BoundsReadBackAsTheSameDoubles) {
  std::mt19937_64 engine(11);
  for (int i = 0; i < 300; ++i) {
    const double lower = std::ldexp(static_cast<double>(engine()), static_cast<int>(engine() % 1800) - 1000);
    const double upper = std::nextafter(lower, 1e308);
    const Json d = Json::parse(json_of(with_gap(lower, upper)));
    EXPECT_EQ(d["joins"][0]["gap"]["lower"].get<double>(), lower);
    EXPECT_EQ(d["joins"][0]["gap"]["upper"].get<double>(), upper);
  }
  const Json none = Json::parse(json_of(with_gap(1, std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(none["joins"][0]["gap"]["upper"].is_null());
  EXPECT_TRUE(none["summary"]["worst_gap"].is_null());
}

TEST(Report, Law3_TheTableRoundsOutward) {
  std::mt19937_64 engine(12);
  const std::regex bounds("\\[([^,\\]]+), ([^\\]]+)\\]");
  const auto check = [&](double lower, double upper) {
    const std::string table = table_of(with_gap(lower, upper));
    std::smatch m;
    ASSERT_TRUE(std::regex_search(table, m, bounds)) << table;
    EXPECT_LE(std::strtod(m[1].str().c_str(), nullptr), lower) << m[0];
    EXPECT_GE(std::strtod(m[2].str().c_str(), nullptr), upper) << m[0];
    EXPECT_GE(std::strtod(m[1].str().c_str(), nullptr), lower * 0.9998) << m[0];
    EXPECT_LE(std::strtod(m[2].str().c_str(), nullptr), upper * 1.0002) << m[0];
  };
  for (int i = 0; i < 2000; ++i) {
    const double x = std::ldexp(static_cast<double>(engine()), static_cast<int>(engine() % 1800) - 1000);
    check(x, x * 1.001);
    // Next to a number of five digits, where the division by its last digit rounds.
    const double five =
        static_cast<double>(10000 + engine() % 90000) * std::pow(10.0, static_cast<int>(engine() % 40) - 20);
    check(std::nextafter(five, 0), std::nextafter(five, 1e308));
  }
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(table_of(with_gap(least, 3 * least)).find("nan"), std::string::npos);
}

const char* kTwoPlates = R"({"format": "patchproof-model", "version": 1, "patches": [
  {"name": "left", "degree": [1, 1], "control_points": [[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
  {"name": "right", "degree": [1, 1], "control_points": [[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]]]}])";

TEST(Report, DeclaredJoinsAreTakenAsTheyAre) {
  const auto report = [&](const std::string& joins) {
    return certify_model(read_good(std::string(kTwoPlates) + joins + "}", "two.json"));
  };
  const Report found = report("");
  ASSERT_EQ(found.joins.size(), 1u);
  EXPECT_EQ(found.joins[0].certificate.c2.verdict, Verdict::proven);
  EXPECT_EQ(found.unmatched.size(), 6u);
  const Report declared = report(R"(, "joins": [
    {"a": {"patch": 1, "edge": "u_min"}, "b": {"patch": 0, "edge": "u_max"}},
    {"a": {"patch": 0, "edge": "u_max"}, "b": {"patch": 1, "edge": "u_min"}, "reversed": true},
    {"a": {"patch": 0, "edge": "v_min"}, "b": {"patch": 1, "edge": "v_max"}}])");
  ASSERT_EQ(declared.joins.size(), 3u);
  EXPECT_EQ(declared.joins[0].a.patch, 1);
  EXPECT_EQ(declared.joins[0].certificate.c2.verdict, Verdict::proven);
  EXPECT_TRUE(declared.joins[1].reversed);
  EXPECT_EQ(declared.joins[1].certificate.c0.verdict, Verdict::refuted);
  EXPECT_LE(declared.joins[1].certificate.gap.lower, 1);
  EXPECT_GE(declared.joins[1].certificate.gap.upper, 1);
  EXPECT_GT(declared.joins[2].certificate.gap.lower, 1.4);
  EXPECT_EQ(declared.unmatched.size(), 4u);
  EXPECT_TRUE(Json::accept(json_of(declared)));
}

TEST(Report, NamesThatAreNoUtf8StillMakeADocument) {
  Report r = with_gap(1, 2);
  r.file = "caf\xe9.json";
  r.patch_names[0] = "\xff\xfe";
  EXPECT_TRUE(Json::accept(json_of(r)));
}

TEST(Report, OutcomeIsTheWorst) {
  Report r;
  EXPECT_EQ(r.outcome(), Outcome::pass);
  const auto add = [&](Outcome o) {
    r.joins.emplace_back();
    r.joins.back().judgement.outcome = o;
    return r.outcome();
  };
  EXPECT_EQ(add(Outcome::pass), Outcome::pass);
  EXPECT_EQ(add(Outcome::undecided), Outcome::undecided);
  EXPECT_EQ(add(Outcome::fail), Outcome::fail);
  EXPECT_EQ(add(Outcome::undecided), Outcome::fail);
}

TEST(Report, ProgressCountsEveryJoinOnce) {
  const ModelFile file = example("cup.json");
  std::atomic<std::size_t> calls{0}, total{0};
  CertifyOptions options;
  options.progress = [&](std::size_t, std::size_t all) { ++calls, total = all; };
  const Report r = certify_model(file, options);
  EXPECT_EQ(calls, r.joins.size());
  EXPECT_EQ(total, r.joins.size());
}

}  // namespace
}  // namespace patchproof::test
