// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/repair_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "patchproof/mesh/tangent_plane.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;

bool is_zero(const Vector& v) { return v == Vector{}; }

std::optional<Error> unreadable(const CurveMesh& mesh, const MeshEdge& edge) {
  const auto error = [&](ErrorCode code, const char* message, std::string values) {
    return Error{code, "edge " + edge.id, message, std::move(values)};
  };
  const std::size_t n = edge.points.size();
  if (edge.degree != 3) return error(ErrorCode::bad_degree, "an edge should be cubic", fmt::format("{}", edge.degree));
  if (n < 4 || edge.knots.size() != n + 4 || (!edge.weights.empty() && edge.weights.size() != n))
    return error(ErrorCode::wrong_count, "the knots, points and weights do not fit",
                 fmt::format("{} knots, {} points, {} weights", edge.knots.size(), n, edge.weights.size()));
  Result<KnotVector<Rational>> knots = KnotVector<Rational>::make(3, edge.knots);
  if (!knots) {
    Error of_knots = knots.error();
    of_knots.where = "edge " + edge.id;
    return of_knots;
  }
  for (const Rational& t : knots->breaks()) {
    const bool is_end = t == 0 || t == 1;
    if (t < 0 || t > 1 || (is_end ? knots->multiplicity(t) != 4 : knots->multiplicity(t) > 3))
      return error(ErrorCode::bad_multiplicity, "the knots should be clamped over [0, 1], inner ones at most triple",
                   fmt::format("{} stands {} times", to_text(t), knots->multiplicity(t)));
  }
  if (edge.knots.front() != 0 || edge.knots.back() != 1)
    return error(ErrorCode::bad_multiplicity, "the knots should be clamped over [0, 1]",
                 fmt::format("{} … {}", to_text(edge.knots.front()), to_text(edge.knots.back())));
  for (const Rational& w : edge.weights)
    if (w <= 0) return error(ErrorCode::bad_weight, "a weight should be positive", to_text(w));
  for (const MeshNode& node : {edge.begin, edge.end}) {
    const std::size_t count = node.kind == MeshNode::Kind::vertex ? mesh.vertices.size() : mesh.t_nodes.size();
    if (node.index < 0 || static_cast<std::size_t>(node.index) >= count)
      return error(ErrorCode::bad_reference, "it ends at an unknown node", std::to_string(node.index));
  }
  return std::nullopt;
}

// (a × b)² ≤ sine² a² b²; both may point anywhere along one line.
bool nearly_parallel(const Vector& a, const Vector& b, const Rational& sine) {
  const Vector n = cross(a, b);
  return dot(n, n) <= sine * sine * dot(a, a) * dot(b, b);
}

class Repair {
 public:
  Repair(const CurveMesh& mesh, const RepairOptions& options) : old_(mesh), sine_(options.largest_sine) {}

  Result<RepairedMesh> run() {
    for (const MeshEdge& edge : old_.edges)
      if (std::optional<Error> error = unreadable(old_, edge)) return std::move(*error);
    if (std::optional<Error> error = bad_reference()) return std::move(*error);
    out_.mesh = old_;
    at_vertex_.resize(old_.vertices.size());
    at_t_node_.resize(old_.t_nodes.size());
    on_edge_.resize(old_.edges.size());
    for (std::size_t t = 0; t < old_.t_nodes.size(); ++t) on_edge_[old_.t_nodes[t].edge].push_back(static_cast<int>(t));
    for (std::size_t e = 0; e < old_.edges.size(); ++e)
      for (const bool at_end : {false, true}) {
        const MeshNode& node = at_end ? old_.edges[e].end : old_.edges[e].begin;
        (node.kind == MeshNode::Kind::vertex ? at_vertex_ : at_t_node_)[node.index].push_back(
            {static_cast<int>(e), at_end});
      }
    for (std::size_t v = 0; v < at_vertex_.size(); ++v) mend_vertex(static_cast<int>(v));
    for (std::size_t e = 0; e < old_.edges.size(); ++e) mend_knots(static_cast<int>(e));
    if (std::optional<Error> error = mend_t_nodes()) return std::move(*error);
    for (std::size_t c = 0; c < old_.control_vectors.size(); ++c) mend_vectors(static_cast<int>(c));
    list_moves();
    return std::move(out_);
  }

 private:
  std::optional<Error> bad_reference() const {
    const auto is_edge = [&](int e) { return 0 <= e && e < static_cast<int>(old_.edges.size()); };
    for (const TNode& node : old_.t_nodes)
      if (!is_edge(node.edge) || node.parameter <= 0 || node.parameter >= 1)
        return Error{ErrorCode::bad_t_node, "T-node " + node.id, "a T-node should lie inside an edge",
                     to_text(node.parameter)};
    for (std::size_t c = 0; c < old_.control_vectors.size(); ++c)
      if (!is_edge(old_.control_vectors[c].edge))
        return Error{ErrorCode::bad_reference, fmt::format("control vectors {}", c), "there is no such edge",
                     std::to_string(old_.control_vectors[c].edge)};
    return std::nullopt;
  }

