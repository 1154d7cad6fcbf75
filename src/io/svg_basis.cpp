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
constexpr std::size_t kMostListed = 40;     // functions in the legend

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

  // Returns where the next panel may begin.
  double draw() {
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
    knots();
    double bottom = top_ + kGraph + 12 + 6 * most_dots() + 34;
    const Legend nameless = legend(names(labels));
    if (!nameless.empty()) {
      nameless.draw(group_, bottom - 8);
      bottom += nameless.height() + 4;
    }
    return bottom;
  }

 private:
  int most_dots() const {
    int dots = 1;
    for (const auto& knot : basis_.knots) dots = std::max(dots, std::min(knot.multiplicity, kMostDots));
    return dots;
  }

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

  std::string name(std::size_t i) const { return (basis_.is_rational ? "R" : "N") + subscript(i); }

  // Names beside the lines: all at their largest values first, then the others along their lines, the higher the better.
  // Returns those for which there was no room.
  std::vector<std::size_t> names(Labels& labels) const {
    std::vector<std::size_t> left, nameless;
    const auto points_of = [&](std::size_t i) {
      std::vector<std::array<double, 2>> points;
      for (const auto& line : basis_.functions[i].components) points.insert(points.end(), line.begin(), line.end());
      std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a[1] > b[1]; });
      return points;
    };
    const auto put = [&](std::size_t i, const std::array<double, 2>& at) {
      return labels.put_near(place(at[0], at[1]), 6, name(i), 12, line_colour(i));
    };
    for (std::size_t i = 0; i < basis_.functions.size(); ++i) {
      const auto points = points_of(i);
      if (points.empty() || !put(i, points[0])) left.push_back(i);
    }
    for (const std::size_t i : left) {
      const auto points = points_of(i);
      const std::size_t step = 1 + points.size() / 48;
      bool is_named = false;
      for (std::size_t k = step; k < points.size() && !is_named && points[k][1] > 0.15 * points[0][1]; k += step)
        is_named = put(i, points[k]);
      if (!is_named) nameless.push_back(i);
    }
    return nameless;
  }

  Legend legend(const std::vector<std::size_t>& nameless) const {
    Legend out;
    for (std::size_t k = 0; k < nameless.size() && k < kMostListed; ++k) {
      const std::size_t i = nameless[k];
      const auto& f = basis_.functions[i];
      out.add_line(f.components.empty() ? name(i) + " = 0" : fmt::format("{} on {}", name(i), f.support),
                   line_colour(i), "1.8");
    }
    if (nameless.size() > kMostListed)
      out.add(fmt::format("and {} more; they are numbered in the order of their knots", nameless.size() - kMostListed),
              [](auto...) {});
    return out;
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
    const double baseline = axis + 12 + 6 * most_dots() + 14;
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
  double top = Page::top(options.title, "");
  Page page(top, options.title, "");
  for (const BasisDrawing& basis : panels) top = Panel(page.root(), basis, top).draw();
  page.set_height(top);  // known only now: a legend may be needed
  return page.text();
}

}  // namespace patchproof
