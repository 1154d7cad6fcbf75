// SPDX-License-Identifier: Apache-2.0
#include "validation/corpus/curve_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "patchproof/contract.h"
#include "patchproof/mesh/tangent_plane.h"
#include "patchproof/spline/homogeneous.h"
#include "validation/corpus/polyhedra.h"
#include "validation/corpus/random.h"

namespace patchproof::validation {
namespace {

using Point = Vec<Rational, 3>;

// The nearest multiple of 2^-bits.
Rational dyadic(double x, int bits) { return from_double(std::ldexp(std::floor(std::ldexp(x, bits) + 0.5), -bits)); }
double length(const Point& v) { return std::sqrt(nearest_double(dot(v, v))); }

// The blossom of a cubic with these Bézier points: affine in each argument, and symmetric.
Point blossom(std::array<Point, 4> b, const Rational* t) {
  for (int level = 3; level > 0; --level)
    for (int i = 0; i < level; ++i) b[i] = Rational(1 - t[level - 1]) * b[i] + t[level - 1] * b[i + 1];
  return b[0];
}

Piecewise<Rational, 4> curve_of(const MeshEdge& edge) {
  const std::vector<Rational> weights =
      edge.weights.empty() ? std::vector<Rational>(edge.points.size(), 1) : edge.weights;
  return extract_bezier(BsplineCurve<Rational, 4>(KnotVector<Rational>::make_unchecked(3, edge.knots),
                                                  to_homogeneous(edge.points, weights)));
}

// Vertices on a sphere, edges and faces between them.
class Ball {
 public:
  // radius, and how far from the sphere and from the direction given points may lie.
  Ball(double radius, std::uint64_t seed, const ClosedMeshOptions& options)
      : radius_(radius), random_(seed), options_(options) {}

  CurveMesh finish() {
    add_control_vectors();
    return std::move(out_);
  }

  int add_vertex(std::array<double, 3> c) {
    const int index = static_cast<int>(out_.vertices.size());
    const double scale = radius_ / std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    double square = 0;
    for (double& x : c) {
      x = scale * x + random_.between(-0.1, 0.1);
      square += x * x;
    }
    const double radius = radius_ + random_.between(-0.05, 0.05);
    Point point, normal;
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = dyadic(radius * c[k] / std::sqrt(square), 8);
      normal[k] = dyadic(c[k] / std::sqrt(square) + random_.between(-0.04, 0.04), 12);
    }
    out_.vertices.push_back({"V" + std::to_string(index), point});
    planes_.push_back(plane_near(normal, 6));
    return index;
  }

  // Its corners, counter-clockwise.
  void cell(const std::vector<int>& corners) {
    const std::size_t n = corners.size();
    std::vector<FaceSide> sides;
    for (std::size_t s = 0; s < n; ++s) sides.push_back(side(corners[s], corners[(s + 1) % n]));
    if (n != 4 || !happens(options_.split_faces)) return add_face(std::move(sides));
    if (random_.coin()) std::rotate(sides.begin(), sides.begin() + 1, sides.end());
    const FaceSide &s0 = sides[0], &s1 = sides[1], &s2 = sides[2], &s3 = sides[3];
    const Rational m0 = t_place(s0), m2 = t_place(s2);
    const int across = t_edge(s0, m0, s2, m2);
    add_face({{s0.edge, m0, s0.to}, s1, {s2.edge, s2.from, m2}, {across, 1, 0}});
    if (random_.integer(0, 2) > 0) return add_face({{s0.edge, s0.from, m0}, {across, 0, 1}, {s2.edge, m2, s2.to}, s3});
    const Rational m3 = t_place(s3), half(1, 2);
    const int second = t_edge({across, 0, 1}, half, s3, m3);
    add_face({{s0.edge, s0.from, m0}, {across, 0, half}, {second, 0, 1}, {s3.edge, m3, s3.to}});
    add_face({{second, 1, 0}, {across, half, 1}, {s2.edge, m2, s2.to}, {s3.edge, s3.from, m3}});
  }

 private:
  bool happens(int per_cent) { return random_.integer(0, 99) < per_cent; }

  void add_face(std::vector<FaceSide> sides) {
    if (sides.size() == 4 && options_.faces_cut_in_triangles > 0 && happens(options_.faces_cut_in_triangles)) {
      const FaceSide &s0 = sides[0], &s1 = sides[1], &s2 = sides[2], &s3 = sides[3];
      const int diagonal = diagonal_of(sides);
      put_face({s0, s1, {diagonal, 1, 0}});
      put_face({{diagonal, 0, 1}, s2, s3});
    } else {
      put_face(std::move(sides));
    }
  }
  void put_face(std::vector<FaceSide> sides) {
    out_.faces.push_back({"F" + std::to_string(out_.faces.size()), std::move(sides)});
  }

