// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/prove_fill.h"

#include <gtest/gtest.h>

#include "support/graph_mesh.h"
#include "validation/corpus/curve_meshes.h"

namespace patchproof::test {
namespace {

using Patch = GregoryPatch<Rational>;

struct Proven {
  CurveMesh mesh;
  MeshTopology topology;
  std::vector<Patch> patches;
  FillProof proof;
};
Proven proven(const CurveMesh& mesh, const FillOptions& options = {}) {
  MeshTopology topology = analyse(mesh).value();
  std::vector<Patch> patches = fill_faces<Rational>(mesh, topology, options, 1).value().patches;
  FillProof proof = prove_fill(mesh, topology, patches, {}, 1);
  return {mesh, std::move(topology), std::move(patches), std::move(proof)};
}

// The parameter of a mesh edge that parameter t of a patch's edge is, and back from the face: sides 0 … 3 are v = 0, u = 1,
// v = 1, u = 0, the last two run backwards.
Rational on_mesh_edge(const EdgeUse& use, const Rational& t) {
  return use.side < 2 ? Rational(use.from + (use.to - use.from) * t) : Rational(use.to + (use.from - use.to) * t);
}
const EdgeUse& use_of(const Proven& p, int face, EdgeName edge, int mesh_edge) {
  for (const int index : p.topology.uses_of_face[face]) {
    const EdgeUse& use = p.topology.uses[index];
    if (edge_of_side(use.side) == edge && use.edge == mesh_edge) return use;
  }
  throw std::out_of_range("no such side");
}
Point3 at(const Patch& patch, EdgeName edge, const Rational& t) {
  switch (edge) {
    case EdgeName::u_min: return evaluate(patch, Rational(0), t);
    case EdgeName::u_max: return evaluate(patch, Rational(1), t);
    case EdgeName::v_min: return evaluate(patch, t, Rational(0));
    default: return evaluate(patch, t, Rational(1));
  }
}

void expect_law1(const Proven& p) {
  std::vector<std::vector<std::pair<Rational, Rational>>> pieces(p.mesh.edges.size());
  ASSERT_EQ(p.proof.joins.size(), p.proof.certificates.size());
  ASSERT_EQ(p.proof.patches.size(), p.patches.size());
  for (const MeshJoin& j : p.proof.joins) {
    const EdgeUse &a = use_of(p, j.join.patch_a, j.edge_a, j.edge), &b = use_of(p, j.join.patch_b, j.edge_b, j.edge);
    EXPECT_TRUE(a.is_left() && !b.is_left());
    const std::vector<Rational>&of_a = j.join.pairing.a, &of_b = j.join.pairing.b;
    ASSERT_EQ(of_a.size(), 2u);
    ASSERT_EQ(of_b.size(), 2u);
    EXPECT_LT(of_a[0], of_a[1]);
    for (const int k :
         {0, 1, 2, 3}) {  // paired parameters are one place of the mesh edge, and one point of both patches
      const Rational ta = ((3 - k) * of_a[0] + k * of_a[1]) / 3, tb = ((3 - k) * of_b[0] + k * of_b[1]) / 3;
      EXPECT_EQ(on_mesh_edge(a, ta), on_mesh_edge(b, tb));
      EXPECT_EQ(at(p.patches[j.join.patch_a], j.edge_a, ta), at(p.patches[j.join.patch_b], j.edge_b, tb));
      EXPECT_EQ(at(p.patches[j.join.patch_a], j.edge_a, ta),
                edge_point(p.topology.curves[j.edge], on_mesh_edge(a, ta)));
    }
    const Rational first = on_mesh_edge(a, of_a[0]), last = on_mesh_edge(a, of_a[1]);
    const Rational &low = std::min(first, last), &high = std::max(first, last);
    pieces[j.edge].push_back({low, high});
    const bool whole = low == a.begin() && high == a.end() && low == b.begin() && high == b.end();
    EXPECT_EQ(j.join.kind, whole ? JoinKind::isoparametric : JoinKind::t_junction);
  }
  for (std::size_t e = 0; e < pieces.size(); ++e) {
    std::sort(pieces[e].begin(), pieces[e].end());
    if (p.topology.kinds[e] == EdgeKind::boundary) {
      EXPECT_TRUE(pieces[e].empty());
      continue;
    }
    Rational covered(0);
    for (const auto& [low, high] : pieces[e]) {
      EXPECT_EQ(low, covered);
      EXPECT_LT(low, high);
      covered = high;
    }
    EXPECT_EQ(covered, 1);
  }
}

void expect_law2(const Proven& p) {
  for (std::size_t i = 0; i < p.proof.joins.size(); ++i) {
    const Certificate& c = p.proof.certificates[i];
    EXPECT_EQ(c.c0.verdict, Verdict::proven) << c.c0.reason;
    EXPECT_EQ(c.gap.upper, 0);
    if (p.topology.kinds[p.proof.joins[i].edge] == EdgeKind::smooth) {
      EXPECT_EQ(c.g1.verdict, Verdict::proven) << c.g1.reason;
      EXPECT_EQ(c.angle.upper, 0);
      EXPECT_EQ(c.orientation, Orientation::smooth);
    } else {
      EXPECT_EQ(c.g1.verdict, Verdict::refuted);
      EXPECT_GT(c.angle.lower, 0);
    }
  }
  for (const GregoryProof& patch : p.proof.patches) EXPECT_TRUE(patch.is_c1());
}

TEST(ProveFill, TheSidesOfAFace) {
  EXPECT_EQ(edge_of_side(0), EdgeName::v_min);
  EXPECT_EQ(edge_of_side(1), EdgeName::u_max);
  EXPECT_EQ(edge_of_side(2), EdgeName::v_max);
  EXPECT_EQ(edge_of_side(3), EdgeName::u_min);
}

TEST(ProveFill, Law1And2_WholeEdgesAndTJunctions) {
  for (const GraphMesh& g : {two_columns(),
                             two_columns({.inner = {"1/4"_q, "1/2"_q, "1/2"_q},
                             .w0 = 2,
                             .to_left = {"1/5"_q, "1/2"_q},
                             .to_right = {"1/2"_q, "2/3"_q}}),
                             two_columns({.to_right = {"1/7"_q, "1/3"_q, "9/10"_q}})}) {
    const Proven p = proven(g.mesh);
    expect_law1(p);
    expect_law2(p);
  }
  // Between the columns: gaps of {1/5, 1/2} and {1/2, 2/3} overlap in four pieces.
  const Proven p = proven(two_columns({.to_left = {"1/5"_q, "1/2"_q}, .to_right = {"1/2"_q, "2/3"_q}}).mesh);
  EXPECT_EQ(std::count_if(p.proof.joins.begin(), p.proof.joins.end(), [](const MeshJoin& j) { return j.edge == 0; }),
            4);
}

// Whichever side of its face an edge is.
TEST(ProveFill, Law1_TurnedFaces) {
  for (int turn = 0; turn < 4; ++turn) {
    GraphMesh g = two_columns({.to_left = {"1/3"_q}});
    for (std::size_t f = 0; f < g.mesh.faces.size(); ++f) {
      auto& sides = g.mesh.faces[f].sides;
      std::rotate(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>((turn + f) % 4), sides.end());
    }
    const Proven p = proven(g.mesh);
    expect_law1(p);
    expect_law2(p);
  }
}

TEST(ProveFill, Law2_RandomMeshes) {
  int count = 0;
  for (std::uint64_t seed = 100; seed < 103; ++seed) {
    const CurveMesh mesh = validation::two_faces(seed, seed % 2 == 1);
    const MeshTopology topology = analyse(mesh).value();
    if (!fill_faces<Rational>(mesh, topology)) continue;  // the basis runs along the edge
    ++count;
    const Proven p = proven(mesh);
    expect_law1(p);
    expect_law2(p);
  }
  EXPECT_GT(count, 1);
}

TEST(ProveFill, Law2_SharpEdgesAreRefuted) {
  GraphMesh g = two_columns();
  g.mesh.edges[1].points[1][2] += Rational(1, 1000);
  const Proven p = proven(g.mesh);
  ASSERT_EQ(p.topology.kinds[0], EdgeKind::sharp);
  expect_law1(p);
  expect_law2(p);
}

// A control point of the row next to the shared edge, out of its place by a little: the joins it acts on fail, and nothing else.
TEST(ProveFill, Law2_OneChangedControlPointBreaksItsJoin) {
  const Proven p = proven(two_columns({.to_left = {"1/3"_q}}).mesh);
  ASSERT_EQ(p.topology.kinds[0], EdgeKind::smooth);
  // Face 2 is the one to the right; edge 0 is its side 3, the U surface's row 0 is the edge and row 1 the one next to it.
  const BsplinePatch<Rational, 4>& u = p.patches[2].u_surface();
  const int n = u.count(Direction::v);
  const auto with = [&](int row, int m) {
    std::vector<Vec<Rational, 4>> net = u.net();
    net[row * n + m][2] += Rational(1, Integer(1) << 40);
    std::vector<Patch> patches = p.patches;
    patches[2] = Patch::make({u.knots(Direction::u), u.knots(Direction::v), net}, p.patches[2].v_surface()).value();
    return prove_fill(p.mesh, p.topology, patches, {}, 1);
  };
  int touched = 0;
  for (int row = 0; row < 4; ++row)
    for (int m = 1; m + 1 < n; ++m) {
      const FillProof moved = with(row, m);
      for (std::size_t i = 0; i < moved.joins.size(); ++i) {
        // The control point acts between two knots; the right face is the second of each join.
        const Join<Rational>& join = moved.joins[i].join;
        if (join.patch_b != 2) {  // the edge between the two others
          EXPECT_EQ(moved.certificates[i].g1.verdict, Verdict::proven);
          continue;
        }
        const auto [low, high] = std::minmax(join.pairing.b[0], join.pairing.b[1]);
        const KnotVector<Rational>& t = u.knots(Direction::v);
        const bool acts = low < t[m + t.degree() + 1] && t[m] < high;
        EXPECT_EQ(moved.certificates[i].c0.verdict, acts && row == 0 ? Verdict::refuted : Verdict::proven) << row << m;
        if (row > 0 || !acts) {
          EXPECT_EQ(moved.certificates[i].g1.verdict, acts && row == 1 ? Verdict::refuted : Verdict::proven)
              << row << m;
        }
        touched += acts;
      }
      for (std::size_t f = 0; f < moved.patches.size(); ++f)
        EXPECT_EQ(moved.patches[f].corners, f != 2 || row == 1 || row == 2 || (m > 1 && m + 2 < n)) << f << row << m;
    }
  EXPECT_GT(touched, 0);
}

TEST(ProveFill, Law3_AnyNumberOfThreads) {
  const CurveMesh mesh = validation::closed_mesh(1, 3, {.split_faces = 40});
  const Proven p = proven(mesh);
  expect_law1(p);
  expect_law2(p);
  for (const int jobs : {0, 2, 4}) {
    const FillProof other = prove_fill(mesh, p.topology, p.patches, {}, jobs);
    ASSERT_EQ(other.joins.size(), p.proof.joins.size());
    for (std::size_t i = 0; i < other.joins.size(); ++i) {
      EXPECT_EQ(other.joins[i].edge, p.proof.joins[i].edge);
      EXPECT_EQ(other.joins[i].join.patch_a, p.proof.joins[i].join.patch_a);
      EXPECT_EQ(other.certificates[i].g1.verdict, p.proof.certificates[i].g1.verdict);
      EXPECT_EQ(other.certificates[i].c1.verdict, p.proof.certificates[i].c1.verdict);
      EXPECT_EQ(other.certificates[i].rung, p.proof.certificates[i].rung);
    }
    for (std::size_t f = 0; f < other.patches.size(); ++f) {
      EXPECT_EQ(other.patches[f].is_c1(), p.proof.patches[f].is_c1());
      EXPECT_EQ(other.patches[f].regular.verdict, p.proof.patches[f].regular.verdict);
      EXPECT_EQ(other.patches[f].boxes, p.proof.patches[f].boxes);
    }
  }
}

TEST(ProveFill, NothingToProve) {
  const CurveMesh empty;
  const FillProof proof = prove_fill(empty, analyse(empty).value(), {});
  EXPECT_TRUE(proof.joins.empty() && proof.certificates.empty() && proof.patches.empty());
}

}  // namespace
}  // namespace patchproof::test
