// SPDX-License-Identifier: Apache-2.0
// A program outside the project: reads two numbers, prints their exact sum, and evaluates the point of a line in two
// scalars, from headers and the compiled library of the installed package alone.
#include <cstdio>
#include <vector>

#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/bernstein.h"

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

  const RoundingGuard guard;
  const Rational exact = middle<Rational>(*a, *b);
  const Interval enclosure = middle<Interval>(*a, *b);
  const bool holds = exact == (*a + *b) / Rational(2) && from_double(enclosure.inf()) <= exact &&
                     exact <= from_double(enclosure.sup());
  return holds ? 0 : 1;
}
