// SPDX-License-Identifier: Apache-2.0
// The numbers of the reference meshes are in tests/validation/gregory_test.cpp; these are the laws, on others.
#include "patchproof/mesh/fill_faces.h"

#include <gtest/gtest.h>

#include "support/graph_mesh.h"
#include "validation/corpus/curve_meshes.h"

namespace patchproof::test {
namespace {

using Patch = GregoryPatch<Rational>;
using Point4 = Vec<Rational, 4>;

struct Filled {
  CurveMesh mesh;
  MeshTopology topology;
  FilledMesh<Rational> result;
};
Filled filled(const CurveMesh& mesh, const FillOptions& options = {}) {
  MeshTopology topology = analyse(mesh).value();
  FilledMesh<Rational> result = fill_faces<Rational>(mesh, topology, options, 1).value();
  return {mesh, std::move(topology), std::move(result)};
}

// Where a side of a face lies on its patch, at edge parameter t.
struct OnPatch {
  Rational u, v;
  bool along_u;
  int into;  // the face lies towards growing or falling parameter
};
OnPatch on_patch(const EdgeUse& use, const Rational& t) {
  const Rational s = (t - use.from) / (use.to - use.from);
  switch (use.side) {
    case 0: return {s, 0, true, 1};
    case 1: return {1, s, false, -1};
    case 2: return {1 - s, 1, true, -1};
    default: return {0, 1 - s, false, 1};
  }
}

std::vector<Rational> places_of(const Filled& f, const EdgeUse& use) {
  std::vector<Rational> out{use.begin(), use.end()};
  for (const int k : {1, 4, 6}) out.push_back(((7 - k) * use.begin() + k * use.end()) / 7);
  for (const Rational& t : breaks(f.topology.curves[use.edge]))
    if (use.begin() < t && t < use.end()) out.push_back(t);
  return out;
}

// (D's points − w_D C)/w: the affine derivative that a homogeneous one stands for.
Point3 affine(const Point4& d, const Point4& c) {
  Point3 out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = (d[k] - d[3] * c[k] / c[3]) / c[3];
  return out;
}

void expect_law1(const Filled& f) {
  for (std::size_t index = 0; index < f.topology.uses.size(); ++index) {
    const EdgeUse& use = f.topology.uses[index];
    const Piecewise<Rational, 4>& curve = f.topology.curves[use.edge];
    const FilledUse<Rational>& filled_use = f.result.uses[index];
    EXPECT_EQ(filled_use.connection.has_value(), f.topology.kinds[use.edge] == EdgeKind::smooth);
    for (const Rational& t : places_of(f, use)) {
      const Point4 c = value(curve, t), tangent = value(curve, t, 1), d = value(filled_use.derivative, t);
      if (const auto& connection = filled_use.connection) {  // D = ± k (a, 0) + h C′
        const Rational k = (use.is_left() ? 1 : -1) * value(connection->k, t)[0], h = value(connection->h, t)[0];
        const Point3 a = value(f.result.connections[use.edge]->basis, t);
        EXPECT_EQ(d, k * Point4({a[0], a[1], a[2], Rational(0)}) + h * tangent);
      }
      const OnPatch at = on_patch(use, t);
      const SurfaceFrame<Rational> s = frame(f.result.patches[use.face], at.u, at.v);
      EXPECT_EQ(s.point, project(c));
      const Point3 across = at.along_u ? s.dv : s.du, along = at.along_u ? s.du : s.dv;
      EXPECT_EQ(Rational(at.into) * across, affine(d, c));
      const Rational speed = use.side < 2 ? Rational(use.to - use.from) : Rational(use.from - use.to);
      EXPECT_EQ(along, speed * affine(tangent, c));
      if (t == use.begin()) {
        EXPECT_EQ(affine(d, c), use.begin_derivative);
      }
      if (t == use.end()) {
        EXPECT_EQ(affine(d, c), use.end_derivative);
      }
    }
  }
}

void expect_law2(const Filled& f) {
  for (std::size_t e = 0; e < f.mesh.edges.size(); ++e) {
    if (f.topology.kinds[e] != EdgeKind::smooth) continue;
    for (const int left : f.topology.left[e])
      for (const int right : f.topology.right[e]) {
        const EdgeUse &a = f.topology.uses[left], &b = f.topology.uses[right];
        const Rational begin = std::max(a.begin(), b.begin()), end = std::min(a.end(), b.end());
        for (int k = 0; k <= 12 && begin < end; ++k) {
          const Rational t = ((12 - k) * begin + k * end) / 12;
          const OnPatch on_a = on_patch(a, t), on_b = on_patch(b, t);
          EXPECT_TRUE(same_direction(frame(f.result.patches[a.face], on_a.u, on_a.v).normal(),
                                     frame(f.result.patches[b.face], on_b.u, on_b.v).normal()))
              << "edge " << f.mesh.edges[e].id << " at " << t;
        }
      }
  }
}

// How many frames differ between the two sides of a knot.
int kinks(const Patch& patch) {
  int out = 0;
  for (const Direction d : {Direction::u, Direction::v}) {
    const auto& surface = d == Direction::u ? patch.v_surface() : patch.u_surface();
    for (const Rational& t : surface.knots(d).breaks()) {
      if (t == 0 || t == 1) continue;
      for (const Rational& x : {Rational(0), "1/3"_q, "5/7"_q, Rational(1)}) {
        const Rational &u = d == Direction::u ? t : x, &v = d == Direction::u ? x : t;
        const auto low = frame(patch, u, v, Side::left, Side::left),
                   high = frame(patch, u, v, Side::right, Side::right);
        EXPECT_EQ(low.point, high.point);
        out += !(low.du == high.du && low.dv == high.dv);
      }
    }
  }
  return out;
}

std::vector<CurveMesh> meshes() {
  std::vector<CurveMesh> out{two_columns().mesh,
                             two_columns({.inner = {"1/4"_q, "1/2"_q, "1/2"_q},
                                          .w0 = 2,
                                          .to_left = {"1/5"_q, "1/2"_q},
                                          .to_right = {"1/2"_q, "2/3"_q}})
                                 .mesh,
                             two_columns({.w0 = 1, .w1 = 30, .to_left = {"1/7"_q}}).mesh,
                             two_columns({.inner = {"2/3"_q}, .w0 = 25, .w1 = "1/2"_q}).mesh};
  for (std::uint64_t seed = 0; seed < 4; ++seed) out.push_back(validation::two_faces(seed, seed % 2 == 1));
  return out;
}

TEST(FillFaces, Law1To3_EdgesDerivativesNormalsAndKnots) {
  bool scaled = false;
  for (const CurveMesh& mesh : meshes()) {
    scaled = !scaled;
    const MeshTopology topology = analyse(mesh).value();
    const auto made =
        fill_faces<Rational>(mesh, topology, {scaled ? NodeScale::rational : NodeScale::none, FillMethod::c1}, 1);
    if (!made) {
      EXPECT_EQ(made.error().code, ErrorCode::basis_along_edge) << made.error().text();
      continue;
    }
    const Filled f{mesh, topology, *made};
    ASSERT_EQ(f.result.patches.size(), mesh.faces.size());
    expect_law1(f);
    expect_law2(f);
    for (const Patch& patch : f.result.patches) {
      EXPECT_TRUE(corners_agree(patch));
      EXPECT_EQ(kinks(patch), 0);
      for (const auto* surface : {&patch.u_surface(), &patch.v_surface()})
        for (const Point4& p : surface->net()) EXPECT_GT(p[3], 0);
    }
  }
}

// Rows whose weights would not be positive, and that lose nothing by the multiple of the boundary that is added.
TEST(FillFaces, Law1_RowsWithTheBoundaryAdded) {
  int raised = 0;
  for (const Rational& w : {Rational(100), "1/100"_q}) {
    const Filled f = filled(two_columns({.w0 = 1, .w1 = w, .to_left = {"1/3"_q}}).mesh);
    expect_law1(f);
    expect_law2(f);
    for (std::size_t i = 0; i < f.result.uses.size(); ++i)
      for (const Rational& t : places_of(f, f.topology.uses[i]))
        raised +=
            value(f.topology.curves[f.topology.uses[i].edge], t)[3] + value(f.result.uses[i].derivative, t)[3] / 3 <= 0;
    for (const Patch& patch : f.result.patches)
      for (const auto* surface : {&patch.u_surface(), &patch.v_surface()})
        for (const Point4& p : surface->net()) EXPECT_GT(p[3], 0);
  }
  EXPECT_GT(raised, 0) << "no weight was ever in danger";
}

TEST(FillFaces, Law3_TheFormerMethodHasKinks) {
  GraphMesh g = two_columns({.inner = {"1/2"_q}, .to_left = {"1/3"_q}});
  const Point3 d = g.lifted(g.at(0, "2/3"_q), {-1, 0});
  g.mesh.control_vectors = {{0, "2/3"_q, 5 * d, -d}};
  const Filled former = filled(g.mesh, {NodeScale::none, FillMethod::former}), now = filled(g.mesh);
  int of_former = 0, of_now = 0;
  for (std::size_t i = 0; i < former.result.patches.size(); ++i) {
    of_former += kinks(former.result.patches[i]);
    of_now += kinks(now.result.patches[i]);
  }
  EXPECT_GT(of_former, 0);
  EXPECT_EQ(of_now, 0);
  expect_law1(former);
  expect_law2(former);
}

// Sharp and boundary edges: the derivatives that are given, with their lengths.
TEST(FillFaces, Law1_ControlVectorsOfSharpAndBoundaryEdges) {
  GraphMesh g = two_columns({.w0 = 2});
  g.mesh.edges[1].points[1][2] += 1;
  const Point3 left{{-1, 2, 3}}, right{{4, 1, 0}};
  g.mesh.control_vectors = {{0, "1/3"_q, left, right}, {3, "1/2"_q, {}, left}};
  const Filled f = filled(g.mesh);
  ASSERT_EQ(f.topology.kinds[0], EdgeKind::sharp);
  EXPECT_FALSE(f.result.connections[0]);
  expect_law1(f);
  for (const auto* side : {&f.topology.left[0], &f.topology.right[0]}) {
    const EdgeUse& use = f.topology.uses[side->front()];
    const OnPatch at = on_patch(use, "1/3"_q);
    const SurfaceFrame<Rational> s = frame(f.result.patches[use.face], at.u, at.v);
    EXPECT_EQ(Rational(at.into) * (at.along_u ? s.dv : s.du), use.is_left() ? left : right);
  }
}

template <class T>
void expect_agrees_with(const GregoryPatch<T>& patch, const Patch& exact, bool with_c_surface) {
  expect_agrees(patch.u_surface().net(), exact.u_surface().net());
  expect_agrees(patch.v_surface().net(), exact.v_surface().net());
  for (std::size_t i = 0; i < 4 && with_c_surface; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      expect_agrees(patch.from_u()[i][j], exact.from_u()[i][j]);
      expect_agrees(patch.from_v()[i][j], exact.from_v()[i][j]);
    }
}

TEST(FillFaces, Law4_DoubleIsWithinTheBoundOfTracked) {
  for (const CurveMesh& mesh : meshes()) {
    const MeshTopology topology = analyse(mesh).value();
    const auto exact = fill_faces<Rational>(mesh, topology, {}, 1);
    const auto tracked = fill_faces<Tracked>(mesh, topology, {}, 2);
    const auto rounded = fill_faces<double>(mesh, topology, {}, 2);
    ASSERT_EQ(exact.has_value(), tracked.has_value());
    ASSERT_EQ(exact.has_value(), rounded.has_value());
    if (!exact) continue;
    for (std::size_t i = 0; i < exact->patches.size(); ++i) {
      const GregoryPatch<Tracked>& t = tracked->patches[i];
      const GregoryPatch<double>& d = rounded->patches[i];
      expect_agrees_with(t, exact->patches[i], false);
      for (const auto& [net, bound] :
           {std::pair(d.u_surface().net(), t.u_surface().net()), std::pair(d.v_surface().net(), t.v_surface().net())}) {
        ASSERT_EQ(net.size(), bound.size());
        for (std::size_t k = 0; k < net.size(); ++k)
          for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_EQ(net[k][c], bound[k][c].value());
            EXPECT_LE(bound[k][c].error(), 1e-12 * (1 + std::fabs(net[k][c])));
          }
      }
    }
  }
}

// Knots that are doubles: then everything is, up to the points of the surface.
TEST(FillFaces, Law4_DoublePointsAreWithinTheBoundOfTracked) {
  const CurveMesh mesh =
      two_columns({.inner = {"1/4"_q, "1/2"_q, "1/2"_q}, .w0 = 2, .to_left = {"1/4"_q, "3/4"_q}, .to_right = {"1/2"_q}})
          .mesh;
  const MeshTopology topology = analyse(mesh).value();
  const auto exact = fill_faces<Rational>(mesh, topology).value();
  const auto tracked = fill_faces<Tracked>(mesh, topology).value();
  const auto rounded = fill_faces<double>(mesh, topology).value();
  int faces = 0;
  for (std::size_t i = 0; i < exact.patches.size(); ++i) {
    bool dyadic = true;
    for (const Direction d : {Direction::u, Direction::v}) {
      const auto& of = d == Direction::u ? exact.patches[i].v_surface() : exact.patches[i].u_surface();
      for (const Rational& t : of.knots(d).knots()) dyadic = dyadic && from_double(nearest_double(t)) == t;
    }
    if (!dyadic) continue;
    ++faces;
    expect_agrees_with(tracked.patches[i], exact.patches[i], true);
    for (const double u : {0.0, 0x1p-700, 0.125, 0.3, 0.5, 1.0})
      for (const double v : {0.0, 0.25, 0.7}) {
        const Vec<double, 3> point = evaluate(rounded.patches[i], u, v);
        const Vec<Tracked, 3> bound = evaluate(tracked.patches[i], u, v);
        const auto [x, y] = detail::off_the_corners(u, v);
        const Point3 truth = evaluate(exact.patches[i], from_double(x), from_double(y));
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(point[c], bound[c].value());
          expect_agrees(bound[c], truth[c]);
        }
      }
  }
  EXPECT_GE(faces, 2);
}

