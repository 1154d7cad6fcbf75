// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/tessellate_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <sstream>

#include "io/io_support.h"
#include "patchproof/deadline.h"
#include "patchproof/parallel.h"

namespace patchproof::test {
namespace {

ModelFile example(const std::string& name) {
  Result<ModelFile> file = read_model(std::string(PATCHPROOF_SOURCE_DIR) + "/examples/" + name);
  if (!file) throw std::runtime_error(file.error().text());
  return std::move(*file);
}

double length(const Vec<double, 3>& x) { return std::sqrt(dot(x, x)); }
Vec<double, 3> corner(const CertifiedMesh& mesh, std::size_t triangle, int i) {
  return mesh.vertices[mesh.triangles[triangle][i]];
}

TEST(TessellateModel, Law1_ASphereIsClosedAndWithinItsBound) {
  for (const CellMethod method : {CellMethod::adaptive, CellMethod::regular})
    for (const double chord : {0.1, 0.02}) {
      MeshRequest request;
      request.chord = chord;
      const Result<ModelMesh> made = tessellate_model(example("sphere_octants.json"), request, method);
      ASSERT_TRUE(made) << made.error().text();
      EXPECT_EQ(made->method, method == CellMethod::regular ? "regular" : "adaptive");
      const CertifiedMesh& mesh = made->mesh;
      EXPECT_EQ(std::set<int>(mesh.faces.begin(), mesh.faces.end()), (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7}));
      EXPECT_LE(mesh.chord, chord);
      for (const auto& v : mesh.vertices) EXPECT_NEAR(length(v), 1, 1e-14 + mesh.gap);
      double deepest = 0;  // of the triangles' middles below the sphere
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        deepest = std::max(deepest, 1 - length(corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3);
      EXPECT_LE(deepest, mesh.chord);
      EXPECT_GT(deepest, mesh.chord / 20);  // the bound is one of this mesh
      EXPECT_TRUE(judge_mesh(mesh, request).watertight.is_closed());
      EXPECT_TRUE(judge_mesh(mesh, request).proved);
    }
}

// Two squares 1/1000 apart are matched only where the model says that they join; then the gap is part of the error.
TEST(TessellateModel, Law1_DeclaredJoinsAreTaken) {
  const std::string squares = R"~({"format":"patchproof-model","version":1,"units":"inch","patches":[
    {"degree":[1,1],"control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
    {"degree":[1,1],"control_points":[[[1.001,0,0],[1.001,1,0]],[[2,0,0],[2,1,0]]]}])~";
  const std::string join =
      R"~(,"joins":[{"a":{"patch":0,"edge":"u_max"},"b":{"patch":1,"edge":"u_min"},"reversed":false}])~";
  const auto apart = tessellate_model(read_good(squares + "}", "squares.json"), {}).value();
  const auto joined = tessellate_model(read_good(squares + join + "}", "squares.json"), {}).value();
  EXPECT_EQ(apart.units, "inch");
  EXPECT_EQ(apart.mesh.vertices.size(), 8U);
  EXPECT_EQ(check_watertight(apart.mesh).free, 8U);
  EXPECT_EQ(joined.mesh.vertices.size(), 6U);
  EXPECT_EQ(check_watertight(joined.mesh).free, 6U);
  EXPECT_TRUE(check_watertight(joined.mesh).is_watertight());
  EXPECT_LT(apart.mesh.gap, 1e-12);
  EXPECT_NEAR(joined.mesh.gap, 0.001, 1e-9);
  EXPECT_GE(joined.mesh.chord, joined.mesh.gap);
}

TEST(TessellateModel, Law1_NotesSayWhatWasExpandedSplitAndLeftOut) {
  const auto plane = tessellate_model(example("gerbs/plane.json"), {}).value();
  EXPECT_EQ(plane.notes, (std::vector<std::string>{"patch 0: GERBS surface, expanded exactly to degree (6, 6)"}));
  EXPECT_EQ(plane.mesh.triangles.size(), 2U);
  const auto torn =
      tessellate_model(read_good(json_patch("[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]],[[1,0,5],[1,1,5]],[[2,0,5],[2,1,5]]]",
                                            ",\n\"knots\":[[0,0,1,1,2,2],[0,0,1,1]]"),
                                 "torn.json"),
                       {});
  ASSERT_TRUE(torn) << torn.error().text();
  EXPECT_EQ(torn->mesh.faces, (std::vector<int>{0, 0, 1, 1}));
  ASSERT_EQ(torn->notes.size(), 1U);
  EXPECT_NE(torn->notes[0].find("in parts"), std::string::npos);
  const auto solid = tessellate_model(example("toolbox/solid.json"), {}).value();
  EXPECT_NE(std::find(solid.notes.begin(), solid.notes.end(), "left out: 1 solids"), solid.notes.end());
}

// A mesh of one triangle with a corner at x, whose chord error is all that was asked for.
ModelMesh triangle(double x, double chord) {
  ModelMesh out;
  out.mesh.vertices = {{{x, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  out.mesh.triangles = {{0, 1, 2}};
  out.mesh.faces = {0};
  out.mesh.free = {{0, 1}, {1, 2}, {2, 0}};
  out.mesh.chord = chord;
  return out;
}

TEST(TessellateModel, Law2_RoomForRounding) {
  struct Case {
    double x, chord;
    MeshFormat format;
    std::size_t calls;
  };
  const double rounding = rounding_of(triangle(1000, 0).mesh, MeshFormat::stl);
  EXPECT_GE(rounding, std::sqrt(3) * 1000 * 0x1p-24);
  EXPECT_LE(rounding, 1.001 * std::sqrt(3) * 1000 * 0x1p-24);
  for (const Case& c : {Case{1000, 1, MeshFormat::stl, 1}, Case{1000, 100 * rounding, MeshFormat::glb, 2},
                        Case{1000, 1.5 * rounding, MeshFormat::stl, 2}, Case{1000, 100 * rounding, MeshFormat::ply, 1},
                        Case{1000, 0.9 * rounding, MeshFormat::stl, 1}}) {
    std::vector<double> asked;
    MeshRequest request;
    request.chord = c.chord;
    request.angle = 17;
    const auto made = mesh_for_file(c.format, request, [&](const MeshRequest& r) -> Result<ModelMesh> {
      asked.push_back(r.chord);
      EXPECT_EQ(r.angle, 17);
      return triangle(c.x, r.chord);
    });
    ASSERT_TRUE(made);
    EXPECT_EQ(asked.size(), c.calls);
    EXPECT_TRUE(is_single_precision(c.format) ? asked[0] < c.chord : asked[0] == c.chord);
    const bool possible = !is_single_precision(c.format) || rounding < c.chord;
    EXPECT_EQ(made->mesh.chord + rounding_of(made->mesh, c.format) <= c.chord, possible);
    EXPECT_EQ(judge_mesh(made->mesh, request, c.format).proved, possible);
  }
  const auto failed = mesh_for_file(MeshFormat::stl, {}, [](const MeshRequest&) -> Result<ModelMesh> {
    return Error{ErrorCode::bad_number, "there", "", ""};
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().where, "there");

  const ModelFile cylinder = example("cylinder.json");  // where the first attempt leaves too little room
  MeshRequest request;
  request.chord = 3e-5;
  std::size_t calls = 0;
  const auto made = mesh_for_file(MeshFormat::stl, request, [&](const MeshRequest& r) {
    ++calls;
    return tessellate_model(cylinder, r);
  });
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_LE(calls, 2U);
  EXPECT_TRUE(judge_mesh(made->mesh, request, MeshFormat::stl).proved);
  EXPECT_GT(judge_mesh(made->mesh, request, MeshFormat::stl).rounding, 0);
}

float float_at(const std::string& bytes, std::size_t at) {
  float x;
  std::memcpy(&x, bytes.data() + at, sizeof x);
  return x;
}

TEST(TessellateModel, Law3_FilesHoldTheMesh) {
  MeshRequest request;
  request.chord = 0.05;
  const CertifiedMesh mesh = tessellate_model(example("torus.json"), request).value().mesh;
  const std::string stl = write_mesh(mesh, "torus", MeshFormat::stl).value();
  ASSERT_EQ(stl.size(), 84 + 50 * mesh.triangles.size());
  const double rounding = rounding_of(mesh, MeshFormat::stl);
  double farthest = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      Vec<double, 3> away;
      for (std::size_t c = 0; c < 3; ++c)
        away[c] = float_at(stl, 84 + 50 * t + 12 + 12 * i + 4 * c) - corner(mesh, t, i)[c];
      farthest = std::max(farthest, length(away));
    }
  EXPECT_LE(farthest, rounding);
  EXPECT_GT(farthest, rounding / 20);

  std::istringstream obj(write_mesh(mesh, "torus", MeshFormat::obj).value());
  std::size_t vertices = 0, triangles = 0;
  for (std::string word; obj >> word;) {
    if (word == "v") {
      for (std::size_t c = 0; c < 3; ++c) {
        obj >> word;
        EXPECT_EQ(std::stod(word), mesh.vertices[vertices][c]);
      }
      ++vertices;
    } else if (word == "f") {
      for (int i = 0; i < 3; ++i) {
        obj >> word;
        EXPECT_EQ(std::stoi(word), mesh.triangles[triangles][i] + 1);
      }
      ++triangles;
    }
  }
  EXPECT_EQ(vertices, mesh.vertices.size());
  EXPECT_EQ(triangles, mesh.triangles.size());

  const std::string ply = write_mesh(mesh, "torus", MeshFormat::ply).value();
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::glb, MeshFormat::vtu})
    EXPECT_NE(write_mesh(mesh, "torus", format).value().find(format == MeshFormat::vtu ? "VTKFile" : "torus"),
              std::string::npos);
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::vtu})
    EXPECT_EQ(rounding_of(mesh, format), 0);
  CertifiedMesh far = triangle(1e39, 0).mesh;
  EXPECT_EQ(write_mesh(far, "", MeshFormat::stl).error().code, ErrorCode::bad_number);
  EXPECT_EQ(mesh_format_of(".vtu"), MeshFormat::vtu);
  for (const char* extension : {"", "stl", ".STL", ".png"}) EXPECT_FALSE(mesh_format_of(extension)) << extension;
}

