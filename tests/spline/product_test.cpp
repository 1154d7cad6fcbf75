// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/product.h"

#include "patchproof/spline/degree.h"
#include "patchproof/spline/reparametrize.h"
#include "support/curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Function = BsplineCurve<Rational, 1>;

template <class T>
class Product : public ScalarTest<T> {};
TYPED_TEST_SUITE(Product, AllScalars, ScalarNames);

KnotVector<Rational> knots_of(int degree, std::vector<Rational> knots) {
  return KnotVector<Rational>::make(degree, std::move(knots)).value();
}

// Functions on [0, 4]; all knots are doubles after the map to [0, 4] too.
std::vector<Function> functions(RandomRationals& random) {
  std::vector<Function> out;
  for (const auto& knots : {knots_of(0, {0, 4}), knots_of(0, {0, 1, 4}), knots_of(1, {0, 0, 2, 4, 4}),
                            knots_of(2, {-2, -1, 0, 1, 2, 4, 5, 7}), knots_of(2, {0, 0, 0, 3, 3, 3, 4, 4, 4}),
                            knots_of(3, {0, 0, 0, 0, 1, 1, 3, 4, 4, 4, 4})})
    out.push_back(Function(knots, random.points<1>(knots.control_count())));
  return out;
}

std::vector<NamedCurve> curves(RandomRationals& random) {
  std::vector<NamedCurve> out = awkward_curves(random);
  for (auto& [name, curve] : out) curve = map_domain(curve, Rational(0), Rational(4));
  return out;
}

TEST(Product, Law1_pieces_are_products_of_pieces) {
  RandomRationals random;
  for (const auto& [name, curve] : curves(random))
    for (const Function& f : functions(random)) {
      SCOPED_TRACE(name + ", times a function of degree " + std::to_string(f.degree()));
      const PlaneCurve fc = product(f, curve);
      const std::vector<Rational> breaks = common_breaks(f.knots(), curve.knots());
      EXPECT_EQ(fc.knots().breaks(), breaks);
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const auto value = [&](const auto& c, const Rational& t) {
          return evaluate_in_span<Rational>(c, span_over(c.knots(), breaks[i], breaks[i + 1]), t);
        };
        for (const Rational& t : enough_parameters(breaks[i], breaks[i + 1], fc.degree()))
          EXPECT_EQ(value(fc, t), value(f, t)[0] * value(curve, t));
      }
    }
}

TYPED_TEST(Product, Law1_in_every_scalar) {
  RandomRationals random;
  const Function f(knots_of(2, {0, 0, 0, 1, 3, 3, 4, 4, 4}), random.points<1>(6));
  for (const auto& knots :
       {knots_of(3, {0, 0, 0, 0, 1, 2, 2, 4, 4, 4, 4}), knots_of(2, {-1, 0, 0, 2, 3, 3, 3, 4, 6, 6})}) {
    const PlaneCurve curve(knots, random.points<2>(knots.control_count()));
    check<TypeParam>(product(f, curve).points(),
                     [&]<class S>() { return product(make_curve<S>(f), make_curve<S>(curve)).points(); });
  }
}

TEST(Product, Law2_degree_and_knots) {
  // f is C¹ at 1 and jumps at 3; C is C² at 1, C⁰ at 2 and C¹ at 3.
  const auto f = knots_of(2, {0, 0, 0, 1, 3, 3, 3, 4, 4, 4});
  const auto c = knots_of(3, {0, 0, 0, 0, 1, 2, 2, 2, 3, 3, 4, 4, 4, 4});
  const KnotVector<Rational> fc = product_knots(f, c);
  EXPECT_EQ(fc.degree(), 5);
  EXPECT_EQ(fc.multiplicity(0), 6);
  EXPECT_EQ(fc.multiplicity(1), 4);  // C¹ of degree 5
  EXPECT_EQ(fc.multiplicity(2), 5);  // C⁰
  EXPECT_EQ(fc.multiplicity(3), 6);  // a jump
  EXPECT_EQ(fc.multiplicity(4), 6);
  EXPECT_EQ(fc.knots().size(), 6u + 4 + 5 + 6 + 6);

  // Random factors are as rough as their knots, and then so is the product: no knot is repeated in vain.
  RandomRationals random;
  const Function g(f, random.points<1>(f.control_count()));
  const PlaneCurve curve(c, random.points<2>(c.control_count()));
  const PlaneCurve gc = product(g, curve);
  EXPECT_EQ(gc.knots(), fc);
  EXPECT_EQ(remove_redundant_knots(gc).knots(), fc);
}

TEST(Product, Law3_one_times_the_curve) {
  RandomRationals random;
  const Function one(knots_of(0, {0, 4}), {{{Rational(1)}}});
  for (const auto& [name, curve] : curves(random)) {
    SCOPED_TRACE(name);
    expect_same_curve(product(one, curve), curve);
    if (is_clean(curve)) {
      EXPECT_EQ(product(one, curve).points(), curve.points());
      EXPECT_EQ(product(elevate_degree(one, 2), curve).points(), elevate_degree(curve, 2).points());
    }
  }
}

TEST(Product, Law4_bilinear_and_associative) {
  RandomRationals random;
  const auto fs = functions(random);
  const PlaneCurve curve = curve_on(random, 2, {0, 0, 0, 1, 3, 3, 4, 4, 4});
  for (const Function& f : fs)
    for (const Function& g : fs) expect_same_curve(product(f, product(g, curve)), product(product(f, g), curve));

  const Function& f = fs.back();
  const PlaneCurve other(curve.knots(), random.points<2>(curve.knots().control_count()));
  std::vector<Vec<Rational, 2>> sum, sum_of_products;
  for (std::size_t i = 0; i < curve.points().size(); ++i)
    sum.push_back(curve.points()[i] + Rational(3) * other.points()[i]);
  const PlaneCurve first = product(f, curve), second = product(f, other);
  for (std::size_t i = 0; i < first.points().size(); ++i)
    sum_of_products.push_back(first.points()[i] + Rational(3) * second.points()[i]);
  EXPECT_EQ(product(f, PlaneCurve(curve.knots(), sum)).points(), sum_of_products);
}

TEST(Product, Contracts) {
  RandomRationals random;
  const PlaneCurve curve = curve_on(random, 2, {0, 0, 0, 1, 1, 1});
  EXPECT_THROW(product(functions(random)[0], curve), contract_error);
}

}  // namespace
}  // namespace patchproof::test
