// SPDX-License-Identifier: Apache-2.0
// Bad curves in our JSON model; those of other formats stand in read_errors_test.cpp.
#include "io/bad_files.h"
#include "io/io_support.h"

namespace patchproof {
namespace {

using test::expect_errors;
using test::json_curve;
using test::kArc;

// Every error of a patch, for a curve.
TEST(ReadCurveErrors, OfOurJson) {
  const auto knots = [](const std::string& list) { return json_curve(kArc, ",\n\"knots\":" + list); };
  const auto weights = [](const std::string& list) { return json_curve(kArc, ",\n\"weights\":" + list); };
  const std::string head = "{\"format\":\"patchproof-model\",\"version\":1";
  expect_errors({
      {"neither patches nor curves", "m.json", head + ",\"curves\":[]}", ErrorCode::wrong_count, "m.json:1 at /", ""},
      {"nothing at all", "m.json", head + "}", ErrorCode::wrong_count, "m.json:1 at /", ""},
      {"misspelt key", "m.json", json_curve(kArc, ",\n\"knot\":[]"), ErrorCode::syntax, "m.json:5 at /curves/0/knot",
       "knot"},
      {"two degrees", "m.json", json_curve(kArc, "", "[1,2]"), ErrorCode::syntax, "m.json:3 at /curves/0/degree", ""},
      {"negative degree", "m.json", json_curve(kArc, "", "-1"), ErrorCode::bad_degree, "m.json:3 at /curves/0/degree",
       "-1"},
      {"degree 65", "m.json", json_curve(kArc, "", "65"), ErrorCode::bad_degree, "m.json:3 at /curves/0/degree", "65"},
      {"missing points", "m.json", head + ",\"curves\":[{\"degree\":1}]}", ErrorCode::syntax, "m.json:1 at /curves/0",
       ""},
      {"no points", "m.json", json_curve("[]"), ErrorCode::wrong_count, "m.json:3 at /curves/0/control_points",
       "0 control points"},
      {"a net", "m.json", json_curve("[[[0,0],[1,1],[2,0]]]"), ErrorCode::syntax,
       "m.json:4 at /curves/0/control_points/0/0", ""},
      {"mixed dimensions", "m.json", json_curve("[[0,0],[1,1,1],[2,0]]"), ErrorCode::wrong_count,
       "m.json:4 at /curves/0/control_points/1", "3"},
      {"points on a line", "m.json", json_curve("[[0],[1],[2]]"), ErrorCode::wrong_count,
       "m.json:4 at /curves/0/control_points/0", "1"},
      {"points of four numbers that are not said to be homogeneous", "m.json",
       json_curve("[[0,0,0,1],[1,1,0,1],[2,0,0,1]]"), ErrorCode::wrong_count, "m.json:4 at /curves/0/control_points/0",
       "4"},
      {"homogeneous points of two numbers", "m.json", json_curve(kArc, ",\"homogeneous\":true"), ErrorCode::wrong_count,
       "m.json:4 at /curves/0/control_points/0", "2"},
      {"weights twice", "m.json", json_curve("[[0,0,1],[1,1,1],[2,0,1]]", ",\"homogeneous\":true,\"weights\":[1,1,1]"),
       ErrorCode::syntax, "m.json:5 at /curves/0", ""},
      {"too few points", "m.json", json_curve("[[0,0],[1,1]]"), ErrorCode::wrong_count,
       "m.json:3 at /curves/0/control_points", "2 control points"},
      {"knots for fewer points", "m.json", knots("[0,0,1,1]"), ErrorCode::wrong_count, "m.json:5 at /curves/0/knots",
       "4 knots"},
      {"decreasing knots", "m.json", knots("[0,0,0,1,\n0.5,1]"), ErrorCode::decreasing_knots,
       "m.json:6 at /curves/0/knots/4", "0.5 after 1"},
      {"empty domain", "m.json", knots("[0,1,1,1,1,2]"), ErrorCode::empty_domain, "m.json:5 at /curves/0/knots", "0"},
      {"a knot that is none", "m.json", knots("[0,0,0,1,1,\"nan\"]"), ErrorCode::bad_number,
       "m.json:5 at /curves/0/knots/5", "nan"},
      {"nested knots", "m.json", knots("[[0,0,0,1,1,1]]"), ErrorCode::syntax, "m.json:5 at /curves/0/knots/0", ""},
      {"too few weights", "m.json", weights("[1,1]"), ErrorCode::wrong_count, "m.json:5 at /curves/0/weights",
       "2 weights"},
      {"no weights", "m.json", weights("[]"), ErrorCode::wrong_count, "m.json:3 at /curves/0/weights", "0 weights"},
      {"a pole inside", "m.json", weights("[1,-1,1]"), ErrorCode::vanishing_weight, "m.json:5 at /curves/0/weights",
       "t = 1/2"},
      {"two poles inside", "m.json", weights("[2,\"-5/2\",2]"), ErrorCode::vanishing_weight,
       "m.json:5 at /curves/0/weights", "t = 1/3, t = 2/3"},
      {"a pole at the end", "m.json", weights("[1,1,0]"), ErrorCode::vanishing_weight, "m.json:5 at /curves/0/weights",
       "t = 1"},
      {"a pole among homogeneous points", "m.json", json_curve("[[0,0,1],[-1,-1,-1],[2,0,1]]", ",\"homogeneous\":true"),
       ErrorCode::vanishing_weight, "m.json:3 at /curves/0/control_points", "t = 1/2"},
      {"a coordinate that is none", "m.json", json_curve("[[0,0],[1,\"x\"],[2,0]]"), ErrorCode::bad_number,
       "m.json:4 at /curves/0/control_points/1/1", "x"},
      {"mixed roots", "m.json", weights("[1,\"sqrt(2)\",\"sqrt(3)\"]"), ErrorCode::mixed_roots,
       "m.json:5 at /curves/0/weights/2", "sqrt(2) and sqrt(3)"},
      {"a join beside curves only", "m.json",
       head +
           ",\"curves\":[{\"degree\":0,\"control_points\":[[0,0]]}],\"joins\":[{\"a\":{\"patch\":0,\"edge\":\"u_max\"},"
           "\"b\":{\"patch\":0,\"edge\":\"u_min\"}}]}",
       ErrorCode::bad_reference, "m.json:1 at /joins/0/a/patch", "0"},
  });
}

}  // namespace
}  // namespace patchproof
