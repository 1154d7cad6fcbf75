// SPDX-License-Identifier: Apache-2.0
// include/patchproof/io/model.h: what a model read from each format means. Every file of tests/data lays its points out so
// that u, v, weights and the order of the file cannot be confused.
#include "patchproof/io/model.h"

#include <gtest/gtest.h>

#include "io/io_support.h"
#include "io/source_file.h"
#include "patchproof/patch/rational_patch.h"

namespace patchproof {
namespace {

using test::exact;
using test::rational_model;

ModelFile file_of(const std::string& name) {
  const auto path = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "tests/data" / name;
  return test::read_good(test::bytes_of(path), path.string());
}

template <class T>
Vec<T, 4> point4(const T& x, const T& y, const T& z, const T& w) {
  return {{x, y, z, w}};
}
Vec<Rational, 4> at(const std::string& x, const std::string& y, const std::string& z, const std::string& w = "1") {
  return point4(exact(x), exact(y), exact(z), exact(w));
}

TEST(Model, NewellRowsRunAlongV) {
  const auto file = file_of("newell/good_two_patches.newell");
  const auto& patches = rational_model(file).patches;
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].surface.point(1, 2), at("0.5", "2.2", "0.25"));
  EXPECT_EQ(patches[0].surface.point(2, 1), at("1", "1.1", "0"));
  EXPECT_EQ(patches[1].surface.point(0, 3), patches[0].surface.point(3, 3));
  EXPECT_FALSE(patches[0].is_rational);
  EXPECT_EQ(patches[0].surface.knots(Direction::u), KnotVector<Rational>::bezier(3));
}

TEST(Model, BptDegreesAreUThenV) {
  const auto file = file_of("bpt/good_mixed_degrees.bpt");
  const auto& surface = rational_model(file).patches[1].surface;
  EXPECT_EQ(surface.degree(Direction::u), 2);
  EXPECT_EQ(surface.degree(Direction::v), 1);
  EXPECT_EQ(surface.point(0, 1), at("1", "1", "1/3"));
  EXPECT_EQ(surface.point(2, 0), at("2", "0", "0"));
}

TEST(Model, BezIsBicubic) {
  const auto file = file_of("bez/good_hill.bez");
  EXPECT_EQ(rational_model(file).patches[0].surface.point(2, 1), at("2", "1", "0.5"));
}

TEST(Model, G2FirstParameterRunsFastestAndCoefficientsAreHomogeneous) {
  const auto file = file_of("g2/good_curve_and_surfaces.g2");
  const auto& patches = rational_model(file).patches;
  ASSERT_EQ(patches.size(), 3u);
  EXPECT_EQ(patches[0].surface.degree(Direction::u), 2);
  EXPECT_EQ(patches[0].surface.point(2, 0), at("2", "0", "0"));
  EXPECT_EQ(patches[0].surface.point(1, 1), at("1", "1", "2.5"));
  EXPECT_EQ(patches[0].surface.knots(Direction::v).domain_begin(), Rational(-1));
  EXPECT_TRUE(patches[1].is_rational);
  EXPECT_EQ(patches[1].surface.point(1, 0), at("4", "0", "0", "2"));  // in the plane: z = 0; not multiplied again
  EXPECT_EQ(patches[2].surface.point(0, 1), at("0", "2", "0"));
  EXPECT_TRUE(file.notes.empty());
}

TEST(Model, GismoWeightsAreMultipliedIn) {
  const auto file = file_of("gismo/good_multipatch.xml");
  const auto& patches = rational_model(file).patches;
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].name, "0");
  EXPECT_EQ(patches[0].surface.count(Direction::v), 3);  // by index, not by order in the file
  EXPECT_EQ(patches[0].surface.knots(Direction::v)[2], exact("1/3"));
  EXPECT_EQ(patches[0].surface.point(1, 1), at("2/3", "1/16", "0"));
  EXPECT_TRUE(patches[1].is_rational);
  EXPECT_EQ(patches[1].surface.point(1, 1), at("0.5", "0.5", "1", "0.5"));
  EXPECT_EQ(file.notes.size(), 1u);
  EXPECT_TRUE(rational_model(file).joins.empty());
}

