// SPDX-License-Identifier: Apache-2.0
// Graphs of basis functions, one panel below the other. Below each axis stand the knots, a dot for each time one occurs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/drawing.h"
#include "io/svg_page.h"

namespace patchproof {
namespace {

constexpr double kLeft = 48, kRight = kPageWidth - 24, kGraph = 170;  // the graph's height
constexpr int kMostDots = 6;
constexpr std::size_t kMostReserved = 100;  // functions; among more, names may cross lines

class Panel {
 public:
  Panel(pugi::xml_node page, const BasisDrawing& basis, double top) : basis_(basis), top_(top + 42) {
    for (const auto& f : basis.functions)
      for (const auto& line : f.components)
        for (const auto& [t, value] : line) {
          low_ = std::min(low_, value);
          high_ = std::max(high_, value);
        }
    group_ = add(page, "g", {{"class", "basis"}});
  }

  void draw() {
    const std::string functions = basis_.is_rational ? "rational basis R" : "B-spline basis N";
    add_text(group_, {24, top_ - 26},
             shortened(fmt::format("{} of degree {}: {}", functions, basis_.degree, basis_.title), 13, kPageWidth - 48),
             13, kInk);
    axes();
    Labels labels(group_, 4, top_ - 16, kPageWidth - 4, top_ + kGraph);
    labels.reserve({kLeft - 10, place(0, 1).y}, 8);  // the axis' own labels
    if (basis_.functions.size() <= kMostReserved)
      for (const auto& f : basis_.functions)
        for (const auto& line : f.components)
          for (std::size_t k = 1; k < line.size(); ++k)
            labels.reserve(place(line[k - 1][0], line[k - 1][1]), place(line[k][0], line[k][1]), 1.5);
    for (std::size_t i = 0; i < basis_.functions.size(); ++i) lines(i);
    for (std::size_t i = 0; i < basis_.functions.size(); ++i) name(labels, i);
    knots();
  }

  static double height(const BasisDrawing& basis) {
    int dots = 1;
    for (const auto& knot : basis.knots) dots = std::max(dots, std::min(knot.multiplicity, kMostDots));
    return 42 + kGraph + 12 + 6 * dots + 34;
  }

 private:
  PagePoint place(double t, double value) const {
    return {kLeft + t * (kRight - kLeft), top_ + (high_ - value) / (high_ - low_) * kGraph};
  }

  void axes() {
    pugi::xml_node frame = add(group_, "g", {{"stroke", kFaint}, {"stroke-width", "1"}});
    for (const double value : {0.0, 1.0}) {
      add(frame, "path",
          {{"d", command('M', {place(0, value)}) + command('L', {place(1, value)})},
           {"opacity", value == 0 ? "1" : "0.35"}});
      add_text(group_, {kLeft - 8, place(0, value).y + 4}, page_number(value), 11.5, kInk, Anchor::end);
    }
    // The knots' range may be larger than the domain.
    for (const auto& [a, b] : {std::array{0.0, basis_.domain[0]}, std::array{basis_.domain[1], 1.0}}) {
      if (!(a < b)) continue;
      const PagePoint p = place(a, high_), q = place(b, low_);
      add(group_, "rect",
          {{"x", page_number(p.x)},
           {"y", page_number(p.y)},
           {"width", page_number(q.x - p.x)},
           {"height", page_number(q.y - p.y)},
           {"fill", kFaint},
           {"opacity", "0.18"}});
      if (q.x - p.x > 90)
        add_text(group_, {(p.x + q.x) / 2, (p.y + q.y) / 2}, "outside the domain", 11, kInk, Anchor::middle);
    }
  }

  void lines(std::size_t i) {
    for (const auto& line : basis_.functions[i].components) {
      std::vector<PagePoint> points;
      for (const auto& [t, value] : line) points.push_back(place(t, value));
      add(group_, "path",
          {{"class", "function"},
           {"d", command('M', {points[0]}) + command('L', {points.begin() + 1, points.end()})},
           {"stroke", line_colour(i)},
           {"stroke-width", "1.8"}});
    }
  }

  // Above the largest value.
  void name(Labels& labels, std::size_t i) {
    std::array<double, 2> best{};
    bool any = false;
    for (const auto& line : basis_.functions[i].components)
      for (const auto& point : line)
        if (!any || point[1] > best[1]) {
          best = point;
          any = true;
        }
    if (!any) return;
    labels.put_near(place(best[0], best[1]), 6, fmt::format("{}{}", basis_.is_rational ? "R" : "N", subscript(i)), 12,
                    line_colour(i));
  }

  static std::string subscript(std::size_t i) {
    std::string out;
    for (const char digit : std::to_string(i)) out += std::string("\xe2\x82") + static_cast<char>(0x80 + digit - '0');
    return out;
  }

  void knots() {
    const double axis = place(0, low_).y;
    pugi::xml_node ticks = add(group_, "g", {{"stroke", kInk}, {"stroke-width", "1.2"}}),
                   dots = add(group_, "g", {{"fill", kAccent}, {"class", "multiplicities"}});
    Labels labels(group_, 4, axis, kPageWidth - 4, axis + 100);
    int most = 1;
    for (const auto& knot : basis_.knots) most = std::max(most, std::min(knot.multiplicity, kMostDots));
    const double baseline = axis + 12 + 6 * most + 14;
    const auto label = [&](const BasisDrawing::Knot& knot) {
      std::string text = knot.label;
      if (knot.multiplicity > kMostDots) text += fmt::format(" ×{}", knot.multiplicity);
      labels.put_at({place(knot.at, 0).x, baseline}, text, 11.5, kInk, Anchor::middle);
    };
    label(basis_.knots.front());  // the ends first: they are never left out
    label(basis_.knots.back());
    for (const auto& knot : basis_.knots) {
      const double x = place(knot.at, 0).x;
      add(ticks, "path", {{"d", command('M', {{x, axis - 3}}) + command('L', {{x, axis + 4}})}});
      for (int k = 0; k < std::min(knot.multiplicity, kMostDots); ++k)
        add(dots, "circle", {{"cx", page_number(x)}, {"cy", page_number(axis + 10 + 6 * k)}, {"r", "2.2"}});
      if (&knot != &basis_.knots.front() && &knot != &basis_.knots.back()) label(knot);
    }
  }

  const BasisDrawing& basis_;
  double top_, low_ = 0, high_ = 1;
  pugi::xml_node group_;
};

}  // namespace

std::string svg_basis(const std::vector<BasisDrawing>& panels, const PlotOptions& options) {
  double height = Page::top(options.title, "");
  for (const BasisDrawing& basis : panels) height += Panel::height(basis);
  Page page(height, options.title, "");
  double top = Page::top(options.title, "");
  for (const BasisDrawing& basis : panels) {
    Panel(page.root(), basis, top).draw();
    top += Panel::height(basis);
  }
  return page.text();
}

}  // namespace patchproof
