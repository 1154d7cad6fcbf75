// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/edge_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;

std::string text(const Vector& p) { return fmt::format("({}, {}, {})", to_text(p[0]), to_text(p[1]), to_text(p[2])); }

// ⌊|d| 2^b⌋/2^b for b = 16, or 32, 48, … until it is positive. REQUIRES d ≠ 0.
Rational rounded_length(const Vector& d) {
  const Rational square = dot(d, d);
  for (unsigned bits = 16;; bits += 16) {
    const Integer scaled = (numerator(square) << (2 * bits)) / denominator(square);
    const Integer root = boost::multiprecision::sqrt(scaled);
    if (root > 0) return Rational(root, Integer(1) << bits);
  }
}

const EdgeUse& at_begin(const MeshTopology& topology, const std::vector<int>& side) {
  return topology.uses[side.front()];
}
const EdgeUse& at_end(const MeshTopology& topology, const std::vector<int>& side) { return topology.uses[side.back()]; }

// Node vectors of one smooth edge, by place.
class NodeVectors {
 public:
  NodeVectors(const CurveMesh& mesh, const MeshTopology& topology, int edge)
      : mesh_(mesh), topology_(topology), edge_(edge), curve_(topology.curves[edge]) {}

  Result<std::map<Rational, Vector>> run() {
    const std::vector<int>&left = topology_.left[edge_], &right = topology_.right[edge_];
    at_[Rational(0)] = at_begin(topology_, left).begin_derivative - at_begin(topology_, right).begin_derivative;
    at_[Rational(1)] = at_end(topology_, left).end_derivative - at_end(topology_, right).end_derivative;
    for (const int node : topology_.t_nodes_on_edge[edge_]) add_t_node(node);
    for (const int vectors : topology_.vectors_on_edge[edge_])
      if (std::optional<Error> error = add_control_vectors(mesh_.control_vectors[vectors])) return std::move(*error);
    return std::move(at_);
  }

 private:
  void add_t_node(int node) {
    const Rational& t = mesh_.t_nodes[node].parameter;
    Vector normal;  // of the surface: that of a face with a corner here
    for (const std::vector<int>* side : {&topology_.left[edge_], &topology_.right[edge_]})
      for (const int use : *side)
        if (topology_.uses[use].begin() == t)
          normal = outward_normal(topology_, topology_.uses[use], t, topology_.uses[use].begin_derivative);
    const Vector tangent = edge_tangent(curve_, t);
    Vector sum;
    for (const EdgeEnd& end : topology_.edges_at_t_node[node]) {
      Vector away = edge_tangent(topology_.curves[end.edge], Rational(end.at_end ? 1 : 0));
      if (end.at_end) away = -away;
      sum = dot(cross(tangent, away), normal) > 0 ? sum + away : sum - away;
    }
    if (!topology_.edges_at_t_node[node].empty()) at_[t] = sum;
  }

  std::optional<Error> add_control_vectors(const ControlVectors& c) {
    const auto error = [&](ErrorCode code, const char* message, std::string values = "") {
      return Error{code, fmt::format("edge {}, control vectors at {}", mesh_.edges[edge_].id, to_text(c.parameter)),
                   message, std::move(values)};
    };
    if (!c.left || !c.right)
      return error(ErrorCode::control_vector_missing, "the edge is smooth and needs a vector for either side");
    const std::string both = text(*c.left) + " and " + text(*c.right);
    if (!is_parallel(*c.left, *c.right) || dot(*c.left, *c.right) >= 0)
      return error(ErrorCode::control_vectors_bent, "the left and the right vector should be opposite", both);
    const Vector tangent = edge_tangent(curve_, c.parameter);
    if (is_parallel(*c.left, tangent))
      return error(ErrorCode::control_vector_along, "the vectors run along the edge", both);
    if (const auto there = at_.find(c.parameter); there != at_.end()) {
      if (!same_direction(there->second, *c.left))
        return error(ErrorCode::control_vector_differs, "the edge that ends there has another direction",
                     text(*c.left) + " and " + text(there->second));
      return std::nullopt;
    }
    at_[c.parameter] = *c.left - *c.right;
    return std::nullopt;
  }

