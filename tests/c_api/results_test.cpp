// SPDX-License-Identifier: Apache-2.0
// Reports, fills and meshes through the C API are those of the C++ library.
#include <cstring>
#include <sstream>

#include "c_api/owned.h"
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/io/fill_model.h"
#include "patchproof/io/read.h"
#include "patchproof/io/report.h"
#include "patchproof/io/tessellate_model.h"
#include "patchproof/io/write.h"

namespace patchproof::test {
namespace {

class CApiResults : public testing::Test {
 protected:
  Owned<patchproof_context> context_ = make_context();
  patchproof_context* c() const { return context_.get(); }
  Owned<patchproof_report> certify(const Owned<patchproof_model>& model, const patchproof_certify_options* options,
                                   const patchproof_callback* callback = nullptr) const {
    return owned<patchproof_report>(
        context_, [&](auto out) { return patchproof_certify(c(), model.get(), options, callback, out); });
  }
  std::string text_of_report(const Owned<patchproof_report>& report, std::int32_t format) const {
    return written([&](char* b, std::size_t n, std::size_t* needed) {
      return patchproof_report_write(c(), report.get(), format, b, n, needed);
    });
  }
};

TEST_F(CApiResults, ReportsAreThoseOfTheLibrary) {
  for (const char* name :
       {"cup.json", "sphere_octants.json", "torus_q.json", "gerbs/heart.json", "toolbox/test12.json"}) {
    const Owned<patchproof_model> model = read_example(context_, name);
    patchproof_certify_options options = sized<patchproof_certify_options>();
    options.require = PATCHPROOF_CLASS_G1;
    options.has_gap = 1;
    options.gap_tolerance = 0.5;
    CertifyOptions expected_options;
    expected_options.request.require = Continuity::g1;
    expected_options.request.gap_tolerance = 0.5;
    expected_options.given = expected_options.request;
    const Report expected = certify_model(*read_model(example(name)), expected_options);
    std::ostringstream json, table;
    write_json(json, expected);
    write_table(table, expected);

    struct Last {
      std::uint64_t done = 0, all = 0;
    } last;
    const patchproof_callback callback{&last, [](void* user, std::uint64_t done, std::uint64_t all) {
                                         *static_cast<Last*>(user) = {done, all};
                                         return 0;
                                       }};
    options.jobs = 2;
    const Owned<patchproof_report> report = certify(model, &options, &callback);
    EXPECT_EQ(text_of_report(report, PATCHPROOF_REPORT_JSON), json.str()) << name;
    EXPECT_EQ(text_of_report(report, PATCHPROOF_REPORT_TABLE), table.str()) << name;
    EXPECT_EQ(last.done, last.all) << name;

    patchproof_report_summary summary = sized<patchproof_report_summary>();
    ASSERT_EQ(patchproof_report_get_summary(c(), report.get(), &summary), PATCHPROOF_OK);
    EXPECT_EQ(summary.joins, expected.joins.size());
    EXPECT_EQ(summary.passed + summary.failed + summary.undecided, summary.joins);
    EXPECT_EQ(summary.outcome, expected.outcome() == Outcome::pass   ? PATCHPROOF_OUTCOME_PASS
                               : expected.outcome() == Outcome::fail ? PATCHPROOF_OUTCOME_FAIL
                                                                     : PATCHPROOF_OUTCOME_UNDECIDED);
    for (std::size_t i = 0; i < summary.joins; ++i) {
      patchproof_join_report join = sized<patchproof_join_report>();
      ASSERT_EQ(patchproof_report_get_join(c(), report.get(), i, &join), PATCHPROOF_OK);
      const ReportedJoin& e = expected.joins[i];
      EXPECT_EQ(join.a.patch, e.a.patch);
      EXPECT_EQ(string_of(join.b.edge), e.b.edge);
      EXPECT_EQ(string_of(join.b.range[1]), e.b.exact_end);
      EXPECT_EQ(join.g1.verdict, static_cast<int>(e.certificate.g1.verdict));
      EXPECT_EQ(string_of(join.g1.reason), e.certificate.g1.reason);
      EXPECT_EQ(join.c2.verdict, static_cast<int>(e.certificate.c2.verdict));
      EXPECT_EQ(join.gap.upper, e.certificate.gap.upper);
      EXPECT_EQ(join.angle.lower, e.certificate.angle.lower);
      EXPECT_EQ(join.angle.point[1], e.certificate.angle.at.point[1]);
      EXPECT_EQ(join.orientation, static_cast<int>(e.certificate.orientation));
      EXPECT_LE(join.angle.upper, summary.largest_angle[1]);
      patchproof_witness witness = sized<patchproof_witness>();
      ASSERT_EQ(patchproof_report_get_witness(c(), report.get(), i, PATCHPROOF_CLASS_G1, &witness), PATCHPROOF_OK);
      ASSERT_EQ(witness.found == 1, e.certificate.g1.witness.has_value());
      if (witness.found) {
        EXPECT_EQ(string_of(witness.quantity), e.certificate.g1.witness->quantity);
        std::string values;
        for (const std::string& x : e.certificate.g1.witness->values) values += x + "\n";
        EXPECT_EQ(string_of(witness.values), values);
      }
      EXPECT_EQ(patchproof_report_get_witness(c(), report.get(), i, 7, &witness), PATCHPROOF_BAD_ARGUMENT);
    }
    patchproof_join_report join = sized<patchproof_join_report>();
    EXPECT_EQ(patchproof_report_get_join(c(), report.get(), summary.joins, &join), PATCHPROOF_BAD_ARGUMENT);
  }
}

TEST_F(CApiResults, JoinsOfCurvesAreThoseOfTheLibrary) {
  for (const char* name : {"toolbox/test12.json", "toolbox/conics.json", "toolbox/quarter_circle.json"}) {
    const Report expected = certify_model(*read_model(example(name)));
    const Owned<patchproof_report> report = certify(read_example(context_, name), nullptr);
    const std::size_t count = expected.curves ? expected.curves->joins.size() : 0;
    patchproof_report_summary summary = sized<patchproof_report_summary>();
    ASSERT_EQ(patchproof_report_get_summary(c(), report.get(), &summary), PATCHPROOF_OK);
    EXPECT_EQ(summary.curve_joins, count);
    EXPECT_EQ(summary.curve_passed + summary.curve_failed + summary.curve_undecided, count);
    patchproof_curve_join_report join = sized<patchproof_curve_join_report>();
    for (std::size_t i = 0; i < count; ++i) {
      const ReportedCurveJoin& e = expected.curves->joins[i];
      ASSERT_EQ(patchproof_report_get_curve_join(c(), report.get(), i, &join), PATCHPROOF_OK);
      EXPECT_EQ(join.id, e.id);
      EXPECT_EQ(join.curve_a, static_cast<int>(e.a.of.curve));
      EXPECT_EQ(join.end_b, e.b.of.end == CurveEnd::end ? 1 : 0);
      EXPECT_EQ(join.g2.verdict, static_cast<int>(e.certificate.g2.verdict));
      EXPECT_EQ(string_of(join.c1.reason), e.certificate.c1.reason);
      EXPECT_EQ(join.gap[1], e.certificate.gap.upper);
      EXPECT_EQ(join.angle[0], e.certificate.angle ? e.certificate.angle->lower : 0);
    }
    EXPECT_EQ(patchproof_report_get_curve_join(c(), report.get(), count, &join), PATCHPROOF_BAD_ARGUMENT);
  }
}

// From arrays: a plane is smooth, a kink is refuted with a witness and its angle; a declared join is taken as it is.
TEST_F(CApiResults, JoinsOfArrays) {
  for (const double lift : {0.0, 0.25}) {
    TwoSquares squares(lift);
    const patchproof_declared_join declared{0, PATCHPROOF_EDGE_U_MAX, 1, PATCHPROOF_EDGE_U_MIN, 0};
    for (const bool declare : {false, true}) {
      squares.data.joins = declare ? &declared : nullptr;
      squares.data.joins_length = declare ? 1 : 0;
      const Owned<patchproof_model> model = squares.make(context_);
      const Owned<patchproof_report> report = certify(model, nullptr);
      patchproof_join_report join = sized<patchproof_join_report>();
      ASSERT_EQ(patchproof_report_get_join(c(), report.get(), 0, &join), PATCHPROOF_OK);
      EXPECT_EQ(join.c0.verdict, PATCHPROOF_VERDICT_PROVEN);
      EXPECT_EQ(join.c1.verdict, lift == 0 ? PATCHPROOF_VERDICT_PROVEN : PATCHPROOF_VERDICT_REFUTED);
      EXPECT_EQ(join.g1.verdict, lift == 0 ? PATCHPROOF_VERDICT_PROVEN : PATCHPROOF_VERDICT_REFUTED);
      EXPECT_EQ(string_of(join.ratio), lift == 0 ? "1" : "");
      EXPECT_LE(join.angle.lower, lift * 180);  // atan(1) = 45 degrees
      EXPECT_GE(join.angle.upper, lift * 180);
    }
  }
}

// Thresholds by name are those of the library; what is given itself counts instead.
TEST_F(CApiResults, ProfilesAndCurvature) {
  TwoSquares squares(0.25);
  squares.data.units = patchproof_from("mm");
  const Owned<patchproof_model> model = squares.make(context_);
  patchproof_certify_options options = sized<patchproof_certify_options>();
  options.profile = patchproof_from("vda4955");
  const auto outcome = [&] {
    patchproof_report_summary summary = sized<patchproof_report_summary>();
    EXPECT_EQ(patchproof_report_get_summary(c(), certify(model, &options).get(), &summary), PATCHPROOF_OK);
    return summary.outcome;
  };
  EXPECT_EQ(outcome(), PATCHPROOF_OUTCOME_FAIL);  // 45 degrees
  options.has_angle = 1;
  options.angle_tolerance = 50;
  EXPECT_EQ(outcome(), PATCHPROOF_OUTCOME_PASS);
  patchproof_report* none = nullptr;
  options.profile = patchproof_from("none such");
  EXPECT_EQ(patchproof_certify(c(), model.get(), &options, nullptr, &none), PATCHPROOF_BAD_ARGUMENT);
  squares.data.units = patchproof_from("cubits");
  options.profile = patchproof_from("vda4955");
  const Owned<patchproof_model> odd = squares.make(context_);
  EXPECT_EQ(patchproof_certify(c(), odd.get(), &options, nullptr, &none), PATCHPROOF_BAD_DATA);
  EXPECT_EQ(none, nullptr);

  const Owned<patchproof_model> curves = read_example(context_, "toolbox/quarter_circle.json");
  patchproof_certify_options curvature = sized<patchproof_certify_options>();
  curvature.has_curvature = 1;
  curvature.curvature_tolerance = -1;
  EXPECT_EQ(patchproof_certify(c(), curves.get(), &curvature, nullptr, &none), PATCHPROOF_BAD_ARGUMENT);
  curvature.curvature_tolerance = 0.25;
  EXPECT_NE(text_of_report(certify(curves, &curvature), PATCHPROOF_REPORT_JSON).find("0.25"), std::string::npos);
}

TEST_F(CApiResults, FillsAreThoseOfTheLibrary) {
  const std::string path = example("meshes/football.json"), bytes = bytes_of(path);
  patchproof_fill_summary summary = sized<patchproof_fill_summary>();
  const auto model = owned<patchproof_model>(context_, [&](auto out) {
    return patchproof_fill(c(), text_of(bytes), text_of(path), nullptr, nullptr, out, &summary);
  });
  const Result<CurveMeshFile> file = read_curve_mesh(path);
  ASSERT_TRUE(file);
  const Result<FilledModel> expected = fill_model(file->mesh, {}, file->units);
  ASSERT_TRUE(expected);
  EXPECT_EQ(written([&](char* b, std::size_t n, std::size_t* needed) {
              return patchproof_model_write(c(), model.get(), PATCHPROOF_FORMAT_JSON, b, n, needed);
            }),
            write_model_json(expected->model));
  std::size_t needed = 0;
  EXPECT_EQ(patchproof_model_write(c(), model.get(), PATCHPROOF_FORMAT_G2, nullptr, 0, &needed), PATCHPROOF_BAD_DATA)
      << "no silent approximation";
  EXPECT_EQ(summary.faces, expected->faces.size());
  EXPECT_EQ(summary.smooth_edges, expected->smooth);
  EXPECT_EQ(summary.g1[PATCHPROOF_VERDICT_PROVEN], static_cast<std::size_t>(expected->g1.proven));
  EXPECT_EQ(summary.regular[PATCHPROOF_VERDICT_UNDECIDED], static_cast<std::size_t>(expected->regular.undecided));
  patchproof_model* none = nullptr;
  EXPECT_EQ(patchproof_fill(c(), patchproof_from("{\"format\": 1}"), patchproof_from("wrong"), nullptr, nullptr, &none,
                            nullptr),
            PATCHPROOF_BAD_DATA);
  patchproof_fill_options options = sized<patchproof_fill_options>();
  options.repairs = 1;
  options.repair_angle = 31;
  EXPECT_EQ(patchproof_fill(c(), text_of(bytes), {}, &options, nullptr, &none, nullptr), PATCHPROOF_BAD_ARGUMENT);
  EXPECT_EQ(none, nullptr);
}

TEST_F(CApiResults, MeshesAreThoseOfTheLibrary) {
  const Owned<patchproof_model> model = read_example(context_, "cup.json");
  const Result<ModelFile> file = read_model(example("cup.json"));
  for (const std::int32_t method : {PATCHPROOF_METHOD_ADAPTIVE, PATCHPROOF_METHOD_REGULAR}) {
    patchproof_tessellate_options options = sized<patchproof_tessellate_options>();
    options.chord = 0.5;
    options.angle = 30;
    options.method = method;
    const auto mesh = owned<patchproof_mesh>(
        context_, [&](auto out) { return patchproof_tessellate(c(), model.get(), &options, nullptr, out); });
    const Result<ModelMesh> expected = tessellate_model(
        *file, {0.5, 30}, method == PATCHPROOF_METHOD_ADAPTIVE ? CellMethod::adaptive : CellMethod::regular);
    ASSERT_TRUE(expected);
    patchproof_mesh_info info = sized<patchproof_mesh_info>();
    ASSERT_EQ(patchproof_mesh_get_info(c(), mesh.get(), &info), PATCHPROOF_OK);
    EXPECT_EQ(info.vertices, expected->mesh.vertices.size());
    EXPECT_EQ(info.triangles, expected->mesh.triangles.size());
    EXPECT_EQ(info.chord, expected->mesh.chord);
    EXPECT_EQ(info.cracks, 0u);
    std::vector<double> vertices(3 * info.vertices);
    std::vector<std::int32_t> triangles(3 * info.triangles), patches(info.triangles);
    ASSERT_EQ(patchproof_mesh_get_data(c(), mesh.get(), vertices.data(), vertices.size(), triangles.data(),
                                       triangles.size(), patches.data(), patches.size()),
              PATCHPROOF_OK);
    EXPECT_EQ(vertices[4], expected->mesh.vertices[1][1]);
    EXPECT_EQ(triangles[5], expected->mesh.triangles[1][2]);
    EXPECT_EQ(patches.back(), expected->mesh.faces.back());
    vertices[0] = 1e77;
    EXPECT_EQ(patchproof_mesh_get_data(c(), mesh.get(), vertices.data(), vertices.size(), triangles.data(),
                                       triangles.size() - 1, nullptr, 0),
              PATCHPROOF_BAD_ARGUMENT);
    EXPECT_EQ(vertices[0], 1e77);
    for (const MeshFormat format :
         {MeshFormat::stl, MeshFormat::obj, MeshFormat::ply, MeshFormat::glb, MeshFormat::vtu})
      EXPECT_EQ(written([&](char* b, std::size_t n, std::size_t* needed) {
                  return patchproof_mesh_write(c(), mesh.get(), static_cast<std::int32_t>(format), b, n, needed);
                }),
                *write_mesh(expected->mesh, "patchproof", format));
  }
  const Owned<patchproof_model> curves = read_example(context_, "toolbox/test12.json");
  patchproof_tessellate_options options = sized<patchproof_tessellate_options>();
  options.chord = 1;
  patchproof_mesh* none = nullptr;
  EXPECT_EQ(patchproof_tessellate(c(), curves.get(), &options, nullptr, &none), PATCHPROOF_BAD_DATA);
  EXPECT_EQ(none, nullptr);
}

}  // namespace
}  // namespace patchproof::test