TEST(FillFaces, Law4_IntervalsEnclose) {
  for (const CurveMesh& mesh : meshes()) {
    const MeshTopology topology = analyse(mesh).value();
    const auto exact = fill_faces<Rational>(mesh, topology, {}, 1);
    if (!exact) continue;
    for (const int jobs : {1, 3}) {
      const auto enclosed = fill_faces<Interval>(mesh, topology, {}, jobs);
      ASSERT_TRUE(enclosed) << enclosed.error().text();
      for (std::size_t i = 0; i < exact->patches.size(); ++i) {
        expect_agrees_with(enclosed->patches[i], exact->patches[i], true);
        const RoundingGuard guard;
        expect_agrees(evaluate(enclosed->patches[i], "1/3"_q, "2/7"_q), evaluate(exact->patches[i], "1/3"_q, "2/7"_q));
      }
    }
  }
  EXPECT_EQ(1 + 0x1p-60, 1.0) << "the rounding is what it was";
}

template <class R>
void expect_same_patches(const FilledMesh<R>& a, const FilledMesh<R>& b) {
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].u_surface().net(), b.patches[i].u_surface().net());
    EXPECT_EQ(a.patches[i].v_surface().net(), b.patches[i].v_surface().net());
    EXPECT_EQ(a.patches[i].from_u(), b.patches[i].from_u());
    EXPECT_EQ(a.patches[i].from_v(), b.patches[i].from_v());
  }
}

