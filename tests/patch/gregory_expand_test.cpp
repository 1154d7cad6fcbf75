// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gregory_expand.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "patchproof/patch/denominator.h"
#include "support/gregory_reference.h"

namespace patchproof {
namespace {

using namespace gregory_reference;

GregoryPatch<Rational> face_of(const std::string& id, const std::string& face) {
  const Json& one = find_case(id);
  const CurveMesh mesh = mesh_of(one.at("mesh"));
  const MeshTopology topology = analyse(mesh).value();
  FilledMesh<Rational> filled = fill_faces<Rational>(mesh, topology, options_of(one)).value();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].id == face) return filled.patches[f];
  throw std::out_of_range(face);
}

Rational q(int a, int b) { return Rational(a, b); }

void expect_same_surface(const GregoryPatch<Rational>& patch, const BsplinePatch<Rational, 4>& expanded) {
  for (const Rational& u : {q(0, 1), q(1, 7), q(1, 3), q(2, 5), q(3, 4), q(1, 1)})
    for (const Rational& v : {q(1, 9), q(1, 3), q(2, 5), q(1, 2), q(7, 8)}) {
      const SurfaceFrame<Rational> s = frame(patch, u, v);
      const PartialDerivatives<Rational, 3> e = rational_derivatives(expanded, u, v, 1, 1);
      ASSERT_EQ(s.point, e.at(0, 0));
      EXPECT_EQ(s.du, e.at(1, 0));
      EXPECT_EQ(s.dv, e.at(0, 1));
      if (u > 0 && u < 1) {
        EXPECT_EQ(second_derivatives(patch, u, v).duv, e.at(1, 1));
      }
    }
}

// (1), (2)
TEST(GregoryExpand, IsTheSameSurfaceInTheStatedDegrees) {
  struct Case {
    const char *id, *face;
    int degree_u, degree_v;
  };
  for (const Case& one : {Case{"A", "F1", 11, 12}, Case{"C", "F2", 12, 12}, Case{"D", "F1", 17, 18},
                          Case{"A-former", "F1", 11, 11}, Case{"T", "F1", 11, 12}}) {
    SCOPED_TRACE(one.id);
    const GregoryPatch<Rational> patch = face_of(one.id, one.face);
    const ExpandedGregory<Rational> expanded = expand(patch);
    EXPECT_EQ(expanded.surface.degree(Direction::u), one.degree_u);
    EXPECT_EQ(expanded.surface.degree(Direction::v), one.degree_v);
    expect_same_surface(patch, expanded.surface);
    for (const Direction d : {Direction::u, Direction::v}) {
      const KnotVector<Rational>& rows = d == Direction::u ? patch.v_surface().knots(d) : patch.u_surface().knots(d);
      for (const Rational& t : rows.breaks())
        if (t > 0 && t < 1) {
          EXPECT_EQ(expanded.surface.knots(d).multiplicity(t) - rows.multiplicity(t),
                    expanded.surface.degree(d) - rows.degree());
        }
    }
  }
}

// (1), (2): weights that are 1 in one span of the knots and not in the next.
TEST(GregoryExpand, BoxesHaveOneDegreeAndOneScale) {
  CurveMesh mesh = mesh_of(find_case("A").at("mesh"));
  MeshEdge& edge = *std::find_if(mesh.edges.begin(), mesh.edges.end(), [](const MeshEdge& e) { return e.id == "E6"; });
  edge.knots = {0, 0, 0, 0, q(1, 2), q(1, 2), 1, 1, 1, 1};
  edge.points = {{{6, 0, 1}}, {{6, 1, q(4, 3)}}, {{q(31, 5), 3, q(8, 5)}}, {{q(33, 5), 5, q(4, 5)}},
                 {{7, 7, 0}}, {{6, 9, -1}}};
  for (const std::vector<Rational>& weights : {std::vector<Rational>{2, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 2}}) {
    edge.weights = weights;
    const MeshTopology topology = analyse(mesh).value();
    for (const FillMethod method : {FillMethod::former, FillMethod::c1}) {
      const FilledMesh<Rational> filled = fill_faces<Rational>(mesh, topology, {NodeScale::none, method}).value();
      for (const GregoryPatch<Rational>& patch : filled.patches) expect_same_surface(patch, expand(patch).surface);
    }
  }
}

// (2): the nets that the independent program found.
TEST(GregoryExpand, HasTheReferenceNets) {
  const Json& conversion = document().at("conversion");
  const GregoryPatch<Rational> patch = face_of(conversion.at("case"), conversion.at("face"));
  const BsplinePatch<Rational, 4> ours = expand(patch).surface;
  const Json& expected = conversion.at("patch");
  for (const Direction d : {Direction::u, Direction::v}) {
    const Json& knots = expected.at(d == Direction::u ? "knots_u" : "knots_v");
    ASSERT_EQ(knots.size(), ours.knots(d).knots().size());
    for (std::size_t i = 0; i < knots.size(); ++i) EXPECT_EQ(number(knots[i]), ours.knots(d).knots()[i]);
  }
  const Json& net = expected.at("net");
  ASSERT_EQ(net.size(), static_cast<std::size_t>(ours.count(Direction::u)));
  for (int i = 0; i < ours.count(Direction::u); ++i) {
    ASSERT_EQ(net[i].size(), static_cast<std::size_t>(ours.count(Direction::v)));
    for (int j = 0; j < ours.count(Direction::v); ++j) EXPECT_EQ(point<4>(net[i][j]), ours.point(i, j));
  }
}

// (3): the 16 zero points, and positive weights elsewhere.
TEST(GregoryExpand, HasZeroPointsAtBlendedCorners) {
  const ExpandedGregory<Rational> expanded = expand(face_of("A", "F1"));
  EXPECT_EQ(expanded.zero_corners, (std::array<bool, 4>{true, true, true, true}));
  const int m = expanded.surface.count(Direction::u), n = expanded.surface.count(Direction::v);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const bool near_corner = (i < 2 || i >= m - 2) && (j < 2 || j >= n - 2);
      if (near_corner) {
        EXPECT_EQ(expanded.surface.point(i, j), (Vec<Rational, 4>{}));
      } else {
        EXPECT_GT(expanded.surface.point(i, j)[3], 0);
      }
    }
}

}  // namespace
}  // namespace patchproof
