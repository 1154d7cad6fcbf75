// SPDX-License-Identifier: Apache-2.0
// Gregory patches against validation/vectors/gregory.json: every intermediate field, control point, value, derivative, twist
// and jump of the reference cases exactly, and every bad mesh refused for its reason.
#include <gtest/gtest.h>

#include "support/gregory_reference.h"

namespace patchproof {
namespace {

using namespace gregory_reference;

template <std::size_t N>
void expect_pieces(const Json& expected, const Piecewise<Rational, N>& f) {
  ASSERT_EQ(expected.at("segments").size(), f.size());
  EXPECT_EQ(expected.at("degree"), f.front().degree());
  for (std::size_t i = 0; i < f.size(); ++i) {
    EXPECT_EQ(number(expected.at("breaks").at(i)), f[i].begin);
    EXPECT_EQ(number(expected.at("breaks").at(i + 1)), f[i].end);
    for (std::size_t j = 0; j < f[i].points.size(); ++j)
      EXPECT_EQ(point<N>(expected.at("segments").at(i).at(j)), f[i].points[j]);
  }
}

void expect_surface(const Json& expected, const BsplinePatch<Rational, 4>& surface, Direction along) {
  const Json& knots = expected.at(along == Direction::v ? "knots_v" : "knots_u");
  const KnotVector<Rational>& ours = surface.knots(along);
  ASSERT_EQ(knots.size(), ours.knots().size());
  for (std::size_t i = 0; i < knots.size(); ++i) EXPECT_EQ(number(knots[i]), ours[static_cast<int>(i)]);
  const Json& points = expected.at("points");
  for (int row = 0; row < 4; ++row) {
    // U is stored with i outside, V with j (rows) outside or as [i][j]; both have the rows' points along the knots.
    for (int m = 0; m < ours.control_count(); ++m) {
      const Json& p = along == Direction::v ? points.at(row).at(m) : points.at(m).at(row);
      EXPECT_EQ(point<4>(p), along == Direction::v ? surface.point(row, m) : surface.point(m, row));
    }
  }
}

void expect_face(const Json& expected, const GregoryPatch<Rational>& patch) {
  expect_surface(expected.at("U"), patch.u_surface(), Direction::v);
  expect_surface(expected.at("V"), patch.v_surface(), Direction::u);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(point<4>(expected.at("Q0").at(i).at(j)), patch.from_u()[i][j]);
      EXPECT_EQ(point<4>(expected.at("Q1").at(i).at(j)), patch.from_v()[i][j]);
    }
  for (const Json& sample : expected.at("samples")) {
    const Rational u = number(sample.at("u")), v = number(sample.at("v"));
    const SurfaceFrame<Rational> s = frame(patch, u, v);
    EXPECT_EQ(point<3>(sample.at("S")), s.point);
    EXPECT_EQ(point<3>(sample.at("S")), evaluate(patch, u, v));
    EXPECT_EQ(point<3>(sample.at("Su")), s.du);
    EXPECT_EQ(point<3>(sample.at("Sv")), s.dv);
    EXPECT_EQ(point<3>(sample.at("N")), s.normal());
  }
  for (const Json& part : expected.at("parts")) {
    const Rational u = number(part.at("u")), v = number(part.at("v"));
    EXPECT_EQ(point<3>(part.at("Su_value")), evaluate_rational(patch.u_surface(), u, v));
    EXPECT_EQ(point<3>(part.at("Sv_value")), evaluate_rational(patch.v_surface(), u, v));
    EXPECT_EQ(point<3>(part.at("Sc_value")), project(evaluate_c_surface<Rational>(patch, u, v)));
  }
  for (const Json& second : expected.at("second")) {
    const auto s = second_derivatives(patch, number(second.at("u")), number(second.at("v")));
    EXPECT_EQ(point<3>(second.at("Suu")), s.duu);
    EXPECT_EQ(point<3>(second.at("Suv")), s.duv);
    EXPECT_EQ(point<3>(second.at("Svv")), s.dvv);
  }
  const std::array<TwoTwists<Rational>, 4> twists = corner_twists(patch);
  const char* corners[] = {"0,0", "1,0", "1,1", "0,1"};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(point<3>(expected.at("twists").at(corners[k]).at(0)), twists[k].from_u);
    EXPECT_EQ(point<3>(expected.at("twists").at(corners[k]).at(1)), twists[k].from_v);
  }
  for (const Direction along : {Direction::v, Direction::u}) {
    const BsplinePatch<Rational, 4>& surface = along == Direction::v ? patch.u_surface() : patch.v_surface();
    for (const Json& jump : expected.at("knot_jumps").at(along == Direction::v ? "U" : "V")) {
      const Rational t = number(jump.at(0));
      for (int row = 0; row < 4; ++row) {
        std::vector<Vec<Rational, 4>> points;
        for (int m = 0; m < surface.count(along); ++m)
          points.push_back(along == Direction::v ? surface.point(row, m) : surface.point(m, row));
        const BsplineCurve<Rational, 4> curve(surface.knots(along), points);
        EXPECT_EQ(point<4>(jump.at(1).at(row)),
                  derivative(curve, t, 1, Side::right) - derivative(curve, t, 1, Side::left));
      }
    }
  }
  EXPECT_TRUE(corners_agree(patch));
}

