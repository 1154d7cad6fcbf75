// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/curve_mesh_file.h"

#include <gtest/gtest.h>

#include "support/gregory_reference.h"

namespace patchproof {
namespace {

using namespace gregory_reference;

bool same(const CurveMesh& a, const CurveMesh& b) {
  const auto equal_lists = [](const auto& x, const auto& y, auto equal) {
    return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), equal);
  };
  return equal_lists(a.vertices, b.vertices,
                     [](const auto& x, const auto& y) { return x.id == y.id && x.point == y.point; }) &&
         equal_lists(a.t_nodes, b.t_nodes,
                     [](const auto& x, const auto& y) {
                       return x.id == y.id && x.edge == y.edge && x.parameter == y.parameter;
                     }) &&
         equal_lists(a.edges, b.edges,
                     [](const auto& x, const auto& y) {
                       return x.id == y.id && x.knots == y.knots && x.points == y.points && x.weights == y.weights &&
                              x.begin == y.begin && x.end == y.end;
                     }) &&
         equal_lists(a.control_vectors, b.control_vectors,
                     [](const auto& x, const auto& y) {
                       return x.edge == y.edge && x.parameter == y.parameter && x.left == y.left && x.right == y.right;
                     }) &&
         equal_lists(a.faces, b.faces, [&](const auto& x, const auto& y) {
           return x.id == y.id && equal_lists(x.sides, y.sides, [](const auto& p, const auto& q) {
                    return p.edge == q.edge && p.from == q.from && p.to == q.to;
                  });
         });
}

// (1), (2): every reference mesh, with T-nodes, weights and control vectors among them.
TEST(CurveMeshFile, MeshesComeBack) {
  for (const Json& one : document().at("cases")) {
    const CurveMesh mesh = mesh_of(one.at("mesh"));
    const std::string text = write_curve_mesh(mesh, "mm");
    EXPECT_TRUE(looks_like_curve_mesh(text));
    const Result<CurveMeshFile> read = read_curve_mesh_text(text, "mesh.json");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->units, "mm");
    EXPECT_TRUE(same(mesh, read->mesh)) << one.at("id");
  }
}

std::string with(const std::string& what, const std::string& by) {
  std::string text = write_curve_mesh(mesh_of(find_case("B").at("mesh")));
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

// (3) and the errors
TEST(CurveMeshFile, BadFilesAreRefusedWithTheirPlace) {
  struct Case {
    std::string what, by;
    ErrorCode code;
    std::string where;
  };
  for (const Case& c :
       {Case{"\"patchproof-curve-mesh\"", "\"mesh\"", ErrorCode::unknown_format, "/format"},
        Case{"\"version\": 1", "\"version\": 2", ErrorCode::unsupported, "/version"},
        Case{"\"id\": \"V1\"", "\"id\": \"V0\"", ErrorCode::bad_reference, "/vertices/1/id"},
        Case{"\"begin\": \"V0\"", "\"begin\": \"V99\"", ErrorCode::bad_reference, "/edges/"},
        Case{"\"edge\": \"E0\", \"parameter\"", "\"edge\": \"E99\", \"parameter\"", ErrorCode::bad_reference,
             "/t_nodes/0/edge"},
        Case{"\"point\": [0, 0, 0]", "\"point\": [0, 0]", ErrorCode::wrong_count, "/vertices/0/point"},
        Case{"\"point\": [0, 0, 0]", "\"point\": [0, 0, 0, 0]", ErrorCode::wrong_count, "/vertices/0/point"},
        Case{"\"point\": [0, 0, 0]", "\"point\": [0, 0, \"nan\"]", ErrorCode::bad_number, "/vertices/0/point/2"},
        Case{"\"point\": [0, 0, 0]", "\"point\": [0, 0, \"sqrt(2)\"]", ErrorCode::bad_number, "/vertices/0/point/2"},
        Case{"\"point\": [0, 0, 0]", "\"point\": 0", ErrorCode::syntax, "/vertices/0"}}) {
    const Result<CurveMeshFile> read = read_curve_mesh_text(with(c.what, c.by), "mesh.json");
    ASSERT_FALSE(read) << c.by;
    EXPECT_EQ(read.error().code, c.code) << read.error().text();
    EXPECT_NE(read.error().where.find(c.where), std::string::npos) << read.error().text();
  }
  EXPECT_EQ(read_curve_mesh_text("", "mesh.json").error().code, ErrorCode::empty_input);
  EXPECT_EQ(read_curve_mesh("no/such/file.json").error().code, ErrorCode::cannot_open);
  const std::string text = write_curve_mesh(mesh_of(find_case("B").at("mesh")));
  for (const std::size_t length : {text.size() / 4, text.size() / 2, text.size() - 3})
    EXPECT_FALSE(read_curve_mesh_text(text.substr(0, length), "mesh.json")) << length;
}

}  // namespace
}  // namespace patchproof
