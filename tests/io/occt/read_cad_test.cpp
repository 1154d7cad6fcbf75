// SPDX-License-Identifier: Apache-2.0
// Parts whose joins are known, through BREP, STEP and IGES files: faces, kinds of edges, labels, units, places, bounds.
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>

#include <set>

#include "io/occt/parts.h"
#include "patchproof/patch/rational_patch.h"

namespace patchproof::test {
namespace {

// The corner of a face's surface at the ends of its domain nearest to the origin, in double.
std::array<double, 3> smallest_coordinates(const CadModel& model) {
  std::array<double, 3> least{1e300, 1e300, 1e300};
  for (const CadFace& face : model.faces)
    for (const auto& p : face.surface.net())
      for (int c = 0; c < 3; ++c) least[c] = std::min(least[c], nearest_double(Rational(p[c] / p[3])));
  return least;
}

std::set<std::string> kinds(const CadModel& model) {
  std::set<std::string> out;
  for (const CadFace& face : model.faces) out.insert(face.kind);
  return out;
}

TEST_F(CadFiles, Law1_ABoxHasTwelveSharpEdges) {
  for (const std::string& file : {write_brep(box()), write_step(box()), write_iges(box())}) {
    const CadModel model = read(file);
    EXPECT_EQ(model.faces.size(), 6u) << file;
    EXPECT_EQ(model.edges.size(), 12u);
    EXPECT_EQ(count(model, CadEdgeKind::shared), 12);
    EXPECT_TRUE(model.notes.empty() && model.left_out.empty());
    const Report report = certify_cad(model);
    ASSERT_EQ(report.joins.size(), 12u);
    for (const ReportedJoin& join : report.joins) {
      const EnclosedMaximum& angle = join.certificate.angle;
      EXPECT_LE(angle.lower, 90 + 1e-12);
      EXPECT_GE(angle.upper, 90 - 1e-12);
      EXPECT_LE(angle.upper - angle.lower, 0.9);
      EXPECT_EQ(join.certificate.gap.lower, 0) << file << " " << join.id;
      EXPECT_LE(join.certificate.gap.upper, 1e-9);
    }
  }
}

TEST_F(CadFiles, Law1_ACylinderHasASeam) {
  const CadModel model = read(write_brep(BRepPrimAPI_MakeCylinder(5, 12).Shape()));
  EXPECT_EQ(kinds(model), (std::set<std::string>{"cylinder", "plane"}));
  EXPECT_EQ(count(model, CadEdgeKind::seam), 1);
  EXPECT_EQ(count(model, CadEdgeKind::shared), 2);
  const Report report = certify_cad(model);
  ASSERT_EQ(report.joins.size(), 3u);
  for (const ReportedJoin& join : report.joins) {
    EXPECT_LE(join.certificate.gap.upper, 1e-9);
    if (join.kind == JoinKind::seam) {
      EXPECT_EQ(join.a.patch, join.b.patch);
      EXPECT_LE(join.certificate.angle.upper, 1e-9);
    } else {
      EXPECT_NEAR(join.certificate.angle.upper, 90, 0.9);
    }
  }
}

TEST_F(CadFiles, Law1_ASphereHasASeamAndTwoPoles) {
  const CadModel model = read(write_brep(BRepPrimAPI_MakeSphere(7).Shape()));
  EXPECT_EQ(kinds(model), std::set<std::string>{"sphere"});
  EXPECT_EQ(count(model, CadEdgeKind::seam), 1);
  EXPECT_EQ(count(model, CadEdgeKind::degenerate), 2);
  const Report report = certify_cad(model);
  ASSERT_EQ(report.joins.size(), 1u);
  EXPECT_LE(report.joins[0].certificate.gap.upper, 1e-9);
  EXPECT_LE(report.joins[0].certificate.angle.upper, 1e-9);
}

TEST_F(CadFiles, Law1_FilletsAreSmooth) {
  // STEP keeps no parameter curves; Open CASCADE finds them anew, less exactly.
  struct Bounds {
    std::string file;
    double gap, angle;
  };
  for (const Bounds& most :
       {Bounds{write_brep(rounded_block()), 1e-9, 1e-3}, {write_step(rounded_block()), 1e-8, 1e-2}}) {
    const CadModel model = read(most.file);
    EXPECT_EQ(model.faces.size(), 26u);
    EXPECT_EQ(kinds(model), (std::set<std::string>{"cylinder", "plane", "sphere"}));
    const Report report = certify_cad(model);
    EXPECT_EQ(report.joins.size(), 48u);
    for (const ReportedJoin& join : report.joins) {
      EXPECT_LE(join.certificate.angle.upper, most.angle) << join.a.edge;
      EXPECT_LE(join.certificate.gap.upper, most.gap) << join.a.edge;
    }
  }
}

// The control: a face moved by a hundredth is found open, by that.
TEST_F(CadFiles, Law2_AGapIsNotClosed) {
  std::string text = text_of(write_brep(compound({box()})));
  const CadModel closed = read(write_text("closed.brep", text));
  EXPECT_LE(certify_cad(closed).joins[0].certificate.gap.upper, 1e-9);
  // Planes of BREP files: "1 x y z …". The first plane, x = 0, moves to x = -0.01.
  const std::string plane = "\n1 0 0 0 1 0 -0 ";
  const std::size_t at = text.find(plane, text.find("\nSurfaces "));
  ASSERT_NE(at, std::string::npos);
  text.replace(at, plane.size(), "\n1 -0.01 0 0 1 0 -0 ");
  const CadModel open = read(write_text("open.brep", text));
  int apart = 0;
  for (const ReportedJoin& join : certify_cad(open).joins) {
    const EnclosedMaximum& gap = join.certificate.gap;
    if (gap.lower == 0) continue;
    EXPECT_NEAR(gap.lower, 0.01, 1e-4);
    EXPECT_NEAR(gap.upper, 0.01, 1e-4);
    ++apart;
  }
  EXPECT_EQ(apart, 4);
}

TEST_F(CadFiles, LabelsOfStepFilesAreTheirEntities) {
  const std::string file = write_step(rounded_block()), text = text_of(file);
  const CadModel model = read(file);
  std::set<std::string> labels;
  const auto expect_entity = [&](const std::string& label, const std::string& type) {
    EXPECT_NE(text.find("\n" + label + " = " + type + "("), std::string::npos) << label;
    EXPECT_TRUE(labels.insert(label).second) << label;
  };
  for (const CadFace& face : model.faces) expect_entity(face.label, "ADVANCED_FACE");
  for (const CadEdge& edge : model.edges)
    if (edge.kind != CadEdgeKind::degenerate) expect_entity(edge.label, "EDGE_CURVE");  // STEP knows no edges in poles
}

TEST_F(CadFiles, NamesOfStepFilesAreKept) {
  std::string text = text_of(write_step(box()));
  const std::string before = "ADVANCED_FACE('',";
  text.replace(text.find(before), before.size(), "ADVANCED_FACE('left wall',");
  const CadModel model = read(write_text("named.step", text));
  EXPECT_NE(model.faces[0].label.find(" 'left wall'"), std::string::npos) << model.faces[0].label;
  EXPECT_EQ(model.faces[1].label.find('\''), std::string::npos);
}

TEST_F(CadFiles, UnitsAreSaidAndConverted) {
  const gp_Trsf away = [] {
    gp_Trsf t;
    t.SetTranslation(gp_Vec(254, 508, 762));
    return t;
  }();
  const TopoDS_Shape part = BRepBuilderAPI_Transform(box(), away, true).Shape();
  const auto expect_millimetres = [](const CadModel& model) {
    const auto least = smallest_coordinates(model);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(least[c], 254 * (c + 1), 1e-9) << model.path;
  };
  EXPECT_EQ(read(write_step(part)).units, "mm");
  EXPECT_EQ(read(write_iges(part)).units, "mm");
  EXPECT_EQ(read(write_brep(part)).units, "");
  const CadModel inch = read(write_step(part, "INCH"));
  EXPECT_EQ(inch.units, "mm (file: INCH)");
  EXPECT_EQ(read(write_iges(part, "IN")).units, "mm (file: INCH)");
  expect_millimetres(inch);
  expect_millimetres(read(write_iges(part, "IN")));
  expect_millimetres(read(write_step(part)));
}

TEST_F(CadFiles, Law4_TwoPlacesAreTwoFaces) {
  gp_Trsf shift, turn, mirror;
  shift.SetTranslation(gp_Vec(100, 0, 0));
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), M_PI / 3);
  mirror.SetMirror(gp_Ax2(gp_Pnt(-50, 0, 0), gp_Dir(1, 0, 0)));
  const TopoDS_Shape part = rounded_block();
  const TopoDS_Compound assembly = compound({part, moved(part, shift), moved(part, shift * turn)});
  for (const std::string& file : {write_brep(assembly), write_step(assembly)}) {
    const CadModel model = read(file);
    ASSERT_EQ(model.faces.size(), 3 * 26u) << file;
    EXPECT_EQ(count(model, CadEdgeKind::shared), 3 * 48);
    EXPECT_EQ(count(model, CadEdgeKind::degenerate), 3 * 8);  // a pole of each sphere
    std::set<std::string> labels;
    for (const CadFace& face : model.faces) labels.insert(face.label);
    EXPECT_EQ(labels.size(), model.faces.size());
    // The control points of the second block are those of the first, 100 further along x.
    for (int i = 0; i < 26; ++i) {
      const auto &a = model.faces[i].surface.net(), &b = model.faces[26 + i].surface.net();
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_NEAR(nearest_double(Rational(b[k][0] / b[k][3] - a[k][0] / a[k][3])), 100, 1e-10);
        EXPECT_NEAR(nearest_double(Rational(b[k][1] / b[k][3] - a[k][1] / a[k][3])), 0, 1e-10);
      }
    }
    for (const ReportedJoin& join : certify_cad(model).joins) {
      EXPECT_LE(join.certificate.gap.upper, 1e-4);
      EXPECT_LE(join.certificate.angle.upper, 0.1);
    }
  }
  // A mirrored block is turned inside out; its fillets are smooth all the same.
  const CadModel mirrored = read(write_brep(BRepBuilderAPI_Transform(part, mirror).Shape()));
  for (const ReportedJoin& join : certify_cad(mirrored).joins) EXPECT_LE(join.certificate.angle.upper, 1e-3);
  EXPECT_NEAR(smallest_coordinates(mirrored)[0], -110, 1e-9);
}

TEST_F(CadFiles, AnEdgeOfThreeFacesIsNonManifold) {
  // Two boxes that share a whole face, without its being one face: its edges have two faces in each box.
  const TopoDS_Shape block = box();
  const TopoDS_Shape first = TopExp_Explorer(block, TopAbs_FACE).Current();
  const CadModel model = read(write_brep(compound({block, first.Reversed()})));
  EXPECT_EQ(model.faces.size(), 6u);  // the same face
  const TopoDS_Shape other = [&] {
    BRep_Builder b;
    TopoDS_Face copy = TopoDS::Face(first.EmptyCopied());
    for (TopExp_Explorer w(first, TopAbs_WIRE); w.More(); w.Next()) b.Add(copy, w.Current());
    return TopoDS_Shape(copy);
  }();
  const CadModel doubled = read(write_brep(compound({block, other})));
  EXPECT_EQ(doubled.faces.size(), 7u);
  EXPECT_EQ(count(doubled, CadEdgeKind::non_manifold), 4);
  EXPECT_EQ(certify_cad(doubled).joins.size(), 8u + 4 * 2u);
}

}  // namespace
}  // namespace patchproof::test