  // From where side 0 begins to where side 2 begins, between the tangents of the sides there.
  int diagonal_of(const std::vector<FaceSide>& sides) {
    const auto node_at = [&](const FaceSide& s) {
      if (s.from == 0) return out_.edges[s.edge].begin;
      if (s.from == 1) return out_.edges[s.edge].end;
      for (std::size_t t = 0;; ++t)
        if (out_.t_nodes[t].edge == s.edge && out_.t_nodes[t].parameter == s.from)
          return MeshNode{MeshNode::Kind::t_node, static_cast<int>(t)};
    };
    const auto point_at = [&](const FaceSide& s) { return edge_point(curve_of(out_.edges[s.edge]), s.from); };
    const auto between = [&](const FaceSide& side, const FaceSide& before) {
      return Rational(side.to - side.from) * edge_tangent(curve_of(out_.edges[side.edge]), side.from) +
             Rational(before.from - before.to) * edge_tangent(curve_of(out_.edges[before.edge]), before.to);
    };
    const Point a = point_at(sides[0]), b = point_at(sides[2]);
    const Point at_a = handle(between(sides[0], sides[3]), b - a), at_b = handle(between(sides[2], sides[1]), a - b);
    return add_edge({a, a + at_a, b + at_b, b}, node_at(sides[0]), node_at(sides[2]));
  }

  // A sixth to a third of the length of an arc with this chord, along a direction.
  Point handle(const Point& direction, const Point& chord) {
    const double u = length(direction), q = length(chord);
    const double cosine = std::max(0.0, nearest_double(dot(direction, chord)) / (u * q));
    return rounded(from_double(q / u * 2 / (3 * (1 + cosine)) * random_.between(0.9, 1.1)), 5) * direction;
  }

  FaceSide side(int from, int to) {
    const auto [low, high] = std::minmax(from, to);
    const auto [found, is_new] = edges_.emplace(std::pair(low, high), static_cast<int>(out_.edges.size()));
    if (is_new) {
      const Point &a = out_.vertices[low].point, &b = out_.vertices[high].point;
      const Point at_a = handle(in_plane(planes_[low], b - a, 6), b - a);
      const Point at_b = handle(in_plane(planes_[high], a - b, 6), a - b);
      add_edge({a, a + at_a, b + at_b, b}, {MeshNode::Kind::vertex, low}, {MeshNode::Kind::vertex, high});
    }
    return {found->second, from == low ? 0 : 1, from == low ? 1 : 0};
  }

  int add_edge(const std::array<Point, 4>& bezier, const MeshNode& begin, const MeshNode& end) {
    static const std::vector<std::vector<Rational>> menu{
        {{1, 3}},         {{1, 2}, {1, 2}},         {{2, 5}, {2, 5}, {2, 5}},
        {{1, 4}, {3, 4}}, {{1, 5}, {1, 2}, {1, 2}}, {{5, 8}, {5, 8}, {5, 8}}};
    MeshEdge edge;
    edge.id = "E" + std::to_string(out_.edges.size());
    edge.begin = begin;
    edge.end = end;
    const bool rational = happens(options_.rational_edges);
    std::vector<Rational> inner;
    if (happens(options_.knotted_edges)) inner = random_.one_of(menu);
    const bool triple = inner.size() == 3 && inner[0] == inner[2];
    if (rational && triple) inner.pop_back();
    edge.knots.assign(4, 0);
    edge.knots.insert(edge.knots.end(), inner.begin(), inner.end());
    edge.knots.insert(edge.knots.end(), 4, 1);
    const std::size_t count = edge.knots.size() - 4;
    const Point chord = bezier[3] - bezier[0];
    const double noise = 0.03 * length(chord);
    for (std::size_t i = 0; i < count; ++i) {
      Point p = blossom(bezier, &edge.knots[i + 1]);
      if (2 <= i && i + 2 < count) {
        for (std::size_t c = 0; c < 3; ++c) p[c] += from_double(random_.between(-noise, noise));
        p = on_grid(p, chord, 8);
      }
      edge.points.push_back(p);
      if (rational) edge.weights.push_back(Rational(random_.integer(4, 6), 4));
    }
    if (triple && !rational) edge.points[3] = Rational(1 - inner[0]) * edge.points[2] + inner[0] * edge.points[4];
    out_.edges.push_back(std::move(edge));
    taken_.push_back(false);
    return static_cast<int>(out_.edges.size()) - 1;
  }

  // Never the same place to both sides of an edge.
  Rational t_place(const FaceSide& s) {
    taken_[s.edge] = true;
    const bool left = s.from < s.to, other = random_.coin();
    return left ? (other ? Rational(1, 3) : Rational(2, 5)) : (other ? Rational(3, 5) : Rational(2, 3));
  }

