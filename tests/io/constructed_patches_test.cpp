// SPDX-License-Identifier: Apache-2.0
// Law 5 of include/patchproof/io/read.h: patches of our JSON model that are made from curves. What they contain, and what is
// wrong with bad ones.
#include <functional>
#include <map>

#include <nlohmann/json.hpp>

#include "io/bad_files.h"
#include "io/io_support.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {
namespace {

using Json = nlohmann::ordered_json;
using test::exact;
using Point = Vec<Rational, 3>;

Json straight(const Json& a, const Json& b) { return {{"degree", 1}, {"control_points", {a, b}}}; }

Json model_of(const Json& patch) { return {{"format", "patchproof-model"}, {"version", 1}, {"patches", {patch}}}; }

// The unit square.
Json square() {
  return {{"v_min", straight({0, 0, 0}, {1, 0, 0})},
          {"v_max", straight({0, 1, 0}, {1, 1, 0})},
          {"u_min", straight({0, 0, 0}, {0, 1, 0})},
          {"u_max", straight({1, 0, 0}, {1, 1, 0})}};
}
Json network() {
  return {{"u", {0, 1}},
          {"v", {0, 1}},
          {"along_u", {straight({0, 0, 0}, {1, 0, 0}), straight({0, 1, 0}, {1, 1, 0})}},
          {"along_v", {straight({0, 0, 0}, {0, 1, 0}), straight({1, 0, 0}, {1, 1, 0})}}};
}
Json blend() {
  return {
      {"along", "v"}, {"degree", 1}, {"controls", {straight({0, 0, 0}, {1, 0, 0}), straight({0, 1, 0}, {1, 1, 0})}}};
}
// The same with something changed.
Json changed(Json what, const std::function<void(Json&)>& change) {
  change(what);
  return what;
}

const ModelFile& file_of(const std::string& name) {
  static std::map<std::string, ModelFile> read;
  const auto path = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "tests/data/model" / name;
  if (!read.contains(name)) read.emplace(name, test::read_good(test::bytes_of(path), path.string()));
  return read.at(name);
}
// The patch whose name begins so.
const ModelPatch<Rational>& patch(const std::string& name) {
  for (const char* file : {"good_constructions.json", "good_coons.json"})
    for (const ModelPatch<Rational>& p : test::rational_model(file_of(file)).patches)
      if (p.name.starts_with(name)) return p;
  throw std::out_of_range(name);
}
Point at(const std::string& name, const std::string& u, const std::string& v) {
  return evaluate_rational(patch(name).surface, exact(u), exact(v));
}
Point point(const std::string& x, const std::string& y, const std::string& z) {
  return {{exact(x), exact(y), exact(z)}};
}
Point project_bezier(const std::vector<Vec<Rational, 4>>& points, const Rational& t) {
  return evaluate_rational(BsplineCurve<Rational, 4>::bezier(points), t);
}

TEST(ConstructedPatches, Law5_NotesSayWhatWasMade) {
  EXPECT_EQ(file_of("good_constructions.json").notes,
            (std::vector<std::string>{
                "patch 0: bilinearly blended Coons patch, expanded exactly to degree (2, 1)",
                "patch 1: transfinite patch, blended along u, expanded exactly to degree (2, 2)",
                "patch 2: Gordon surface through 2 and 3 curves, expanded exactly to degree (2, 3)",
            }));
  EXPECT_EQ(file_of("good_coons.json").notes,
            (std::vector<std::string>{
                "patch 0: bicubically blended Coons patch, expanded exactly to degree (4, 4)",
                "patch 1: bilinearly blended Coons patch of rational curves, expanded exactly to degree (5, 1)",
            }));
}

TEST(ConstructedPatches, Law5_CoonsPatchesContainTheirBoundaries) {
  for (const std::string t : {"0", "1/7", "1/3", "5/6", "1"}) {
    EXPECT_EQ(at("a fan", t, "1"), point("1", "5", "1/2"));
    const Rational x = exact(t), one(1);
    EXPECT_EQ(at("a fan", t, "0"), project_bezier({{{Rational(0), Rational(0), Rational(0), one}},
                                                   {{one, one, exact("1/3"), one}},
                                                   {{Rational(2), Rational(0), Rational(0), one}}},
                                                  x));
    EXPECT_EQ(at("a fan", "0", t), (Point{{x, Rational(5) * x, x / Rational(2)}}));
  }
  EXPECT_EQ(at("a fan", "1", "1/3"), point("3", "3", "3"));
}

TEST(ConstructedPatches, Law5_BicubicPatchesHaveTheirDerivatives) {
  const auto across = [](const std::string& u, const std::string& v) {
    return rational_derivatives(patch("bicubically").surface, exact(u), exact(v), 1, 1);
  };
  EXPECT_EQ(across("1", "0").at(0, 1), point("0", "1", "3/8"));  // the middle of [0, 2]
  EXPECT_EQ(across("1/2", "1").at(0, 1), point("0", "1", "0"));
  EXPECT_EQ(across("0", "1/3").at(1, 0), point("1", "0", "0"));
  EXPECT_EQ(across("2", "1/2").at(1, 0), point("1", "0", "-3/8"));
  EXPECT_EQ(at("bicubically", "2", "1/3"), point("2", "1/3", "0"));
}

// Boundaries on the unit cylinder with other factors in their weights: the surface is that cylinder.
TEST(ConstructedPatches, Law5_RationalCoonsPatches) {
  EXPECT_TRUE(patch("rational").is_rational);
  for (const std::string u : {"0", "1/5", "1/2", "1"}) {
    const Point p = at("rational", u, "1/3");
    EXPECT_EQ(p[0] * p[0] + p[1] * p[1], Rational(1));
    EXPECT_EQ(p[2], exact("1/3"));
  }
}

TEST(ConstructedPatches, Law5_TransfinitePatchesBlendHomogeneousPoints) {
  EXPECT_EQ(at("curves and points", "0", "1/2"), point("0", "0", "0"));
  EXPECT_EQ(at("curves and points", "2", "1/4"), point("3", "1", "0"));
  // At u = 1 the second and the third control weigh 1/2 each; at v = 1/2 they are (1, 1/2, 0; 1) and (1.5, 0.75, 1/8; 3/4).
  EXPECT_EQ(evaluate(patch("curves and points").surface, Rational(1), exact("1/2")),
            (Vec<Rational, 4>{{exact("5/4"), exact("5/8"), exact("1/16"), exact("7/8")}}));
}

TEST(ConstructedPatches, Law5_GordonSurfacesContainTheirNetwork) {
  EXPECT_EQ(at("through a network", "1/2", "0"), point("1/2", "0", "1/2"));
  EXPECT_EQ(at("through a network", "1/4", "0"), point("1/4", "0", "3/8"));
  EXPECT_EQ(at("through a network", "1/4", "1"), point("1/4", "1", "-3/8"));
  EXPECT_EQ(at("through a network", "1", "1/3"), point("1", "1/3", "0"));
  EXPECT_EQ(at("through a network", "1/2", "1/2"),
            project_bezier({{{exact("1/2"), exact("0"), exact("1/2"), exact("1")}},
                            {{exact("1/2"), exact("0"), exact("2"), exact("1")}},
                            {{exact("1/2"), exact("1"), exact("1"), exact("1")}},
                            {{exact("1/2"), exact("1"), exact("-1/2"), exact("1")}}},
                           exact("1/2")));
}

void expect_error(const Json& patch, ErrorCode code, const std::string& pointer, const std::string& values,
                  const std::string& message = "") {
  const std::string text = model_of(patch).dump();
  test::expect_error({text, "m.json", text, code, "m.json:1 at /patches/0" + pointer, values},
                     read_model_text(text, "m.json"));
  const auto file = read_model_text(text, "m.json");
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().message.find(message), std::string::npos) << file.error().text();
}

