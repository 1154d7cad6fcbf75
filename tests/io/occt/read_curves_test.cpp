// SPDX-License-Identifier: Apache-2.0
// Edges of no face: read as curves, joined within a file and across files.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <gp_Circ.hxx>

#include <cmath>
#include <random>

#include "io/occt/parts.h"
#include "patchproof/io/curve_files.h"
#include "patchproof/spline/homogeneous.h"
#include "patchproof/spline/smoothness.h"

namespace patchproof::test {
namespace {

opencascade::handle<Geom_BezierCurve> cubic() {
  TColgp_Array1OfPnt poles(1, 4);
  poles(1) = gp_Pnt(0, 0, 0);
  poles(2) = gp_Pnt(1, 2, 0.1);
  poles(3) = gp_Pnt(3, 2, 1);
  poles(4) = gp_Pnt(4, 0, 1.0 / 3);
  return new Geom_BezierCurve(poles);
}

TEST_F(CadFiles, CurvesOfNoFaceAreReadExactly) {
  const CadModel model = read(write_brep(BRepBuilderAPI_MakeEdge(cubic(), 0.1, 0.7).Edge()));
  ASSERT_EQ(model.curves.size(), 1u);
  EXPECT_TRUE(model.faces.empty() && model.edges.empty() && model.notes.empty());
  EXPECT_EQ(model.curves[0].label, "edge 1");
  EXPECT_EQ(model.curves[0].kind, "bezier");
  EXPECT_GT(model.curves[0].tolerance[0], 0);
  const auto& curve = model.curves[0].curve;
  EXPECT_EQ(curve.knots().domain_begin(), from_double(0.1));
  EXPECT_EQ(curve.knots().domain_end(), from_double(0.7));
  // The whole Bézier curve with exact numbers, cut there.
  const Rational t = from_double(0.4);
  const std::array<double, 3> z{0.1, 1, 1.0 / 3};
  const Rational s = Rational(1) - t;
  const Rational x = Rational(3) * s * s * t + Rational(9) * s * t * t + Rational(4) * t * t * t;
  const Rational h = Rational(3) * s * s * t * from_double(z[0]) + Rational(3) * s * t * t * from_double(z[1]) +
                     t * t * t * from_double(z[2]);
  const Vec<Rational, 3> p = evaluate_rational(curve, t);
  EXPECT_EQ(p[0], x);
  EXPECT_EQ(p[2], h);
}

TEST_F(CadFiles, LinesAndCirclesAndNotes) {
  BRepBuilderAPI_MakePolygon square(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0), gp_Pnt(1, 1, 0), gp_Pnt(0, 1, 0), true);
  for (const std::string& file : {write_brep(square.Wire()), write_step(square.Wire())}) {
    const CadModel model = read(file);
    ASSERT_EQ(model.curves.size(), 4u) << file;
    EXPECT_TRUE(model.edges.empty());
    EXPECT_EQ(model.curves[0].kind, "line");
    const Report report = certify_cad(model);
    ASSERT_EQ(report.curves->joins.size(), 4u);
    EXPECT_TRUE(report.curves->free.empty());
    for (const ReportedCurveJoin& join : report.curves->joins) {
      EXPECT_EQ(join.edge_class, EdgeClass::sharp);
      EXPECT_LE(join.certificate.angle->lower, 90);
      EXPECT_GE(join.certificate.angle->upper, 90);
    }
  }
  const gp_Circ circle(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 2);
  const CadModel arc = read(write_brep(BRepBuilderAPI_MakeEdge(circle).Edge()));
  ASSERT_EQ(arc.curves.size(), 1u);
  ASSERT_EQ(arc.notes.size(), 1u);
  EXPECT_NE(arc.notes[0].find("circle"), std::string::npos);
  const Report closed = certify_cad(arc);
  ASSERT_EQ(closed.curves->joins.size(), 1u);
  EXPECT_LE(closed.curves->joins[0].certificate.angle->upper, 1e-12);
  EXPECT_LE(closed.curves->joins[0].certificate.curvature_difference->upper, 1e-12);
  EXPECT_NEAR(closed.curves->joins[0].certificate.curvature[0]->upper, 0.5, 1e-12);
}

TEST_F(CadFiles, TwoPartsOfOneSplineAreOneFunction) {
  const auto write = [&](double from, double to, const char* name) {
    BRepTools::Write(BRepBuilderAPI_MakeEdge(cubic(), from, to).Edge(), path(name).c_str());
    return curves_of(read(path(name)));
  };
  const Result<Report> report = certify_curve_files({write(0.4, 1, "second.brep"), write(0, 0.4, "first.brep")});
  ASSERT_TRUE(report);
  ASSERT_EQ(report->curves->joins.size(), 1u);
  const ReportedCurveJoin& join = report->curves->joins[0];
  EXPECT_EQ(class_name(join.certificate), "C∞");
  EXPECT_EQ(report->curves->files[report->curves->curves[join.a.of.curve].file].path, path("first.brep"));
  EXPECT_EQ(report->curves->free.size(), 2u);
}

TEST_F(CadFiles, EdgesBesideFacesAndFilesWithoutEither) {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, box());
  builder.Add(both, BRepBuilderAPI_MakeEdge(gp_Pnt(50, 0, 0), gp_Pnt(60, 0, 0)).Edge());
  const CadModel model = read(write_brep(both));
  EXPECT_EQ(model.faces.size(), 6u);
  EXPECT_EQ(model.edges.size(), 12u);
  EXPECT_EQ(model.curves.size(), 1u);
  BRepTools::Write(BRepBuilderAPI_MakeVertex(gp_Pnt(1, 2, 3)).Vertex(), path("vertex.brep").c_str());
  const Result<CadModel> vertex = read_cad_model(path("vertex.brep"));
  ASSERT_FALSE(vertex);
  EXPECT_EQ(vertex.error().code, ErrorCode::wrong_count);
  EXPECT_NE(vertex.error().message.find("neither faces nor edges"), std::string::npos);
  const gp_Lin endless(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0));
  const Result<CadModel> line = read_cad_model(write_brep(BRepBuilderAPI_MakeEdge(endless).Edge()));
  ASSERT_FALSE(line);
  EXPECT_NE(line.error().message.find("infinite"), std::string::npos) << line.error().text();
}