  // To the left of an edge, about at right angles to it and to the sphere, about as long as its derivative.
  Point across(int edge, const Rational& t) {
    const Piecewise<Rational, 4> curve = curve_of(out_.edges[edge]);
    const Point point = edge_point(curve, t), tangent = edge_tangent(curve, t);
    const Point left = cross(point, tangent);
    return on_grid(from_double(1 / length(point)) * left, tangent, 6);
  }

  int t_node(const FaceSide& s, const Rational& t) {
    taken_[s.edge] = true;
    out_.t_nodes.push_back({"T" + std::to_string(out_.t_nodes.size()), s.edge, t});
    return static_cast<int>(out_.t_nodes.size()) - 1;
  }

  int t_edge(const FaceSide& from, const Rational& m, const FaceSide& to, const Rational& n) {
    const auto inwards = [&](const FaceSide& s, const Rational& t) {
      const Point left = across(s.edge, t);
      return s.from < s.to ? left : -left;
    };
    const Point a = edge_point(curve_of(out_.edges[from.edge]), m), b = edge_point(curve_of(out_.edges[to.edge]), n);
    const Point at_a = handle(inwards(from, m), b - a), at_b = handle(inwards(to, n), a - b);
    const int begin = t_node(from, m), end = t_node(to, n);
    return add_edge({a, a + at_a, b + at_b, b}, {MeshNode::Kind::t_node, begin}, {MeshNode::Kind::t_node, end});
  }

  void add_control_vectors() {
    for (std::size_t e = 0; e < out_.edges.size(); ++e) {
      if (taken_[e] || !happens(options_.edges_with_control_vectors)) continue;
      const std::vector<Rational>& knots = out_.edges[e].knots;
      const bool at_knot = knots.size() > 8 && random_.coin();
      const Rational t = at_knot ? knots[4] : Rational(random_.integer(2, 5), 7);
      const Point left = across(static_cast<int>(e), t);
      out_.control_vectors.push_back({static_cast<int>(e), t, left, Rational(-random_.integer(3, 5), 4) * left});
    }
  }

  const double radius_;
  Random random_;
  const ClosedMeshOptions options_;
  CurveMesh out_;
  std::vector<TangentPlane> planes_;  // at the vertices
  std::map<std::pair<int, int>, int> edges_;
  std::vector<bool> taken_;  // edges with T-nodes
};

// One of low, low + 1/d, …, high.
Rational fraction(Random& random, int low, int high, int d = 3) {
  return Rational(random.integer(low * d, high * d), d);
}

}  // namespace

CurveMesh closed_mesh(int n, std::uint64_t seed, const ClosedMeshOptions& options) {
  PATCHPROOF_REQUIRES(n >= 1, "closed_mesh: at least one face on each side");
  Ball ball(n, seed, options);
  std::map<std::array<int, 3>, int> vertices;  // by place on the cube [0, n]³
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          // Counter-clockwise from outside: the two other axes in their order where the outward normal is +axis.
          const int u = (axis + (end ? 1 : 2)) % 3, v = (axis + (end ? 2 : 1)) % 3;
          std::vector<int> corners;
          for (const auto& [x, y] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
            std::array<int, 3> place;
            place[axis] = end;
            place[u] = x;
            place[v] = y;
            const auto found = vertices.find(place);
            if (found == vertices.end())
              corners.push_back(vertices[place] =
                                    ball.add_vertex({2.0 * place[0] - n, 2.0 * place[1] - n, 2.0 * place[2] - n}));
            else
              corners.push_back(found->second);
          }
          ball.cell(corners);
        }
  return ball.finish();
}

CurveMesh polyhedron_mesh(Polyhedron polyhedron, std::uint64_t seed, const ClosedMeshOptions& options) {
  const SolidFaces icosahedron = regular_icosahedron();
  const SolidFaces solid = polyhedron == Polyhedron::icosahedron ? icosahedron
                           : polyhedron == Polyhedron::football  ? truncated(icosahedron)
                                                                 : expanded(icosahedron);
  Ball ball(polyhedron == Polyhedron::icosahedron ? 2 : 4, seed, options);
  for (const std::array<double, 3>& p : solid.points) ball.add_vertex(p);
  for (const std::vector<int>& face : solid.faces) ball.cell(face);
  return ball.finish();
}

