// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <regex>
#include <sstream>

namespace patchproof {
namespace {

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

using Point = Vec<Rational, 4>;

std::vector<Rational> numbers(const std::vector<int>& v) {
  std::vector<Rational> out;
  for (const int x : v) out.push_back(q(x));
  return out;
}

ModelCurve<Rational> curve_of(const std::string& name, int degree, const std::vector<int>& knots,
                              std::vector<Point> points, int dimension = 2) {
  bool rational = false;
  for (const Point& p : points) rational = rational || !(p[3] == 1);
  return {name,
          BsplineCurve<Rational, 4>(KnotVector<Rational>::make(degree, numbers(knots)).value(), std::move(points)),
          rational, dimension};
}
Point at(int x, int y, int z = 0) { return {{q(x), q(y), q(z), q(1)}}; }

// Quadratic, on the unit square of the page's plane, with a jump at 1.
ModelCurve<Rational> jumping() {
  return curve_of("jumping", 2, {0, 0, 0, 1, 1, 1, 2, 3, 3, 3},
                  {at(0, 0), at(-1, 2), at(1, 4), at(2, 3), at(1, 1), at(1, 2), at(3, 1)});
}
ModelCurve<Rational> cubic() {
  return curve_of("cubic", 3, {0, 0, 0, 0, 1, 1, 1, 1}, {at(0, 0), at(0, 4), at(4, 4), at(4, 0)});
}
ModelCurve<Rational> half_circle() {
  return curve_of("half circle", 2, {0, 0, 0, 1, 1, 1}, {at(1, 0), {{q(0), q(1), q(0), q(0)}}, at(-1, 0)});
}
ModelPatch<Rational> saddle() {
  const auto knots = KnotVector<Rational>::make(1, numbers({0, 0, 1, 2, 2})).value();
  std::vector<Point> net;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) net.push_back(at(i, j, i * j));
  return {"saddle", BsplinePatch<Rational, 4>(knots, knots, net), false};
}
Model<Rational> model_of(std::vector<ModelCurve<Rational>> curves, std::vector<ModelPatch<Rational>> patches = {}) {
  Model<Rational> out;
  out.curves = std::move(curves);
  out.patches = std::move(patches);
  return out;
}

pugi::xml_document svg_of(const Model<Rational>& model, const PlotOptions& options = {}) {
  const auto text = plot(model, PlotFormat::svg, options);
  if (!text) throw std::runtime_error(text.error().text());
  pugi::xml_document document;
  if (!document.load_string(text->c_str())) throw std::runtime_error("no XML");
  return document;
}

std::vector<pugi::xml_node> of_class(const pugi::xml_node& root, const std::string& name) {
  std::vector<pugi::xml_node> out;
  const std::function<void(const pugi::xml_node&)> walk = [&](const pugi::xml_node& node) {
    if (node.attribute("class").as_string() == name) out.push_back(node);
    for (const pugi::xml_node& child : node.children()) walk(child);
  };
  walk(root);
  return out;
}

// The commands of a path, without their numbers.
std::string letters(const pugi::xml_node& path) {
  std::string out;
  for (const char c : std::string(path.attribute("d").as_string()))
    if (std::isalpha(static_cast<unsigned char>(c))) out += c;
  return out;
}

std::vector<double> path_numbers(const pugi::xml_node& path) {
  std::string text = path.attribute("d").as_string();
  for (char& c : text)
    if (std::isalpha(static_cast<unsigned char>(c))) c = ' ';
  std::istringstream in(text);
  std::vector<double> out;
  for (double x; in >> x;) out.push_back(x);
  return out;
}

// Coordinates of all paths, circles and texts: inside the viewBox?
void expect_all_in_view(const pugi::xml_document& document) {
  const pugi::xml_node svg = document.child("svg");
  std::istringstream box(svg.attribute("viewBox").as_string());
  double left, top, width, height;
  box >> left >> top >> width >> height;
  ASSERT_TRUE(box);
  EXPECT_EQ(svg.attribute("width").as_double(), width);
  int seen = 0;
  const auto inside = [&](double x, double y) {
    ++seen;
    EXPECT_TRUE(0 <= x && x <= width && 0 <= y && y <= height) << x << " " << y << " of " << width << " " << height;
  };
  const std::function<void(const pugi::xml_node&)> walk = [&](const pugi::xml_node& node) {
    const std::string name = node.name();
    if (name == "circle") inside(node.attribute("cx").as_double(), node.attribute("cy").as_double());
    if (name == "text" || name == "rect") inside(node.attribute("x").as_double(), node.attribute("y").as_double());
    if (name == "path") {
      const std::vector<double> n = path_numbers(node);
      EXPECT_EQ(n.size() % 2, 0u);
      for (std::size_t i = 0; i + 1 < n.size(); i += 2) inside(n[i], n[i + 1]);
    }
    for (const pugi::xml_node& child : node.children()) walk(child);
  };
  walk(svg);
  EXPECT_GT(seen, 10);
}

TEST(Plot, Law1_PathsAreExactBezierCommands) {
  const auto document = svg_of(model_of({jumping(), cubic()}));
  const auto paths = of_class(document, "curve");
  ASSERT_EQ(paths.size(), 3u);  // two components and one
  EXPECT_EQ(letters(paths[0]), "MQ");
  EXPECT_EQ(letters(paths[1]), "MQQ");
  EXPECT_EQ(letters(paths[2]), "MC");
  // The control points of the cubic are those of its path: the page's scale and origin follow from two of them.
  const std::vector<double> n = path_numbers(paths[2]);
  ASSERT_EQ(n.size(), 8u);
  const double scale = (n[6] - n[0]) / 4;
  EXPECT_GT(scale, 10);
  EXPECT_NEAR(n[2], n[0], 0.011);
  EXPECT_NEAR(n[1] - n[3], 4 * scale, 0.03);  // y points up on paper, down in SVG
  EXPECT_NEAR(n[4] - n[2], 4 * scale, 0.03);
  EXPECT_NEAR(n[7], n[1], 0.011);
  // Both limits at the jump: (1, 4) and (2, 3).
  const std::vector<double> before = path_numbers(paths[0]), after = path_numbers(paths[1]);
  EXPECT_NEAR(after[0] - before[4], scale, 0.03);
  EXPECT_NEAR(after[1] - before[5], scale, 0.03);
  EXPECT_EQ(letters(of_class(svg_of(model_of({curve_of("line", 1, {0, 0, 1, 2, 2}, {at(0, 0), at(2, 1), at(3, 0)})})),
                             "curve")[0]),
            "MLL");
}

TEST(Plot, Law1_RationalPiecesArePolylinesOnTheCurve) {
  const auto document = svg_of(model_of({half_circle()}), {"", false, {}, 40, {}, {}, {}});
  const auto paths = of_class(document, "curve");
  ASSERT_EQ(paths.size(), 1u);
  const std::vector<double> n = path_numbers(paths[0]);
  ASSERT_EQ(n.size(), 82u);
  const double radius = (n[0] - n[80]) / 2, x = (n[0] + n[80]) / 2, y = n[1];
  for (std::size_t i = 0; i < n.size(); i += 2) EXPECT_NEAR(std::hypot(n[i] - x, n[i + 1] - y), radius, 0.02);
  EXPECT_EQ(of_class(document, "vector").size(), 2u);  // in the picture and in the legend
  // Equal weights other than 1 are polynomial.
  auto scaled = cubic();
  std::vector<Point> points = scaled.curve.points();
  for (Point& p : points) p = q(3) * p;
  scaled.curve = BsplineCurve<Rational, 4>(scaled.curve.knots(), points);
  EXPECT_EQ(letters(of_class(svg_of(model_of({scaled})), "curve")[0]), "MC");
}

TEST(Plot, Law2_EverythingIsInView) {
  const std::vector<Model<Rational>> models{
      model_of({jumping(), cubic()}),
      model_of({half_circle()}),
      model_of({}, {saddle()}),
      model_of({cubic()}, {saddle()}),
      model_of({curve_of("dot", 0, {0, 1, 2}, {at(1, 1), at(1, 1)})}),
      model_of({curve_of("upright", 1, {0, 0, 1, 1}, {at(2, 0), at(2, 900)})}),
      model_of({curve_of("flat", 1, {0, 0, 1, 1}, {at(-1000000, 5), at(1000000, 5)})}),
      model_of({curve_of("in space", 1, {0, 0, 1, 1}, {at(0, 0, 0), at(1, 2, 3)}, 3)})};
  for (const auto& model : models) {
    expect_all_in_view(svg_of(model, {"A title", false, true, {}, {}, {}, {}}));
    expect_all_in_view(svg_of(model, {"", false, false, 3, {}, {}, {}}));
    expect_all_in_view(svg_of(model, {"A title", true, {}, {}, {}, {}, {}}));
  }
}

TEST(Plot, Law2_SizeAndPlaceDoNotMatter) {
  const auto scaled = [](const Rational& factor, const Rational& shift) {
    auto c = cubic();
    std::vector<Point> points = c.curve.points();
    for (Point& p : points) p = {{p[0] * factor + shift, p[1] * factor, p[2], p[3]}};
    c.curve = BsplineCurve<Rational, 4>(c.curve.knots(), points);
    return std::string(of_class(svg_of(model_of({c})), "curve")[0].attribute("d").as_string());
  };
  const std::string reference = scaled(q(1), q(0));
  EXPECT_EQ(scaled(from_double(std::ldexp(1, 900)), q(0)), reference);
  EXPECT_EQ(scaled(from_double(std::ldexp(1, -900)), q(0)), reference);
  EXPECT_EQ(scaled(q(1), q(1 << 20)), reference);
}

TEST(Plot, Law3_TheSameBytes) {
  const auto model = model_of({jumping(), half_circle()}, {saddle()});
  for (const PlotFormat format : {PlotFormat::svg, PlotFormat::obj, PlotFormat::stl, PlotFormat::vtu, PlotFormat::glb})
    EXPECT_EQ(plot(model, format).value(), plot(model, format).value());
}

TEST(Plot, Law4_OneLineForEachFunctionAndComponent) {
  const PlotOptions basis{"", true, {}, {}, {}, {}, {}};
  // 7 functions; none crosses the jump.
  auto document = svg_of(model_of({jumping()}), basis);
  EXPECT_EQ(of_class(document, "basis").size(), 1u);
  EXPECT_EQ(of_class(document, "function").size(), 7u);
  // Beyond multiplicity p + 1 one function is dead and has no line.
  const auto dead = curve_of("dead", 2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2}, std::vector<Point>(7, at(0, 0)));
  EXPECT_EQ(of_class(svg_of(model_of({dead}), basis), "function").size(), 6u);
  // The same knots once; weights make a second panel.
  document = svg_of(model_of({cubic(), cubic()}), basis);
  EXPECT_EQ(of_class(document, "basis").size(), 1u);
  document = svg_of(model_of({half_circle()}, {saddle()}), basis);
  EXPECT_EQ(of_class(document, "basis").size(), 3u);
  EXPECT_EQ(of_class(document, "function").size(), 3u + 3 + 3);
  // Each multiplicity is a dot.
  document = svg_of(model_of({jumping()}), basis);
  const auto dots = of_class(document, "multiplicities")[0].children("circle");
  EXPECT_EQ(std::distance(dots.begin(), dots.end()), 10);
}

