// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/join_polynomials.h"

#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/interval.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Homogeneous = BsplinePatch<Rational, 4>;
using Point = Vec<Rational, 3>;

// A Bézier patch with random points and weights; u runs into the patch, v along the edge u = 0.
Homogeneous random_rational(RandomRationals& random, int p, int degree_v, bool weighted) {
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i < (p + 1) * (degree_v + 1); ++i) {
    const Rational w = weighted ? Rational(random.integer(1, 12)) / Rational(5) : Rational(1);
    const Point x = random.point<3>();
    net.push_back({{w * x[0], w * x[1], w * x[2], w}});
  }
  return {KnotVector<Rational>::bezier(p), KnotVector<Rational>::bezier(degree_v), net};
}

// The forms of the edge u = 0, multiplied out of the net without any code of the library.
template <class R>
SideForms<R> forms_of(const Homogeneous& s) {
  const int p = s.degree(Direction::u), n = s.degree(Direction::v);
  bool polynomial = true;
  for (const auto& x : s.net()) polynomial = polynomial && x[3] == s.net()[0][3];
  SideForms<R> forms;
  for (int c = 0; c < 4; ++c)
    for (int k = 0; k < 3; ++k) {
      if (c == 3 && polynomial && k > 0) continue;
      std::vector<R> a;
      Rational choose(1);
      for (int j = 0; j <= n; ++j) {
        Rational d(0);
        if (k == 0) d = s.point(0, j)[c];
        if (k == 1 && p >= 1) d = Rational(p) * (s.point(1, j)[c] - s.point(0, j)[c]);
        if (k == 2 && p >= 2)
          d = Rational(p * (p - 1)) * (s.point(2, j)[c] - Rational(2) * s.point(1, j)[c] + s.point(0, j)[c]);
        a.push_back(make<R>(Rational(choose * d)));
        choose = choose * Rational(n - j) / Rational(j + 1);
      }
      if (c == 3 && polynomial) a.resize(1);
      (c < 3 ? forms.position[k][c] : forms.weight[k]) = BinaryForm<R>(std::move(a));
    }
  return forms;
}

template <class R>
Vec<R, 3> value(const FormVector<R>& f, const R& t) {
  return {{f[0](t), f[1](t), f[2](t)}};
}

// Affine derivatives at (0, t): at(k, l) = ∂^k into the patch, ∂^l along.
PartialDerivatives<Rational, 3> affine(const Homogeneous& s, const Rational& t) {
  return rational_derivatives(s, Rational(0), t, 2, 1);
}
Rational weight(const Homogeneous& s, const Rational& t) { return evaluate(s, Rational(0), t)[3]; }

const std::vector<std::pair<bool, bool>> kWeighted{{true, true}, {true, false}, {false, true}, {false, false}};

template <class T>
class JoinPolynomialLaws : public ScalarTest<T> {};
using Rings = ::testing::Types<Rational, Quadratic, Interval>;
TYPED_TEST_SUITE(JoinPolynomialLaws, Rings, ScalarNames);

TYPED_TEST(JoinPolynomialLaws, Law1_PointDifferenceAndNormal) {
  using T = TypeParam;
  RandomRationals random;
  for (const auto& [wa, wb] : kWeighted) {
    const Homogeneous x = random_rational(random, 3, 3, wa), y = random_rational(random, 2, 4, wb);
    const SideForms<T> a = forms_of<T>(x), b = forms_of<T>(y);
    for (const Rational& t : spread(Rational(0), Rational(1), 4)) {
      const T at = make<T>(t);
      const Rational wx = weight(x, t), wy = weight(y, t);
      const auto X = affine(x, t), Y = affine(y, t);
      expect_agrees(value(point_difference(a, b), at), (wx * wy) * (X.at(0, 0) - Y.at(0, 0)));
      expect_agrees(value(normal(a), at), (wx * wx * wx) * cross(X.at(0, 1), X.at(1, 0)));
      expect_agrees(value(normal(b), at), (wy * wy * wy) * cross(Y.at(0, 1), Y.at(1, 0)));
    }
  }
}

// det of four columns by Leibniz' formula, rows in the order (w, x, y, z).
Rational determinant(std::array<Vec<Rational, 4>, 4> columns) {
  std::array<int, 4> p{0, 1, 2, 3};
  Rational sum(0);
  do {
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) inversions += p[j] > p[i];
    Rational term(inversions % 2 == 0 ? 1 : -1);
    for (int i = 0; i < 4; ++i) term = term * columns[i][(p[i] + 3) % 4];
    sum += term;
  } while (std::next_permutation(p.begin(), p.end()));
  return sum;
}

