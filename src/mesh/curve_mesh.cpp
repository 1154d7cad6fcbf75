// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/curve_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {
namespace {

using Point = Vec<Rational, 3>;

std::string text(const Point& p) { return fmt::format("({}, {}, {})", to_text(p[0]), to_text(p[1]), to_text(p[2])); }

std::string text(const std::vector<Rational>& numbers) {
  std::string out;
  for (const Rational& x : numbers) out += (out.empty() ? "" : " ") + to_text(x);
  return out;
}

bool is_zero(const Point& p) { return p == Point{}; }

class Analysis {
 public:
  Analysis(const CurveMesh& mesh, FaceSides sides) : mesh_(mesh), sides_(sides) {}

  Result<MeshTopology> run() {
    for (const auto step : {&Analysis::edges, &Analysis::control_vectors, &Analysis::t_nodes, &Analysis::edge_ends,
                            &Analysis::faces, &Analysis::covers, &Analysis::corners, &Analysis::t_node_corners})
      if (std::optional<Error> error = (this->*step)()) return std::move(*error);
    classify();
    if (std::optional<Error> error = vectors_of_other_edges()) return std::move(*error);
    return std::move(out_);
  }

 private:
  static Error error(ErrorCode code, const std::string& where, std::string message, std::string values = "") {
    return {code, where, std::move(message), std::move(values)};
  }
  std::string edge_name(int e) const { return "edge " + mesh_.edges[e].id; }
  std::string face_name(int f) const { return "face " + mesh_.faces[f].id; }
  bool is_edge(int e) const { return 0 <= e && e < static_cast<int>(mesh_.edges.size()); }

  std::optional<Error> edges() {
    for (const MeshEdge& edge : mesh_.edges)
      if (std::optional<Error> e = add_curve(edge)) {
        e->where = "edge " + edge.id;
        return e;
      }
    return std::nullopt;
  }

  std::optional<Error> add_curve(const MeshEdge& edge) {
    if (edge.degree != 3)
      return error(ErrorCode::bad_degree, "", "an edge should be cubic", fmt::format("degree {}", edge.degree));
    const std::size_t n = edge.points.size();
    if (edge.knots.size() != n + 4 || (!edge.weights.empty() && edge.weights.size() != n))
      return error(ErrorCode::wrong_count, "", "the knots, points and weights do not fit",
                   fmt::format("{} knots, {} points, {} weights", edge.knots.size(), n, edge.weights.size()));
    for (std::size_t i = 1; i < edge.knots.size(); ++i)
      if (edge.knots[i] < edge.knots[i - 1])
        return error(ErrorCode::decreasing_knots, "", fmt::format("knot {} is smaller than the one before it", i),
                     fmt::format("{} after {}", to_text(edge.knots[i]), to_text(edge.knots[i - 1])));
    Result<KnotVector<Rational>> knots = KnotVector<Rational>::make(3, edge.knots);
    if (!knots) return knots.error();
    const bool clamped = knots->multiplicity(Rational(0)) == 4 && knots->multiplicity(Rational(1)) == 4;
    if (!clamped || knots->domain_begin() != 0 || knots->domain_end() != 1)
      return error(ErrorCode::bad_multiplicity, "", "the knots should begin with 0 and end with 1, four times each",
                   text(edge.knots));
    for (const Rational& t : knots->breaks())
      if (t > 0 && t < 1 && knots->multiplicity(t) > 3)
        return error(ErrorCode::bad_multiplicity, "", "an inner knot should stand at most three times",
                     fmt::format("{} stands {} times", to_text(t), knots->multiplicity(t)));
    for (std::size_t i = 0; i < edge.weights.size(); ++i)
      if (edge.weights[i] <= 0)
        return error(ErrorCode::bad_weight, "", fmt::format("weight {} should be positive", i),
                     to_text(edge.weights[i]));
    const std::vector<Rational> weights = edge.weights.empty() ? std::vector<Rational>(n, 1) : edge.weights;
    Piecewise<Rational, 4> curve =
        extract_bezier(BsplineCurve<Rational, 4>(std::move(*knots), to_homogeneous(edge.points, weights)));
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
      for (const int order : {0, 1}) {
        const Rational& t = curve[i].end;
        const auto left = value(curve, t, order, Side::left), right = value(curve, t, order, Side::right);
        if (!(left == right))
          return error(
              ErrorCode::not_c1, "",
              fmt::format("the homogeneous {} jumps at the knot {}", order == 0 ? "point" : "derivative", to_text(t)),
              fmt::format("({}, {}, {}, {})", to_text(right[0] - left[0]), to_text(right[1] - left[1]),
                          to_text(right[2] - left[2]), to_text(right[3] - left[3])));
      }
    for (const Rational& t : breaks(curve))
      if (is_zero(edge_tangent(curve, t)))
        return error(ErrorCode::vanishing_tangent, "", "the derivative vanishes at a knot", to_text(t));
    out_.curves.push_back(std::move(curve));
    return std::nullopt;
  }

