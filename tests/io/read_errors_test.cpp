// SPDX-License-Identifier: Apache-2.0
// Bad input of every format: the error's code, its place and the values exactly as read.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "io/bad_files.h"
#include "io/io_support.h"
#include "patchproof/io/read.h"

namespace patchproof {
namespace {

using test::gismo_patch;
using test::json_patch;
using test::kSquare;

using test::Bad;
using test::expect_error;
using test::expect_errors;

std::string bpt(const std::string& last) { return "1 # one patch\n1 1\n0 0 0\n0 1 0\n1 0 0\n" + last; }
std::string g2(const std::string& u_knots, const std::string& last = "1 1 0",
               const std::string& head = "200 1 0 0\n3 0\n2 2\n") {
  return head + u_knots + "\n2 2\n0 0 1 1\n0 0 0\n1 0 0\n0 1 0\n" + last + "\n";
}
std::string geomdl(const std::string& more, const std::string& knots_u = "[0,0,1,1]",
                   const std::string& type = "surface") {
  return "{\"shape\":{\"type\":\"" + type +
         "\",\"data\":[{\"degree_u\":1,\"degree_v\":1,\n\"knotvector_u\":" + knots_u +
         ",\n\"knotvector_v\":[0,0,1,1],\"size_u\":2,\"size_v\":2,\n" + more + "}]}}";
}
const std::string kPoints = "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]";
const std::string kRunTogether = "-0.565656565656572.45286195286198";

TEST(ReadErrors, Bpt) {
  expect_errors({
      {"two numbers run together", "m.bpt", bpt("1 " + kRunTogether), ErrorCode::bad_number, "m.bpt:6", kRunTogether},
      {"run together, more follows", "m.bpt", bpt("1 " + kRunTogether + " 5\n"), ErrorCode::bad_number, "m.bpt:6",
       kRunTogether},
      {"nan", "m.bpt", bpt("1 1 nan\n"), ErrorCode::bad_number, "m.bpt:6", "nan"},
      {"inf", "m.bpt", bpt("1 1 -inf\n"), ErrorCode::bad_number, "m.bpt:6", "-inf"},
      {"infinity", "m.bpt", bpt("1 1 1e999999999\n"), ErrorCode::bad_number, "m.bpt:6", "1e999999999"},
      {"decimal comma", "m.bpt", bpt("1 1 0,5\n"), ErrorCode::bad_number, "m.bpt:6", "0,5"},
      {"zero denominator", "m.bpt", bpt("1 1 1/0\n"), ErrorCode::bad_number, "m.bpt:6", "1/0"},
      {"too large", "m.bpt", bpt("1 1 1e302\n"), ErrorCode::bad_number, "m.bpt:6", "1e302"},
      {"truncated", "m.bpt", bpt("1 1\n"), ErrorCode::syntax, "m.bpt:6", "11 of 12 coordinates"},
      {"more patches announced", "m.bpt", "\n2\n1 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n", ErrorCode::wrong_count, "m.bpt:2",
       "2"},
      {"fewer patches announced", "m.bpt", bpt("1 1 0\n1 1\n0 0 0"), ErrorCode::wrong_count, "m.bpt:7", "1"},
      {"a billion patches announced", "m.bpt", "1000000000\n1 1\n0 0 0\n", ErrorCode::syntax, "m.bpt:3",
       "3 of 12 coordinates"},
      {"no patches", "m.bpt", "0\n", ErrorCode::wrong_count, "m.bpt:1", "0"},
      {"degree 0", "m.bpt", "1\n0 1\n0 0 0\n0 1 0\n", ErrorCode::bad_degree, "m.bpt:2", "0"},
      {"degree -3", "m.bpt", "1\n1 -3\n0 0 0\n0 1 0\n", ErrorCode::bad_degree, "m.bpt:2", "-3"},
      {"degree 65", "m.bpt", "1\n65 1\n", ErrorCode::bad_degree, "m.bpt:2", "65"},
      {"degree no number", "m.bpt", "1\nx 1\n", ErrorCode::syntax, "m.bpt:2", "x"},
      {"header no number", "m.bpt", "patches: 3\n1 1\n", ErrorCode::syntax, "m.bpt:1", "patches:"},
      {"control characters", "m.bpt", bpt("1 1 \x01\x02\n"), ErrorCode::bad_number, "m.bpt:6", "\\x01\\x02"},
      {"only a comment", "m.bpt", "# nothing\n", ErrorCode::syntax, "m.bpt:1", ""},
  });
}

TEST(ReadErrors, Bez) {
  const std::string row = "0 0 0 0 1 0 0 2 0 0 3 0\n";
  expect_errors({
      {"more announced", "m.bez", "2\n" + row + row + row + row, ErrorCode::wrong_count, "m.bez:1", "2"},
      {"fewer announced", "m.bez", "1\n" + row + row + row + row + row, ErrorCode::wrong_count, "m.bez:6", "0"},
      {"truncated", "m.bez", "1\n" + row + row + row, ErrorCode::syntax, "m.bez:4", "36 of 48 coordinates"},
      {"bad number", "m.bez", "1\n" + row + row + row + "0 0 0 0 1 0 0 2 0 0 3 1.2.3", ErrorCode::bad_number, "m.bez:5",
       "1.2.3"},
  });
}

TEST(ReadErrors, Newell) {
  const std::string indices = "1,2,1,2,1,2,1,2,1,2,1,2,1,2,1,2\n";
  expect_errors({
      {"wrong width", "teapot", "1\n1,2,3\n2\n0,0,0\n1,1,1\n", ErrorCode::wrong_count, "teapot:2", "1,2,3"},
      {"index 0", "teapot", "1\n0" + indices.substr(1) + "2\n0,0,0\n1,1,1\n", ErrorCode::bad_reference, "teapot:2",
       "0"},
      {"index 3", "teapot", "1\n3" + indices.substr(1) + "2\n0,0,0\n1,1,1\n", ErrorCode::bad_reference, "teapot:2",
       "3"},
      {"index x", "teapot", "1\nx" + indices.substr(1) + "2\n0,0,0\n1,1,1\n", ErrorCode::syntax, "teapot:2", "x"},
      {"missing index", "teapot", "1\n" + indices.substr(1) + "2\n0,0,0\n1,1,1\n", ErrorCode::syntax, "teapot:2", ""},
      {"more vertices announced", "teapot", "1\n" + indices + "3\n0,0,0\n1,1,1\n", ErrorCode::wrong_count, "teapot:3",
       "3"},
      {"fewer vertices announced", "teapot", "1\n" + indices + "1\n0,0,0\n1,1,1\n", ErrorCode::wrong_count, "teapot:5",
       "1,1,1"},
      {"more patches announced", "teapot", "2\n" + indices + "2\n0,0,0\n1,1,1\n", ErrorCode::wrong_count, "teapot:3",
       "2"},
      {"only indices", "teapot", "1\n" + indices, ErrorCode::syntax, "teapot:2", ""},
      {"run together", "teapot", "1\n" + indices + "2\n0,0,0\n1,1," + kRunTogether + "\n", ErrorCode::bad_number,
       "teapot:5", kRunTogether},
      {"blank inside a number", "teapot", "1\n" + indices + "2\n0,0,0\n1,1,1 5\n", ErrorCode::bad_number, "teapot:5",
       "1 5"},
  });
}

TEST(ReadErrors, G2) {
  const std::string rational = "200 1 0 0\n3 1\n2 2\n0 0 1 1\n2 2\n0 0 1 1\n0 0 0 1\n1 0 0 -1\n0 1 0 1\n1 1 0 1\n";
  expect_errors({
      {"run together", "m.g2", g2("0 0 1 1", "1 1 " + kRunTogether), ErrorCode::bad_number, "m.g2:10", kRunTogether},
      {"decreasing knots", "m.g2", g2("0 1 0.5 1"), ErrorCode::decreasing_knots, "m.g2:4", "0.5 after 1"},
      {"multiplicity too high", "m.g2", g2("0 0 0 1"), ErrorCode::bad_multiplicity, "m.g2:4", "0"},
      {"empty domain", "m.g2", g2("2 2 2 2"), ErrorCode::empty_domain, "m.g2:4", "2"},
      {"knot nan", "m.g2", g2("0 0 1 nan"), ErrorCode::bad_number, "m.g2:4", "nan"},
      {"truncated coefficients", "m.g2", g2("0 0 1 1", "1 1"), ErrorCode::syntax, "m.g2:10", ""},
      {"truncated knots", "m.g2", "200 1 0 0\n3 0\n2 2\n0 0 1", ErrorCode::syntax, "m.g2:4", ""},
      {"order 1", "m.g2", "200 1 0 0\n3 0\n2 1\n0 0 1\n", ErrorCode::bad_degree, "m.g2:3", "1"},
      {"order 66", "m.g2", "200 1 0 0\n3 0\n99 66\n", ErrorCode::bad_degree, "m.g2:3", "66"},
      {"too few coefficients", "m.g2", "200 1 0 0\n3 0\n2 4\n0 0 0 0 1 1\n", ErrorCode::wrong_count, "m.g2:3",
       "2 coefficients, order 4"},
      {"huge counts", "m.g2", "200 1 0 0\n3 0\n1000000000 4\n0 0 0 0 1 1\n", ErrorCode::syntax, "m.g2:4", ""},
      {"dimension 4", "m.g2", "200 1 0 0\n4 0\n", ErrorCode::unsupported, "m.g2:2", "4"},
      {"volume", "m.g2", "700 1 0 0\n3 0\n", ErrorCode::unsupported, "m.g2:1", "700"},
      {"only a curve of dimension 1", "m.g2", "100 1 0 0\n1 0\n2 2\n0 0 1 1\n0\n1\n", ErrorCode::unsupported, "m.g2:6",
       ""},
      {"a curve with decreasing knots", "m.g2", "100 1 0 0\n3 0\n2 2\n0 1 0 1\n0 0 0\n1 1 1\n",
       ErrorCode::decreasing_knots, "m.g2:4", "0 after 1"},
      {"a curve of order 0", "m.g2", "100 1 0 0\n3 0\n2 0\n0 1\n", ErrorCode::bad_degree, "m.g2:3", "0"},
      {"a curve with a pole", "m.g2", "100 1 0 0\n2 1\n2 2\n0 0 1 1\n0 0 1\n1 1 -2\n", ErrorCode::vanishing_weight,
       "m.g2:1", "t = 1/3"},
      {"curve with a bad number", "m.g2", "100 1 0 0\n3 0\n2 2\n0 0 1 1\n0 0 0\n1 1 x\n", ErrorCode::bad_number,
       "m.g2:6", "x"},
      {"vanishing denominator", "m.g2", rational, ErrorCode::vanishing_weight, "m.g2:1", "u in [0, 1], v in [0, 1]"},
      {"rest after the last object", "m.g2", g2("0 0 1 1") + "17\n", ErrorCode::syntax, "m.g2:11", ""},
  });
}

TEST(ReadErrors, TrimmedSurfacesAreUnsupported) {
  const std::string whole =
      test::bytes_of(std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "tests/data/g2/good_curve_and_surfaces.g2");
  const std::string line = std::to_string(1 + std::count(whole.begin(), whole.begin() + whole.find("210 1 0 0"), '\n'));
  // One digit of a corner, of the order of the curves, of the number of loops.
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string out = whole;
    out.replace(out.rfind(from), from.size(), to);
    return out;
  };
  expect_errors({
      {"a corner cut off", "m.g2", changed("0.25 2\n0 2\n", "0.25 2\n0.5 2\n"), ErrorCode::unsupported, "m.g2:" + line,
       "a loop inside the domain"},
      {"a curve off its side", "m.g2", changed("0.25 2\n0 2\n", "0.25 1.5\n0 2\n"), ErrorCode::unsupported,
       "m.g2:" + line, "a loop inside the domain"},
      {"not closed", "m.g2", changed("0 2\n0 0\n", "0 2\n0 0.1\n"), ErrorCode::unsupported, "m.g2:" + line,
       "a loop inside the domain"},
      {"unclamped", "m.g2", changed("0 0 0.5 1 1\n", "0 0.1 0.5 1 1\n"), ErrorCode::unsupported, "m.g2:" + line,
       "a loop inside the domain"},
      {"two loops", "m.g2", changed("1\n4 0.0001\n", "2\n4 0.0001\n"), ErrorCode::unsupported, "m.g2:" + line,
       "2 loops"},
      {"a circle", "m.g2", changed("1 100 100\n", "1 130 100\n"), ErrorCode::unsupported, "m.g2:" + line,
       "curve classes 130 and 100"},
  });
}

TEST(ReadErrors, Gismo) {
  const std::string square = "0 0 0 1 0 0 0 1 0 1 1 0";
  expect_errors({
      {"run together", "m.xml", gismo_patch("0 0 0 1 0 0 0 1 0\n1 1 " + kRunTogether), ErrorCode::bad_number,
       "m.xml:10", kRunTogether},
      {"one coordinate short", "m.xml", gismo_patch("0 0 0 1 0 0 0 1 0 1 1"), ErrorCode::wrong_count, "m.xml:9",
       "11 coordinates"},
      {"weights short", "m.xml", gismo_patch(square, "1 1 1"), ErrorCode::wrong_count, "m.xml:9", "3 weights"},
      {"weight zero makes the denominator vanish", "m.xml", gismo_patch(square, "1 0 1 1"), ErrorCode::vanishing_weight,
       "m.xml:9", "u in [1, 1], v in [0, 0]"},
      {"decreasing knots", "m.xml", gismo_patch(square, "", "0 0 1 0.5"), ErrorCode::decreasing_knots, "m.xml:6",
       "0.5 after 1"},
      {"too few knots", "m.xml", gismo_patch(square, "", "0 1 2"), ErrorCode::wrong_count, "m.xml:6", "3 knots"},
      {"dimension 1", "m.xml", gismo_patch("0 0 0 0", "", "0 0 1 1", "1"), ErrorCode::unsupported, "m.xml:9", "1"},
      {"dimension x", "m.xml", gismo_patch(square, "", "0 0 1 1", "x"), ErrorCode::syntax, "m.xml:9", "x"},
      {"no coefficients", "m.xml", "<xml><Geometry type=\"TensorBSpline2\"/></xml>", ErrorCode::syntax, "m.xml:1", ""},
      {"THB spline", "m.xml", "<xml>\n<Geometry type=\"THBSpline2\"/></xml>", ErrorCode::unsupported, "m.xml:2",
       "THBSpline2"},
  });
}

TEST(ReadErrors, GismoReferences) {
  std::string xml = gismo_patch("0 0 0 1 0 0 0 1 0 1 1 0");
  xml.insert(xml.find("</xml>"), "<MultiPatch><patches type=\"id_range\">0 1</patches></MultiPatch>\n");
  expect_errors({
      {"a patch that is not there", "m.xml", xml, ErrorCode::bad_reference, "m.xml:11", "1"},
      {"no geometry", "m.xml", "<xml></xml>", ErrorCode::unsupported, "m.xml:1", ""},
      {"other XML", "m.xml", "<svg></svg>", ErrorCode::unknown_format, "m.xml:1", ""},
      {"zero byte", "m.xml", std::string("<xml>\n\0</xml>", 13), ErrorCode::syntax, "m.xml:2", ""},
  });
}

TEST(ReadErrors, JsonModel) {
  expect_errors({
      {"misspelt key", "m.json", json_patch(kSquare, ",\n\"weigths\":[[1,1],[1,1]]"), ErrorCode::syntax,
       "m.json:5 at /patches/0/weigths", "weigths"},
      {"key twice", "m.json", json_patch(kSquare, ",\n\"degree\":[1,1]"), ErrorCode::syntax,
       "m.json:5 at /patches/0/degree", "degree"},
      {"missing degree", "m.json",
       "{\"format\":\"patchproof-model\",\"version\":1,\"patches\":[{\"control_points\":" + kSquare + "}]}",
       ErrorCode::syntax, "m.json:1 at /patches/0", ""},
      {"other format", "m.json", "{\"format\":\"gltf\"}", ErrorCode::unknown_format, "m.json:1 at /format", "gltf"},
      {"other version", "m.json", "{\"format\":\"patchproof-model\",\n\"version\":2}", ErrorCode::unsupported,
       "m.json:2 at /version", "2"},
      {"neither format nor shape", "m.json", "{\"a\":[1,{\"b\":2}]}", ErrorCode::unknown_format, "m.json", ""},
      {"an array", "m.json", "[1,2]", ErrorCode::syntax, "m.json:1 at /0", "1"},
      {"no patches", "m.json", "{\"format\":\"patchproof-model\",\"version\":1,\"patches\":[]}", ErrorCode::wrong_count,
       "m.json:1 at /", ""},
      {"point of two numbers", "m.json", json_patch("[[[0,0],[0,1]],[[1,0],[1,1]]]"), ErrorCode::wrong_count,
       "m.json:4 at /patches/0/control_points/0/0", "2"},
      {"point of another length", "m.json", json_patch("[[[0,0,0],[0,1,0,1]],[[1,0,0],[1,1,0]]]"),
       ErrorCode::wrong_count, "m.json:4 at /patches/0/control_points/0/1", "4"},
      {"ragged rows", "m.json", json_patch("[[[0,0,0],[0,1,0]],[[1,0,0]]]"), ErrorCode::wrong_count,
       "m.json:4 at /patches/0/control_points/1", "1"},
      {"too few points", "m.json", json_patch("[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]", "", "[1,2]"),
       ErrorCode::wrong_count, "m.json:3 at /patches/0/control_points", "2 control points"},
      {"bad number in a string", "m.json", json_patch("[[[0,0,0],[0,1,\"1.2.3\"]],[[1,0,0],[1,1,0]]]"),
       ErrorCode::bad_number, "m.json:4 at /patches/0/control_points/0/1/2", "1.2.3"},
      {"bad bare number", "m.json", json_patch("[[[0,0,0],[0,1," + kRunTogether + "]],[[1,0,0],[1,1,0]]]"),
       ErrorCode::bad_number, "m.json:4 at /patches/0/control_points/0/1/3", kRunTogether},
      {"bare nan", "m.json", json_patch("[[[0,0,0],[0,1,NaN]],[[1,0,0],[1,1,0]]]"), ErrorCode::bad_number,
       "m.json:4 at /patches/0/control_points/0/1/2", "NaN"},
      {"nan in a string", "m.json", json_patch("[[[0,0,0],[0,1,\"nan\"]],[[1,0,0],[1,1,0]]]"), ErrorCode::bad_number,
       "m.json:4 at /patches/0/control_points/0/1/2", "nan"},
      {"null", "m.json", json_patch("[[[0,0,0],[0,1,null]],[[1,0,0],[1,1,0]]]"), ErrorCode::syntax,
       "m.json:4 at /patches/0/control_points/0/1/2", "null"},
      {"beyond doubles", "m.json", json_patch("[[[0,0,0],[0,1,1e400]],[[1,0,0],[1,1,0]]]"), ErrorCode::bad_number,
       "m.json:4 at /patches/0/control_points/0/1/2", "1e400"},
      {"an escaped quote in a number", "m.json", json_patch("[[[0,0,0],[0,1,\"1\\\"2\"]],[[1,0,0],[1,1,0]]]"),
       ErrorCode::bad_number, "m.json at /patches/0/control_points/0/1/2", "1\"2"},
      {"degree 0", "m.json", json_patch(kSquare, "", "[0,1]"), ErrorCode::bad_degree, "m.json:3 at /patches/0/degree/0",
       "0"},
      {"degree 2.5", "m.json", json_patch(kSquare, "", "[1,2.5]"), ErrorCode::syntax, "m.json:3 at /patches/0/degree/1",
       "2.5"},
      {"three degrees", "m.json", json_patch(kSquare, "", "[1,1,1]"), ErrorCode::wrong_count,
       "m.json:3 at /patches/0/degree/2", "1"},
      {"one knot vector", "m.json", json_patch(kSquare, ",\n\"knots\":[[0,0,1,1]]"), ErrorCode::wrong_count,
       "m.json:5 at /patches/0/knots", "1"},
      {"decreasing knots", "m.json", json_patch(kSquare, ",\n\"knots\":[[0,0,1,1],[0,0,\n\"1/2\",0.25]]"),
       ErrorCode::decreasing_knots, "m.json:6 at /patches/0/knots/1/3", "0.25 after 1/2"},
      {"multiplicity", "m.json", json_patch(kSquare, ",\n\"knots\":[[0,0,1,1],[0,1,1,1]]"), ErrorCode::bad_multiplicity,
       "m.json:5 at /patches/0/knots/1/1", "1"},
      {"weights of another shape", "m.json", json_patch(kSquare, ",\n\"weights\":[[1,1,1,1]]"), ErrorCode::wrong_count,
       "m.json:5 at /patches/0/weights", "1 x 4 weights"},
      {"weights twice", "m.json",
       json_patch("[[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]]", ",\"weights\":[[1,1],[1,1]]"), ErrorCode::syntax,
       "m.json:5 at /patches/0", ""},
      {"denominator vanishes", "m.json", json_patch(kSquare, ",\n\"weights\":[[1,1],[0,1]]"),
       ErrorCode::vanishing_weight, "m.json:5 at /patches/0/weights", "u in [1, 1], v in [0, 0]"},
      {"mixed roots", "m.json", json_patch(kSquare, ",\n\"weights\":[[1,\"sqrt(2)\"],[1,\"1+sqrt(3)\"]]"),
       ErrorCode::mixed_roots, "m.json:5 at /patches/0/weights/1/1", "sqrt(2) and 1+sqrt(3)"},
      {"weighted point too large", "m.json",
       json_patch("[[[0,0,0],[0,1,0]],[[1e200,0,0],[1,1,0]]]", ",\n\"weights\":[[1,1],[1e200,1]]"),
       ErrorCode::bad_number, "m.json:4 at /patches/0/control_points/1/0/0", "1e200 with weight 1e200"},
      {"truncated", "m.json", json_patch(kSquare).substr(0, 100), ErrorCode::syntax,
       "m.json:4 at /patches/0/control_points/0/1/1", "0"},
      {"trailing text", "m.json", json_patch(kSquare) + "\n}", ErrorCode::syntax, "m.json:7 at /", "}"},
      {"join to patch 1", "m.json",
       json_patch(kSquare).substr(0, json_patch(kSquare).size() - 1) +
           ",\n\"joins\":[{\"a\":{\"patch\":0,\"edge\":\"u_max\"},\n\"b\":{\"patch\":1,\"edge\":\"u_min\"}}]}",
       ErrorCode::bad_reference, "m.json:8 at /joins/0/b/patch", "1"},
      {"join to an edge that is none", "m.json",
       "{\"format\":\"patchproof-model\",\"version\":1,\n\"joins\":[{\"a\":{\"patch\":0,\"edge\":\"u_mid\"}}]}",
       ErrorCode::bad_reference, "m.json:2 at /joins/0/a/edge", "u_mid"},
  });
}

TEST(ReadErrors, Geomdl) {
  const std::string net = "\"control_points\":{" + kPoints + "}";
  expect_errors({
      {"rational without weights", "m.json", geomdl("\"rational\":true,\n" + net), ErrorCode::wrong_count,
       "m.json:1 at /shape/data/0/control_points/weights", "0 weights"},
      {"weights without rational", "m.json",
       geomdl("\"rational\":false,\n\"control_points\":{" + kPoints + ",\"weights\":[1,1,1,1]}"), ErrorCode::syntax,
       "m.json:5 at /shape/data/0", ""},
      {"decreasing knots", "m.json", geomdl("\"rational\":false," + net, "[0,0,1,0.5]"), ErrorCode::decreasing_knots,
       "m.json:2 at /shape/data/0/knotvector_u/3", "0.5 after 1"},
      {"dimension", "m.json", geomdl("\"rational\":false,\"dimension\":2,\n" + net), ErrorCode::wrong_count,
       "m.json:5 at /shape/data/0", "points of 3 numbers"},
      {"trimmed", "m.json", geomdl("\"rational\":false,\"trims\":{\"count\":1},\n" + net), ErrorCode::unsupported,
       "m.json:4 at /shape/data/0/trims", ""},
      {"volume", "m.json", "{\"shape\":{\"type\":\"volume\"}}", ErrorCode::unsupported, "m.json:1 at /shape/type",
       "volume"},
      {"a surface that lacks a size", "m.json",
       "{\"shape\":{\"type\":\"surface\",\"data\":[{\"rational\":false,\"degree_u\":1,\"degree_v\":1,\"knotvector_u\":["
       "],"
       "\"knotvector_v\":[],\"size_u\":2," +
           net + "}]}}",
       ErrorCode::syntax, "m.json:1 at /shape/data/0", ""},
      {"a surface among curves", "m.json", geomdl("\"rational\":false," + net, "[0,0,1,1]", "curve"), ErrorCode::syntax,
       "m.json:4 at /shape", "curve"},
      {"no surfaces", "m.json", "{\"shape\":{\"type\":\"surface\",\"data\":[]}}", ErrorCode::wrong_count,
       "m.json:1 at /shape", ""},
      {"bad point", "m.json",
       geomdl("\"rational\":false,\n\"control_points\":{\"points\":[[0,0,0],[0,1,\"x\"],[1,0,0],[1,1,0]]}"),
       ErrorCode::bad_number, "m.json:5 at /shape/data/0/control_points/points/1/2", "x"},
  });
}

TEST(ReadErrors, SizesThatNobodyMeant) {
  const std::string digits(1000000, '7'), decimal = "0." + digits;
  const std::string deep(1000000, '['), objects = [] {
    std::string out;
    for (int i = 0; i < 100000; ++i) out += "{\"shape\":";
    return out;
  }();
  for (const std::string& number : {digits, decimal}) {
    for (const std::string& bytes :
         {bpt("1 1 " + number), g2("0 0 1 1", "1 1 " + number), gismo_patch("0 0 0 1 0 0 0 1 0 1 1 " + number),
          json_patch("[[[0,0,0],[0,1,0]],[[1,0,0],[1,1," + number + "]]]"),
          json_patch("[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,\"" + number + "\"]]]")}) {
      const auto file = read_model_text(bytes, "m");
      ASSERT_FALSE(file);
      EXPECT_EQ(file.error().code, ErrorCode::bad_number) << file.error().text();
      EXPECT_LT(file.error().values.size(), 400u);
      EXPECT_NE(file.error().values.find("777"), std::string::npos);
    }
  }
  const std::string head = "{\"format\":\"patchproof-model\",\"version\":1,\"patches\":";
  for (const std::string& bytes :
       {deep, objects, head + deep, "{\"shape\":{\"type\":\"surface\",\"delta\":" + deep, head + "[" + objects}) {
    const auto file = read_model_text(bytes, "m.json");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::syntax) << file.error().text();
    EXPECT_LT(file.error().text().size(), 1000u);
  }
}

