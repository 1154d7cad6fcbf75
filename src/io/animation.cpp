// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include "io/drawing_gerbs.h"

namespace patchproof {
namespace {

constexpr int kMostCells = 8;  // along a span: there are many frames

std::string text_of(const pugi::xml_node& node) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  node.print(out, " ", pugi::format_raw);
  return out.str();
}

using Parts = std::vector<std::string>;

Parts parts_of(const pugi::xml_document& page) {
  Parts out;
  for (const pugi::xml_node& child : page.document_element().children()) out.push_back(text_of(child));
  return out;
}

// "0%{visibility:hidden}8.3333%{visibility:visible}…": one change at the beginning of each run of frames.
std::string key_frames(const std::vector<bool>& seen) {
  std::string out;
  const std::size_t n = seen.size();
  for (std::size_t k = 0; k < n; ++k)
    if (k == 0 || seen[k] != seen[k - 1])
      out += fmt::format("{:.6g}%{{visibility:{}}}", 100.0 * static_cast<double>(k) / static_cast<double>(n),
                         seen[k] ? "visible" : "hidden");
  return out + fmt::format("100%{{visibility:{}}}", seen.back() ? "visible" : "hidden");
}

std::string moving_picture(const std::vector<std::string>& frames, double seconds) {
  std::vector<Parts> parts;
  std::string root;  // its start tag
  for (const std::string& frame : frames) {
    pugi::xml_document page;
    page.load_buffer(frame.data(), frame.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
    parts.push_back(parts_of(page));
    if (!root.empty()) continue;
    pugi::xml_node first = page.document_element();
    while (first.first_child()) first.remove_child(first.first_child());
    root = text_of(first);
    root.erase(root.rfind("/>"));
    while (root.back() == ' ') root.pop_back();
  }
  // What stands first and last in all frames alike does not move.
  const auto common = [&](auto at) {
    std::size_t count = 0;
    const std::size_t most =
        std::min_element(parts.begin(), parts.end(), [](auto& a, auto& b) { return a.size() < b.size(); })->size();
    while (count < most && std::all_of(parts.begin(), parts.end(), [&](const Parts& p) {
             return p[at(p, count)] == parts[0][at(parts[0], count)];
           }))
      ++count;
    return count;
  };
  const std::size_t before = common([](const Parts&, std::size_t k) { return k; });
  const std::size_t after =
      before == parts[0].size() ? 0 : common([](const Parts& p, std::size_t k) { return p.size() - 1 - k; });
  std::map<std::string, std::size_t> numbers;
  std::vector<std::string> states;
  std::vector<std::vector<bool>> seen;  // of each state, in each frame
  for (std::size_t f = 0; f < parts.size(); ++f) {
    std::string state;
    for (std::size_t k = before; k + after < parts[f].size(); ++k) state += parts[f][k] + "\n";
    const auto [at, is_new] = numbers.emplace(state, states.size());
    if (is_new) {
      states.push_back(state);
      seen.emplace_back(parts.size(), false);
    }
    seen[at->second][f] = true;
  }
  std::string out = root + ">\n<style>\n.frame{visibility:hidden}.s0{visibility:visible}\n";
  if (states.size() > 1) {
    for (std::size_t s = 0; s < states.size(); ++s)
      out += fmt::format("@keyframes k{}{{{}}}\n", s, key_frames(seen[s]));
    out += "@media (prefers-reduced-motion: no-preference){\n";
    for (std::size_t s = 0; s < states.size(); ++s)
      out += fmt::format(".s{}{{animation:k{} {:.6g}s step-end infinite}}\n", s, s, seconds);
    out += "}\n";
  }
  out += "</style>\n";
  for (std::size_t k = 0; k < before; ++k) out += parts[0][k] + "\n";
  for (std::size_t s = 0; s < states.size(); ++s)
    if (!states[s].empty()) out += fmt::format("<g class=\"frame s{}\">\n{}</g>\n", s, states[s]);
  for (std::size_t k = parts[0].size() - after; k < parts[0].size(); ++k) out += parts[0][k] + "\n";
  return out + "</svg>\n";
}

}  // namespace

template <ExactField T>
Result<Animation> plot_frames(const std::vector<Model<T>>& frames, const PlotOptions& options, double seconds) {
  PATCHPROOF_REQUIRES(!frames.empty() && seconds > 0 && !options.basis, "plot_frames: nothing to be drawn, or no time");
  std::vector<Drawing> drawings;
  for (const Model<T>& model : frames) {
    Result<Drawing> drawing = draw_with_gerbs(model, options, kMostCells);
    if (!drawing) return drawing.error();
    drawings.push_back(std::move(*drawing));
  }
  Animation out{svg_scenes(drawings, options), ""};
  out.moving = moving_picture(out.frames, seconds);
  return out;
}

template Result<Animation> plot_frames(const std::vector<Model<Rational>>&, const PlotOptions&, double);
template Result<Animation> plot_frames(const std::vector<Model<Quadratic>>&, const PlotOptions&, double);

}  // namespace patchproof