TEST(TessellateModel, Law4_OnlyWholeMeshesAreProved) {
  MeshRequest request;
  request.chord = 0.05;
  request.angle = 25;
  const CertifiedMesh mesh = tessellate_model(example("torus.json"), request).value().mesh;
  EXPECT_TRUE(judge_mesh(mesh, request).proved);
  EXPECT_TRUE(judge_mesh(mesh, request, MeshFormat::obj).proved);
  const auto is_proved = [&](auto change) {
    CertifiedMesh changed = mesh;
    change(changed);
    return judge_mesh(changed, request).proved;
  };
  EXPECT_FALSE(is_proved([](CertifiedMesh& m) { m.triangles.pop_back(), m.faces.pop_back(); }));
  EXPECT_FALSE(is_proved([](CertifiedMesh& m) { m.triangles.push_back(m.triangles[0]), m.faces.push_back(0); }));
  EXPECT_FALSE(is_proved([](CertifiedMesh& m) { m.chord_misses = 1; }));
  EXPECT_FALSE(is_proved([](CertifiedMesh& m) { m.angle_misses = 1; }));
  EXPECT_FALSE(is_proved([](CertifiedMesh& m) { m.chord = std::nextafter(0.05, 1); }));
  EXPECT_FALSE(is_proved([](CertifiedMesh& m) { m.chord = std::numeric_limits<double>::infinity(); }));
  CertifiedMesh tight = mesh;
  tight.chord = 0.05;  // without room for single precision
  EXPECT_TRUE(judge_mesh(tight, request, MeshFormat::ply).proved);
  EXPECT_FALSE(judge_mesh(tight, request, MeshFormat::stl).proved);
}

