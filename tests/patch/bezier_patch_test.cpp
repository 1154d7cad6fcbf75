// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/bezier_patch.h"

#include "patchproof/scalar/integer.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Exact = BezierPatch<Rational, 3>;

template <class T>
BezierPatch<T, 3> make_bezier(const Exact& b) {
  return {b.degree(Direction::u), b.degree(Direction::v), make_points<T>(b.net())};
}

// Σ b_ij B_i B_j and its derivatives from the multiplied-out Bernstein polynomials.
Vec<Rational, 3> by_definition(const Exact& b, const Rational& u, const Rational& v, int k = 0, int l = 0) {
  const auto basis = [](int n, const Rational& t, int order) {
    std::vector<Rational> out;
    for (int i = 0; i <= n; ++i) {
      std::vector<Rational> unit(n + 1, Rational(0));
      unit[i] = 1;
      out.push_back(from_bernstein(unit).derivative(order)(t));
    }
    return out;
  };
  const auto bu = basis(b.degree(Direction::u), u, k), bv = basis(b.degree(Direction::v), v, l);
  Vec<Rational, 3> sum;
  for (std::size_t i = 0; i < bu.size(); ++i)
    for (std::size_t j = 0; j < bv.size(); ++j) sum += Rational(bu[i] * bv[j]) * b.point(i, j);
  return sum;
}

Exact random_bezier(int p, int q, std::uint64_t seed = 3) {
  RandomRationals random(seed);
  return {p, q, random.points<3>((p + 1) * (q + 1))};
}

template <class T>
class BezierPatchLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(BezierPatchLaws, AllScalars, ScalarNames);
template <class T>
class ExactBezierPatchLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(ExactBezierPatchLaws, ExactScalars, ScalarNames);

const Rational kU = Rational(1) / 3, kV = Rational(5) / 4;  // one parameter outside the unit square

TYPED_TEST(BezierPatchLaws, Law1_EvaluateIsTheDoubleSum) {
  for (const auto& [p, q] : {std::pair(0, 0), std::pair(1, 4), std::pair(3, 2), std::pair(5, 0)}) {
    const Exact b = random_bezier(p, q);
    check<TypeParam>(by_definition(b, kU, kV),
                     [&]<class S>() { return evaluate(make_bezier<S>(b), make<S>(kU), make<S>(kV)); });
  }
}

TEST(BezierPatch, Law1_Corners) {
  const Exact b = random_bezier(3, 2);
  EXPECT_TRUE(evaluate(b, Rational(0), Rational(0)) == b.point(0, 0));
  EXPECT_TRUE(evaluate(b, Rational(1), Rational(0)) == b.point(3, 0));
  EXPECT_TRUE(evaluate(b, Rational(0), Rational(1)) == b.point(0, 2));
  EXPECT_TRUE(evaluate(b, Rational(1), Rational(1)) == b.point(3, 2));
  EXPECT_THROW(Exact(1, 1, b.net()), contract_error);
}

TEST(BezierPatch, Law1_IntegerNets) {
  // De Casteljau needs a Ring only: at integer parameters it is exact on integers.
  const BezierPatch<Integer, 1> b(2, 1, {{{1}}, {{2}}, {{-3}}, {{4}}, {{5}}, {{7}}});
  const BezierPatch<Rational, 1> same(2, 1, {{{1}}, {{2}}, {{-3}}, {{4}}, {{5}}, {{7}}});
  EXPECT_EQ(Rational(evaluate(b, Integer(3), Integer(-2))[0]), evaluate(same, Rational(3), Rational(-2))[0]);
}

