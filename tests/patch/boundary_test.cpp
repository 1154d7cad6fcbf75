// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/boundary.h"

#include "patchproof/spline/bernstein.h"
#include "support/curves.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

constexpr EdgeName kEdges[] = {EdgeName::u_min, EdgeName::u_max, EdgeName::v_min, EdgeName::v_max};

template <class T>
class BoundaryLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(BoundaryLaws, BoundedScalars, ScalarNames);

// rows[k](t) of the line against the k-th derivative multiplied out of the definition, times (−1)^k on the left side.
template <class T, std::size_t N>
void expect_rows(const BsplinePatch<Rational, N>& patch, const IsoLine<Rational>& line, int order) {
  const IsoLine<knot_scalar_t<T>> same{line.constant, make_knot<T>(line.value), line.side};
  const auto rows = cross_boundary_rows(make_patch<T>(patch), same, order);
  ASSERT_EQ(static_cast<int>(rows.size()), order + 1);
  const KnotVector<Rational>& along = patch.knots(other(line.constant));
  for (int k = 0; k <= order; ++k) {
    const Rational sign(line.side == Side::left && k % 2 == 1 ? -1 : 1);
    for (const Rational& t : spread(along.domain_begin(), along.domain_end(), 4)) {
      const auto exact = line.constant == Direction::u
                             ? derivative_by_definition(patch, line.value, t, k, 0, line.side, Side::right)
                             : derivative_by_definition(patch, t, line.value, 0, k, Side::right, line.side);
      expect_agrees(evaluate(rows[k], make_knot<T>(t)), sign * exact);
    }
  }
}

TYPED_TEST(BoundaryLaws, Law1_EdgesAndInnerLines) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 3; ++round) {
    const auto patch = random_patch<3>(random, 1 + round, 4 + round, 3 - round, 5);
    for (const EdgeName edge : kEdges) {
      SCOPED_TRACE(to_string(edge));
      expect_rows<T>(patch, edge_line(patch, edge), 4);  // beyond the degree, too: zeros
    }
    // Every line at an inner knot, whatever its multiplicity, from both sides.
    for (const Direction d : {Direction::u, Direction::v}) {
      const auto breaks = patch.knots(d).breaks();
      for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
        for (const Side side : {Side::left, Side::right})
          expect_rows<T>(patch, IsoLine<Rational>{d, breaks[i], side}, 2);
    }
  }
}

TEST(BoundaryLawsExact, Law1_PointsIntoThePatch) {
  // S = (u, v, 0) on [2, 5] × [−1, 1]: inward means away from the edge, and the edges run along growing parameters.
  std::vector<Vec<Rational, 3>> net;
  for (const int u : {2, 5})
    for (const int v : {-1, 1}) net.push_back({{Rational(u), Rational(v), Rational(0)}});
  const BsplinePatch<Rational, 3> plane(make_knots<Rational>(1, {2, 2, 5, 5}), make_knots<Rational>(1, {-1, -1, 1, 1}),
                                        net);
  const auto inward = [&](EdgeName e) { return cross_boundary_rows(plane, edge_line(plane, e), 1)[1].points()[0]; };
  EXPECT_EQ(inward(EdgeName::u_min), (Vec<Rational, 3>{{Rational(1), Rational(0), Rational(0)}}));
  EXPECT_EQ(inward(EdgeName::u_max), (Vec<Rational, 3>{{Rational(-1), Rational(0), Rational(0)}}));
  EXPECT_EQ(inward(EdgeName::v_min), (Vec<Rational, 3>{{Rational(0), Rational(1), Rational(0)}}));
  EXPECT_EQ(inward(EdgeName::v_max), (Vec<Rational, 3>{{Rational(0), Rational(-1), Rational(0)}}));
  const auto line = cross_boundary_rows(plane, edge_line(plane, EdgeName::u_max), 0)[0];
  EXPECT_EQ(line.points().front(), (Vec<Rational, 3>{{Rational(5), Rational(-1), Rational(0)}}));
  EXPECT_EQ(line.points().back(), (Vec<Rational, 3>{{Rational(5), Rational(1), Rational(0)}}));
  EXPECT_STREQ(to_string(EdgeName::u_min), "u_min");
  EXPECT_STREQ(to_string(EdgeName::v_max), "v_max");
}

TEST(BoundaryLawsExact, Law1_TwoSidesOfAJump) {
  // Multiplicity p + 1: another surface on each side of the line.
  RandomRationals random;
  const BsplinePatch<Rational, 3> patch(make_knots<Rational>(2, {0, 0, 0, 1, 1, 1, 2, 2, 2}),
                                        KnotVector<Rational>::bezier(3), random.points<3>(24));
  for (const Side side : {Side::left, Side::right})
    expect_rows<Rational>(patch, IsoLine<Rational>{Direction::u, 1, side}, 2);
  const auto left = cross_boundary_rows(patch, IsoLine<Rational>{Direction::u, 1, Side::left}, 0)[0];
  const auto right = cross_boundary_rows(patch, IsoLine<Rational>{Direction::u, 1, Side::right}, 0)[0];
  EXPECT_NE(left.points(), right.points());
}

TEST(BoundaryLawsExact, BrokenContracts) {
  RandomRationals random;
  const BsplinePatch<Rational, 3> patch(KnotVector<Rational>::bezier(2), KnotVector<Rational>::bezier(2),
                                        random.points<3>(9));
  const auto rows = [&](const Rational& at, Side side) {
    return cross_boundary_rows(patch, IsoLine<Rational>{Direction::u, at, side}, 1);
  };
  EXPECT_THROW(rows(2, Side::left), contract_error);
  EXPECT_THROW(rows(0, Side::left), contract_error);
  EXPECT_THROW(rows(1, Side::right), contract_error);
  EXPECT_NO_THROW(rows(0, Side::right));
  const auto curve = awkward_curves(random)[3].curve;  // breaks 0, 1, 3, 4
  EXPECT_THROW(bezier_coefficients(curve, Rational(0), Rational(2)), contract_error);
  EXPECT_THROW(bezier_coefficients(curve, Rational(1), Rational(1)), contract_error);
}

TYPED_TEST(BoundaryLaws, Law2_BezierCoefficients) {
  using T = TypeParam;
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const auto same = make_curve<T>(curve);
    const auto breaks = curve.knots().breaks();
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for (const auto& [from, to] : std::vector<std::pair<int, int>>{{0, 4}, {0, 1}, {3, 4}, {1, 2}}) {
        const Rational h = (breaks[i + 1] - breaks[i]) / Rational(4);
        const Rational a = breaks[i] + Rational(from) * h, b = breaks[i] + Rational(to) * h;
        const auto points = bezier_coefficients(same, make_knot<T>(a), make_knot<T>(b));
        ASSERT_EQ(static_cast<int>(points.size()), curve.degree() + 1);
        const int span = span_over(curve.knots(), a, b);
        for (const int k : {0, 1, 3, 4}) {
          const Rational x = Rational(k) / Rational(4);
          expect_agrees(de_casteljau(points, make<T>(x)),
                        evaluate_in_span<Rational>(curve, span, Rational(a + x * (b - a))));
        }
      }
  }
}

TEST(BoundaryLawsExact, Law2_WholeBezierIsACopy) {
  RandomRationals random;
  const BsplineCurve<Rational, 4> curve(KnotVector<Rational>::bezier(5), random.points<4>(6));
  EXPECT_EQ(bezier_coefficients(curve, Rational(0), Rational(1)), curve.points());
}

}  // namespace
}  // namespace patchproof
