// SPDX-License-Identifier: Apache-2.0
// Curves, patches and maps as meshes of doubles, for pictures and for other programs.
//
// Each span of the knots is cut into equal cells; one mesh for each component of the domain (domain_grid.h), so that no
// cell reaches across a jump. Points are A/w of the homogeneous spline, evaluated by the ordinary templates in double, with
// exact knots and parameters where they are exact.
// Normals are S_u × S_v / |S_u × S_v|. Where that cross product is small beside those elsewhere, exact data decide whether
// it is zero: at a pole the vertex takes the mean of its neighbours' normals, and none where these cancel or have none.
//
// ENSURES   (1) vertex k of component c lies at the parameters and sides of domain_grids, within rounding of the exact
//               point; the cells are those of the grid;
//           (2) every normal has length 1 within rounding and points to the side of S_u × S_v; where the exact product is
//               zero it is the mean of the neighbours' or absent, never NaN and never of length 0;
//           (3) the ends of a component are the two one-sided limits at a jump;
//           (4) tessellate_map does the same with any map; its normals (D = 2) are means over the cells around a vertex,
//               weighted by area.
// ERRORS    vanishing_weight: the denominator is 0 in double;  bad_number: a point that is no finite double;
//           usage: more than kMaxMeshVertices vertices.
// REQUIRES  at least one cell in each span; a denominator without a zero on the domain (readers certify it).
// SCALARS   T: Field with embedding<double, T>, K: OrderedField with embedding<double, K>.
// COST      one evaluation for each vertex; basis functions once for each line of the grid.
// NEIGHBOURS domain_grid.h, io/mesh_files.h (writes them).
// TEST      tests/mesh/tessellate_test.cpp checks (1)–(4).
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/mesh/domain_grid.h"
#include "patchproof/patch/rational_patch.h"

