// SPDX-License-Identifier: Apache-2.0
#include "validation/corpus/truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/integer.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof::validation {
namespace {

KnotVector<Rational> exact_knots(int degree, std::span<const double> knots) {
  std::vector<Rational> exact;
  for (const double k : knots) exact.push_back(from_double(k));
  return KnotVector<Rational>::make(degree, std::move(exact)).value();
}

std::vector<Vec<Rational, 4>> exact_net(std::span<const double> points, std::span<const double> weights) {
  std::vector<Vec<Rational, 4>> net;
  for (std::size_t i = 0; 3 * i < points.size(); ++i)
    net.push_back(to_homogeneous(
        Vec<Rational, 3>{{from_double(points[3 * i]), from_double(points[3 * i + 1]), from_double(points[3 * i + 2])}},
        weights.empty() ? Rational(1) : from_double(weights[i])));
  return net;
}

// n / |n|, each coordinate within 2^-200: √(|n|²) by an integer square root of at least 220 bits.
ExactVector normalised(const ExactVector& n) {
  const Rational square = dot(n, n);
  const Integer p = numerator(square), q = denominator(square);
  // √(p/q) = √(p·q)/q;  with 2k more bits of p·q, the root's k more bits are right to within one unit.
  const Integer product = p * q;
  const int bits = static_cast<int>(msb(product)), k = bits > 440 ? 0 : (440 - bits) / 2 + 1;
  const Integer root = sqrt(Integer(product << (2 * k)));
  const Rational inverse_length = Rational(Integer(q << k), root);
  return inverse_length * n;
}

Rational two_to(int exponent) {
  return exponent >= 0 ? Rational(Integer(Integer(1) << exponent))
                       : Rational(Integer(1), Integer(Integer(1) << -exponent));
}

}  // namespace

BsplinePatch<Rational, 4> exact_patch(const SurfaceData& d) {
  return {exact_knots(d.degree_u, d.knots_u), exact_knots(d.degree_v, d.knots_v), exact_net(d.points, d.weights)};
}

BsplineCurve<Rational, 4> exact_curve(const CurveData& d) {
  return {exact_knots(d.degree, d.knots), exact_net(d.points, d.weights)};
}

SurfaceTruth exact_values(const BsplinePatch<Rational, 4>& patch, double u, double v, Side side, int derivatives) {
  const PartialDerivatives<Rational, 4> h =
      partial_derivatives(patch, from_double(u), from_double(v), derivatives, derivatives, side, side);
  // Only k + l ≤ derivatives are wanted: each table of the quotient as small as it can be.
  const auto quotient = [&](int order_u, int order_v) {
    std::vector<Vec<Rational, 4>> table;
    for (int k = 0; k <= order_u; ++k)
      for (int l = 0; l <= order_v; ++l) table.push_back(h.at(k, l));
    return rational_derivatives(PartialDerivatives<Rational, 4>(order_u, order_v, std::move(table)));
  };
  SurfaceTruth out;
  out.vectors[kPoint] = quotient(0, 0).at(0, 0);
  if (derivatives >= 1) {
    out.vectors[kDu] = quotient(1, 0).at(1, 0);
    out.vectors[kDv] = quotient(0, 1).at(0, 1);
    const ExactVector n = cross(out.vectors[kDu], out.vectors[kDv]);
    out.has_normal = n != ExactVector{};
    if (out.has_normal) out.normal = normalised(n);
  }
  if (derivatives >= 2) {
    out.vectors[kDuu] = quotient(2, 0).at(2, 0);
    out.vectors[kDuv] = quotient(1, 1).at(1, 1);
    out.vectors[kDvv] = quotient(0, 2).at(0, 2);
  }
  return out;
}

CurveTruth exact_values(const BsplineCurve<Rational, 4>& curve, double t, Side side, int derivatives) {
  const std::vector<ExactVector> c = rational_derivatives(curve, from_double(t), derivatives, side);
  CurveTruth out;
  for (std::size_t k = 0; k < c.size(); ++k) out[k] = c[k];
  return out;
}

std::vector<KnownSurface> with_truth(std::vector<SurfaceCase> cases) {
  std::vector<KnownSurface> out(cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t k) {
    KnownSurface& known = out[k];
    known.data = std::move(cases[k]);
    const SurfaceCase& c = known.data;
    const BsplinePatch<Rational, 4> patch = exact_patch(c.data());
    for (std::size_t i = 0; i < c.u.size(); ++i)
      known.scattered.push_back(exact_values(patch, c.u[i], c.v[i], c.side, 2));
    for (const double u : c.grid_u)
      for (const double v : c.grid_v) known.grid.push_back(exact_values(patch, u, v, c.side, 2));
  });
  return out;
}

std::vector<KnownCurve> with_truth(std::vector<CurveCase> cases) {
  std::vector<KnownCurve> out(cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t k) {
    out[k].data = std::move(cases[k]);
    const BsplineCurve<Rational, 4> curve = exact_curve(out[k].data.data());
    for (const double t : out[k].data.t) out[k].values.push_back(exact_values(curve, t, out[k].data.side, 2));
  });
  return out;
}

Rational ulp(const Rational& x) {
  const double nearest = std::abs(nearest_double(x));
  if (std::isinf(nearest)) return two_to(1023 - 52);
  return two_to(nearest < std::numeric_limits<double>::min() ? -1074 : std::ilogb(nearest) - 52);
}

Deviation deviation(double computed, const Rational& exact) {
  if (!std::isfinite(computed)) return {false, Rational(0)};
  const Rational d = from_double(computed) - exact;
  return {true, d < Rational(0) ? Rational(-d) : d};
}

double in_ulps(const Deviation& d, const Rational& x) {
  if (!d.is_finite) return std::numeric_limits<double>::infinity();
  return std::min(nearest_double(Rational(d.modulus / ulp(x))), std::numeric_limits<double>::max());
}

Rational largest_coordinate(const ExactVector& v) {
  Rational largest(0);
  for (const Rational& x : v.c) {
    const Rational modulus = x < Rational(0) ? Rational(-x) : x;
    if (modulus > largest) largest = modulus;
  }
  return largest;
}

bool overflows(const Rational& x) { return std::isinf(nearest_double(x)); }

}  // namespace patchproof::validation
