// SPDX-License-Identifier: Apache-2.0
// Files that are damaged or hold what cannot be used: named errors, nothing printed, no exception, no crash.
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

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

// Bytes changed at random: an answer or an error, within the time.
TEST_F(DamagedFiles, RandomDamage) {
  std::mt19937 random(11);
  const std::string iges = text_of(write_iges(box()));
  int read_well = 0;
  for (const auto& [name, good] : {std::pair<const char*, const std::string&>{"a.step", box_}, {"a.igs", iges}})
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
