// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/mesh_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <locale>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "patchproof/mesh/facets.h"

namespace patchproof {
namespace {

using Json = nlohmann::json;
using Point = Vec<double, 3>;

// ---- the parts ------------------------------------------------------------------------------------------------------

template <std::size_t D>
MeshPart mapped(const std::string& name, const std::array<int, D>& shape, CellKind kind = CellKind::cuboid) {
  std::array<std::array<double, 2>, D> box;
  box.fill({0, 1});
  MeshPart part{name,
                map_vertices(grid_on(kind, shape, box),
                             [](const Vec<double, D>& x) {
                               Point p;
                               for (std::size_t i = 0; i < D; ++i) p[i] = x[i];
                               p[0] += 0.1 * p[1] * p[1];
                               return p;
                             }),
                {},
                {}};
  return part;
}
MeshPart curve() { return mapped<1>("curve", {3}); }
MeshPart surface() { return mapped<2>("surface", {2, 3}); }
MeshPart solid(CellKind kind = CellKind::cuboid) { return mapped<3>("solid", {2, 1, 2}, kind); }

MeshPart with_normals(MeshPart part) {
  part.normals.assign(part.mesh.vertices.size(), Point{{0, 0, 1}});
  return part;
}
MeshPart with_parameters(MeshPart part) {
  part.parameters[0].assign(part.mesh.vertices.size(), 0.1);
  part.parameters[1].assign(part.mesh.vertices.size(), 0.2);
  return part;
}

// ---- other people's eyes: readers that share nothing with the writers -------------------------------------------------

struct Obj {
  std::vector<Point> points, normals;
  std::vector<std::vector<std::array<int, 2>>> faces;  // point, normal (0: none), from 1
  std::vector<std::vector<int>> lines;
  std::vector<std::string> names;
};

Obj read_obj(const std::string& text) {
  Obj out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key, word;
    words >> key;
    if (key == "v" || key == "vn") {
      Point p;
      words >> p[0] >> p[1] >> p[2];
      EXPECT_TRUE(words) << line;
      (key == "v" ? out.points : out.normals).push_back(p);
    } else if (key == "f") {
      out.faces.emplace_back();
      while (words >> word) {
        const std::size_t slash = word.find("//");
        out.faces.back().push_back(
            {std::stoi(word), slash == std::string::npos ? 0 : std::stoi(word.substr(slash + 2))});
      }
    } else if (key == "l") {
      out.lines.emplace_back();
      for (int v; words >> v;) out.lines.back().push_back(v);
    } else if (key == "o") {
      out.names.push_back(line.substr(2));
    } else {
      EXPECT_EQ(key, "#") << line;
    }
  }
  return out;
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T x;
  if (at + sizeof(T) > bytes.size()) throw std::out_of_range("the file ends early");
  std::memcpy(&x, bytes.data() + at, sizeof(T));
  return x;
}

std::vector<std::array<Point, 4>> read_stl(const std::string& bytes) {  // normal, a, b, c
  EXPECT_NE(bytes.substr(0, 5), "solid");
  const auto count = number_at<std::uint32_t>(bytes, 80);
  EXPECT_EQ(bytes.size(), 84 + 50 * std::size_t{count});
  std::vector<std::array<Point, 4>> out(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 12; ++k) out[t][k / 3][k % 3] = number_at<float>(bytes, 84 + 50 * t + 4 * k);
  return out;
}

struct Glb {
  Json json;
  std::string data;
};

Glb read_glb(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 4), 2u);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), bytes.size());
  const auto length = number_at<std::uint32_t>(bytes, 12);
  EXPECT_EQ(length % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(bytes.substr(20 + length + 4, 4), std::string("BIN\0", 4));
  const auto size = number_at<std::uint32_t>(bytes, 20 + length);
  EXPECT_EQ(size % 4, 0u);
  EXPECT_EQ(bytes.size(), 28 + length + size);
  return {Json::parse(bytes.substr(20, length)), bytes.substr(28 + length)};
}

