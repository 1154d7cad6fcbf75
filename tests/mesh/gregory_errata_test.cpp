// SPDX-License-Identifier: Apache-2.0
// The printed formulas of docs/errata.md (E-GRE-…), evaluated, beside the right ones.
#include <gtest/gtest.h>

#include "patchproof/mesh/edge_connection.h"
#include "support/gregory_reference.h"

namespace patchproof {
namespace {

using namespace gregory_reference;
using Polynomial = std::vector<Rational>;

Rational q(int a, int b = 1) { return Rational(a, b); }

// The slopes to the left and right of the knot between two cubic pieces of these lengths.
std::array<Rational, 2> slopes(const Polynomial& left, const Rational& h_left, const Polynomial& right,
                               const Rational& h_right) {
  return {Rational(hodograph(left).back() / h_left), Rational(hodograph(right).front() / h_right)};
}

TEST(GregoryErrata, Erratum_E_GRE_01_TheRatioAtAKnot) {
  const Rational h = q(1, 3);
  const auto joint = [&](const Rational& t) { return Rational((1 - t) * 0 + t * 3); };  // (21) with b_2 = 0, b_1 = 3
  const Rational printed = joint(h), right = joint(h / (h + h));
  EXPECT_EQ(slopes({0, 0, 0, printed}, h, {printed, 3, 3, 3}, h), (std::array{q(9), q(18)}));
  EXPECT_EQ(slopes({0, 0, 0, right}, h, {right, 3, 3, 3}, h), (std::array{q(27, 2), q(27, 2)}));
}

// b = k a in C¹ for a in C¹ asks that the slope of k does not jump.
TEST(GregoryErrata, Erratum_E_GRE_02_KIsLinear) {
  const std::vector<Rational> x{0, q(1, 4), q(1, 2), 1};
  const auto slope_jump = [&](const std::vector<Rational>& k, std::size_t i) {
    return Rational((k[i + 1] - k[i]) / (x[i + 1] - x[i]) - (k[i] - k[i - 1]) / (x[i] - x[i - 1]));
  };
  // Rows of (30): (1 − t)(k_{i} − k_{i−1}) = t' (k_{i+1} − k_i) with ratios t = h_i or h_i/(h_i + h_{i+1}); solved for k_1, k_2.
  const auto solved = [&](bool printed) {
    const auto ratio = [&](std::size_t i) {
      const Rational h = x[i] - x[i - 1], next = x[i + 1] - x[i];
      return printed ? h : Rational(h / (h + next));
    };
    // k_i = (1 − t_i) k_{i−1} + t_i k_{i+1}, k_0 = 1, k_3 = 3
    const Rational t1 = ratio(1), t2 = ratio(2);
    const Rational k2 = ((1 - t2) * (1 - t1) * 1 + t2 * 3) / (1 - (1 - t2) * t1);
    return std::vector<Rational>{1, Rational((1 - t1) * 1 + t1 * k2), k2, 3};
  };
  const std::vector<Rational> right = solved(false), printed = solved(true);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(right[i], 1 + 2 * x[i]);
  EXPECT_EQ(slope_jump(right, 1), 0);
  EXPECT_NE(slope_jump(printed, 1), 0);
}

TEST(GregoryErrata, Erratum_E_GRE_03_RowsOfOtherDegrees) {
  const int k = 4;
  const Rational x1 = q(1, 3), p0 = 2, p1 = 5;
  const Rational derivative_of_row = k / x1 * (p1 - p0);
  const auto derivative_of_c = [&](const Rational& factor) { return Rational(3 * factor * (p1 - p0)); };
  EXPECT_EQ(derivative_of_c(k / (3 * x1)), derivative_of_row);
  EXPECT_EQ(derivative_of_row - derivative_of_c(1 / x1), (k - 3) / x1 * (p1 - p0));
}

TEST(GregoryErrata, Erratum_E_GRE_04_WeightsStayPositive) {
  const Rational w0 = 1, w1 = q(1, 2), x1 = q(1, 3);
  const Rational printed = w0 + (w1 - w0) / x1;
  EXPECT_EQ(printed, q(-1, 2));
  EXPECT_EQ(de_casteljau(Polynomial{1, printed, printed, 1}, q(1, 2)), q(-1, 8));
  const Rational lambda = *detail::gauge<Rational>({printed}, {w0});
  EXPECT_EQ(printed + lambda * w0, q(1, 4));
}

TEST(GregoryErrata, Erratum_E_GRE_05_ValenceThree) {
  const CurveMesh mesh = mesh_of(find_case("A").at("mesh"));
  const MeshTopology topology = analyse(mesh).value();
  const int e0 = 0;
  ASSERT_EQ(mesh.edges[e0].id, "E0");
  const EdgeUse &left = topology.uses[topology.left[e0][0]], &right = topology.uses[topology.right[e0][0]];
  EXPECT_FALSE(is_parallel(left.begin_derivative, right.begin_derivative));
  const EdgeConnection connection = connect_edge(mesh, topology, e0).value();
  for (const EdgeUse* use : {&left, &right}) {
    const UseConnection of_use = connect_use(mesh, topology, connection, *use);
    const Rational k = value(of_use.k, Rational(0))[0], h = value(of_use.h, Rational(0))[0];
    EXPECT_NE(h, 0);
    EXPECT_EQ(Rational(use->is_left() ? k : Rational(-k)) * value(connection.basis, Rational(0)) +
                  h * edge_tangent(topology.curves[e0], Rational(0)),
              use->begin_derivative);
  }
}

// S^c along rays into a corner: with equal corner points only, the slope depends on the ray.
TEST(GregoryErrata, Erratum_E_GRE_06_CornersNeedDerivatives) {
  const auto z_slope = [](const Rational& q010_from_v, const Rational& p, const Rational& r) {
    // z of the four points at the corner: Q_00 = 0, Q_10 = 0, Q⁰_01 = 1/3, Q¹_01 as given; first order in the distance.
    const Rational beta = p * p / (p * p + r * r);
    return Rational(3 * r * (beta / 3 + (1 - beta) * q010_from_v));
  };
  EXPECT_EQ(z_slope(q(1, 3), 1, 1), 1);  // equal derivatives: z = v along every ray
  EXPECT_EQ(z_slope(q(1, 3), 3, 1), 1);
  EXPECT_NE(z_slope(0, 1, 1), z_slope(0, 3, 1));
  // corners_agree refuses such a patch.
  const GregoryPatch<Rational> good =
      fill_faces<Rational>(mesh_of(find_case("A").at("mesh")), analyse(mesh_of(find_case("A").at("mesh"))).value())
          .value()
          .patches[0];
  EXPECT_TRUE(corners_agree(good));
  std::vector<Vec<Rational, 4>> net = good.v_surface().net();
  net[1][2] += 1;  // S^v_v in the corner (0, 0)
  const auto bad = GregoryPatch<Rational>::make(
      good.u_surface(), BsplinePatch<Rational, 4>(good.v_surface().knots(Direction::u),
                                                  good.v_surface().knots(Direction::v), std::move(net)));
  ASSERT_TRUE(bad);
  EXPECT_FALSE(corners_agree(*bad));
}

}  // namespace
}  // namespace patchproof