TEST(TessellateModel, Law5_JobsDoNotMatter) {
  std::set<std::string> bytes;
  for (const int jobs : {0, 1, 7}) {
    MeshRequest request;
    request.chord = 0.05;
    request.jobs = jobs;
    bytes.insert(
        write_mesh(tessellate_model(example("torus_q.json"), request).value().mesh, "", MeshFormat::ply).value());
  }
  EXPECT_EQ(bytes.size(), 1U);
}

TEST(TessellateModel, Errors) {
  struct Case {
    const char* model;
    MeshRequest request;
    ErrorCode code;
    const char* where;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Case& c : {Case{"toolbox/knots.json", {}, ErrorCode::unsupported, "tessellate"},
                        Case{"gerbs/torus.json", {}, ErrorCode::unsupported, "patch 0"},
                        Case{"torus.json", {nan, 180, 1000, 1}, ErrorCode::usage, nullptr},
                        Case{"gerbs/torus.json", {0, 180, 1000, 1}, ErrorCode::usage, nullptr},
                        Case{"torus.json", {1, -1, 1000, 1}, ErrorCode::usage, nullptr},
                        Case{"torus.json", {1e-6, 180, 100, 1}, ErrorCode::usage, nullptr}}) {
    const auto made = tessellate_model(example(c.model), c.request);
    ASSERT_FALSE(made) << c.model;
    EXPECT_EQ(made.error().code, c.code) << made.error().text();
    if (c.where != nullptr) {
      EXPECT_EQ(made.error().where, c.where);
    }
  }
  const std::atomic<bool> flag{true};
  const StopScope scope(&flag);
  EXPECT_THROW((void)tessellate_model(example("torus_q.json"), {}), std::runtime_error);
}

}  // namespace
}  // namespace patchproof::test
