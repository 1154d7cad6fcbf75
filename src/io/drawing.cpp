// SPDX-License-Identifier: Apache-2.0
#include "io/drawing_patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/mesh_parts.h"
#include "patchproof/spline/bezier_extraction.h"

namespace patchproof {
namespace {

constexpr int kCurveCells = 96, kBasisCells = 64;
constexpr int kPictureQuadrangles = 5000;    // about so many when the cells are chosen here
constexpr std::size_t kMostDrawn = 1000000;  // edges or quadrangles; more than any viewer of SVG bears

// Short and exact, or 4 digits.
template <ExactField T>
std::string label_of(const T& t) {
  const std::string exact = to_text(t);
  return exact.size() <= 6 ? exact : fmt::format("{:.4g}", nearest_double(t));
}

// The Bézier points of a polynomial piece of degree 1 to 3.
template <ExactField T>
std::optional<std::vector<Point3>> bezier_points(const std::vector<Vec<T, 4>>& points) {
  if (points.size() < 2 || points.size() > 4) return std::nullopt;
  std::vector<Point3> out;
  for (const Vec<T, 4>& p : points) {
    if (!(p[3] == points[0][3]) || p[3] == T(0)) return std::nullopt;
    out.push_back(control_of(p).at);
  }
  return out;
}

template <ExactField T>
Result<CurveDrawing> draw_curve(const ModelCurve<T>& model, int index, int cells) {
  const BsplineCurve<T, 4>& curve = model.curve;
  CurveDrawing out{
      title_of("curve", index, model.name), curve.degree(), model.is_rational, model.dimension == 2, {}, {}};
  const auto pieces = tessellate(curve, cells);
  if (!pieces) return Error{pieces.error().code, out.name, pieces.error().message, pieces.error().where};
  for (const Vec<T, 4>& p : curve.points()) out.controls.push_back(control_of(p));
  for (const DrawnControl& c : out.controls)
    if (!detail::is_finite(c.at))
      return Error{ErrorCode::bad_number, out.name, "a control point is no finite number in doubles", ""};
  const auto bezier = extract_bezier(curve);
  const std::vector<T> breaks = curve.knots().breaks();
  std::size_t span = 0;
  for (std::size_t c = 0; c < pieces->size(); ++c) {
    const std::vector<Point3>& vertices = (*pieces)[c].mesh.vertices;
    CurveDrawing::Component component;
    const std::size_t spans = (vertices.size() - 1) / cells;
    for (std::size_t s = 0; s <= spans; ++s) {
      const std::size_t v = s * cells;
      const int multiplicity = curve.knots().multiplicity(breaks[span + s]);
      std::string label = label_of(breaks[span + s]);
      // The two limits at a jump are two places.
      if (s == spans && c + 1 < pieces->size()) label += "−";
      if (s == 0 && c > 0) label += "+";
      if (multiplicity > 1 && s > 0 && s < spans) label += fmt::format(" ×{}", multiplicity);
      component.marks.push_back(
          {vertices[v], vertices[v > 0 ? v - 1 : v], vertices[v + 1 < vertices.size() ? v + 1 : v], label});
      if (s == spans) break;
      const auto exact = bezier_points(bezier[span + s].points);
      component.exact.push_back(exact.has_value());
      component.segments.push_back(exact ? *exact
                                         : std::vector<Point3>(vertices.begin() + v, vertices.begin() + v + cells + 1));
    }
    span += spans;
    out.components.push_back(std::move(component));
  }
  return out;
}

// How long the control net is along u and along v, on average, for each span; nothing when doubles cannot tell.
template <ExactField T>
std::optional<std::array<double, 2>> span_lengths(const BsplinePatch<T, 4>& s) {
  std::array<double, 2> sum{};
  const int rows = s.count(Direction::u), columns = s.count(Direction::v);
  const auto length = [&](const Vec<T, 4>& a, const Vec<T, 4>& b) {
    const DrawnControl p = control_of(a), q = control_of(b);
    const Point3 d = q.at - p.at;
    return p.is_vector || q.is_vector ? 0.0 : std::hypot(d[0], d[1], d[2]);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i + 1 < rows) sum[0] += length(s.point(i, j), s.point(i + 1, j)) / columns;
      if (j + 1 < columns) sum[1] += length(s.point(i, j), s.point(i, j + 1)) / rows;
    }
  for (const Direction d : {Direction::u, Direction::v})
    sum[d == Direction::v] /= static_cast<double>(s.knots(d).breaks().size() - 1);
  if (!std::isfinite(sum[0] * sum[1]) || !(sum[0] * sum[1] > 0)) return std::nullopt;
  return sum;
}

// Cells of about the same size everywhere: painter's order and shading want neighbours of one size.
template <ExactField T>
std::vector<std::array<int, 2>> even_cells(const Model<T>& model, const std::vector<int>& patches, int otherwise) {
  std::vector<std::optional<std::array<double, 2>>> lengths;
  double area = 0;
  for (const int i : patches) {
    if (const GregoryPatch<T>* gregory = gregory_patch(model, i)) {
      const auto of_u = span_lengths(gregory->u_surface()), of_v = span_lengths(gregory->v_surface());
      lengths.push_back(of_u && of_v ? std::optional(std::array{(*of_v)[0], (*of_u)[1]}) : std::nullopt);
    } else {
      lengths.push_back(span_lengths(model.patches[i].surface));
    }
    if (lengths.back()) area += static_cast<double>(spans_of(model, i)) * (*lengths.back())[0] * (*lengths.back())[1];
  }
  const double size = std::sqrt(area / kPictureQuadrangles);
  std::vector<std::array<int, 2>> out;
  for (const auto& l : lengths) {
    out.push_back({otherwise, otherwise});
    if (!l || !std::isfinite(size) || otherwise < 4) continue;
    for (int d : {0, 1}) {
      const int cells = static_cast<int>(std::clamp((*l)[d] / size, otherwise < 8 ? 4.0 : 8.0, 40.0));
      out.back()[d] = cells - cells % 4;
    }
  }
  return out;
}

template <ExactField T>
Result<PatchDrawing> draw_patch(const ModelPatch<T>& model, int index, std::array<int, 2> cells, bool control) {
  const BsplinePatch<T, 4>& s = model.surface;
  PatchDrawing out{false,
                   title_of("patch", index, model.name),
                   {s.degree(Direction::u), s.degree(Direction::v)},
                   cells,
                   model.is_rational,
                   {},
                   {s.count(Direction::u), s.count(Direction::v)}};
  auto pieces = tessellate(s, out.cells);
  if (!pieces) return Error{pieces.error().code, out.name, pieces.error().message, pieces.error().where};
  out.pieces = std::move(*pieces);
  if (control) {
    if (auto error = add_net(out, s)) return *error;
  }
  return out;
}

// Along each side of a span; a multiple of 4, for the isoparametric lines, when there are that many.
int picture_cells(std::size_t spans) {
  const double wide = std::sqrt(kPictureQuadrangles / std::max<double>(1, static_cast<double>(spans)));
  const int cells = std::clamp(static_cast<int>(wide), 2, 24);
  return cells < 4 ? cells : cells - cells % 4;
}

Error too_much_to_draw() {
  return {ErrorCode::usage, "svg", "more than a million cells to draw; ask for fewer cells, or for one curve or patch",
          ""};
}

// The graphs of all functions on the knots; with weights, of the rational ones.
template <ExactField T>
Result<BasisDrawing> graphs(const std::string& title, const KnotVector<T>& knots, const std::vector<T>& weights,
                            int cells) {
  BasisDrawing out{title, knots.degree(), !weights.empty(), {}, {}, {}};
  const T &first = knots.knots().front(), range = knots.knots().back() - first;
  const auto place = [&](const T& t) { return nearest_double(T((t - first) / range)); };
  out.domain = {place(knots.domain_begin()), place(knots.domain_end())};
  for (std::size_t i = 0; i < knots.knots().size(); ++i) {
    const T& t = knots.knots()[i];
    if (i > 0 && t == knots.knots()[i - 1]) continue;
    out.knots.push_back({place(t), knots.multiplicity(t), label_of(t)});
  }
  const int p = knots.degree();
  out.functions.resize(knots.control_count());
  for (int i = 0; i < knots.control_count(); ++i)
    out.functions[i].support = fmt::format("[{}, {}]", label_of(knots[i]), label_of(knots[i + p + 1]));
  for (const auto& samples : sample_spans(knots, cells)) {
    std::vector<int> spans;
    std::vector<std::vector<double>> live;  // the p + 1 functions of the span, at each sample
    for (const auto& [t, side] : samples) {
      spans.push_back(knots.find_span(t, side));
      std::vector<T> values = basis_in_span<T>(knots, spans.back(), t);
      T sum(weights.empty() ? 1 : 0);
      for (int j = 0; j <= p && !weights.empty(); ++j) sum += values[j] = values[j] * weights[spans.back() - p + j];
      if (sum == T(0)) return Error{ErrorCode::vanishing_weight, title, "the denominator is zero", "at " + label_of(t)};
      live.emplace_back();
      for (const T& value : values) live.back().push_back(nearest_double(T(value / sum)));
    }
    for (int i = 0; i < knots.control_count(); ++i) {
      const T begin = std::max(knots[i], samples.front().t), end = std::min(knots[i + p + 1], samples.back().t);
      if (!(begin < end)) continue;
      std::vector<std::array<double, 2>> line;
      const auto begins =
          std::lower_bound(samples.begin(), samples.end(), begin, [](const auto& s, const T& t) { return s.t < t; });
      for (std::size_t k = begins - samples.begin(); k < samples.size() && !(end < samples[k].t); ++k) {
        const int j = i - spans[k] + p;  // at the end of the support the next span lives, and the function is 0
        line.push_back({place(samples[k].t), 0 <= j && j <= p ? live[k][j] : 0.0});
      }
      out.functions[i].components.push_back(std::move(line));
    }
  }
  return out;
}

template <ExactField T>
struct BasisSource {
  std::string owner;
  KnotVector<T> knots;
  std::vector<T> weights;  // empty: no rational functions
};

template <ExactField T>
bool has_different_weights(const std::vector<T>& weights) {
  return std::any_of(weights.begin(), weights.end(), [&](const T& w) { return !(w == weights.front()); });
}

}  // namespace

