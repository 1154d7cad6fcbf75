// SPDX-License-Identifier: Apache-2.0
// Joins along which normals vanish: at an end, inside, or everywhere.
#include <gtest/gtest.h>

#include "patchproof/join/certify.h"
#include "support/broken_joins.h"
#include "support/certificates.h"

namespace patchproof::test {
namespace {

TEST(CertifyDegenerate, APoleAtTheEndOfAnEdgeHasALimitNormal) {
  for (const auto& j : valid_joins())
    if (j.name == "sphere in Q") {
      const Certificate c = certify_join(j.a, j.b, j.join);
      EXPECT_EQ(c.g1.verdict, Verdict::proven);
      ASSERT_EQ(c.degenerate.size(), 2u);  // the pole u = 1, from both sides
      for (const Degeneracy& d : c.degenerate) EXPECT_TRUE(d.begin == 1 && d.end == 1) << d.what;
      return;
    }
  FAIL() << "the family has no sphere";
}

TEST(CertifyDegenerate, ACrossDerivativeThatVanishesAlongTheEdgeUsesTheSecondOrder) {
  const Surface<Rational> s = wavy_patch(3, 3);
  auto [a, b] = split(s, Direction::u, q(1, 2));
  // b's first inner row falls onto the edge; the second one goes where the first was.
  for (int j = 0; j < 4; ++j) {
    const auto edge = b.point(0, j), inner = b.point(1, j);
    b = with_point(with_point(b, 4 + j, edge), 8 + j, inner);
  }
  const Join<Rational> join = edge_join(a, EdgeName::u_max, b, EdgeName::u_min);
  const Certificate c = certify_join(a, b, join);
  EXPECT_EQ(c.c0.verdict, Verdict::proven);
  EXPECT_EQ(c.c1.verdict, Verdict::refuted);
  EXPECT_EQ(c.g1.verdict, Verdict::proven);
  EXPECT_FALSE(c.ratio);
  EXPECT_FALSE(c.degenerate.empty());
  // Second order in another plane.
  const Surface<Rational> tilted = with_point(b, 9, b.point(2, 1) + Vec<Rational, 4>{{q(0), q(0), q(1), q(0)}});
  const Certificate t = certify_join(a, tilted, join);
  EXPECT_EQ(t.g1.verdict, Verdict::refuted);
  EXPECT_GT(t.angle.lower, 0);
  // Folded back over a.
  Surface<Rational> folded = b;
  for (int j = 0; j < 4; ++j) folded = with_point(folded, 8 + j, b.point(0, j) + b.point(0, j) - b.point(2, j));
  const Certificate f = certify_join(a, folded, join);
  EXPECT_EQ(f.g1.verdict, Verdict::refuted);
  EXPECT_EQ(f.orientation, Orientation::cusp);
  EXPECT_EQ(f.angle.lower, 180);
  EXPECT_EQ(f.plane_angle.upper, 0);
  // Nothing up to second order: undecided, never a guess.
  Surface<Rational> flat = b;
  for (int j = 0; j < 4; ++j) flat = with_point(flat, 8 + j, b.point(0, j));
  const Certificate n = certify_join(a, flat, join);
  EXPECT_EQ(n.c0.verdict, Verdict::proven);
  EXPECT_EQ(n.g1.verdict, Verdict::undecided);
  EXPECT_FALSE(n.g1.reason.empty());
  EXPECT_EQ(n.angle.upper, 180);
}

TEST(CertifyDegenerate, AnEdgeThatRunsBackOnItselfIsJudgedBetweenTheTurns) {
  // The edge x = (t − 1/2)², doubly covered: normals vanish at t = 1/2 and change sides; a plane goes on beyond it.
  const auto sheet = [](int direction) {
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 2; ++i)
      for (const Rational& x : {q(1, 4), q(-1, 4), q(1, 4)}) net.push_back(weighted(x, q(direction * i), q(0)));
    return Surface<Rational>(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(2), std::move(net));
  };
  const Surface<Rational> a = sheet(-1), b = sheet(1);
  const Certificate c = certify_join(a, b, edge_join(a, EdgeName::u_min, b, EdgeName::u_min));
  EXPECT_EQ(c.c1.verdict, Verdict::proven);
  EXPECT_EQ(c.g1.verdict, Verdict::proven);  // both sides turn together
  EXPECT_FALSE(c.degenerate.empty());
  const Certificate back = certify_join(a, a, edge_join(a, EdgeName::u_min, a, EdgeName::u_min));
  EXPECT_EQ(back.orientation, Orientation::cusp);
  EXPECT_EQ(back.g1.verdict, Verdict::refuted);
}

TEST(CertifyDegenerate, SidesThatChangeAlongTheEdgeAreMixed) {
  // y_s changes its sign at t = 1/2: smooth before it, folded back after it.
  std::vector<Vec<Rational, 4>> net_a, net_b;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      net_a.push_back(weighted(q(j), q(-i), q(0)));
      net_b.push_back(weighted(q(j), q(j == 0 ? i : -i), q(0)));
    }
  const auto patch = [](const std::vector<Vec<Rational, 4>>& net) {
    return Surface<Rational>(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(1), net);
  };
  const Surface<Rational> a = patch(net_a), b = patch(net_b);
  const Join<Rational> join = edge_join(a, EdgeName::u_min, b, EdgeName::u_min);
  const Certificate c = certify_join(a, b, join);
  EXPECT_EQ(c.g1.verdict, Verdict::refuted);
  EXPECT_EQ(c.orientation, Orientation::mixed);
  EXPECT_EQ(c.angle.lower, 180);
  EXPECT_EQ(c.plane_angle.upper, 0);
  ASSERT_TRUE(c.g1.witness);
  expect_true_witness(a, b, join, *c.g1.witness);
}

TEST(CertifyDegenerate, ANormalThatVanishesButKeepsItsSideLeavesTheBoundsTight) {
  // y_s of the first patch has the factor (3t − 1)²; the second patch is bent by atan(1/20) = 2.86°, or folded back so.
  const auto sheet = [](const std::vector<Rational>& y, const Rational& z) {
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 3; ++j) net.push_back(weighted(q(j, 2), q(i) * y[j], q(i) * z));
    return Surface<Rational>(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(2), std::move(net));
  };
  const Surface<Rational> a = sheet({q(-1), q(2), q(-4)}, q(0));
  const auto certificate = [&](int y) {
    const Surface<Rational> b = sheet({q(y), q(y), q(y)}, q(1, 20));
    return certify_join(a, b, edge_join(a, EdgeName::u_min, b, EdgeName::u_min));
  };
  const Certificate smooth = certificate(1), cusp = certificate(-1);
  EXPECT_EQ(smooth.orientation, Orientation::smooth);
  EXPECT_TRUE(smooth.angle.converged && smooth.angle.upper < 2.9);
  EXPECT_EQ(cusp.orientation, Orientation::cusp);
  EXPECT_TRUE(cusp.angle.converged && cusp.angle.lower > 175 && cusp.angle.upper < 177.2);
  EXPECT_TRUE(cusp.plane_angle.converged && cusp.plane_angle.upper < 2.9);
}

}  // namespace
}  // namespace patchproof::test
