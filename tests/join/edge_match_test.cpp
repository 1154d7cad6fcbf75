// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/edge_match.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <tuple>

#include "patchproof/join/certify.h"
#include "support/broken_joins.h"

namespace patchproof::test {
namespace {

using Surfaces = std::vector<Surface<Rational>>;

std::vector<const Surface<Rational>*> pointers(const Surfaces& s) {
  std::vector<const Surface<Rational>*> out;
  for (const auto& x : s) out.push_back(&x);
  return out;
}
EdgeMatch<Rational> match(const Surfaces& s, double length = 0) { return match_edges(pointers(s), length); }

Certificate certify(const Surfaces& s, const Join<Rational>& j) { return certify_join(s[j.patch_a], s[j.patch_b], j); }

EdgeName edge_of(const IsoLine<Rational>& line) {
  if (line.constant == Direction::u) return line.side == Side::right ? EdgeName::u_min : EdgeName::u_max;
  return line.side == Side::right ? EdgeName::v_min : EdgeName::v_max;
}

// The joins between two different patches.
std::vector<Join<Rational>> between(const EdgeMatch<Rational>& m, int a, int b) {
  std::vector<Join<Rational>> out;
  for (const auto& j : m.joins)
    if ((j.patch_a == a && j.patch_b == b) || (j.patch_a == b && j.patch_b == a)) out.push_back(j);
  return out;
}

// Law 1: joined, unmatched or collapsed.
void expect_every_edge_accounted_for(const Surfaces& s, const EdgeMatch<Rational>& m) {
  std::set<std::pair<int, EdgeName>> seen;
  for (const auto& j : m.joins)
    if (j.kind != JoinKind::knot_line)
      seen.insert({j.patch_a, edge_of(j.line_a)}), seen.insert({j.patch_b, edge_of(j.line_b)});
  for (const auto& e : m.unmatched) seen.insert({e.patch, e.edge});
  for (const auto& e : m.collapsed)
    EXPECT_TRUE(seen.insert({e.patch, e.edge}).second) << "collapsed and something else";
  EXPECT_EQ(seen.size(), 4 * s.size());
}

// A bilinear patch over [x0, x1] × [y0, y1]: u along x, v along y.
Surface<Rational> plate(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1,
                        const Rational& z = q(0)) {
  return {KnotVector<Rational>::bezier(1),
          KnotVector<Rational>::bezier(1),
          {weighted(x0, y0, q(0)), weighted(x0, y1, q(0)), weighted(x1, y0, z), weighted(x1, y1, z)}};
}

std::pair<Surface<Rational>, Surface<Rational>> halves(unsigned seed = 1) {
  return split(wavy_patch(3, 3, seed), Direction::u, q(1, 2));
}

TEST(EdgeMatch, Law1_EveryPairOfEdgesInEitherDirection) {
  const auto [a, b] = halves();
  const std::array<std::function<Surface<Rational>(const Surface<Rational>&)>, 8> symmetries{
      [](const auto& s) { return s; },
      [](const auto& s) { return reverse(s, Direction::u); },
      [](const auto& s) { return reverse(s, Direction::v); },
      [](const auto& s) { return reverse(reverse(s, Direction::u), Direction::v); },
      [](const auto& s) { return swap_directions(s); },
      [](const auto& s) { return reverse(swap_directions(s), Direction::u); },
      [](const auto& s) { return reverse(swap_directions(s), Direction::v); },
      [](const auto& s) { return reverse(reverse(swap_directions(s), Direction::u), Direction::v); }};
  std::set<std::tuple<EdgeName, EdgeName, bool>> seen;
  for (const auto& f : symmetries)
    for (const auto& g : symmetries) {
      const Surfaces s{f(a), g(b)};
      const auto m = match(s);
      ASSERT_EQ(m.joins.size(), 1u);
      EXPECT_EQ(m.unmatched.size(), 6u);
      expect_every_edge_accounted_for(s, m);
      EXPECT_EQ(m.joins[0].kind, JoinKind::isoparametric);
      EXPECT_EQ(m.joins[0].pairing.kind, PairingKind::identity);
      EXPECT_EQ(certify(s, m.joins[0]).c2.verdict, Verdict::proven);
      seen.insert({edge_of(m.joins[0].line_a), edge_of(m.joins[0].line_b), m.joins[0].pairing.reversed()});
    }
  EXPECT_EQ(seen.size(), 32u);
}

TEST(EdgeMatch, TheValidFamilyIsFoundAndProven) {
  for (const auto& valid : valid_joins()) {
    SCOPED_TRACE(valid.name);
    const Surfaces s{valid.a, valid.b};
    const auto found = match(s);
    const auto joins = between(found, 0, 1);
    ASSERT_EQ(joins.size(), 1u);
    EXPECT_EQ(joins[0].kind, valid.join.kind);
    EXPECT_EQ(joins[0].pairing.kind, valid.join.pairing.kind);
    EXPECT_EQ(joins[0].pairing.ratio, valid.join.pairing.ratio);
    EXPECT_TRUE(joins[0].pairing.a == valid.join.pairing.a && joins[0].pairing.b == valid.join.pairing.b);
    EXPECT_EQ(certify(s, joins[0]).g1.verdict, Verdict::proven);
    expect_every_edge_accounted_for(s, found);
  }
}

TEST(EdgeMatch, TJunctionsEndAtExactParameters) {
  const auto [whole, b] = halves(3);
  for (const Rational& at : {q(1, 3), q(137, 1009), q(12345, 1000000), q(2, 65536)}) {
    SCOPED_TRACE(to_text(at));
    const auto [low, high] = split(b, Direction::v, at);
    const Surfaces s{whole, low, reverse(high, Direction::v)};
    const auto m = match(s);
    const auto joins_low = between(m, 0, 1), joins_high = between(m, 0, 2);
    ASSERT_TRUE(joins_low.size() == 1 && joins_high.size() == 1);
    EXPECT_EQ(joins_low[0].kind, JoinKind::t_junction);
    EXPECT_TRUE((joins_low[0].pairing.a == std::vector<Rational>{q(0), at}));
    EXPECT_TRUE((joins_high[0].pairing.a == std::vector<Rational>{at, q(1)}));
    EXPECT_TRUE(joins_high[0].pairing.reversed());
    for (const auto& j : m.joins) EXPECT_EQ(certify(s, j).c2.verdict, Verdict::proven);
    for (const auto& e : m.unmatched)
      EXPECT_FALSE(e.patch == 0 && e.edge == EdgeName::u_max) << "nothing of it is free";
    expect_every_edge_accounted_for(s, m);
  }
}

TEST(EdgeMatch, ATJunctionAtAKnotTakesTheKnot) {
  const auto [a, b] = halves();
  const Rational knot = *parse_scalar<Rational>("0.31415926535897932384626433832795");
  const auto [low, high] = split(b, Direction::v, knot);
  const Surfaces s{insert_knot(a, Direction::v, knot), low, high};
  const auto m = match(s);
  ASSERT_EQ(between(m, 0, 1).size(), 1u);
  EXPECT_EQ(between(m, 0, 1)[0].pairing.a[1], knot);
  EXPECT_EQ(certify(s, between(m, 0, 1)[0]).c0.verdict, Verdict::proven);
}

TEST(EdgeMatch, PartialOverlapLeavesUnmatchedRanges) {
  const Surfaces s{plate(q(0), q(1), q(0), q(2)), plate(q(1), q(2), q(1), q(5))};
  const auto m = match(s);
  ASSERT_EQ(m.joins.size(), 1u);
  EXPECT_EQ(m.joins[0].kind, JoinKind::t_junction);
  EXPECT_TRUE((m.joins[0].pairing.a == std::vector<Rational>{q(1, 2), q(1)}));
  EXPECT_TRUE((m.joins[0].pairing.b == std::vector<Rational>{q(0), q(1, 4)}));
  EXPECT_EQ(certify(s, m.joins[0]).g1.verdict, Verdict::proven);
  int ranges = 0;
  for (const EdgeRange& e : m.unmatched) {
    if (e.patch == 0 && e.edge == EdgeName::u_max && e.begin == 0 && e.end == 0.5) ++ranges;
    if (e.patch == 1 && e.edge == EdgeName::u_min && e.begin == 0.25 && e.end == 1) ++ranges;
  }
  EXPECT_EQ(ranges, 2);
  expect_every_edge_accounted_for(s, m);
  // Reversed.
  const Surfaces back{s[0], reverse(s[1], Direction::v)};
  const auto r = match(back);
  ASSERT_EQ(r.joins.size(), 1u);
  EXPECT_TRUE((r.joins[0].pairing.b == std::vector<Rational>{q(1), q(3, 4)}));
  EXPECT_EQ(certify(back, r.joins[0]).g1.verdict, Verdict::proven);
}

TEST(EdgeMatch, EdgesThatOnlyTouchAreFree) {
  const Surfaces s{plate(q(0), q(1), q(0), q(1)), plate(q(1), q(2), q(1), q(2))};
  const auto m = match(s);
  EXPECT_TRUE(m.joins.empty());
  EXPECT_EQ(m.unmatched.size(), 8u);
  // A corner in the middle of an edge.
  const Surfaces corner{s[0], plate(q(1), q(2), q(1, 2), q(1, 2) + q(1))};
  const Surface<Rational> turned = apply(rotation_about(Vec<Rational, 3>{{q(0), q(0), q(1)}}, q(1, 7)), corner[1]);
  const Vec<Rational, 3> to{{q(1) - turned.point(0, 0)[0], q(1, 2) - turned.point(0, 0)[1], q(0)}};
  EXPECT_TRUE(match({s[0], apply(translation(to), turned)}).joins.empty());
}

TEST(EdgeMatch, ThreePatchesOnOneEdgeAreThreeJoins) {
  const Surfaces s{plate(q(-1), q(0), q(0), q(1)), plate(q(0), q(1), q(0), q(1)), plate(q(0), q(1), q(0), q(1), q(1))};
  const auto m = match(s);
  EXPECT_EQ(m.joins.size(), 3u);
  for (const auto& j : m.joins) EXPECT_EQ(certify(s, j).c0.verdict, Verdict::proven);
  expect_every_edge_accounted_for(s, m);
}

// A closed, irregular spline curve without symmetry, extruded from z = 0 to z = height.
Surface<Rational> tube(int height) {
  const std::vector<std::pair<int, int>> ring{{4, 0}, {5, 2}, {1, 6}, {-3, 4}, {-5, -1}, {-1, -4}, {3, -3}, {4, 0}};
  std::vector<Vec<Rational, 4>> net;
  for (int z : {0, height})
    for (const auto& [x, y] : ring) net.push_back(weighted(q(x), q(y), q(z)));
  std::vector<Rational> knots{q(0), q(0), q(0), q(0), q(1), q(2), q(3), q(4), q(5), q(5), q(5), q(5)};
  return {KnotVector<Rational>::bezier(1), KnotVector<Rational>::make(3, knots).value(), std::move(net)};
}

TEST(EdgeMatch, SeamsAndClosedEdgesInEitherDirection) {
  for (const bool reversed : {false, true}) {
    SCOPED_TRACE(reversed);
    const Surfaces s{tube(2), reversed ? reverse(tube(-2), Direction::v) : tube(-2)};
    const auto m = match(s);
    int seams = 0;
    for (const auto& j : m.joins) {
      const Certificate c = certify(s, j);
      EXPECT_EQ(c.c0.verdict, Verdict::proven);
      if (j.kind == JoinKind::seam) {
        ++seams;
        EXPECT_EQ(j.patch_a, j.patch_b);
        EXPECT_EQ(c.g1.verdict, Verdict::refuted);
      } else {
        EXPECT_EQ(j.pairing.reversed(), reversed);
        EXPECT_EQ(c.c2.verdict, Verdict::proven);
      }
    }
    EXPECT_EQ(seams, 2);
    EXPECT_EQ(m.joins.size(), 3u);
    EXPECT_EQ(m.unmatched.size(), 2u);
    expect_every_edge_accounted_for(s, m);
  }
}

TEST(EdgeMatch, ClosedEdgesAtAnotherPaceAreRunInTheRightDirection) {
  const Surface<Rational> above = tube(2);
  // The same curve, slower in places: pieces of other lengths of parameter.
  Surface<Rational> below = tube(-2);
  for (int k = 1; k < 5; ++k) below = raise_multiplicity(below, Direction::v, q(k), 3);
  std::vector<Rational> other_pace;
  for (const Rational& k : below.knots(Direction::v).knots()) other_pace.push_back(k * (q(10) + k));
  below = {below.knots(Direction::u), KnotVector<Rational>::make(3, other_pace).value(), below.net()};
  for (const bool reversed : {false, true}) {
    const Surfaces s{above, reversed ? reverse(below, Direction::v) : below};
    const auto joins = between(match(s, 1e-2), 0, 1);
    ASSERT_EQ(joins.size(), 1u);
    EXPECT_EQ(joins[0].pairing.reversed(), reversed);
    EXPECT_EQ(joins[0].pairing.kind, PairingKind::piecewise_linear);
    EXPECT_LE(certify(s, joins[0]).gap.upper, 1e-2);
  }
}

TEST(EdgeMatch, CollapsedEdgesExactlyAndNearly) {
  const Surface<Rational> octant = sphere_octant(q(1), q(2));
  const auto pole = match({octant});
  ASSERT_EQ(pole.collapsed.size(), 1u);
  EXPECT_TRUE(pole.collapsed[0].exactly && pole.collapsed[0].tangent_plane);
  EXPECT_EQ(pole.collapsed[0].edge, EdgeName::u_max);
  EXPECT_EQ(pole.unmatched.size(), 3u);
  expect_every_edge_accounted_for({octant}, pole);

  const Vec<Rational, 4> h = octant.point(2, 1);
  const Rational tiny = *parse_scalar<Rational>("1e-15");
  const auto nearly = match({with_point(octant, 7, h + Vec<Rational, 4>{{tiny, q(0), q(0), q(0)}})});
  ASSERT_EQ(nearly.collapsed.size(), 1u);
  EXPECT_FALSE(nearly.collapsed[0].exactly);
  EXPECT_FALSE(nearly.collapsed[0].tangent_plane);

  // A cone: its tip has no tangent plane. A flat sector has one.
  const auto sector = [](const Rational& height) {
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 3; ++j)
        net.push_back(weighted(q(i * (j < 2)), q(i * (j > 0)), Rational(height * q(1 - i)), j == 2 ? q(2) : q(1)));
    return Surface<Rational>(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(2), std::move(net));
  };
  const auto cone = match({sector(q(1))}), disk = match({sector(q(0))});
  ASSERT_TRUE(cone.collapsed.size() == 1 && disk.collapsed.size() == 1);
  EXPECT_TRUE(cone.collapsed[0].exactly);
  EXPECT_FALSE(cone.collapsed[0].tangent_plane);
  EXPECT_TRUE(disk.collapsed[0].tangent_plane);
}

TEST(EdgeMatch, EdgesAtAnotherPaceGetAPiecewiseLinearPairing) {
  // The straight edge x = 0 run through as t and as t² (3 − 2t), which stops at both ends: no rational linear map.
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i < 2; ++i)
    for (const Rational& y : {q(0), q(0), q(1), q(1)}) net.push_back(weighted(q(i), y, q(i * i)));
  const Surfaces s{plate(q(-1), q(0), q(0), q(1)),
                   Surface<Rational>(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(3), net)};
  for (const bool reversed : {false, true}) {
    const Surfaces pair{s[0], reversed ? reverse(s[1], Direction::v) : s[1]};
    const auto m = match(pair, 1e-3);
    ASSERT_EQ(m.joins.size(), 1u);
    const Pairing<Rational>& p = m.joins[0].pairing;
    EXPECT_EQ(p.kind, PairingKind::piecewise_linear);
    EXPECT_EQ(p.reversed(), reversed);
    for (std::size_t i = 0; i + 1 < p.a.size(); ++i) {
      EXPECT_LT(p.a[i], p.a[i + 1]);
      EXPECT_TRUE(reversed ? p.b[i + 1] < p.b[i] : p.b[i] < p.b[i + 1]);
    }
    EXPECT_TRUE(p.a.front() == q(0) && p.a.back() == q(1));
    const Certificate c = certify(pair, m.joins[0]);
    EXPECT_EQ(c.c0.verdict, Verdict::undecided);  // another pairing might join them
    EXPECT_LE(c.gap.upper, 1e-3);
  }
}

