// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/curve_mesh_file.h"

#include <map>

#include "json_text.h"
#include "json_walker.h"
#include "source_file.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node {
  kRoot,
  kFormat,
  kVersion,
  kUnits,
  kVertices,
  kVertex,
  kTNodes,
  kTNode,
  kEdges,
  kEdge,
  kAllVectors,
  kVectors,
  kFaces,
  kFace,
  kSides,
  kSide,
  kId,
  kPoint,
  kLeft,
  kRight,
  kCoordinate,
  kEdgeName,
  kParameter,
  kDegree,
  kKnots,
  kKnot,
  kPoints,
  kWeights,
  kWeight,
  kEnd,
  kTNodeName,
  kFrom,
  kTo,
};

constexpr JsonRule kRules[] = {
    {kNoParent, "", kRoot, JsonType::object},
    {kRoot, "format", kFormat, JsonType::string, true},
    {kRoot, "version", kVersion, JsonType::integer, true},
    {kRoot, "units", kUnits, JsonType::string},
    {kRoot, "vertices", kVertices, JsonType::array, true},
    {kVertices, "", kVertex, JsonType::object},
    {kVertex, "id", kId, JsonType::string, true},
    {kVertex, "point", kPoint, JsonType::array, true},
    {kRoot, "t_nodes", kTNodes, JsonType::array},
    {kTNodes, "", kTNode, JsonType::object},
    {kTNode, "id", kId, JsonType::string, true},
    {kTNode, "edge", kEdgeName, JsonType::string, true},
    {kTNode, "parameter", kParameter, JsonType::number, true},
    {kRoot, "edges", kEdges, JsonType::array, true},
    {kEdges, "", kEdge, JsonType::object},
    {kEdge, "id", kId, JsonType::string, true},
    {kEdge, "degree", kDegree, JsonType::integer},
    {kEdge, "knots", kKnots, JsonType::array},
    {kEdge, "points", kPoints, JsonType::array, true},
    {kEdge, "weights", kWeights, JsonType::array},
    {kEdge, "begin", kEnd, JsonType::string, true},
    {kEdge, "begin", kTNodeName, JsonType::object},
    {kEdge, "end", kEnd, JsonType::string, true},
    {kEdge, "end", kTNodeName, JsonType::object},
    {kTNodeName, "t_node", kEnd, JsonType::string, true},
    {kKnots, "", kKnot, JsonType::number},
    {kPoints, "", kPoint, JsonType::array},
    {kWeights, "", kWeight, JsonType::number},
    {kRoot, "control_vectors", kAllVectors, JsonType::array},
    {kAllVectors, "", kVectors, JsonType::object},
    {kVectors, "edge", kEdgeName, JsonType::string, true},
    {kVectors, "parameter", kParameter, JsonType::number, true},
    {kVectors, "left", kLeft, JsonType::array},
    {kVectors, "right", kRight, JsonType::array},
    {kPoint, "", kCoordinate, JsonType::number},
    {kLeft, "", kCoordinate, JsonType::number},
    {kRight, "", kCoordinate, JsonType::number},
    {kRoot, "faces", kFaces, JsonType::array, true},
    {kFaces, "", kFace, JsonType::object},
    {kFace, "id", kId, JsonType::string, true},
    {kFace, "sides", kSides, JsonType::array, true},
    {kSides, "", kSide, JsonType::object},
    {kSide, "edge", kEdgeName, JsonType::string, true},
    {kSide, "from", kFrom, JsonType::number},
    {kSide, "to", kTo, JsonType::number},
};

