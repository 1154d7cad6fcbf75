// SPDX-License-Identifier: Apache-2.0
#include "trimmed_face.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace patchproof {
namespace {

// The largest power of two that is not above x.
double power_below(double x) { return std::scalbn(1.0, std::ilogb(x)); }

// Factors that make the plane of the parameters even: a step of the same bend in either direction has the same length.
std::array<double, 2> evened(const SurfacePieces& pieces, double chord) {
  const ParameterBox<double> d = pieces.domain();
  const SurfaceHull hull = pieces.bound(d);
  const double length[2] = {d.u_end - d.u_begin, d.v_end - d.v_begin}, speed[2] = {hull.u, hull.v},
               bend[2] = {hull.uu, hull.vv};
  const double whole = std::max(speed[0] * length[0], speed[1] * length[1]);
  std::array<double, 2> out;
  for (int k = 0; k < 2; ++k) {
    const double by_size = speed[k] / whole, by_bend = std::sqrt(bend[k] / (8 * chord));
    const double factor = std::isfinite(by_bend) ? std::max(by_size, by_bend) : by_size;
    out[k] = std::isfinite(factor) && factor > 0 ? power_below(factor) : power_below(1 / length[k]);
  }
  return out;
}

double width(const Interval& x, double from) { return std::max(x.sup() - from, from - x.inf()); }

}  // namespace

void FaceMesh::link(int self, const std::vector<EdgeMesh>& edges) {
  const RoundingGuard guard;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t k = 0; k < edges[e].faces.size(); ++k) {
      if (edges[e].faces[k] != self) continue;
      const ParameterCurve& curve = edges[e].curves[k];
      DirectedUse use{static_cast<int>(e), static_cast<int>(k), edges[e].forward[k]};
      use.begin = middle(curve.at(use.forward ? curve.begin() : curve.end()));
      use.end = middle(curve.at(use.forward ? curve.end() : curve.begin()));
      use.from = middle(pieces.point(use.begin[0], use.begin[1]));
      use.to = middle(pieces.point(use.end[0], use.end[1]));
      use.tolerance = edges[e].tolerance;
      uses.push_back(use);
    }
  const ParameterBox<double> d = pieces.domain();
  if (uses.empty()) {
    fault = "it has no edges";
    return;
  }
  // A tolerance of 0 would not even forgive rounding.
  double size = 0;
  for (const DirectedUse& use : uses)
    for (const double x : use.from.c) size = std::max(size, std::abs(x));
  for (DirectedUse& use : uses) use.tolerance = std::max(use.tolerance, 0x1p-40 * size);
  auto closed = close_loops(uses, {d.u_end - d.u_begin, d.v_end - d.v_begin});
  if (!closed) {
    fault = "its edges do not close";
    return;
  }
  joints = std::move(*closed);
  // A gap is a pole, or something is missing.
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (!joints[k].gap) continue;
    const DirectedUse &use = uses[k], &next = uses[joints[k].next];
    for (const double x : {0.25, 0.5, 0.75}) {
      const auto at = [&](std::size_t c) { return (1 - x) * use.end[c] + x * next.begin[c]; };
      if (!(distance(pieces.point(at(0), at(1)), use.to) <= 2 * (use.tolerance + next.tolerance))) {
        fault = "its edges do not close";
        return;
      }
    }
  }
  gaps.assign(joints.size(), {});
}

double FaceMesh::along(const ParameterCurve& curve, double a, double b) const {
  const Vec<Interval, 2> p = curve.at(a), q = curve.at(b);
  const std::array<double, 2> bend = curve.bend(a, b);
  const ParameterBox<double> box{std::min(p[0].inf(), q[0].inf()) - bend[0], std::max(p[0].sup(), q[0].sup()) + bend[0],
                                 std::min(p[1].inf(), q[1].inf()) - bend[1],
                                 std::max(p[1].sup(), q[1].sup()) + bend[1]};
  const SurfaceHull hull = pieces.bound(box);
  const auto part = [](double speed, double x) { return x > 0 ? speed * x : 0; };
  return hull.chord(std::abs(q[0].sup() - p[0].inf()), std::abs(q[1].sup() - p[1].inf())) + part(hull.u, bend[0]) +
         part(hull.v, bend[1]);
}

