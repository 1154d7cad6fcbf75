// SPDX-License-Identifier: Apache-2.0
// What plot makes of solids: their controls left out, their boundaries closed and turned outwards.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <sstream>

#include "patchproof/io/plot.h"
#include "patchproof/io/read.h"

namespace patchproof {
namespace {

int count(const std::string& text, const std::string& what) {
  int out = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
  return out;
}

struct Enclosed {
  double volume = 0;
  bool is_closed = true;  // each edge is run through once from one end and once from the other
};

Enclosed enclosed(const std::string& stl) {
  using Place = std::array<float, 3>;
  Enclosed out;
  std::map<std::array<Place, 2>, int> uses;
  for (std::size_t at = 84 + 12; at + 38 <= stl.size(); at += 50) {
    std::array<Place, 3> t;
    std::memcpy(&t, stl.data() + at, sizeof t);
    const auto point = [&](int k) { return Vec<double, 3>{{t[k][0], t[k][1], t[k][2]}}; };
    out.volume += dot(cross(point(0), point(1)), point(2)) / 6;
    for (int k : {0, 1, 2}) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, times] : uses)
    out.is_closed = out.is_closed && times == 1 && uses.contains({edge[1], edge[0]});
  return out;
}

// The patches of a solid's controls are not the solid: by default they are left out, and the boundary is closed.
TEST(Plot, Law5_SolidsStandForTheirControls) {
  const auto model = read_model(PATCHPROOF_SOURCE_DIR "/examples/toolbox/solid.json", Decimals::exact);
  ASSERT_TRUE(model.has_value()) << model.error().text();
  auto solid = std::get<Model<Rational>>(model->model);
  const auto names = [&](const PlotOptions& options) {
    std::vector<std::string> out;
    std::istringstream obj(plot(solid, PlotFormat::obj, options).value());
    for (std::string line; std::getline(obj, line);)
      if (line.starts_with("o ")) out.push_back(line.substr(2));
    return out;
  };
  EXPECT_EQ(names({}), (std::vector<std::string>{"transfinite_solid"}));
  EXPECT_EQ(names({"", false, {}, {}, {}, 1, {}}), (std::vector<std::string>{"lifted by 5 + u²"}));
  EXPECT_EQ(count(plot(solid, PlotFormat::svg, {"", false, {}, 4, {}, {}, {}}).value(), "class=\"facet\""), 6 * 16);
  EXPECT_EQ(count(plot(solid, PlotFormat::svg, {"", true, {}, {}, {}, {}, {}}).value(), "class=\"basis\""),
            2);  // degrees 1 and 2

  // The determinant of the map integrates to −3149/90, and the mesh's error falls with the square of the cells.
  const Enclosed coarse = enclosed(plot(solid, PlotFormat::stl, {"", false, {}, 8, {}, {}, {}}).value()),
                 fine = enclosed(plot(solid, PlotFormat::stl, {"", false, {}, 16, {}, {}, {}}).value());
  EXPECT_TRUE(coarse.is_closed);
  EXPECT_TRUE(fine.is_closed);
  EXPECT_NEAR((4 * fine.volume - coarse.volume) / 3, 3149.0 / 90, 0.01);
  // A patch alone has edges of its own.
  EXPECT_FALSE(enclosed(plot(solid, PlotFormat::stl, {"", false, {}, {}, {}, 0, {}}).value()).is_closed);
  // A patch that is no control stays.
  solid.patches.push_back(solid.patches[0]);
  EXPECT_EQ(names({}), (std::vector<std::string>{"test05_bilinear", "transfinite_solid"}));
}

}  // namespace
}  // namespace patchproof