  const CurveMesh& mesh_;
  const MeshTopology& topology_;
  const int edge_;
  const Piecewise<Rational, 4>& curve_;
  std::map<Rational, Vector> at_;
};

// w C′_xyz − w′ C_xyz: w² times the affine tangent, on one piece.
std::vector<Vector> tangent_form(const std::vector<Vec<Rational, 4>>& points) {
  const auto xyz = [](const std::vector<Vec<Rational, 4>>& from) {
    std::vector<Vector> out;
    for (const auto& p : from) out.push_back({{p[0], p[1], p[2]}});
    return out;
  };
  const auto weight = [](const std::vector<Vec<Rational, 4>>& from) {
    std::vector<Rational> out;
    for (const auto& p : from) out.push_back(p[3]);
    return out;
  };
  const std::vector<Vec<Rational, 4>> derivative = hodograph(points);
  const std::vector<Rational> w = weight(points);
  if (std::all_of(w.begin(), w.end(), [&](const Rational& x) { return x == w[0]; })) return xyz(derivative);
  std::vector<Vector> out = product(w, xyz(derivative));
  const std::vector<Vector> other = product(weight(derivative), xyz(points));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = out[i] - other[i];
  return out;
}

// The Bernstein coefficients of f × g.
std::vector<Vector> cross_product(const std::vector<Vector>& f, const std::vector<Vector>& g) {
  const int m = static_cast<int>(f.size()) - 1, n = static_cast<int>(g.size()) - 1;
  const auto of_f = binomial_row<Rational>(m), of_g = binomial_row<Rational>(n),
             of_both = binomial_row<Rational>(m + n);
  std::vector<Vector> out(m + n + 1);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) out[i + j] += Rational(of_f[i] * of_g[j] / of_both[i + j]) * cross(f[i], g[j]);
  return out;
}

bool runs_across(const Piecewise<Rational, 3>& basis, const Piecewise<Rational, 4>& curve) {
  const Piecewise<Rational, 3> a = refine(basis, breaks(curve));
  const Piecewise<Rational, 4> c = refine(curve, breaks(basis));
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!no_zero(cross_product(a[i].points, tangent_form(c[i].points)))) return false;
  return true;
}

Piecewise<Rational, 1> scalar_pieces(const std::vector<Rational>& places, const std::vector<std::vector<Rational>>& f) {
  Piecewise<Rational, 1> out;
  for (std::size_t i = 0; i < f.size(); ++i) {
    out.push_back({places[i], places[i + 1], {}});
    for (const Rational& c : f[i]) out.back().points.push_back({{c}});
  }
  return out;
}

bool no_zero(const std::vector<Vector>& coefficients, int depth) {
  const Vector middle = de_casteljau(coefficients, Rational(1, 2));
  if (std::all_of(coefficients.begin(), coefficients.end(), [&](const Vector& c) { return dot(c, middle) > 0; }))
    return true;
  const Vector zero;
  if (depth == 0 || middle == zero || coefficients.front() == zero || coefficients.back() == zero) return false;
  const BezierHalves<Vector> halves = split(coefficients, Rational(1, 2));
  return no_zero(halves.left, depth - 1) && no_zero(halves.right, depth - 1);
}

}  // namespace

bool no_zero(const std::vector<Vec<Rational, 3>>& coefficients) { return no_zero(coefficients, 24); }

Result<EdgeConnection> connect_edge(const CurveMesh& mesh, const MeshTopology& topology, int edge,
                                    const FillOptions& options) {
  PATCHPROOF_REQUIRES(topology.kinds[edge] == EdgeKind::smooth, "connect_edge: the edge is not smooth");
  Result<std::map<Rational, Vector>> nodes = NodeVectors(mesh, topology, edge).run();
  if (!nodes) return nodes.error();
  EdgeConnection out;
  for (const auto& [place, vector] : *nodes) {
    if (vector == Vector{})
      return Error{ErrorCode::basis_along_edge, "edge " + mesh.edges[edge].id,
                   "the derivatives across the edge cancel at a node", to_text(place)};
    out.places.push_back(place);
    out.vectors.push_back(options.scale == NodeScale::rational ? Rational(1 / rounded_length(vector)) * vector
                                                               : vector);
  }
  out.basis = node_field<Rational, 3>(out.places, out.vectors, options.method == FillMethod::c1);
  if (!runs_across(out.basis, topology.curves[edge]))
    return Error{ErrorCode::basis_along_edge, "edge " + mesh.edges[edge].id,
                 "the derivatives across the edge cannot be joined without one "
                 "along it: control vectors are needed",
                 ""};
  return out;
}

