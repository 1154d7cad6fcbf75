// SPDX-License-Identifier: Apache-2.0
// Curve meshes for tests: straight lines of the plane lifted to the graph of z = f(x, y), f of second degree. Every edge
// between two faces is smooth, and points, derivatives and normals are known without any curve: a line's parameter is linear.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "patchproof/mesh/curve_mesh.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {

using Point3 = Vec<Rational, 3>;
using Place2 = std::array<Rational, 2>;

class GraphMesh {
 public:
  CurveMesh mesh;

  // f = x² f0 + x y f1 + y² f2
  explicit GraphMesh(std::array<Rational, 3> f = {1, "-1/2"_q, "3/4"_q}) : f_(std::move(f)) {}

  Point3 lifted(const Place2& p) const {
    return {{p[0], p[1], f_[0] * p[0] * p[0] + f_[1] * p[0] * p[1] + f_[2] * p[1] * p[1]}};
  }
  // The derivative of the graph at p in a direction of the plane.
  Point3 lifted(const Place2& p, const Place2& d) const {
    return {{d[0], d[1], f_[0] * 2 * p[0] * d[0] + f_[1] * (p[0] * d[1] + p[1] * d[0]) + f_[2] * 2 * p[1] * d[1]}};
  }
  Place2 at(const MeshNode& node) const {
    if (node.kind == MeshNode::Kind::vertex) return places_[node.index];
    return at(mesh.t_nodes[node.index].edge, mesh.t_nodes[node.index].parameter);
  }
  Place2 at(int edge, const Rational& t) const {
    const Place2 a = at(mesh.edges[edge].begin), b = at(mesh.edges[edge].end);
    return {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]};
  }
  // Of a side, by its own parameter over [0, 1].
  Place2 direction(const FaceSide& s) const {
    const Place2 a = at(s.edge, s.from), b = at(s.edge, s.to);
    return {b[0] - a[0], b[1] - a[1]};
  }

  MeshNode vertex(const Rational& x, const Rational& y) {
    places_.push_back({x, y});
    mesh.vertices.push_back({"V" + std::to_string(mesh.vertices.size()), lifted(places_.back())});
    return {MeshNode::Kind::vertex, static_cast<int>(mesh.vertices.size()) - 1};
  }
  MeshNode t_node(int edge, const Rational& t) {
    mesh.t_nodes.push_back({"T" + std::to_string(mesh.t_nodes.size()), edge, t});
    return {MeshNode::Kind::t_node, static_cast<int>(mesh.t_nodes.size()) - 1};
  }
  // With these inner knots, and the weight going from w0 to w1 linearly.
  int edge(const MeshNode& begin, const MeshNode& end, const std::vector<Rational>& inner = {}, const Rational& w0 = 1,
           const Rational& w1 = 1) {
    const Place2 a = at(begin), b = at(end);
    const Point3 p = lifted(a), q = lifted(b), d = lifted(a, {b[0] - a[0], b[1] - a[1]});
    const std::vector<Point3> parabola{p, p + "1/2"_q * d, q};
    std::vector<Vec<Rational, 4>> bezier;  // of w (x, y, z, 1)
    std::vector<Vec<Rational, 4>> low;
    for (const Point3& x : parabola) low.push_back({{x[0], x[1], x[2], Rational(1)}});
    bezier = product(std::vector<Rational>{w0, w1}, low);
    MeshEdge e;
    e.id = "E" + std::to_string(mesh.edges.size());
    e.begin = begin;
    e.end = end;
    e.knots.assign(4, 0);
    e.knots.insert(e.knots.end(), inner.begin(), inner.end());
    e.knots.insert(e.knots.end(), 4, 1);
    for (std::size_t i = 0; i + 4 < e.knots.size(); ++i) {
      const Vec<Rational, 4> h = blossom(bezier, {e.knots[i + 1], e.knots[i + 2], e.knots[i + 3]});
      e.points.push_back({{h[0] / h[3], h[1] / h[3], h[2] / h[3]}});
      if (w0 != 1 || w1 != 1) e.weights.push_back(h[3]);
    }
    mesh.edges.push_back(std::move(e));
    return static_cast<int>(mesh.edges.size()) - 1;
  }
  void face(std::vector<FaceSide> sides) {
    mesh.faces.push_back({"F" + std::to_string(mesh.faces.size()), std::move(sides)});
  }

 private:
  std::array<Rational, 3> f_;
  std::vector<Place2> places_;
};

struct TwoColumnsOptions {
  std::array<Rational, 3> f{1, "-1/2"_q, "3/4"_q};  // of the graph
  std::vector<Rational> inner = {};                 // knots of the shared edge
  Rational w0 = 1, w1 = 1;                          // its weights at the ends
  std::vector<Rational> to_left =
      {};  // T-nodes of the shared edge, increasing, with as many faces to its left as there are gaps
  std::vector<Rational> to_right = {};  // likewise
};

// Two columns of faces beside edge 0, which runs upwards from (2, 0) to (3, 4); the faces to its left come first, upwards.
inline GraphMesh two_columns(const TwoColumnsOptions& options = {}) {
  GraphMesh g(options.f);
  const MeshNode low = g.vertex(2, 0), high = g.vertex(3, 4), left_low = g.vertex(0, 0), left_high = g.vertex(0, 5),
                 right_low = g.vertex(5, 1), right_high = g.vertex(6, 4);
  const int shared = g.edge(low, high, options.inner, options.w0, options.w1);
  const auto column = [&](bool left, const MeshNode& outer_low, const MeshNode& outer_high,
                          const std::vector<Rational>& at) {
    const int bottom = g.edge(low, outer_low), top = g.edge(high, outer_high), outer = g.edge(outer_low, outer_high);
    int below = bottom;
    Rational from(0), outer_from(0);
    for (std::size_t i = 0; i <= at.size(); ++i) {
      const Rational to = i < at.size() ? at[i] : Rational(1),
                     outer_to = Rational(static_cast<int>(i + 1), static_cast<int>(at.size() + 1));
      int above = top;
      if (i < at.size()) {
        MeshNode inside = g.t_node(shared, to);
        // A node that both columns share is one T-node.
        for (std::size_t k = 0; k + 1 < g.mesh.t_nodes.size(); ++k)
          if (g.mesh.t_nodes[k].edge == shared && g.mesh.t_nodes[k].parameter == to) {
            g.mesh.t_nodes.pop_back();
            inside.index = static_cast<int>(k);
            break;
          }
        above = g.edge(inside, g.t_node(outer, outer_to));
      }
      if (left)
        g.face({{below, 1, 0}, {shared, from, to}, {above, 0, 1}, {outer, outer_to, outer_from}});
      else
        g.face({{below, 0, 1}, {outer, outer_from, outer_to}, {above, 1, 0}, {shared, to, from}});
      below = above;
      from = to;
      outer_from = outer_to;
    }
  };
  column(true, left_low, left_high, options.to_left);
  column(false, right_low, right_high, options.to_right);
  return g;
}

}  // namespace patchproof::test
