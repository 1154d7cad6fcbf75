// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/edge_connection.h"

#include <gtest/gtest.h>

#include <set>

#include "support/graph_mesh.h"
#include "validation/corpus/curve_meshes.h"

namespace patchproof::test {
namespace {

Rational at(const Piecewise<Rational, 1>& f, const Rational& t, int order = 0, Side side = Side::right) {
  return value(f, t, order, side)[0];
}

// Places of [begin, end]: its ends, every break of the three functions inside, and what lies between.
std::vector<Rational> places_of(const EdgeUse& use, const std::vector<std::vector<Rational>>& all) {
  std::set<Rational> out{use.begin(), use.end()};
  for (const auto& list : all)
    for (const Rational& t : list)
      if (use.begin() < t && t < use.end()) out.insert(t);
  std::vector<Rational> dense;
  for (auto low = out.begin(), high = std::next(low); high != out.end(); ++low, ++high)
    for (const int k : {0, 1, 3, 5}) dense.push_back(((6 - k) * *low + k * *high) / 6);
  dense.push_back(use.end());
  return dense;
}

struct Connected {
  CurveMesh mesh;
  MeshTopology topology;
  EdgeConnection edge;
};
Connected connected(const CurveMesh& mesh, const FillOptions& options = {}) {
  MeshTopology topology = analyse(mesh).value();
  EdgeConnection edge = connect_edge(mesh, topology, 0, options).value();
  return {mesh, std::move(topology), std::move(edge)};
}

// Laws 1, 2, 4 and the C¹ part of 3 and 6, of all uses of edge 0.
void expect_laws(const Connected& c, const FillOptions& options) {
  const Piecewise<Rational, 4>& curve = c.topology.curves[0];
  const bool former = options.method == FillMethod::former;
  for (const auto* side : {&c.topology.left[0], &c.topology.right[0]})
    for (const int index : *side) {
      const EdgeUse& use = c.topology.uses[index];
      const UseConnection of_use = connect_use(c.mesh, c.topology, c.edge, use, options);
      const int sign = use.is_left() ? 1 : -1;
      EXPECT_EQ(breaks(of_use.k).front(), use.begin());
      EXPECT_EQ(breaks(of_use.k).back(), use.end());
      EXPECT_EQ(breaks(of_use.h).front(), use.begin());
      EXPECT_EQ(breaks(of_use.h).back(), use.end());
      const auto across = [&](const Rational& t) {
        const Rational w = value(curve, t)[3];
        return Rational(sign * at(of_use.k, t) / w) * value(c.edge.basis, t) + at(of_use.h, t) * edge_tangent(curve, t);
      };
      EXPECT_EQ(across(use.begin()), use.begin_derivative);
      EXPECT_EQ(across(use.end()), use.end_derivative);
      for (const auto& piece : of_use.k)
        for (const auto& k : piece.points) EXPECT_GT(k[0], 0);
      if (!former) {
        EXPECT_EQ(of_use.k.size(), 1u);
        EXPECT_EQ(of_use.k.front().degree(), 1);
      }
      for (const Rational& t :
           places_of(use, {breaks(curve), breaks(c.edge.basis), breaks(of_use.k), breaks(of_use.h)})) {
        const Point3 a = value(c.edge.basis, t), tangent = edge_tangent(curve, t);
        EXPECT_FALSE(is_parallel(a, tangent)) << t;
        if (t == use.begin() || t == use.end()) continue;
        // D and, but for the former method, its derivative from both sides, by Leibniz' rule.
        const auto derivative = [&](int order, Side s) {
          Vec<Rational, 4> sum;
          for (int i = 0; i <= order; ++i) {
            const Point3 of_a = value(c.edge.basis, t, i, s);
            sum += Rational(sign * at(of_use.k, t, order - i, s)) * Vec<Rational, 4>{{of_a[0], of_a[1], of_a[2], 0}};
            sum += at(of_use.h, t, i, s) * value(curve, t, order - i + 1, s);
          }
          return sum;
        };
        EXPECT_EQ(derivative(0, Side::left), derivative(0, Side::right)) << t;
        if (!former) {
          EXPECT_EQ(derivative(1, Side::left), derivative(1, Side::right)) << t;
        }
      }
    }
}

TEST(EdgeConnection, Law1To4_RandomMeshes) {
  int bumps = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed)
    for (const FillOptions& options : {FillOptions{}, FillOptions{NodeScale::rational, FillMethod::c1},
                                       FillOptions{NodeScale::none, FillMethod::former}}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      const CurveMesh mesh = validation::two_faces(seed, seed % 2 == 1);
      const MeshTopology topology = analyse(mesh).value();
      ASSERT_EQ(topology.kinds[0], EdgeKind::smooth);
      const Result<EdgeConnection> edge = connect_edge(mesh, topology, 0, options);
      if (!edge) {  // linear pieces may fail where smooth ones do not
        EXPECT_EQ(edge.error().code, ErrorCode::basis_along_edge);
        continue;
      }
      expect_laws({mesh, topology, *edge}, options);
      bumps += connect_use(mesh, topology, *edge, topology.uses[topology.left[0][0]], options).h.front().degree() == 2;
    }
  EXPECT_GT(bumps, 0);
}

TEST(EdgeConnection, Law3_TheVectorsAtTheNodes) {
  GraphMesh g = two_columns(
      {.inner = {"1/5"_q, "1/2"_q}, .w0 = 2, .to_left = {"1/3"_q, "1/2"_q}, .to_right = {"1/2"_q, "3/4"_q}});
  const Point3 at_vectors = g.lifted(g.at(0, "1/4"_q), {-1, "1/8"_q});
  g.mesh.control_vectors = {{0, "1/4"_q, at_vectors, -3 * at_vectors}, {0, "1/2"_q, {}, {}}};
  // T-edges leave from 1/3 and 1/2 to the left, from 1/2 and 3/4 to the right.
  const auto leaving = [&](const Rational& t, bool left) {
    Point3 sum;
    for (const MeshEdge& e : g.mesh.edges)
      if (e.begin.kind == MeshNode::Kind::t_node && g.mesh.t_nodes[e.begin.index].edge == 0 &&
          g.mesh.t_nodes[e.begin.index].parameter == t) {
        const Place2 a = g.at(e.begin), b = g.at(e.end);
        if ((b[0] < a[0]) == left) sum += g.lifted(a, {b[0] - a[0], b[1] - a[1]});
      }
    return sum;
  };
  const Point3 at_half = leaving("1/2"_q, true) - leaving("1/2"_q, false);
  g.mesh.control_vectors[1].left = "1/9"_q * at_half;
  g.mesh.control_vectors[1].right = -at_half;
  const Connected c = connected(g.mesh);
  EXPECT_EQ(c.edge.places, (std::vector<Rational>{0, "1/4"_q, "1/3"_q, "1/2"_q, "3/4"_q, 1}));
  const auto end = [&](int left, int right, const Rational& t) {
    const auto d = [&](int e) {
      const Place2 a = g.at(g.mesh.edges[e].begin), b = g.at(g.mesh.edges[e].end);
      return g.lifted(g.at(0, t), {b[0] - a[0], b[1] - a[1]});
    };
    return d(left) - d(right);
  };
  const auto edge_between = [&](int begin, int end_vertex) {
    for (std::size_t e = 0; e < g.mesh.edges.size(); ++e)
      if (g.mesh.edges[e].begin == MeshNode{MeshNode::Kind::vertex, begin} &&
          g.mesh.edges[e].end == MeshNode{MeshNode::Kind::vertex, end_vertex})
        return static_cast<int>(e);
    return -1;
  };
  ASSERT_EQ(c.edge.vectors.size(), 6u);
  EXPECT_EQ(c.edge.vectors[0], end(edge_between(0, 2), edge_between(0, 4), 0));
  EXPECT_EQ(c.edge.vectors[1], Rational(4) * at_vectors);
  EXPECT_EQ(c.edge.vectors[2], leaving("1/3"_q, true));
  EXPECT_EQ(c.edge.vectors[3], at_half) << "the T-node's, not the control vectors'";
  EXPECT_EQ(c.edge.vectors[4], -leaving("3/4"_q, false));
  EXPECT_EQ(c.edge.vectors[5], end(edge_between(1, 3), edge_between(1, 5), 1));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(value(c.edge.basis, c.edge.places[i]), c.edge.vectors[i]);
  EXPECT_TRUE(is_c1(c.edge.basis));
  expect_laws(c, {});
}

TEST(EdgeConnection, Law5_LengthsRoundedDown) {
  GraphMesh g = two_columns({.to_left = {"1/3"_q}});
  const Point3 d = g.lifted(g.at(0, "2/3"_q), {-1, 0});
  g.mesh.control_vectors = {{0, "2/3"_q, d, -d}};
  const std::vector<Point3> unscaled = connected(g.mesh).edge.vectors;
  for (const Rational& size : {Rational(1), Rational(1, 3000000), Rational(1, Integer(1) << 50), Rational(1234567)}) {
    g.mesh.control_vectors = {{0, "2/3"_q, size * d, -size * d}};
    const Connected scaled = connected(g.mesh, {NodeScale::rational, FillMethod::c1});
    std::vector<Point3> plain = unscaled;
    plain[2] = Rational(2 * size) * d;
    ASSERT_EQ(scaled.edge.vectors.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const Point3 &v = plain[i], &u = scaled.edge.vectors[i];
      ASSERT_TRUE(same_direction(u, v));
      const Rational length = v[0] / u[0], square = dot(v, v);
      Rational grid(1, 65536);
      while (square < grid * grid) grid /= 65536;
      EXPECT_EQ(denominator(Rational(length / grid)), 1);
      EXPECT_LE(length * length, square);
      EXPECT_GT((length + grid) * (length + grid), square);
    }
    expect_laws(scaled, {NodeScale::rational, FillMethod::c1});
  }
}

TEST(EdgeConnection, Law6_TheFormerMethodIsPiecewiseLinear) {
  GraphMesh g = two_columns({.to_left = {"1/3"_q}});
  const Point3 d = g.lifted(g.at(0, "2/3"_q), {-1, 0});
  g.mesh.control_vectors = {{0, "2/3"_q, 5 * d, -d}};
  const FillOptions former{NodeScale::none, FillMethod::former};
  const Connected c = connected(g.mesh, former);
  EXPECT_EQ(breaks(c.edge.basis), (std::vector<Rational>{0, "1/3"_q, "2/3"_q, 1}));
  EXPECT_EQ(c.edge.basis.front().degree(), 1);
  EXPECT_FALSE(is_c1(c.edge.basis));
  expect_laws(c, former);
  // The lengths of the control vectors count.
  for (const auto* side : {&c.topology.left[0], &c.topology.right[0]}) {
    const EdgeUse& use = c.topology.uses[side->back()];
    const UseConnection of_use = connect_use(c.mesh, c.topology, c.edge, use, former);
    EXPECT_EQ(at(of_use.k, "2/3"_q) * value(c.edge.basis, "2/3"_q), use.is_left() ? 5 * d : d);
    EXPECT_EQ(of_use.h.front().degree(), 1);
  }
}

// (t − r) times a vector, and sums of it with others.
TEST(EdgeConnection, Law7_NoZeroIsNeverSaidOfAVectorWithOne) {
  using Vectors = std::vector<Point3>;
  RandomRationals random;
  for (int round = 0; round < 40; ++round) {
    const Rational r = random.integer(0, 60) / Rational(60), tiny = Rational(1, Integer(1) << random.integer(1, 60));
    const Vectors g = random.points<3>(random.integer(1, 4));
    const std::vector<Rational> root{-r, 1 - r};
    EXPECT_FALSE(no_zero(product(root, g))) << "zero at " << r;
    const std::vector<Rational> twice{r * r, -r * (1 - r), (1 - r) * (1 - r)};
    EXPECT_FALSE(no_zero(product(twice, g)));
    // (t − r)² + tiny in one place and t − r in others: no common zero.
    Vectors apart;
    for (const Rational& x : twice) apart.push_back({{x + tiny, 0, 0}});
    for (int i = 0; i < 3; ++i) apart[i][1] = std::vector<Rational>{-r, (1 - 2 * r) / 2, 1 - r}[i];
    if (tiny > Rational(1, 1 << 20)) {
      EXPECT_TRUE(no_zero(apart)) << r << " " << tiny;
    }
    for (Point3& x : apart) x[0] -= tiny;
    EXPECT_FALSE(no_zero(apart));
  }
  const Rational half("1/2"_q);
  EXPECT_FALSE(no_zero({{{0, 0, 0}}}));
  EXPECT_TRUE(no_zero({{{0, 0, Rational(1, Integer(1) << 500)}}}));
  EXPECT_FALSE(no_zero({{{-half, half, 0}}, {{-half, half, 0}}, {{half, -half, 0}}})) << "t² = 1/2, no rational zero";
  EXPECT_TRUE(no_zero({{{1, 0, 0}}, {{0, 1, 0}}, {{-1, 0, 0}}})) << "half a turn";
  EXPECT_FALSE(no_zero({{{1, 0, 0}}, {{0, 0, 0}}, {{-1, 0, 0}}}));
  EXPECT_TRUE(no_zero({{{3, 0, 0}}, {{-1, 1, 0}}, {{-1, -1, 0}}, {{3, 0, 1}}})) << "nearly all round";
}

TEST(EdgeConnection, NodeFieldReproducesParabolas) {
  RandomRationals random;
  const std::vector<Rational> all{0, "1/9"_q, "1/2"_q, "4/7"_q, 1};
  for (std::size_t count = 2; count <= all.size(); ++count) {
    const std::vector<Rational> places(all.end() - static_cast<std::ptrdiff_t>(count), all.end());
    const Point3 a = random.point<3>(), b = random.point<3>(), c = count == 2 ? Point3{} : random.point<3>();
    std::vector<Point3> vectors, wild;
    for (const Rational& t : places) {
      vectors.push_back(a + t * b + Rational(t * t) * c);
      wild.push_back(random.point<3>());
    }
    const auto f = node_field<Rational, 3>(places, vectors);
    EXPECT_EQ(breaks(f), places);
    EXPECT_EQ(f.front().degree(), count == 2 ? 1 : count == 3 ? 2 : 3);
    for (std::size_t i = 0; i + 1 < count; ++i)
      for (const int k : {0, 1, 2, 3}) {
        const Rational t = (k * places[i] + (3 - k) * places[i + 1]) / 3;
        EXPECT_EQ(value(f, t), a + t * b + Rational(t * t) * c);
      }
    const auto smooth = node_field<Rational, 3>(places, wild), straight = node_field<Rational, 3>(places, wild, false);
    EXPECT_TRUE(is_c1(smooth));
    EXPECT_EQ(straight.front().degree(), 1);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(value(smooth, places[i]), wild[i]);
      EXPECT_EQ(value(straight, places[i]), wild[i]);
    }
    if (count == 3) {
      EXPECT_EQ(value(smooth, places[1], 2, Side::left), value(smooth, places[1], 2)) << "one parabola";
    }
    with_bound(value(smooth, places.back(), 1, Side::left), [&]<class S>() {
      return value(node_field<S, 3>(places, make_points<S>(wild)), places.back(), 1, Side::left);
    });
  }
  EXPECT_THROW((void)(node_field<Rational, 3>({0}, {{}})), contract_error);
  EXPECT_THROW((void)(node_field<Rational, 3>({0, 1}, {{}})), contract_error);
}

