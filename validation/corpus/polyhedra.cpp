// SPDX-License-Identifier: Apache-2.0
#include "validation/corpus/polyhedra.h"

#include <cmath>
#include <map>
#include <utility>

namespace patchproof::validation {

SolidFaces regular_icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

namespace {

// The neighbours of each vertex, counter-clockwise.
std::vector<std::vector<int>> neighbours(const SolidFaces& solid) {
  std::vector<std::map<int, int>> next(solid.points.size());  // of a vertex: the neighbour after this one
  for (const std::vector<int>& face : solid.faces)
    for (std::size_t i = 0; i < face.size(); ++i)
      next[face[i]][face[(i + 1) % face.size()]] = face[(i + face.size() - 1) % face.size()];
  std::vector<std::vector<int>> out;
  for (const std::map<int, int>& of_vertex : next) {
    out.push_back({of_vertex.begin()->first});
    while (out.back().size() < of_vertex.size()) out.back().push_back(of_vertex.at(out.back().back()));
  }
  return out;
}

// A new vertex for each key, where it says.
template <class Key>
class NewVertices {
 public:
  explicit NewVertices(SolidFaces& solid) : solid_(solid) {}
  // On the way from a to b.
  int operator()(const Key& key, const std::array<double, 3>& a, const std::array<double, 3>& b) {
    const auto [found, is_new] = index_.emplace(key, static_cast<int>(solid_.points.size()));
    if (is_new) solid_.points.push_back({a[0] + (b[0] - a[0]) / 3, a[1] + (b[1] - a[1]) / 3, a[2] + (b[2] - a[2]) / 3});
    return found->second;
  }

 private:
  SolidFaces& solid_;
  std::map<Key, int> index_;
};

}  // namespace

SolidFaces truncated(const SolidFaces& old) {
  SolidFaces out;
  NewVertices<std::pair<int, int>> on_edge(out);
  const auto at = [&](int a, int b) { return on_edge({a, b}, old.points[a], old.points[b]); };
  for (const std::vector<int>& face : old.faces) {
    out.faces.emplace_back();
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      out.faces.back().insert(out.faces.back().end(), {at(a, b), at(b, a)});
    }
  }
  const auto around = neighbours(old);
  for (int a = 0; a < static_cast<int>(around.size()); ++a) {
    out.faces.emplace_back();
    for (const int b : around[a]) out.faces.back().push_back(at(a, b));
  }
  return out;
}

SolidFaces expanded(const SolidFaces& old) {
  SolidFaces out;
  NewVertices<std::pair<int, int>> in_face(out);  // by face and corner
  std::map<std::pair<int, int>, int> face_at;     // to the left of an edge
  const auto at = [&](int f, int a) {
    std::array<double, 3> middle{};
    for (const int v : old.faces[f])
      for (std::size_t c = 0; c < 3; ++c) middle[c] += old.points[v][c] / static_cast<double>(old.faces[f].size());
    return in_face({f, a}, old.points[a], middle);
  };
  for (int f = 0; f < static_cast<int>(old.faces.size()); ++f) {
    const std::vector<int>& face = old.faces[f];
    out.faces.emplace_back();
    for (std::size_t i = 0; i < face.size(); ++i) {
      face_at[{face[i], face[(i + 1) % face.size()]}] = f;
      out.faces.back().push_back(at(f, face[i]));
    }
  }
  for (const auto& [edge, left] : face_at) {
    const auto [a, b] = edge;
    const int right = face_at.at({b, a});
    if (a < b) out.faces.push_back({at(left, b), at(left, a), at(right, a), at(right, b)});
  }
  const auto around = neighbours(old);
  for (int a = 0; a < static_cast<int>(around.size()); ++a) {
    out.faces.emplace_back();
    for (const int b : around[a]) out.faces.back().push_back(at(face_at.at({a, b}), a));
  }
  return out;
}

}  // namespace patchproof::validation
