// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/deviation.h"

#include <cmath>

#include "patchproof/scalar/ball.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Form = BinaryForm<Rational>;
using Forms = FormVector<Rational>;

Rational q(int a, int b) { return Rational(a) / Rational(b); }
Rational ten_to(int k) {
  Rational p(1);
  for (int i = 0; i < std::abs(k); ++i) p = p * 10;
  return k < 0 ? Rational(1 / p) : p;
}
Rational two_to(int k) {
  const Rational p(Integer(1) << std::abs(k));
  return k < 0 ? Rational(1 / p) : p;
}
Form scaled(const Rational& s, const Form& f) { return Form::constant(s) * f; }
Forms scaled(const Rational& s, const Forms& f) { return {scaled(s, f[0]), scaled(s, f[1]), scaled(s, f[2])}; }
Forms random_forms(RandomRationals& random, int degree) {
  return {Form(random.numbers(degree + 1)), Form(random.numbers(degree + 1)), Form(random.numbers(degree + 1))};
}
Form one() { return Form::constant(1); }
Form b(std::vector<Rational> bernstein) { return Form::from_bernstein(std::move(bernstein)); }

// One piece with its exact polynomials: the oracle of every check.
struct ExactPiece {
  Forms n;
  Form d, f = one();
};

// The exact gap or angle at t, by MPFI with 300 bits. At zeros of the factor f both orientations are limits: the larger.
Ball exact_value(const ExactPiece& p, Deviation what, const Rational& t) {
  Rational square(0);
  for (const Form& c : p.n) square += c(t) * c(t);
  Rational d = p.d(t);
  if (what == Deviation::gap) return sqrt(Ball(square)) / Ball(d);
  const Rational f = p.f(t);
  if (what == Deviation::plane_angle) d = abs(d);
  if (what == Deviation::angle && (f < 0 || (f == 0 && d > 0))) d = -d;
  if (d == 0) return Ball(90);
  const Ball acute = atan(sqrt(Ball(square)) / Ball(Rational(abs(d)))) * Ball(180) / Ball::pi();
  return d > 0 ? acute : Ball(180) - acute;
}
bool certainly_above(const Ball& x, double y) { return (x - Ball(y)).sign() == Sign::positive; }
bool certainly_below(const Ball& x, double y) { return (x - Ball(y)).sign() == Sign::negative; }

// The three laws, against the exact polynomials at many places.
DeviationBound expect_laws(const std::vector<ExactPiece>& pieces, Deviation what, const Budget& budget = {}) {
  const BallPrecision precision(300);
  std::vector<DeviationPiece> input;
  for (const ExactPiece& p : pieces) input.push_back(deviation_piece(p.n, p.d, p.f));
  const DeviationBound bound = bound_deviation(input, what, budget);
  EXPECT_LE(bound.lower, bound.upper);
  if (bound.upper < std::numeric_limits<double>::infinity()) {
    for (const ExactPiece& p : pieces)
      for (const Rational& t : spread(Rational(0), Rational(1), 210))  // with 1/2, 1/3, 1/7
        EXPECT_FALSE(certainly_above(exact_value(p, what, t), bound.upper)) << "at " << t << ", upper " << bound.upper;
  }
  const Ball at_witness = exact_value(pieces[bound.piece], what, from_double(bound.t));
  EXPECT_FALSE(certainly_below(at_witness, bound.lower)) << "at " << bound.t << ", lower " << bound.lower;
  if (bound.converged) {
    EXPECT_LE(bound.upper - bound.lower, bound.upper / 100);
  }
  return bound;
}
DeviationBound expect_converged(const std::vector<ExactPiece>& pieces, Deviation what) {
  const DeviationBound bound = expect_laws(pieces, what);
  EXPECT_TRUE(bound.converged) << "[" << bound.lower << ", " << bound.upper << "]";
  return bound;
}

class DeviationLaws : public ::testing::Test {
 private:
  RoundingGuard guard_;
};

// A positive weight product whose Bernstein coefficients are not all positive comes every third time.
Form random_weight(RandomRationals& random, int degree) {
  std::vector<Rational> w;
  for (int i = 0; i <= degree; ++i) w.push_back(Rational(random.integer(1, 9)) / Rational(4));
  if (random.integer(0, 2) != 0) return b(w);
  return b({1, q(-1, 2), 1}) * b(w);  // 1 − 3t(1−t) ≥ 1/4
}

