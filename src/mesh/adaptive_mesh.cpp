// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/adaptive_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "cells.h"
#include "patchproof/deadline.h"
#include "patchproof/parallel.h"
#include "patchproof/patch/patch_knots.h"
#include "shared_edges.h"

namespace patchproof {
namespace {

template <ExactField T>
class Mesher {
 public:
  Mesher(const std::vector<const BsplinePatch<T, 4>*>& patches, const std::vector<Join<T>>& joins,
         const std::vector<CollapsedEdge>& collapsed, const MeshRequest& request, CellMethod method)
      : request_(request),
        method_(method),
        shared_(patches, joins, collapsed),
        pieces_(patches.size()),
        cells_(patches.size()) {
    in_parallel(patches.size(), [&](std::size_t k) {
      pieces_[k] = SurfacePieces::of(*patches[k], PieceParameters::spans);
      for (int i = 0; i < pieces_[k].count(Direction::u); ++i)
        for (int j = 0; j < pieces_[k].count(Direction::v); ++j)
          cells_[k].push_back({double(i), i + 1.0, double(j), j + 1.0});
    });
  }

  Result<CertifiedMesh> run() {
    in_parallel(cells_.size(), [&](std::size_t k) { refine(k); });
    for (;;) {
      std::size_t count = 0;
      for (const auto& cells : cells_) count += cells.size();
      if (2 * count > request_.max_triangles) return too_many();
      triangulate();
      if (auto error = place_nodes()) return *error;
      in_parallel(cells_.size(), [&](std::size_t k) {
        const RoundingGuard guard;
        for (Cell& c : cells_[k]) {
          check_deadline();
          if (!c.proved) prove(k, c);
        }
      });
      bool again = false;
      for (std::size_t k = 0; k < cells_.size(); ++k) again = cut(k) || again;
      if (!again) return collected();
    }
  }

 private:
  Error too_many() const {
    return {ErrorCode::usage, "", "more triangles would be needed than are allowed; ask for a larger error",
            fmt::format("{}", request_.max_triangles)};
  }

  void in_parallel(std::size_t count, const std::function<void(std::size_t)>& item) const {
    for_each_item(request_.jobs, count, item);
  }

  // Cuts the cells of a patch until their own bounds are small enough, before neighbours are looked at.
  void refine(std::size_t k) {
    const RoundingGuard guard;
    do {
      for (Cell& c : cells_[k]) {
        check_deadline();
        if (c.proved) continue;
        const SurfaceHull hull = pieces_[k].bound(c.box());
        c.proof.chord = hull.chord(c.u1 - c.u0, c.v1 - c.v0);
        c.proof.angle = request_.angle < 180 ? own_angle(k, c, hull) : 0;
        if (!(c.proof.chord <= request_.chord))
          c.proof.cut = possible(chord_cut(hull, c), c);
        else if (!(c.proof.angle <= request_.angle) && c.stalled < kStalled)
          c.proof.cut = possible(angle_cut(hull, c), c);
        c.proved = true;
      }
    } while (cut(k) && 2 * cells_[k].size() <= request_.max_triangles);
    for (Cell& c : cells_[k]) c.proved = false;
  }

  // With the triangles that the cell has when nothing hangs on its sides.
  double own_angle(std::size_t k, const Cell& c, const SurfaceHull& hull) const {
    const auto at = [&](double u, double v) { return middle(pieces_[k].point(u, v)); };
    const Vec<double, 3> a = at(c.u0, c.v0), b = at(c.u1, c.v0), d = at(c.u1, c.v1), e = at(c.u0, c.v1);
    double out = 0;
    if (!(a == b) && !(b == d) && !(d == a)) out = std::max(out, angle_bound(hull, normal_of(a, b, d)));
    if (!(a == d) && !(d == e) && !(e == a)) out = std::max(out, angle_bound(hull, normal_of(a, d, e)));
    return out;
  }

  bool cut(std::size_t k) {
    std::size_t in_u = 0, in_v = 0;
    for (const Cell& c : cells_[k]) {
      in_u += c.proof.cut == Cut::u || c.proof.cut == Cut::both;
      in_v += c.proof.cut == Cut::v || c.proof.cut == Cut::both;
    }
    if (in_u + in_v == 0) return false;
    const Cut all = better_cut(static_cast<double>(in_u), static_cast<double>(in_v));
    std::vector<Cell> out;
    for (Cell& c : cells_[k]) add_parts(c, method_ == CellMethod::regular ? all : c.proof.cut, out);
    cells_[k] = std::move(out);
    return true;
  }

  void triangulate();
  std::optional<Error> place_nodes();
  void prove(std::size_t k, Cell& cell) const;
  CertifiedMesh collected() const;