pugi::xml_document read_xml(const std::string& text) {
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size());
  EXPECT_TRUE(result) << result.description();
  return document;
}

std::vector<double> numbers(const pugi::xml_node& parent, const char* name) {
  const pugi::xml_node node = parent.find_child_by_attribute("DataArray", "Name", name);
  EXPECT_TRUE(node) << name;
  std::istringstream in(node.child_value());
  std::vector<double> out;
  for (double x; in >> x;) out.push_back(x);
  return out;
}

double enclosed(const std::vector<std::array<Point, 3>>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += dot(cross(a, b), c) / 6;
  return sum;
}

// Whether each edge is run through once from one end and once from the other.
bool is_closed(const std::vector<std::array<Point, 3>>& triangles) {
  std::map<std::array<std::array<double, 3>, 2>, int> uses;
  for (const auto& t : triangles)
    for (int k : {0, 1, 2}) ++uses[{t[k].c, t[(k + 1) % 3].c}];
  for (const auto& [edge, count] : uses)
    if (count != 1 || !uses.contains({edge[1], edge[0]})) return false;
  return true;
}

MeshPart mirrored(MeshPart part) {
  for (Point& p : part.mesh.vertices) p = {{p[0], p[2], p[1]}};
  return part;
}

// ---- laws -----------------------------------------------------------------------------------------------------------

TEST(MeshFiles, Law1_Obj) {
  const MeshPart c = curve(), s = surface();
  const Obj obj = read_obj(write_obj({c, s}).value());
  EXPECT_EQ(obj.names, (std::vector<std::string>{"curve", "surface"}));
  ASSERT_EQ(obj.points.size(), c.mesh.vertices.size() + s.mesh.vertices.size());
  for (std::size_t v = 0; v < s.mesh.vertices.size(); ++v) EXPECT_EQ(obj.points[4 + v], s.mesh.vertices[v]);  // in full
  EXPECT_EQ(obj.lines, (std::vector<std::vector<int>>{{1, 2, 3, 4}}));
  ASSERT_EQ(obj.faces.size(), 6u);
  EXPECT_EQ(obj.faces[0], (std::vector<std::array<int, 2>>{{5, 0}, {6, 0}, {9, 0}, {8, 0}}));
  EXPECT_EQ(read_obj(write_obj({surface(), surface()}).value()).faces[6][0][0], 13);
  EXPECT_EQ(read_obj(write_obj({solid()}).value()).faces.size(), 16u);
  EXPECT_EQ(read_obj(write_obj({solid()}).value()).points.size(), 18u);
  EXPECT_EQ(read_obj(write_obj({mapped<3>("", {3, 3, 3})}).value()).points.size(), 64u - 8u);  // none from inside
}

TEST(MeshFiles, Law1_SolidsAreOrientedOutwards) {
  for (const CellKind kind : {CellKind::cuboid, CellKind::simplex}) {
    const Obj obj = read_obj(write_obj({solid(kind)}).value());
    std::vector<std::array<Point, 3>> triangles;
    for (const auto& f : obj.faces)
      for (std::size_t k = 2; k < f.size(); ++k)
        triangles.push_back({obj.points[f[0][0] - 1], obj.points[f[k - 1][0] - 1], obj.points[f[k][0] - 1]});
    EXPECT_NEAR(enclosed(triangles), 1, 1e-12);
    triangles.clear();
    for (const auto& [n, a, b, c] : read_stl(write_stl({solid(kind)}).value())) triangles.push_back({a, b, c});
    EXPECT_NEAR(enclosed(triangles), 1, 1e-6);
  }
}