TEST(EdgeMatch, Law2_TheOrderOfThePatchesDoesNotMatter) {
  const auto [a, b] = halves();
  const auto [low, high] = split(b, Direction::v, q(2, 5));
  Surfaces s{a, low, high, plate(q(50), q(51), q(0), q(1)), plate(q(51), q(52), q(0), q(1))};
  std::vector<int> order{0, 1, 2, 3, 4};
  using End = std::pair<int, EdgeName>;
  std::optional<std::set<std::set<End>>> expected;
  do {
    Surfaces shuffled;
    for (int i : order) shuffled.push_back(s[i]);
    const auto m = match(shuffled);
    std::set<std::set<End>> found;
    for (const auto& j : m.joins) {
      found.insert({{order[j.patch_a], edge_of(j.line_a)}, {order[j.patch_b], edge_of(j.line_b)}});
      EXPECT_EQ(certify(shuffled, j).c2.verdict, Verdict::proven);
    }
    if (!expected) expected = found;
    EXPECT_EQ(found, *expected);
    EXPECT_EQ(found.size(), 4u);
    expect_every_edge_accounted_for(shuffled, m);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(EdgeMatch, Law3_ListsAreSorted) {
  Surfaces s;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) s.push_back(plate(q(i), q(i + 1), q(j), q(j + 1)));
  const auto m = match(s);
  EXPECT_EQ(m.joins.size(), 24u);
  EXPECT_EQ(m.unmatched.size(), 16u);
  const auto key = [](const Join<Rational>& j) {
    return std::tuple(j.patch_a, edge_of(j.line_a), j.patch_b, edge_of(j.line_b));
  };
  for (std::size_t i = 0; i + 1 < m.joins.size(); ++i) EXPECT_LT(key(m.joins[i]), key(m.joins[i + 1]));
  for (std::size_t i = 0; i + 1 < m.unmatched.size(); ++i)
    EXPECT_LT(std::pair(m.unmatched[i].patch, m.unmatched[i].edge),
              std::pair(m.unmatched[i + 1].patch, m.unmatched[i + 1].edge));
}

TEST(EdgeMatch, TheMatchLengthDecidesOnlyWhichEdgesAreLookedAt) {
  const Surfaces s{plate(q(0), q(1), q(0), q(1)), plate(q(1001, 1000), q(2), q(0), q(1))};
  EXPECT_TRUE(match(s).joins.empty());
  EXPECT_TRUE(match(s, 0.0009).joins.empty());
  const auto m = match(s, 0.0011);
  ASSERT_EQ(m.joins.size(), 1u);
  EXPECT_EQ(m.length, 0.0011);
  const Certificate c = certify(s, m.joins[0]);
  EXPECT_EQ(c.c0.verdict, Verdict::refuted);
  EXPECT_LE(c.gap.lower, 0.001);
  EXPECT_GE(c.gap.upper, 0.001);
}

TEST(EdgeMatch, LinesInsideAPatchThatAllowAKinkAreLookedAt) {
  const Surface<Rational> smooth = raise_multiplicity(wavy_patch(3, 3), Direction::u, q(1, 2), 3);
  const auto m = match({smooth});
  ASSERT_EQ(m.joins.size(), 1u);
  EXPECT_EQ(m.joins[0].kind, JoinKind::knot_line);
  EXPECT_EQ(certify({smooth}, m.joins[0]).c2.verdict, Verdict::proven);
  const Surface<Rational> torn = insert_knot(smooth, Direction::u, q(1, 2));
  EXPECT_EQ(certify({torn}, match({torn}).joins[0]).c2.verdict, Verdict::proven);
  const Surface<Rational> apart =
      with_point(torn, 4 * 4 + 1, torn.net()[4 * 4 + 1] + Vec<Rational, 4>{{q(0), q(0), q(1, 100), q(0)}});
  EXPECT_EQ(certify({apart}, match({apart}).joins[0]).c0.verdict, Verdict::refuted);
}

TEST(EdgeMatch, DeclaredJoinsTakeWholeEdges) {
  const auto [a, b] = halves();
  const Surfaces s{a, moebius(reverse(b, Direction::v), Direction::v, q(5, 4)), plate(q(50), q(60), q(0), q(1))};
  const Join<Rational> good = whole_edge_join(pointers(s), 0, EdgeName::u_max, 1, EdgeName::u_min, true);
  EXPECT_EQ(good.pairing.kind, PairingKind::rational_linear);
  EXPECT_EQ(certify(s, good).c2.verdict, Verdict::proven);
  const Join<Rational> wrong_way = whole_edge_join(pointers(s), 0, EdgeName::u_max, 1, EdgeName::u_min, false);
  EXPECT_EQ(certify(s, wrong_way).c0.verdict, Verdict::refuted);
  const Join<Rational> far = whole_edge_join(pointers(s), 0, EdgeName::v_min, 2, EdgeName::v_max, false);
  EXPECT_GT(certify(s, far).gap.lower, 30);
  EXPECT_EQ(whole_edge_join(pointers(s), 0, EdgeName::u_min, 0, EdgeName::u_max, false).kind, JoinKind::seam);
}

TEST(EdgeMatch, NothingToMatch) {
  const auto none = match({});
  EXPECT_TRUE(none.joins.empty() && none.unmatched.empty() && none.collapsed.empty());
  const auto one = match({wavy_patch(3, 3)});
  EXPECT_TRUE(one.joins.empty());
  EXPECT_EQ(one.unmatched.size(), 4u);
}

}  // namespace
}  // namespace patchproof::test
