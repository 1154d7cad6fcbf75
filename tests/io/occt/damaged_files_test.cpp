// SPDX-License-Identifier: Apache-2.0
// Files that are damaged or hold what cannot be used: named errors, nothing printed, no exception, no crash.
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopTools_FormatVersion.hxx>

#include <random>

#include "io/occt/parts.h"

namespace patchproof::test {
namespace {

class DamagedFiles : public CadFiles {
 protected:
  const std::string box_ = text_of(write_step(box()));
  // Rational B-splines for everything.
  const std::string tube_ =
      text_of(write_step(BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeCylinder(5, 12).Shape(), true).Shape()));

  static std::string with(std::string text, const std::string& from, const std::string& to, std::size_t after = 0) {
    const std::size_t at = text.find(from, after);
    if (at == std::string::npos) throw std::runtime_error("the file does not hold " + from);
    return text.replace(at, from.size(), to);
  }

  // The error, which names the file and says nothing in Open CASCADE's words; nothing is printed.
  Error refused(const std::string& name, const std::string& text) const {
    const std::string file = write_text(name, text);
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const Result<CadModel> model = read_cad_model(file);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    if (model) throw std::runtime_error("accepted: " + name);
    EXPECT_EQ(model.error().where.find(file), 0u) << model.error().text();
    for (const char* word : {"Standard_", "SIGSEGV", "Geom_", "exception"})
      EXPECT_EQ(model.error().text().find(word), std::string::npos) << model.error().text();
    return model.error();
  }
  void expect(ErrorCode code, const std::string& words, const Error& error) const {
    EXPECT_EQ(error.code, code) << error.text();
    EXPECT_NE(error.text().find(words), std::string::npos) << error.text();
  }
};

TEST_F(DamagedFiles, FilesThatAreNone) {
  EXPECT_EQ(read_cad_model(path("missing.step")).error().code, ErrorCode::cannot_open);
  EXPECT_EQ(read_cad_model(path(".")).error().code, ErrorCode::cannot_open);
  expect(ErrorCode::empty_input, "empty", refused("empty.step", ""));
  std::string garbage = "ISO-10303-21;\n";
  std::mt19937 random(7);
  for (int i = 0; i < 5000; ++i) garbage += static_cast<char>(random());
  EXPECT_EQ(refused("garbage.step", garbage).code, ErrorCode::syntax);
  EXPECT_EQ(refused("header.igs", std::string(72, ' ') + "S0000001\n").code, ErrorCode::syntax);
  EXPECT_EQ(refused("header.brep", "DBRep_DrawableShape\n").code, ErrorCode::syntax);
  EXPECT_EQ(refused("header.step", box_.substr(0, box_.find("DATA;"))).code, ErrorCode::syntax);
}

TEST_F(DamagedFiles, TruncatedFiles) {
  const std::string brep = text_of(write_brep(rounded_block()));
  for (int k = 1; k < 10; ++k) refused("cut.step", box_.substr(0, box_.size() * k / 10));
  refused("cut.brep", brep.substr(0, brep.size() / 50));
}

TEST_F(DamagedFiles, EntitiesThatCannotBeReadAreNamed) {
  // The first point on a face: zeros would be put for what is no number.
  const std::size_t at = box_.find(" = VERTEX_POINT('',#") + std::string(" = VERTEX_POINT('',#").size();
  const std::string number = box_.substr(at, box_.find(')', at) - at),
                    point = "\n#" + number + " = CARTESIAN_POINT('',(";
  for (const char* value : {"NAN", "'one'"}) {
    const Error error = refused("point.step", with(box_, point + "0.", point + value));
    expect(ErrorCode::syntax, "entity #" + number, error);
    EXPECT_NE(error.where.find(" at #"), std::string::npos) << error.text();
  }
  const Error wrong = refused("type.step", with(box_, "= PLANE('',", "= CARTESIAN_POINT('',"));
  EXPECT_NE(wrong.where.find(" at #"), std::string::npos) << wrong.text();
}

// Of the other faces something is left, at once: Open CASCADE never sees what is not finite.
TEST_F(DamagedFiles, NumbersOfStepFilesThatAreNotFinite) {
  for (const char* value : {"NAN", "-INF", "1.E999", "-1.E200", "1.5.2"}) {
    const std::string text =
        with(tube_, "CARTESIAN_POINT('',(5.,0.,12.", std::string("CARTESIAN_POINT('',(") + value + ",0.,12.");
    const Error error = refused("value.step", text);
    expect(ErrorCode::syntax, " of it cannot be read: line ", error);
    EXPECT_NE(error.where.find(" at #"), std::string::npos) << error.text();
    const CadModel model = read(path("value.step"), UnusableFaces::leave_out);
    EXPECT_GT(model.left_out.size(), 0u);
    EXPECT_GT(model.faces.size(), 0u);
  }
  // Beside the faces: the placement of the part.
  const std::string placed = with(tube_, "DIRECTION('',(0.,0.,1.", "DIRECTION('',(0.,0.,1.E999");
  expect(ErrorCode::syntax, "has 1.E999", refused("placement.step", placed));
  EXPECT_EQ(read(path("placement.step"), UnusableFaces::leave_out).notes.size(), 1u);
  // Names, comments and keywords are no numbers.
  const std::string named = with(with(tube_, "CARTESIAN_POINT('',", "CARTESIAN_POINT('it''s NAN, 1.E999',"), "DATA;",
                                 "DATA; /* (INF, 'NAN */");
  EXPECT_EQ(read(write_text("named.step", named)).faces.size(), 3u);
}

TEST_F(DamagedFiles, SurfacesThatCannotBeUsedAreNamed) {
  const std::size_t surface = tube_.find("RATIONAL_B_SPLINE_SURFACE");
  for (const char* weight : {"-0.25", "0."}) {
    const Error error = refused("weight.step", with(tube_, "(0.5,0.5)", std::string("(") + weight + ",0.5)", surface));
    expect(ErrorCode::unsupported, "weight that is not positive", error);
    EXPECT_NE(error.where.find(" at #"), std::string::npos) << error.text();
  }
  const Error knots = refused("knots.step", with(tube_, "(-2.094395102393,0.,2.094395102393", "(9.,0.,2.094395102393"));
  EXPECT_NE(knots.where.find(" at #"), std::string::npos) << knots.text();
}

TEST_F(DamagedFiles, Law3_TheOtherFacesAreReported) {
  const std::string damaged =
      write_text("weight.step", with(tube_, "(0.5,0.5)", "(-0.25,0.5)", tube_.find("RATIONAL_B_SPLINE_SURFACE")));
  const CadModel model = read(damaged, UnusableFaces::leave_out);
  ASSERT_EQ(model.left_out.size(), 1u);
  EXPECT_EQ(model.left_out[0].label[0], '#');
  EXPECT_EQ(model.faces.size(), 2u);
  const Report report = certify_cad(model);
  ASSERT_TRUE(report.cad);
  EXPECT_EQ(report.cad->left_out.size(), 1u);
  EXPECT_EQ(report.cad->left_out[0].label, model.left_out[0].label);
}

// A number of a BREP file, by the first text like it in a table.
class DamagedBreps : public DamagedFiles {
 protected:
  const std::string tube_brep_ =
      text_of(write_brep(BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeCylinder(5, 12).Shape(), true).Shape()));

