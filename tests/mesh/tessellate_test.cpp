// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/tessellate.h"

#include <cmath>
#include <limits>

#include "mesh/mesh_support.h"
#include "patchproof/scalar/quadratic.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Numbers = std::vector<Rational>;
using Point = Vec<double, 3>;

KnotVector<Rational> knots_of(int degree, const Numbers& knots) {
  return KnotVector<Rational>::make(degree, knots).value();
}
const KnotVector<Rational> jumps = knots_of(2, {q(0), q(0), q(0), q(1), q(1), q(1), q(3), q(4), q(4), q(4)});
const KnotVector<Rational> unclamped = knots_of(3, {q(-1), q(0), q(0), q(1, 2), q(2), q(3), q(3), q(5)});

double distance(const Point& a, const Vec<Rational, 3>& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::abs(a[i] - nearest_double(b[i]));
  return sum;
}

// Random points with weights 1/2 … 3.
std::vector<Vec<Rational, 4>> weighted_points(RandomRationals& random, int count) {
  std::vector<Vec<Rational, 4>> out;
  for (int i = 0; i < count; ++i) out.push_back(to_homogeneous(random.points<3>(1)[0], q(random.integer(1, 6), 2)));
  return out;
}

TEST(Tessellate, Law1And3_Curves) {
  RandomRationals random;
  const BsplineCurve<Rational, 4> curve(jumps, weighted_points(random, 7));
  const auto pieces = tessellate(curve, 5).value();
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].mesh.cell_count(), 5u);
  EXPECT_EQ(pieces[1].mesh.cell_count(), 10u);
  const auto grids = domain_grids(std::array{sample_spans(jumps, 5)});
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(pieces[c].mesh.corners, grids[c].complex.corners);
    EXPECT_TRUE(pieces[c].normals.empty());
    for (std::size_t v = 0; v < grids[c].sides.size(); ++v) {
      const Rational& t = grids[c].complex.vertices[v][0];
      EXPECT_EQ(pieces[c].parameters[v][0], nearest_double(t));
      EXPECT_LT(distance(pieces[c].mesh.vertices[v], evaluate_rational(curve, t, grids[c].sides[v][0])), 1e-13);
    }
  }
  EXPECT_LT(distance(pieces[0].mesh.vertices.back(), evaluate_rational(curve, q(1), Side::left)), 1e-13);
  EXPECT_GT(distance(pieces[0].mesh.vertices.back(), evaluate_rational(curve, q(1), Side::right)), 1e-3);
}

TEST(Tessellate, Law1And2_Patches) {
  RandomRationals random;
  const BsplinePatch<Rational, 4> patch(jumps, unclamped, weighted_points(random, 7 * 4));
  const auto pieces = tessellate(patch, {3, 4}).value();
  ASSERT_EQ(pieces.size(), 2u);
  const auto grids = domain_grids(std::array{sample_spans(jumps, 3), sample_spans(unclamped, 4)});
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(pieces[c].mesh.corners, grids[c].complex.corners);
    for (std::size_t k = 0; k < grids[c].sides.size(); ++k) {
      const auto& [u, v] = grids[c].complex.vertices[k].c;
      const auto [side_u, side_v] = grids[c].sides[k];
      EXPECT_LT(distance(pieces[c].mesh.vertices[k], evaluate_rational(patch, u, v, side_u, side_v)), 1e-12);
      const Vec<Rational, 3> exact = normal(patch, u, v, side_u, side_v);
      const auto expected = unit({{nearest_double(exact[0]), nearest_double(exact[1]), nearest_double(exact[2])}});
      ASSERT_TRUE(pieces[c].normals[k].has_value());
      EXPECT_NEAR(dot(*pieces[c].normals[k], *expected), 1, 1e-12);
      EXPECT_NEAR(dot(*pieces[c].normals[k], *pieces[c].normals[k]), 1, 1e-14);
    }
  }
}