TYPED_TEST(JoinPolynomialLaws, Law1_Coplanarity) {
  using T = TypeParam;
  RandomRationals random;
  for (const auto& [wa, wb] : kWeighted) {
    const Homogeneous x = random_rational(random, 2, 3, wa), y = random_rational(random, 1, 2, wb);
    const BinaryForm<T> form = coplanarity(forms_of<T>(x), forms_of<T>(y));
    for (const Rational& t : spread(Rational(0), Rational(1), 4)) {
      const auto X = partial_derivatives(x, Rational(0), t, 1, 1), Y = partial_derivatives(y, Rational(0), t, 1, 1);
      expect_agrees(form(make<T>(t)), determinant({X.at(0, 0), X.at(0, 1), X.at(1, 0), Y.at(1, 0)}));
    }
  }
}

// y with the edge curve of x: the same homogeneous edge times a positive polynomial factor, the rest random.
Homogeneous on_the_edge_of(const Homogeneous& x, RandomRationals& random, bool weighted) {
  const int n = x.degree(Direction::v);
  const std::vector<Rational> factor = weighted ? std::vector<Rational>{2, 3} : std::vector<Rational>{1, 1};
  std::vector<Vec<Rational, 4>> edge;
  for (int j = 0; j <= n; ++j) edge.push_back(x.point(0, j));
  edge = product(factor, edge);
  Homogeneous y = random_rational(random, 2, n + 1, weighted);
  std::vector<Vec<Rational, 4>> net = y.net();
  std::copy(edge.begin(), edge.end(), net.begin());
  return {y.knots(Direction::u), y.knots(Direction::v), net};
}

TYPED_TEST(JoinPolynomialLaws, Law1_DerivativesAcrossACommonEdge) {
  using T = TypeParam;
  RandomRationals random;
  for (const bool weighted : {true, false}) {
    const Homogeneous x = random_rational(random, 3, 2, weighted), y = on_the_edge_of(x, random, weighted);
    const SideForms<T> a = forms_of<T>(x), b = forms_of<T>(y);
    for (const Rational& t : spread(Rational(0), Rational(1), 5)) {
      const T at = make<T>(t);
      const Rational w = weight(x, t) * weight(y, t);
      const auto X = affine(x, t), Y = affine(y, t);
      ASSERT_EQ(X.at(0, 0), Y.at(0, 0));
      expect_agrees(value(cross_term(a, b), at), w * X.at(1, 0));
      expect_agrees(value(cross_term(b, a), at), w * Y.at(1, 0));
    }
  }
}

// Without a common edge the cross terms are what the header defines, and the second difference is the s²-coefficient
// (times two) of X(−s) w_Y(s) − Y(s) w_X(−s), expanded as polynomials in s.
TYPED_TEST(JoinPolynomialLaws, Law1_SecondDifferenceIsTheCoefficientOfSSquared) {
  using T = TypeParam;
  RandomRationals random;
  for (const auto& [wa, wb] : kWeighted) {
    const Homogeneous x = random_rational(random, 3, 2, wa), y = random_rational(random, 3, 3, wb);
    const FormVector<T> form = second_difference(forms_of<T>(x), forms_of<T>(y));
    const FormVector<T> p = cross_term(forms_of<T>(x), forms_of<T>(y));
    for (const Rational& t : spread(Rational(0), Rational(1), 3)) {
      const auto in_s = [&](const Homogeneous& patch, int c, int sign) {
        std::vector<Rational> column;
        const int n = patch.degree(Direction::v);
        for (int i = 0; i <= 3; ++i) {
          std::vector<Rational> line;
          for (int j = 0; j <= n; ++j) line.push_back(patch.point(i, j)[c]);
          column.push_back(from_bernstein(line)(t));
        }
        return from_bernstein(column).compose(Polynomial({Rational(0), Rational(sign)}));
      };
      const auto coefficient = [](const Polynomial& f, std::size_t i) { return i < f.c.size() ? f.c[i] : Rational(0); };
      Vec<Rational, 3> second, first;
      for (int c = 0; c < 3; ++c) {
        const Polynomial difference =
            in_s(x, c, -1) * in_s(y, 3, 1) + Polynomial({Rational(-1)}) * in_s(y, c, 1) * in_s(x, 3, -1);
        second[c] = Rational(2) * coefficient(difference, 2);
        first[c] = coefficient(in_s(x, c, 1), 1) * coefficient(in_s(y, 3, 1), 0) -
                   coefficient(in_s(x, 3, 1), 1) * coefficient(in_s(y, c, 1), 0);
      }
      expect_agrees(value(form, make<T>(t)), second);
      expect_agrees(value(p, make<T>(t)), first);
    }
  }
}

