// SPDX-License-Identifier: Apache-2.0
#include "kernels/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/error_bounds.h"
#include "patchproof/scalar/double_double.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/power_form.h"

namespace patchproof::kernels {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Powers of two within 2^±kLargestExponent of spans keep all factors of second derivatives finite.
constexpr int kLargestExponent = 500;
// The denominator needs no watching where the smallest weight of a piece is that many times its rounding errors.
constexpr double kSafeMargin = 4;

Error bad_number(std::string where, std::string message, double value) {
  return Error{ErrorCode::bad_number, std::move(where), std::move(message), number_text(value)};
}

std::optional<Error> first_not_finite(std::span<const double> numbers, const char* name) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i]))
      return bad_number(std::string(name) + "[" + std::to_string(i) + "]", "the number is not finite", numbers[i]);
  return std::nullopt;
}

Result<KnotVector<double>> checked_knots(int degree, std::span<const double> knots, const char* name) {
  if (auto error = first_not_finite(knots, name)) return *error;
  auto made = KnotVector<double>::make(degree, {knots.begin(), knots.end()});
  if (made) return made;
  Error error = made.error();
  error.where = name;
  return error;
}

std::optional<Error> wrong_count(const char* name, std::size_t have, std::size_t need) {
  if (have == need) return std::nullopt;
  return Error{ErrorCode::wrong_count, name, "the knots need " + std::to_string(need) + " numbers",
               std::to_string(have)};
}

// index(t) as locate.h computes it.
std::int64_t bucket_of(const Axis& a, double t) { return static_cast<std::int64_t>((t - a.begin) * a.per_unit); }

void make_buckets(Axis& a) {
  constexpr int kMostSteps = 2;
  constexpr int kUsualMost = 1 << 14;
  for (std::int64_t buckets = 4;; buckets *= 2) {
    if (buckets < 2 * std::int64_t{a.count}) continue;
    a.per_unit = static_cast<double>(buckets) / (a.end - a.begin);
    a.first.assign(static_cast<std::size_t>(buckets) + 2, 0);
    // first[b]: the last span that begins in an earlier bucket. Those that begin in bucket b are the steps.
    a.steps = 0;
    int s = 0;
    for (std::size_t b = 0; b < a.first.size(); ++b) {
      a.first[b] = s;
      while (s + 1 < a.count && bucket_of(a, a.right[s + 1]) == static_cast<std::int64_t>(b)) ++s;
      a.steps = std::max(a.steps, static_cast<int>(s - a.first[b]));
    }
    if (a.steps <= kMostSteps || buckets >= kUsualMost) return;
  }
}

Result<Axis> make_axis(const KnotVector<double>& knots, const char* name) {
  Axis a;
  a.degree = knots.degree();
  a.begin = knots.domain_begin();
  a.end = knots.domain_end();
  if (!std::isfinite(a.end - a.begin)) return bad_number(name, "the domain is too long for double", a.end);
  for (int i = a.degree; i < knots.control_count(); ++i) {
    const double from = knots[i], to = knots[i + 1];
    if (!(from < to)) continue;
    const double centre = from + (to - from) / 2, half = std::max(centre - from, to - centre);
    int exponent;
    std::frexp(half, &exponent);
    if (std::abs(exponent) > kLargestExponent)
      return bad_number(std::string(name) + "[" + std::to_string(i) + "]",
                        "the span that begins here is too short or too long for derivatives in double", to - from);
    a.knot_span.push_back(i);
    a.centre.push_back(centre);
    a.scale.push_back(std::ldexp(1.0, -exponent));
    a.reach.push_back(std::ldexp(half, -exponent));
    a.right.push_back(from);
    a.left.push_back(a.count == 0 ? from : std::nextafter(from, kInfinity));
    ++a.count;
  }
  a.right.push_back(kInfinity);
  a.left.push_back(kInfinity);
  make_buckets(a);
  return a;
}

// M of each span: see power_form.h.
std::vector<std::vector<DoubleDouble>> matrices(const KnotVector<double>& knots, const Axis& a) {
  std::vector<std::vector<DoubleDouble>> out;
  for (int s = 0; s < a.count; ++s)
    out.push_back(basis_power_form<DoubleDouble>(knots, a.knot_span[s], a.centre[s], a.scale[s]));
  return out;
}