TEST(ConstructedPatches, BadCoonsPatches) {
  const auto bad = [](const std::function<void(Json&)>& change, ErrorCode code, const std::string& pointer,
                      const std::string& values, const std::string& message = "") {
    expect_error({{"coons", changed(square(), change)}}, code, "/coons" + pointer, values, message);
  };
  EXPECT_TRUE(read_model_text(model_of({{"coons", square()}}).dump(), "m.json"));
  bad(
      [](Json& c) {
        c["u_max"] = straight({1, 0, 0}, {1, 1, "1/3"});
      },
      ErrorCode::curves_apart, "", "(1, 1, 0) and (1, 1, 1/3)", "corner u_max, v_max");
  bad([](Json& c) { c["v_min"]["knots"] = {0, 0, 2, 2}; }, ErrorCode::domains_differ, "", "[0, 2] and [0, 1]");
  bad([](Json& c) { c.erase("u_min"); }, ErrorCode::syntax, "", "", "\"u_min\"");
  bad([](Json& c) { c["w_min"] = 1; }, ErrorCode::syntax, "/w_min", "w_min");
  bad([](Json& c) { c["u_min"] = 1; }, ErrorCode::syntax, "/u_min", "1", "an object or an array");
  bad([](Json& c) { c["u_min"] = {0}; }, ErrorCode::wrong_count, "/u_min", "1");
  bad([](Json& c) { c["u_min"] = {0, 0, "x"}; }, ErrorCode::bad_number, "/u_min/2", "x");
  bad([](Json& c) { c["u_min"]["degree"] = 2; }, ErrorCode::wrong_count, "/u_min/control_points", "2 control points");
  bad([](Json& c) { c["u_min"]["weights"] = {1, -1}; }, ErrorCode::vanishing_weight, "/u_min/weights", "t = 1/2");
  bad([](Json& c) { c["u_min"]["degree"] = {1, 1}; }, ErrorCode::syntax, "/u_min/degree", "");
  bad([](Json& c) { c["across_u_min"] = {1, 0, 0}; }, ErrorCode::wrong_count, "", "1", "all four");
  const auto across = [](Json& c) {
    for (const char* side : {"v_min", "v_max"}) c[std::string("across_") + side] = {0, 1, 0};
    for (const char* side : {"u_min", "u_max"}) c[std::string("across_") + side] = {1, 0, 0};
  };
  EXPECT_TRUE(read_model_text(model_of({{"coons", changed(square(), across)}}).dump(), "m.json"));
  bad(
      [&](Json& c) {
        across(c);
        c["across_v_min"] = {0, 2, 0};
      },
      ErrorCode::curves_apart, "", "(0, 2, 0) and (0, 1, 0)");
  bad(
      [&](Json& c) {
        across(c);
        c["across_v_min"] = {{"degree", 2}, {"control_points", {{0, 1, 0}, {0, 1, 1}, {0, 1, 0}}}};
      },
      ErrorCode::twists_differ, "", "(0, 0, 2) and (0, 0, 0)");
  bad(
      [&](Json& c) {
        across(c);
        c["v_min"]["weights"] = {1, 2};
      },
      ErrorCode::unsupported, "", "");
}

