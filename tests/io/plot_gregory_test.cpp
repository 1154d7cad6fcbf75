// SPDX-License-Identifier: Apache-2.0
// Laws 5, 8 and 9 of include/patchproof/io/plot.h: Gregory patches, normals, sections.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include "patchproof/io/plot.h"
#include "patchproof/mesh/domain_grid.h"
#include "patchproof/patch/bezier_patch.h"
#include "support/gregory_patches.h"
#include "support/gregory_reference.h"

namespace patchproof::test {
namespace {

using Point3 = Vec<double, 3>;

Model<Rational> filled(const std::string& id) {
  const auto& one = gregory_reference::find_case(id);
  const CurveMesh mesh = gregory_reference::mesh_of(one.at("mesh"));
  const MeshTopology topology = analyse(mesh).value();
  FilledMesh<Rational> faces = fill_faces<Rational>(mesh, topology, gregory_reference::options_of(one)).value();
  Model<Rational> model;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    model.gregory_patches.push_back({mesh.faces[f].id, std::move(faces.patches[f])});
  return model;
}

// The vertices of each part of an OBJ file, in order of the parts.
std::vector<std::pair<std::string, std::vector<Point3>>> parts_of(const std::string& obj) {
  std::vector<std::pair<std::string, std::vector<Point3>>> out;
  std::istringstream in(obj);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("o ", 0) == 0) out.push_back({line.substr(2), {}});
    Point3 p;
    if (line.rfind("v ", 0) == 0 && std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3)
      out.back().second.push_back(p);
  }
  return out;
}
std::vector<Point3> part(const std::string& obj, const std::string& name) {
  for (const auto& [part, vertices] : parts_of(obj))
    if (part == name) return vertices;
  ADD_FAILURE() << "no part " << name;
  return {};
}

double angle(const Point3& a, const Point3& b) {
  const Point3 c = cross(a, b);
  return std::atan2(std::sqrt(dot(c, c)), dot(a, b)) * 180 / std::numbers::pi;
}

TEST(PlotGregory, Law5_PartsInOrderWithThePointsOfThePatch) {
  Model<Rational> model = filled("A");
  model.patches.push_back(
      {"plane",
       to_bspline(BezierPatch<Rational, 4>(1, 1, {{{0, 0, 0, 1}}, {{0, 1, 0, 1}}, {{1, 0, 0, 1}}, {{1, 1, 0, 1}}})),
       false});
  PlotOptions options;
  options.cells = 3;
  const auto parts = parts_of(plot(model, PlotFormat::obj, options).value());
  ASSERT_EQ(parts.size(), 1 + model.gregory_patches.size());
  EXPECT_EQ(parts[0].first, "plane");
  for (std::size_t f = 0; f < model.gregory_patches.size(); ++f) {
    const auto& [name, patch] = model.gregory_patches[f];
    EXPECT_EQ(parts[1 + f].first, name);
    const auto us = sample_spans(patch.v_surface().knots(Direction::u), 3)[0],
               vs = sample_spans(patch.u_surface().knots(Direction::v), 3)[0];
    ASSERT_EQ(parts[1 + f].second.size(), us.size() * vs.size());
    for (std::size_t j = 0; j < vs.size(); ++j)
      for (std::size_t i = 0; i < us.size(); ++i) {
        const Vec<Rational, 3> exact = evaluate(patch, us[i].t, vs[j].t);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(parts[1 + f].second[j * us.size() + i][c], nearest_double(exact[c]), 1e-11);
      }
  }
  options.patch = 1;  // the first Gregory patch
  EXPECT_EQ(parts_of(plot(model, PlotFormat::obj, options).value()).size(), 1U);
  options.patch = static_cast<int>(model.gregory_patches.size()) + 1;
  EXPECT_EQ(plot(model, PlotFormat::obj, options).error().code, ErrorCode::bad_reference);
}

TEST(PlotGregory, Law5_EveryFormat) {
  const Model<Rational> model = filled("A");
  for (const PlotFormat format :
       {PlotFormat::svg, PlotFormat::obj, PlotFormat::stl, PlotFormat::vtu, PlotFormat::glb}) {
    const auto bytes = plot(model, format);
    ASSERT_TRUE(bytes) << bytes.error().text();
    EXPECT_GT(bytes->size(), 1000U);
    EXPECT_EQ(bytes->find("nan"), std::string::npos);
  }
}

