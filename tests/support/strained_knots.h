// SPDX-License-Identifier: Apache-2.0
// Knots in double that strain a computation, for tests of error bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "patchproof/spline/knot_vector.h"
#include "support/wild_numbers.h"

namespace patchproof::test {

// Doubles that strain: nearly equal knots, far offsets, scales up to 1e±150, subnormal distances.
inline std::vector<std::vector<double>> strained_double_knots(int degree, WildNumbers& wild) {
  std::vector<std::vector<double>> out;
  const double scales[] = {1, 1e150, 1e-150, 0x1p-1060, 0x1p1000};
  for (const double scale : scales)
    for (const double offset : {0.0, 1.0e6})
      for (int kind = 0; kind < 3; ++kind) {
        std::vector<double> knots;
        double t = offset * scale;
        const int count = 2 * degree + 2 + wild.below(8);
        for (int i = 0; i < count; ++i) {
          knots.push_back(t);
          const int choice = wild.below(kind == 0 ? 3 : 4);
          if (kind == 1 && choice == 0) t = std::nextafter(t, kInfinity);                     // one ulp further
          if (kind == 2 && choice == 0) t += scale * std::ldexp(1.0, -wild.below(1000) - 1);  // any fraction
          if (choice >= 2) t += scale * std::ldexp(1 + wild.below(1 << 20) * 0x1p-20, -wild.below(12));
        }
        if (knots[degree] == knots[count - degree - 1]) continue;
        out.push_back(knots);
      }
  return out;
}

// n u/(1 − n u), u = 2^-53.
inline Rational gamma(long roundings) {
  const Rational u = power_of_two(-53);
  return Rational(roundings) * u / (1 - Rational(roundings) * u);
}

// Knots to insert: anywhere in a span, on its ends, and one double beside its begin; some twice.
inline std::vector<double> strained_insertion(const KnotVector<double>& old, int count, WildNumbers& wild) {
  std::vector<double> out;
  while (static_cast<int>(out.size()) < count) {
    const int span = old.degree() + wild.below(old.control_count() - old.degree());
    const double a = old[span], b = old[span + 1];
    double t = a + (b - a) * (wild.below(1024) / 1024.0);
    if (wild.below(3) == 0) t = std::nextafter(a, kInfinity);
    out.insert(out.end(), 1 + wild.below(2), std::min(t, b));
  }
  return out;
}

inline KnotVector<Rational> exact_knots(const KnotVector<double>& knots) {
  std::vector<Rational> out;
  for (const double x : knots.knots()) out.push_back(from_double(x));
  return KnotVector<Rational>::make(knots.degree(), std::move(out)).value();
}

}  // namespace patchproof::test
