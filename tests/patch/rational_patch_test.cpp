// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/rational_patch.h"

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "patchproof/scalar/parse_scalar.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

template <class T>
class RationalPatchLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(RationalPatchLaws, AllScalars, ScalarNames);

// Positive, negative and zero weights; the denominator stays away from zero at the places used.
BsplinePatch<Rational, 4> some_patch() {
  RandomRationals random(5);
  auto net = random.points<4>(5 * 4);
  for (std::size_t i = 0; i < net.size(); ++i)
    net[i][3] = i % 7 == 3 ? Rational(0) : i == 6 ? Rational(-1) / 4 : net[i][3] / 40 + 2;
  return {make_knots<Rational>(2, {0, 0, 0, 1, 1, 3, 3, 3}), make_knots<Rational>(3, {-1, -1, -1, -1, 2, 2, 2, 2}),
          net};
}

const Rational kU = Rational(5) / 2, kV = Rational(1) / 8;

TYPED_TEST(RationalPatchLaws, Law1_WeightTimesPointIsTheHomogeneousPoint) {
  const auto exact = some_patch();
  const auto h = derivative_by_definition(exact, kU, kV, 0, 0);
  const Vec<Rational, 3> truth{{h[0] / h[3], h[1] / h[3], h[2] / h[3]}};
  check<TypeParam>(
      truth, [&]<class S>() { return evaluate_rational(make_patch<S>(exact), make_knot<S>(kU), make_knot<S>(kV)); });
}

// The derivatives satisfy Leibniz' rule for A = w·S: Σ C(k,a) C(l,b) w^{ab} S^{k−a,l−b} = A^{kl}, which determines them.
TEST(RationalPatch, Law2_DerivativesOfTheQuotient) {
  const auto s = some_patch();
  const int order = 3;
  const auto table = rational_derivatives(s, kU, kV, order, order);
  std::vector<std::vector<Vec<Rational, 4>>> h(order + 1);
  for (int k = 0; k <= order; ++k)
    for (int l = 0; l <= order; ++l) h[k].push_back(derivative_by_definition(s, kU, kV, k, l));
  const int choose[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  for (int k = 0; k <= order; ++k)
    for (int l = 0; l <= order; ++l) {
      Vec<Rational, 3> sum;
      for (int a = 0; a <= k; ++a)
        for (int b = 0; b <= l; ++b) sum += Rational(choose[k][a] * choose[l][b] * h[a][b][3]) * table.at(k - a, l - b);
      for (int c = 0; c < 3; ++c) EXPECT_EQ(sum[c], h[k][l][c]) << k << " " << l;
    }
}

TYPED_TEST(RationalPatchLaws, Law2_EveryScalarAgrees) {
  const auto exact = some_patch();
  const auto truth = rational_derivatives(exact, kU, kV, 2, 2);
  for (int k = 0; k <= 2; ++k)
    for (int l = 0; l <= 2; ++l)
      check<TypeParam>(truth.at(k, l), [&]<class S>() {
        return rational_derivatives(make_patch<S>(exact), make_knot<S>(kU), make_knot<S>(kV), 2, 2).at(k, l);
      });
}

TEST(RationalPatch, Law3_EqualWeightsGiveThePolynomialPatch) {
  RandomRationals random;
  const auto polynomial = random_patch<3>(random, 2, 5, 3, 6);
  const std::vector<Rational> weights(30, Rational(-3) / 7);
  const auto rational = with_weights(polynomial, weights).value();
  const auto d = polynomial.domain();
  const Rational u = (2 * d.u_begin + d.u_end) / 3, v = (d.v_begin + 4 * d.v_end) / 5;
  const auto expected = partial_derivatives(polynomial, u, v, 2, 3), found = rational_derivatives(rational, u, v, 2, 3);
  for (int k = 0; k <= 2; ++k)
    for (int l = 0; l <= 3; ++l) EXPECT_TRUE(found.at(k, l) == expected.at(k, l));
  EXPECT_TRUE(normal(polynomial, u, v) == normal(rational, u, v));
  EXPECT_TRUE(normal(polynomial, u, v) == normal(to_homogeneous(polynomial), u, v));
  const auto refused = with_weights(polynomial, std::vector<Rational>(29, Rational(1)));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::wrong_count);
}

TEST(RationalPatch, Law4_HomogeneousScaleDoesNotMatter) {
  const auto s = some_patch();
  const Rational factor = Rational(-1) / (1 << 20);
  const auto scaled = map_points(s, [&](const Vec<Rational, 4>& p) { return factor * p; });
  const auto a = rational_derivatives(s, kU, kV, 2, 2), b = rational_derivatives(scaled, kU, kV, 2, 2);
  for (int k = 0; k <= 2; ++k)
    for (int l = 0; l <= 2; ++l) EXPECT_TRUE(a.at(k, l) == b.at(k, l));
}