TEST(ReadErrors, Recognition) {
  expect_errors({
      {"empty", "m.bpt", "", ErrorCode::empty_input, "m.bpt", ""},
      {"blanks", "m.bpt", " \n\t\r\n", ErrorCode::empty_input, "m.bpt", ""},
      {"a letter", "letter.txt", "Dear reader,\nhere are my patches.\n", ErrorCode::unknown_format, "letter.txt", ""},
      {"binary", "m.3dm",
       std::string("\x7f"
                   "ELF\0\0\1",
                   7),
       ErrorCode::unknown_format, "m.3dm", ""},
      {"only a count", "m", "32\n", ErrorCode::unknown_format, "m", ""},
      {"only a count, .bpt", "m.BPT", "32\n", ErrorCode::wrong_count, "m.BPT:1", "32"},
  });
}

// In a folder that is removed at the end.
class ReadErrorsOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "patchproof-read-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(ReadErrorsOnDisk, WhatIsNoReadableFile) {
  const std::string missing = (folder_ / "missing.bpt").string(), pipe = (folder_ / "pipe.bpt").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_error({"directory", "", "", ErrorCode::cannot_open, folder_.string(), ""}, read_model(folder_.string()));
  expect_error({"missing", "", "", ErrorCode::cannot_open, missing, ""}, read_model(missing));
  expect_error({"pipe", "", "", ErrorCode::cannot_open, pipe, ""}, read_model(pipe));  // without waiting for a writer
  expect_error({"empty path", "", "", ErrorCode::cannot_open, "", ""}, read_model(""));
  const std::string empty = file("empty.json", "");
  expect_error({"empty", "", "", ErrorCode::empty_input, empty, ""}, read_model(empty));
}

TEST_F(ReadErrorsOnDisk, NoPermission) {
  const std::string path = file("secret.bpt", bpt("1 1 0\n"));
  ASSERT_TRUE(read_model(path));
  std::filesystem::permissions(path, std::filesystem::perms::none);
  constexpr uid_t kNobody = 65534;
  const bool is_root = geteuid() == 0;  // whom no permission stops
  if (is_root && seteuid(kNobody) != 0) GTEST_SKIP() << "root, and cannot become another user for a moment";
  const auto result = read_model(path);
  ASSERT_TRUE(!is_root || seteuid(0) == 0);
  expect_error({"no permission", "", "", ErrorCode::cannot_open, path, ""}, result);
}

TEST_F(ReadErrorsOnDisk, TheBadFilesOfTheTestData) {
  for (const auto& path : test::data_files("bad_")) {
    const auto result = read_model(path.string());
    ASSERT_FALSE(result) << path;
    EXPECT_EQ(result.error().where.rfind(path.string() + ":", 0), 0u) << result.error().text();
  }
}

}  // namespace
}  // namespace patchproof
