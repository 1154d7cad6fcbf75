// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/trimmed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "patchproof/mesh/adaptive_mesh.h"
#include "patchproof/parallel.h"
#include "trimmed_face.h"

namespace patchproof {
namespace {

constexpr int kRounds = 64;

class Builder {
 public:
  Builder(const std::vector<TrimmedFace>& faces, const std::vector<TrimmedEdge>& edges, const MeshRequest& request,
          const Triangulator& triangulator)
      : request_(request), triangulator_(triangulator), edges_(edges.size()), faces_(faces.size()) {
    in_parallel(faces.size(), [&](std::size_t f) {
      faces_[f].label = faces[f].label;
      faces_[f].pieces = SurfacePieces::of(*faces[f].surface, PieceParameters::knots);
    });
    in_parallel(edges.size(), [&](std::size_t e) {
      for (const TrimmedUse& use : edges[e].uses) {
        edges_[e].faces.push_back(use.face);
        edges_[e].forward.push_back(use.forward);
        edges_[e].curves.emplace_back(*use.parameters);
      }
      edges_[e].tolerance = edges[e].tolerance;
    });
  }

  Result<CertifiedMesh> run() {
    link();
    in_parallel(edges_.size(), [&](std::size_t e) { first_samples(edges_[e]); });
    number_vertices();
    for (int round = 0;; ++round) {
      if (auto error = place_vertices()) return *error;
      in_parallel(faces_.size(), [&](std::size_t f) {
        FaceMesh& face = faces_[f];
        if (!face.dirty || !face.fault.empty()) return;
        face.mesh(edges_, places_, request_, triangulator_);
      });
      std::size_t count = 0;
      for (const FaceMesh& face : faces_) count += face.triangles.size();
      if (count > request_.max_triangles)
        return Error{ErrorCode::usage, "", "more triangles would be needed than are allowed; ask for a larger error",
                     fmt::format("{}", request_.max_triangles)};
      if (round == kRounds || !refine()) return collected();
    }
  }

 private:
  void in_parallel(std::size_t count, const std::function<void(std::size_t)>& item) const {
    for_each_item(request_.jobs, count, item);
  }

