// SPDX-License-Identifier: Apache-2.0
#include "io/svg_facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/drawing_patches.h"

namespace patchproof {
namespace {

constexpr int kIsolines = 4;  // at most so many intervals between isoparametric lines in each span

struct Facet {
  double depth;
  std::string path, colour;
  std::string strong, faint, sections;  // its edges that are lines of the knots, and other isoparametric lines
};

// Facets are many: tenths of a page unit are enough for them, and their file is shorter.
PagePoint tenths(const PagePoint& p) { return {std::round(10 * p.x) / 10, std::round(10 * p.y) / 10}; }

std::string shade(double light) {
  const double s = 0.12 + 0.88 * light;
  const auto mix = [&](int dark, int bright) { return static_cast<int>(std::lround(dark + s * (bright - dark))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(58, 214), mix(84, 228), mix(114, 242));
}

int cells_along_u(const Tessellation<2>& piece) {
  const auto& x = piece.parameters;
  std::size_t vertices = 1;
  while (vertices < x.size() && x[vertices][1] == x[0][1] && x[vertices][0] != x[0][0]) ++vertices;
  return static_cast<int>(vertices) - 1;
}

void collect(std::vector<Facet>& facets, const PatchDrawing& patch, const Tessellation<2>& piece,
             const std::vector<double>& levels, const View& view) {
  const auto& mesh = piece.mesh;
  const int wide = cells_along_u(piece);
  const auto step = [](int cells) {
    int intervals = std::min(kIsolines, cells);
    while (cells % intervals != 0) --intervals;
    return cells / intervals;
  };
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto v = mesh.cell(c);
    const std::array<Point3, 4> p{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[3]], mesh.vertices[v[2]]};
    Facet f;
    f.depth = view.depth(0.25 * (p[0] + p[1] + p[2] + p[3]));
    const double light = view.brightness(cross(p[2] - p[0], p[3] - p[1]));
    std::array<PagePoint, 4> at{};
    for (std::size_t k = 0; k < 4; ++k) at[k] = tenths(view.place(p[k]));
    f.path = command('M', {at[0]}) + command('L', {at[1], at[2], at[3]}) + "Z";
    f.colour = shade(light);
    const int i = static_cast<int>(c) % wide, j = static_cast<int>(c) / wide;
    const std::array<std::array<int, 4>, 4> edges{{{0, 1, 1, j}, {3, 2, 1, j + 1}, {0, 3, 0, i}, {1, 2, 0, i + 1}}};
    for (const auto& [a, b, direction, line] : edges) {
      const std::string edge = command('M', {at[a]}) + command('L', {at[b]});
      if (line % patch.cells[direction] == 0)
        f.strong += edge;
      else if (line % step(patch.cells[direction]) == 0)
        f.faint += edge;
    }
    const auto [low, high] = std::minmax({p[0][2], p[1][2], p[2][2], p[3][2]});
    const auto [back, front] = std::minmax({view.depth(p[0]), view.depth(p[1]), view.depth(p[2]), view.depth(p[3])});
    // Sections come after the neighbours, whose strokes would cover their ends.
    Facet lines{f.depth + 2 * (front - back), "", "", "", "", ""};
    for (auto at_level = std::lower_bound(levels.begin(), levels.end(), low);
         at_level != levels.end() && *at_level <= high; ++at_level)
      for (const auto& [a, b] : section(p, *at_level))
        lines.sections += command('M', {view.place(a)}) + command('L', {view.place(b)});
    if (!lines.sections.empty()) facets.push_back(std::move(lines));
    facets.push_back(std::move(f));
  }
}

}  // namespace

bool has_inner_knots(const PatchDrawing& patch) {
  if (!patch.is_solid && patch.pieces.size() > 1) return true;
  return std::any_of(patch.pieces.begin(), patch.pieces.end(), [&](const Tessellation<2>& piece) {
    const int wide = cells_along_u(piece);
    return wide > patch.cells[0] || static_cast<int>(piece.mesh.cell_count()) > wide * patch.cells[1];
  });
}

void draw_facets(pugi::xml_node root, const std::vector<PatchDrawing>& patches, const std::vector<double>& levels,
                 const View& view) {
  std::vector<Facet> facets;
  for (const PatchDrawing& patch : patches)
    for (const auto& piece : patch.pieces) collect(facets, patch, piece, levels, view);
  std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.depth < b.depth; });
  if (facets.empty()) return;
  pugi::xml_node group = add(root, "g", {{"class", "patches"}, {"stroke-width", "0.6"}});
  for (const Facet& f : facets) {
    // The stroke of the fill's colour hides the seams between neighbours.
    if (!f.path.empty())
      add(group, "path", {{"class", "facet"}, {"d", f.path}, {"fill", f.colour}, {"stroke", f.colour}});
    if (!f.faint.empty()) add(group, "path", {{"d", f.faint}, {"stroke", "#33506e"}, {"opacity", "0.4"}});
    if (!f.strong.empty()) add(group, "path", {{"d", f.strong}, {"stroke", "#1f3247"}, {"stroke-width", "1.1"}});
    if (!f.sections.empty())
      add(group, "path",
          {{"class", "section"},
           {"d", f.sections},
           {"stroke", kSection},
           {"stroke-width", "1.3"},
           {"stroke-linecap", "round"}});
  }
}

void draw_normals(pugi::xml_node root, const std::vector<DrawnNormal>& normals, double length, const View& view) {
  if (normals.empty()) return;
  for (const bool left : {false, true}) {
    std::string lines;
    for (const DrawnNormal& n : normals)
      if (n.from_left == left)
        lines += command('M', {view.place(n.at)}) + command('L', {view.place(n.at + length * n.direction)});
    if (lines.empty()) continue;
    // The one below is wider, so that both are seen where they are the same.
    add(root, "path",
        {{"class", "normals"},
         {"d", lines},
         {"stroke", left ? kFromLeft : kFromRight},
         {"stroke-width", left ? "0.9" : "1.8"}});
  }
}

void draw_net(pugi::xml_node root, const PatchDrawing& patch, const View& view) {
  for (const DrawnNet& net : patch.nets) {
    pugi::xml_node group = add(root, "g", {{"class", "net"}, {"stroke", kAccent}, {"stroke-width", "0.9"}});
    const auto at = [&](int i, int j) -> const DrawnControl& { return net.controls[i * net.count[1] + j]; };
    std::string lines;
    for (int i = 0; i < net.count[0]; ++i)
      for (int j = 0; j < net.count[1]; ++j) {
        if (at(i, j).is_vector) continue;
        const PagePoint p = view.place(at(i, j).at);
        for (const auto& [k, l] : {std::array{i + 1, j}, std::array{i, j + 1}})
          if (k < net.count[0] && l < net.count[1] && !at(k, l).is_vector)
            lines += command('M', {p}) + command('L', {view.place(at(k, l).at)});
        add(group, "circle", {{"cx", page_number(p.x)}, {"cy", page_number(p.y)}, {"r", "2.2"}, {"fill", kAccent}});
      }
    if (!lines.empty()) add(group, "path", {{"d", lines}, {"opacity", "0.8"}});
  }
}

}  // namespace patchproof