TEST(FillFaces, Law5_AnyNumberOfThreads) {
  const CurveMesh mesh = validation::closed_mesh(1, 5, {.split_faces = 50});
  const MeshTopology topology = analyse(mesh).value();
  const auto exact = fill_faces<Rational>(mesh, topology, {}, 1).value();
  const auto rounded = fill_faces<double>(mesh, topology, {}, 1).value();
  for (const int jobs : {0, 2, 4}) {
    expect_same_patches(exact, fill_faces<Rational>(mesh, topology, {}, jobs).value());
    expect_same_patches(rounded, fill_faces<double>(mesh, topology, {}, jobs).value());
  }
  expect_law1({mesh, topology, exact});
  expect_law2({mesh, topology, exact});
}

// Of several bad edges the first is named, whoever looks at it first.
TEST(FillFaces, ErrorsAndNothingToFill) {
  CurveMesh mesh = validation::closed_mesh(2, 5, {.edges_with_control_vectors = 0, .split_faces = 0});
  for (const int e : {40, 7, 23}) mesh.control_vectors.push_back({e, "1/2"_q, Point3{{1, 2, 3}}, std::nullopt});
  const MeshTopology topology = analyse(mesh).value();
  for (const int jobs : {1, 2, 4}) {
    const auto made = fill_faces<Rational>(mesh, topology, {}, jobs);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::control_vector_missing);
    EXPECT_NE(made.error().where.find("edge " + mesh.edges[7].id + ","), std::string::npos) << made.error().text();
  }
  const CurveMesh empty;
  EXPECT_TRUE(fill_faces<Rational>(empty, analyse(empty).value()).value().patches.empty());
}

}  // namespace
}  // namespace patchproof::test