template <ExactField T>
Result<Chosen> chosen(const Model<T>& model, const PlotOptions& options) {
  Chosen out;
  const bool all = !options.curve && !options.patch && !options.solid;
  const auto choose = [&](std::vector<int>& indices, std::size_t count, const std::optional<int>& only,
                          const char* what, const char* plural) -> std::optional<Error> {
    if (only && (*only < 0 || *only >= static_cast<int>(count)))
      return Error{ErrorCode::bad_reference, fmt::format("--{}", what),
                   count == 0   ? fmt::format("the model has no {}", plural)
                   : count == 1 ? fmt::format("the model has one {}, number 0", what)
                                : fmt::format("the model has {} 0 to {}", plural, count - 1),
                   std::to_string(*only)};
    if (only) indices.push_back(*only);
    for (std::size_t i = 0; all && i < count; ++i) indices.push_back(static_cast<int>(i));
    return std::nullopt;
  };
  const auto is_control = [&](int patch) {
    return std::any_of(model.solids.begin(), model.solids.end(), [&](const ModelSolid<T>& solid) {
      return std::any_of(solid.controls.begin(), solid.controls.end(),
                         [&](const auto& control) { return control.patch == patch; });
    });
  };
  if (auto error = choose(out.curves, model.curves.size(), options.curve, "curve", "curves")) return *error;
  if (auto error =
          choose(out.patches, model.patches.size() + model.gregory_patches.size(), options.patch, "patch", "patches"))
    return *error;
  if (auto error = choose(out.solids, model.solids.size(), options.solid, "solid", "solids")) return *error;
  if (all && !options.basis) std::erase_if(out.patches, is_control);
  return out;
}

