// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/bspline_patch.h"

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "patchproof/scalar/parse_scalar.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

template <class T>
class BsplinePatchLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(BsplinePatchLaws, AllScalars, ScalarNames);

// A patch with repeated inner knots, one full knot, unclamped in v, not beginning at 0. All knots are doubles.
BsplinePatch<Rational, 3> rich_patch() {
  RandomRationals random(7);
  const Rational quarter = Rational(1) / Rational(4);
  return {make_knots<Rational>(2, {1, 1, 1, 2, 2, 2, 5 * quarter + 2, 4, 4, 4}),
          make_knots<Rational>(3, {-3, -2, -2, -1, 0, 0, quarter, 1, 3, 4, 5}), random.points<3>(7 * 7)};
}

std::vector<Rational> places(const KnotVector<Rational>& knots) {
  std::vector<Rational> out = knots.breaks();
  for (std::size_t i = out.size() - 1; i > 0; --i) out.push_back((out[i] + 3 * out[i - 1]) / 4);
  return out;
}

TYPED_TEST(BsplinePatchLaws, Law1_EvaluateIsTheDoubleSum) {
  const auto exact = rich_patch();
  for (const Rational& u : places(exact.knots(Direction::u)))
    for (const Rational& v : places(exact.knots(Direction::v)))
      check<TypeParam>(derivative_by_definition(exact, u, v, 0, 0),
                       [&]<class S>() { return evaluate(make_patch<S>(exact), make_knot<S>(u), make_knot<S>(v)); });
}

TYPED_TEST(BsplinePatchLaws, Law2_DerivativesOfEveryOrder) {
  const auto exact = rich_patch();
  const Rational u = Rational(5) / Rational(2), v = Rational(1) / Rational(8);
  for (int k = 0; k <= 3; ++k)
    for (int l = 0; l <= 4; ++l)
      check<TypeParam>(derivative_by_definition(exact, u, v, k, l), [&]<class S>() {
        return partial_derivatives(make_patch<S>(exact), make_knot<S>(u), make_knot<S>(v), 3, 4).at(k, l);
      });
}

TEST(BsplinePatch, Law2_BeyondTheDegreeDerivativesVanish) {
  const auto table = partial_derivatives(rich_patch(), Rational(3), Rational(1), 3, 4);
  EXPECT_EQ(table.order_u(), 3);
  EXPECT_EQ(table.order_v(), 4);
  for (int l = 0; l <= 4; ++l) EXPECT_TRUE(table.at(3, l) == (Vec<Rational, 3>{}));
  for (int k = 0; k <= 3; ++k) EXPECT_TRUE(table.at(k, 4) == (Vec<Rational, 3>{}));
  EXPECT_FALSE(table.at(2, 3) == (Vec<Rational, 3>{}));
}

TYPED_TEST(BsplinePatchLaws, Law3_SwappingDirectionsTransposes) {
  const auto exact = rich_patch();
  const Rational u = Rational(7) / Rational(4), v = Rational(1) / Rational(2);
  const auto swapped = swap_directions(make_patch<TypeParam>(exact));
  EXPECT_EQ(swapped.degree(Direction::u), 3);
  EXPECT_EQ(swapped.count(Direction::v), 7);
  for (int k = 0; k <= 2; ++k)
    for (int l = 0; l <= 2; ++l)
      check<TypeParam>(derivative_by_definition(exact, u, v, k, l), [&]<class S>() {
        return partial_derivatives(swap_directions(make_patch<S>(exact)), make_knot<S>(v), make_knot<S>(u), 2, 2)
            .at(l, k);
      });
  EXPECT_EQ(swap_directions(swap_directions(exact)).net(), exact.net());
}