TYPED_TEST(BezierPatchLaws, Law2_SplitAndRestrict) {
  const Exact b = random_bezier(3, 2);
  const Rational t = Rational(3) / 8, s = Rational(1) / 4, one = 1;
  for (const Direction d : {Direction::u, Direction::v}) {
    const auto at = [&](const Rational& along) {
      return d == Direction::u ? by_definition(b, along, kV) : by_definition(b, kV, along);
    };
    const auto value = [&]<class S>(const BezierPatch<S, 3>& patch) {
      return d == Direction::u ? evaluate(patch, make<S>(s), make<S>(kV)) : evaluate(patch, make<S>(kV), make<S>(s));
    };
    check<TypeParam>(at(t * s), [&]<class S>() { return value(split(make_bezier<S>(b), d, make<S>(t)).first); });
    check<TypeParam>(at(t + (one - t) * s),
                     [&]<class S>() { return value(split(make_bezier<S>(b), d, make<S>(t)).second); });
    check<TypeParam>(at(2 + (t - 2) * s), [&]<class S>() {
      return value(restrict(make_bezier<S>(b), d, make<S>(Rational(2)), make<S>(t)));
    });
  }
}

TEST(BezierPatch, Law2_HalvesShareTheLineBetweenThem) {
  const auto [low, high] = split(random_bezier(3, 2), Direction::u, Rational(2) / 7);
  for (int j = 0; j <= 2; ++j) EXPECT_TRUE(low.point(3, j) == high.point(0, j));
}

TYPED_TEST(ExactBezierPatchLaws, Law3_ElevationAndReduction) {
  const auto b = make_bezier<TypeParam>(random_bezier(2, 3));
  for (const Direction d : {Direction::u, Direction::v}) {
    const auto higher = elevate_degree(b, d, 2);
    EXPECT_EQ(higher.degree(d), b.degree(d) + 2);
    expect_agrees(evaluate(higher, make<TypeParam>(kU), make<TypeParam>(kV)),
                  by_definition(random_bezier(2, 3), kU, kV));
    auto lower = reduce_degree(higher, d);
    ASSERT_TRUE(lower.has_value());
    lower = reduce_degree(*lower, d);
    ASSERT_TRUE(lower.has_value());
    EXPECT_TRUE(lower->net() == b.net());
    EXPECT_FALSE(reduce_degree(b, d).has_value());
    // One line of full degree is enough to refuse.
    auto net = higher.net();
    net.back()[1] += TypeParam(1);
    EXPECT_FALSE(
        reduce_degree(BezierPatch<TypeParam, 3>(higher.degree(Direction::u), higher.degree(Direction::v), net), d));
  }
  EXPECT_FALSE(reduce_degree(make_bezier<TypeParam>(random_bezier(0, 1)), Direction::u).has_value());
}

TYPED_TEST(BezierPatchLaws, Law4_ReverseAndSwap) {
  const Exact b = random_bezier(3, 2);
  check<TypeParam>(by_definition(b, 1 - kU, kV), [&]<class S>() {
    return evaluate(reverse(make_bezier<S>(b), Direction::u), make<S>(kU), make<S>(kV));
  });
  check<TypeParam>(by_definition(b, kV, 1 - kU), [&]<class S>() {
    return evaluate(swap_directions(reverse(make_bezier<S>(b), Direction::v)), make<S>(kU), make<S>(kV));
  });
  EXPECT_TRUE(swap_directions(swap_directions(b)).net() == b.net());
  EXPECT_TRUE(reverse(reverse(b, Direction::v), Direction::v).net() == b.net());
  EXPECT_TRUE(swap_directions(reverse(b, Direction::u)).net() == reverse(swap_directions(b), Direction::v).net());
}

TYPED_TEST(BezierPatchLaws, Law5_DerivativePatches) {
  const Exact b = random_bezier(3, 2);
  for (const auto& [k, l] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(2, 1), std::pair(0, 3)})
    check<TypeParam>(by_definition(b, kU, kV, k, l), [&]<class S>() {
      auto d = make_bezier<S>(b);
      for (int i = 0; i < k; ++i) d = derivative_patch(d, Direction::u);
      for (int i = 0; i < l; ++i) d = derivative_patch(d, Direction::v);
      return evaluate(d, make<S>(kU), make<S>(kV));
    });
  EXPECT_TRUE(derivative_patch(derivative_patch(b, Direction::u), Direction::v).net() ==
              derivative_patch(derivative_patch(b, Direction::v), Direction::u).net());
}