// Homogeneous control points, weights scaled by a power of two to at most 1.
struct Net {
  std::vector<DoubleDouble> numbers;  // x y z w of each
  std::vector<double> weight;
};

Result<Net> make_net(std::span<const double> points, std::span<const double> weights) {
  Net net;
  const std::size_t count = points.size() / 3;
  double largest = 0;
  for (const double w : weights) largest = std::max(largest, std::fabs(w));
  if (!weights.empty() && largest == 0) return bad_number("weights", "all weights are zero", 0);
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weights.empty() ? 1 : std::ldexp(weights[i], -exponent);
    // Scaled down, the smallest weights may lose digits to underflow.
    const bool exact = weights.empty() || std::ldexp(w, exponent) == weights[i];
    const DoubleDouble factor(w, 0, exact ? 0 : std::numeric_limits<double>::denorm_min());
    for (int k = 0; k < 3; ++k) {
      net.numbers.push_back(weights.empty() ? DoubleDouble(points[3 * i + k])
                                            : DoubleDouble(points[3 * i + k]) * factor);
      if (!std::isfinite(net.numbers.back().error()))
        return bad_number("points[" + std::to_string(3 * i + k) + "]", "the number overflows", points[3 * i + k]);
    }
    net.numbers.push_back(factor);
    net.weight.push_back(exact ? w : 0);  // a lower bound is wanted
  }
  return net;
}

PointMagnitude magnitude_of(const double* high, const double* error, double smallest_weight) {
  const auto of = [&](int k) { return Magnitude(std::fabs(high[k]), error[k]); };
  PointMagnitude out{of(0), of(3), smallest_weight};
  for (int k = 1; k < 3; ++k) {
    out.coordinate.size = std::max(out.coordinate.size, of(k).size);
    out.coordinate.error = std::max(out.coordinate.error, of(k).error);
  }
  return out;
}

// |x| ≤ reach, rounded once.
Magnitude local_parameter(double reach) { return Magnitude(reach, kUnitRoundoff * reach); }

// A power of two that brings a number of this size near 1.
double near_one(double size) {
  int exponent = 0;
  if (size > 0 && std::isfinite(size)) std::frexp(size, &exponent);
  return std::ldexp(1.0, -exponent);
}

template <class Jet>
void keep_bounds(const Jet& jet, int count, PieceBounds& out) {
  for (int m = 0; m < count; ++m) {
    const double e = jet.d[m].coordinate.error;
    out.error[m] = std::isfinite(e) ? e : kInfinity;
  }
}

}  // namespace

std::string number_text(double x) {
  return std::isfinite(x) ? to_text(x) : std::isnan(x) ? "NaN" : x > 0 ? "infinity" : "-infinity";
}