  std::string damaged(const std::string& table, const std::string& from, const std::string& to) const {
    return with(tube_brep_, from, to, tube_brep_.find("\n" + table + " "));
  }
  // Named by face and entity, with the number; when such faces are left out, the others are there.
  void expect_left_out(const std::string& text, ErrorCode code, const std::string& words, std::size_t faces) const {
    const Error error = refused("damaged.brep", text);
    expect(code, words, error);
    EXPECT_NE(error.where.find(" at face "), std::string::npos) << error.text();
    if (faces == 0) return;
    const CadModel model = read(path("damaged.brep"), UnusableFaces::leave_out);
    EXPECT_EQ(model.left_out.size(), 3 - faces);
    EXPECT_EQ(model.faces.size(), faces);
    EXPECT_NE(model.left_out.at(0).reason.find(words), std::string::npos) << model.left_out[0].reason;
  }
};

TEST_F(DamagedBreps, Law1_NumbersAreNamedWithTheirEntity) {
  for (const char* value : {"abc", "nan", "inf", "1e999", "1e200", "1,5"}) {
    const std::string is = std::string(" is ") + value + ",";
    expect_left_out(damaged("Surfaces", "\n5 8.6602540378443837 ", std::string("\n5 ") + value + " "),
                    ErrorCode::bad_number,
                    "surface 1 (line 29): a coordinate of control point (2, 1) is " + std::string(value), 0);
    expect_left_out(damaged("Surfaces", "  0.5 5", std::string("  ") + value + " 5"), ErrorCode::bad_number,
                    "the weight of control point (2, 1)" + is, 2);
    expect_left_out(damaged("Curves", "  0.50000000000000011 ", std::string("  ") + value + " "), ErrorCode::bad_number,
                    "curve 1 (line 19): the weight of control point 2" + is, 0);
    expect_left_out(damaged("Curve2ds", "  1.0471975511965979 ", std::string("  ") + value + " "),
                    ErrorCode::bad_number, "parameter curve 1 (line 6): a coordinate of control point 2" + is, 2);
    expect_left_out(damaged("Surfaces", "\n2.0943951023931953 ", std::string("\n") + value + " "),
                    ErrorCode::bad_number, "knot 2 along u" + is, 2);
  }
  for (const char* value : {"-0.25", "0"}) {
    const std::string is = std::string(" is ") + value + ", not positive";
    expect_left_out(damaged("Surfaces", "  0.5 5", std::string("  ") + value + " 5"), ErrorCode::unsupported,
                    "the weight of control point (2, 1)" + is, 2);
    expect_left_out(damaged("Curves", "  0.50000000000000011 ", std::string("  ") + value + " "),
                    ErrorCode::unsupported, "the weight of control point 2" + is, 1);
  }
  expect_left_out(damaged("Surfaces", "\n2.0943951023931953 ", "\n0 "), ErrorCode::decreasing_knots,
                  "knot 2 along u is not above the one before it: 0 after 0", 2);
  expect_left_out(damaged("Surfaces", "\n2.0943951023931953 2", "\n2.0943951023931953 7"), ErrorCode::unsupported,
                  "surface 1 (line 28): Open CASCADE builds none from it", 2);
  expect_left_out(damaged("TShapes", "Ve\n1e-07\n5 ", "Ve\n1e-07\nfive "), ErrorCode::bad_number,
                  "shape 1, a vertex (line 66): a coordinate is five", 1);
}