TEST_F(DeviationLaws, Law1to3_RandomGaps) {
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    std::vector<ExactPiece> pieces;
    for (int i = random.integer(1, 3); i > 0; --i)
      pieces.push_back({random_forms(random, random.integer(0, 7)), random_weight(random, random.integer(0, 5))});
    expect_converged(pieces, Deviation::gap);
  }
}

TEST_F(DeviationLaws, Law3_GapsOfEverySize) {
  RandomRationals random;
  const Forms n = random_forms(random, 5);
  const Form w = random_weight(random, 4);
  double previous = 0;
  for (const int k : {-250, -160, -100, -30, -12, -6, 0, 6, 12, 100, 160, 250}) {
    const DeviationBound bound = expect_converged({{scaled(ten_to(k), n), w}}, Deviation::gap);
    EXPECT_GT(bound.lower, previous);
    previous = bound.upper;
  }
}

TEST_F(DeviationLaws, Law3_GapOfWeightsWithNonPositiveCoefficients) {
  // W = (2t − 1)² + 1/100 > 0 has the coefficient −99/100; the largest gap is 100 at 1/2.
  const DeviationBound bound =
      expect_converged({{{one(), Form(), Form()}, b({q(101, 100), q(-99, 100), q(101, 100)})}}, Deviation::gap);
  EXPECT_LE(bound.lower, 100);
  EXPECT_GE(bound.upper, 100);
  EXPECT_EQ(bound.t, 0.5);
}

TEST_F(DeviationLaws, Law1_VanishingDenominatorIsNotBounded) {
  // W = (3t − 1)²: the gap has no bound, and that is the answer.
  const DeviationBound bound = expect_laws({{{one(), Form(), Form()}, b({1, -2, 4})}}, Deviation::gap);
  EXPECT_EQ(bound.upper, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(bound.converged);
}

TEST_F(DeviationLaws, ExactZeroIsZero) {
  for (const Deviation what : {Deviation::gap, Deviation::angle, Deviation::plane_angle}) {
    const DeviationBound bound = expect_converged({{{}, b({1, 2, 1})}, {{Form({0, 0}), Form(), Form()}, one()}}, what);
    EXPECT_EQ(bound.lower, 0);
    EXPECT_EQ(bound.upper, 0);
  }
}

TEST_F(DeviationLaws, Law1to3_RandomAngles) {
  // Normals as they occur: C = n × m, D = n · m of two vector polynomials without common zeros.
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    const Forms n = random_forms(random, random.integer(0, 4)), m = random_forms(random, random.integer(0, 4));
    const std::vector<ExactPiece> pieces{{cross(n, m), dot(n, m)}};
    expect_converged(pieces, Deviation::angle);
    expect_converged(pieces, Deviation::plane_angle);
  }
}

TEST_F(DeviationLaws, Law3_AnglesFromTinyToAlmost180) {
  // tan of 10^-k times something between 1 and 2.25, on both sides of 90°.
  const Forms c{b({1, 1, 2}), b({0, 1, 1}), b({0, 0, q(-1, 2)})};
  for (int k = -11; k <= 11; ++k)
    for (const int sign : {1, -1}) {
      const DeviationBound bound =
          expect_converged({{scaled(ten_to(k), c), b({Rational(sign), Rational(sign)})}}, Deviation::angle);
      EXPECT_TRUE(sign > 0 ? bound.upper <= 90 : bound.lower >= 90) << k;
      const DeviationBound plane =
          expect_converged({{scaled(ten_to(k), c), b({Rational(sign), Rational(sign)})}}, Deviation::plane_angle);
      EXPECT_LE(plane.upper, 90);
    }
}

