// SPDX-License-Identifier: Apache-2.0
// A program outside the project: reads two numbers, prints their exact sum, and evaluates the point of a line in two
// scalars and by the kernels, from headers and the compiled library of the installed package alone.
#include <cstdio>
#include <vector>

#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/evaluate_batch.h"

using namespace patchproof;

template <Ring T>
T middle(const Rational& a, const Rational& b) {
  const std::vector<Vec<T, 1>> line = {{{embed<T>(a)}}, {{embed<T>(b)}}};
  return de_casteljau(line, embed<T>(Rational(1) / Rational(2)))[0];
}

int main(int count, char** words) {
  if (count != 3) return 2;
  const Result<Rational> a = parse_scalar<Rational>(words[1]), b = parse_scalar<Rational>(words[2]);
  if (!a || !b) return 2;
  std::printf("%s\n", to_text(Rational(*a + *b)).c_str());

  const std::vector<double> knots = {0, 0, 1, 1}, points = {1, 2, 3, 3, 4, 7}, t = {0.5};
  double point[3];
  CurveOutput out;
  out.point = VectorArray::interleaved(point);
  const auto curve = BatchCurve::make({1, knots, points, {}});
  if (!curve || !curve->evaluate(t, out) || point[0] != 2 || point[1] != 3 || point[2] != 5) return 1;

  const RoundingGuard guard;
  const Rational exact = middle<Rational>(*a, *b);
  const Interval enclosure = middle<Interval>(*a, *b);
  const bool holds = exact == (*a + *b) / Rational(2) && from_double(enclosure.inf()) <= exact &&
                     exact <= from_double(enclosure.sup());
  return holds ? 0 : 1;
}