Result<SurfacePieces> prepare(const SurfaceData& data) {
  const auto knots_u = checked_knots(data.degree_u, data.knots_u, "knots_u");
  if (!knots_u) return knots_u.error();
  const auto knots_v = checked_knots(data.degree_v, data.knots_v, "knots_v");
  if (!knots_v) return knots_v.error();
  const int nu = knots_u->control_count(), nv = knots_v->control_count();
  const std::size_t count = static_cast<std::size_t>(nu) * nv;
  if (auto error = wrong_count("points", data.points.size(), 3 * count)) return *error;
  if (!data.weights.empty())
    if (auto error = wrong_count("weights", data.weights.size(), count)) return *error;
  if (auto error = first_not_finite(data.points, "points")) return *error;
  if (auto error = first_not_finite(data.weights, "weights")) return *error;
  auto axis_u = make_axis(*knots_u, "knots_u"), axis_v = make_axis(*knots_v, "knots_v");
  if (!axis_u) return axis_u.error();
  if (!axis_v) return axis_v.error();
  const auto net = make_net(data.points, data.weights);
  if (!net) return net.error();

  SurfacePieces s;
  s.u = std::move(*axis_u);
  s.v = std::move(*axis_v);
  s.rational = !data.weights.empty();
  const int p = s.u.degree, q = s.v.degree, order_u = p + 1, order_v = q + 1, numbers = s.rational ? 4 : 3;
  s.row = 8 * order_u;
  s.piece = static_cast<std::size_t>(s.row) * ((q + 2) / 2);
  const std::size_t pieces = static_cast<std::size_t>(s.u.count) * s.v.count;
  s.high = Coefficients(pieces * s.piece);
  s.low = Coefficients(pieces * s.piece);
  s.bounds.resize(pieces);
  const auto in_u = matrices(*knots_u, s.u), in_v = matrices(*knots_v, s.v);

  std::vector<DoubleDouble> rows(static_cast<std::size_t>(order_u) * nv * 4);  // Σ_a M_ia P_a,b
  std::vector<double> errors(s.piece);
  for (int a = 0; a < s.u.count; ++a) {
    const int first_u = s.u.knot_span[a] - p;
    for (int i = 0; i < order_u; ++i)
      for (int b = 0; b < nv; ++b)
        for (int k = 0; k < numbers; ++k) {
          DoubleDouble sum(0);
          for (int r = 0; r < order_u; ++r)
            sum += in_u[a][i * order_u + r] * net->numbers[(static_cast<std::size_t>(first_u + r) * nv + b) * 4 + k];
          rows[(static_cast<std::size_t>(i) * nv + b) * 4 + k] = sum;
        }
    for (int b = 0; b < s.v.count; ++b) {
      const int first_v = s.v.knot_span[b] - q;
      const std::size_t number = static_cast<std::size_t>(a) * s.v.count + b;
      double *high = s.high.data() + number * s.piece, *low = s.low.data() + number * s.piece;
      PieceBounds& bounds = s.bounds[number];
      double sum_of_moduli[4]{}, sum_of_errors[4]{};
      std::fill(errors.begin(), errors.end(), 0.0);
      for (int i = 0; i < order_u; ++i)
        for (int j = 0; j < order_v; ++j) {
          const std::size_t at = s.at(i, j);
          const double size = std::pow(s.u.reach[a], i) * std::pow(s.v.reach[b], j) * kBoundSlack;
          double largest = 0, largest_error = 0;
          for (int k = 0; k < numbers; ++k) {
            DoubleDouble sum(0);
            for (int r = 0; r < order_v; ++r)
              sum += in_v[b][j * order_v + r] * rows[(static_cast<std::size_t>(i) * nv + first_v + r) * 4 + k];
            if (!std::isfinite(sum.error()))
              return bad_number("points", "the surface's derivatives overflow", sum.high());
            high[at + k] = sum.high();
            low[at + k] = sum.low();
            errors[at + k] = std::fabs(sum.low()) + sum.error();
            largest = std::max(largest, std::fabs(sum.high()));
            largest_error = std::max(largest_error, sum.error());
            sum_of_moduli[k] += std::fabs(sum.high()) * size + (sum.high() != 0 ? kUnderflow : 0);
            sum_of_errors[k] += sum.error() * size + (sum.error() != 0 ? kUnderflow : 0);
          }
          // The fourth number of a piece without weights: the term of its pointwise bound.
          if (!s.rational) high[at + 3] = (gamma(3 * (i + j) + 3) * largest + largest_error) * kBoundSlack + kUnderflow;
        }
      for (int k = 0; k < numbers; ++k)
        bounds.compensated[k] = compensated_error(p + q + 2, sum_of_moduli[k], sum_of_errors[k]);

      double smallest_weight = kInfinity;
      for (int i = 0; i < order_u; ++i)
        for (int j = 0; j < order_v; ++j)
          smallest_weight =
              std::min(smallest_weight, net->weight[static_cast<std::size_t>(first_u + i) * nv + first_v + j]);
      const Magnitude x = local_parameter(s.u.reach[a]), y = local_parameter(s.v.reach[b]);
      HornerRows<2, PointMagnitude> sums;
      for (int j = q; j >= 0; --j) {
        Horner<2, PointMagnitude> row;
        for (int i = p; i >= 0; --i)
          row.push(p - i, magnitude_of(high + s.at(i, j), errors.data() + s.at(i, j), smallest_weight), x);
        sums.push(q - j, row.d, y);
      }
      const auto jet = surface_jet<2>(sums, PowerOfTwo(s.u.scale[a]), PowerOfTwo(s.v.scale[b]));
      bounds.numerator_error = jet.d[0].coordinate.error;
      bounds.weight_error = jet.d[0].weight.error;
      const auto affine = s.rational ? quotient<2>(jet) : jet;
      keep_bounds(affine, 6, bounds);
      // The size of S_u: its bound, or without one (a denominator near zero) that of the numerator.
      const auto size = [&](int m) {
        const double bound = affine.d[m].coordinate.size;
        return std::isfinite(bound) ? bound : jet.d[m].coordinate.size;
      };
      bounds.normal_scale_u = near_one(size(1));
      bounds.normal_scale_v = near_one(size(2));
      s.safe_weights = s.safe_weights && (!s.rational || smallest_weight > kSafeMargin * bounds.weight_error);
    }
  }
  s.knots_u.assign(data.knots_u.begin(), data.knots_u.end());
  s.knots_v.assign(data.knots_v.begin(), data.knots_v.end());
  s.points.assign(data.points.begin(), data.points.end());
  s.weights.assign(data.weights.begin(), data.weights.end());
  return s;
}