TEST_F(DeviationLaws, Law3_EnclosesKnownAngles) {
  const auto constant = [](int y, int x) { return ExactPiece{{Form(), Form::constant(y), Form()}, Form::constant(x)}; };
  const auto expect_near = [](const DeviationBound& bound, double degrees) {
    EXPECT_LE(bound.lower, degrees);
    EXPECT_GE(bound.upper, degrees);
    EXPECT_LE(bound.upper - bound.lower, 1e-12 * degrees);
  };
  expect_near(expect_converged({constant(1, 1)}, Deviation::angle), 45);
  expect_near(expect_converged({constant(1, 0)}, Deviation::angle), 90);
  expect_near(expect_converged({constant(-1, -1)}, Deviation::angle), 135);
  expect_near(expect_converged({constant(0, -1)}, Deviation::angle), 180);
  expect_near(expect_converged({constant(-1, -1)}, Deviation::plane_angle), 45);
  expect_near(expect_converged({constant(0, -1), constant(1, 1)}, Deviation::plane_angle), 45);
  const DeviationBound worst = expect_converged({constant(0, 1), constant(1, 1), constant(1, -1)}, Deviation::angle);
  expect_near(worst, 135);
  EXPECT_EQ(worst.piece, 2);
}

TEST_F(DeviationLaws, Law3_AngleCrosses90) {
  const Form d = b({1, -1}), third = b({-1, 2});
  const ExactPiece far{{one(), b({0, 1}), Form()}, d}, near{{scaled(ten_to(-6), b({1, 2, 1})), Form(), Form()}, third};
  EXPECT_GT(expect_converged({far}, Deviation::angle).lower, 90);
  EXPECT_GT(expect_converged({near}, Deviation::angle).lower, 179.9);
  EXPECT_GT(expect_converged({near}, Deviation::plane_angle).lower, 89);
}

TEST_F(DeviationLaws, Law3_Exactly180InsideAndAtAnEnd) {
  for (const Form& zero : {b({-1, 2}), b({-1, 1}), b({0, 1}), b({1, 0}), Form({-1, -2, 1})}) {
    const DeviationBound bound =
        expect_converged({{{zero, zero * b({1, 2}), Form()}, Form::constant(-1)}}, Deviation::angle);
    EXPECT_EQ(bound.upper, 180);
  }
}

TEST_F(DeviationLaws, Law3_HugeAndTinyCoefficients) {
  RandomRationals random;
  const Forms n = random_forms(random, 4), m = random_forms(random, 4);
  const Forms c = cross(n, m);
  const Form d = dot(n, m), w = random_weight(random, 4);
  const DeviationBound angle = expect_converged({{c, d}}, Deviation::angle),
                       gap = expect_converged({{c, w}}, Deviation::gap);
  for (const int bits : {-9000, -2000, -1100, -600, 600, 1100, 2000, 9000}) {
    const Rational s = two_to(bits);
    const DeviationBound same_angle = expect_converged({{scaled(s, c), scaled(s, d)}}, Deviation::angle);
    EXPECT_DOUBLE_EQ(same_angle.upper, angle.upper);
    const DeviationBound same_gap = expect_converged({{scaled(s, c), scaled(s, w)}}, Deviation::gap);
    EXPECT_DOUBLE_EQ(same_gap.upper, gap.upper);
    // Perpendicular everywhere, D = 0 or nothing beside C.
    for (const Deviation what : {Deviation::angle, Deviation::plane_angle}) {
      const DeviationBound right = expect_converged({{{scaled(s, one()), Form(), Form()}, Form()}}, what);
      EXPECT_EQ(right.lower, 90);
      EXPECT_EQ(right.upper, 90);
    }
    const DeviationBound nearly =
        expect_laws({{{one(), Form(), Form()}, Form::constant(two_to(-std::abs(bits)))}}, Deviation::angle);
    EXPECT_TRUE(nearly.converged);
    EXPECT_NEAR(nearly.upper, 90, 1e-9);
  }
}

TEST_F(DeviationLaws, Law1_ValuesBeyondDoubles) {
  // A gap of 2^-2000 is above 0 and below every double; one of 2^2000 above every double.
  const DeviationBound tiny = expect_laws({{{Form::constant(two_to(-2000)), Form(), Form()}, one()}}, Deviation::gap);
  EXPECT_GT(tiny.upper, 0);
  EXPECT_LT(tiny.upper, 1e-300);
  EXPECT_EQ(tiny.lower, 0);
  EXPECT_FALSE(tiny.converged);
  const DeviationBound huge = expect_laws({{{Form::constant(two_to(2000)), Form(), Form()}, one()}}, Deviation::gap);
  EXPECT_GT(huge.upper, 1e308);
  EXPECT_FALSE(huge.converged);
}