class MeshVisitor final : public JsonVisitor {
 public:
  MeshVisitor(Decimals decimals, CurveMeshFile& file) : decimals_(decimals), file_(file), mesh_(file.mesh) {}

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    switch (node) {
      case kVertices:
      case kTNodes:
      case kEdges:
      case kAllVectors:
      case kFaces: list_ = static_cast<Node>(node); break;
      case kVertex: mesh_.vertices.emplace_back(); break;
      case kTNode: mesh_.t_nodes.emplace_back(); break;
      case kEdge: mesh_.edges.emplace_back(); break;
      case kVectors: mesh_.control_vectors.emplace_back(); break;
      case kFace: mesh_.faces.emplace_back(); break;
      case kSide: side_ = {0, Rational(0), Rational(1)}; break;
      case kPoint:
      case kLeft:
      case kRight: components_ = 0; break;
      case kTNodeName: end_is_t_node_ = true, at_end_ = walker.key() == "end"; break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    switch (node) {
      case kPoint:
      case kLeft:
      case kRight:
        if (components_ != 3)
          return walker.error(ErrorCode::wrong_count, "three numbers should stand here", std::to_string(components_));
        if (node == kLeft) mesh_.control_vectors.back().left = point_;
        if (node == kRight) mesh_.control_vectors.back().right = point_;
        if (node == kPoint)
          (list_ == kEdges ? mesh_.edges.back().points.emplace_back() : mesh_.vertices.back().point) = point_;
        break;
      case kTNodeName: end_is_t_node_ = false; break;
      case kEdge: return finish_edge();
      case kSide: mesh_.faces.back().sides.push_back(side_); break;
      case kRoot: return resolve(walker);
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    switch (node) {
      case kFormat:
        if (text != "patchproof-curve-mesh")
          return walker.error(ErrorCode::unknown_format, "the format should be \"patchproof-curve-mesh\"", text);
        break;
      case kVersion:
        if (text != "1") return walker.error(ErrorCode::unsupported, "only version 1 of the format is read", text);
        break;
      case kUnits: file_.units = text; break;
      case kId: return add_id(text, walker);
      case kDegree: {
        const std::optional<long> degree = to_integer(text);
        if (!degree || *degree < 0 || *degree > 64)
          return walker.error(ErrorCode::bad_degree, "an edge should be cubic", text);
        mesh_.edges.back().degree = static_cast<int>(*degree);
        break;
      }
      case kCoordinate:
        if (components_ == 3) return walker.error(ErrorCode::wrong_count, "three numbers should stand here", text);
        return number(text, walker, point_[components_++]);
      case kKnot: return number(text, walker, mesh_.edges.back().knots.emplace_back());
      case kWeight: return number(text, walker, mesh_.edges.back().weights.emplace_back());
      case kParameter:
        return number(text, walker,
                      list_ == kTNodes ? mesh_.t_nodes.back().parameter : mesh_.control_vectors.back().parameter);
      case kFrom: return number(text, walker, side_.from);
      case kTo: return number(text, walker, side_.to);
      case kEdgeName: return refer(Reference::Kind::edge, text, walker);
      case kEnd:
        if (!end_is_t_node_) at_end_ = walker.key() == "end";
        return refer(end_is_t_node_ ? Reference::Kind::t_node : Reference::Kind::vertex, text, walker);
      default: break;
    }
    return std::nullopt;
  }

 private:
  // A name to be looked up when all lists are read: they may stand in any order.
  struct Reference {
    enum class Kind { vertex, t_node, edge } kind;
    std::string name, pointer;
    enum class Of { t_node, begin, end, vectors, side } of;
    std::size_t index, side = 0;
  };

  std::optional<Error> number(std::string_view text, const JsonWalker& walker, Rational& value) {
    Result<Rational> read = parse_scalar<Rational>(text, decimals_);
    if (!read)
      return walker.error(read.error().code,
                          mentions_root(text) ? "curve meshes hold rational numbers, no roots" : read.error().message,
                          text);
    value = std::move(*read);
    return std::nullopt;
  }

  std::optional<Error> add_id(std::string_view text, const JsonWalker& walker) {
    const std::string id(text);
    std::map<std::string, int>* ids = &vertices_;
    std::size_t count = 0;
    switch (list_) {
      case kVertices: mesh_.vertices.back().id = id, count = mesh_.vertices.size(); break;
      case kTNodes: ids = &t_nodes_, mesh_.t_nodes.back().id = id, count = mesh_.t_nodes.size(); break;
      case kEdges: ids = &edges_, mesh_.edges.back().id = id, count = mesh_.edges.size(); break;
      default: ids = &faces_, mesh_.faces.back().id = id, count = mesh_.faces.size(); break;
    }
    if (!ids->emplace(id, static_cast<int>(count) - 1).second)
      return walker.error(ErrorCode::bad_reference, "this id stands twice in its list", text);
    return std::nullopt;
  }

  std::optional<Error> refer(typename Reference::Kind kind, std::string_view text, const JsonWalker& walker) {
    Reference reference{kind, std::string(text), walker.pointer(), Reference::Of::side, 0};
    switch (list_) {
      case kTNodes: reference.of = Reference::Of::t_node, reference.index = mesh_.t_nodes.size() - 1; break;
      case kAllVectors:
        reference.of = Reference::Of::vectors, reference.index = mesh_.control_vectors.size() - 1;
        break;
      case kEdges:
        reference.of = at_end_ ? Reference::Of::end : Reference::Of::begin, reference.index = mesh_.edges.size() - 1;
        break;
      default: reference.index = mesh_.faces.size() - 1, reference.side = mesh_.faces.back().sides.size(); break;
    }
    references_.push_back(std::move(reference));
    return std::nullopt;
  }

  std::optional<Error> finish_edge() {
    MeshEdge& edge = mesh_.edges.back();
    if (edge.knots.empty())  // one Bézier piece
      for (const int t : {0, 1}) edge.knots.insert(edge.knots.end(), edge.degree + 1, Rational(t));
    return std::nullopt;
  }

  std::optional<Error> resolve(const JsonWalker& walker) {
    for (const Reference& r : references_) {
      const std::map<std::string, int>& in = r.kind == Reference::Kind::vertex   ? vertices_
                                             : r.kind == Reference::Kind::t_node ? t_nodes_
                                                                                 : edges_;
      const auto found = in.find(r.name);
      if (found == in.end()) {
        constexpr const char* kNames[] = {"vertex", "T-node", "edge"};
        Error error = walker.error(ErrorCode::bad_reference,
                                   fmt::format("there is no {} of this id", kNames[static_cast<int>(r.kind)]), r.name);
        error.where = file_.path + " at " + r.pointer;
        return error;
      }
      const MeshNode node{r.kind == Reference::Kind::t_node ? MeshNode::Kind::t_node : MeshNode::Kind::vertex,
                          found->second};
      switch (r.of) {
        case Reference::Of::t_node: mesh_.t_nodes[r.index].edge = found->second; break;
        case Reference::Of::begin: mesh_.edges[r.index].begin = node; break;
        case Reference::Of::end: mesh_.edges[r.index].end = node; break;
        case Reference::Of::vectors: mesh_.control_vectors[r.index].edge = found->second; break;
        case Reference::Of::side: mesh_.faces[r.index].sides[r.side].edge = found->second; break;
      }
    }
    return std::nullopt;
  }

  const Decimals decimals_;
  CurveMeshFile& file_;
  CurveMesh& mesh_;
  std::map<std::string, int> vertices_, t_nodes_, edges_, faces_;
  std::vector<Reference> references_;
  Vec<Rational, 3> point_;
  int components_ = 0;
  FaceSide side_;
  bool end_is_t_node_ = false, at_end_ = false;
  Node list_ = kRoot;  // the one being read
};

using Buffer = fmt::memory_buffer;

void put_vector(Buffer& out, const Vec<Rational, 3>& p) {
  json_list(out, 3, ", ", [&](int c) { put(out, "{}", json_number(p[c])); });
}

template <class Elements, class Put>
void put_list(Buffer& out, const char* key, const Elements& elements, Put put_element) {
  put(out, ",\n  \"{}\": ", key);
  put(out, "[");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    put(out, "{}", i == 0 ? "\n    " : ",\n    ");
    put_element(elements[i]);
  }
  put(out, "\n  ]");
}

}  // namespace