std::string title_of(const std::string& what, int index, const std::string& name) {
  return name.empty() ? fmt::format("{} {}", what, index) : printable(name);
}

template <ExactField T>
Result<Drawing> draw(const Model<T>& model, const PlotOptions& options) {
  const Result<Chosen> which = chosen(model, options);
  if (!which) return which.error();
  Drawing out;
  std::size_t spans = 0, edges = 0;
  for (const int i : which->patches) spans += spans_of(model, i);
  for (const int i : which->solids) spans += face_spans(model.solids[i].map);
  for (const int i : which->curves) edges += model.curves[i].curve.knots().breaks().size() - 1;
  const int cells = options.cells.value_or(picture_cells(spans));
  const std::size_t wide = static_cast<std::size_t>(cells);
  if (spans > kMostDrawn || spans * wide > kMostDrawn || spans * wide * wide > kMostDrawn) return too_much_to_draw();
  const int curve_cells = options.cells.value_or(kCurveCells);
  if (edges > kMostDrawn || edges * static_cast<std::size_t>(curve_cells) > kMostDrawn) return too_much_to_draw();
  for (const int i : which->curves) {
    auto drawn = draw_curve(model.curves[i], i, curve_cells);
    if (!drawn) return drawn.error();
    out.curves.push_back(std::move(*drawn));
  }
  std::vector<std::array<int, 2>> patch_cells(which->patches.size(), {cells, cells});
  if (!options.cells) patch_cells = even_cells(model, which->patches, cells);
  for (std::size_t k = 0; k < which->patches.size(); ++k) {
    const int i = which->patches[k];
    const bool control = options.control.value_or(false);
    auto drawn = gregory_patch(model, i) ? draw_gregory(model, i, patch_cells[k], control)
                                         : draw_patch(model.patches[i], i, patch_cells[k], control);
    if (!drawn) return drawn.error();
    out.patches.push_back(std::move(*drawn));
  }
  for (const int i : which->solids) {
    auto drawn = draw_solid(model.solids[i], i, cells);
    if (!drawn) return drawn.error();
    out.patches.push_back(std::move(*drawn));
  }
  if (options.normals) {
    auto normals = normals_along_lines(model, which->patches);
    if (!normals) return normals.error();
    out.normals = std::move(*normals);
  }
  if (options.sections) out.levels = section_levels(out.patches, *options.sections);
  return out;
}