  std::optional<Error> control_vectors() {
    out_.vectors_on_edge.resize(mesh_.edges.size());
    for (std::size_t i = 0; i < mesh_.control_vectors.size(); ++i) {
      const ControlVectors& c = mesh_.control_vectors[i];
      if (!is_edge(c.edge))
        return error(ErrorCode::bad_reference, fmt::format("control vectors {}", i), "there is no such edge",
                     std::to_string(c.edge));
      if (c.parameter <= 0 || c.parameter >= 1)
        return error(ErrorCode::control_vector_outside, edge_name(c.edge),
                     "control vectors should stand inside the edge", to_text(c.parameter));
      out_.vectors_on_edge[c.edge].push_back(static_cast<int>(i));
    }
    const auto place = [&](int i) -> const Rational& { return mesh_.control_vectors[i].parameter; };
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      std::vector<int>& list = out_.vectors_on_edge[e];
      std::sort(list.begin(), list.end(), [&](int a, int b) { return place(a) < place(b); });
      for (std::size_t i = 0; i + 1 < list.size(); ++i)
        if (place(list[i]) == place(list[i + 1]))
          return error(ErrorCode::control_vector_twice, edge_name(static_cast<int>(e)),
                       "there are two pairs of control vectors at one place", to_text(place(list[i])));
    }
    return std::nullopt;
  }

  std::optional<Error> t_nodes() {
    out_.t_nodes_on_edge.resize(mesh_.edges.size());
    out_.edges_at_t_node.resize(mesh_.t_nodes.size());
    for (std::size_t i = 0; i < mesh_.t_nodes.size(); ++i) {
      const TNode& node = mesh_.t_nodes[i];
      if (!is_edge(node.edge))
        return error(ErrorCode::bad_t_node, "T-node " + node.id, "there is no such edge", std::to_string(node.edge));
      if (node.parameter <= 0 || node.parameter >= 1)
        return error(ErrorCode::bad_t_node, "T-node " + node.id, "a T-node should lie inside its edge",
                     fmt::format("{} of edge {}", to_text(node.parameter), mesh_.edges[node.edge].id));
      std::vector<int>& list = out_.t_nodes_on_edge[node.edge];
      const auto at =
          std::find_if(list.begin(), list.end(), [&](int k) { return mesh_.t_nodes[k].parameter >= node.parameter; });
      if (at != list.end() && mesh_.t_nodes[*at].parameter == node.parameter)
        return error(ErrorCode::bad_t_node, "T-node " + node.id, "there is another T-node at this place",
                     fmt::format("T-node {} at {}", mesh_.t_nodes[*at].id, to_text(node.parameter)));
      list.insert(at, static_cast<int>(i));
    }
    return std::nullopt;
  }

  std::optional<Error> edge_ends() {
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      for (const bool at_end : {false, true}) {
        const MeshNode& node = at_end ? mesh_.edges[e].end : mesh_.edges[e].begin;
        const bool t_node = node.kind == MeshNode::Kind::t_node;
        const std::size_t count = t_node ? mesh_.t_nodes.size() : mesh_.vertices.size();
        const std::string name = edge_name(static_cast<int>(e));
        if (node.index < 0 || static_cast<std::size_t>(node.index) >= count)
          return error(
              ErrorCode::bad_reference, name,
              fmt::format("its {} names an unknown {}", at_end ? "end" : "begin", t_node ? "T-node" : "vertex"));
        const Point there = t_node ? t_node_point(node.index) : mesh_.vertices[node.index].point;
        const Point here = edge_point(out_.curves[e], Rational(at_end ? 1 : 0));
        if (!(here == there))
          return error(ErrorCode::ends_apart, name,
                       fmt::format("it does not {} at {} {}", at_end ? "end" : "begin", t_node ? "T-node" : "vertex",
                                   t_node ? mesh_.t_nodes[node.index].id : mesh_.vertices[node.index].id),
                       text(here) + " and " + text(there));
        if (t_node) out_.edges_at_t_node[node.index].push_back({static_cast<int>(e), at_end});
      }
    return std::nullopt;
  }
  Point t_node_point(int node) const {
    return edge_point(out_.curves[mesh_.t_nodes[node].edge], mesh_.t_nodes[node].parameter);
  }