TEST(Plot, Law4_TheLinesAreTheFunctions) {
  const auto document = svg_of(model_of({cubic()}), {"", true, {}, 4, {}, {}, {}});
  const auto lines = of_class(document, "function");
  ASSERT_EQ(lines.size(), 4u);
  const double bottom = path_numbers(lines[0]).back(), top = path_numbers(lines[0])[1];
  for (int i = 0; i < 4; ++i) {
    const std::vector<double> n = path_numbers(lines[i]);
    ASSERT_EQ(n.size(), 10u);
    for (int k = 0; k <= 4; ++k) {
      const double t = k / 4.0, binomial = i == 0 || i == 3 ? 1 : 3;
      const double value = binomial * std::pow(t, i) * std::pow(1 - t, 3 - i);
      EXPECT_NEAR((bottom - n[2 * k + 1]) / (bottom - top), value, 1e-4);
    }
  }
}

TEST(Plot, Law5_MeshFilesHoldThePartsInOrder) {
  const auto model = model_of({jumping()}, {saddle()});
  const std::string obj = plot(model, PlotFormat::obj, {"", false, {}, 2, {}, {}, {}}).value();
  std::vector<std::string> names;
  const std::regex object("\no (.*)\n");
  for (std::sregex_iterator it(obj.begin(), obj.end(), object), end; it != end; ++it) names.push_back((*it)[1]);
  EXPECT_EQ(names, (std::vector<std::string>{"jumping, component 0", "jumping, component 1", "saddle"}));
  const std::regex face("\nf ");
  EXPECT_EQ(std::distance(std::sregex_iterator(obj.begin(), obj.end(), face), std::sregex_iterator()), 16);
  const std::string glb = plot(model, PlotFormat::glb).value();
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  const std::string stl = plot(model, PlotFormat::stl, {"", false, {}, 3, {}, {}, {}}).value();
  EXPECT_EQ(stl.size(), 84u + 50 * 2 * 36);
  pugi::xml_document vtu;
  ASSERT_TRUE(vtu.load_string(plot(model, PlotFormat::vtu, {"", false, {}, {}, 0, {}, {}}).value().c_str()));
  EXPECT_EQ(vtu.child("VTKFile").child("UnstructuredGrid").child("Piece").attribute("NumberOfCells").as_int(), 3 * 16);
}

