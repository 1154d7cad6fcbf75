// SPDX-License-Identifier: Apache-2.0
// Curves and patches in one view: the plane z = 0 from above, or space from the front, right and above.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "io/drawing_patches.h"
#include "io/svg_facets.h"
#include "io/svg_layers.h"
#include "io/svg_page.h"
#include "io/svg_view.h"
#include "patchproof/spline/bernstein.h"

namespace patchproof {
namespace {

constexpr double kMargin = 44;
constexpr std::size_t kMostNamed = 10;    // curves in the legend
constexpr std::size_t kMostLabels = 300;  // knots: none is labelled when there are more

class Scene {
 public:
  // Everything of `all` has its place in the view; `drawing` is one of them.
  Scene(const Drawing& drawing, std::span<const Drawing> all, const PlotOptions& options)
      : drawing_(drawing),
        show_polygons_(options.control.value_or(true)),
        plane_(std::all_of(all.begin(), all.end(), is_plane)),
        view_(plane_) {
    title_ = options.title;
    describe();
    for (const Drawing& d : all) include_everything(d);
    normal_length_ = normal_length(drawing.normals);
    for (const DrawnNormal& n : drawing.normals) view_.include(n.at + normal_length_ * n.direction);
  }

  std::string draw() {
    const double left = plane_ ? kMargin + 12 : kMargin, top = Page::top(title_, subtitle_) + 18;
    const double used = view_.fit(left, kPageWidth - left - kMargin, top);
    const double bottom = top + used + 14;
    const double legend_top = bottom + (plane_ ? 30 : 6);
    std::vector<std::vector<Polyline>> on_page;
    for (const CurveDrawing& curve : drawing_.curves) on_page.push_back(polylines(curve));
    dashes_ = dashes_of(on_page);
    const Legend legend = this->legend();
    Page page(legend_top + legend.height() + 12, title_, subtitle_);
    pugi::xml_node root = page.root();
    if (plane_) axes(root, left - 14, kPageWidth - kMargin + 14, top - 14, bottom);
    draw_facets(root, drawing_.patches, drawing_.levels, view_);
    for (const PatchDrawing& patch : drawing_.patches) draw_net(root, patch, view_);
    draw_normals(root, drawing_.normals, normal_length_, view_);
    pugi::xml_node under = add(root, "g", {{"class", "control"}}), over = add(root, "g", {{"class", "curves"}});
    Labels labels(add(root, "g", {{"class", "labels"}}), 4, top - 16, kPageWidth - 4, bottom + 2);
    for (std::size_t i = 0; i < drawing_.curves.size() && has_labels(); ++i)
      reserve(labels, drawing_.curves[i], on_page[i]);
    for (std::size_t i = 0; i < drawing_.curves.size(); ++i) {
      if (show_polygons_ && !drawing_.curves[i].controls.empty()) polygon(under, drawing_.curves[i].controls);
      paths(over, drawing_.curves[i], i);
    }
    for (std::size_t i = 0; i < drawing_.curves.size(); ++i) marks(over, labels, drawing_.curves[i], i);
    legend.draw(root, legend_top);
    if (!plane_) triad(root, bottom + 4);
    return page.text();
  }

 private:
  static bool is_plane(const Drawing& drawing) {
    const auto flat = [](const Point3& p) { return p[2] == 0; };
    for (const CurveDrawing& c : drawing.curves)
      if (!c.is_plane && !std::all_of(c.controls.begin(), c.controls.end(), [&](const auto& p) { return flat(p.at); }))
        return false;
    for (const PatchDrawing& p : drawing.patches)
      for (const auto& piece : p.pieces)
        if (!std::all_of(piece.mesh.vertices.begin(), piece.mesh.vertices.end(), flat)) return false;
    return true;
  }

  // A long name leaves room for what is said of it.
  static std::string titled(const std::string& name, const std::string& what) {
    return shortened(name, 13, kPageWidth - 48 - text_width(": " + what, 13)) + ": " + what;
  }