// Largest angle between the normals from both sides of one place, and how many places there are.
std::pair<double, int> crease(const Model<Rational>& model) {
  PlotOptions options;
  options.normals = true;
  const std::string obj = plot(model, PlotFormat::obj, options).value();
  const auto left = part(obj, "normals from the left"), right = part(obj, "normals from the right");
  std::map<std::array<double, 3>, std::vector<Point3>> from_right;
  for (std::size_t k = 0; k + 1 < right.size(); k += 2) from_right[right[k].c].push_back(right[k + 1] - right[k]);
  double largest = 0;
  int places = 0;
  for (std::size_t k = 0; k + 1 < left.size(); k += 2) {
    const auto found = from_right.find(left[k].c);
    if (found == from_right.end()) continue;
    double least = 180;
    for (const Point3& n : found->second) least = std::min(least, angle(left[k + 1] - left[k], n));
    largest = std::max(largest, least), ++places;
  }
  return {largest, places};
}

TEST(PlotGregory, Law8_OneNormalFromBothSidesWhereThePatchIsSmoothTwoWhereNot) {
  const auto [smooth, places] = crease(filled("A"));
  const auto [former, as_many] = crease(filled("A-former"));
  EXPECT_GT(places, 6);
  EXPECT_GE(as_many, 7);
  EXPECT_LT(smooth, 1e-5);
  EXPECT_GT(former, 3.6) << "the former method's crease across v = 1/3";
}

TEST(PlotGregory, Law9_SectionsLieInTheirPlanes) {
  PlotOptions options;
  options.sections = 5;
  const auto parts = parts_of(plot(filled("A"), PlotFormat::obj, options).value());
  int sections = 0;
  for (const auto& [name, vertices] : parts) {
    if (name.rfind("section z = ", 0) != 0) continue;
    ++sections;
    const double level = std::stod(name.substr(12));
    EXPECT_GE(vertices.size(), 2U);
    for (const Point3& p : vertices) EXPECT_NEAR(p[2], level, 1e-4 * (1 + std::fabs(level)));
  }
  EXPECT_EQ(sections, 5);
}

TEST(PlotGregory, Law2_ThePictureHasNetsNormalsAndSectionsWithinThePage) {
  PlotOptions options;
  options.control = true;
  options.normals = true;
  options.sections = 6;
  pugi::xml_document svg;
  const Model<Rational> model = filled("A-former");
  ASSERT_TRUE(svg.load_string(plot(model, PlotFormat::svg, options).value().c_str()));
  EXPECT_EQ(svg.select_nodes("//g[@class='net']").size(), 2 * model.gregory_patches.size());
  EXPECT_EQ(svg.select_nodes("//path[@class='normals']").size(), 2U);
  EXPECT_GT(svg.select_nodes("//path[@class='section']").size(), 10U);
  double left = 0, top = 0, width = 0, height = 0;
  ASSERT_EQ(
      std::sscanf(svg.first_child().attribute("viewBox").value(), "%lf %lf %lf %lf", &left, &top, &width, &height), 4);
  for (const auto& node : svg.select_nodes("//path[@class='normals' or @class='section']")) {
    std::string numbers = node.node().attribute("d").value();
    for (char& c : numbers)
      if (c == 'M' || c == 'L') c = ' ';
    std::istringstream in(numbers);
    for (double x = 0, y = 0; in >> x >> y;)
      ASSERT_TRUE(left <= x && x <= left + width && top <= y && y <= top + height) << x << " " << y;
  }
}

TEST(PlotGregory, Errors) {
  const Model<Rational> model = filled("A");
  PlotOptions options;
  options.normals = true;
  EXPECT_EQ(plot(model, PlotFormat::stl, options).error().code, ErrorCode::usage);
  options.basis = true;
  EXPECT_EQ(plot(model, PlotFormat::svg, options).error().code, ErrorCode::usage);
  options = {};
  options.sections = 0;
  EXPECT_EQ(plot(model, PlotFormat::svg, options).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace patchproof::test