TEST(EdgeConnection, GivenDerivativesOfBoundaries) {
  GraphMesh g = two_columns({.w0 = 3, .w1 = 2, .to_left = {"1/2"_q}});
  const Point3 d{{0, 0, 7}};
  g.mesh.faces.resize(2);  // those to the left of edge 0, which is a boundary now
  std::vector<MeshEdge> edges(g.mesh.edges.begin(), g.mesh.edges.begin() + 4);
  for (std::size_t e = 4; e < g.mesh.edges.size(); ++e)
    if (g.mesh.edges[e].begin.kind == MeshNode::Kind::t_node) edges.push_back(g.mesh.edges[e]);
  for (MeshFace& f : g.mesh.faces)
    for (FaceSide& s : f.sides)
      if (s.edge >= 4) s.edge = 4;
  g.mesh.edges = edges;
  g.mesh.control_vectors = {{0, "3/4"_q, d, {}}, {0, "1/4"_q, d, 2 * d}, {0, "1/2"_q, 5 * d, {}}, {0, "1/3"_q, {}, d}};
  const MeshTopology topology = analyse(g.mesh).value();
  ASSERT_EQ(topology.kinds[0], EdgeKind::boundary);
  EXPECT_THROW((void)connect_edge(g.mesh, topology, 0), contract_error);
  const EdgeUse &low = topology.uses[topology.left[0][0]], &high = topology.uses[topology.left[0][1]];
  const auto weight = [](const Rational& t) { return Rational(3 - t); };
  const GivenDerivatives of_low = given_derivatives(g.mesh, topology, low),
                         of_high = given_derivatives(g.mesh, topology, high);
  EXPECT_EQ(of_low.places, (std::vector<Rational>{0, "1/4"_q, "1/2"_q}));
  EXPECT_EQ(of_high.places, (std::vector<Rational>{"1/2"_q, "3/4"_q, 1}));
  EXPECT_EQ(of_low.vectors, (std::vector<Point3>{weight(0) * low.begin_derivative, weight("1/4"_q) * d,
                                                 weight("1/2"_q) * low.end_derivative}));
  EXPECT_EQ(of_high.vectors, (std::vector<Point3>{weight("1/2"_q) * high.begin_derivative, weight("3/4"_q) * d,
                                                  weight(1) * high.end_derivative}));
}