TYPED_TEST(BezierPatchLaws, Law6_CornerTwists) {
  const Exact b = random_bezier(3, 2);
  const std::vector<Vec<Rational, 3>> truth{by_definition(b, 0, 0, 1, 1), by_definition(b, 1, 0, 1, 1),
                                            by_definition(b, 0, 1, 1, 1), by_definition(b, 1, 1, 1, 1)};
  check<TypeParam>(truth, [&]<class S>() {
    const auto twists = corner_twists(make_bezier<S>(b));
    return std::vector<Vec<S, 3>>(twists.begin(), twists.end());
  });
}

TEST(BezierPatch, Law6_TwistsAreSymmetric) {
  const Exact b = random_bezier(3, 2);
  const auto swapped = corner_twists(swap_directions(b)), straight = corner_twists(b);
  EXPECT_TRUE(swapped[0] == straight[0] && swapped[1] == straight[2] && swapped[2] == straight[1] &&
              swapped[3] == straight[3]);
  const Vec<Rational, 3> zero;
  EXPECT_TRUE(corner_twists(random_bezier(0, 3))[2] == zero);
}

// Unclamped, repeated, full and more than full knots; the pieces cover the domain and are the patch.
TYPED_TEST(BezierPatchLaws, Law7_PiecesAreThePatch) {
  RandomRationals random(17);
  const BsplinePatch<Rational, 3> s{make_knots<Rational>(2, {-1, 0, 0, 1, 2, 2, 2, 2, 3, 4, 4, 5}),
                                    make_knots<Rational>(1, {1, 1, 3, 3, 4}), random.points<3>(9 * 3)};
  const auto pieces = extract_bezier(make_patch<TypeParam>(s));
  const auto bu = s.knots(Direction::u).breaks(), bv = s.knots(Direction::v).breaks();
  ASSERT_EQ(pieces.size(), (bu.size() - 1) * (bv.size() - 1));
  const Rational x = Rational(1) / 4, y = Rational(3) / 4;
  std::size_t next = 0;
  for (std::size_t a = 0; a + 1 < bu.size(); ++a)
    for (std::size_t b = 0; b + 1 < bv.size(); ++b, ++next) {
      const auto& box = pieces[next].box;
      EXPECT_TRUE(box.u_begin == make_knot<TypeParam>(bu[a]) && box.u_end == make_knot<TypeParam>(bu[a + 1]) &&
                  box.v_begin == make_knot<TypeParam>(bv[b]) && box.v_end == make_knot<TypeParam>(bv[b + 1]));
      const Rational u = bu[a] + (bu[a + 1] - bu[a]) * x, v = bv[b] + (bv[b + 1] - bv[b]) * y;
      check<TypeParam>(derivative_by_definition(s, u, v, 0, 0), [&]<class S>() {
        return evaluate(extract_bezier(make_patch<S>(s))[next].bezier, make<S>(x), make<S>(y));
      });
      // The corners are one-sided limits.
      check<TypeParam>(derivative_by_definition(s, bu[a + 1], bv[b], 0, 0, Side::left, Side::right),
                       [&]<class S>() { return extract_bezier(make_patch<S>(s))[next].bezier.point(2, 0); });
    }
}

TEST(BezierPatch, Law7_ABezierPatchIsItsOnlyPiece) {
  const Exact b = random_bezier(3, 2);
  const auto pieces = extract_bezier(to_bspline(b));
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(pieces[0].bezier.net() == b.net());
  EXPECT_TRUE(pieces[0].box == (ParameterBox<Rational>{0, 1, 0, 1}));
}

}  // namespace
}  // namespace patchproof