TEST(BsplinePatch, Law4_SidesAndEnds) {
  const auto s = rich_patch();
  const ParameterBox<Rational> d = s.domain();
  EXPECT_TRUE(d == (ParameterBox<Rational>{1, 4, -1, 1}));
  // Clamped in u: the ends of each v-line are the splines of the outer rows.
  for (const Side side : {Side::left, Side::right}) {
    EXPECT_TRUE(evaluate(s, d.u_begin, d.v_end, side, side) == derivative_by_definition(s, d.u_begin, d.v_end, 0, 0));
    EXPECT_TRUE(evaluate(s, d.u_end, d.v_begin, side, side) == derivative_by_definition(s, d.u_end, d.v_begin, 0, 0));
  }
  // u = 2 has multiplicity degree + 1: the surface jumps. v = 0 has multiplicity 2 < 3: S and S_v agree, S_vv does not.
  const Rational u = 2, v = 0, inner = Rational(1) / Rational(3);
  EXPECT_FALSE(evaluate(s, u, v, Side::left) == evaluate(s, u, v, Side::right));
  EXPECT_TRUE(evaluate(s, u, v, Side::left) == derivative_by_definition(s, u, v, 0, 0, Side::left));
  const auto left = partial_derivatives(s, 1 + inner, v, 1, 2, Side::right, Side::left);
  const auto right = partial_derivatives(s, 1 + inner, v, 1, 2, Side::right, Side::right);
  EXPECT_TRUE(left.at(1, 1) == right.at(1, 1));
  EXPECT_FALSE(left.at(0, 2) == right.at(0, 2));
  EXPECT_THROW(evaluate(s, Rational(5), v), contract_error);
  EXPECT_THROW(evaluate(s, u, Rational(3) / Rational(2)), contract_error);
}

TEST(BsplinePatch, Law4_DeadControlPointsBeyondFullMultiplicity) {
  RandomRationals random;
  const auto knots = make_knots<Rational>(1, {0, 0, 1, 1, 1, 2, 2});  // multiplicity degree + 2 at 1
  auto net = random.points<3>(5 * 2);
  const KnotVector<Rational> line = KnotVector<Rational>::bezier(1);
  const BsplinePatch<Rational, 3> s(knots, line, net);
  for (int j = 0; j < 2; ++j) net[2 * 2 + j] = random.point<3>();
  const BsplinePatch<Rational, 3> other(knots, line, net);
  expect_same_surface(s, other);
  EXPECT_TRUE(evaluate(s, Rational(1), Rational(0), Side::left) == s.point(1, 0));
  EXPECT_TRUE(evaluate(s, Rational(1), Rational(0), Side::right) == s.point(3, 0));
}

TEST(BsplinePatch, Law5_ParametersOfAnotherScalar) {
  const auto exact = rich_patch();
  const Rational u = Rational(10) / Rational(3), v = Rational(1) / Rational(7);
  const int span_u = exact.knots(Direction::u).find_span(u), span_v = exact.knots(Direction::v).find_span(v);
  const auto truth = derivative_by_definition(exact, u, v, 1, 1);
  {
    RoundingGuard guard;
    expect_agrees(partial_derivatives_in_span<Interval>(exact, span_u, span_v, enclose(u), enclose(v), 1, 1).at(1, 1),
                  truth);
    // A parameter box: the enclosure holds the surface at every parameter of the box.
    const Interval box_u(3.25, 3.5), box_v(0.0, 0.25);
    const Vec<Interval, 3> hull =
        evaluate_in_span<Interval>(exact, span_u, exact.knots(Direction::v).find_span(0), box_u, box_v);
    for (const Rational& s : spread(Rational(13) / 4, Rational(7) / 2, 3))
      for (const Rational& t : spread(Rational(0), Rational(1) / 4, 3)) {
        const auto point = derivative_by_definition(exact, s, t, 0, 0, Side::right, Side::left);
        const auto on_piece = evaluate_in_span<Rational>(exact, span_u, exact.knots(Direction::v).find_span(0), s, t);
        for (int c = 0; c < 3; ++c) {
          EXPECT_LE(from_double(hull[c].inf()), on_piece[c]);
          EXPECT_GE(from_double(hull[c].sup()), on_piece[c]);
        }
        if (t > 0) {
          EXPECT_TRUE(on_piece == point);
        }
      }
  }
  expect_agrees(evaluate_in_span<Ball>(exact, span_u, span_v, Ball(u), Ball(v)),
                derivative_by_definition(exact, u, v, 0, 0));
  expect_agrees(evaluate_in_span<Tracked>(exact, span_u, span_v, make<Tracked>(u), make<Tracked>(v)),
                derivative_by_definition(exact, u, v, 0, 0));
}

