// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/watertight.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace patchproof {
namespace {

// The first vertex at the same place, for each vertex.
std::vector<int> welded(const std::vector<Vec<double, 3>>& vertices) {
  std::vector<int> order(vertices.size()), out(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&](int a, int b) { return vertices[a].c < vertices[b].c; };
  std::stable_sort(order.begin(), order.end(), less);
  for (std::size_t k = 0; k < order.size(); ++k)
    out[order[k]] = k > 0 && !less(order[k - 1], order[k]) ? out[order[k - 1]] : order[k];
  return out;
}

struct Use {
  int low, high;
  bool upward;
  std::size_t triangle;
  auto key() const { return std::pair(low, high); }
};

// The sides of the triangles, equal ones together.
std::vector<Use> sides(const CertifiedMesh& mesh, const std::vector<int>& at) {
  std::vector<Use> uses;
  uses.reserve(mesh.triangles.size() * 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = at[mesh.triangles[i][k]], b = at[mesh.triangles[i][(k + 1) % 3]];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), a < b, i});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.key() < b.key(); });
  return uses;
}

}  // namespace

Watertight check_watertight(const CertifiedMesh& mesh) {
  const std::vector<int> at = welded(mesh.vertices);
  const std::vector<Use> uses = sides(mesh, at);
  std::vector<std::pair<int, int>> free;
  for (const auto& e : mesh.free) free.emplace_back(std::minmax(at[e[0]], at[e[1]]));
  std::sort(free.begin(), free.end());
  Watertight out;
  for (std::size_t k = 0; k < uses.size();) {
    std::size_t end = k;
    int upward = 0;
    for (; end < uses.size() && uses[end].key() == uses[k].key(); ++end) upward += uses[end].upward ? 1 : 0;
    ++out.edges;
    const std::size_t count = end - k;
    if (count == 1)
      ++(std::binary_search(free.begin(), free.end(), uses[k].key()) ? out.free : out.cracks);
    else if (count > 2)
      ++out.branching;
    else if (upward != 1)
      out.oriented = false;
    k = end;
  }
  return out;
}

void orient(CertifiedMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const std::vector<Use> uses = sides(mesh, welded(mesh.vertices));
  const int count = *std::max_element(mesh.faces.begin(), mesh.faces.end()) + 1;
  std::vector<std::vector<std::pair<int, bool>>> neighbours(count);  // face, whether it runs the same way
  for (std::size_t k = 0; k + 1 < uses.size(); ++k) {
    if (uses[k].key() != uses[k + 1].key() || (k > 0 && uses[k - 1].key() == uses[k].key()) ||
        (k + 2 < uses.size() && uses[k + 2].key() == uses[k].key()))
      continue;
    const int a = mesh.faces[uses[k].triangle], b = mesh.faces[uses[k + 1].triangle];
    if (a == b) continue;
    neighbours[a].emplace_back(b, uses[k].upward == uses[k + 1].upward);
    neighbours[b].emplace_back(a, uses[k].upward == uses[k + 1].upward);
  }
  std::vector<int> part(count, -1);
  std::vector<bool> turned(count);
  int parts = 0;
  for (int f = 0; f < count; ++f) {
    if (part[f] >= 0) continue;
    std::vector<int> open{f};
    part[f] = parts;
    while (!open.empty()) {
      const int a = open.back();
      open.pop_back();
      for (const auto& [b, same] : neighbours[a])
        if (part[b] < 0) {
          part[b] = parts;
          turned[b] = turned[a] != same;
          open.push_back(b);
        }
    }
    ++parts;
  }
  std::vector<double> volumes(parts);
  const Vec<double, 3> origin = mesh.vertices[mesh.triangles[0][0]];
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const double v =
        dot(mesh.vertices[t[0]] - origin, cross(mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin));
    volumes[part[mesh.faces[i]]] += turned[mesh.faces[i]] ? -v : v;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int f = mesh.faces[i];
    if (turned[f] != (volumes[part[f]] < 0)) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
}

}  // namespace patchproof
