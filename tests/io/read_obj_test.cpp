// SPDX-License-Identifier: Apache-2.0
// Free-form geometry in OBJ files, tinyspline's curves, and what Rhino writes.
#include <gtest/gtest.h>

#include "io/bad_files.h"
#include "io/io_support.h"

namespace patchproof {
namespace {

using test::exact;
using test::expect_errors;
using test::rational_model;
using test::read_good;

Model<Rational> good(const std::string& file) {
  const auto path = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "tests/data" / file;
  return rational_model(read_good(test::bytes_of(path), path.string()));
}
std::vector<Rational> numbers(std::initializer_list<const char*> texts) {
  std::vector<Rational> out;
  for (const char* text : texts) out.push_back(exact(text));
  return out;
}
Vec<Rational, 4> point(const char* x, const char* y, const char* z, const char* w = "1") {
  return {{exact(x), exact(y), exact(z), exact(w)}};
}

TEST(ReadObj, SurfacesAndCurves) {
  const Model<Rational> model = good("obj/good_free_form.obj");
  ASSERT_EQ(model.patches.size(), 2u);
  ASSERT_EQ(model.curves.size(), 1u);
  const auto& roof = model.patches[0];
  EXPECT_EQ(roof.name, "tent");
  EXPECT_TRUE(roof.is_rational);
  EXPECT_EQ(roof.surface.knots(Direction::u).knots(), numbers({"0", "0", "0", "3", "3", "3"}));
  EXPECT_EQ(roof.surface.point(1, 0), point("0", "1.5", "0.25"));
  EXPECT_EQ(roof.surface.point(1, 1), point("0", "3", "4.5", "2"));
  // Without "rat" the fourth number is no weight; pieces of Bézier meet at 1/4.
  const auto& strip = model.patches[1];
  EXPECT_EQ(strip.name, "strip");
  EXPECT_FALSE(strip.is_rational);
  EXPECT_EQ(strip.surface.knots(Direction::u).knots(), numbers({"0", "0", "0", "1/4", "1/4", "1", "1", "1"}));
  EXPECT_EQ(strip.surface.point(4, 1), point("4", "1", "1/8"));
  const auto& border = model.curves[0];
  EXPECT_EQ(border.name, "border");
  EXPECT_EQ(border.curve.knots().knots(), numbers({"0", "0", "0", "0", "2", "2", "2", "2"}));
  EXPECT_EQ(border.curve.points()[2], point("3", "0", "-1"));
}

TEST(ReadObj, WhatIsSkippedIsSaid) {
  const auto path = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "tests/data/obj/good_free_form.obj";
  EXPECT_EQ(read_good(test::bytes_of(path), "m.obj").notes,
            (std::vector<std::string>{"1 points, lines and faces skipped", "1 connections of surfaces (con) skipped"}));
}

std::string obj(const std::string& element, const std::string& head = "cstype bezier\ndeg 1 1\n") {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" + head + element;
}
const std::string kParameters = "parm u 0 1\nparm v 0 1\nend\n";

TEST(ReadObj, Errors) {
  const std::string surf = "surf 0 1 0 1 1 2 3 4\n";
  ASSERT_TRUE(read_model_text(obj(surf + kParameters), "m.obj"));
  expect_errors({
      {"polygons only", "m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", ErrorCode::unsupported, "m.obj:4", ""},
      {"trimmed", "m.obj", obj(surf + "parm u 0 1\nparm v 0 1\ntrim 0 1 1\nend\n"), ErrorCode::unsupported, "m.obj:10",
       "trim"},
      {"cardinal splines", "m.obj", obj(surf, "cstype cardinal\ndeg 3 3\n"), ErrorCode::unsupported, "m.obj:5",
       "cardinal"},
      {"a basis matrix", "m.obj", obj("bmat u 1 0 0 1\n"), ErrorCode::unsupported, "m.obj:7", "bmat"},
      {"part of the domain", "m.obj", obj("surf 0 0.5 0 1 1 2 3 4\n" + kParameters), ErrorCode::unsupported, "m.obj:7",
       "0.5"},
      {"no end", "m.obj", obj(surf + "parm u 0 1\n"), ErrorCode::syntax, "m.obj:8", ""},
      {"the next element inside", "m.obj", obj(surf + surf + kParameters), ErrorCode::syntax, "m.obj:8", "surf"},
      {"end outside", "m.obj", obj("end\n"), ErrorCode::syntax, "m.obj:7", "end"},
      {"parm outside", "m.obj", obj(kParameters), ErrorCode::syntax, "m.obj:7", "parm"},
      {"parm twice", "m.obj", obj(surf + "parm u 0 1\nparm u 0 1\n"), ErrorCode::syntax, "m.obj:9", "u"},
      {"no parm v", "m.obj", obj(surf + "parm u 0 1\nend\n"), ErrorCode::syntax, "m.obj:7", "surf"},
      {"no type", "m.obj", obj(surf + kParameters, "deg 1 1\n"), ErrorCode::syntax, "m.obj:6", "surf"},
      {"no degree", "m.obj", obj(surf + kParameters, "cstype bezier\n"), ErrorCode::bad_degree, "m.obj:6", "surf"},
      {"no degree along v", "m.obj", obj(surf + kParameters, "cstype bezier\ndeg 1\n"), ErrorCode::bad_degree,
       "m.obj:7", "surf"},
      {"degree 65", "m.obj", obj(surf, "cstype bezier\ndeg 1 65\n"), ErrorCode::bad_degree, "m.obj:6", "65"},
      {"degree 1.5", "m.obj", obj(surf, "cstype bezier\ndeg 1.5 1\n"), ErrorCode::syntax, "m.obj:6", "1.5"},
      {"vertex 5 of 4", "m.obj", obj("surf 0 1 0 1 1 2 3 5\n" + kParameters), ErrorCode::bad_reference, "m.obj:7", "5"},
      {"vertex 0", "m.obj", obj("surf 0 1 0 1 0 2 3 4\n" + kParameters), ErrorCode::bad_reference, "m.obj:7", "0"},
      {"vertex -5", "m.obj", obj("surf 0 1 0 1 -5 2 3 4\n" + kParameters), ErrorCode::bad_reference, "m.obj:7", "-5"},
      {"vertex x", "m.obj", obj("surf 0 1 0 1 x 2 3 4\n" + kParameters), ErrorCode::syntax, "m.obj:7", "x"},
      {"too few points", "m.obj", obj("surf 0 1 0 1 1 2 3\n" + kParameters), ErrorCode::wrong_count, "m.obj:7", "surf"},
      {"no points", "m.obj", obj("surf 0 1 0 1\n" + kParameters), ErrorCode::wrong_count, "m.obj:7", "surf"},
      {"too few knots", "m.obj", obj(surf + kParameters, "cstype bspline\ndeg 1 1\n"), ErrorCode::wrong_count,
       "m.obj:8", "0"},
      {"decreasing parameters", "m.obj", obj("surf 1 0 0 1 1 2 3 4\nparm u 1 0\nparm v 0 1\nend\n"),
       ErrorCode::decreasing_knots, "m.obj:8", "0 after 1"},
      {"a coordinate that is none", "m.obj", "v 0 0 nan\n" + obj("surf 0 1 0 1 1 2 3 4\n" + kParameters),
       ErrorCode::bad_number, "m.obj:1", "nan"},
      {"a bound that is none", "m.obj", obj("surf 0 1/0 0 1 1 2 3 4\n" + kParameters), ErrorCode::bad_number, "m.obj:7",
       "1/0"},
      {"a short vertex", "m.obj", obj("v 1 2\n"), ErrorCode::wrong_count, "m.obj:7", "v"},
      {"an unknown statement", "m.obj", obj("surface 1\n"), ErrorCode::syntax, "m.obj:7", "surface"},
      {"a pole", "m.obj", "v 0 0 0 -1\n" + obj(surf + kParameters, "cstype rat bezier\ndeg 1 1\n"),
       ErrorCode::vanishing_weight, "m.obj:1", "u in [0, 1], v in [0, 1]"},
  });
}

TEST(ReadTinyspline, ACurve) {
  const Model<Rational> model = good("tinyspline/good_arch.json");
  ASSERT_EQ(model.curves.size(), 1u);
  EXPECT_EQ(model.curves[0].dimension, 3);
  EXPECT_EQ(model.curves[0].curve.knots().knots(), numbers({"0", "0", "0", "1/2", "1", "1", "1"}));
  EXPECT_EQ(model.curves[0].curve.points()[2], point("3/2", "1/4", "1"));
}

TEST(ReadTinyspline, Errors) {
  const auto curve = [](const std::string& degree, const std::string& dimension, const std::string& points,
                        const std::string& knots) {
    return "{\"degree\":" + degree + ",\"dimension\":" + dimension + ",\n\"control_points\":" + points +
           ",\n\"knots\":" + knots + "}";
  };
  expect_errors({
      {"half a point", "m.json", curve("1", "2", "[0,0,1,1,2]", "[0,0,1,1]"), ErrorCode::wrong_count,
       "m.json:2 at /control_points", "5 coordinates"},
      {"too few points", "m.json", curve("1", "2", "[0,0]", "[0,0,1,1]"), ErrorCode::wrong_count,
       "m.json:1 at /control_points", "1 control points"},
      {"a list of points", "m.json", curve("1", "2", "[[0,0],[1,1]]", "[0,0,1,1]"), ErrorCode::syntax,
       "m.json:2 at /control_points/0", ""},
      {"dimension 1", "m.json", curve("1", "1", "[0,1]", "[0,0,1,1]"), ErrorCode::unsupported, "m.json:1 at /dimension",
       "1"},
      {"dimension 0", "m.json", curve("1", "0", "[0,1]", "[0,0,1,1]"), ErrorCode::unsupported, "m.json:1 at /dimension",
       "0"},
      {"a number that is none", "m.json", curve("1", "2", "[0,0,1,\"x\"]", "[0,0,1,1]"), ErrorCode::bad_number,
       "m.json:2 at /control_points/3", "x"},
      {"decreasing knots", "m.json", curve("1", "2", "[0,0,1,1]", "[0,1,0,1]"), ErrorCode::decreasing_knots,
       "m.json:3 at /knots/2", "0 after 1"},
      {"no knots", "m.json", "{\"degree\":1,\"dimension\":2,\"control_points\":[0,0,1,1]}", ErrorCode::syntax,
       "m.json:1 at /", ""},
  });
}

TEST(ReadRhino, IsRefusedByName) {
  expect_errors({
      {"a list of objects", "m.json", R"([{"version":10000,"archive3dm":60,"opennurbs":-1,"data":"x"}])",
       ErrorCode::unsupported, "m.json:1 at /0/archive3dm", ""},
      {"one object", "m.json", R"({"version":10000,"archive3dm":60,"data":"x"})", ErrorCode::unsupported,
       "m.json:1 at /archive3dm", ""},
      {".3dm", "m.3dm", "3D Geometry File Format        5", ErrorCode::unsupported, "m.3dm", ""},
  });
}

}  // namespace
}  // namespace patchproof
