// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/affine.h"

#include "patchproof/patch/rational_patch.h"
#include "patchproof/spline/bezier_extraction.h"
#include "support/curves.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

template <class T>
class AffineLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(AffineLaws, BoundedScalars, ScalarNames);

template <class T>
Vec<T, 3> vec(const Rational& x, const Rational& y, const Rational& z) {
  return make_point<T>(Vec<Rational, 3>{{x, y, z}});
}

// A rotation, a skew scaling and a far translation.
template <class T>
AffineMap<T> some_map() {
  const AffineMap<T> turn = rotation(Quaternion<T>{T(2), vec<T>(1, -3, 5)});
  return compose(translation(vec<T>(1000000, -7, Rational(1) / 3)),
                 compose(turn, scaling(vec<T>(Rational(1) / 1024, -3, 1 << 20))));
}

BsplinePatch<Rational, 3> some_patch() {
  RandomRationals random(11);
  return {make_knots<Rational>(2, {0, 0, 0, 1, 3, 3, 4, 4}), make_knots<Rational>(1, {1, 2, 3, 4}),
          random.points<3>(10)};
}

TYPED_TEST(AffineLaws, Law1_MappedPointsGiveTheMappedPatch) {
  using T = TypeParam;
  const auto exact = some_patch();
  const Rational u = Rational(3) / 4, v = Rational(9) / 4;
  const auto truth = apply(some_map<Rational>(), evaluate(exact, u, v));
  expect_agrees(evaluate(apply(some_map<T>(), make_patch<T>(exact)), make_knot<T>(u), make_knot<T>(v)), truth);
  const auto homogeneous = apply(some_map<T>(), to_homogeneous(make_patch<T>(exact)));
  expect_agrees(evaluate_rational(homogeneous, make_knot<T>(u), make_knot<T>(v)), truth);
}

TEST(Affine, Law1_HoldsForEveryWeight) {
  RandomRationals random;
  const auto knots = make_knots<Rational>(2, {0, 0, 0, 1, 2, 2, 2});
  const BsplinePatch<Rational, 4> s(knots, knots, random.points<4>(16));
  const auto map = some_map<Rational>();
  const auto image = apply(map, s);
  for (int i = 0; i < 5; ++i) {
    const Rational u = 2 * random.unit(), v = 2 * random.unit();
    EXPECT_TRUE(evaluate(image, u, v) == apply(map, evaluate(s, u, v)));
  }
}

TYPED_TEST(AffineLaws, Law2_Composition) {
  using T = TypeParam;
  const auto outer = [](auto x) {
    using S = decltype(x);
    return compose(translation(vec<S>(1, 2, 3)), scaling(vec<S>(2, 3, 5)));
  };
  const auto truth = apply(outer(Rational()), apply(some_map<Rational>(), Vec<Rational, 3>{{Rational(1) / 7, 2, -3}}));
  const auto p = vec<T>(Rational(1) / 7, 2, -3);
  expect_agrees(apply(compose(outer(T(0)), some_map<T>()), p), truth);
  expect_agrees(apply(outer(T(0)), apply(some_map<T>(), p)), truth);
}

TEST(Affine, Law3_RotationsKeepDotAndCross) {
  RandomRationals random;
  for (int i = 0; i < 20; ++i) {
    const Quaternion<Rational> q{random() + 21, random.point<3>()};
    const auto r = rotation(q);
    const auto a = random.point<3>(), b = random.point<3>();
    EXPECT_EQ(dot(apply(r, a), apply(r, b)), dot(a, b));
    EXPECT_TRUE(cross(apply(r, a), apply(r, b)) == apply(r, cross(a, b)));
    EXPECT_TRUE(apply(r, q.v) == q.v);
  }
}

TEST(Affine, Law3_TheAngleIsThatOfThePythagoreanTriple) {
  const Rational half = Rational(1) / 2;  // cos = 3/5, sin = 4/5
  const auto r = rotation_about(Vec<Rational, 3>{{0, 0, 1}}, half);
  EXPECT_TRUE(apply(r, Vec<Rational, 3>{{1, 0, 0}}) == (Vec<Rational, 3>{{Rational(3) / 5, Rational(4) / 5, 0}}));
  EXPECT_TRUE(apply(r, Vec<Rational, 3>{{0, 1, 0}}) == (Vec<Rational, 3>{{Rational(-4) / 5, Rational(3) / 5, 0}}));
  EXPECT_TRUE(apply(r, Vec<Rational, 3>{{0, 0, 1}}) == (Vec<Rational, 3>{{0, 0, 1}}));
  // s = 0 is the half turn, which no half-angle tangent reaches.
  const auto half_turn = rotation(Quaternion<Rational>{0, {{1, 0, 0}}});
  EXPECT_TRUE(apply(half_turn, Vec<Rational, 3>{{5, 6, 7}}) == (Vec<Rational, 3>{{5, -6, -7}}));
  EXPECT_THROW(rotation(Quaternion<Rational>{0, {{0, 0, 0}}}), contract_error);
}