// A map may turn space inside out: the boundary still looks outwards and is closed, the cells have a positive volume.
TEST(MeshFiles, Law1_MirroredSolidsAreOrientedOutwards) {
  for (const CellKind kind : {CellKind::cuboid, CellKind::simplex})
    for (const bool far : {false, true}) {
      MeshPart part = mirrored(solid(kind));
      // At a distance, and of a size, whose cube no double holds.
      if (far)
        for (Point& p : part.mesh.vertices) p = std::ldexp(1, 400) * (p + Point{{1e6, -1e6, 1e6}});
      const double scale = far ? std::ldexp(1, 400) : 1;
      const auto scaled = [&](Point p) { return (1 / scale) * p - (far ? Point{{1e6, -1e6, 1e6}} : Point{}); };
      std::vector<std::array<Point, 3>> triangles;
      const Obj obj = read_obj(write_obj({part}).value());
      for (const auto& f : obj.faces)
        for (std::size_t k = 2; k < f.size(); ++k)
          triangles.push_back(
              {scaled(obj.points[f[0][0] - 1]), scaled(obj.points[f[k - 1][0] - 1]), scaled(obj.points[f[k][0] - 1])});
      EXPECT_NEAR(enclosed(triangles), 1, 1e-6);
      EXPECT_TRUE(is_closed(triangles));
      const pugi::xml_document document = read_xml(write_vtu({part}).value());
      const pugi::xml_node piece = document.child("VTKFile").child("UnstructuredGrid").child("Piece");
      const auto place = numbers(piece.child("Points"), "Points"),
                 corners = numbers(piece.child("Cells"), "connectivity");
      const int n = kind == CellKind::cuboid ? 8 : 4;
      for (std::size_t first = 0; first < corners.size(); first += n) {
        const auto at = [&](int k) {
          const std::size_t p = 3 * static_cast<std::size_t>(corners[first + k]);
          return scaled({{place[p], place[p + 1], place[p + 2]}});
        };
        EXPECT_GT(dot(cross(at(1) - at(0), at(n == 8 ? 3 : 2) - at(0)), at(n == 8 ? 4 : 3) - at(0)), 0);
      }
      if (far) continue;
      triangles.clear();
      for (const auto& [normal, a, b, c] : read_stl(write_stl({part}).value())) triangles.push_back({a, b, c});
      EXPECT_NEAR(enclosed(triangles), 1, 1e-6);
      const Glb glb = read_glb(write_glb({part}).value());
      triangles.clear();
      const auto offset = [&](int view) { return glb.json["bufferViews"][view]["byteOffset"].get<std::size_t>(); };
      for (std::size_t k = 0; k < glb.json["accessors"][1]["count"].get<std::size_t>(); ++k) {
        const auto v = number_at<std::uint32_t>(glb.data, offset(1) + 4 * k);
        Point p;
        for (std::size_t i : {0, 1, 2}) p[i] = number_at<float>(glb.data, offset(0) + 12 * v + 4 * i);
        if (k % 3 == 0) triangles.emplace_back();
        triangles.back()[k % 3] = p;
      }
      EXPECT_NEAR(enclosed(triangles), 1, 1e-6);
    }
}

TEST(MeshFiles, Law1And4_Stl) {
  const auto triangles = read_stl(write_stl({curve(), surface()}).value());
  EXPECT_EQ(triangles.size(), 12u);
  double area = 0;
  for (const auto& [n, a, b, c] : triangles) {
    EXPECT_NEAR(n[2], 1, 1e-6);
    area += cross(b - a, c - a)[2] / 2;
  }
  EXPECT_NEAR(area, 1, 1e-6);
  MeshPart pole = surface();
  for (int v : {0, 1, 2}) pole.mesh.vertices[v] = {{0.25, 1e-60 * v, 0}};
  EXPECT_EQ(read_stl(write_stl({pole}).value()).size(), 10u);
  EXPECT_EQ(read_stl(write_stl({mapped<2>("", {2, 3}, CellKind::simplex)}).value()).size(), 12u);
}