  std::optional<MeshNode> node_at(int e, const Rational& t) const {
    if (t == 0) return mesh_.edges[e].begin;
    if (t == 1) return mesh_.edges[e].end;
    for (const int k : out_.t_nodes_on_edge[e])
      if (mesh_.t_nodes[k].parameter == t) return MeshNode{MeshNode::Kind::t_node, k};
    return std::nullopt;
  }

  std::optional<Error> faces() {
    out_.left.resize(mesh_.edges.size());
    out_.right.resize(mesh_.edges.size());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::vector<FaceSide>& sides = mesh_.faces[f].sides;
      const std::string name = face_name(static_cast<int>(f));
      const int count = static_cast<int>(sides.size());
      if (sides_ == FaceSides::four ? count != 4 : count < 2)
        return error(
            ErrorCode::wrong_side_count, name,
            sides_ == FaceSides::four ? "a face should have four sides" : "a face should have at least two sides",
            std::to_string(count));
      out_.uses_of_face.emplace_back();
      for (int s = 0; s < count; ++s) {
        const auto& [e, from, to] = sides[s];
        const std::string range = fmt::format("[{}, {}]", to_text(from), to_text(to));
        if (!is_edge(e)) return error(ErrorCode::bad_side, name, fmt::format("side {} has an unknown edge", s));
        if (from == to || std::min(from, to) < 0 || std::max(from, to) > 1)
          return error(ErrorCode::bad_side, name,
                       fmt::format("side {} is not a range of edge {}", s, mesh_.edges[e].id), range);
        if (!node_at(e, from) || !node_at(e, to))
          return error(ErrorCode::side_ends_nowhere, name,
                       fmt::format("side {} ends where edge {} has no vertex and no T-node", s, mesh_.edges[e].id),
                       range);
        const int use = static_cast<int>(out_.uses.size());
        out_.uses.push_back({static_cast<int>(f), s, e, from, to, {}, {}});
        out_.uses_of_face.back().push_back(use);
        (from < to ? out_.left : out_.right)[e].push_back(use);
      }
      for (int s = 0; s < count; ++s) {
        const FaceSide &here = sides[s], &next = sides[(s + 1) % count];
        if (!(*node_at(here.edge, here.to) == *node_at(next.edge, next.from)))
          return error(ErrorCode::open_loop, name,
                       fmt::format("sides {} and {} do not meet at a node", s, (s + 1) % count),
                       fmt::format("{} of edge {} and {} of edge {}", to_text(here.to), mesh_.edges[here.edge].id,
                                   to_text(next.from), mesh_.edges[next.edge].id));
      }
    }
    return std::nullopt;
  }

  std::optional<Error> covers() {
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      const std::string name = edge_name(static_cast<int>(e));
      for (std::vector<int>* side : {&out_.left[e], &out_.right[e]}) {
        const char* which = side == &out_.left[e] ? "left" : "right";
        std::sort(side->begin(), side->end(),
                  [&](int a, int b) { return out_.uses[a].begin() < out_.uses[b].begin(); });
        Rational covered(0);
        for (const int use : *side) {
          if (out_.uses[use].begin() != covered)
            return error(ErrorCode::uneven_cover, name,
                         fmt::format("the faces to its {} {}", which,
                                     covered < out_.uses[use].begin() ? "leave a gap" : "overlap"),
                         fmt::format("face {} begins at {}, not at {}", mesh_.faces[out_.uses[use].face].id,
                                     to_text(out_.uses[use].begin()), to_text(covered)));
          covered = out_.uses[use].end();
        }
        if (!side->empty() && covered != 1)
          return error(ErrorCode::uneven_cover, name, fmt::format("the faces to its {} leave a gap", which),
                       fmt::format("the last ends at {}", to_text(covered)));
      }
      if (out_.left[e].empty() && out_.right[e].empty())
        return error(ErrorCode::unused_edge, name, "no face lies at it");
    }
    return std::nullopt;
  }

  // The derivative of a side's own parameter over [0, 1], out of its first or
  // last point.
  Point outgoing(const EdgeUse& use, bool at_last) const {
    const Point tangent = edge_tangent(out_.curves[use.edge], at_last ? use.to : use.from);
    return Rational(at_last ? use.from - use.to : use.to - use.from) * tangent;
  }

  std::optional<Error> corners() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::vector<int>& uses = out_.uses_of_face[f];
      const std::size_t count = uses.size();
      for (std::size_t s = 0; s < count; ++s) {
        EdgeUse& use = out_.uses[uses[s]];
        const Point at_from = outgoing(out_.uses[uses[(s + count - 1) % count]], true);
        const Point at_to = outgoing(out_.uses[uses[(s + 1) % count]], false);
        if (is_parallel(outgoing(use, false), at_from))
          return error(
              ErrorCode::parallel_tangents, face_name(static_cast<int>(f)),
              fmt::format("sides {} and {} have parallel tangents where they meet", (s + count - 1) % count, s),
              text(at_from) + " and " + text(outgoing(use, false)));
        use.begin_derivative = use.is_left() ? at_from : at_to;
        use.end_derivative = use.is_left() ? at_to : at_from;
      }
    }
    return std::nullopt;
  }

  std::optional<Error> t_node_corners() {
    for (const TNode& node : mesh_.t_nodes) {
      bool met = false;
      for (const std::vector<int>* side : {&out_.left[node.edge], &out_.right[node.edge]})
        for (const int use : *side)
          met = met || out_.uses[use].begin() == node.parameter || out_.uses[use].end() == node.parameter;
      if (!met)
        return error(ErrorCode::bad_t_node, "T-node " + node.id, "no face has a corner there",
                     fmt::format("{} of edge {}", to_text(node.parameter), mesh_.edges[node.edge].id));
    }
    return std::nullopt;
  }

  void classify() {
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      if (out_.left[e].empty() || out_.right[e].empty()) {
        out_.kinds.push_back(EdgeKind::boundary);
        continue;
      }
      std::map<Rational, Point> normals;  // the first one at each parameter
      bool smooth = true;
      for (const std::vector<int>* side : {&out_.left[e], &out_.right[e]})
        for (const int index : *side) {
          const EdgeUse& use = out_.uses[index];
          for (const bool at_end : {false, true}) {
            const Rational& t = at_end ? use.end() : use.begin();
            const Point n = outward_normal(out_, use, t, at_end ? use.end_derivative : use.begin_derivative);
            const auto [first, is_new] = normals.emplace(t, n);
            smooth = smooth && (is_new || same_direction(first->second, n));
          }
        }
      out_.kinds.push_back(smooth ? EdgeKind::smooth : EdgeKind::sharp);
    }
  }

  // On smooth edges connect_edge asks for more.
  std::optional<Error> vectors_of_other_edges() {
    for (const ControlVectors& c : mesh_.control_vectors) {
      if (out_.kinds[c.edge] == EdgeKind::smooth) continue;
      const std::string where = fmt::format("{}, control vectors at {}", edge_name(c.edge), to_text(c.parameter));
      if (!c.left && !c.right)
        return error(ErrorCode::control_vector_missing, where, "there is neither a left nor a right one");
      for (const std::optional<Point>& vector : {c.left, c.right})
        if (vector && is_parallel(*vector, edge_tangent(out_.curves[c.edge], c.parameter)))
          return error(ErrorCode::control_vector_along, where, "the vector is zero or runs along the edge",
                       text(*vector));
    }
    return std::nullopt;
  }

  const CurveMesh& mesh_;
  const FaceSides sides_;
  MeshTopology out_;
};

}  // namespace

