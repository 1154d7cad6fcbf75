// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "patchproof/scalar/rational.h"

#ifdef PATCHPROOF_HAVE_DELAUNAY

namespace patchproof {
namespace {

using Points = std::vector<Vec<double, 2>>;
using Triangles = std::vector<std::array<int, 3>>;

Triangles hull_of(const Points& points) {
  const auto found = constrained_delaunay(points, {});
  EXPECT_TRUE(found) << found.error().text();
  return *found;
}

Rational orientation(const Vec<double, 2>& a, const Vec<double, 2>& b, const Vec<double, 2>& c) {
  const auto x = [](double t) { return from_double(t); };
  return (x(b[0]) - x(a[0])) * (x(c[1]) - x(a[1])) - (x(b[1]) - x(a[1])) * (x(c[0]) - x(a[0]));
}

// Positive: d lies inside the circle through a, b, c, which run against the clock.
Rational in_circle(const Vec<double, 2>& a, const Vec<double, 2>& b, const Vec<double, 2>& c, const Vec<double, 2>& d) {
  Rational m[3][3];
  const Vec<double, 2>* rows[] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    m[i][0] = from_double((*rows[i])[0]) - from_double(d[0]);
    m[i][1] = from_double((*rows[i])[1]) - from_double(d[1]);
    m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

void expect_delaunay(const Points& points, const Triangles& triangles) {
  for (const auto& t : triangles) {
    EXPECT_GT(orientation(points[t[0]], points[t[1]], points[t[2]]), 0);
    for (const auto& p : points) EXPECT_LE(in_circle(points[t[0]], points[t[1]], points[t[2]], p), 0);
  }
}

std::size_t edges_of(const Triangles& triangles) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  return edges.size();
}

TEST(Delaunay, Law1_AFlatTriangleIsNotLost) {
  // Finite auxiliary corners would lose it.
  const Points flat{{{0, 0}}, {{2, 0}}, {{1, 0.001}}};
  EXPECT_EQ(hull_of(flat).size(), 1u);
  const Points flatter{{{0, 0}}, {{2, 0}}, {{1, std::numeric_limits<double>::denorm_min()}}};
  EXPECT_EQ(hull_of(flatter).size(), 1u);
}

TEST(Delaunay, Law2_CountsWithCollinearPointsOfTheBorder) {
  // Six points, one of them amid a side of the hull: k = 5, five triangles and ten edges.
  const Points six{{{0, 0}}, {{4, 0}}, {{4, 4}}, {{0, 4}}, {{2, 0}}, {{1, 2}}};
  const Triangles found = hull_of(six);
  EXPECT_EQ(found.size(), 2 * 6 - 2 - 5u);
  EXPECT_EQ(edges_of(found), 3 * 6 - 3 - 5u);
  expect_delaunay(six, found);
}

TEST(Delaunay, Law2_CocircularPointsGetOneOfTheValidTriangulations) {
  Points grid;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) grid.push_back({{double(i), double(j)}});
  const Triangles found = hull_of(grid);
  EXPECT_EQ(found.size(), 2 * 36 - 2 - 20u);
  expect_delaunay(grid, found);
}

TEST(Delaunay, Law2_NoPointInACircleOfRandomPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1, 1);
  Points points;
  for (int i = 0; i < 60; ++i) points.push_back({{at(random), at(random)}});
  expect_delaunay(points, hull_of(points));
}

TEST(Delaunay, Law3_ASquareWithAHoleAndAnIslandInIt) {
  Points points;
  std::vector<std::array<int, 2>> segments;
  const auto square = [&](double r) {
    const int first = static_cast<int>(points.size());
    for (const auto& [x, y] : {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
      points.push_back({{x, y}});
    for (int k = 0; k < 4; ++k) segments.push_back({first + k, first + (k + 1) % 4});
  };
  square(3);
  square(2);
  square(1);
  const auto found = constrained_delaunay(points, segments);
  ASSERT_TRUE(found);
  double area = 0;
  std::set<std::pair<int, int>> sides;
  for (const auto& t : *found) {
    area += 0.5 * orientation(points[t[0]], points[t[1]], points[t[2]]).convert_to<double>();
    for (int k = 0; k < 3; ++k) sides.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  EXPECT_EQ(area, 36 - 16 + 4);
  for (const auto& s : segments) EXPECT_EQ(sides.count(std::minmax(s[0], s[1])), 1u);
  // A cut that is run through there and back takes nothing away.
  points.push_back({{2.5, 0}});
  points.push_back({{2.5, 1}});
  segments.insert(segments.end(), {{12, 13}, {13, 12}});
  const auto slit = constrained_delaunay(points, segments);
  ASSERT_TRUE(slit);
  double same = 0;
  for (const auto& t : *slit) same += 0.5 * orientation(points[t[0]], points[t[1]], points[t[2]]).convert_to<double>();
  EXPECT_EQ(same, area);
}

TEST(Delaunay, Law4_NothingFromALine) {
  EXPECT_TRUE(hull_of({}).empty());
  EXPECT_TRUE(hull_of({{{0, 0}}, {{1, 1}}, {{3, 3}}}).empty());
}

TEST(Delaunay, BadInputIsNamed) {
  const auto code = [](const Points& points, const std::vector<std::array<int, 2>>& segments) {
    const auto found = constrained_delaunay(points, segments);
    return found ? "none" : to_string(found.error().code);
  };
  const Points square{{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}, {{0.5, 0}}};
  EXPECT_STREQ(code({{{0, 0}}, {{1, 0}}, {{0, 0}}}, {}), "usage");
  EXPECT_STREQ(code({{{0, std::nan("")}}}, {}), "bad_number");
  EXPECT_STREQ(code(square, {{0, 9}}), "bad_reference");
  EXPECT_STREQ(code(square, {{0, 2}, {1, 3}}), "usage");
  EXPECT_STREQ(code(square, {{0, 1}}), "usage");  // over the point amid it
}

}  // namespace
}  // namespace patchproof

#else

TEST(Delaunay, IsNotBuilt) { GTEST_SKIP() << "built without patchproof::delaunay"; }

#endif
