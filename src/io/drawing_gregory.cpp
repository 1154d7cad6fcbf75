// SPDX-License-Identifier: Apache-2.0
// Gregory patches, normals along lines of knots, and sections.
#include <algorithm>
#include <cmath>

#include "io/drawing_patches.h"

namespace patchproof {
namespace {

constexpr double kNormalLength = 0.12;  // of the extent
constexpr int kNormalCells = 6;         // normals in each span of a line

template <ExactField T>
KnotVector<double> rounded(const KnotVector<T>& knots) {
  std::vector<double> out;
  for (const T& t : knots.knots()) out.push_back(nearest_double(t));
  return KnotVector<double>::make_unchecked(knots.degree(), std::move(out));
}
template <ExactField T>
Result<GregoryPatch<double>> rounded(const GregoryPatch<T>& patch) {
  const auto surface = [](const BsplinePatch<T, 4>& s) {
    std::vector<Vec<double, 4>> net;
    for (const Vec<T, 4>& p : s.net())
      net.push_back({{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2]), nearest_double(p[3])}});
    return BsplinePatch<double, 4>(rounded(s.knots(Direction::u)), rounded(s.knots(Direction::v)), std::move(net));
  };
  return GregoryPatch<double>::make(surface(patch.u_surface()), surface(patch.v_surface()));
}

// The same places and limits in either kind of patch.
template <ExactField T>
SurfaceFrame<T> exact_frame(const Model<T>& model, int i, const T& u, const T& v, Side side_u, Side side_v) {
  const PartialDerivatives<T, 3> s = rational_derivatives(model.patches[i].surface, u, v, 1, 1, side_u, side_v);
  return {s.at(0, 0), s.at(1, 0), s.at(0, 1)};
}

}  // namespace

template <ExactField T>
Result<std::vector<Tessellation<2>>> tessellate(const GregoryPatch<T>& patch, std::array<int, 2> cells) {
  const KnotVector<T>&knots_u = patch.v_surface().knots(Direction::u), &knots_v = patch.u_surface().knots(Direction::v);
  if (auto error = detail::too_many_vertices(
          std::array{detail::vertices_along(knots_u, cells[0]), detail::vertices_along(knots_v, cells[1])}))
    return *error;
  const Result<GregoryPatch<double>> in_double = rounded(patch);
  if (!in_double) return in_double.error();
  std::vector<Tessellation<2>> out;
  const std::array directions{sample_spans(knots_u, cells[0]), sample_spans(knots_v, cells[1])};
  for (const DomainGrid<T, 2>& grid : domain_grids(directions)) {
    Tessellation<2> piece;
    piece.parameters = detail::rounded_parameters(grid);
    std::size_t next = 0;
    bool finite = true;
    piece.mesh = map_domain(grid, [&](const std::array<T, 2>&, const std::array<Side, 2>& sides) {
      const Vec<double, 2>& at = piece.parameters[next++];
      const SurfaceFrame<double> f = frame(*in_double, at[0], at[1], sides[0], sides[1]);
      finite = finite && detail::is_finite(f.point);
      piece.normals.push_back(unit(f.normal()));
      return f.point;
    });
    if (!finite) return detail::not_a_double(piece.parameters[0].c, false);
    detail::borrow_normals(piece.normals, directions[0][0].size());
    out.push_back(std::move(piece));
  }
  return out;
}

template <ExactField T>
Result<PatchDrawing> draw_gregory(const Model<T>& model, int i, std::array<int, 2> cells, bool control) {
  const GregoryPatch<T>& patch = *gregory_patch(model, i);
  PatchDrawing out;
  out.name = title_of("patch", i, patch_name(model, i));
  out.cells = cells;
  out.degree = {patch.v_surface().degree(Direction::u), patch.u_surface().degree(Direction::v)};
  for (const auto* surface : {&patch.u_surface(), &patch.v_surface()})
    for (const Vec<T, 4>& p : surface->net()) out.is_rational = out.is_rational || !(p[3] == T(1));
  auto pieces = tessellate(patch, cells);
  if (!pieces) return Error{pieces.error().code, out.name, pieces.error().message, pieces.error().where};
  out.pieces = std::move(*pieces);
  if (!control) return out;
  for (const auto* surface : {&patch.u_surface(), &patch.v_surface()})
    if (auto error = add_net(out, *surface)) return *error;
  return out;
}