class GregoryReference : public testing::TestWithParam<std::size_t> {};

TEST_P(GregoryReference, EveryNumberIsEqual) {
  const Json& one = document().at("cases").at(GetParam());
  SCOPED_TRACE("case " + one.at("id").get<std::string>());
  const CurveMesh mesh = mesh_of(one.at("mesh"));
  const Result<MeshTopology> topology = analyse(mesh);
  ASSERT_TRUE(topology) << topology.error().text();
  const Result<FilledMesh<Rational>> filled = fill_faces<Rational>(mesh, *topology, options_of(one));
  ASSERT_TRUE(filled) << filled.error().text();
  const Json& edges = one.at("expected").at("edges");
  ASSERT_EQ(edges.size(), mesh.edges.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const Json& expected = edges.at(mesh.edges[e].id);
    SCOPED_TRACE("edge " + mesh.edges[e].id);
    EXPECT_EQ(expected.at("kind"), to_string(topology->kinds[e]));
    ASSERT_EQ(expected.contains("a"), filled->connections[e].has_value());
    if (filled->connections[e]) {
      const EdgeConnection& connection = *filled->connections[e];
      ASSERT_EQ(expected.at("nodes").size(), connection.places.size());
      for (std::size_t k = 0; k < connection.places.size(); ++k) {
        EXPECT_EQ(number(expected.at("nodes").at(k).at(0)), connection.places[k]);
        EXPECT_EQ(point<3>(expected.at("nodes").at(k).at(1)), connection.vectors[k]);
      }
      expect_pieces(expected.at("a"), connection.basis);
    }
    std::size_t uses = 0;
    for (const std::vector<int>* side : {&topology->left[e], &topology->right[e]})
      for (const int index : *side) {
        const EdgeUse& use = topology->uses[index];
        const Json* found = nullptr;
        for (const Json& candidate : expected.at("uses"))
          if (candidate.at("face") == mesh.faces[use.face].id && candidate.at("side") == use.side) found = &candidate;
        ASSERT_NE(found, nullptr);
        ++uses;
        EXPECT_EQ(found->at("sign"), use.is_left() ? 1 : -1);
        EXPECT_EQ(number(found->at("lo")), use.begin());
        EXPECT_EQ(number(found->at("hi")), use.end());
        EXPECT_EQ(point<3>(found->at("b_lo")), use.begin_derivative);
        EXPECT_EQ(point<3>(found->at("b_hi")), use.end_derivative);
        const FilledUse<Rational>& of_use = filled->uses[index];
        ASSERT_EQ(found->at("k").is_null(), !of_use.connection);
        if (of_use.connection) {
          expect_pieces(found->at("k"), of_use.connection->k);
          expect_pieces(found->at("h"), of_use.connection->h);
        }
        expect_pieces(found->at("D"), of_use.derivative);
      }
    EXPECT_EQ(uses, expected.at("uses").size());
  }
  const Json& faces = one.at("expected").at("faces");
  ASSERT_EQ(faces.size(), mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    SCOPED_TRACE("face " + mesh.faces[f].id);
    expect_face(faces.at(mesh.faces[f].id), filled->patches[f]);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, GregoryReference, testing::Range(std::size_t{0}, std::size_t{14}),
                         [](const testing::TestParamInfo<std::size_t>& info) {
                           std::string name = document().at("cases").at(info.param).at("id");
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(GregoryReferenceFile, HasAllCases) { EXPECT_EQ(document().at("cases").size(), 14u); }

TEST(GregoryReferenceFile, BadMeshesAreRefusedForTheirReason) {
  const std::map<std::string, std::vector<ErrorCode>> codes{
      {"E_DEGREE", {ErrorCode::bad_degree}},
      {"E_COUNT", {ErrorCode::wrong_count}},
      {"E_KNOTS", {ErrorCode::decreasing_knots, ErrorCode::bad_multiplicity, ErrorCode::empty_domain}},
      {"E_WEIGHT", {ErrorCode::bad_weight}},
      {"E_NOT_C1", {ErrorCode::not_c1}},
      {"E_CUSP", {ErrorCode::vanishing_tangent}},
      {"E_REF", {ErrorCode::bad_reference}},
      {"E_GAP", {ErrorCode::ends_apart}},
      {"E_TNODE", {ErrorCode::bad_t_node}},
      {"E_SIDES", {ErrorCode::wrong_side_count}},
      {"E_SIDE", {ErrorCode::bad_side}},
      {"E_SIDE_END", {ErrorCode::side_ends_nowhere}},
      {"E_LOOP", {ErrorCode::open_loop}},
      {"E_COVER", {ErrorCode::uneven_cover}},
      {"E_UNUSED", {ErrorCode::unused_edge}},
      {"E_CORNER", {ErrorCode::parallel_tangents}},
      {"E_CV_RANGE", {ErrorCode::control_vector_outside}},
      {"E_CV_DUP", {ErrorCode::control_vector_twice}},
      {"E_CV_PAIR", {ErrorCode::control_vector_missing}},
      {"E_CV_PARALLEL", {ErrorCode::control_vectors_bent}},
      {"E_CV_TANGENT", {ErrorCode::control_vector_along}},
      {"E_CV_TNODE", {ErrorCode::control_vector_differs}},
      {"E_BASIS_TANGENT", {ErrorCode::basis_along_edge}},
  };
  const Json& bad = document().at("bad_meshes");
  ASSERT_EQ(bad.size(), 23u);
  for (const Json& one : bad) {
    const std::string code = one.at("code");
    SCOPED_TRACE(code);
    const CurveMesh mesh = mesh_of(one.at("mesh"));
    const Result<MeshTopology> topology = analyse(mesh);
    Error error{ErrorCode::usage, "", "", ""};
    if (!topology) {
      error = topology.error();
    } else {
      const Result<FilledMesh<Rational>> filled = fill_faces<Rational>(mesh, *topology);
      ASSERT_FALSE(filled);
      error = filled.error();
    }
    const std::vector<ErrorCode>& expected = codes.at(code);
    EXPECT_NE(std::find(expected.begin(), expected.end(), error.code), expected.end()) << error.text();
    EXPECT_FALSE(error.where.empty());
    EXPECT_FALSE(error.message.empty());
    RecordProperty(code, error.text());
  }
}

}  // namespace
}  // namespace patchproof