// Open CASCADE's own derivatives, at the ends of edges of random splines that meet.
TEST_F(CadFiles, AnglesAndCurvaturesAreThoseThatOpenCascadeFinds) {
  std::mt19937 engine(20240229);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int trial = 0; trial < 20; ++trial) {
    opencascade::handle<Geom_BezierCurve> curves[2];
    gp_Pnt meet(number(engine), number(engine), number(engine));
    for (int k = 0; k < 2; ++k) {
      TColgp_Array1OfPnt poles(1, 5);
      TColStd_Array1OfReal weights(1, 5);
      for (int i = 1; i <= 5; ++i) {
        poles(i) = gp_Pnt(number(engine), number(engine), number(engine));
        weights(i) = 1 + std::fabs(number(engine));
      }
      poles(k == 0 ? 5 : 1) = meet;
      curves[k] = trial % 2 ? new Geom_BezierCurve(poles, weights) : new Geom_BezierCurve(poles);
    }
    TopoDS_Compound both;
    BRep_Builder builder;
    builder.MakeCompound(both);
    for (const auto& curve : curves) builder.Add(both, BRepBuilderAPI_MakeEdge(curve).Edge());
    const Report report = certify_cad(read(write_brep(both)));
    ASSERT_EQ(report.curves->joins.size(), 1u);
    const CurveCertificate& c = report.curves->joins[0].certificate;
    gp_Pnt point;
    gp_Vec d1[2], d2[2], curvature[2];
    for (int k = 0; k < 2; ++k) {
      curves[k]->D2(k == 0 ? 1 : 0, point, d1[k], d2[k]);
      curvature[k] = (d2[k] - d1[k] * (d2[k].Dot(d1[k]) / d1[k].SquareMagnitude())) / d1[k].SquareMagnitude();
    }
    const auto agrees = [](const std::optional<Enclosure>& ours, double theirs) {
      ASSERT_TRUE(ours);
      EXPECT_LE(ours->lower, theirs * (1 + 1e-11));
      EXPECT_GE(ours->upper, theirs * (1 - 1e-11));
    };
    agrees(c.angle, d1[0].Angle(d1[1]) * 180 / M_PI);
    agrees(c.second_angle, d2[0].Angle(d2[1]) * 180 / M_PI);
    agrees(c.speed_ratio, d1[1].Magnitude() / d1[0].Magnitude());
    agrees(c.first_difference, (d1[0] - d1[1]).Magnitude());
    agrees(c.second_difference, (d2[0] - d2[1]).Magnitude());
    agrees(c.curvature[0], curvature[0].Magnitude());
    agrees(c.curvature[1], curvature[1].Magnitude());
    agrees(c.curvature_difference, (curvature[0] - curvature[1]).Magnitude());
  }
}