TEST_F(DamagedBreps, Law3_WhatCannotBeCountedIsRefused) {
  for (const char* count : {"-3", "4", "99999999", "99999999999999999999", "three"}) {
    const Error error = refused("count.brep", damaged("Surfaces", "Surfaces 3", std::string("Surfaces ") + count));
    EXPECT_EQ(error.code, ErrorCode::syntax);
    EXPECT_NE(error.where.find(" at Surfaces"), std::string::npos) << error.text();
  }
  for (std::size_t k = 1; k < 20; ++k) {
    const Error error = refused("cut.brep", tube_brep_.substr(0, tube_brep_.size() * k / 20));
    EXPECT_EQ(error.code, ErrorCode::syntax);  // the last word may be cut in two
    EXPECT_NE(error.where.find("cut.brep:"), std::string::npos) << error.text();
  }
  expect(ErrorCode::bad_reference, "[+99]", refused("part.brep", damaged("TShapes", "\n+6 0", "\n+99 0")));
}

TEST_F(DamagedBreps, UndamagedFilesOfAllVersionsAreRead) {
  gp_Trsf turned;
  turned.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 2, 3)), 1);
  const TopoDS_Compound all = compound({rounded_block(), moved(BRepPrimAPI_MakeCylinder(5, 12).Shape(), turned)});
  for (const auto version :
       {TopTools_FormatVersion_VERSION_1, TopTools_FormatVersion_VERSION_2, TopTools_FormatVersion_VERSION_3}) {
    BRepTools::Write(all, path("all.brep").c_str(), true, false, version);
    const CadModel model = read(path("all.brep"));
    EXPECT_EQ(model.faces.size(), 26u + 3u);
    EXPECT_EQ(count(model, CadEdgeKind::shared), 48 + 2);
  }
}

// Bytes changed at random: an answer or an error, within the time.
TEST_F(DamagedFiles, RandomDamage) {
  std::mt19937 random(11);
  const std::string iges = text_of(write_iges(box()));
  int read_well = 0;
  const std::string brep = text_of(write_brep(rounded_block()));
  for (const auto& [name, good] :
       {std::pair<const char*, const std::string&>{"a.step", box_}, {"a.igs", iges}, {"a.brep", brep}})
    for (int i = 0; i < 25; ++i) {
      std::string text = good;
      for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random());
      const Result<CadModel> model = read_cad_model(write_text(name, text), UnusableFaces::leave_out);
      if (model) certify_cad(*model);
      read_well += model.has_value();
    }
  EXPECT_GT(read_well, 5);
}

}  // namespace
}  // namespace patchproof::test