CurveMesh two_faces(std::uint64_t seed, bool rational) {
  Random random(seed);
  const int segments = random.integer(1, 5);
  std::vector<int> twelfths{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  while (static_cast<int>(twelfths.size()) >= segments)
    twelfths.erase(twelfths.begin() + random.integer(0, static_cast<int>(twelfths.size()) - 1));
  std::vector<Rational> x{0};
  for (const int k : twelfths) x.push_back(Rational(k, 12));
  x.push_back(1);

  // The shared edge, homogeneous: inner Bézier points at random, joints where it is C¹.
  std::vector<Vec<Rational, 4>> inner, net{{{0, 0, 0, 1}}};
  for (int i = 0; i < segments; ++i)
    for (const int third : {1, 2}) {
      const Rational y = 9 * (x[i] + Rational(third, 3) * (x[i + 1] - x[i]));
      const Rational w = rational ? Rational(random.integer(4, 8), 4) : Rational(1);
      inner.push_back({{w * fraction(random, -1, 1), w * y, w * fraction(random, -1, 1), w}});
    }
  for (int i = 0; i < segments; ++i) {
    net.insert(net.end(), {inner[2 * i], inner[2 * i + 1]});
    if (i + 1 == segments) break;
    const Rational t = (x[i + 1] - x[i]) / (x[i + 2] - x[i]);
    net.push_back(Rational(1 - t) * inner[2 * i + 1] + t * inner[2 * i + 2]);
  }
  net.push_back({{0, 9, 0, 1}});

  CurveMesh mesh;
  const std::vector<Point> points{{{0, 0, 0}}, {{0, 9, 0}}, {{-6, 0, 0}}, {{-6, 9, 2}}, {{6, 0, 1}}, {{6, 9, -1}}};
  for (const Point& p : points) mesh.vertices.push_back({"V" + std::to_string(mesh.vertices.size()), p});
  const auto add_edge = [&](int begin, int end, std::vector<Rational> knots, std::vector<Point> net_of_edge) {
    MeshEdge edge;
    edge.id = "E" + std::to_string(mesh.edges.size());
    edge.knots.assign(4, 0);
    edge.knots.insert(edge.knots.end(), knots.begin(), knots.end());
    edge.knots.insert(edge.knots.end(), 4, 1);
    edge.points = std::move(net_of_edge);
    edge.begin.index = begin;
    edge.end.index = end;
    mesh.edges.push_back(std::move(edge));
  };
  std::vector<Rational> knots;
  for (int i = 1; i < segments; ++i) knots.insert(knots.end(), 3, x[i]);
  std::vector<Point> shared;
  for (const Vec<Rational, 4>& p : net) shared.push_back(project(p));
  add_edge(0, 1, knots, shared);
  if (rational)
    for (const Vec<Rational, 4>& p : net) mesh.edges[0].weights.push_back(p[3]);

  // The edges that leave from its ends, their second points from random derivatives in one plane with its tangent.
  const Piecewise<Rational, 4> curve = curve_of(mesh.edges[0]);
  std::array<Point, 4> second;  // of the edges to the left and to the right of its beginning, then of its end
  for (const int end : {0, 1}) {
    const Point left{{-6, fraction(random, -1, 1), fraction(random, -1, 1)}};
    const Point right = Rational(-fraction(random, 1, 2)) * left +
                        Rational(random.integer(-2, 2), 10) * edge_tangent(curve, Rational(end));
    second[2 * end] = points[end] + Rational(1, 3) * left;
    second[2 * end + 1] = points[end] + Rational(1, 3) * right;
  }
  add_edge(0, 2, {}, {points[0], second[0], {{-4, 0, 1}}, points[2]});
  add_edge(1, 3, {}, {points[1], second[2], {{-4, 9, 2}}, points[3]});
  add_edge(2, 3, {Rational(1, 2), Rational(1, 2), Rational(1, 2)},
           {points[2],
            {{-6, 1, 1}},
            {{-7, 3, 1}},
            {{-7, Rational(9, 2), Rational(3, 2)}},
            {{-7, 6, 2}},
            {{-6, 8, 2}},
            points[3]});
  add_edge(0, 4, {}, {points[0], second[1], {{4, 0, 1}}, points[4]});
  add_edge(1, 5, {}, {points[1], second[3], {{4, 9, -2}}, points[5]});
  add_edge(4, 5, {}, {points[4], {{6, 3, 2}}, {{7, 6, 0}}, points[5]});
  mesh.faces = {{"F1", {{1, 1, 0}, {0, 0, 1}, {2, 0, 1}, {3, 1, 0}}},
                {"F2", {{4, 0, 1}, {6, 0, 1}, {5, 1, 0}, {0, 1, 0}}}};

  std::vector<Rational> candidates(x.begin() + 1, x.end() - 1);
  candidates.push_back(Rational(random.integer(1, 30), 31));
  std::sort(candidates.begin(), candidates.end());
  for (const Rational& t : candidates)
    if (random.integer(0, 9) < 6) {
      const Point left{{-5, fraction(random, -1, 1), fraction(random, -1, 1)}};
      mesh.control_vectors.push_back({0, t, left, Rational(-fraction(random, 1, 2)) * left});
    }
  return mesh;
}

}  // namespace patchproof::validation
