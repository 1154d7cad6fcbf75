// SPDX-License-Identifier: Apache-2.0
// The reference meshes and surfaces of validation/vectors/gregory.json, found by an independent program in fractions.
#pragma once

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "patchproof/mesh/fill_faces.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof::gregory_reference {

using Json = nlohmann::json;

inline const Json& document() {
  static const Json all = [] {
    std::ifstream in(std::string(PATCHPROOF_SOURCE_DIR) + "/validation/vectors/gregory.json");
    return Json::parse(in);
  }();
  return all;
}

inline const Json& find_case(const std::string& id) {
  for (const Json& one : document().at("cases"))
    if (one.at("id") == id) return one;
  throw std::out_of_range("no reference case " + id);
}

inline Rational number(const Json& text) { return parse_scalar<Rational>(text.get<std::string>()).value(); }

template <std::size_t N>
Vec<Rational, N> point(const Json& numbers) {
  Vec<Rational, N> out;
  for (std::size_t c = 0; c < N; ++c) out[c] = number(numbers.at(c));
  return out;
}

// Unknown names become index −1, which analyse() has to find.
inline CurveMesh mesh_of(const Json& from) {
  std::map<std::string, int> vertices, edges, t_nodes;
  const auto find = [](const std::map<std::string, int>& in, const std::string& name) {
    const auto found = in.find(name);
    return found == in.end() ? -1 : found->second;
  };
  CurveMesh mesh;
  for (const auto& [id, p] : from.at("vertices").items()) {
    vertices.emplace(id, static_cast<int>(mesh.vertices.size()));
    mesh.vertices.push_back({id, point<3>(p)});
  }
  for (const auto& [id, e] : from.at("edges").items()) edges.emplace(id, static_cast<int>(edges.size()));
  const Json none = Json::object(), &nodes = from.contains("tnodes") ? from.at("tnodes") : none;
  for (const auto& [id, t] : nodes.items()) {
    t_nodes.emplace(id, static_cast<int>(mesh.t_nodes.size()));
    mesh.t_nodes.push_back({id, find(edges, t.at("edge")), number(t.at("param"))});
  }
  for (const auto& [id, e] : from.at("edges").items()) {
    MeshEdge edge;
    edge.id = id;
    edge.degree = e.value("degree", 3);
    for (const Json& t : e.at("knots")) edge.knots.push_back(number(t));
    for (const Json& p : e.at("points")) edge.points.push_back(point<3>(p));
    for (const Json& w : e.value("weights", Json::array())) edge.weights.push_back(number(w));
    const auto node = [&](const Json& end) -> MeshNode {
      if (end.is_object()) return {MeshNode::Kind::t_node, find(t_nodes, end.at("tnode"))};
      return {MeshNode::Kind::vertex, find(vertices, end)};
    };
    edge.begin = node(e.at("start"));
    edge.end = node(e.at("end"));
    mesh.edges.push_back(std::move(edge));
  }
  for (const Json& c : from.value("control_vectors", Json::array())) {
    ControlVectors vectors{find(edges, c.at("edge")), number(c.at("param")), std::nullopt, std::nullopt};
    if (c.contains("left")) vectors.left = point<3>(c.at("left"));
    if (c.contains("right")) vectors.right = point<3>(c.at("right"));
    mesh.control_vectors.push_back(std::move(vectors));
  }
  for (const auto& [id, sides] : from.at("faces").items()) {
    MeshFace face{id, {}};
    for (const Json& s : sides) face.sides.push_back({find(edges, s.at(0)), number(s.at(1)), number(s.at(2))});
    mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

inline FillOptions options_of(const Json& one) {
  return {one.at("options").at("scale") == "rational" ? NodeScale::rational : NodeScale::none,
          one.at("options").at("method") == "c0" ? FillMethod::former : FillMethod::c1};
}

}  // namespace patchproof::gregory_reference