Result<CurveMeshFile> read_curve_mesh_text(std::string_view bytes, const std::string& path, Decimals decimals) {
  if (bytes.find_first_not_of(" \t\r\n\v\f") == std::string_view::npos)
    return Error{ErrorCode::empty_input, path, bytes.empty() ? "the file is empty" : "nothing but blanks", ""};
  CurveMeshFile file{path, sha256_of(bytes), "", {}};
  const SourceFile source{path, bytes};
  MeshVisitor visitor(decimals, file);
  if (std::optional<Error> error = JsonWalker(source, kRules, UnknownKeys::refused, visitor).walk()) return *error;
  return file;
}

Result<CurveMeshFile> read_curve_mesh(const std::string& path, Decimals decimals) {
  const Result<std::string> bytes = load_file(path);
  if (!bytes) return bytes.error();
  return read_curve_mesh_text(*bytes, path, decimals);
}

std::string write_curve_mesh(const CurveMesh& mesh, const std::string& units) {
  Buffer out;
  const auto edge_id = [&](int e) { return json_string(mesh.edges[e].id); };
  const auto node = [&](const MeshNode& n) {
    return n.kind == MeshNode::Kind::t_node ? fmt::format("{{\"t_node\": {}}}", json_string(mesh.t_nodes[n.index].id))
                                            : json_string(mesh.vertices[n.index].id);
  };
  put(out, "{{\n  \"format\": \"patchproof-curve-mesh\",\n  \"version\": 1");
  if (!units.empty()) put(out, ",\n  \"units\": {}", json_string(units));
  put_list(out, "vertices", mesh.vertices, [&](const MeshVertex& v) {
    put(out, "{{\"id\": {}, \"point\": ", json_string(v.id));
    put_vector(out, v.point);
    put(out, "}}");
  });
  if (!mesh.t_nodes.empty())
    put_list(out, "t_nodes", mesh.t_nodes, [&](const TNode& t) {
      put(out, "{{\"id\": {}, \"edge\": {}, \"parameter\": {}}}", json_string(t.id), edge_id(t.edge),
          json_number(t.parameter));
    });
  put_list(out, "edges", mesh.edges, [&](const MeshEdge& e) {
    put(out, "{{\"id\": {}, \"begin\": {}, \"end\": {}", json_string(e.id), node(e.begin), node(e.end));
    if (!(e.knots == KnotVector<Rational>::bezier(3).knots())) {
      put(out, ",\n     \"knots\": ");
      json_list(out, static_cast<int>(e.knots.size()), ", ", [&](int i) { put(out, "{}", json_number(e.knots[i])); });
    }
    put(out, ",\n     \"points\": ");
    json_list(out, static_cast<int>(e.points.size()), ", ", [&](int i) { put_vector(out, e.points[i]); });
    if (!e.weights.empty()) {
      put(out, ",\n     \"weights\": ");
      json_list(out, static_cast<int>(e.weights.size()), ", ",
                [&](int i) { put(out, "{}", json_number(e.weights[i])); });
    }
    put(out, "}}");
  });
  if (!mesh.control_vectors.empty())
    put_list(out, "control_vectors", mesh.control_vectors, [&](const ControlVectors& c) {
      put(out, "{{\"edge\": {}, \"parameter\": {}", edge_id(c.edge), json_number(c.parameter));
      for (const auto* side : {&c.left, &c.right})
        if (*side) {
          put(out, ", \"{}\": ", side == &c.left ? "left" : "right");
          put_vector(out, **side);
        }
      put(out, "}}");
    });
  put_list(out, "faces", mesh.faces, [&](const MeshFace& f) {
    put(out, "{{\"id\": {}, \"sides\": ", json_string(f.id));
    json_list(out, static_cast<int>(f.sides.size()), ", ", [&](int i) {
      const FaceSide& side = f.sides[i];
      put(out, "{{\"edge\": {}", edge_id(side.edge));
      if (side.from != 0 || side.to != 1)
        put(out, ", \"from\": {}, \"to\": {}", json_number(side.from), json_number(side.to));
      put(out, "}}");
    });
    put(out, "}}");
  });
  put(out, "\n}}\n");
  return fmt::to_string(out);
}

bool looks_like_curve_mesh(std::string_view bytes) {
  return bytes.substr(0, 4096).find("patchproof-curve-mesh") != std::string_view::npos;
}

}  // namespace patchproof