TEST(Tessellate, Law1_DoublesAndQuadraticNumbers) {
  RandomRationals random;
  const auto net = weighted_points(random, 9);
  const auto square = KnotVector<Rational>::bezier(2);
  const BsplinePatch<Rational, 4> exact(square, square, net);
  const auto reference = tessellate(exact, {4, 4}).value();
  const auto rounded = tessellate(make_patch<double>(exact), {4, 4}).value();
  const auto quadratic = tessellate(make_patch<Quadratic>(exact), {4, 4}).value();
  ASSERT_EQ(rounded.size(), 1u);
  for (std::size_t k = 0; k < 25; ++k) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(rounded[0].mesh.vertices[k][i], reference[0].mesh.vertices[k][i], 1e-12);
    EXPECT_EQ(quadratic[0].mesh.vertices[k], reference[0].mesh.vertices[k]);
    EXPECT_NEAR(dot(*rounded[0].normals[k], *reference[0].normals[k]), 1, 1e-10);
  }
}

// A cone z = v over the circle, far from the origin, with its apex at v = 0: S_u is zero there, in doubles only nearly.
BsplinePatch<Rational, 4> cone(const Rational& offset) {
  const std::vector<Vec<Rational, 4>> arc{
      {{q(1), q(0), q(0), q(1)}}, {{q(1), q(1), q(0), q(1)}}, {{q(0), q(2), q(0), q(2)}}};
  std::vector<Vec<Rational, 4>> net;
  for (const auto& p : arc)
    for (const int v : {0, 1}) {
      const Rational w = p[3];
      net.push_back({{v * p[0] + w * offset, v * p[1] + w * offset / 3, w * v, w}});
    }
  return {KnotVector<Rational>::bezier(2), KnotVector<Rational>::bezier(1), net};
}

TEST(Tessellate, Law2_AtAPoleTheNeighboursDecide) {
  for (const Rational& offset : {q(0), q(1000000)}) {
    const auto piece = tessellate(cone(offset), {8, 4}).value()[0];
    for (std::size_t k = 0; k < 9; ++k) {
      ASSERT_TRUE(piece.normals[k].has_value());
      for (int i = 0; i < 3; ++i) EXPECT_NEAR((*piece.normals[k])[i], (*piece.normals[k + 9])[i], 1e-15);
      EXPECT_NEAR(std::abs((*piece.normals[k])[2]), std::sqrt(0.5), 1e-9);
    }
  }
}

TEST(Tessellate, Law2_NoNormalWhereThereIsNone) {
  // A patch that is a line has no normal anywhere; its vertices stay.
  std::vector<Vec<Rational, 4>> line;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) line.push_back({{q(i + 2 * j), q(0), q(0), q(1)}});
  const auto square = KnotVector<Rational>::bezier(2);
  const auto piece = tessellate(BsplinePatch<Rational, 4>(square, square, line), {3, 3}).value()[0];
  for (const auto& n : piece.normals) EXPECT_FALSE(n.has_value());
  EXPECT_EQ(piece.mesh.cell_count(), 9u);
  // One that is a point, in doubles too.
  const BsplinePatch<Rational, 4> point(square, square,
                                        std::vector<Vec<Rational, 4>>(9, {{q(1, 3), q(2), q(0), q(1)}}));
  const auto small = tessellate(point, {2, 2}).value()[0];
  for (const auto& n : small.normals) EXPECT_FALSE(n.has_value());
  for (const auto& n : tessellate(make_patch<double>(point), {2, 2}).value()[0].normals) EXPECT_FALSE(n.has_value());
  // Doubly covered: the neighbours on both sides of the fold cancel.
  std::vector<std::optional<Point>> fold{Point{{0, 0, 1}}, std::nullopt, Point{{0, 0, -1}}};
  detail::borrow_normals(fold, 3);
  EXPECT_FALSE(fold[1].has_value());
  fold[2] = std::nullopt;
  detail::borrow_normals(fold, 3);
  EXPECT_EQ(fold[1], fold[0]);
  EXPECT_FALSE(fold[2].has_value());
}

TEST(Tessellate, Law2_SizeDoesNotMatter) {
  RandomRationals random;
  const auto square = KnotVector<Rational>::bezier(2);
  const BsplinePatch<Rational, 4> patch(square, square, weighted_points(random, 9));
  const auto reference = tessellate(patch, {3, 3}).value()[0];
  for (const int exponent : {-1000, -400, 400, 1000}) {
    const Rational factor = from_double(std::ldexp(1, exponent));
    const auto scaled = map_points(patch, [&](const Vec<Rational, 4>& p) {
      return Vec<Rational, 4>{{factor * p[0], factor * p[1], factor * p[2], p[3]}};
    });
    const auto piece = tessellate(scaled, {3, 3}).value()[0];
    for (std::size_t k = 0; k < 16; ++k) {
      ASSERT_TRUE(piece.normals[k].has_value()) << exponent;
      EXPECT_NEAR(dot(*piece.normals[k], *reference.normals[k]), 1, 1e-12);
    }
  }
}