  void describe() {
    const std::size_t curves = drawing_.curves.size(), patches = drawing_.patches.size();
    if (curves == 1 && patches == 0) {
      const CurveDrawing& c = drawing_.curves[0];
      std::size_t spans = 0;
      for (const auto& component : c.components) spans += component.segments.size();
      subtitle_ = titled(c.name, !c.kind.empty() ? c.kind
                                                 : fmt::format("{}degree {}, {} control points, {} span{}",
                                                               c.is_rational ? "rational, " : "", c.degree,
                                                               c.controls.size(), spans, spans == 1 ? "" : "s"));
      return;
    }
    if (patches == 1 && curves == 0) {
      const PatchDrawing& p = drawing_.patches[0];
      if (!p.kind.empty())
        subtitle_ = titled(p.name, p.kind);
      else if (p.count[0] == 0 && !p.is_solid)
        subtitle_ = titled(p.name, fmt::format("{}Gregory patch, degree {} × {}", p.is_rational ? "rational " : "",
                                               p.degree[0], p.degree[1]));
      else
        subtitle_ = p.is_solid ? p.name
                               : titled(p.name, fmt::format("{}degree {} × {}, {} × {} control points",
                                                            p.is_rational ? "rational, " : "", p.degree[0], p.degree[1],
                                                            p.count[0], p.count[1]));
      return;
    }
    const std::size_t solids = std::count_if(drawing_.patches.begin(), drawing_.patches.end(),
                                             [](const PatchDrawing& p) { return p.is_solid; });
    const auto count = [&](std::size_t n, const char* what, const char* plural) {
      if (n > 0) subtitle_ += fmt::format("{}{} {}", subtitle_.empty() ? "" : ", ", n, n == 1 ? what : plural);
    };
    count(curves, "curve", "curves");
    count(patches - solids, "patch", "patches");
    count(solids, "solid", "solids");
  }

  void include_everything(const Drawing& drawing) {
    for (const CurveDrawing& c : drawing.curves) {
      for (const auto& component : c.components)
        for (const auto& segment : component.segments)
          for (const Point3& p : segment) view_.include(p);
      for (const auto& component : c.components)
        for (const auto& mark : component.marks) view_.include(mark.at);
      if (show_polygons_) include(c.controls);
    }
    for (const PatchDrawing& p : drawing.patches) {
      for (const auto& piece : p.pieces)
        for (const Point3& v : piece.mesh.vertices) view_.include(v);
      for (const DrawnNet& net : p.nets) include(net.controls);
    }
  }
  void include(const std::vector<DrawnControl>& controls) {
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (!controls[i].is_vector) view_.include(controls[i].at);
      if (controls[i].is_vector) view_.include(foot(controls, i) + controls[i].at);
    }
  }
  // Where a control vector is drawn: at the point before it, else at the one behind it, else at the origin.
  static Point3 foot(const std::vector<DrawnControl>& controls, std::size_t i) {
    for (std::size_t k = i; k-- > 0;)
      if (!controls[k].is_vector) return controls[k].at;
    for (std::size_t k = i + 1; k < controls.size(); ++k)
      if (!controls[k].is_vector) return controls[k].at;
    return {};
  }

  std::vector<PagePoint> places(const std::vector<Point3>& points, std::size_t from = 0) const {
    std::vector<PagePoint> out;
    for (std::size_t i = from; i < points.size(); ++i) out.push_back(view_.place(points[i]));
    return out;
  }

  void axes(pugi::xml_node root, double left, double right, double top, double bottom) {
    pugi::xml_node group = add(root, "g", {{"class", "axes"}, {"stroke", kFaint}, {"stroke-width", "0.8"}});
    add(group, "path", {{"d", command('M', {{left, top}}) + command('L', {{left, bottom}, {right, bottom}})}});
    const double scale = view_.page_units_per_unit();
    if (!(scale > 0)) return;
    const double step = round_step((right - left) / scale, 9);
    const PagePoint corner = view_.place({{view_.low()[0], view_.low()[1], 0}});
    for (const int axis : {0, 1}) {
      const double from =
          axis == 0 ? view_.low()[0] + (left - corner.x) / scale : view_.low()[1] + (corner.y - bottom) / scale;
      const double to =
          axis == 0 ? view_.low()[0] + (right - corner.x) / scale : view_.low()[1] + (corner.y - top) / scale;
      for (double k = std::ceil(from / step); k <= std::floor(to / step) && std::abs(k) < 1e15; ++k) {
        Point3 at{{view_.low()[0], view_.low()[1], 0}};
        at[axis] = k * step;
        const PagePoint p = view_.place(at);
        const std::string text = fmt::format("{:.6g}", k * step == 0 ? 0 : k * step);
        const bool along_x = axis == 0;
        add(group, "path",
            {{"d", along_x ? command('M', {{p.x, top}}) + command('L', {{p.x, bottom}})
                           : command('M', {{left, p.y}}) + command('L', {{right, p.y}})},
             {"opacity", "0.22"}});
        pugi::xml_node label = along_x ? add_text(group, {p.x, bottom + 15}, text, 11.5, kInk, Anchor::middle)
                                       : add_text(group, {left - 6, p.y + 4}, text, 11.5, kInk, Anchor::end);
        label.append_attribute("stroke") = "none";
      }
    }
  }

  // ---- curves ---------------------------------------------------------------------------------------------------------

  bool has_labels() const {
    std::size_t marks = 0;
    for (const CurveDrawing& curve : drawing_.curves)
      for (const auto& component : curve.components) marks += component.marks.size();
    return marks <= kMostLabels;
  }

