// SPDX-License-Identifier: Apache-2.0
// One side of a trimmed join on a part of the edge: Taylor models of its parameters, points and normals, on each polynomial
// that may be meant; and what its normal does at the ends of the edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "patchproof/deadline.h"
#include "patchproof/join/trimmed_join.h"
#include "patchproof/patch/affine.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/power_series.h"
#include "patchproof/scalar/taylor_model.h"

namespace patchproof::trimmed {

constexpr int kOrder = 7;
using Model = TaylorModel<kOrder>;
using ParameterCurve = BsplineCurve<Rational, 3>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline bool has_unit_weights(const ParameterCurve& curve) {
  return std::all_of(curve.points().begin(), curve.points().end(), [](const auto& p) { return p[2] == Rational(1); });
}

// What the Taylor models of a side are taken of: a spline, or a GERBS surface, whose cells between breaks stand for spans.
class Surface {
 public:
  Surface(const TrimmedSide& side, const AffineMap<Rational>& move) {
    if (!side.gerbs) {
      const BsplinePatch<Rational, 4> patch = apply(move, *side.surface);
      std::vector<Vec<Interval, 4>> net;
      for (const auto& p : patch.net()) net.push_back({{enclose(p[0]), enclose(p[1]), enclose(p[2]), enclose(p[3])}});
      spline_.emplace(patch.knots(Direction::u), patch.knots(Direction::v), std::move(net));
      return;
    }
    gerbs_ = side.gerbs->map_locals(
        [&](const auto& local) { return local.map_points([&](const Vec<Rational, 4>& p) { return apply(move, p); }); });
    for (const Direction d : {Direction::u, Direction::v}) {
      std::vector<Rational> breaks = gerbs_->breaks(d);
      breaks.insert(breaks.begin(), breaks.front());
      breaks.push_back(breaks.back());
      cells_.push_back(KnotVector<Rational>::make_unchecked(1, std::move(breaks)));
    }
  }

  const KnotVector<Rational>& knots(Direction d) const {
    return spline_ ? spline_->knots(d) : cells_[d == Direction::u ? 0 : 1];
  }
  // Of homogeneous points, on the polynomial or the cell of these spans.
  template <Field R>
  PartialDerivatives<R, 4> derivatives(int span_u, int span_v, const R& u, const R& v, int order) const {
    if (spline_) return partial_derivatives_in_span<R>(*spline_, span_u, span_v, u, v, order, order);
    if constexpr (Transcendental<R>) {
      const auto middle = [](const KnotVector<Rational>& k, int span) {
        return Rational((k[span] + k[span + 1]) / Rational(2));
      };
      const auto points =
          partial_derivatives_at<R>(*gerbs_, {middle(cells_[0], span_u), middle(cells_[1], span_v)},
                                    {patchproof::Side::right, patchproof::Side::right}, u, v, order, order);
      std::vector<Vec<R, 4>> out;
      for (int k = 0; k <= order; ++k)
        for (int l = 0; l <= order; ++l) {
          const Vec<R, 3>& p = points.at(k, l);
          out.push_back({{p[0], p[1], p[2], R(k == 0 && l == 0 ? 1 : 0)}});
        }
      return {order, order, std::move(out)};
    } else {
      PATCHPROOF_REQUIRES(false, "a GERBS surface has no values in this scalar");
      return {0, 0, {}};
    }
  }