// TiGL's getEdgeContinuity compares the directions of the first and of the second derivatives, within 1e-7 radians: it says C2 for the
// first pair and C0 for the others. Here are the numbers behind that.
TEST(TiglEdges, VerdictsAndBounds) {
  const std::string folder = PATCHPROOF_SOURCE_DIR "/../shared/data/brep_tigl/checkEdgeContinuity_edge";
  std::vector<CurveFile> files;
  for (const char* number : {"1", "2", "3"}) {
    const std::string file = folder + number + ".brep";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    Result<CadModel> model = read_cad_model(file);
    ASSERT_TRUE(model) << model.error().text();
    files.push_back(curves_of(*model));
  }
  CertifyOptions options;
  options.request.gap_tolerance = 1.05628e-6;  // of the files' vertices
  options.request.angle_tolerance = 1e-7 * 180 / 3.14159265358979;
  const Result<Report> report = certify_curve_files(files, options);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->curves->free.empty());
  ASSERT_EQ(report->curves->joins.size(), 3u);
  const auto pair = [&](int a, int b) -> const ReportedCurveJoin& {
    for (const ReportedCurveJoin& j : report->curves->joins)
      if (j.a.of.curve == a - 1 && j.b.of.curve == b - 1) return j;
    throw std::runtime_error("no such pair");
  };
  // Both are parts of one spline, cut at one double: not only C2.
  const ReportedCurveJoin& smooth = pair(1, 2);
  EXPECT_EQ(smooth.certificate.c2.verdict, Verdict::proven);
  EXPECT_EQ(smooth.certificate.g2.verdict, Verdict::proven);
  EXPECT_EQ(smooth.certificate.order, kOneFunction);
  EXPECT_EQ(smooth.certificate.gap.upper, 0);
  EXPECT_EQ(smooth.certificate.second_angle->upper, 0);
  EXPECT_EQ(smooth.within, "G1");
  const ReportedCurveJoin &trailing = pair(2, 3), &leading = pair(3, 1);
  EXPECT_EQ(trailing.within, "G0");
  EXPECT_GT(trailing.certificate.angle->lower, 81.338);
  EXPECT_LT(trailing.certificate.angle->upper, 81.339);
  EXPECT_GT(trailing.certificate.gap.lower, 3.75e-14);  // the ranges in the files have 15 digits
  EXPECT_LT(trailing.certificate.gap.upper, 3.76e-14);
  EXPECT_EQ(leading.within, "G0");
  EXPECT_GT(leading.certificate.angle->lower, 82.116);
  EXPECT_LT(leading.certificate.angle->upper, 82.117);
  EXPECT_LT(leading.certificate.gap.upper, 3.15e-18);
}

}  // namespace
}  // namespace patchproof::test