  const MeshRequest request_;
  const CellMethod method_;
  SharedEdges<T> shared_;
  std::vector<SurfacePieces> pieces_;
  std::vector<std::vector<Cell>> cells_;
  std::vector<int> vertices_;                 // of each node
  std::vector<Vec<Interval, 3>> enclosures_;  // of each node, on its patch
  std::vector<Vec<double, 3>> places_;        // of each node: that of its vertex
  std::vector<double> offsets_;
};

template <ExactField T>
void Mesher<T>::triangulate() {
  for (std::size_t k = 0; k < cells_.size(); ++k)
    for (const Cell& c : cells_[k]) {
      check_deadline();
      for (const double u : {c.u0, c.u1})
        for (const double v : {c.v0, c.v1}) shared_.node(static_cast<int>(k), u, v);
    }
  shared_.spread();
  std::vector<Lines> lines(cells_.size());
  for (std::size_t n = 0; n < shared_.nodes().size(); ++n) {
    const MeshNode& node = shared_.nodes()[n];
    lines[node.patch].add(node.u, node.v, static_cast<int>(n));
  }
  for (Lines& l : lines) l.sort();
  for (std::size_t k = 0; k < cells_.size(); ++k)
    for (Cell& c : cells_[k]) {
      const auto corner = [&](double u, double v) { return shared_.node(static_cast<int>(k), u, v); };
      std::vector<int> ring;
      std::size_t hanging = 0;
      const auto side = [&](int first, Direction constant, double line, double begin, double end) {
        ring.push_back(first);
        const auto inner = lines[k].between(constant, line, begin, end);
        ring.insert(ring.end(), inner.begin(), inner.end());
        if (!inner.empty()) hanging = ring.size() - 1;
      };
      side(corner(c.u0, c.v0), Direction::v, c.v0, c.u0, c.u1);
      side(corner(c.u1, c.v0), Direction::u, c.u1, c.v0, c.v1);
      side(corner(c.u1, c.v1), Direction::v, c.v1, c.u1, c.u0);
      side(corner(c.u0, c.v1), Direction::u, c.u0, c.v1, c.v0);
      std::vector<std::array<int, 3>> out;
      const std::size_t n = ring.size();
      if (n > 5) {
        const int centre = shared_.node(static_cast<int>(k), 0.5 * (c.u0 + c.u1), 0.5 * (c.v0 + c.v1));
        for (std::size_t i = 0; i < n; ++i) out.push_back({ring[i], ring[(i + 1) % n], centre});
      } else {
        for (std::size_t i = 1; i + 1 < n; ++i)
          out.push_back({ring[hanging], ring[(hanging + i) % n], ring[(hanging + i + 1) % n]});
      }
      if (out == c.triangles) continue;
      c.triangles = std::move(out);
      c.proved = false;
    }
}

template <ExactField T>
std::optional<Error> Mesher<T>::place_nodes() {
  const auto& nodes = shared_.nodes();
  const std::size_t done = enclosures_.size();
  enclosures_.resize(nodes.size());
  places_.resize(nodes.size());
  offsets_.resize(nodes.size());
  constexpr std::size_t kTogether = 256;
  const auto chunks = [&](std::size_t from, auto item) {
    in_parallel((nodes.size() - from + kTogether - 1) / kTogether, [&](std::size_t chunk) {
      const RoundingGuard guard;
      const std::size_t begin = from + chunk * kTogether;
      for (std::size_t n = begin; n < std::min(begin + kTogether, nodes.size()); ++n) item(n);
    });
  };
  chunks(done, [&](std::size_t n) { enclosures_[n] = pieces_[nodes[n].patch].point(nodes[n].u, nodes[n].v); });
  std::vector<char> moved(nodes.size());
  vertices_.resize(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) vertices_[n] = shared_.vertex_of(static_cast<int>(n));
  chunks(0, [&](std::size_t n) {
    const Vec<double, 3> place = middle(enclosures_[vertices_[n]]);
    moved[n] = !(place == places_[n]);
    places_[n] = place;
  });
  for (auto& cells : cells_)
    for (Cell& c : cells)
      for (const auto& t : c.triangles) c.proved = c.proved && !moved[t[0]] && !moved[t[1]] && !moved[t[2]];
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const double x : places_[n].c)
      if (!std::isfinite(x))
        return Error{ErrorCode::bad_number, fmt::format("patch {}", nodes[n].patch), "a vertex is no finite double",
                     fmt::format("{}, {}", nodes[n].u, nodes[n].v)};
  chunks(0, [&](std::size_t n) { offsets_[n] = distance(enclosures_[n], places_[n]); });
  return std::nullopt;
}

template <ExactField T>
void Mesher<T>::prove(std::size_t k, Cell& cell) const {
  CellProof out;
  const SurfaceHull hull = pieces_[k].bound(cell.box());
  const double flat = hull.chord(cell.u1 - cell.u0, cell.v1 - cell.v0);
  double offset = 0, size = 0;
  for (const auto& t : cell.triangles) {
    for (const int n : t) {
      offset = std::max(offset, offsets_[n]);
      size = std::max(size, distance(exactly(places_[n]), places_[cell.triangles[0][0]]));
    }
    if (vertices_[t[0]] == vertices_[t[1]] || vertices_[t[1]] == vertices_[t[2]] ||
        vertices_[t[2]] == vertices_[t[0]]) {
      ++out.collapsed;
      continue;
    }
    ++out.count;
    out.angle = std::max(out.angle, angle_bound(hull, normal_of(places_[t[0]], places_[t[1]], places_[t[2]])));
  }
  out.chord = flat + offset;
  out.chord_missed = !(out.chord <= request_.chord);
  out.angle_missed = !(out.angle <= request_.angle);
  if (out.chord_missed && flat > 0.25 * request_.chord)
    out.cut = possible(chord_cut(hull, cell), cell);
  else if (out.angle_missed && (size > request_.chord || cell.stalled < kStalled))
    out.cut = possible(angle_cut(hull, cell), cell);
  cell.proof = out;
  cell.proved = true;
}

template <ExactField T>
CertifiedMesh Mesher<T>::collected() const {
  CertifiedMesh out;
  std::vector<int> number(places_.size(), -1);
  const auto vertex = [&](int node) {
    int& n = number[vertices_[node]];
    if (n < 0) {
      n = static_cast<int>(out.vertices.size());
      out.vertices.push_back(places_[node]);
    }
    return n;
  };
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    std::size_t chord = 0, angle = 0;
    for (const Cell& cell : cells_[k]) {
      const CellProof& proof = cell.proof;
      out.chord = std::max(out.chord, proof.chord);
      out.angle = std::max(out.angle, proof.angle);
      out.collapsed += proof.collapsed;
      if (proof.chord_missed) chord += proof.count;
      if (proof.angle_missed) angle += proof.count;
      for (const auto& t : cell.triangles) {
        const std::array<int, 3> v{vertex(t[0]), vertex(t[1]), vertex(t[2])};
        for (const int n : t) out.gap = std::max(out.gap, offsets_[n]);
        // Also of a triangle that is left out at a pole: its neighbour ends there.
        for (int i = 0; i < 3; ++i)
          if (v[i] != v[(i + 1) % 3] && shared_.is_free(t[i], t[(i + 1) % 3]))
            out.free.push_back({v[i], v[(i + 1) % 3]});
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        out.triangles.push_back(v);
        out.faces.push_back(static_cast<int>(k));
      }
    }
    if (chord > 0)
      out.notes.push_back(fmt::format("patch {}: the chord error of {} triangles is not proved", k, chord));
    if (angle > 0)
      out.notes.push_back(fmt::format("patch {}: the normal angle of {} triangles is not proved", k, angle));
    out.chord_misses += chord;
    out.angle_misses += angle;
  }
  orient(out);
  return out;
}

}  // namespace