TEST(Tessellate, Law4_AnyMap) {
  const auto u = sample_spans(KnotVector<Rational>::bezier(1), 6), v = sample_spans(jumps, 2);
  const auto sphere = [](const std::array<Rational, 2>& x, const std::array<Side, 2>&) {
    const double s = nearest_double(x[0]), t = nearest_double(x[1]) / 2 - 1;
    return Point{{std::cos(s) * std::cos(t), std::sin(s) * std::cos(t), std::sin(t)}};
  };
  const auto pieces = tessellate_map(std::array{u, v}, sphere).value();
  ASSERT_EQ(pieces.size(), 2u);
  for (const auto& piece : pieces)
    for (std::size_t k = 0; k < piece.normals.size(); ++k)
      EXPECT_GT(dot(*piece.normals[k], piece.mesh.vertices[k]), 0.96);  // outwards
  const auto solid = tessellate_map(std::array{u, u, v}, [&](const auto& x, const auto& sides) {
    return nearest_double(1 + x[1]) * sphere({x[0], x[2]}, {sides[0], sides[2]});
  });
  ASSERT_EQ(solid.value().size(), 2u);
  EXPECT_EQ(solid.value()[0].mesh.cell_count(), 6u * 6 * 2);
  EXPECT_EQ(solid.value()[0].mesh.dimension, 3);
  EXPECT_TRUE(solid.value()[0].normals.empty());
}

TEST(Tessellate, Errors) {
  const auto square = KnotVector<Rational>::bezier(1);
  const Rational huge = from_double(std::numeric_limits<double>::max()), tiny = q(1) / (huge * huge);
  const auto patch_of = [&](const Vec<Rational, 4>& p) {
    return BsplinePatch<Rational, 4>(square, square, std::vector<Vec<Rational, 4>>(4, p));
  };
  const auto curve_of = [&](const Vec<Rational, 4>& p) {
    return BsplineCurve<Rational, 4>(square, std::vector<Vec<Rational, 4>>(2, p));
  };
  EXPECT_EQ(tessellate(patch_of({{q(1), q(1), q(1), tiny}}), {2, 2}).error().code, ErrorCode::vanishing_weight);
  EXPECT_EQ(tessellate(curve_of({{q(1), q(1), q(1), tiny}}), 2).error().code, ErrorCode::vanishing_weight);
  EXPECT_EQ(tessellate(patch_of({{huge, q(1), q(1), q(1, 2)}}), {2, 2}).error().code, ErrorCode::bad_number);
  const Error error = tessellate(curve_of({{q(1), huge, q(1), q(1, 2)}}), 2).error();
  EXPECT_EQ(error.code, ErrorCode::bad_number);
  EXPECT_EQ(error.where, "at (0)");
  EXPECT_EQ(tessellate(patch_of({{q(1), q(1), q(1), q(1)}}), {1 << 14, 1 << 14}).error().code, ErrorCode::usage);
  EXPECT_EQ(tessellate(curve_of({{q(1), q(1), q(1), q(1)}}), 2000000000).error().code, ErrorCode::usage);
  EXPECT_THROW((void)tessellate(curve_of({{q(1), q(1), q(1), q(1)}}), 0), contract_error);
}

TEST(Tessellate, UnitVectors) {
  for (const double scale : {1.0, 1e-320, 1e-300, 1e300, std::numeric_limits<double>::max() / 2}) {
    const auto n = unit({{scale, -scale, 0}});
    ASSERT_TRUE(n.has_value());
    EXPECT_NEAR((*n)[0], std::sqrt(0.5), 1e-15);
    EXPECT_EQ((*n)[1], -(*n)[0]);
  }
  EXPECT_FALSE(unit({{0, -0.0, 0}}).has_value());
  EXPECT_FALSE(unit({{1, std::numeric_limits<double>::infinity(), 0}}).has_value());
  EXPECT_FALSE(unit({{1, std::nan(""), 0}}).has_value());
}

}  // namespace
}  // namespace patchproof
