// SPDX-License-Identifier: Apache-2.0
// The curves of the examples in "Curves, surfaces and splines with LAR" (test08 to test13), with the lost data restored, and
// a few with rarer knots. Tests of figures worked out independently of this library refer to them by name.
#pragma once

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/curve.h"

namespace patchproof::test {

// "0 1/2 -3" as numbers.
inline std::vector<Rational> numbers_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<Rational> out;
  for (std::string word; in >> word;) out.push_back(Rational(word));
  return out;
}

// "0 1  1/2 3" as points of the plane.
inline std::vector<Vec<Rational, 2>> points_of(const std::string& text) {
  const std::vector<Rational> x = numbers_of(text);
  std::vector<Vec<Rational, 2>> out;
  for (std::size_t i = 0; i + 1 < x.size(); i += 2) out.push_back({{x[i], x[i + 1]}});
  return out;
}

inline BsplineCurve<Rational, 2> plane_curve(int degree, const std::string& knots, const std::string& points) {
  return BsplineCurve<Rational, 2>::make(KnotVector<Rational>::make(degree, numbers_of(knots)).value(),
                                         points_of(points))
      .value();
}

inline BsplineCurve<Rational, 2> lar_curve(const std::string& name) {
  struct Data {
    int degree;
    const char *knots, *points;
  };
  static const char* const eleven = "0 1  0 0  1 0  1 1  0 1";
  static const char* const twelve = "0 0  -1 2  1 4  2 3  1 1  1 2  5/2 1";
  static const char* const ten = "0 0  5/2 5  6 1  9 3";
  static const std::map<std::string, Data> curves = {
      {"test01", {4, "0 0 0 0 0 1 1 1 1 1", "0 0  1 0  1 1  2 1  3 1"}},
      {"test08a", {3, "0 0 0 0 1 2 3 4 5 6 7 7 7 7", "0 0  -1 2  1 4  2 3  1 1  1 2  5/2 1  5/2 3  4 4  5 0"}},
      {"test08b", {2, "0 0 0 1 2 3 4 5 5 5", "0 1  1 1  2 0  3 0  4 0  5 -1  6 -1"}},
      {"test09", {3, "0 0 0 0 1 1 1 1", "0 1  0 0  1 1  1 0"}},
      {"test10a", {3, "0 0 0 0 1 1 1 1", ten}},
      {"test10b", {3, "0 0 0 0 1 2 2 2 2", "0 0  5/2 5  5/2 5  6 1  9 3"}},
      {"test10c", {3, "0 0 0 0 1 2 3 3 3 3", "0 0  5/2 5  5/2 5  5/2 5  6 1  9 3"}},
      {"test11a", {2, "0 0 0 1 2 3 3 3", eleven}},
      {"test11b", {2, "0 1 2 3 4 5 6 7", eleven}},
      {"test11c_closed", {2, "0 1 2 3 4 5 6 7 8", "0 1  0 0  1 0  1 1  0 1  0 0"}},
      {"test12_b1", {2, "0 0 0 1 2 3 4 5 5 5", twelve}},
      {"test12_b2", {2, "0 0 0 1 1 2 3 4 4 4", twelve}},
      {"test12_b3", {2, "0 0 0 1 1 1 2 3 3 3", twelve}},
      {"test12_b4", {2, "0 0 0 1 1 1 1 2 2 2", twelve}},
      {"over_clamped", {2, "0 0 0 1 1 1 1", "0 0  1 2  3 2  9 9"}},
      {"partially_clamped", {2, "0 0 0 1 2 3 3 4", "0 0  1 2  3 2  4 0  6 1"}},
      {"shifted_domain", {2, "10 10 10 21/2 11 11 11", "0 0  1 2  3 2  4 0"}},
      {"deg0", {0, "0 1 2 3", "0 0  1 3  4 1"}},
      {"deg1", {1, "0 0 1 2 2", "0 0  1 3  4 1"}},
  };
  const auto found = curves.find(name);
  if (found == curves.end()) throw std::invalid_argument("no curve " + name);
  return plane_curve(found->second.degree, found->second.knots, found->second.points);
}

// The knots of both full circles of nine points.
inline std::vector<Rational> circle_knots() { return numbers_of("0 0 0 1 1 2 2 3 3 4 4 4"); }

// a + b√2
inline Quadratic in_root_two(const std::string& a, const std::string& b = "0") {
  return Quadratic(Rational(a), Rational(b), 2);
}

// test13: clockwise from (−1, 0), homogeneous.
inline BsplineCurve<Quadratic, 3> lar_circle() {
  const Quadratic o(0), e(1), r = in_root_two("0", "1/2");
  std::vector<Quadratic> knots;
  for (const Rational& t : circle_knots()) knots.push_back(Quadratic(t));
  return BsplineCurve<Quadratic, 3>::make(KnotVector<Quadratic>::make(2, knots).value(), {{{-e, o, e}},
                                                                                          {{-r, r, r}},
                                                                                          {{o, e, e}},
                                                                                          {{r, r, r}},
                                                                                          {{e, o, e}},
                                                                                          {{r, -r, r}},
                                                                                          {{o, -e, e}},
                                                                                          {{-r, -r, r}},
                                                                                          {{-e, o, e}}})
      .value();
}

// The unit circle with rational weights, counterclockwise from (1, 0), homogeneous.
inline BsplineCurve<Rational, 3> rational_circle() {
  std::vector<Vec<Rational, 3>> points;
  const std::vector<Rational> x = numbers_of("1 0 1  1 1 1  0 2 2  -1 1 1  -1 0 1  -1 -1 1  0 -2 2  1 -1 1  1 0 1");
  for (std::size_t i = 0; i < x.size(); i += 3) points.push_back({{x[i], x[i + 1], x[i + 2]}});
  return BsplineCurve<Rational, 3>::make(KnotVector<Rational>::make(2, circle_knots()).value(), points).value();
}

}  // namespace patchproof::test