template <ExactField T>
Result<std::vector<DrawnNormal>> normals_along_lines(const Model<T>& model, const std::vector<int>& patches) {
  std::vector<DrawnNormal> out;
  for (const int i : patches) {
    const GregoryPatch<T>* gregory = gregory_patch(model, i);
    for (const Direction across : {Direction::u, Direction::v}) {
      const Direction along = across == Direction::u ? Direction::v : Direction::u;
      const KnotVector<T>& lines = patch_knots(model, i, across);
      for (const T& line : lines.breaks())
        for (const auto& component : sample_spans(patch_knots(model, i, along), kNormalCells))
          for (const DomainSample<T>& s : component)
            for (const Side side : {Side::left, Side::right}) {
              if (side == Side::left ? line == lines.domain_begin() : line == lines.domain_end()) continue;
              const bool is_u = across == Direction::u;
              const T &u = is_u ? line : s.t, &v = is_u ? s.t : line;
              const Side side_u = is_u ? side : s.side, side_v = is_u ? s.side : side;
              const SurfaceFrame<T> f =
                  gregory ? frame(*gregory, u, v, side_u, side_v) : exact_frame(model, i, u, v, side_u, side_v);
              const Vec<T, 3> n = f.normal();
              DrawnNormal normal{{}, {}, side == Side::left};
              T size(0);
              for (std::size_t c = 0; c < 3; ++c) {
                size = std::max({size, n[c], T(-n[c])});
                normal.at[c] = nearest_double(f.point[c]);
              }
              if (size == T(0)) continue;  // no normal: a pole
              for (std::size_t c = 0; c < 3; ++c) normal.direction[c] = nearest_double(T(n[c] / size));
              const std::optional<Point3> direction = unit(normal.direction);
              if (!direction || !detail::is_finite(normal.at))
                return Error{ErrorCode::bad_number, title_of("patch", i, patch_name(model, i)),
                             "a point with a normal is no finite number in doubles", ""};
              normal.direction = *direction;
              out.push_back(normal);
            }
    }
  }
  return out;
}

double normal_length(const std::vector<DrawnNormal>& normals) {
  double extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const DrawnNormal& n : normals) low = std::min(low, n.at[axis]), high = std::max(high, n.at[axis]);
    if (low < high) extent = std::max(extent, high - low);
  }
  return kNormalLength * extent;
}

std::vector<double> section_levels(const std::vector<PatchDrawing>& patches, int count) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const PatchDrawing& patch : patches)
    for (const auto& piece : patch.pieces)
      for (const Point3& p : piece.mesh.vertices) low = std::min(low, p[2]), high = std::max(high, p[2]);
  return section_levels(low, high, count);
}

std::vector<double> section_levels(double low, double high, int count) {
  std::vector<double> out;
  if (!(low < high)) return out;
  for (int k = 1; k <= count; ++k) out.push_back(low + (high - low) * (k - 0.5) / count);
  return out;
}

std::vector<std::array<Point3, 2>> section(const std::array<Point3, 4>& corners, double level) {
  std::vector<std::array<Point3, 2>> out;
  // Two triangles, so that there is never a choice.
  for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    std::vector<Point3> ends;
    for (int k = 0; k < 3; ++k) {
      const Point3 &a = corners[t[k]], &b = corners[t[(k + 1) % 3]];
      if ((a[2] < level) == (b[2] < level)) continue;
      const double share = (level - a[2]) / (b[2] - a[2]);
      ends.push_back({{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), level}});
    }
    if (ends.size() == 2) out.push_back({ends[0], ends[1]});
  }
  return out;
}

template Result<std::vector<Tessellation<2>>> tessellate(const GregoryPatch<Rational>&, std::array<int, 2>);
template Result<std::vector<Tessellation<2>>> tessellate(const GregoryPatch<Quadratic>&, std::array<int, 2>);
template Result<PatchDrawing> draw_gregory(const Model<Rational>&, int, std::array<int, 2>, bool);
template Result<PatchDrawing> draw_gregory(const Model<Quadratic>&, int, std::array<int, 2>, bool);
template Result<std::vector<DrawnNormal>> normals_along_lines(const Model<Rational>&, const std::vector<int>&);
template Result<std::vector<DrawnNormal>> normals_along_lines(const Model<Quadratic>&, const std::vector<int>&);

}  // namespace patchproof