TEST(Plot, ChoicesAndControl) {
  const auto model = model_of({jumping(), cubic()}, {saddle()});
  EXPECT_EQ(of_class(svg_of(model, {"", false, {}, {}, 1, {}, {}}), "curve").size(), 1u);
  EXPECT_EQ(of_class(svg_of(model, {"", false, {}, {}, 1, {}, {}}), "facet").size(), 0u);
  EXPECT_EQ(of_class(svg_of(model, {"", false, {}, 3, {}, 0, {}}), "facet").size(), 36u);
  EXPECT_EQ(of_class(svg_of(model, {"", false, {}, 3, {}, 0, {}}), "curve").size(), 0u);
  EXPECT_EQ(of_class(svg_of(model, {"", false, {}, 3, 0, 0, {}}), "curve").size(), 2u);
  EXPECT_EQ(of_class(svg_of(model), "polygon").size(), 2u);
  EXPECT_EQ(of_class(svg_of(model), "net").size(), 0u);
  EXPECT_EQ(of_class(svg_of(model, {"", false, false, {}, {}, {}, {}}), "polygon").size(), 0u);
  EXPECT_EQ(of_class(svg_of(model, {"", false, true, {}, {}, {}, {}}), "net").size(), 1u);
}

TEST(Plot, Law5_Solids) {
  using Map = TransfiniteMap<Rational, 3, 4>;
  // A unit cube, twice as long, with a jump along u at 1.
  const auto knots = KnotVector<Rational>::make(1, numbers({0, 0, 1, 1, 2, 2})).value();
  std::vector<Map> along_u;
  for (const int x : {0, 1, 3, 4}) {
    const auto bar = [&](int y) { return Map::bezier(2, {Map(at(x, y, 0)), Map(at(x, y, 1))}).value(); };
    along_u.push_back(Map::bezier(1, {bar(0), bar(1)}).value());
  }
  Model<Rational> model = model_of({cubic()}, {saddle()});
  model.solids.push_back({"bar", Map::blend(0, knots, along_u).value()});
  const PlotOptions only{"", false, {}, 2, {}, {}, 0};
  const auto document = svg_of(model, only);
  expect_all_in_view(document);
  EXPECT_EQ(of_class(document, "facet").size(), 2u * 6 * 4);
  EXPECT_EQ(of_class(svg_of(model), "curve").size(), 1u);
  pugi::xml_document vtu;
  ASSERT_TRUE(vtu.load_string(plot(model, PlotFormat::vtu, only).value().c_str()));
  const auto piece = vtu.child("VTKFile").child("UnstructuredGrid").child("Piece");
  EXPECT_EQ(piece.attribute("NumberOfCells").as_int(), 2 * 8);
  EXPECT_EQ(piece.attribute("NumberOfPoints").as_int(), 2 * 27);
  EXPECT_EQ(plot(model, PlotFormat::stl, only).value().size(), 84u + 50 * 2 * 24 * 2);
  EXPECT_FALSE(plot(model, PlotFormat::svg, {"", true, {}, {}, {}, {}, 0}).has_value());
  EXPECT_EQ(plot(model, PlotFormat::svg, {"", false, {}, {}, {}, {}, 1}).error().code, ErrorCode::bad_reference);
}