UseConnection connect_use(const CurveMesh& mesh, const MeshTopology& topology, const EdgeConnection& connection,
                          const EdgeUse& use, const FillOptions& options) {
  const Piecewise<Rational, 4>& curve = topology.curves[use.edge];
  // b = ± k a + h c with n = a × c:  k = ± (b × c)·n / n·n,  h = (a × b)·n /
  // n·n
  struct Ends {
    Rational k, h;
  };
  const auto coefficients = [&](const Rational& t, const Vector& b) -> Ends {
    const Vector a = value(connection.basis, t), c = edge_tangent(curve, t), n = cross(a, c);
    PATCHPROOF_REQUIRES(dot(b, n) == 0,
                        "connect_use: the derivative lies outside the tangent "
                        "plane of a smooth edge");
    const Rational k = dot(cross(b, c), n) / dot(n, n), w = value(curve, t)[3];
    PATCHPROOF_REQUIRES(use.is_left() ? k > 0 : k < 0, "connect_use: the face lies on the wrong side");
    return {use.is_left() ? Rational(w * k) : Rational(-w * k), dot(cross(a, b), n) / dot(n, n)};
  };
  const Rational &begin = use.begin(), &end = use.end();
  const Ends first = coefficients(begin, use.begin_derivative), last = coefficients(end, use.end_derivative);
  const std::vector<Rational> basis_places = breaks(window(connection.basis, begin, end)),
                              places = common_breaks(breaks(window(curve, begin, end)), basis_places);
  UseConnection out;
  const bool c1 = options.method == FillMethod::c1;
  if (c1) {
    out.k = scalar_pieces({begin, end}, {{first.k, last.k}});
  } else {  // the length of a control vector counts
    std::vector<Rational> at{first.k};
    for (std::size_t i = 1; i + 1 < basis_places.size(); ++i) {
      Rational k(1);
      for (const int v : topology.vectors_on_edge[use.edge]) {
        const ControlVectors& c = mesh.control_vectors[v];
        const std::optional<Vector>& d = use.is_left() ? c.left : c.right;
        const Vector a = value(connection.basis, basis_places[i]);
        if (c.parameter == basis_places[i] && d) k = abs(dot(*d, a)) / dot(a, a);
      }
      at.push_back(k * value(curve, basis_places[i])[3]);
    }
    at.push_back(last.k);
    std::vector<std::vector<Rational>> pieces;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) pieces.push_back({at[i], at[i + 1]});
    out.k = scalar_pieces(basis_places, pieces);
  }
  if ((first.h == 0 && last.h == 0) || places.size() == 2) {
    out.h = scalar_pieces({begin, end}, {{first.h, last.h}});
    return out;
  }
  std::vector<std::vector<Rational>> bump(places.size() - 1, std::vector<Rational>(c1 ? 3 : 2, Rational(0)));
  bump.front().front() = first.h;
  bump.back().back() = last.h;
  out.h = scalar_pieces(places, bump);
  return out;
}

GivenDerivatives given_derivatives(const CurveMesh& mesh, const MeshTopology& topology, const EdgeUse& use) {
  GivenDerivatives out;
  const auto add = [&](const Rational& t, const Vector& vector) {
    out.places.push_back(t);
    out.vectors.push_back(value(topology.curves[use.edge], t)[3] * vector);
  };
  add(use.begin(), use.begin_derivative);
  for (const int v : topology.vectors_on_edge[use.edge]) {
    const ControlVectors& c = mesh.control_vectors[v];
    const std::optional<Vector>& d = use.is_left() ? c.left : c.right;
    if (d && use.begin() < c.parameter && c.parameter < use.end()) add(c.parameter, *d);
  }
  add(use.end(), use.end_derivative);
  return out;
}

}  // namespace patchproof
