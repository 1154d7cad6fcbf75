// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/fill_model.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <map>
#include <set>

#include "io/io_support.h"
#include "patchproof/deadline.h"
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/io/report.h"
#include "patchproof/io/write.h"
#include "patchproof/parallel.h"

namespace patchproof::test {
namespace {

std::string text_of(const std::string& name) {
  return bytes_of(std::string(PATCHPROOF_SOURCE_DIR) + "/examples/meshes/" + name);
}
CurveMesh mesh_of(const std::string& text) {
  Result<CurveMeshFile> file = read_curve_mesh_text(text, "mesh.json");
  if (!file) throw std::runtime_error(file.error().text());
  return std::move(file->mesh);
}
CurveMesh two_faces() { return mesh_of(text_of("two_faces.json")); }
// two_faces.json with one text in place of another.
CurveMesh changed(const std::string& old, const std::string& with) {
  std::string text = text_of("two_faces.json");
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::runtime_error("two_faces.json lacks " + old);
  return mesh_of(text.replace(at, old.size(), with));
}
// One coordinate rounded: its tangent planes miss one another by some thousandths of a degree.
CurveMesh rounded() { return changed("[-2, \"1/3\", \"1/3\"]", "[-2, 0.3333, 0.3334]"); }

FilledModel filled(CurveMesh mesh, const FillRequest& request = {}) {
  Result<FilledModel> out = fill_model(std::move(mesh), request, "mm");
  if (!out) throw std::runtime_error(out.error().text());
  return std::move(*out);
}

// The model, certified by itself, joins as the findings say: G1 at all smooth edges, C1 inside, regular.
void expect_certified(const FilledModel& made) {
  ModelFile file;
  file.model = made.model;
  const Report report = certify_model(file);
  std::map<Verdict, int> g1;
  for (const ReportedJoin& join : report.joins)
    if (join.kind != JoinKind::knot_line) ++g1[join.certificate.g1.verdict];
  int sharp = 0;
  for (const FilledJoin& join : made.joins) sharp += join.kind == EdgeKind::sharp;
  EXPECT_EQ(g1[Verdict::proven], made.g1.proven);
  EXPECT_EQ(g1[Verdict::refuted], made.g1.refuted + sharp);
  ASSERT_EQ(report.gregory_patches.size(), made.faces.size());
  for (std::size_t f = 0; f < made.faces.size(); ++f) {
    EXPECT_EQ(report.gregory_patches[f].proof.is_c1(), made.faces[f].proof.is_c1());
    EXPECT_EQ(report.gregory_patches[f].proof.regular.verdict, made.faces[f].proof.regular.verdict);
  }
}

TEST(FillModel, Law1_OnePatchForEachFaceAndCertifyAgrees) {
  const FilledModel two = filled(two_faces());
  EXPECT_EQ(two.model.units, "mm");
  ASSERT_EQ(two.model.gregory_patches.size(), 2U);
  EXPECT_EQ(two.model.gregory_patches[0].name, "F1");
  EXPECT_EQ(two.model.gregory_patches[1].name, "F2");
  EXPECT_EQ(evaluate(two.model.gregory_patches[0].patch, Rational(0), Rational(0)),
            (Vec<Rational, 3>{{Rational(-6), Rational(0), Rational(0)}}));
  EXPECT_EQ(two.verdict(), Verdict::proven);
  expect_certified(two);
  const FilledModel mixed = filled(mesh_of(text_of("mixed_faces.json")));
  ASSERT_EQ(mixed.model.gregory_patches.size(), mixed.mesh.faces.size());
  for (std::size_t f = 0; f < mixed.mesh.faces.size(); ++f)
    EXPECT_EQ(mixed.model.gregory_patches[f].name, mixed.mesh.faces[f].id);
  EXPECT_EQ(mixed.verdict(), Verdict::proven);
  EXPECT_EQ(mixed.boundary, 0U);
  expect_certified(mixed);
}

TEST(FillModel, Law2_TheMeshIsRepairedOnRequestAndSplitWhereNeeded) {
  const FilledModel plain = filled(two_faces());
  EXPECT_FALSE(plain.repair);
  EXPECT_FALSE(plain.split);
  EXPECT_EQ(write_curve_mesh(plain.mesh), write_curve_mesh(two_faces()));

  FillRequest request;
  request.repair_degrees = 0.1;
  const FilledModel repaired = filled(rounded(), request);
  ASSERT_TRUE(repaired.repair);
  EXPECT_GT(repaired.repair->moved, 0U);
  EXPECT_GT(repaired.repair->largest, 0);
  EXPECT_LT(repaired.repair->largest, 0.01);
  EXPECT_FALSE(repaired.repair->edges.empty());
  EXPECT_TRUE(std::is_sorted(repaired.repair->edges.begin(), repaired.repair->edges.end()));
  EXPECT_EQ(repaired.smooth, 1U);
  EXPECT_NE(write_curve_mesh(repaired.mesh), write_curve_mesh(rounded()));
  request.repair_degrees = 1e-6;
  const FilledModel little = filled(rounded(), request);
  ASSERT_TRUE(little.repair);
  EXPECT_EQ(little.repair->moved, 0U);
  EXPECT_FALSE(little.repair->vertices.empty());
  EXPECT_EQ(little.sharp, 1U);

  const FilledModel ball = filled(mesh_of(text_of("football.json")));
  ASSERT_TRUE(ball.split);
  EXPECT_EQ(ball.split->faces, 32U);
  EXPECT_EQ(ball.split->before, 32U);
  EXPECT_EQ(ball.split->after, 180U);  // 12 · 5 + 20 · 6
  EXPECT_EQ(ball.mesh.faces.size(), 180U);
  EXPECT_EQ(ball.smooth, ball.mesh.edges.size());
  EXPECT_EQ(ball.g1.proven, 360);
  EXPECT_EQ(ball.verdict(), Verdict::proven);
}

TEST(FillModel, Law3_JoinsOfEdges) {
  const FilledModel two = filled(two_faces());
  ASSERT_EQ(two.joins.size(), 1U);
  const FilledJoin& join = two.joins[0];
  EXPECT_EQ(join.edge, "E0");
  EXPECT_EQ((std::set<std::string>{join.face_a, join.face_b}), (std::set<std::string>{"F1", "F2"}));
  EXPECT_EQ(join.kind, EdgeKind::smooth);
  EXPECT_EQ(join.verdict, Verdict::proven);
  EXPECT_EQ(join.angle.upper, 0);

  const FilledModel sharp = filled(rounded());
  ASSERT_EQ(sharp.joins.size(), 1U);
  EXPECT_EQ(sharp.joins[0].kind, EdgeKind::sharp);
  EXPECT_EQ(sharp.joins[0].verdict, Verdict::refuted);
  EXPECT_GT(sharp.joins[0].angle_at_nodes, 0);
  EXPECT_LT(sharp.joins[0].angle_at_nodes, 0.1);
  EXPECT_GT(sharp.joins[0].angle.lower, 0);
  EXPECT_LE(sharp.joins[0].angle_at_nodes, sharp.joins[0].angle.upper * (1 + 1e-6));
  EXPECT_FALSE(sharp.joins[0].reason.empty());
}

TEST(FillModel, Law4_TalliesCount) {
  const FilledModel sharp = filled(rounded());  // a sharp edge is nobody's fault
  EXPECT_EQ(sharp.g1.proven + sharp.g1.refuted + sharp.g1.undecided, 0);
  EXPECT_EQ(sharp.verdict(), Verdict::proven);
  EXPECT_EQ(sharp.smooth + sharp.sharp + sharp.boundary, sharp.mesh.edges.size());
  FillRequest former;
  former.method = FillMethod::former;
  const FilledModel kinked = filled(two_faces(), former);
  EXPECT_EQ(kinked.g1.proven, 1);
  EXPECT_EQ(kinked.c1.refuted, 2);
  EXPECT_EQ(kinked.c1.proven, 0);
  EXPECT_EQ(kinked.regular.proven, 2);
  EXPECT_EQ(kinked.verdict(), Verdict::refuted);
  expect_certified(kinked);
  FilledModel undecided = filled(two_faces());
  undecided.regular.add(Verdict::undecided);
  EXPECT_EQ(undecided.verdict(), Verdict::undecided);
  undecided.g1.add(Verdict::refuted);
  EXPECT_EQ(undecided.verdict(), Verdict::refuted);
}

TEST(FillModel, Law5_JobsDoNotMatter) {
  std::set<std::string> models;
  for (const int jobs : {0, 1, 7}) {
    FillRequest request;
    request.jobs = jobs;
    models.insert(write_model_json(filled(mesh_of(text_of("mixed_faces.json")), request).model));
  }
  EXPECT_EQ(models.size(), 1U);
}

// Left to itself the scale is `rational` where faces are to be split or there are T-nodes, and `none` for two_faces.json.
TEST(FillModel, TheScaleFollowsTheMesh) {
  const CurveMesh mixed = mesh_of(text_of("mixed_faces.json"));
  const CurveMesh split = filled(mixed).mesh;  // with T-nodes, and faces of four sides only
  for (const CurveMesh& mesh : {two_faces(), mixed, split}) {
    std::map<int, std::string> models;
    for (const int scale : {-1, 0, 1}) {
      FillRequest request;
      if (scale >= 0) request.scale = scale == 0 ? NodeScale::none : NodeScale::rational;
      models[scale] = write_model_json(filled(mesh, request).model);
    }
    EXPECT_NE(models[0], models[1]);
    EXPECT_EQ(models[-1], models[mesh.faces.size() == 2 ? 0 : 1]);
  }
}

TEST(FillModel, Errors) {
  for (const double degrees : {-0.1, 30.1, std::numeric_limits<double>::quiet_NaN()}) {
    FillRequest request;
    request.repair_degrees = degrees;
    const auto made = fill_model(two_faces(), request);
    ASSERT_FALSE(made) << degrees;
    EXPECT_EQ(made.error().code, ErrorCode::usage);
    EXPECT_EQ(made.error().where, "repair");
  }
  const auto apart = fill_model(changed("\"point\": [0, 9, 0]", "\"point\": [0, 9, 1]"));
  ASSERT_FALSE(apart);
  EXPECT_EQ(apart.error().code, ErrorCode::ends_apart);
  EXPECT_NE(apart.error().where.find("E0"), std::string::npos);
  const auto bent = fill_model(changed("\"right\": [6, 0, -3]", "\"right\": [6, 0, -2]"));
  ASSERT_FALSE(bent);
  EXPECT_EQ(bent.error().code, ErrorCode::control_vectors_bent);
  const std::atomic<bool> flag{true};
  const StopScope scope(&flag);
  EXPECT_THROW((void)fill_model(two_faces()), stop_requested);
}

}  // namespace
}  // namespace patchproof::test