 private:
  std::optional<BsplinePatch<Interval, 4, Rational>> spline_;
  std::optional<GerbsSurface<Rational, 4>> gerbs_;
  std::vector<KnotVector<Rational>> cells_;  // of a GERBS surface, in u and v
};

// One side, with its surface moved so that coordinates are as small as the edge allows.
struct MovedSide {
  MovedSide(const TrimmedSide& side, const AffineMap<Rational>& move)
      : surface(side, move),
        curve(&side.parameters),
        flipped(side.flipped),
        polynomial(has_unit_weights(side.parameters)) {}
  Surface surface;
  const ParameterCurve* curve;
  bool flipped, polynomial;
};

inline const Rational& inside(const KnotVector<Rational>& k, const Rational& x) {
  return x < k.domain_begin() ? k.domain_begin() : x > k.domain_end() ? k.domain_end() : x;
}

// A point near the middle of the edge, with short numbers; it moves as the surface does. Coordinates relative to it are not
// rounded again and again in what all points share.
inline Vec<Rational, 3> origin_near(const TrimmedSide& side, const Rational& t) {
  const Vec<double, 3> h =
      evaluate_in_span<double>(side.parameters, side.parameters.knots().find_span(t), nearest_double(t));
  Rational at[2];
  int spans[2];
  for (const Direction d : {Direction::u, Direction::v}) {
    const int i = d == Direction::u ? 0 : 1;
    const KnotVector<Rational>& k = side.surface->knots(d);
    const double x = h[i] / h[2];
    at[i] = inside(k, std::isfinite(x) ? from_double(x) : k.domain_begin());
    spans[i] = k.find_span(at[i]);
  }
  const int p = side.surface->degree(Direction::u), q = side.surface->degree(Direction::v);
  const Vec<Rational, 3> corner = project(side.surface->point(spans[0] - p, spans[1] - q));
  Vec<double, 4> sum;
  const auto basis_u = basis_derivatives_in_span<double>(side.surface->knots(Direction::u), spans[0],
                                                         nearest_double(at[0]), 0),
             basis_v = basis_derivatives_in_span<double>(side.surface->knots(Direction::v), spans[1],
                                                         nearest_double(at[1]), 0);
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) {
      const Vec<Rational, 4>& x = side.surface->point(spans[0] - p + i, spans[1] - q + j);
      const double b = basis_u[0][i] * basis_v[0][j];
      for (int c = 0; c < 3; ++c) sum[c] += b * nearest_double(Rational(x[c] - corner[c] * x[3]));
      sum[3] += b * nearest_double(x[3]);
    }
  Vec<Rational, 3> out = corner;
  for (int c = 0; c < 3; ++c)
    if (const double away = sum[c] / sum[3]; std::isfinite(away)) out[c] = out[c] + from_double(away);
  return out;
}

// The spans of the knots that a parameter in [x.inf, x.sup] may lie in; the outermost ones reach to infinity.
inline std::vector<int> spans_meeting(const KnotVector<Rational>& knots, const Interval& x) {
  const auto clamped = [&](double value) {
    const Rational r = from_double(value);
    return r < knots.domain_begin() ? knots.domain_begin() : r > knots.domain_end() ? knots.domain_end() : r;
  };
  const int first = knots.find_span(clamped(x.inf()), patchproof::Side::left),
            last = knots.find_span(clamped(x.sup()), patchproof::Side::right);
  std::vector<int> out;
  for (int span = first; span <= last; ++span)
    if (knots[span] < knots[span + 1]) out.push_back(span);
  return out;
}

// Where a side runs on a part of the edge: models of u and v, and the spans that they meet.
struct Run {
  Model u, v;
  std::vector<int> spans_u, spans_v;
  std::size_t combinations() const { return spans_u.size() * spans_v.size(); }
};

inline Run run_of(const MovedSide& side, const Model& t, const Rational& inside) {
  const int span = side.curve->knots().find_span(inside);
  const Vec<Model, 3> h = evaluate_in_span<Model>(*side.curve, span, t);
  Run run;
  run.u = side.polynomial ? h[0] : h[0] / h[2];
  run.v = side.polynomial ? h[1] : h[1] / h[2];
  const Interval u = run.u.bernstein_range(), v = run.v.bernstein_range();
  if (!std::isfinite(u.inf()) || !std::isfinite(u.sup()) || !std::isfinite(v.inf()) || !std::isfinite(v.sup()))
    return run;
  run.spans_u = spans_meeting(side.surface.knots(Direction::u), u);
  run.spans_v = spans_meeting(side.surface.knots(Direction::v), v);
  return run;
}

// Enclosures of a side's homogeneous point and of w⁴ times its normal at one parameter, when one polynomial is meant there.
struct EnclosedEnd {
  Vec<Interval, 4> point;
  Vec<Interval, 3> normal;
};
inline std::optional<EnclosedEnd> enclosed_end(const TrimmedSide& side, const Rational& t) {
  const int span = side.parameters.knots().find_span(t);
  const Vec<Interval, 3> h = evaluate_in_span<Interval>(side.parameters, span, enclose(t));
  if (!(h[2].inf() > 0)) return std::nullopt;
  Interval at[2];
  int spans[2];
  for (const Direction d : {Direction::u, Direction::v}) {
    const int i = d == Direction::u ? 0 : 1;
    const KnotVector<Rational>& k = side.surface->knots(d);
    const Interval x = h[i] / h[2], begin = enclose(k.domain_begin()), end = enclose(k.domain_end());
    // As `inside` has it: the nearest parameter in the domain.
    at[i] = Interval(std::min(std::max(x.inf(), begin.inf()), end.inf()),
                     std::max(std::min(x.sup(), end.sup()), begin.sup()));
    const std::vector<int> meeting = spans_meeting(k, at[i]);
    if (meeting.size() != 1) return std::nullopt;
    spans[i] = meeting.front();
  }
  const auto d = partial_derivatives_in_span<Interval>(*side.surface, spans[0], spans[1], at[0], at[1], 1, 1);
  return EnclosedEnd{d.at(0, 0), scaled_normal(d.at(0, 0), d.at(1, 0), d.at(0, 1))};
}