TYPED_TEST(AffineLaws, Law4_NormalsTurnWithTheCofactors) {
  using T = TypeParam;
  const auto map = some_map<T>();
  const auto a = vec<T>(1, 2, Rational(1) / 3), b = vec<T>(-1, 0, 5);
  const auto exact_map = some_map<Rational>();
  const auto truth = cross(apply_to_direction(exact_map, vec<Rational>(1, 2, Rational(1) / 3)),
                           apply_to_direction(exact_map, vec<Rational>(-1, 0, 5)));
  expect_agrees(apply_to_normal(map, cross(a, b)), truth);
}

TEST(Affine, Law5_ProjectiveMapsCommuteWithEvaluation) {
  RandomRationals random;
  const auto knots = make_knots<Rational>(2, {0, 0, 0, 1, 2, 2, 2});
  const BsplinePatch<Rational, 4> s(knots, knots, random.points<4>(16));
  ProjectiveMap<Rational> map;
  for (auto& row : map.rows) row = random.point<4>();
  const Rational u = Rational(1) / 3, v = Rational(8) / 5;
  EXPECT_TRUE(evaluate(apply(map, s), u, v) == apply(map, evaluate(s, u, v)));
  const auto affine = some_map<Rational>();
  EXPECT_EQ(apply(to_projective(affine), s).net(), apply(affine, s).net());
}

template <std::size_t N>
BsplineCurve<Rational, N> with_random_points(RandomRationals& random, const KnotVector<Rational>& knots) {
  return {knots, random.points<N>(knots.control_count())};
}

// Both sides as Bézier points of every piece.
template <class Map, std::size_t N>
void expect_commutes(const Map& map, const BsplineCurve<Rational, N>& curve) {
  const auto image = extract_bezier(apply(map, curve)), pieces = extract_bezier(curve);
  ASSERT_EQ(image.size(), pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = 0; j < pieces[i].points.size(); ++j)
      EXPECT_TRUE(image[i].points[j] == apply(map, pieces[i].points[j]));
}

TEST(Affine, Law6_CurvesOfMappedPointsAreMappedCurves) {
  RandomRationals random;
  for (const NamedCurve& named : awkward_curves(random)) {
    SCOPED_TRACE(named.name);
    expect_commutes(some_map<Rational>(), with_random_points<3>(random, named.curve.knots()));
    expect_commutes(some_map<Rational>(), with_random_points<4>(random, named.curve.knots()));
    ProjectiveMap<Rational> m;
    for (auto& row : m.rows) row = random.point<4>();
    expect_commutes(m, with_random_points<4>(random, named.curve.knots()));
    const auto curve = with_random_points<4>(random, named.curve.knots());
    EXPECT_TRUE(apply(to_projective(some_map<Rational>()), curve).points() ==
                apply(some_map<Rational>(), curve).points());
  }
}

// (x, y, z, w) ↦ (x, y, z, w + x) on a quarter circle: its image passes (3/8, 1/2), and weights change.
TEST(Affine, Erratum_E_LAR_10_AProjectiveMapMustChangeTheWeights) {
  const auto n = [](int p, int q = 1) { return Rational(p) / Rational(q); };
  const auto quarter = BsplineCurve<Rational, 4>::bezier(
      {{{n(1), n(0), n(0), n(1)}}, {{n(1), n(1), n(0), n(1)}}, {{n(0), n(2), n(0), n(2)}}});
  ProjectiveMap<Rational> map = to_projective(translation(Vec<Rational, 3>{}));
  map.rows[3][0] = n(1);
  const Rational t = n(1, 2);
  const Vec<Rational, 3> truth{{n(3, 8), n(1, 2), n(0)}};
  EXPECT_EQ(evaluate_rational(apply(map, quarter), t), truth);
  EXPECT_EQ(project(apply(map, evaluate(quarter, t))), truth);
  // As printed: the projected control points are mapped, each with the weight it had.
  std::vector<Vec<Rational, 4>> kept;
  for (const auto& p : quarter.points()) kept.push_back(to_homogeneous(project(apply(map, p)), p[3]));
  EXPECT_EQ(evaluate_rational(BsplineCurve<Rational, 4>::bezier(kept), t),
            (Vec<Rational, 3>{{n(3, 10), n(3, 5), n(0)}}));
}

}  // namespace
}  // namespace patchproof