  // The end point and the next one.
  std::pair<Vector&, Vector&> points_at(const EdgeEnd& end) {
    std::vector<Vector>& p = out_.mesh.edges[end.edge].points;
    return end.at_end ? std::pair<Vector&, Vector&>(p[p.size() - 1], p[p.size() - 2])
                      : std::pair<Vector&, Vector&>(p[0], p[1]);
  }
  Vector direction_at(const EdgeEnd& end) {
    const auto [last, next] = points_at(end);
    return next - last;
  }

  void move_end(const EdgeEnd& end, const Vector& to) {
    const auto [last, next] = points_at(end);
    if (last == to) return;
    next += to - last;
    last = to;
  }

  // Into one plane, that of `fixed` too when that is not zero. False when they are too far from one.
  bool make_coplanar(const std::vector<EdgeEnd>& ends, const Vector& fixed) {
    std::vector<Vector> directions{fixed};
    for (const EdgeEnd& end : ends) directions.push_back(direction_at(end));
    std::erase_if(directions, is_zero);
    const bool on_a_line = std::all_of(directions.begin(), directions.end(),
                                       [&](const Vector& d) { return is_parallel(d, directions.front()); });
    if (on_a_line || common_normal(directions)) return true;
    Vector normal = fitted_normal(directions);
    if (!is_zero(fixed)) normal = projected(normal, fixed);
    if (is_zero(normal)) return false;
    const Rational bound = sine_ * sine_ * dot(normal, normal);
    for (const Vector& d : directions) {
      const Rational height = dot(d, normal);
      if (height * height > bound * dot(d, d)) return false;
    }
    for (const EdgeEnd& end : ends) {
      const Vector d = direction_at(end);
      points_at(end).second += projected(d, normal) - d;
    }
    return true;
  }

  void mend_vertex(int vertex) {
    for (const EdgeEnd& end : at_vertex_[vertex]) move_end(end, old_.vertices[vertex].point);
    if (!make_coplanar(at_vertex_[vertex], {})) out_.vertices.push_back(vertex);
  }

  void mend_knots(int e) {
    MeshEdge& edge = out_.mesh.edges[e];
    for (std::size_t m = 4; m + 6 < edge.knots.size(); ++m) {
      const Rational& x = edge.knots[m];
      if (x != edge.knots[m + 2]) continue;
      const std::size_t j = m - 1;  // its point
      const Rational s = (x - edge.knots[m - 1]) / (edge.knots[m + 3] - edge.knots[m - 1]);
      const auto weight = [&](std::size_t i) { return edge.weights.empty() ? Rational(1) : edge.weights[i]; };
      const Rational w_before = Rational(1 - s) * weight(j - 1), w_after = s * weight(j + 1), w = w_before + w_after;
      const Vector point = Rational(w_before / w) * edge.points[j - 1] + Rational(w_after / w) * edge.points[j + 1];
      if (point == edge.points[j] && w == weight(j)) continue;
      const Vector before = edge.points[j] - edge.points[j - 1], after = edge.points[j + 1] - edge.points[j];
      if (dot(before, after) <= 0 || !nearly_parallel(before, after, sine_)) {
        out_.knots.push_back({e, x});
        continue;
      }
      edge.points[j] = point;
      if (!edge.weights.empty()) edge.weights[j] = w;
    }
  }

