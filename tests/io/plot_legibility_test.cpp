// SPDX-License-Identifier: Apache-2.0
// Whether a reader can tell what a picture shows: names of functions, curves on each other, long names.
#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "patchproof/io/plot.h"
#include "patchproof/io/read.h"

namespace patchproof {
namespace {

Model<Rational> model_of(const std::string& json) {
  const auto file = read_model_text(R"({"format": "patchproof-model", "version": 1, )" + json + "}", "test.json");
  if (!file) throw std::runtime_error(file.error().text());
  return std::get<Model<Rational>>(file->model);
}

pugi::xml_document svg_of(const Model<Rational>& model, const PlotOptions& options = {}) {
  pugi::xml_document document;
  document.load_string(plot(model, PlotFormat::svg, options).value().c_str());
  return document;
}

// How often each text stands in the picture, or the texts of a class.
std::multiset<std::string> texts(const pugi::xml_document& svg) {
  std::multiset<std::string> out;
  for (const auto& found : svg.select_nodes("//text")) out.insert(found.node().child_value());
  return out;
}
std::vector<std::string> dashes(const pugi::xml_document& svg) {
  std::vector<std::string> out;
  for (const auto& found : svg.select_nodes("//path[@class='curve']"))
    out.emplace_back(found.node().attribute("stroke-dasharray").as_string());
  return out;
}

const PlotOptions kBasis{"", true, {}, {}, {}, {}, {}};

std::string curve(const std::string& knots, int points, const std::string& more = "") {
  std::string out = R"({"degree": 2, "knots": [)" + knots + R"(], "control_points": [)";
  for (int i = 0; i < points; ++i)
    out += (i == 0 ? "[" : ", [") + std::to_string(i) + ", " + std::to_string(i % 2) + "]";
  return out + "]" + more + "}";
}

TEST(Plot, Law6_EveryFunctionIsNamed) {
  // Knots of multiplicity p + 1: two functions have their peak at one place.
  auto names = texts(svg_of(model_of(R"("curves": [)" + curve("0, 0, 0, 1, 1, 1, 2, 3, 3, 3", 7) + "]"), kBasis));
  for (const char* name : {"N₀", "N₁", "N₂", "N₃", "N₄", "N₅", "N₆"}) EXPECT_EQ(names.count(name), 1u) << name;
  // A function without support is named below, and said to be 0.
  names = texts(svg_of(model_of(R"("curves": [)" + curve("0, 0, 0, 1, 1, 1, 1, 2, 2, 2", 7) + "]"), kBasis));
  EXPECT_EQ(names.count("N₃ = 0"), 1u);
  EXPECT_EQ(names.count("N₃"), 0u);
  EXPECT_EQ(names.count("N₄"), 1u);
  // Weights that flatten a function: its line is hidden among others, and its name finds a place all the same.
  names = texts(
      svg_of(model_of(R"("curves": [)" +
                      curve("0, 0, 0, 1, 1, 2, 2, 3, 3, 3", 7, R"(, "weights": [1, 50, 1, 50, 1, 50, "1/100"])") + "]"),
             kBasis));
  for (const std::string digit : {"₀", "₁", "₂", "₃", "₄", "₅", "₆"}) {
    const auto is_name = [&](const std::string& t) { return t == "R" + digit || t.starts_with("R" + digit + " on ["); };
    EXPECT_EQ(std::count_if(names.begin(), names.end(), is_name), 1) << digit;
  }
}

// So many functions that no name has room beside its line: forty stand below with their supports, the rest are counted.
TEST(Plot, Law6_Crowds) {
  std::string knots = "0, 0, 0";
  for (int i = 1; i < 900; ++i) knots += ", " + std::to_string(i);
  const auto svg = svg_of(model_of(R"("curves": [)" + curve(knots + ", 900, 900, 900", 902) + "]"), kBasis);
  std::size_t listed = 0, named = 0, more = 0;
  for (const std::string& text : texts(svg)) {
    if (text.find(" on [") != std::string::npos) {
      ++listed;
    } else if (text.starts_with("N") && text.find(' ') == std::string::npos) {
      ++named;
    } else if (text.starts_with("and ")) {
      more += std::stoul(text.substr(4));
    }
  }
  EXPECT_EQ(listed, 40u);
  EXPECT_EQ(listed + named + more, 902u);
  std::istringstream box(svg.child("svg").attribute("viewBox").as_string());
  double left, top, width, height;
  box >> left >> top >> width >> height;
  for (const auto& found : svg.select_nodes("//text")) EXPECT_LT(found.node().attribute("y").as_double(), height);
}

TEST(Plot, Law7_CurvesOnEachOther) {
  const std::string parabola = R"({"degree": 2, "control_points": [[0, 0], [1, 2], [2, 0]]})",
                    // its right half, and the same run backwards
      half = R"({"degree": 2, "control_points": [[1, 1], ["3/2", 1], [2, 0]]})",
                    crossing = R"({"degree": 1, "control_points": [[0, 1], [2, 0]]})";
  const auto drawn = [&](const std::string& curves) {
    return dashes(svg_of(model_of("\"curves\": [" + curves + "]")));
  };
  auto found = drawn(parabola + "," + half);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], "");
  EXPECT_NE(found[1], "");
  // A curve that is longer than the one below it is whole where it is alone.
  found = drawn(half + "," + parabola);
  EXPECT_EQ(found[0], "");
  std::istringstream lengths(found[1]);
  double first = 0;
  lengths >> first;
  EXPECT_GT(first, 300);
  // Three on each other: wider gaps.
  found = drawn(parabola + "," + parabola + "," + parabola);
  const auto gap = [](const std::string& text) {
    std::istringstream in(text);
    double dash = 0, gap = 0;
    in >> dash >> gap;
    return gap / dash;
  };
  EXPECT_NEAR(gap(found[1]), 1, 0.2);
  EXPECT_NEAR(gap(found[2]), 2, 0.3);
  // Crossing is nothing.
  EXPECT_EQ(drawn(parabola + "," + crossing), (std::vector<std::string>{"", ""}));
}