// The points and segments of the loops.
void FaceMesh::lay_border(const std::vector<EdgeMesh>& edges) {
  points.clear();
  sides.clear();
  std::map<std::pair<double, double>, int> known;
  const auto point = [&](const Vec<double, 2>& at, int vertex) {
    const auto [found, is_new] = known.try_emplace({at[0] + 0.0, at[1] + 0.0}, static_cast<int>(points.size()));
    if (is_new)
      points.push_back({at, vertex});
    else if (points[found->second].vertex != vertex)
      fault = "its loops touch";
    return found->second;
  };
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const DirectedUse& use = uses[k];
    const EdgeMesh& edge = edges[use.edge];
    const ParameterCurve& curve = edge.curves[use.use];
    const std::size_t n = edge.t.size();
    // A joint without a gap lies where the next use begins.
    const Vec<double, 2> end = joints[k].gap ? use.end : uses[joints[k].next].begin;
    const auto index = [&](std::size_t i) { return use.forward ? i : n - 1 - i; };
    const auto place = [&](std::size_t i) {
      return i == 0 ? use.begin : i + 1 == n ? end : middle(curve.at(edge.t[index(i)]));
    };
    const auto moved = [&](std::size_t i, const Vec<double, 2>& at) {
      const Vec<Interval, 2> true_place = curve.at(edge.t[index(i)]);
      return std::array<double, 2>{width(true_place[0], at[0]), width(true_place[1], at[1])};
    };
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const Vec<double, 2> p = place(i), q = place(i + 1);
      const double s = edge.t[index(i)], t = edge.t[index(i + 1)];
      FaceSide side{point(p, edge.vertices[index(i)]), point(q, edge.vertices[index(i + 1)]), use.edge, 0.5 * (s + t)};
      const auto bend = curve.bend(std::min(s, t), std::max(s, t)), first = moved(i, p), second = moved(i + 1, q);
      for (int c = 0; c < 2; ++c) side.bend[c] = bend[c] + std::max(first[c], second[c]);
      if (side.a != side.b) sides.push_back(side);
    }
    if (!joints[k].gap) continue;
    const Vec<double, 2> from = use.end, to = uses[joints[k].next].begin;
    const int vertex = edge.vertices[use.forward ? n - 1 : 0];
    std::vector<double> cuts = gaps[k];
    cuts.insert(cuts.begin(), 0);
    cuts.push_back(1);
    const auto between = [&](double x) {
      return x == 0   ? from
             : x == 1 ? to
                      : Vec<double, 2>{{(1 - x) * from[0] + x * to[0], (1 - x) * from[1] + x * to[1]}};
    };
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      FaceSide side{point(between(cuts[i]), vertex), point(between(cuts[i + 1]), vertex), -1,
                    0.5 * (cuts[i] + cuts[i + 1]), static_cast<int>(k)};
      if (side.a != side.b) sides.push_back(side);
    }
  }
  for (const Vec<double, 2>& at : inner)
    if (known.try_emplace({at[0], at[1]}, static_cast<int>(points.size())).second) points.push_back({at});
}

void FaceMesh::mesh(const std::vector<EdgeMesh>& edges, const std::vector<Vec<double, 3>>& places,
                    const MeshRequest& request, const Triangulator& triangulator) {
  cuts.clear();
  triangles.clear();
  wanted_.clear();
  wanted_gaps_.clear();
  std::vector<Vec<double, 2>> plane;
  std::vector<std::array<int, 2>> segments;
  {
    const RoundingGuard guard;
    lay_border(edges);
    if (!fault.empty()) return;
    for (FacePoint& p : points) {
      const Vec<Interval, 3> on_surface = pieces.point(p.at[0], p.at[1]);
      p.place = p.vertex >= 0 ? places[p.vertex] : middle(on_surface);
      p.offset = distance(on_surface, p.place);
    }
    const std::array<double, 2> scale = evened(pieces, request.chord);  // powers of two: nothing is rounded
    for (const FacePoint& p : points) plane.push_back({{p.at[0] * scale[0], p.at[1] * scale[1]}});
    for (const FaceSide& s : sides) segments.push_back({s.a, s.b});
  }
  const auto found = triangulator(plane, segments);  // its predicates set their own rounding
  if (!found) {
    fault = fmt::format("its loops cross: {}", found.error().text());
    return;
  }
  const RoundingGuard guard;
  std::vector<std::pair<std::array<int, 2>, int>> border;
  for (std::size_t s = 0; s < sides.size(); ++s)
    border.push_back({{std::min(sides[s].a, sides[s].b), std::max(sides[s].a, sides[s].b)}, static_cast<int>(s)});
  std::sort(border.begin(), border.end());
  for (const std::array<int, 3>& corners : *found) {
    triangles.push_back({corners});
    prove(triangles.back(), request, border);
  }
}