TEST(Model, GeomdlWeightsAreMultipliedIn) {
  const auto file = file_of("geomdl/good_two_surfaces.json");
  const auto& patches = rational_model(file).patches;
  EXPECT_FALSE(patches[0].is_rational);
  EXPECT_EQ(patches[0].surface.point(0, 1), at("0", "1", "0.3"));
  EXPECT_EQ(patches[1].surface.point(1, 1), at("0.7071", "0.7071", "0.7071", "0.7071"));
}

TEST(Model, JsonHoldsNamesUnitsKnotsAndJoins) {
  const auto file = file_of("model/good_joins.json");
  const auto& model = rational_model(file);
  EXPECT_EQ(model.units, "mm");
  EXPECT_EQ(model.patches[0].name, "left");
  EXPECT_EQ(model.patches[1].name, "");
  const auto& u = model.patches[0].surface.knots(Direction::u);
  EXPECT_EQ(u.knots(), (std::vector<Rational>{Rational(0), Rational(0), Rational(3), Rational(3)}));
  EXPECT_EQ(model.patches[0].surface.knots(Direction::v)[3], exact("1/3"));
  EXPECT_EQ(model.patches[0].surface.point(1, 1), at("1", "1", "1/3"));
  EXPECT_EQ(model.patches[1].surface.point(1, 1), at("2", "3", "12345678901234567890"));
  ASSERT_EQ(model.joins.size(), 1u);
  EXPECT_EQ(model.joins[0].patch_a, 0);
  EXPECT_EQ(model.joins[0].patch_b, 1);
  EXPECT_EQ(model.joins[0].edge_a, EdgeName::u_max);
  EXPECT_EQ(model.joins[0].edge_b, EdgeName::u_min);
  EXPECT_FALSE(model.joins[0].reversed);
}

TEST(Model, CurvesOfOurJson) {
  const auto file = file_of("model/good_curves.json");
  const auto& curves = rational_model(file).curves;
  ASSERT_EQ(curves.size(), 5u);
  EXPECT_EQ(curves[0].name, "Bézier");
  EXPECT_EQ(curves[0].dimension, 2);
  EXPECT_FALSE(curves[0].is_rational);
  EXPECT_EQ(curves[0].curve.knots(), KnotVector<Rational>::bezier(2));
  EXPECT_EQ(curves[0].curve.points()[1], at("1", "1/3", "0"));
  // Knots beyond degree + 1 inside and at the end: the fourth and the last control point have no influence.
  EXPECT_EQ(curves[1].dimension, 3);
  EXPECT_EQ(evaluate(curves[1].curve, Rational(1), Side::left), at("1", "4", "0"));
  EXPECT_EQ(evaluate(curves[1].curve, Rational(1), Side::right), at("1", "1", "0"));
  EXPECT_EQ(evaluate(curves[1].curve, Rational(2)), at("5/2", "1", "0"));
  // A control vector: the upper half circle.
  EXPECT_EQ(curves[2].dimension, 2);
  EXPECT_TRUE(curves[2].is_rational);
  EXPECT_EQ(curves[2].curve.points()[1], at("0", "1", "0", "0"));
  EXPECT_EQ(project(evaluate(curves[2].curve, exact("1/2"))), (Vec<Rational, 3>{{exact("0"), exact("1"), exact("0")}}));
  EXPECT_EQ(curves[3].dimension, 3);
  EXPECT_EQ(curves[3].curve.points()[2], at("0", "4", "10", "2"));
  EXPECT_EQ(curves[4].curve.degree(), 0);
  EXPECT_EQ(evaluate(curves[4].curve, Rational(1), Side::left), at("4", "5", "0"));
  EXPECT_EQ(evaluate(curves[4].curve, Rational(1)), at("6", "7", "0"));
}