TYPED_TEST(BsplinePatchLaws, Law6_CornerTwists) {
  const auto exact = rich_patch();
  const auto d = exact.domain();
  const std::vector<Vec<Rational, 3>> truth{derivative_by_definition(exact, d.u_begin, d.v_begin, 1, 1),
                                            derivative_by_definition(exact, d.u_end, d.v_begin, 1, 1),
                                            derivative_by_definition(exact, d.u_begin, d.v_end, 1, 1),
                                            derivative_by_definition(exact, d.u_end, d.v_end, 1, 1)};
  check<TypeParam>(truth, [&]<class S>() {
    const auto twists = corner_twists(make_patch<S>(exact));
    return std::vector<Vec<S, 3>>(twists.begin(), twists.end());
  });
}

TEST(BsplinePatch, MakeRefusesAWrongCount) {
  const auto knots = KnotVector<Rational>::bezier(1);
  const auto made = BsplinePatch<Rational, 3>::make(knots, knots, std::vector<Vec<Rational, 3>>(3));
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code, ErrorCode::wrong_count);
  EXPECT_EQ(made.error().values, "3");
  EXPECT_THROW((BsplinePatch<Rational, 3>(knots, knots, std::vector<Vec<Rational, 3>>(5))), contract_error);
}

TEST(BsplinePatch, MapPointsMayChangeTheDimension) {
  const auto s = rich_patch();
  const auto heights = map_points(s, [](const Vec<Rational, 3>& p) { return Vec<Rational, 1>{{p[2]}}; });
  const Rational u = 3, v = Rational(1) / Rational(5);
  EXPECT_EQ(evaluate(heights, u, v)[0], evaluate(s, u, v)[2]);
}

// Large offsets and extreme scales are no special case of exact arithmetic.
TEST(BsplinePatch, OffsetsAndScalesAreExact) {
  const auto s = rich_patch();
  const Rational u = Rational(11) / Rational(4), v = Rational(2) / Rational(3);
  const Vec<Rational, 3> offset{{1000000, -1000000, 1000000}};
  for (const Rational& scale : {Rational(1 << 20), 1 / Rational(1 << 20)}) {
    const auto moved = map_points(s, [&](const Vec<Rational, 3>& p) { return scale * p + offset; });
    EXPECT_TRUE(evaluate(moved, u, v) == scale * evaluate(s, u, v) + offset);
    EXPECT_TRUE(partial_derivatives(moved, u, v, 1, 1).at(1, 1) == scale * partial_derivatives(s, u, v, 1, 1).at(1, 1));
  }
}

// The printed figures of another program: a bicubic surface, points and derivatives cut to 3 decimals.
TEST(BsplinePatch, ReferenceTable) {
  const auto file =
      std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "../shared/data/eval_tables/geomdl_test_surface.json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the reference data " << file << " is not here";
  const auto json = nlohmann::json::parse(std::ifstream(file));
  const auto number = [](const nlohmann::json& x) { return parse_scalar<Rational>(x.dump()).value(); };
  const auto numbers = [&](const nlohmann::json& list) {
    std::vector<Rational> out;
    for (const auto& x : list) out.push_back(number(x));
    return out;
  };
  const auto& surface = json.at("surface");
  std::vector<Vec<Rational, 3>> net;
  for (const auto& p : surface.at("control_points")) net.push_back({{number(p[0]), number(p[1]), number(p[2])}});
  const BsplinePatch<Rational, 3> s(make_knots<Rational>(3, numbers(surface.at("knots_u"))),
                                    make_knots<Rational>(3, numbers(surface.at("knots_v"))), net);
  int compared = 0;
  for (const auto& row : json.at("points")) {
    const auto at = numbers(row[0]), expected = numbers(row[1]);
    const auto point = evaluate(s, at[0], at[1]);
    for (int c = 0; c < 3; ++c, ++compared) EXPECT_LT(abs(Rational(point[c] - expected[c])), Rational(1) / 1000);
  }
  EXPECT_GE(compared, 24);
}

}  // namespace
}  // namespace patchproof
