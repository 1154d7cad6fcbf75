// SPDX-License-Identifier: Apache-2.0
// Numbers that all threads read. (tests/scalar/mpfr_threads_test.cpp: what MPFR keeps for each thread.)
#include "patchproof/scalar/fixed_integer.h"
#include "patchproof/scalar/transcendental.h"
#include "patchproof/spline/binary_form.h"
#include "patchproof/spline/real_roots.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

TEST(ThreadsScalar, NumbersAreReadByAll) {
  const Rational third = Rational(1) / Rational(3), tiny = Rational(1) / Rational(Integer(1) << 1100);
  const Quadratic root = parse_scalar<Quadratic>("1/3+2*sqrt(2)").value();
  const Ball wide(Interval(0.25, 0.5));
  const auto form = BinaryForm<Rational>::from_bernstein({-1, 3, -4, 7, Rational(-1) / Rational(9)});
  Together all;
  all.add("arithmetic",
          [&] { return say(third * third + tiny, third / tiny, root * root - root, root / (root + root)); });
  all.add("roundings", [&] {
    return say(nearest_double(third), nearest_double(tiny), nearest_double(root), enclose(third), enclose(tiny),
               enclose(root), enclose_scaled(tiny).mantissa);
  });
  all.add("balls", [&] {
    const BallPrecision precision(200);
    return say(exp(wide), sin(wide), cos(wide), atan(wide), sqrt(wide), Ball::pi(), Ball(third) / wide, wide * wide);
  });
  all.add("balls of few digits", [&] {
    const BallPrecision precision(30);
    return say(exp(wide), Ball::pi(), Ball(third));
  });
  all.add("circular functions", [&] {
    const RoundingGuard guard;
    using Model = TaylorModel<4>;
    return say(pi<Interval>(), cos_sin_pi(Interval(0.1, 0.2)), cos_sin_pi(Ball(third)),
               cos_sin_pi(Model::variable(Interval(0.3), Interval(0.1))));
  });
  all.add("circular functions of doubles", [&] { return say(pi<double>(), cos_sin_pi(0.3), cos_sin_pi(-7.7)); });
  all.add("texts", [&] {
    return say(to_text(third), to_text(root), to_text(0.1), parse_scalar<Rational>("-12.75e-3"),
               parse_scalar<Quadratic>("sqrt(8)/3"), parse_scalar<Rational>("1/0"));
  });
  all.add("roots", [&] { return say(isolate_roots(form, Rational(1) / Rational(1000))); });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