TEST(Model, CurvesOfOtherFormats) {
  const auto g2 = file_of("g2/good_only_curves.g2");
  ASSERT_EQ(rational_model(g2).curves.size(), 1u);
  EXPECT_EQ(g2.notes, std::vector<std::string>{"1 curve of dimension 1 skipped"});
  EXPECT_EQ(rational_model(g2).curves[0].dimension, 2);
  EXPECT_EQ(rational_model(g2).curves[0].curve.points()[2], at("0", "2", "0", "2"));  // not multiplied again
  const auto beside = file_of("g2/good_curve_and_surfaces.g2");
  ASSERT_EQ(rational_model(beside).curves.size(), 1u);
  EXPECT_EQ(rational_model(beside).curves[0].curve.points()[1], at("1", "0", "0"));

  const auto gismo = file_of("gismo/good_curves.xml");
  ASSERT_EQ(rational_model(gismo).curves.size(), 2u);
  EXPECT_EQ(gismo.notes, std::vector<std::string>{"1 curve of dimension 1 skipped"});
  EXPECT_EQ(rational_model(gismo).curves[0].name, "3");
  EXPECT_EQ(rational_model(gismo).curves[0].curve.knots()[2], exact("1/3"));
  EXPECT_EQ(rational_model(gismo).curves[0].curve.points()[2], at("1", "2/3", "0"));
  EXPECT_EQ(rational_model(gismo).curves[1].curve.points()[1], at("0.5", "0.5", "0", "0.5"));  // multiplied

  const auto geomdl = file_of("geomdl/good_curves.json");
  ASSERT_EQ(rational_model(geomdl).curves.size(), 2u);
  EXPECT_EQ(rational_model(geomdl).curves[0].dimension, 2);
  EXPECT_EQ(rational_model(geomdl).curves[0].curve.points()[1], at("1", "0.3", "0"));
  EXPECT_EQ(rational_model(geomdl).curves[1].name, "arc");
  EXPECT_EQ(rational_model(geomdl).curves[1].curve.points()[1], at("0.7071", "0.7071", "1.4142", "0.7071"));
}

TEST(Model, ACurveWithARootIsReadOverItsField) {
  const auto file = file_of("model/good_only_a_circle.json");
  const auto& model = std::get<Model<Quadratic>>(file.model);
  EXPECT_TRUE(model.patches.empty());
  ASSERT_EQ(model.curves.size(), 1u);
  for (int k = 0; k <= 4; ++k) {
    const Vec<Quadratic, 4> p = evaluate(model.curves[0].curve, Quadratic(k) / Quadratic(4));
    EXPECT_EQ(p[0] * p[0] + p[1] * p[1], p[3] * p[3]);
  }
}

// Both patches lie exactly on the cylinder x² + y² = w², one by √2 and one by points at infinity.
TEST(Model, JsonWithRootsAndPointsAtInfinity) {
  const auto file = file_of("model/good_quarter_cylinder.json");
  const auto& patches = std::get<Model<Quadratic>>(file.model).patches;
  const Quadratic half_root(Rational(0), exact("1/2"), 2);
  EXPECT_EQ(patches[0].surface.point(1, 1), point4(half_root, half_root, half_root, half_root));
  EXPECT_EQ(patches[1].surface.point(1, 0), point4(Quadratic(0), Quadratic(1), Quadratic(0), Quadratic(0)));
  for (const auto& patch : patches) {
    EXPECT_TRUE(patch.is_rational);
    for (int k = 0; k <= 4; ++k) {
      const Quadratic u = Quadratic(k) / Quadratic(4);
      const auto p = evaluate(patch.surface, u, u);
      EXPECT_EQ(p[0] * p[0] + p[1] * p[1], p[3] * p[3]);
    }
  }
}

TEST(Model, WeightsThatAreAllOneMakeNoRationalPatch) {
  const auto file = test::read_good(test::json_patch(test::kSquare, ",\"weights\":[[1,1.0],[\"2/2\",1e0]]"), "m.json");
  EXPECT_FALSE(rational_model(file).patches[0].is_rational);
}

TEST(Model, Sha256OfTheBytesRead) {
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2
  const std::string bytes = test::json_patch(test::kSquare);
  EXPECT_EQ(test::read_good(bytes, "m.json").sha256, sha256_of(bytes));
  EXPECT_EQ(test::read_good("\xef\xbb\xbf" + bytes, "m.json").sha256, sha256_of("\xef\xbb\xbf" + bytes));
}

}  // namespace
}  // namespace patchproof