TEST(ConstructedPatches, BadBlendings) {
  const auto bad = [](const std::function<void(Json&)>& change, ErrorCode code, const std::string& pointer,
                      const std::string& values, const std::string& message = "") {
    expect_error({{"transfinite", changed(blend(), change)}}, code, "/transfinite" + pointer, values, message);
  };
  EXPECT_TRUE(read_model_text(model_of({{"transfinite", blend()}}).dump(), "m.json"));
  bad([](Json& t) { t["along"] = "w"; }, ErrorCode::syntax, "/along", "w");
  bad([](Json& t) { t["degree"] = 2; }, ErrorCode::wrong_count, "", "2", "3 controls");
  bad([](Json& t) { t["degree"] = 65; }, ErrorCode::bad_degree, "/degree", "65");
  bad([](Json& t) { t["knots"] = {0, 1, 0, 1}; }, ErrorCode::decreasing_knots, "/knots/2", "0 after 1");
  bad([](Json& t) { t["controls"] = Json::array(); }, ErrorCode::wrong_count, "", "0");
  bad([](Json& t) { t["controls"][1]["knots"] = {0, 0, 2, 2}; }, ErrorCode::domains_differ, "", "0 … 2 after 0 … 1");
  bad([](Json& t) { t["controls"][1] = {1, 2, 3, 4}; }, ErrorCode::wrong_count, "/controls/1", "4");
  bad([](Json& t) { t["controls"][1] = "a curve"; }, ErrorCode::syntax, "/controls/1", "a curve");
  // Weights 1 and −1 at the two ends: somewhere between, the blend of them is 0.
  bad(
      [](Json& t) {
        t["controls"][1]["weights"] = {-1, -1};
      },
      ErrorCode::vanishing_weight, "", "u in [0, 1], v in [0, 1]");
  bad([](Json& t) { t["control_points"] = Json::array(); }, ErrorCode::syntax, "/control_points", "control_points");
}

