// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/animation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "patchproof/io/motion.h"
#include "patchproof/io/read.h"

namespace patchproof {
namespace {

// Curve 0 rests, curve 1 moves upwards.
std::vector<Model<Rational>> frames(int count) {
  const auto file = read_model_text(R"~({"format": "patchproof-model", "version": 1,
    "curves": [{"name": "rests", "degree": 1, "control_points": [[0, 0], [3, 1]]}],
    "gerbs_curves": [{"name": "moves", "b_function": "polynomial(1)", "knots": [0, 1, 2], "locals": [
      {"degree": 1, "knots": [0, 0, 2, 2], "control_points": [[0, 0], [2, 1]]}, {"same_as": 0}, {"same_as": 0}]}]
})~",
                                    "model.json");
  const auto& model = std::get<Model<Rational>>(file.value().model);
  const auto motion = read_motion_text(R"~({"format": "patchproof-motion", "version": 1,
    "motions": [{"curve": 1, "locals": [1, 2], "translate": [0, 9, 0]}]})~",
                                       "motion.json", model);
  std::vector<Model<Rational>> out;
  for (int k = 0; k < count; ++k) out.push_back(frame(model, motion.value(), k, count));
  return out;
}

pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document out;
  EXPECT_TRUE(out.load_string(text.c_str()));
  return out;
}
std::vector<std::string> paths(const pugi::xml_node& root) {
  std::vector<std::string> out;
  for (const auto& path : root.select_nodes(".//path[@class='curve']"))
    out.push_back(path.node().attribute("d").value());
  return out;
}

TEST(Animation, Law1_OneViewForAllFrames) {
  const auto made = plot_frames(frames(6), {}, 2);
  ASSERT_TRUE(made) << made.error().text();
  ASSERT_EQ(made->frames.size(), 6u);
  std::set<std::string> boxes, at_rest, moving;
  for (const std::string& frame : made->frames) {
    const auto page = parsed(frame);
    boxes.insert(page.document_element().attribute("viewBox").value());
    at_rest.insert(paths(page)[0]);
    moving.insert(paths(page)[1]);
  }
  boxes.insert(parsed(made->moving).document_element().attribute("viewBox").value());
  EXPECT_EQ(boxes.size(), 1u);
  EXPECT_EQ(at_rest.size(), 1u);
  EXPECT_EQ(moving.size(), 4u);  // 0, 1/3, 2/3, 1
}

// The states' visibility over the period, read from the style rules.
std::vector<bool> seen(const std::string& style, std::size_t state, std::size_t frames) {
  const std::string head = "@keyframes k" + std::to_string(state) + "{";
  const std::size_t begin = style.find(head);
  EXPECT_NE(begin, std::string::npos);
  std::istringstream rules(style.substr(begin + head.size(), style.find('\n', begin) - begin - head.size()));
  std::vector<bool> out(frames, false);
  double percent = 0;
  char sign = 0;
  std::string rule;
  while (rules >> percent >> sign && std::getline(rules, rule, '}')) {
    const auto from = static_cast<std::size_t>(percent * static_cast<double>(frames) / 100 + 0.5);
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(std::min(from, frames)), out.end(),
              rule == "{visibility:visible");
  }
  return out;
}

TEST(Animation, Law2_EveryFrameInItsTurn) {
  for (const int count : {2, 5, 6}) {
    const auto made = plot_frames(frames(count), {}, 2);
    ASSERT_TRUE(made) << made.error().text();
    const auto page = parsed(made->moving);
    const std::string style = page.document_element().child("style").text().get();
    const auto states = page.select_nodes("/svg/g[starts-with(@class, 'frame s')]");
    ASSERT_EQ(states.size(), static_cast<std::size_t>(count / 2 + 1));
    for (std::size_t f = 0; f < made->frames.size(); ++f) {
      std::vector<std::size_t> shown;
      for (std::size_t s = 0; s < states.size(); ++s)
        if (seen(style, s, made->frames.size())[f]) shown.push_back(s);
      ASSERT_EQ(shown.size(), 1u) << f;
      const auto frame = parsed(made->frames[f]);
      std::vector<std::string> expected = paths(frame), got = paths(states[static_cast<int>(shown[0])].node());
      EXPECT_EQ(got, expected) << f;
    }
    EXPECT_NE(style.find("animation:k0 2s step-end infinite"), std::string::npos);
    EXPECT_NE(style.find(".frame{visibility:hidden}.s0{visibility:visible}"), std::string::npos);
  }
}

TEST(Animation, Law2_NothingMovesWhereNothingMoves) {
  const auto one = frames(2)[0];
  const auto made = plot_frames(std::vector{one, one, one}, {}, 2);
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(made->moving.find("keyframes"), std::string::npos);
  EXPECT_EQ(paths(parsed(made->moving)), paths(parsed(made->frames[0])));
}

TEST(Animation, Law3_TheSameBytes) {
  const auto first = plot_frames(frames(4), {}, 2), second = plot_frames(frames(4), {}, 2);
  EXPECT_EQ(first.value().moving, second.value().moving);
  EXPECT_EQ(first.value().frames, second.value().frames);
}

}  // namespace
}  // namespace patchproof