// n(s, t) = w³ x_t × x_s at several s determines its polynomial in s; its linear term is the second-order normal.
TYPED_TEST(JoinPolynomialLaws, Law1_SecondOrderNormalIsTheDerivativeInS) {
  using T = TypeParam;
  RandomRationals random;
  for (const bool weighted : {true, false}) {
    const Homogeneous x = random_rational(random, 2, 2, weighted);
    const FormVector<T> second = normal(forms_of<T>(x), NormalOrder::second);
    for (const Rational& t : spread(Rational(0), Rational(1), 3)) {
      // n is of degree 3·2 − 1 in s at most: six values give it by Newton's divided differences.
      const int degree = 5;
      std::vector<Rational> places;
      std::vector<Point> values;
      for (int i = 0; i <= degree; ++i) {
        const Rational s = Rational(i) / Rational(degree);
        const auto X = rational_derivatives(x, s, t, 1, 1);
        const Rational w = evaluate(x, s, t)[3];
        places.push_back(s);
        values.push_back((w * w * w) * cross(X.at(0, 1), X.at(1, 0)));
      }
      Point exact;
      for (int c = 0; c < 3; ++c) {
        std::vector<Rational> d;
        for (const Point& v : values) d.push_back(v[c]);
        for (int r = 1; r <= degree; ++r)
          for (int i = degree; i >= r; --i) d[i] = (d[i] - d[i - 1]) / (places[i] - places[i - r]);
        Polynomial newton({d[degree]});
        for (int i = degree - 1; i >= 0; --i)
          newton = newton * Polynomial({-places[i], Rational(1)}) + Polynomial({d[i]});
        exact[c] = newton.derivative()(Rational(0));
      }
      expect_agrees(value(second, make<T>(t)), exact);
    }
  }
}

// A collapsed edge: the first-order normal is zero and n(s, t)/s tends to the second-order normal linearly in s.
TEST(JoinPolynomialLawsExact, Law1_CollapsedEdge) {
  RandomRationals random;
  for (const bool weighted : {true, false}) {
    Homogeneous x = random_rational(random, 2, 3, weighted);
    std::vector<Vec<Rational, 4>> net = x.net();
    for (int j = 1; j <= 3; ++j) net[j] = net[0];
    x = Homogeneous(x.knots(Direction::u), x.knots(Direction::v), net);
    const SideForms<Rational> a = forms_of<Rational>(x);
    for (const BinaryForm<Rational>& c : normal(a)) EXPECT_TRUE(*is_zero(c));
    const Rational t = random.unit();
    const Point n1 = value(normal(a, NormalOrder::second), t);
    EXPECT_NE(n1, Point());
    Rational last(-1);
    for (const int bits : {4, 10, 16}) {
      const Rational s = Rational(1) / Rational(1 << bits);
      const auto X = rational_derivatives(x, s, t, 1, 1);
      const Rational w = evaluate(x, s, t)[3];
      const Point n = (w * w * w / s) * cross(X.at(0, 1), X.at(1, 0));
      const Point d = n - n1;
      const Rational distance = dot(d, d);
      if (last >= 0) {
        EXPECT_LT(distance * Rational(1 << 10), last);
      }
      last = distance;
    }
  }
}

TEST(JoinPolynomialLawsExact, Law2_PolynomialSidesNeedNoRationalArithmetic) {
  RandomRationals random;
  const SideForms<Rational> a = forms_of<Rational>(random_rational(random, 3, 3, false));
  EXPECT_EQ(a.weight[0].degree(), 0);
  EXPECT_TRUE(a.weight[1].is_empty());
  // Degrees of a bicubic join: 3, 3 + 2, 3 + 3 + 2.
  EXPECT_EQ(point_difference(a, a)[0].degree(), 3);
  EXPECT_EQ(normal(a)[0].degree(), 5);
  EXPECT_EQ(coplanarity(a, a).degree(), 8);
}

TEST(JoinPolynomialLawsExact, Law3_ShiftedOrigin) {
  RandomRationals random;
  const Homogeneous x = random_rational(random, 2, 2, true), y = random_rational(random, 2, 3, true);
  const Point o{{Rational(1000003), Rational(-7) / Rational(3), Rational(5)}};
  const auto shifted = [&](const Homogeneous& s) {
    return map_points(s, [&](const Vec<Rational, 4>& p) {
      return Vec<Rational, 4>{{p[0] - o[0] * p[3], p[1] - o[1] * p[3], p[2] - o[2] * p[3], p[3]}};
    });
  };
  const auto same = [](const FormVector<Rational>& f, const FormVector<Rational>& g) {
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(*is_zero(f[c] - g[c]));
  };
  const SideForms<Rational> a = forms_of<Rational>(x), b = forms_of<Rational>(y);
  const SideForms<Rational> c = forms_of<Rational>(shifted(x)), d = forms_of<Rational>(shifted(y));
  same(point_difference(a, b), point_difference(c, d));
  same(normal(a), normal(c));
  same(normal(a, NormalOrder::second), normal(c, NormalOrder::second));
  same(second_difference(a, b), second_difference(c, d));
  EXPECT_TRUE(*is_zero(coplanarity(a, b) - coplanarity(c, d)));
  same(cross_term(a, b), cross_term(c, d));
}

}  // namespace
}  // namespace patchproof