// A homogeneous point and w⁴ times the face's normal.
struct Frame {
  Vec<Model, 4> point;
  Vec<Model, 3> normal;
};
inline std::vector<Frame> frames(const MovedSide& side, const Run& run) {
  std::vector<Frame> out;
  for (const int i : run.spans_u)
    for (const int j : run.spans_v) {
      check_deadline();
      const auto d = side.surface.derivatives<Model>(i, j, run.u, run.v, 1);
      const Vec<Model, 3> n = scaled_normal(d.at(0, 0), d.at(1, 0), d.at(0, 1));
      out.push_back({d.at(0, 0), side.flipped ? -n : n});
    }
  return out;
}

// Encloses the values of n' on a piece, for each combination of spans; seen from the other end where `at_end`.
inline std::vector<Vec<Interval, 3>> normal_rates(const MovedSide& side, const Run& run, const Model& t,
                                                  const Rational& inside, bool at_end) {
  using Series = PowerSeries<Model, 1>;
  const Vec<Series, 3> h =
      evaluate_in_span<Series>(*side.curve, side.curve->knots().find_span(inside), Series::variable(0, t, 1));
  const Series u = side.polynomial ? h[0] : h[0] / h[2], v = side.polynomial ? h[1] : h[1] / h[2];
  std::vector<Vec<Interval, 3>> out;
  for (const int i : run.spans_u)
    for (const int j : run.spans_v) {
      check_deadline();
      const auto d = side.surface.derivatives<Series>(i, j, u, v, 1);
      const Vec<Series, 3> n = scaled_normal(d.at(0, 0), d.at(1, 0), d.at(0, 1));
      Vec<Interval, 3> rate;
      for (int c = 0; c < 3; ++c) rate[c] = n[c].coefficient({1}).bernstein_range();
      out.push_back(side.flipped != at_end ? -rate : rate);
    }
  return out;
}

// w⁴ times the face's normal at the begin or the end of the edge, exactly.
inline Vec<Rational, 3> end_normal(const TrimmedSide& side, const Rational& t) {
  const Vec<Rational, 2> at = evaluate_rational(side.parameters, t);
  const Rational u = inside(side.surface->knots(Direction::u), at[0]),
                 v = inside(side.surface->knots(Direction::v), at[1]);
  const auto d = partial_derivatives(*side.surface, u, v, 1, 1);
  const Vec<Rational, 3> n = scaled_normal(d.at(0, 0), d.at(1, 0), d.at(0, 1));
  return side.flipped ? -n : n;
}

inline Rational square_of(const Vec<Rational, 3>& v) { return dot(v, v); }

// A pole: an end of the edge where a side's normal is zero, or so short beside the one amid the edge that only rounding
// keeps it from zero. Where it is zero, n(t) = (t − t_0) n'(ξ) points as a value of n' does.
struct Pole {
  bool is_one = false;
  bool zero = true;
};
// COST of an ordinary end that of intervals; of a pole, and of what may be one, exact values.
inline Pole pole_at(const TrimmedSide& side, const Rational& end, const Rational& middle) {
  if (side.gerbs) return {};  // no exact values: where its normal vanishes, nothing is known of the angle
  const Rational short_square = from_double(0x1p-60);
  const auto a = enclosed_end(side, end), b = enclosed_end(side, middle);
  if (a && b && dot(a->normal, a->normal).inf() > (Interval(0x1p-60) * dot(b->normal, b->normal)).sup()) return {};
  const Vec<Rational, 3> normal = end_normal(side, end);
  return {square_of(normal) <= short_square * square_of(end_normal(side, middle)), detail::is_zero_point(normal)};
}

}  // namespace patchproof::trimmed