  // First the T-nodes of edges that will not move any more.
  std::optional<Error> mend_t_nodes() {
    std::vector<int> open_ends(old_.edges.size()), ready;
    for (const std::vector<EdgeEnd>& ends : at_t_node_)
      for (const EdgeEnd& end : ends) ++open_ends[end.edge];
    for (std::size_t e = 0; e < open_ends.size(); ++e)
      if (open_ends[e] == 0) ready.push_back(static_cast<int>(e));
    for (std::size_t done = 0; done < ready.size(); ++done) {
      const int e = ready[done];
      if (on_edge_[e].empty()) continue;
      const Piecewise<Rational, 4> curve = curve_of(e);
      for (const int t : on_edge_[e]) {
        const Rational& parameter = old_.t_nodes[t].parameter;
        for (const EdgeEnd& end : at_t_node_[t]) {
          move_end(end, edge_point(curve, parameter));
          if (--open_ends[end.edge] == 0) ready.push_back(end.edge);
        }
        if (at_t_node_[t].size() > 1 && !make_coplanar(at_t_node_[t], edge_tangent(curve, parameter)))
          out_.t_nodes.push_back(t);
      }
    }
    // What is left ends on one another in rings: fine if nothing has to move.
    for (std::size_t e = 0; e < open_ends.size(); ++e) {
      if (open_ends[e] == 0) continue;
      const Piecewise<Rational, 4> curve = curve_of(static_cast<int>(e));
      for (const int t : on_edge_[e])
        for (const EdgeEnd& end : at_t_node_[t]) {
          const Vector at = edge_point(curve, old_.t_nodes[t].parameter);
          if (!(points_at(end).first == at))
            return Error{ErrorCode::ends_apart, "edge " + old_.edges[end.edge].id,
                         "it does not end at T-node " + old_.t_nodes[t].id +
                             ", and cannot be moved there: the edge that carries the node depends on it",
                         ""};
        }
    }
    std::sort(out_.t_nodes.begin(), out_.t_nodes.end());
    return std::nullopt;
  }
  Piecewise<Rational, 4> curve_of(int e) const {
    const MeshEdge& edge = out_.mesh.edges[e];
    const std::vector<Rational> weights =
        edge.weights.empty() ? std::vector<Rational>(edge.points.size(), 1) : edge.weights;
    return extract_bezier(BsplineCurve<Rational, 4>(KnotVector<Rational>::make_unchecked(3, edge.knots),
                                                    to_homogeneous(edge.points, weights)));
  }

  void mend_vectors(int index) {
    ControlVectors& c = out_.mesh.control_vectors[index];
    if (!c.left || !c.right || is_zero(*c.left) || is_zero(*c.right)) return;
    Vector along;  // of the edges that end there
    for (const int t : on_edge_[c.edge])
      if (old_.t_nodes[t].parameter == c.parameter)
        for (const EdgeEnd& end : at_t_node_[t]) {
          const Vector d = direction_at(end);
          along = dot(d, *c.left) < 0 ? along - d : along + d;
        }
    if (is_zero(along)) along = *c.left;
    if (is_parallel(*c.left, along) && is_parallel(*c.right, along) && dot(*c.left, *c.right) < 0) return;
    const bool near =
        nearly_parallel(*c.left, along, sine_) && nearly_parallel(*c.right, along, sine_) && dot(*c.left, *c.right) < 0;
    if (!near) {
      out_.vectors.push_back(index);
      return;
    }
    for (std::optional<Vector>* d : {&c.left, &c.right})
      if (!is_parallel(**d, along)) *d = Rational(dot(**d, along) / dot(along, along)) * along;
  }

  void list_moves() {
    const auto add = [&](RepairMove::Part part, int edge, std::size_t index, const Vector& by) {
      if (is_zero(by)) return;
      out_.moves.push_back({part, edge, static_cast<int>(index), by});
      if (part != RepairMove::Part::weight) out_.largest_square = std::max(out_.largest_square, dot(by, by));
    };
    for (std::size_t e = 0; e < old_.edges.size(); ++e) {
      const MeshEdge &before = old_.edges[e], &after = out_.mesh.edges[e];
      for (std::size_t i = 0; i < before.points.size(); ++i)
        add(RepairMove::Part::point, static_cast<int>(e), i, after.points[i] - before.points[i]);
      for (std::size_t i = 0; i < before.weights.size(); ++i)
        add(RepairMove::Part::weight, static_cast<int>(e), i, {{after.weights[i] - before.weights[i], 0, 0}});
    }
    for (std::size_t c = 0; c < old_.control_vectors.size(); ++c) {
      const ControlVectors &before = old_.control_vectors[c], &after = out_.mesh.control_vectors[c];
      if (before.left) add(RepairMove::Part::left_vector, before.edge, c, *after.left - *before.left);
      if (before.right) add(RepairMove::Part::right_vector, before.edge, c, *after.right - *before.right);
    }
    const RoundingGuard guard;
    out_.largest = out_.largest_square == 0 ? 0 : sqrt(enclose(out_.largest_square)).sup();
  }

  const CurveMesh& old_;
  const Rational sine_;
  RepairedMesh out_;
  std::vector<std::vector<EdgeEnd>> at_vertex_, at_t_node_;
  std::vector<std::vector<int>> on_edge_;  // the T-nodes
};

}  // namespace

Result<RepairedMesh> repair_mesh(const CurveMesh& mesh, const RepairOptions& options) {
  PATCHPROOF_REQUIRES(0 <= options.largest_sine && options.largest_sine < 1, "repair_mesh: a sine in [0, 1)");
  return Repair(mesh, options).run();
}

}  // namespace patchproof