const char* to_string(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::boundary: return "boundary";
    case EdgeKind::smooth: return "smooth";
    case EdgeKind::sharp: return "sharp";
  }
  return "?";
}

Result<MeshTopology> analyse(const CurveMesh& mesh, FaceSides sides) { return Analysis(mesh, sides).run(); }

Vec<Rational, 3> edge_point(const Piecewise<Rational, 4>& curve, const Rational& t) { return project(value(curve, t)); }

Vec<Rational, 3> edge_tangent(const Piecewise<Rational, 4>& curve, const Rational& t) {
  return rational_derivatives<Rational, 4>({value(curve, t, 0), value(curve, t, 1)})[1];
}

Vec<Rational, 3> outward_normal(const MeshTopology& topology, const EdgeUse& use, const Rational& t,
                                const Vec<Rational, 3>& into_face) {
  const Vec<Rational, 3> n = cross(edge_tangent(topology.curves[use.edge], t), into_face);
  return use.is_left() ? n : -n;
}

bool is_parallel(const Vec<Rational, 3>& a, const Vec<Rational, 3>& b) { return is_zero(cross(a, b)); }
bool same_direction(const Vec<Rational, 3>& a, const Vec<Rational, 3>& b) { return is_parallel(a, b) && dot(a, b) > 0; }

}  // namespace patchproof