TEST(MeshFiles, Law1_Vtu) {
  const pugi::xml_document document =
      read_xml(write_vtu({curve(), surface(), solid(), solid(CellKind::simplex)}).value());
  const pugi::xml_node piece = document.child("VTKFile").child("UnstructuredGrid").child("Piece");
  const std::size_t cells = 3 + 6 + 4 + 24, points = 4 + 12 + 18 + 18;
  EXPECT_EQ(piece.attribute("NumberOfPoints").as_ullong(), points);
  EXPECT_EQ(piece.attribute("NumberOfCells").as_ullong(), cells);
  const auto place = numbers(piece.child("Points"), "Points");
  ASSERT_EQ(place.size(), 3 * points);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(place[3 * 15 + i], surface().mesh.vertices[11][i]);
  const auto types = numbers(piece.child("Cells"), "types"), offsets = numbers(piece.child("Cells"), "offsets"),
             corners = numbers(piece.child("Cells"), "connectivity"), parts = numbers(piece.child("CellData"), "part");
  ASSERT_EQ(types.size(), cells);
  ASSERT_EQ(offsets.size(), cells);
  ASSERT_EQ(parts.size(), cells);
  std::map<double, int> count;
  for (const double t : types) ++count[t];
  EXPECT_EQ(count, (std::map<double, int>{{3, 3}, {9, 6}, {12, 4}, {10, 24}}));
  EXPECT_EQ(offsets.back(), corners.size());
  EXPECT_EQ(corners.size(), 3u * 2 + 6 * 4 + 4 * 8 + 24 * 4);
  // Every edge of VTK's hexahedron (0–1, 1–2, 2–3, 3–0, the same above, and upright ones) is an edge of the grid here.
  const std::size_t first = static_cast<std::size_t>(offsets[9]) - 8;
  const auto at = [&](int k) {
    const std::size_t p = 3 * static_cast<std::size_t>(corners[first + k]);
    return Point{{place[p], place[p + 1], place[p + 2]}};
  };
  for (const auto& [a, b] : std::vector<std::array<int, 2>>{
           {0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}) {
    const Point d = at(b) - at(a);
    EXPECT_EQ((d[1] != 0) + (d[2] != 0) + (d[1] == 0 && d[0] != 0), 1) << a << b;
  }
  EXPECT_GT(dot(cross(at(1) - at(0), at(3) - at(0)), at(4) - at(0)), 0);
}

TEST(MeshFiles, Law1_Glb) {
  const Glb glb = read_glb(write_glb({with_normals(surface()), curve(), solid()}).value());
  ASSERT_EQ(glb.json["meshes"].size(), 3u);
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.data.size());
  EXPECT_EQ(glb.json["nodes"][0]["children"], Json({1, 2, 3}));
  EXPECT_EQ(glb.json["nodes"][2]["name"], "curve");
  std::size_t covered = 0;
  for (const Json& view : glb.json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"], covered);
    covered += view["byteLength"].get<std::size_t>();
  }
  EXPECT_EQ(covered, glb.data.size());
  const std::vector<std::size_t> counts{6 * 2 * 3, 3 * 2, 16 * 2 * 3};
  for (int m : {0, 1, 2}) {
    const Json& primitive = glb.json["meshes"][m]["primitives"][0];
    EXPECT_EQ(primitive["mode"], m == 1 ? 1 : 4);
    EXPECT_EQ(primitive["attributes"].contains("NORMAL"), m == 0);
    const Json &position = glb.json["accessors"][primitive["attributes"]["POSITION"].get<int>()],
               &index = glb.json["accessors"][primitive["indices"].get<int>()];
    EXPECT_EQ(index["count"], counts[m]);
    EXPECT_EQ(index["componentType"], 5125);
    const Json &place = glb.json["bufferViews"][position["bufferView"].get<int>()],
               &order = glb.json["bufferViews"][index["bufferView"].get<int>()];
    EXPECT_EQ(place["byteLength"], position["count"].get<std::size_t>() * 12);
    EXPECT_EQ(order["byteLength"], index["count"].get<std::size_t>() * 4);
    Point low, high;
    low.c.fill(1e9);
    high.c.fill(-1e9);
    for (std::size_t k = 0; k < 3 * position["count"].get<std::size_t>(); ++k) {
      const double x = number_at<float>(glb.data, place["byteOffset"].get<std::size_t>() + 4 * k);
      low[k % 3] = std::min(low[k % 3], x);
      high[k % 3] = std::max(high[k % 3], x);
    }
    EXPECT_EQ(position["min"], Json(low.c));
    EXPECT_EQ(position["max"], Json(high.c));
    for (std::size_t k = 0; k < counts[m]; ++k)
      EXPECT_LT(number_at<std::uint32_t>(glb.data, order["byteOffset"].get<std::size_t>() + 4 * k), position["count"]);
  }
}

