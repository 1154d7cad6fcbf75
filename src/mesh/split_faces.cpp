// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/split_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "patchproof/mesh/tangent_plane.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;

bool is_zero(const Vector& v) { return v == Vector{}; }

// The positive multiple of a direction whose length is a third of what suits an arc with this chord.
Vector third_of_arc(const Vector& direction, const Vector& chord) {
  const Rational u = dot(direction, direction), q = dot(chord, chord), both = dot(direction, chord);
  Rational cosine = rounded_root(Rational(both * both / (u * q)));
  if (both < 0) cosine = std::max(Rational(-cosine), Rational(-1, 4));
  return rounded(Rational(rounded_root(Rational(q / u)) * 2 / (3 * (1 + cosine)))) * direction;
}

// Where a spoke begins.
struct Middle {
  int t_node = 0;
  Rational parameter;
  Vector point, direction;  // of d
};

class Split {
 public:
  Split(const CurveMesh& mesh, const FillOptions& options) : mesh_(mesh), options_(options) {}

  Result<CurveMesh> run() {
    Result<MeshTopology> topology = analyse(mesh_, FaceSides::any);
    if (!topology) return topology.error();
    topology_ = std::move(*topology);
    out_ = mesh_;
    out_.faces.clear();
    for (const TNode& node : mesh_.t_nodes) names_.insert(node.id);
    for (const MeshVertex& vertex : mesh_.vertices) names_.insert(vertex.id);
    for (const MeshEdge& edge : mesh_.edges) edge_names_.insert(edge.id);
    for (const MeshFace& face : mesh_.faces) face_names_.insert(face.id);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (mesh_.faces[f].sides.size() == 4) {
        out_.faces.push_back(mesh_.faces[f]);
      } else if (std::optional<Error> error = split(static_cast<int>(f))) {
        return std::move(*error);
      }
    }
    return std::move(out_);
  }

 private:
  std::optional<Error> split(int face) {
    const MeshFace& old = mesh_.faces[face];
    const std::size_t n = old.sides.size();
    if (n < 3)
      return Error{ErrorCode::wrong_side_count, "face " + old.id, "a face should have at least three sides to be split",
                   std::to_string(n)};
    std::vector<Middle> middles;
    for (const int use : topology_.uses_of_face[face]) {
      Result<Middle> middle = middle_of(topology_.uses[use]);
      if (!middle) return middle.error();
      middles.push_back(std::move(*middle));
    }
    const Vector centre = centre_of(middles);
    const std::optional<std::vector<Vector>> ends = directions_at(centre, middles);
    if (!ends)
      return Error{ErrorCode::parallel_tangents, "face " + old.id,
                   "there is no plane at its centre in which the curves from the middles of its sides can meet",
                   fmt::format("centre ({}, {}, {})", to_text(centre[0]), to_text(centre[1]), to_text(centre[2]))};
    const int vertex = static_cast<int>(out_.vertices.size()), first = static_cast<int>(out_.edges.size());
    out_.vertices.push_back({unused(old.id + ".centre", names_), centre});
    for (std::size_t i = 0; i < n; ++i) {
      const Middle& m = middles[i];
      const Vector chord = centre - m.point;
      const Vector tangent = edge_tangent(topology_.curves[old.sides[i].edge], m.parameter);
      const Vector begin =
          third_of_arc(is_zero(m.direction) || is_parallel(m.direction, tangent) ? chord : m.direction, chord);
      const Vector end = third_of_arc((*ends)[i], -chord);
      MeshEdge spoke;
      spoke.id = unused(fmt::format("{}/{}", old.id, i), edge_names_);
      spoke.knots = {0, 0, 0, 0, 1, 1, 1, 1};
      spoke.points = {m.point, m.point + begin, centre + end, centre};
      spoke.begin = {MeshNode::Kind::t_node, m.t_node};
      spoke.end = {MeshNode::Kind::vertex, vertex};
      out_.edges.push_back(std::move(spoke));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = (i + n - 1) % n;
      const FaceSide &side = old.sides[i], &last = old.sides[before];
      out_.faces.push_back({unused(fmt::format("{}.{}", old.id, i), face_names_),
                            {{side.edge, side.from, middles[i].parameter},
                             {first + static_cast<int>(i), 0, 1},
                             {first + static_cast<int>(before), 1, 0},
                             {last.edge, middles[before].parameter, last.to}}});
    }
    return std::nullopt;
  }

  static std::string unused(std::string name, std::set<std::string>& names) {
    while (!names.insert(name).second) name += '\'';
    return name;
  }

  Result<Middle> middle_of(const EdgeUse& use) {
    Middle out;
    out.parameter = (use.from + use.to) / 2;
    out.point = edge_point(topology_.curves[use.edge], out.parameter);
    out.t_node = t_node_at(use.edge, out.parameter);
    if (topology_.kinds[use.edge] == EdgeKind::smooth) {
      auto known = connections_.find(use.edge);
      if (known == connections_.end()) {
        Result<EdgeConnection> connection = connect_edge(mesh_, topology_, use.edge, options_);
        if (!connection) return connection.error();
        known = connections_.emplace(use.edge, std::move(*connection)).first;
      }
      out.direction = value(known->second.basis, out.parameter);
      if (!use.is_left()) out.direction = -out.direction;
    } else {
      const GivenDerivatives given = given_derivatives(mesh_, topology_, use);
      out.direction = value(node_field(given.places, given.vectors), out.parameter);
    }
    return out;
  }

  int t_node_at(int edge, const Rational& parameter) {
    for (const int node : topology_.t_nodes_on_edge[edge])
      if (mesh_.t_nodes[node].parameter == parameter) return node;
    const auto [place, is_new] = t_nodes_.emplace(std::pair(edge, parameter), static_cast<int>(out_.t_nodes.size()));
    if (is_new)
      out_.t_nodes.push_back(
          {unused(fmt::format("{}@{}", mesh_.edges[edge].id, to_text(parameter)), names_), edge, parameter});
    return place->second;
  }

  static Vector centre_of(const std::vector<Middle>& middles) {
    const Rational share(1, static_cast<int>(middles.size()));
    Vector mean, centre;
    for (const Middle& m : middles) mean += share * m.point;
    centre = mean;
    std::vector<Vector> in_face;  // directions that are all in the plane of a flat face
    for (const Middle& m : middles) {
      in_face.push_back(m.point - middles[0].point);
      in_face.push_back(m.direction);
      if (!is_zero(m.direction) && !(m.point == mean))
        centre += Rational(share * Rational(3, 2)) * third_of_arc(m.direction, mean - m.point);
    }
    const Vector from = centre - middles[0].point;
    if (const std::optional<Vector> flat = common_normal(in_face))
      return middles[0].point + in_plane(plane_of(*flat), from);
    return on_grid(centre, from);
  }

  // Of the spokes, away from the centre; nothing when the middles lie on a line or a face folds back there.
  static std::optional<std::vector<Vector>> directions_at(const Vector& centre, const std::vector<Middle>& middles) {
    const std::size_t n = middles.size();
    std::vector<Vector> to_middles;
    for (const Middle& m : middles) to_middles.push_back(m.point - centre);
    for (const Vector& v : to_middles)
      if (is_zero(v)) return std::nullopt;
    Vector normal;
    for (std::size_t i = 0; i < n; ++i) normal += cross(to_middles[i], to_middles[(i + 1) % n]);
    if (is_zero(normal)) return std::nullopt;
    const std::optional<Vector> flat = common_normal(to_middles);
    const TangentPlane plane = flat ? plane_of(dot(*flat, normal) > 0 ? *flat : -*flat) : plane_near(normal);
    std::vector<Vec<Rational, 2>> places;  // coordinates in the plane
    for (const Vector& v : to_middles) places.push_back(plane_coordinates(plane, v));
    if (!goes_round_once(places)) {
      // first and second may differ in length
      const Rational ratio = rounded_root(Rational(dot(plane.first, plane.first) / dot(plane.second, plane.second)));
      const double x = nearest_double(places[0][0]), y = nearest_double(Rational(places[0][1] / ratio));
      for (std::size_t i = 0; i < n; ++i) {
        const double angle = std::atan2(y, x) + 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
        places[i] = {{rounded(from_double(std::cos(angle))), ratio * rounded(from_double(std::sin(angle)))}};
      }
      if (!goes_round_once(places)) return std::nullopt;
    }
    std::vector<Vector> out;
    for (const Vec<Rational, 2>& p : places) out.push_back(p[0] * plane.first + p[1] * plane.second);
    return out;
  }

  static bool goes_round_once(const std::vector<Vec<Rational, 2>>& places) {
    const std::size_t n = places.size();
    int rounds = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec<Rational, 2>&here = places[i], &next = places[(i + 1) % n];
      if (here[0] * next[1] - here[1] * next[0] <= 0) return false;
      if (here[1] < 0 && next[1] >= 0) ++rounds;
    }
    return rounds == 1;
  }

  const CurveMesh& mesh_;
  const FillOptions options_;
  MeshTopology topology_;
  CurveMesh out_;
  std::map<int, EdgeConnection> connections_;
  std::map<std::pair<int, Rational>, int> t_nodes_;  // new ones
  std::set<std::string> names_, edge_names_, face_names_;
};

}  // namespace

Result<CurveMesh> split_faces(const CurveMesh& mesh, const FillOptions& options) { return Split(mesh, options).run(); }

}  // namespace patchproof