template <ExactField T>
Result<std::vector<BasisDrawing>> draw_basis(const Model<T>& model, const PlotOptions& options) {
  const Result<Chosen> which = chosen(model, options);
  if (!which) return which.error();
  std::vector<BasisSource<T>> sources;
  const auto add = [&](const std::string& owner, const KnotVector<T>& knots, std::vector<T> weights) {
    if (!has_different_weights(weights)) weights.clear();
    for (BasisSource<T>& s : sources)
      if (s.knots == knots && s.weights == weights) {
        if (!s.owner.ends_with(", …")) s.owner += s.owner.size() < 60 ? ", " + owner : ", …";
        return;
      }
    sources.push_back({owner, knots, std::move(weights)});
  };
  for (const int i : which->curves) {
    const ModelCurve<T>& c = model.curves[i];
    std::vector<T> weights;
    for (const Vec<T, 4>& p : c.curve.points()) weights.push_back(p[3]);
    add(title_of("curve", i, c.name), c.curve.knots(), std::move(weights));
  }
  for (const int i : which->patches) {
    for (const Direction d : {Direction::u, Direction::v})
      add(title_of("patch", i, patch_name(model, i)) + (d == Direction::u ? " along u" : " along v"),
          patch_knots(model, i, d), {});
  }
  std::vector<BasisDrawing> out;
  std::size_t cells_drawn = 0;
  const int cells = options.cells.value_or(kBasisCells);
  for (const BasisSource<T>& s : sources) {
    cells_drawn += (s.knots.breaks().size() - 1) * (s.knots.degree() + 1);
    if (cells_drawn * static_cast<std::size_t>(cells) > kMostDrawn) return too_much_to_draw();
    for (const bool rational : {false, true}) {
      if (rational && s.weights.empty()) continue;
      auto panel = graphs(s.owner, s.knots, rational ? s.weights : std::vector<T>{}, cells);
      if (!panel) return panel.error();
      out.push_back(std::move(*panel));
    }
  }
  if (out.empty())
    return Error{ErrorCode::usage, "--basis", "there are no curves and no patches whose functions could be drawn", ""};
  return out;
}

template Result<Chosen> chosen(const Model<Rational>&, const PlotOptions&);
template Result<Chosen> chosen(const Model<Quadratic>&, const PlotOptions&);
template Result<Drawing> draw(const Model<Rational>&, const PlotOptions&);
template Result<Drawing> draw(const Model<Quadratic>&, const PlotOptions&);
template Result<std::vector<BasisDrawing>> draw_basis(const Model<Rational>&, const PlotOptions&);
template Result<std::vector<BasisDrawing>> draw_basis(const Model<Quadratic>&, const PlotOptions&);

}  // namespace patchproof
