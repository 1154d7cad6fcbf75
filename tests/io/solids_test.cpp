// SPDX-License-Identifier: Apache-2.0
// Solids in our JSON: read, evaluated, written back, and what is wrong with bad ones.
#include <gtest/gtest.h>

#include <sstream>

#include "patchproof/io/read.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/transfinite_calculus.h"

namespace patchproof::test {
namespace {

std::string model_with(const std::string& solid, const std::string& more = "") {
  return R"({"format": "patchproof-model", "version": 1, "solids": [)" + solid + R"(], "patches": [
    {"degree": [1, 1], "control_points": [[[0, 0, 0], [2, -4, 2]], [[0, 3, 1], [4, 0, 0]]]},
    {"degree": [2, 1], "control_points": [[[0, 0, 5], [2, -4, 7]], [[0, 1.5, 5.5], [3, -2, 6]], [[0, 3, 7], [4, 0, 6]]]},
    {"degree": [1, 1], "control_points": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]],
     "weights": [[1, 2], [3, 4]]},
    {"degree": [1, 1], "control_points": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]],
     "weights": [[-1, -2], [-3, -4]]},
    {"degree": [1, 1], "knots": [[0, 0, 2, 2], [0, 0, 1, 1]],
     "control_points": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]]}]})" +
         more;
}

Result<ModelFile> read(const std::string& text) { return read_model_text(text, "solid.json"); }
const Model<Rational>& exact(const Result<ModelFile>& file) { return std::get<Model<Rational>>(file->model); }

TEST(Solids, APatchAPointAndALiftedPatch) {
  const auto file = read(model_with(R"({"name": "s", "transfinite": {"degree": 2, "controls": [0, [1, 1, 3], 1]}})"));
  ASSERT_TRUE(file) << file.error().text();
  const ModelSolid<Rational>& s = exact(file).solids.at(0);
  EXPECT_EQ(s.name, "s");
  const struct {
    const char* at;
    const char* values[4];  // the point, then the derivatives by u, v and w
  } rows[] = {
      {"0 0 0", {"0 0 0", "0 3 1", "2 -4 2", "2 2 6"}},
      {"1/2 1/3 1/4", {"1 7/12 359/192", "5/12 25/12 1/16", "15/8 -35/16 5/16", "0 2/3 119/24"}},
      {"1 1 1", {"4 0 6", "2 4 0", "4 -3 -1", "6 -2 6"}},
      {"1/5 4/5 1/2", {"73/50 -18/25 171/50", "4/5 19/10 -3/5", "6/5 -19/10 7/10", "0 0 126/25"}},
      {"3/4 1/8 1", {"7/16 59/32 201/32", "1/4 25/8 17/8", "7/2 -13/4 -1/4", "-9/8 27/16 105/16"}},
  };
  const auto numbers = [](const std::string& text) {
    std::istringstream in(text);
    std::array<Rational, 3> out;
    for (Rational& x : out) {
      std::string word;
      in >> word;
      x = parse_scalar<Rational>(word).value();
    }
    return out;
  };
  for (const auto& row : rows) {
    const auto t = rational_taylor(s.map, ParameterPlace<Rational, 3>(numbers(row.at)), 1);
    for (int k = 0; k < 4; ++k) {
      std::array<int, 3> alpha{};
      if (k > 0) alpha[k - 1] = 1;
      for (int c = 0; c < 3; ++c) EXPECT_EQ(t[c].derivative(alpha), numbers(row.values[k])[c]) << row.at;
    }
  }
}

TEST(Solids, WhatIsWrittenReadsBack) {
  const auto file = read(model_with(
      R"({"name": "s", "transfinite": {"degree": 1, "knots": [0, 0, "1/3", 5, 5], "controls": [1, [1, "2/7", 3], 2]}},
         {"transfinite": {"degree": 0, "controls": [0]}})"));
  ASSERT_TRUE(file) << file.error().text();
  const std::string text = write_model_json(exact(file));
  const auto again = read(text);
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(write_model_json(exact(again)), text);
  ASSERT_EQ(exact(again).solids.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(identical(exact(file).solids[k].map, exact(again).solids[k].map));
    EXPECT_EQ(exact(file).solids[k].name, exact(again).solids[k].name);
  }
  EXPECT_EQ(exact(again).solids[0].knots->domain_end(), 5);
}

TEST(Solids, BadOnesAreNamed) {
  const struct {
    const char* solid;
    ErrorCode code;
    const char* where;
  } cases[] = {
      {R"({"transfinite": {"degree": 1, "controls": [0, 5]}})", ErrorCode::bad_reference,
       "/solids/0/transfinite/controls/1"},
      {R"({"transfinite": {"degree": 1, "controls": [0, -1]}})", ErrorCode::bad_reference,
       "/solids/0/transfinite/controls/1"},
      {R"({"transfinite": {"degree": 1, "controls": [0, 3]}})", ErrorCode::unsupported,
       "/solids/0/transfinite/controls/1"},
      {R"({"transfinite": {"degree": 2, "controls": [0, 1]}})", ErrorCode::wrong_count, "/solids/0/transfinite"},
      {R"({"transfinite": {"degree": 1, "controls": [0, 4]}})", ErrorCode::domains_differ, "/solids/0/transfinite"},
      {R"({"transfinite": {"degree": 1, "knots": [0, 0, 1, 0], "controls": [0, 1]}})", ErrorCode::decreasing_knots,
       "/solids/0/transfinite"},
      {R"({"transfinite": {"degree": 1, "controls": [0, [1, "x", 2]]}})", ErrorCode::bad_number,
       "/solids/0/transfinite"},
      {R"({"transfinite": {"degree": 1, "controls": []}})", ErrorCode::wrong_count, "/solids/0/transfinite"},
      {R"({"name": "nothing"})", ErrorCode::syntax, "/solids/0"},
  };
  for (const auto& bad : cases) {
    const auto file = read(model_with(bad.solid));
    ASSERT_FALSE(file) << bad.solid;
    EXPECT_EQ(file.error().code, bad.code) << file.error().text();
    EXPECT_NE(file.error().where.find(bad.where), std::string::npos) << file.error().text();
  }
}

}  // namespace
}  // namespace patchproof::test