TYPED_TEST(RationalPatchLaws, Law5_Normals) {
  const auto exact = some_patch();
  const auto truth = rational_derivatives(exact, kU, kV, 1, 1);
  const Vec<Rational, 3> n = cross(truth.at(1, 0), truth.at(0, 1));
  check<TypeParam>(n, [&]<class S>() { return normal(make_patch<S>(exact), make_knot<S>(kU), make_knot<S>(kV)); });
  const Rational w = evaluate(exact, kU, kV)[3];
  check<TypeParam>(Rational(w * w * w * w) * n, [&]<class S>() {
    const auto h = partial_derivatives(make_patch<S>(exact), make_knot<S>(kU), make_knot<S>(kV), 1, 1);
    return scaled_normal(h.at(0, 0), h.at(1, 0), h.at(0, 1));
  });
}

TEST(RationalPatch, AVanishingDenominatorIsAContract) {
  const KnotVector<Rational> line = KnotVector<Rational>::bezier(1);
  const BsplinePatch<Rational, 4> s(line, line, {{{0, 0, 0, 1}}, {{0, 1, 0, 1}}, {{1, 0, 0, -1}}, {{1, 1, 0, -1}}});
  EXPECT_THROW(evaluate_rational(s, Rational(1) / 2, Rational(0)), contract_error);
  EXPECT_NO_THROW(evaluate_rational(s, Rational(1) / 3, Rational(0)));
}

// A sphere octant over Q with one pole: every point lies on the sphere, and the normal vanishes at the pole only.
TEST(RationalPatch, SphereOctant) {
  // The quarter circle (1 − t², 2t)/(1 + t²) turned about the axis; the pole is the line v = 1.
  const Vec<Rational, 3> arc[3] = {{{1, 0, 1}}, {{1, 1, 1}}, {{0, 2, 2}}};
  std::vector<Vec<Rational, 4>> net;
  for (const auto& a : arc)
    for (const auto& b : arc) net.push_back({{a[0] * b[0], a[1] * b[0], a[2] * b[1], a[2] * b[2]}});
  const KnotVector<Rational> quadratic = KnotVector<Rational>::bezier(2);
  const BsplinePatch<Rational, 4> s(quadratic, quadratic, net);
  for (const Rational& u : spread(0, 1, 4))
    for (const Rational& v : spread(0, 1, 4)) {
      const auto p = evaluate_rational(s, u, v);
      EXPECT_EQ(dot(p, p), 1);
      const auto n = normal(s, u, v);
      EXPECT_TRUE(cross(n, p) == (Vec<Rational, 3>{})) << "the normal is radial";
      EXPECT_EQ(dot(n, p) == 0, v == 1) << "and vanishes only at the pole";
      EXPECT_GE(dot(n, p), 0);
    }
}

TEST(RationalPatch, SphereWithRootWeights) {
  const Quadratic one(1), zero(0), half_root(Rational(0), Rational(1) / 2, 2);
  const Vec<Quadratic, 3> arc[3] = {{{one, zero, one}}, {{half_root, half_root, half_root}}, {{zero, one, one}}};
  std::vector<Vec<Quadratic, 4>> net;
  for (const auto& a : arc)
    for (const auto& b : arc) net.push_back({{a[0] * b[0], a[1] * b[0], a[2] * b[1], a[2] * b[2]}});
  const KnotVector<Quadratic> quadratic = KnotVector<Quadratic>::bezier(2);
  const BsplinePatch<Quadratic, 4> s(quadratic, quadratic, net);
  const Quadratic third = one / Quadratic(3);
  const auto p = evaluate_rational(s, third, third);
  EXPECT_TRUE(dot(p, p) == one);
  const auto d = rational_derivatives(s, third, third, 2, 0);
  EXPECT_TRUE(dot(p, d.at(1, 0)) == zero);
  EXPECT_TRUE(dot(d.at(1, 0), d.at(1, 0)) + dot(p, d.at(2, 0)) == zero);
}

// A half sphere of degree (3, 3) with collapsed edges and weights down to 1/9, from another program's tests.
TEST(RationalPatch, ReferenceHemisphere) {
  const auto file =
      std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "../shared/data/eval_tables/tinynurbs_hemisphere.json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the reference data " << file << " is not here";
  const auto json = nlohmann::json::parse(std::ifstream(file)).at("surface");
  std::vector<Vec<Rational, 3>> points;
  std::vector<Rational> weights;
  for (const auto& p : json.at("control_points"))
    points.push_back({{p[0].get<int>(), p[1].get<int>(), p[2].get<int>()}});
  for (const auto& w : json.at("weights")) weights.push_back(parse_scalar<Rational>(w.get<std::string>()).value());
  const KnotVector<Rational> cubic = KnotVector<Rational>::bezier(3);
  const auto s = with_weights(BsplinePatch<Rational, 3>(cubic, cubic, points), weights).value();
  for (const Rational& u : spread(0, 1, 5))
    for (const Rational& v : spread(0, 1, 5)) {
      const auto p = evaluate_rational(s, u, v);
      EXPECT_EQ(dot(p, p), 1) << u << " " << v;
      EXPECT_EQ(normal(s, u, v) == (Vec<Rational, 3>{}), u == 0 || u == 1);
    }
}

}  // namespace
}  // namespace patchproof
