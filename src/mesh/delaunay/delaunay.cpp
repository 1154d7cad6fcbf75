// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/delaunay.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>

namespace patchproof {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  // points are never constructed
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                               CGAL::No_constraint_intersection_tag>;

Error crossing(std::size_t segment, const std::array<int, 2>& ends) {
  return {ErrorCode::usage, "segment " + std::to_string(segment), "a segment meets another one or a point on its way",
          std::to_string(ends[0]) + ", " + std::to_string(ends[1])};
}

}  // namespace

Result<std::vector<std::array<int, 3>>> constrained_delaunay(const std::vector<Vec<double, 2>>& points,
                                                             const std::vector<std::array<int, 2>>& segments) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i][0]) || !std::isfinite(points[i][1]))
      return Error{ErrorCode::bad_number, "point " + std::to_string(i), "a coordinate is not finite", ""};
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> handles(points.size());
  Triangulation::Face_handle near;
  // Neighbours after each other, without the library's random order: the same points give the same triangles.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::vector<std::pair<Kernel::Point_2, std::size_t>> sorted;
  for (const std::size_t i : order) sorted.emplace_back(Kernel::Point_2(points[i][0], points[i][1]), i);
  using Traits =
      CGAL::Spatial_sort_traits_adapter_2<Kernel,
                                          CGAL::First_of_pair_property_map<std::pair<Kernel::Point_2, std::size_t>>>;
  CGAL::spatial_sort(sorted.begin(), sorted.end(), Traits());
  for (const auto& [p, i] : sorted) {
    const std::size_t before = triangulation.number_of_vertices();
    handles[i] = triangulation.insert(p, near);
    if (triangulation.number_of_vertices() == before)
      return Error{ErrorCode::usage, "point " + std::to_string(i), "equals another point",
                   std::to_string(handles[i]->info())};
    handles[i]->info() = static_cast<int>(i);
    near = handles[i]->face();
  }
  const auto key = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  std::map<std::pair<int, int>, int> times;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const auto [a, b] = segments[s];
    const int count = static_cast<int>(points.size());
    if (a < 0 || b < 0 || a >= count || b >= count || a == b)
      return Error{ErrorCode::bad_reference, "segment " + std::to_string(s), "its ends are two of the points",
                   std::to_string(a)};
    if (++times[key(a, b)] > 1) continue;
    try {
      triangulation.insert_constraint(handles[a], handles[b]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      return crossing(s, segments[s]);
    }
  }
  for (std::size_t s = 0; s < segments.size(); ++s)
    if (!triangulation.is_edge(handles[segments[s][0]], handles[segments[s][1]])) return crossing(s, segments[s]);
  std::vector<std::array<int, 3>> out;
  if (triangulation.dimension() < 2) return out;
  // From the outside inwards: how often segments were crossed, odd or even.
  std::unordered_map<Triangulation::Face_handle, bool> inside;
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  inside[open[0]] = false;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    const bool here = inside[face];
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (inside.count(next) > 0) continue;
      bool odd = false;
      if (face->is_constrained(i)) {
        const auto found = times.find(key(face->vertex((i + 1) % 3)->info(), face->vertex((i + 2) % 3)->info()));
        odd = found != times.end() && found->second % 2 == 1;
      }
      inside[next] = here != odd;
      open.push_back(next);
    }
  }
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face)
    if (segments.empty() || inside[face])
      out.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return out;
}

}  // namespace patchproof