namespace patchproof {

// D: how many parameters.
template <std::size_t D>
struct Tessellation {
  CellComplex<double, 3> mesh;  // cuboids: edges, quadrangles, hexahedra
  std::vector<Vec<double, D>> parameters;
  std::vector<std::optional<Vec<double, 3>>> normals;  // of each vertex when D = 2, else empty
};

constexpr std::size_t kMaxMeshVertices = std::size_t{1} << 26;

// A curve of homogeneous points: polylines.
template <Field T, OrderedField K>
Result<std::vector<Tessellation<1>>> tessellate(const BsplineCurve<T, 4, K>& curve, int cells_per_span);

// A patch of homogeneous points: quadrangles, positive in the (u, v) plane.
template <Field T, OrderedField K>
Result<std::vector<Tessellation<2>>> tessellate(const BsplinePatch<T, 4, K>& patch, std::array<int, 2> cells_per_span);

// f(std::array<K, D> parameters, std::array<Side, D> sides) → Vec<double, 3>.
template <OrderedField K, std::size_t D, class F>
Result<std::vector<Tessellation<D>>> tessellate_map(const std::array<SampledDomain<K>, D>& directions, F f);

// v / |v|, or nothing when v is zero or not finite; without overflow or underflow on the way.
std::optional<Vec<double, 3>> unit(const Vec<double, 3>& v);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// For a grid of columns × rows vertices, column running fastest: where a normal is missing, the mean of those of the
// neighbours that have one.
void borrow_normals(std::vector<std::optional<Vec<double, 3>>>& normals, std::size_t columns);

// The mean of the normals of the quadrangles at each vertex, weighted by area.
std::vector<std::optional<Vec<double, 3>>> normals_of_cells(const CellComplex<double, 3>& mesh);

bool is_finite(const Vec<double, 3>& p);

// The error for a point at these parameters.
Error not_a_double(std::span<const double> parameters, bool no_weight);

// The error when a product of so many vertices is too much; asked before anything of that size is built.
template <std::size_t D>
std::optional<Error> too_many_vertices(const std::array<std::size_t, D>& along) {
  std::size_t count = 1;
  for (const std::size_t n : along) {
    if (n > kMaxMeshVertices / count)
      return Error{ErrorCode::usage, "", "the mesh would have more than 2^26 vertices; ask for fewer cells", ""};
    count *= std::max<std::size_t>(n, 1);
  }
  return std::nullopt;
}

// At least so many vertices has sample_spans.
template <OrderedField K>
std::size_t vertices_along(const KnotVector<K>& knots, int cells_per_span) {
  PATCHPROOF_REQUIRES(cells_per_span >= 1, "tessellate: at least one cell in each span");
  return (knots.breaks().size() - 1) * static_cast<std::size_t>(cells_per_span) + 1;
}

template <OrderedField K, std::size_t D>
std::vector<Vec<double, D>> rounded_parameters(const DomainGrid<K, D>& grid) {
  std::vector<Vec<double, D>> out;
  out.reserve(grid.complex.vertices.size());
  for (const Vec<K, D>& x : grid.complex.vertices) {
    Vec<double, D> rounded;
    for (std::size_t i = 0; i < D; ++i) rounded[i] = embed<double>(x[i]);
    out.push_back(rounded);
  }
  return out;
}

// The basis functions at one parameter, and their first derivatives.
struct BasisAt {
  int span;
  std::vector<std::vector<double>> functions;
};

template <OrderedField K>
std::vector<BasisAt> basis_along(const KnotVector<K>& knots, const std::vector<DomainSample<K>>& samples) {
  std::vector<BasisAt> out;
  out.reserve(samples.size());
  for (const DomainSample<K>& s : samples) {
    const int span = knots.find_span(s.t, s.side);
    out.push_back({span, basis_derivatives_in_span<double>(knots, span, s.t, 1)});
  }
  return out;
}

inline double largest_coordinate(const Vec<double, 3>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

inline Vec<double, 3> divided(const Vec<double, 3>& v, double by) { return {{v[0] / by, v[1] / by, v[2] / by}}; }

// The direction of the exact S_u × S_v, or nothing when it is zero.
template <ExactField T, OrderedField K>
std::optional<Vec<double, 3>> exact_unit_normal(const BsplinePatch<T, 4, K>& patch, const Vec<K, 2>& at,
                                                const std::array<Side, 2>& sides) {
  const Vec<T, 3> n = normal(patch, at[0], at[1], sides[0], sides[1]);
  T size(0);
  for (std::size_t i = 0; i < 3; ++i) size = std::max({size, n[i], T(-n[i])});
  if (size == T(0)) return std::nullopt;
  Vec<double, 3> rounded;
  for (std::size_t i = 0; i < 3; ++i) rounded[i] = embed<double>(T(n[i] / size));
  return unit(rounded);
}

// Cross products below this part of the largest ones are looked at again.
constexpr double kDoubtful = 0x1p-20;
// In doubles, where nothing can be looked at again, these are taken for zero.
constexpr double kNoise = 0x1p-36;

}  // namespace detail

template <OrderedField K, std::size_t D, class F>
Result<std::vector<Tessellation<D>>> tessellate_map(const std::array<SampledDomain<K>, D>& directions, F f) {
  std::array<std::size_t, D> along{};
  for (std::size_t axis = 0; axis < D; ++axis)
    for (const auto& component : directions[axis]) along[axis] += component.size();
  if (auto error = detail::too_many_vertices(along)) return *error;
  std::vector<Tessellation<D>> out;
  for (const DomainGrid<K, D>& grid : domain_grids(directions)) {
    Tessellation<D> piece{map_domain(grid, f), detail::rounded_parameters(grid), {}};
    for (std::size_t v = 0; v < piece.mesh.vertices.size(); ++v)
      if (!detail::is_finite(piece.mesh.vertices[v])) return detail::not_a_double(piece.parameters[v].c, false);
    if constexpr (D == 2) piece.normals = detail::normals_of_cells(piece.mesh);
    out.push_back(std::move(piece));
  }
  return out;
}

template <Field T, OrderedField K>
Result<std::vector<Tessellation<1>>> tessellate(const BsplineCurve<T, 4, K>& curve, int cells_per_span) {
  if (auto error = detail::too_many_vertices(std::array{detail::vertices_along(curve.knots(), cells_per_span)}))
    return *error;
  std::vector<Vec<double, 4>> points;
  for (const Vec<T, 4>& p : curve.points())
    points.push_back({{embed<double>(p[0]), embed<double>(p[1]), embed<double>(p[2]), embed<double>(p[3])}});
  const BsplineCurve<double, 4, K> rounded(curve.knots(), std::move(points));
  std::optional<double> no_weight;  // where
  auto out = tessellate_map(std::array{sample_spans(curve.knots(), cells_per_span)},
                            [&](const std::array<K, 1>& t, const std::array<Side, 1>& side) {
                              const auto h =
                                  evaluate_in_span<double>(rounded, curve.knots().find_span(t[0], side[0]), t[0]);
                              if (h[3] != 0) return project(h);
                              no_weight = embed<double>(t[0]);
                              return Vec<double, 3>{{std::numeric_limits<double>::quiet_NaN(), 0, 0}};
                            });
  if (no_weight) return detail::not_a_double(std::span(&*no_weight, 1), true);
  return out;
}

template <Field T, OrderedField K>
Result<std::vector<Tessellation<2>>> tessellate(const BsplinePatch<T, 4, K>& patch, std::array<int, 2> cells_per_span) {
  const KnotVector<K>&knots_u = patch.knots(Direction::u), &knots_v = patch.knots(Direction::v);
  if (auto error = detail::too_many_vertices(std::array{detail::vertices_along(knots_u, cells_per_span[0]),
                                                        detail::vertices_along(knots_v, cells_per_span[1])}))
    return *error;
  const std::array directions{sample_spans(knots_u, cells_per_span[0]), sample_spans(knots_v, cells_per_span[1])};
  const auto rounded = map_points(patch, [](const Vec<T, 4>& p) {
    return Vec<double, 4>{{embed<double>(p[0]), embed<double>(p[1]), embed<double>(p[2]), embed<double>(p[3])}};
  });
  std::vector<Tessellation<2>> out;
  for (const DomainGrid<K, 2>& grid : domain_grids(directions)) {
    const auto along_u = detail::basis_along(knots_u, directions[0][grid.component[0]]),
               along_v = detail::basis_along(knots_v, directions[1][grid.component[1]]);
    Tessellation<2> piece{{CellKind::cuboid, 2, {}, grid.complex.corners}, detail::rounded_parameters(grid), {}};
    std::vector<std::array<Vec<double, 3>, 2>> tangents;
    double largest_u = 0, largest_v = 0;
    for (const auto& v : along_v)
      for (const auto& u : along_u) {
        const auto h = detail::contract<double>(rounded, u.span, v.span, u.functions, v.functions);
        const std::span<const double> where = piece.parameters[tangents.size()].c;
        if (h.at(0, 0)[3] == 0) return detail::not_a_double(where, true);
        const auto s = rational_derivatives(h);
        if (!detail::is_finite(s.at(0, 0))) return detail::not_a_double(where, false);
        piece.mesh.vertices.push_back(s.at(0, 0));
        tangents.push_back({s.at(1, 0), s.at(0, 1)});
        largest_u = std::max(largest_u, detail::largest_coordinate(s.at(1, 0)));
        largest_v = std::max(largest_v, detail::largest_coordinate(s.at(0, 1)));
      }
    for (std::size_t k = 0; k < tangents.size(); ++k) {
      // Scaled first, so that the product can neither overflow nor underflow unless it is small.
      const auto product =
          cross(detail::divided(tangents[k][0], largest_u), detail::divided(tangents[k][1], largest_v));
      const double size = detail::largest_coordinate(product);
      if constexpr (scalar_traits<T>::is_exact && scalar_traits<K>::is_exact) {
        piece.normals.push_back(size > detail::kDoubtful
                                    ? unit(product)
                                    : detail::exact_unit_normal(patch, grid.complex.vertices[k], grid.sides[k]));
      } else {
        piece.normals.push_back(size > detail::kNoise ? unit(product) : std::nullopt);
      }
    }
    detail::borrow_normals(piece.normals, along_u.size());
    out.push_back(std::move(piece));
  }
  return out;
}

}  // namespace patchproof