TEST(ConstructedPatches, BadNetworks) {
  const auto bad = [](const std::function<void(Json&)>& change, ErrorCode code, const std::string& pointer,
                      const std::string& values, const std::string& message = "") {
    expect_error({{"gordon", changed(network(), change)}}, code, "/gordon" + pointer, values, message);
  };
  EXPECT_TRUE(read_model_text(model_of({{"gordon", network()}}).dump(), "m.json"));
  bad([](Json& g) { g["u"] = {0, "1/2", 1}; }, ErrorCode::wrong_count, "", "2 curves, 3 parameters");
  bad([](Json& g) { g["u"] = {1, 0}; }, ErrorCode::decreasing_knots, "", "0 after 1");
  bad([](Json& g) { g["u"] = Json::array(); }, ErrorCode::wrong_count, "", "0", "at least two");
  bad([](Json& g) { g["u"] = {0, "one"}; }, ErrorCode::bad_number, "/u/1", "one");
  bad(
      [](Json& g) {
        g["along_v"][1] = straight({1, 0, 0}, {1, 1, 1});
      },
      ErrorCode::curves_apart, "", "(1, 1, 0) and (1, 1, 1)", "u = 1, v = 1");
  bad([](Json& g) { g["along_v"][1]["weights"] = {1, 2}; }, ErrorCode::unsupported, "", "");
}

TEST(ConstructedPatches, OneWayOnly) {
  expect_error({{"coons", square()}, {"gordon", network()}}, ErrorCode::syntax, "/gordon", "");
  expect_error({{"coons", square()}, {"degree", {1, 1}}}, ErrorCode::syntax, "", "");
  expect_error({{"name", "nothing"}}, ErrorCode::syntax, "", "", "\"degree\"");
}

// Small files whose expansions would be large.
TEST(ConstructedPatches, SizesThatNobodyMeant) {
  Json steep = blend();
  steep["degree"] = 40;
  steep["controls"] = Json::array();
  const Json wave = {{"degree", 64}, {"control_points", Json::array()}};
  for (int i = 0; i <= 40; ++i) {
    Json curve = wave;
    for (int k = 0; k <= 64; ++k) curve["control_points"].push_back({k, i, k % 2});
    steep["controls"].push_back(curve);
  }
  expect_error({{"transfinite", steep}}, ErrorCode::unsupported, "/transfinite",
               "1 x 1 spans of degree (64, 40), 41 curves, numbers of up to 2 characters");
  Json dense = network();
  for (int i = 2; i <= 3000; ++i) {
    dense["u"].push_back(i);
    dense["along_v"].push_back(straight({i, 0, 0}, {i, 1, 0}));
  }
  expect_error({{"gordon", dense}}, ErrorCode::bad_degree, "/gordon", "3001 curves");
  const std::string huge = "2e301";
  expect_error({{"transfinite", changed(blend(),
                                        [&](Json& t) {
                                          t["controls"][0] = straight({huge, 0, 0}, {0, 0, 0});
                                        })}},
               ErrorCode::bad_number, "/transfinite/controls/0/control_points/0/0", huge);
}

}  // namespace
}  // namespace patchproof