void FaceMesh::prove(FaceTriangle& t, const MeshRequest& request,
                     const std::vector<std::pair<std::array<int, 2>, int>>& border) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ParameterBox<double> box{kInfinity, -kInfinity, kInfinity, -kInfinity};
  double offset = 0;
  bool collapsed = false;
  std::array<int, 3> side_of{-1, -1, -1};  // of the side between corners k and k + 1
  for (int k = 0; k < 3; ++k) {
    const FacePoint &p = points[t.corners[k]], &q = points[t.corners[(k + 1) % 3]];
    box.u_begin = std::min(box.u_begin, p.at[0]);
    box.u_end = std::max(box.u_end, p.at[0]);
    box.v_begin = std::min(box.v_begin, p.at[1]);
    box.v_end = std::max(box.v_end, p.at[1]);
    offset = std::max(offset, p.offset);
    collapsed = collapsed || (p.vertex >= 0 && p.vertex == q.vertex);
    const int a = t.corners[k], b = t.corners[(k + 1) % 3];
    const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
    const auto at = std::lower_bound(border.begin(), border.end(), std::pair(ends, -1));
    if (at != border.end() && at->first == ends) side_of[k] = at->second;
  }
  const double size_u = box.u_end - box.u_begin, size_v = box.v_end - box.v_begin;
  std::array<double, 2> wider{};
  for (const int s : side_of)
    for (int c = 0; c < 2 && s >= 0; ++c) wider[c] = std::max(wider[c], sides[s].bend[c]);
  const SurfaceHull hull =
      pieces.bound({-(wider[0] - box.u_begin), box.u_end + wider[0], -(wider[1] - box.v_begin), box.v_end + wider[1]});
  double lens = 0;
  int lens_side = -1;
  for (const int s : side_of) {
    if (s < 0) continue;
    const auto part = [](double speed, double x) { return x > 0 ? speed * x : 0; };
    const double of_side = part(hull.u, sides[s].bend[0]) + part(hull.v, sides[s].bend[1]);
    if (of_side > lens || lens_side < 0) lens_side = s;
    lens = std::max(lens, of_side);
  }
  const double flat = hull.chord(size_u, size_v);
  t.chord = flat + lens + offset;
  if (!collapsed)
    t.angle = angle_bound(
        hull, normal_of(points[t.corners[0]].place, points[t.corners[1]].place, points[t.corners[2]].place));
  ask(t, hull, flat, side_of, lens, lens_side, request);
}

// What would make the triangle better, when it is not good enough.
void FaceMesh::ask(const FaceTriangle& t, const SurfaceHull& hull, double flat, const std::array<int, 3>& side_of,
                   double lens, int lens_side, const MeshRequest& request) {
  const auto cut_side = [&](int s) {
    const FaceSide& side = sides[s];
    if (side.edge >= 0)
      cuts.emplace_back(side.edge, side.middle);
    else
      wanted_gaps_.emplace_back(side.joint, side.middle);
  };
  const bool chord = !(t.chord <= request.chord), angle = !(t.angle <= request.angle);
  if (chord && lens > flat && lens > 0.25 * request.chord) return cut_side(lens_side);
  const bool for_chord = chord && flat > 0.25 * request.chord;
  if (!for_chord && !angle) return;
  double worst = 0, longest = 0;
  int which = -1;
  const auto part = [](double x, double of) { return of > 0 ? x / of : 0; };
  for (int k = 0; k < 3; ++k) {
    const FacePoint &p = points[t.corners[k]], &q = points[t.corners[(k + 1) % 3]];
    longest = std::max(longest, distance(exactly(p.place), q.place));
    const double du = std::abs(q.at[0] - p.at[0]), dv = std::abs(q.at[1] - p.at[1]);
    const double bend =
        for_chord ? hull.uu * du * du + 2 * hull.uv * du * dv + hull.vv * dv * dv + hull.jump_u * du + hull.jump_v * dv
                  : (part(hull.uu, hull.u) + part(hull.uv, hull.v)) * du +
                        (part(hull.vv, hull.v) + part(hull.uv, hull.u)) * dv;
    if (bend > worst) {
      worst = bend;
      which = k;
    }
  }
  if (which < 0) return;
  // Smaller than this a normal without a bound is one without a limit, or rounding.
  if (!for_chord && longest < 0x1p-4 * request.chord) return;
  if (side_of[which] >= 0) return cut_side(side_of[which]);
  const FacePoint &p = points[t.corners[which]], &q = points[t.corners[(which + 1) % 3]];
  wanted_.push_back({{0.5 * (p.at[0] + q.at[0]), 0.5 * (p.at[1] + q.at[1])}});
}

bool FaceMesh::add_points() {
  std::sort(wanted_.begin(), wanted_.end(), [](const auto& a, const auto& b) { return a.c < b.c; });
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  inner.insert(inner.end(), wanted_.begin(), wanted_.end());
  bool any = !wanted_.empty();
  for (const auto& [joint, at] : wanted_gaps_) {
    auto& list = gaps[joint];
    const auto place = std::lower_bound(list.begin(), list.end(), at);
    if (place != list.end() && *place == at) continue;
    list.insert(place, at);
    any = true;
  }
  wanted_.clear();
  wanted_gaps_.clear();
  return any;
}

}  // namespace patchproof