TEST(Plot, Law2_LongNamesAreShortenedInTheMiddle) {
  std::string name(300, 'W');
  const auto svg = svg_of(model_of(R"("curves": [{"name": ")" + ("a" + name + "z") +
                                   R"(", "degree": 1, "control_points": [[0, 0], [2, 0]]}])"),
                          {"begin " + name + " end", false, {}, {}, {}, {}, {}});
  std::size_t shortened = 0;
  for (const auto& found : svg.select_nodes("//text")) {
    const std::string text = found.node().child_value();
    EXPECT_LT(text.size(), 160u) << text;
    if (text.find("W…W") != std::string::npos) ++shortened;
    EXPECT_EQ(text.starts_with("begin"), text.ends_with(" end"));
    EXPECT_TRUE(text.find(": degree 1") == std::string::npos || text.starts_with("aW"));
  }
  EXPECT_EQ(shortened, 3u);  // title, subtitle, legend
}

TEST(Plot, LegendsSayWhichLines) {
  const std::string flat = R"("control_points": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]])";
  const auto bezier = texts(svg_of(model_of(R"("patches": [{"degree": [1, 1], )" + flat + "]}]")));
  EXPECT_EQ(bezier.count("edges"), 1u);
  EXPECT_EQ(bezier.count("parameter lines"), 1u);
  const auto spline =
      texts(svg_of(model_of(R"("patches": [{"degree": [1, 1], "knots": [[0, 0, 1, 2, 2], [0, 0, 1, 1]], )" + flat +
                            ", [[2, 0, 0], [2, 1, 0]]]}]")));
  EXPECT_EQ(spline.count("edges and knot lines"), 1u);
}

// Knots have their values also where there are several curves.
TEST(Plot, KnotsOfSeveralCurves) {
  std::string curves;
  for (int i = 0; i < 4; ++i)
    curves += std::string(i == 0 ? "" : ", ") + R"({"degree": 1, "knots": [7, 7, 8, 9, 9], "control_points": [[0, )" +
              std::to_string(i) + "], [1, " + std::to_string(i) + "], [2, " + std::to_string(i) + "]]}";
  EXPECT_EQ(texts(svg_of(model_of("\"curves\": [" + curves + "]"))).count("8"), 4u);
}

}  // namespace
}  // namespace patchproof