TEST(MeshFiles, Law2_TheSameBytesInAnyLocale) {
  const std::vector<MeshPart> parts{with_normals(surface()), curve(), solid()};
  const std::locale before;
  for (const auto write : {write_obj, write_stl, write_vtu, write_glb}) {
    const std::string bytes = write(parts).value();
    EXPECT_EQ(write(parts).value(), bytes);
    struct Comma : std::numpunct<char> {
      char do_decimal_point() const override { return ','; }
      char do_thousands_sep() const override { return '.'; }
      std::string do_grouping() const override { return "\1"; }
    };
    std::locale::global(std::locale(before, new Comma));
    EXPECT_EQ(write(parts).value(), bytes);
    std::locale::global(before);
  }
}

TEST(MeshFiles, Law3_Normals) {
  MeshPart part = with_normals(surface());
  Obj obj = read_obj(write_obj({surface(), part}).value());
  EXPECT_EQ(obj.normals.size(), 12u);
  EXPECT_EQ(obj.faces[6][0], (std::array<int, 2>{13, 1}));
  part.normals[0] = std::nullopt;
  obj = read_obj(write_obj({part}).value());
  EXPECT_EQ(obj.normals.size(), 11u);
  EXPECT_EQ(obj.faces[0][1], (std::array<int, 2>{2, 0}));
  EXPECT_EQ(obj.faces[1][0], (std::array<int, 2>{2, 1}));
  EXPECT_FALSE(read_glb(write_glb({part}).value()).json["meshes"][0]["primitives"][0]["attributes"].contains("NORMAL"));
  const auto count = [](const std::vector<MeshPart>& parts) {
    const auto document = read_xml(write_vtu(parts).value());
    const auto data = document.child("VTKFile").child("UnstructuredGrid").child("Piece").child("PointData");
    return std::distance(data.children().begin(), data.children().end());
  };
  EXPECT_EQ(count({surface()}), 0);
  EXPECT_EQ(count({with_normals(surface())}), 1);
  EXPECT_EQ(count({part}), 0);
  EXPECT_EQ(count({with_parameters(with_normals(surface()))}), 3);
  EXPECT_EQ(count({with_parameters(with_normals(surface())), curve()}), 0);
}

TEST(MeshFiles, Errors) {
  for (const auto write : {write_obj, write_stl, write_vtu, write_glb}) {
    EXPECT_EQ(write({}).error().code, ErrorCode::usage);
    EXPECT_EQ(write({MeshPart{}}).error().code, ErrorCode::usage);
  }
  EXPECT_EQ(write_stl({curve()}).error().code, ErrorCode::usage);
  MeshPart large = surface();
  large.mesh.vertices[3][1] = 1e40;
  EXPECT_EQ(write_stl({large}).error().code, ErrorCode::bad_number);
  EXPECT_EQ(write_glb({large}).error().code, ErrorCode::bad_number);
  EXPECT_EQ(read_obj(write_obj({large}).value()).points[3][1], 1e40);
}

TEST(MeshFiles, NamesCannotBreakAFile) {
  MeshPart part = surface();
  part.name = "a\nv 1 2 3\r\"\\\x01\xff <b>&";
  const Obj obj = read_obj(write_obj({part}).value());
  EXPECT_EQ(obj.points.size(), 12u);
  EXPECT_EQ(obj.names[0], "a v 1 2 3 \"\\ \xef\xbf\xbd <b>&");
  EXPECT_EQ(read_glb(write_glb({part}).value()).json["meshes"][0]["name"], obj.names[0]);
}

}  // namespace
}  // namespace patchproof