TEST_F(DeviationLaws, Law1to3_Degree64) {
  RandomRationals random;
  const Forms n = random_forms(random, 32), m = random_forms(random, 32);
  expect_converged({{cross(n, m), dot(n, m)}}, Deviation::angle);
  const auto bernstein = [&](int degree) { return b(random.numbers(degree + 1)); };
  expect_converged({{{bernstein(64), bernstein(64), bernstein(64)}, one()}}, Deviation::gap);
}

TEST_F(DeviationLaws, Law3_FactorThatChangesSign) {
  // Up to 3° apart and least at 1/2; where F < 0 the sides are exchanged.
  const Forms c{b({q(1, 20), q(1, 200), q(1, 20)}), Form(), Form()};
  const DeviationBound kept = expect_converged({{c, one(), b({1, 3, 1})}}, Deviation::angle);
  EXPECT_LT(kept.upper, 3);
  const DeviationBound turned = expect_converged({{c, one(), b({-1, -3, -1})}}, Deviation::angle);
  EXPECT_GT(turned.lower, 178.4 * 0.99);
  EXPECT_EQ(turned.t, 0.5);
  for (const Form& f : {b({-1, 1}), b({-1, 2}), Form({-1, -2, 1})}) {
    const DeviationBound both = expect_converged({{c, one(), f}}, Deviation::angle);
    EXPECT_GT(both.lower, 177);
    EXPECT_LT(expect_converged({{c, one(), f}}, Deviation::plane_angle).upper, 3);
  }
  // C0 folded back on one side of t² = 1/2 only, and smooth on the other.
  EXPECT_EQ(expect_converged({{{}, one(), Form({-1, -2, 1})}}, Deviation::angle).upper, 180);
  EXPECT_EQ(expect_converged({{{}, one(), Form({-1, -2, 1})}}, Deviation::plane_angle).upper, 0);
}

TEST_F(DeviationLaws, ABudgetEndsInWiderBoundsNotWrongOnes) {
  RandomRationals random;
  const Forms n = random_forms(random, 5), m = random_forms(random, 5);
  const std::vector<ExactPiece> pieces{{cross(n, m), dot(n, m)}};
  double upper = 180;
  for (const int nodes : {0, 1, 4, 16, 1000}) {
    Budget budget;
    budget.nodes = nodes;
    const DeviationBound bound = expect_laws(pieces, Deviation::angle, budget);
    EXPECT_LE(bound.upper, upper);
    upper = bound.upper;
  }
  Budget late;
  late.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  expect_laws(pieces, Deviation::angle, late);
}

TEST_F(DeviationLaws, IntervalFormsBoundTheSame) {
  // Forms over Interval enclose those over Rational: both bounds hold for the exact polynomials.
  RandomRationals random;
  const auto enclosed = [](const Form& f) {
    std::vector<Interval> a;
    for (const Rational& x : f.coefficients()) a.push_back(enclose(x));
    return BinaryForm<Interval>(std::move(a));
  };
  for (int round = 0; round < 10; ++round) {
    const Forms n = random_forms(random, 3), m = random_forms(random, 3);
    const FormVector<Interval> x{enclosed(n[0]), enclosed(n[1]), enclosed(n[2])},
        y{enclosed(m[0]), enclosed(m[1]), enclosed(m[2])};
    const ExactPiece exact{cross(n, m), dot(n, m)};
    const DeviationBound bound = bound_deviation({deviation_piece(cross(x, y), dot(x, y))}, Deviation::angle);
    const DeviationBound reference = expect_converged({exact}, Deviation::angle);
    EXPECT_TRUE(bound.converged);
    EXPECT_LE(bound.lower, reference.upper);
    EXPECT_LE(reference.lower, bound.upper);
    const BallPrecision precision(300);
    for (const Rational& t : spread(Rational(0), Rational(1), 64))
      EXPECT_FALSE(certainly_above(exact_value(exact, Deviation::angle, t), bound.upper));
  }
}

}  // namespace
}  // namespace patchproof