  // Which ends of edges are one vertex: those that follow each other in the loop of a face.
  void link() {
    in_parallel(faces_.size(), [&](std::size_t f) { faces_[f].link(static_cast<int>(f), edges_); });
    parent_.resize(2 * edges_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<int>(i);
    for (const FaceMesh& face : faces_)
      if (face.fault.empty())
        for (std::size_t k = 0; k < face.uses.size(); ++k) {
          const DirectedUse &a = face.uses[k], &b = face.uses[face.joints[k].next];
          const int x = root(2 * a.edge + (a.forward ? 1 : 0)), y = root(2 * b.edge + (b.forward ? 0 : 1));
          parent_[std::max(x, y)] = std::min(x, y);
        }
  }
  int root(int i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  // Until the parameter curves bend little and the surface along them, too.
  void first_samples(EdgeMesh& edge) const {
    if (edge.curves.empty()) return;
    const RoundingGuard guard;
    std::set<double> t;
    for (const ParameterCurve& c : edge.curves)
      for (const double b : c.breaks()) t.insert(std::clamp(b, edge.curves[0].begin(), edge.curves[0].end()));
    edge.t.assign(t.begin(), t.end());
    for (int depth = 0; depth < 24; ++depth) {
      std::vector<double> finer;
      for (std::size_t i = 0; i + 1 < edge.t.size(); ++i) {
        finer.push_back(edge.t[i]);
        bool fine = true;
        for (std::size_t k = 0; k < edge.curves.size() && fine; ++k)
          fine = faces_[edge.faces[k]].along(edge.curves[k], edge.t[i], edge.t[i + 1]) <= 0.75 * request_.chord;
        if (!fine) finer.push_back(0.5 * (edge.t[i] + edge.t[i + 1]));
      }
      finer.push_back(edge.t.back());
      if (finer.size() == edge.t.size()) return;
      edge.t = std::move(finer);
    }
  }

  void number_vertices() {
    std::map<int, int> ends;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      EdgeMesh& edge = edges_[e];
      edge.vertices.assign(edge.t.size(), -1);
      for (std::size_t i = 0; i < edge.t.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == edge.t.size();
        const int end = is_end ? root(2 * static_cast<int>(e) + (i == 0 ? 0 : 1)) : -1;
        if (is_end && ends.count(end) > 0) {
          edge.vertices[i] = ends[end];
          continue;
        }
        edge.vertices[i] = new_vertex(static_cast<int>(e), edge.t[i]);
        if (is_end) ends[end] = edge.vertices[i];
      }
    }
  }

  int new_vertex(int edge, double t) {
    from_.push_back({edge, t});
    return static_cast<int>(from_.size()) - 1;
  }

  // Of those that have no place yet: the point of the edge's first face.
  std::optional<Error> place_vertices() {
    const RoundingGuard guard;
    for (std::size_t v = places_.size(); v < from_.size(); ++v) {
      const EdgeMesh& edge = edges_[from_[v].edge];
      const Vec<double, 2> p = middle(edge.curves[0].at(from_[v].t));
      places_.push_back(middle(faces_[edge.faces[0]].pieces.point(p[0], p[1])));
      for (const double x : places_.back().c)
        if (!std::isfinite(x))
          return Error{ErrorCode::bad_number, faces_[edge.faces[0]].label, "a vertex is no finite double", ""};
    }
    return std::nullopt;
  }

  bool refine() {
    std::vector<std::set<double>> finer(edges_.size());
    bool any = false;
    for (FaceMesh& face : faces_) {
      face.dirty = face.add_points();
      any = any || face.dirty;
      for (const auto& [edge, t] : face.cuts) finer[edge].insert(t);
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (finer[e].empty()) continue;
      EdgeMesh& edge = edges_[e];
      std::vector<double> t;
      std::vector<int> vertices;
      auto next = finer[e].begin();
      for (std::size_t i = 0; i < edge.t.size(); ++i) {
        for (; next != finer[e].end() && *next < edge.t[i]; ++next) {
          t.push_back(*next);
          vertices.push_back(new_vertex(static_cast<int>(e), *next));
        }
        if (next != finer[e].end() && *next == edge.t[i]) ++next;
        t.push_back(edge.t[i]);
        vertices.push_back(edge.vertices[i]);
      }
      if (t.size() == edge.t.size()) continue;
      edge.t = std::move(t);
      edge.vertices = std::move(vertices);
      any = true;
      for (const int f : edge.faces) faces_[f].dirty = true;
    }
    return any;
  }

  CertifiedMesh collected() const {
    CertifiedMesh out;
    out.vertices = places_;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const FaceMesh& face = faces_[f];
      if (!face.fault.empty()) {
        out.notes.push_back(fmt::format("{}: left out: {}", face.label, face.fault));
        out.chord = std::numeric_limits<double>::infinity();
        out.angle = 180;
        ++out.chord_misses;
        ++out.angle_misses;
        continue;
      }
      std::vector<int> number;
      for (const FacePoint& p : face.points) {
        number.push_back(p.vertex >= 0 ? p.vertex : static_cast<int>(out.vertices.size()));
        if (p.vertex < 0) out.vertices.push_back(p.place);
        out.gap = std::max(out.gap, p.offset);
      }
      std::size_t chord = 0, angle = 0;
      for (const FaceTriangle& t : face.triangles) {
        out.chord = std::max(out.chord, t.chord);
        if (!(t.chord <= request_.chord)) ++chord;
        const std::array<int, 3> v{number[t.corners[0]], number[t.corners[1]], number[t.corners[2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
          ++out.collapsed;
          continue;
        }
        out.angle = std::max(out.angle, t.angle);
        if (!(t.angle <= request_.angle)) ++angle;
        out.triangles.push_back(v);
        out.faces.push_back(static_cast<int>(f));
      }
      for (const FaceSide& s : face.sides)
        if (s.edge >= 0 && edges_[s.edge].faces.size() == 1) out.free.push_back({number[s.a], number[s.b]});
      if (chord > 0)
        out.notes.push_back(fmt::format("{}: the chord error of {} triangles is not proved", face.label, chord));
      if (angle > 0)
        out.notes.push_back(fmt::format("{}: the normal angle of {} triangles is not proved", face.label, angle));
      out.chord_misses += chord;
      out.angle_misses += angle;
    }
    compact(out);
    orient(out);
    return out;
  }

  // Without vertices that no triangle has.
  static void compact(CertifiedMesh& mesh) {
    std::vector<int> number(mesh.vertices.size(), -1);
    std::vector<Vec<double, 3>> kept;
    for (auto& t : mesh.triangles)
      for (int& v : t) {
        if (number[v] < 0) {
          number[v] = static_cast<int>(kept.size());
          kept.push_back(mesh.vertices[v]);
        }
        v = number[v];
      }
    std::vector<std::array<int, 2>> free;
    for (const auto& e : mesh.free)
      if (number[e[0]] >= 0 && number[e[1]] >= 0) free.push_back({number[e[0]], number[e[1]]});
    mesh.free = std::move(free);
    mesh.vertices = std::move(kept);
  }

  struct From {
    int edge;
    double t;
  };

  const MeshRequest request_;
  const Triangulator& triangulator_;
  std::vector<EdgeMesh> edges_;
  std::vector<FaceMesh> faces_;
  std::vector<int> parent_;
  std::vector<From> from_;
  std::vector<Vec<double, 3>> places_;  // of the vertices on edges
};

}  // namespace

Result<CertifiedMesh> trimmed_mesh(const std::vector<TrimmedFace>& faces, const std::vector<TrimmedEdge>& edges,
                                   const MeshRequest& request, const Triangulator& triangulator) {
  if (auto error = check_request(request)) return *error;
  if (faces.empty()) return Error{ErrorCode::wrong_count, "", "there are no faces", "0"};
  return Builder(faces, edges, request, triangulator).run();
}

}  // namespace patchproof