  // One for each component.
  std::vector<Polyline> polylines(const CurveDrawing& curve) const {
    std::vector<Polyline> out;
    for (const auto& component : curve.components) {
      out.emplace_back();
      for (std::size_t s = 0; s < component.segments.size(); ++s) {
        std::vector<Point3> line = component.segments[s];
        if (component.exact[s]) {
          line.clear();
          for (int k = 0; k <= 16; ++k) line.push_back(de_casteljau(component.segments[s], k / 16.0));
        }
        for (const Point3& p : line) out.back().push_back(view_.place(p));
      }
    }
    return out;
  }

  // No label on a curve or on a control point.
  void reserve(Labels& labels, const CurveDrawing& curve, const std::vector<Polyline>& lines) const {
    for (const auto& line : lines)
      for (std::size_t k = 1; k < line.size(); ++k) labels.reserve(line[k - 1], line[k], 2.5);
    if (!show_polygons_) return;
    for (const DrawnControl& c : curve.controls)
      if (!c.is_vector) labels.reserve(view_.place(c.at), 5);
  }

  void polygon(pugi::xml_node parent, const std::vector<DrawnControl>& controls) const {
    pugi::xml_node group = add(parent, "g", {{"stroke", kFaint}, {"stroke-width", "1.1"}});
    std::string lines;
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (controls[i].is_vector) continue;
      const bool continues = i > 0 && !controls[i - 1].is_vector;
      lines += command(continues ? 'L' : 'M', {view_.place(controls[i].at)});
    }
    add(group, "path", {{"d", lines}, {"class", "polygon"}, {"stroke-dasharray", "5 3"}});
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (controls[i].is_vector) {
        arrow(group, view_.place(foot(controls, i)), view_.place(foot(controls, i) + controls[i].at));
        continue;
      }
      const PagePoint p = view_.place(controls[i].at);
      add(group, "circle", {{"cx", page_number(p.x)}, {"cy", page_number(p.y)}, {"r", "3.2"}, {"stroke-width", "1.3"}});
    }
  }

  static void arrow(pugi::xml_node parent, const PagePoint& from, const PagePoint& to) {
    const double x = to.x - from.x, y = to.y - from.y, length = std::hypot(x, y);
    if (!(length > 0)) return;
    const double c = x / length, s = y / length, head = std::min(9.0, length);
    add(parent, "path",
        {{"class", "vector"},
         {"stroke", kAccent},
         {"stroke-width", "1.5"},
         {"d", command('M', {from}) + command('L', {to}) +
                   command('M', {{to.x - head * (c - 0.45 * s), to.y - head * (s + 0.45 * c)}}) +
                   command('L', {to, {to.x - head * (c + 0.45 * s), to.y - head * (s - 0.45 * c)}})}});
  }

  void paths(pugi::xml_node parent, const CurveDrawing& curve, std::size_t index) const {
    for (std::size_t c = 0; c < curve.components.size(); ++c) {
      const auto& component = curve.components[c];
      std::string d = command('M', {view_.place(component.segments[0][0])});
      for (std::size_t s = 0; s < component.segments.size(); ++s) {
        const std::vector<PagePoint> rest = places(component.segments[s], 1);
        const char letter = !component.exact[s] || rest.size() == 1 ? 'L' : rest.size() == 2 ? 'Q' : 'C';
        d += command(letter, rest);
      }
      pugi::xml_node path =
          add(parent, "path", {{"class", "curve"}, {"d", d}, {"stroke", line_colour(index)}, {"stroke-width", "2.4"}});
      const std::vector<double>& dashes = dashes_[index][c];
      if (dashes.empty()) continue;
      std::string lengths;
      for (const double length : dashes) lengths += (lengths.empty() ? "" : " ") + page_number(length);
      path.append_attribute("stroke-dasharray") = lengths.c_str();
      path.append_attribute("stroke-linecap") = "butt";  // round ends would fill the gaps
    }
  }

  // A short line across the curve at each break; a square where the curve has no direction.
  void marks(pugi::xml_node parent, Labels& labels, const CurveDrawing& curve, std::size_t index) const {
    pugi::xml_node group =
        add(parent, "g", {{"class", "knots"}, {"stroke", line_colour(index)}, {"stroke-width", "1.6"}});
    for (const auto& component : curve.components)
      for (const auto& mark : component.marks) {
        const PagePoint p = view_.place(mark.at), a = view_.place(mark.before), b = view_.place(mark.after);
        const double length = std::hypot(b.x - a.x, b.y - a.y), r = 6;
        if (length > 0.01) {
          const double x = -(b.y - a.y) / length * r, y = (b.x - a.x) / length * r;
          add(group, "path", {{"d", command('M', {{p.x - x, p.y - y}}) + command('L', {{p.x + x, p.y + y}})}});
        } else {
          add(group, "path",
              {{"d", command('M', {{p.x - 3, p.y - 3}}) +
                         command('L', {{p.x + 3, p.y - 3}, {p.x + 3, p.y + 3}, {p.x - 3, p.y + 3}}) + "Z"}});
        }
        if (has_labels()) labels.put_near(p, 9, mark.label, 11, line_colour(index));
      }
  }

  // ---- what the signs mean --------------------------------------------------------------------------------------------

  Legend legend() const {
    Legend out;
    const std::size_t curves = drawing_.curves.size();
    for (std::size_t i = 0; i < curves && i < kMostNamed; ++i)
      out.add_line(shortened(drawing_.curves[i].name, 11.5, 150), line_colour(i), "2.4");
    if (curves > kMostNamed) out.add(fmt::format("and {} more", curves - kMostNamed), [](auto...) {});
    const bool has_polygons = std::any_of(drawing_.curves.begin(), drawing_.curves.end(),
                                          [](const CurveDrawing& c) { return !c.controls.empty(); });
    if (has_polygons && show_polygons_) out.add_line("control polygon", kFaint, "1.1", "5 3");
    if (curves > 0)
      out.add("knot", [](pugi::xml_node group, double left, double middle) {
        add(group, "path",
            {{"d", command('M', {{left + 10, middle - 6}}) + command('L', {{left + 10, middle + 6}})},
             {"stroke", kInk},
             {"stroke-width", "1.6"}});
      });
    const auto is_vector = [](const DrawnControl& p) { return p.is_vector; };
    if (show_polygons_ && std::any_of(drawing_.curves.begin(), drawing_.curves.end(), [&](const CurveDrawing& c) {
          return std::any_of(c.controls.begin(), c.controls.end(), is_vector);
        }))
      out.add("control vector, weight 0", [](pugi::xml_node group, double left, double middle) {
        arrow(group, {left, middle}, {left + 20, middle});
      });
    const auto& patches = drawing_.patches;
    if (!patches.empty())
      out.add_line(std::any_of(patches.begin(), patches.end(), has_inner_knots) ? "edges and knot lines" : "edges",
                   "#4a6a8c", "1.3");
    if (std::any_of(patches.begin(), patches.end(), [](const auto& p) { return std::max(p.cells[0], p.cells[1]) > 1; }))
      out.add_line("parameter lines", "#4a6a8c", "0.6");
    if (std::any_of(drawing_.patches.begin(), drawing_.patches.end(), [](const auto& p) { return !p.nets.empty(); }))
      out.add_line("control net", kAccent, "0.9");
    const auto is_left = [](const DrawnNormal& n) { return n.from_left; };
    if (std::any_of(drawing_.normals.begin(), drawing_.normals.end(), is_left))
      out.add_line("normal from the left of a line", kFromLeft, "0.9");
    if (!std::all_of(drawing_.normals.begin(), drawing_.normals.end(), is_left))
      out.add_line("from the right", kFromRight, "1.8");
    if (!drawing_.levels.empty()) out.add_line("sections z = const", kSection, "1.3");
    return out;
  }

  // The directions of the axes, at the right of the legend.
  void triad(pugi::xml_node root, double y) const {
    pugi::xml_node group = add(root, "g", {{"class", "triad"}});
    const PagePoint origin{kPageWidth - 54, y};
    for (int axis = 0; axis < 3; ++axis) {
      const double x = 24 * view_.right()[axis], up = 24 * view_.up()[axis];
      const PagePoint tip{origin.x + x, origin.y - up};
      add(group, "path",
          {{"d", command('M', {origin}) + command('L', {tip})}, {"stroke", kInk}, {"stroke-width", "1.2"}});
      add_text(group, {origin.x + 1.36 * x, origin.y - 1.36 * up + 4}, std::array{"x", "y", "z"}[axis], 11.5, kInk,
               Anchor::middle);
    }
  }

  const Drawing& drawing_;
  bool show_polygons_, plane_;
  View view_;
  double normal_length_ = 0;
  std::string title_, subtitle_;
  std::vector<std::vector<std::vector<double>>> dashes_;  // of the curves: svg_layers.h
};

}  // namespace

std::string svg_scene(const Drawing& drawing, const PlotOptions& options) {
  return Scene(drawing, {&drawing, 1}, options).draw();
}

std::vector<std::string> svg_scenes(const std::vector<Drawing>& drawings, const PlotOptions& options) {
  std::vector<std::string> out;
  for (const Drawing& drawing : drawings) out.push_back(Scene(drawing, drawings, options).draw());
  return out;
}

}  // namespace patchproof
