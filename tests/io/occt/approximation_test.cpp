// SPDX-License-Identifier: Apache-2.0
// Offset surfaces, which Open CASCADE approximates.
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <TopExp.hxx>

#include "io/occt/approximation.h"
#include "io/occt/parts.h"

namespace patchproof::test {
namespace {

TopoDS_Face wavy_offset(double distance) {
  TColgp_Array2OfPnt points(1, 4, 1, 4);
  for (int i = 1; i <= 4; ++i)
    for (int j = 1; j <= 4; ++j) points(i, j) = gp_Pnt(3 * i, 3 * j, (i * j) % 3);
  const opencascade::handle<Geom_Surface> basis = new Geom_BezierSurface(points);
  return BRepBuilderAPI_MakeFace(opencascade::handle<Geom_Surface>(new Geom_OffsetSurface(basis, distance)), 1e-6);
}

// Denser than the figure's own samples.
TEST(Approximation, SamplesLieWithinTheFigure) {
  const TopoDS_Face before = wavy_offset(0.3);
  TopExp_Explorer e(BRepBuilderAPI_NurbsConvert(before, true).Shape(), TopAbs_FACE);
  const TopoDS_Face after = TopoDS::Face(e.Current());
  const occt::SurfaceApproximation by = occt::approximation_of(before, after);
  EXPECT_GT(by.figure, 0);
  EXPECT_GT(by.whole.length, 0);
  EXPECT_LT(by.whole.length, 1e-4);
  const auto original = BRep_Tool::Surface(before), spline = BRep_Tool::Surface(after);
  for (int i = 0; i <= 300; ++i)
    for (int j = 0; j <= 300; ++j)
      ASSERT_LE(original->Value(i / 300.0, j / 300.0).Distance(spline->Value(i / 300.0, j / 300.0)), by.whole.length);
}

class ApproximatedFaces : public CadFiles {};

TEST_F(ApproximatedFaces, Law6_AreSaidAndAllowedFor) {
  const TopoDS_Face face = wavy_offset(0.3);
  const CadModel model = read(write_brep(face));
  ASSERT_EQ(model.faces.size(), 1u);
  EXPECT_GT(model.faces[0].approximation.length, 0);
  ASSERT_FALSE(model.notes.empty());
  EXPECT_NE(model.notes[0].find("approximated by a B-spline"), std::string::npos);

  const CadModel block = read(PATCHPROOF_SOURCE_DIR "/examples/cad/block.step");
  int approximated = 0;
  for (const double tolerance : {1e-5, 1e-3}) {
    CertifyOptions options;
    options.request.gap_tolerance = tolerance;
    const Report report = certify_cad(block, options);
    for (const ReportedJoin& join : report.joins) {
      if (join.approximation.length == 0) continue;
      ++approximated;
      const double most = join.certificate.gap.upper + join.approximation.length,
                   least = join.certificate.gap.lower - join.approximation.length;
      const Outcome outcome = most <= tolerance   ? Outcome::pass
                              : least > tolerance ? Outcome::fail
                                                  : Outcome::undecided;
      EXPECT_EQ(join.judgement.outcome, outcome) << join.id;
    }
  }
  EXPECT_EQ(approximated, 2 * 4);
}

}  // namespace
}  // namespace patchproof::test