TEST(EdgeConnection, Errors) {
  const auto expect = [](ErrorCode code, std::optional<Point3> left, std::optional<Point3> right,
                         const Rational& t = "2/3"_q, bool flat = false) {
    GraphMesh g = two_columns(
        {.f = flat ? std::array<Rational, 3>{} : std::array<Rational, 3>{1, "-1/2"_q, "3/4"_q}, .to_left = {"1/3"_q}});
    g.mesh.control_vectors = {{0, t, left, right}};
    const MeshTopology topology = analyse(g.mesh).value();
    const Result<EdgeConnection> made = connect_edge(g.mesh, topology, 0);
    ASSERT_FALSE(made) << "expected " << to_string(code);
    EXPECT_EQ(made.error().code, code) << made.error().text();
    EXPECT_EQ(made.error().where.rfind("edge E0", 0), 0u);
  };
  const GraphMesh g = two_columns({.to_left = {"1/3"_q}});
  const Point3 d = g.lifted(g.at(0, "2/3"_q), {-1, 0}), along = g.lifted(g.at(0, "2/3"_q), g.direction({0, 0, 1}));
  expect(ErrorCode::control_vector_missing, {}, {});
  expect(ErrorCode::control_vector_missing, d, {});
  expect(ErrorCode::control_vector_missing, {}, d);
  expect(ErrorCode::control_vectors_bent, d, d);
  expect(ErrorCode::control_vectors_bent, d, Point3{});
  expect(ErrorCode::control_vectors_bent, Point3{}, Point3{});
  expect(ErrorCode::control_vectors_bent, d, -d + Point3{{0, 0, Rational(1, Integer(1) << 99)}});
  expect(ErrorCode::control_vector_along, along, -along);
  // In a plane a vector on the wrong side cannot be reached without running along the edge.
  expect(ErrorCode::basis_along_edge, Point3{{1, 0, 0}}, Point3{{-1, 0, 0}}, "2/3"_q, true);
  expect(ErrorCode::basis_along_edge, Point3{{1, 0, 0}}, Point3{{-1, 0, 0}}, "1/1000"_q, true);
  expect(ErrorCode::control_vector_differs, d, -d, "1/3"_q);
}

}  // namespace
}  // namespace patchproof::test