Result<CurvePieces> prepare(const CurveData& data) {
  const auto knots = checked_knots(data.degree, data.knots, "knots");
  if (!knots) return knots.error();
  const std::size_t count = static_cast<std::size_t>(knots->control_count());
  if (auto error = wrong_count("points", data.points.size(), 3 * count)) return *error;
  if (!data.weights.empty())
    if (auto error = wrong_count("weights", data.weights.size(), count)) return *error;
  if (auto error = first_not_finite(data.points, "points")) return *error;
  if (auto error = first_not_finite(data.weights, "weights")) return *error;
  auto axis = make_axis(*knots, "knots");
  if (!axis) return axis.error();
  const auto net = make_net(data.points, data.weights);
  if (!net) return net.error();

  CurvePieces c;
  c.t = std::move(*axis);
  c.rational = !data.weights.empty();
  const int p = c.t.degree, order = p + 1;
  c.high = Coefficients(c.piece() * c.t.count);
  c.bounds.resize(c.t.count);
  const auto basis = matrices(*knots, c.t);
  std::vector<double> errors(c.piece());
  for (int s = 0; s < c.t.count; ++s) {
    double* high = c.high.data() + s * c.piece();
    PieceBounds& bounds = c.bounds[s];
    double smallest_weight = kInfinity;
    for (int i = 0; i < order; ++i) {
      smallest_weight = std::min(smallest_weight, net->weight[c.t.knot_span[s] - p + i]);
      for (int k = 0; k < (c.rational ? 4 : 3); ++k) {
        DoubleDouble sum(0);
        for (int r = 0; r < order; ++r)
          sum += basis[s][i * order + r] * net->numbers[static_cast<std::size_t>(c.t.knot_span[s] - p + r) * 4 + k];
        if (!std::isfinite(sum.error())) return bad_number("points", "the curve's derivatives overflow", sum.high());
        high[4 * i + k] = sum.high();
        errors[4 * i + k] = std::fabs(sum.low()) + sum.error();
      }
    }
    const Magnitude x = local_parameter(c.t.reach[s]);
    Horner<2, PointMagnitude> h;
    for (int i = p; i >= 0; --i) h.push(p - i, magnitude_of(high + 4 * i, errors.data() + 4 * i, smallest_weight), x);
    const auto jet = curve_jet<2>(h, PowerOfTwo(c.t.scale[s]));
    bounds.numerator_error = jet.d[0].coordinate.error;
    bounds.weight_error = jet.d[0].weight.error;
    keep_bounds(c.rational ? quotient<2>(jet) : jet, 3, bounds);
    c.safe_weights = c.safe_weights && (!c.rational || smallest_weight > kSafeMargin * bounds.weight_error);
  }
  c.knots.assign(data.knots.begin(), data.knots.end());
  c.points.assign(data.points.begin(), data.points.end());
  c.weights.assign(data.weights.begin(), data.weights.end());
  return c;
}

}  // namespace patchproof::kernels