std::optional<Error> check_request(const MeshRequest& request) {
  if (!(request.chord > 0) || !std::isfinite(request.chord))
    return Error{ErrorCode::usage, "chord", "the error asked for is a positive number",
                 fmt::format("{}", request.chord)};
  if (!(request.angle > 0 && request.angle <= 180))
    return Error{ErrorCode::usage, "angle", "the angle asked for is above 0 and at most 180 degrees",
                 fmt::format("{}", request.angle)};
  return std::nullopt;
}

template <ExactField T>
Result<CertifiedMesh> adaptive_mesh(const std::vector<const BsplinePatch<T, 4>*>& patches,
                                    const std::vector<Join<T>>& joins, const std::vector<CollapsedEdge>& collapsed,
                                    const MeshRequest& request, CellMethod method) {
  if (auto error = check_request(request)) return *error;
  return Mesher<T>(patches, joins, collapsed, request, method).run();
}

template <ExactField T>
std::vector<BsplinePatch<T, 4>> split_torn(const BsplinePatch<T, 4>& patch) {
  std::vector<BsplinePatch<T, 4>> out{patch};
  for (const Direction d : {Direction::u, Direction::v}) {
    std::vector<T> at;
    for (const T& t : patch.knots(d).breaks())
      if (patch.knots(d).domain_begin() < t && t < patch.knots(d).domain_end() &&
          patch.knots(d).multiplicity(t) > patch.degree(d))
        at.push_back(t);
    for (const T& t : at) {
      std::vector<BsplinePatch<T, 4>> parts;
      for (const auto& part : out) {
        if (!(part.knots(d).domain_begin() < t && t < part.knots(d).domain_end())) {
          parts.push_back(part);
          continue;
        }
        auto halves = split(part, d, t);
        parts.push_back(std::move(halves.first));
        parts.push_back(std::move(halves.second));
      }
      out = std::move(parts);
    }
  }
  return out;
}

template Result<CertifiedMesh> adaptive_mesh<Rational>(const std::vector<const BsplinePatch<Rational, 4>*>&,
                                                       const std::vector<Join<Rational>>&,
                                                       const std::vector<CollapsedEdge>&, const MeshRequest&,
                                                       CellMethod);
template Result<CertifiedMesh> adaptive_mesh<Quadratic>(const std::vector<const BsplinePatch<Quadratic, 4>*>&,
                                                        const std::vector<Join<Quadratic>>&,
                                                        const std::vector<CollapsedEdge>&, const MeshRequest&,
                                                        CellMethod);
template std::vector<BsplinePatch<Rational, 4>> split_torn<Rational>(const BsplinePatch<Rational, 4>&);
template std::vector<BsplinePatch<Quadratic, 4>> split_torn<Quadratic>(const BsplinePatch<Quadratic, 4>&);

}  // namespace patchproof
