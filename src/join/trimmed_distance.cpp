// SPDX-License-Identifier: Apache-2.0
// How far a point is from a whole edge of a trimmed face, at least.
#include "trimmed_distance.h"

#include <vector>

#include "patchproof/patch/affine.h"
#include "trimmed_side.h"

namespace patchproof {
namespace {

using namespace trimmed;

// The square of the least absolute value.
Interval least_square(const Interval& x) {
  if (x.inf() > 0) return square(Interval(x.inf()));
  if (x.sup() < 0) return square(Interval(x.sup()));
  return Interval(0);
}

// Of the origin from the part of the edge over [begin, end], at least.
double distance_of_part(const MovedSide& side, const Rational& begin, const Rational& end) {
  const Rational middle = (begin + end) / Rational(2);
  const Model t = Model::variable(enclose(middle), enclose(Rational((end - begin) / Rational(2))));
  const Run run = run_of(side, t, middle);
  double out = run.combinations() > 0 ? kInfinity : 0;
  for (const int i : run.spans_u)
    for (const int j : run.spans_v) {
      check_deadline();
      const Vec<Model, 4> h = side.surface.derivatives<Model>(i, j, run.u, run.v, 0).at(0, 0);
      const Interval w = h[3].bernstein_range();
      if (!(w.inf() > 0) && !(w.sup() < 0)) return 0;
      Interval square_sum(0);
      for (int c = 0; c < 3; ++c) square_sum += least_square(h[c].bernstein_range());
      const Interval distance = sqrt(square_sum / square(w));
      out = std::min(out, distance.inf());
    }
  return out;
}

}  // namespace

double distance_from_edge(const Vec<Rational, 3>& point, const TrimmedSide& side, double enough, int parts) {
  const AffineMap<Rational> move = translation(-point);
  const MovedSide moved(side, move);
  std::vector<std::pair<Rational, Rational>> open;
  const std::vector<Rational> breaks = side.parameters.knots().breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) open.emplace_back(breaks[i], breaks[i + 1]);
  double least = kInfinity;
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    const double distance = distance_of_part(moved, begin, end);
    if (distance > enough || parts-- <= 0) {
      least = std::min(least, distance);
      continue;
    }
    const Rational middle = (begin + end) / Rational(2);
    open.emplace_back(begin, middle);
    open.emplace_back(middle, end);
  }
  return least;
}

}  // namespace patchproof
