// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/tangent_plane.h"

#include <gtest/gtest.h>

#include "patchproof/contract.h"
#include "support/scalars.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;

Rational two_to(int e) { return e < 0 ? Rational(1) / two_to(-e) : e == 0 ? Rational(1) : Rational(2) * two_to(e - 1); }
Rational square(const Vector& v) { return dot(v, v); }
Rational largest(const Vector& v) { return std::max({Rational(abs(v[0])), Rational(abs(v[1])), Rational(abs(v[2]))}); }

class TangentPlaneTest : public ::testing::Test {
 protected:
  // Of any size between 2^-60 and 2^60.
  Rational number() { return random_() * two_to(random_.integer(-60, 60)); }
  Vector vector() {
    const Rational scale = two_to(random_.integer(-60, 60));
    Vector v{{random_(), random_(), random_()}};
    if (v == Vector{}) v[0] = 1;
    return scale * v;
  }
  test::RandomRationals random_;
};

TEST_F(TangentPlaneTest, Law1_RoundedNumbersAreNear) {
  for (int k = 0; k < 500; ++k)
    for (const int bits : {4, 8, 16, 40}) {
      const Rational x = number(), bound = two_to(1 - bits);
      EXPECT_LE(abs(Rational(rounded(x, bits) - x)), bound * abs(x));
      EXPECT_EQ(rounded(x, bits) == 0, x == 0);
      const Rational root = rounded_root(Rational(x * x), bits);
      EXPECT_LE(abs(Rational(root - abs(x))), bound * abs(x));
      // Of a number that is no square: between the roots of nearby squares.
      const Rational y = abs(x), r = rounded_root(y, bits);
      EXPECT_LE(r * r, y * (1 + bound) * (1 + bound));
      EXPECT_GE(r * r, y * (1 - bound) * (1 - bound));
      const Vector v = vector(), size = vector(), at = on_grid(v, size, bits);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_LE(abs(Rational(at[c] - v[c])), two_to(-bits) * largest(size));
    }
  const Vector v = vector();
  EXPECT_EQ(on_grid(v, {}), v);
  EXPECT_EQ(rounded_root(Rational(0)), 0);
}

TEST_F(TangentPlaneTest, Law2_PlanesHaveIntegerVectorsAtRightAngles) {
  for (int k = 0; k < 300; ++k) {
    const Vector normal = vector();
    for (const int bits : {6, 10, 30}) {
      for (const TangentPlane& plane : {plane_of(normal), plane_near(normal, bits)}) {
        for (const Vector& v : {plane.normal, plane.first, plane.second}) {
          EXPECT_NE(v, Vector{});
          for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(denominator(v[c]), 1);
        }
        EXPECT_EQ(dot(plane.normal, plane.first), 0);
        EXPECT_EQ(dot(plane.normal, plane.second), 0);
        EXPECT_EQ(dot(plane.first, plane.second), 0);
        EXPECT_EQ(cross(cross(plane.first, plane.second), plane.normal), Vector{});
        EXPECT_GT(dot(cross(plane.first, plane.second), plane.normal), 0);
      }
      EXPECT_EQ(cross(plane_of(normal).normal, normal), Vector{});
      EXPECT_GT(dot(plane_of(normal).normal, normal), 0);
      const Vector near = plane_near(normal, bits).normal;
      EXPECT_LE(square(cross(near, normal)), two_to(4 - 2 * bits) * square(near) * square(normal));
      EXPECT_GT(dot(near, normal), 0);
      EXPECT_LE(largest(near), two_to(bits + 1));
    }
  }
  EXPECT_THROW(plane_of({}), contract_error);
}

TEST_F(TangentPlaneTest, Law3And4_Projections) {
  for (int k = 0; k < 300; ++k) {
    const TangentPlane plane = plane_near(vector());
    const Vector v = vector(), exact = projected(v, plane.normal);
    EXPECT_EQ(dot(exact, plane.normal), 0);
    EXPECT_EQ(cross(v - exact, plane.normal), Vector{});
    EXPECT_EQ(projected(exact, plane.normal), exact);
    for (const int bits : {6, 16, 40}) {
      const Vector near = in_plane(plane, v, bits);
      EXPECT_EQ(dot(near, plane.normal), 0);
      EXPECT_LE(square(near - exact), two_to(6 - 2 * bits) * square(v));
    }
  }
}

TEST_F(TangentPlaneTest, Law5And6_NormalsOfDirections) {
  EXPECT_FALSE(common_normal({}));
  EXPECT_FALSE(common_normal({{{1, 2, 3}}, {{-2, -4, -6}}, {}}));  // a line lies in many planes
  EXPECT_FALSE(common_normal({{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}));
  for (int k = 0; k < 200; ++k) {
    const Vector a = vector(), b = vector();
    if (cross(a, b) == Vector{}) continue;
    std::vector<Vector> directions{{}, a, Rational(-2) * a, b};
    for (int i = 0; i < 3; ++i) directions.push_back(random_() * a + random_() * b);
    const std::optional<Vector> normal = common_normal(directions);
    ASSERT_TRUE(normal);
    EXPECT_EQ(fitted_normal(directions), *normal);
    for (const Vector& d : directions) EXPECT_EQ(dot(d, *normal), 0);
    // Three directions a little out of the plane of a and b: the fitted plane lies as near to them as this one, and nearly in it.
    const Vector unit = in_plane(plane_of(*normal), a), other = cross(plane_of(*normal).normal, unit);
    const Rational up = two_to(-20), n = rounded_root(square(unit)) / rounded_root(square(*normal));
    const Rational m = rounded_root(square(unit)) / rounded_root(square(other));
    std::vector<Vector> near{unit, m * other, Rational(-1) * unit + Rational(-m) * other};
    for (std::size_t i = 0; i < 3; ++i) near[i] += Rational(up * n * (i == 0 ? 1 : i == 1 ? -1 : 1)) * *normal;
    const Vector fitted = fitted_normal(near);
    EXPECT_NE(fitted, Vector{});
    EXPECT_LE(square(cross(fitted, *normal)), two_to(-36) * square(fitted) * square(*normal));
    Rational of_fitted, of_normal;
    for (const Vector& d : near) {
      of_fitted += dot(d, fitted) * dot(d, fitted) / (square(d) * square(fitted));
      of_normal += dot(d, *normal) * dot(d, *normal) / (square(d) * square(*normal));
    }
    EXPECT_LE(of_fitted, of_normal);
  }
}

}  // namespace
}  // namespace patchproof
