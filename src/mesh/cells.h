// SPDX-License-Identifier: Apache-2.0
// Cells of a patch that are halved until their triangles are proved, and the vertices on their sides.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "patchproof/mesh/chord_bound.h"

namespace patchproof {

// Where a cut makes the angle hardly smaller, so many times in a row, the normal may have no limit.
constexpr int kStalled = 5;
constexpr double kSmallestCell = 0x1p-18;  // of a span; vertices of joined edges are told apart down to kNearNodes

enum class Cut { none, u, v, both };

// What is measured of a cell's triangles.
struct CellProof {
  double chord = 0, angle = 0;
  std::size_t collapsed = 0, count = 0;
  bool chord_missed = false, angle_missed = false;
  Cut cut = Cut::none;
};

struct Cell {
  double u0, u1, v0, v1;
  double last_angle = 180;                         // of the cell that it was cut from
  int stalled = 0;                                 // how many cuts in a row made the angle hardly smaller
  std::vector<std::array<int, 3>> triangles = {};  // of nodes
  bool proved = false;                             // `proof` is that of these triangles
  CellProof proof = {};
  ParameterBox<double> box() const { return {u0, u1, v0, v1}; }
};

inline Vec<double, 3> middle(const Vec<Interval, 3>& p) {
  Vec<double, 3> out;
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = p[c].is_point() ? p[c].inf() : p[c].inf() + 0.5 * (p[c].sup() - p[c].inf());
  return out;
}

inline Vec<Interval, 3> exactly(const Vec<double, 3>& p) { return {{Interval(p[0]), Interval(p[1]), Interval(p[2])}}; }

inline double distance(const Vec<Interval, 3>& p, const Vec<double, 3>& q) {
  const Vec<Interval, 3> d = p - exactly(q);
  return sqrt(square(d[0]) + square(d[1]) + square(d[2])).sup();
}

// Interval refuses infinities and NaN; a hull may hold both.
inline Vec<Interval, 3> normal_of(const Vec<double, 3>& a, const Vec<double, 3>& b, const Vec<double, 3>& c) {
  return cross(exactly(b) - exactly(a), exactly(c) - exactly(a));
}

inline Cut better_cut(double along_u, double along_v) {
  constexpr double kMore = 3;
  return along_u > kMore * along_v ? Cut::u : along_v > kMore * along_u ? Cut::v : Cut::both;
}

inline Cut chord_cut(const SurfaceHull& h, const Cell& c) {
  const double du = c.u1 - c.u0, dv = c.v1 - c.v0;
  return better_cut(h.uu * du * du, h.vv * dv * dv);
}

// Where the normal turns: S_u by S_uu along u, S_v by S_uv.
inline Cut angle_cut(const SurfaceHull& h, const Cell& c) {
  const double du = c.u1 - c.u0, dv = c.v1 - c.v0;
  const auto part = [](double x, double of) { return of > 0 ? x / of : 0; };
  return better_cut((part(h.uu, h.u) + part(h.uv, h.v)) * du, (part(h.vv, h.v) + part(h.uv, h.u)) * dv);
}

inline Cut possible(Cut cut, const Cell& c) {
  const bool u = c.u1 - c.u0 > kSmallestCell, v = c.v1 - c.v0 > kSmallestCell;
  if (cut == Cut::u || cut == Cut::both) cut = u ? cut : cut == Cut::both && v ? Cut::v : Cut::none;
  if (cut == Cut::v || cut == Cut::both) cut = v ? cut : cut == Cut::both && u ? Cut::u : Cut::none;
  return cut;
}

inline void add_parts(Cell& c, Cut cut, std::vector<Cell>& out) {
  if (cut == Cut::none) return out.push_back(std::move(c));
  const double angle = c.proof.angle;
  const int stalled = angle > 0.9 * c.last_angle ? c.stalled + 1 : 0;
  const double u = cut == Cut::v ? c.u1 : 0.5 * (c.u0 + c.u1), v = cut == Cut::u ? c.v1 : 0.5 * (c.v0 + c.v1);
  out.push_back({c.u0, u, c.v0, v, angle, stalled});
  if (cut != Cut::v) out.push_back({u, c.u1, c.v0, v, angle, stalled});
  if (cut != Cut::u) out.push_back({c.u0, u, v, c.v1, angle, stalled});
  if (cut == Cut::both) out.push_back({u, c.u1, v, c.v1, angle, stalled});
}

// The nodes on lines u = const and v = const of a patch.
class Lines {
 public:
  void add(double u, double v, int node) {
    u_.push_back({u, v, node});
    v_.push_back({v, u, node});
  }
  void sort() {
    for (auto* list : {&u_, &v_})
      std::sort(list->begin(), list->end(),
                [](const On& a, const On& b) { return std::pair(a.line, a.at) < std::pair(b.line, b.at); });
  }
  // Those strictly between, in order.
  std::vector<int> between(Direction constant, double line, double begin, double end) const {
    const auto& list = constant == Direction::u ? u_ : v_;
    std::vector<int> out;
    const bool back = end < begin;
    if (back) std::swap(begin, end);
    auto it =
        std::upper_bound(list.begin(), list.end(), std::pair(line, begin),
                         [](const std::pair<double, double>& x, const On& o) { return x < std::pair(o.line, o.at); });
    for (; it != list.end() && it->line == line && it->at < end; ++it) out.push_back(it->node);
    if (back) std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  struct On {
    double line, at;
    int node;
  };
  std::vector<On> u_, v_;
};

}  // namespace patchproof