TEST(Plot, FacetsStandFromBackToFront) {
  // Two upright walls, the nearer one given first: it must be drawn last.
  const auto wall = [](const std::string& name, int y) {
    const auto knots = KnotVector<Rational>::bezier(1);
    return ModelPatch<Rational>{
        name, BsplinePatch<Rational, 4>(knots, knots, {at(0, y, 0), at(0, y, 9), at(9, y, 0), at(9, y, 9)}), false};
  };
  const auto first_facet = [](const Model<Rational>& m) {
    return std::string(of_class(svg_of(m, {"", false, {}, 1, {}, {}, {}}), "facet")[0].attribute("d").as_string());
  };
  EXPECT_EQ(first_facet(model_of({}, {wall("near", 0), wall("far", 5)})),
            first_facet(model_of({}, {wall("far", 5), wall("near", 0)})));
}

TEST(Plot, Errors) {
  const auto model = model_of({jumping()}, {saddle()});
  const auto code = [&](const Model<Rational>& m, PlotFormat format, const PlotOptions& options) {
    const auto result = plot(m, format, options);
    EXPECT_FALSE(result.has_value());
    return result.error().code;
  };
  EXPECT_EQ(code(model_of({}), PlotFormat::svg, {}), ErrorCode::usage);
  EXPECT_EQ(code(model_of({jumping()}), PlotFormat::stl, {}), ErrorCode::usage);
  EXPECT_EQ(code(model, PlotFormat::svg, {"", false, {}, {}, 1, {}, {}}), ErrorCode::bad_reference);
  EXPECT_EQ(code(model, PlotFormat::obj, {"", false, {}, {}, {}, 1, {}}), ErrorCode::bad_reference);
  EXPECT_EQ(code(model, PlotFormat::svg, {"", false, {}, {}, -1, {}, {}}), ErrorCode::bad_reference);
  EXPECT_EQ(code(model_of({jumping()}), PlotFormat::svg, {"", false, {}, {}, {}, 0, {}}), ErrorCode::bad_reference);
  EXPECT_EQ(code(model, PlotFormat::obj, {"", true, {}, {}, {}, {}, {}}), ErrorCode::usage);
  EXPECT_EQ(code(model, PlotFormat::svg, {"", false, {}, 0, {}, {}, {}}), ErrorCode::usage);
  EXPECT_EQ(code(model, PlotFormat::svg, {"", false, {}, 2000000000, {}, {}, {}}), ErrorCode::usage);
  EXPECT_EQ(code(model, PlotFormat::obj, {"", false, {}, 2000000000, {}, {}, {}}), ErrorCode::usage);
  EXPECT_EQ(code(model, PlotFormat::svg, {"", true, {}, 2000000000, {}, {}, {}}), ErrorCode::usage);
  auto vanishing = half_circle();
  vanishing.curve =
      BsplineCurve<Rational, 4>(vanishing.curve.knots(), std::vector<Point>(3, {{q(1), q(1), q(0), q(0)}}));
  EXPECT_EQ(code(model_of({vanishing}), PlotFormat::svg, {}), ErrorCode::vanishing_weight);
}

TEST(Plot, Formats) {
  EXPECT_EQ(plot_format("svg"), PlotFormat::svg);
  EXPECT_EQ(plot_format(".GLB"), PlotFormat::glb);
  EXPECT_EQ(plot_format(".vtu"), PlotFormat::vtu);
  for (const char* name : {"", ".", "png", "svgz", "vtk", "stl "}) EXPECT_FALSE(plot_format(name).has_value()) << name;
}

TEST(Plot, NumbersWithARoot) {
  const Quadratic one(1), zero(0), w(q(0), q(1, 2), 2);
  Model<Quadratic> model;
  model.curves.push_back(
      {"quarter",
       BsplineCurve<Quadratic, 4>(KnotVector<Quadratic>::bezier(2),
                                  {{{one, zero, zero, one}}, {{w, w, zero, w}}, {{zero, one, zero, one}}}),
       true, 2});
  EXPECT_TRUE(plot(model, PlotFormat::svg).has_value());
  EXPECT_TRUE(plot(model, PlotFormat::svg, {"", true, {}, {}, {}, {}, {}}).has_value());
  EXPECT_TRUE(plot(model, PlotFormat::vtu).has_value());
}

}  // namespace
}  // namespace patchproof
