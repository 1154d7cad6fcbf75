// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gregory_approximate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/gregory_expand.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/tensor_form.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/power_series.h"

namespace patchproof {
namespace {

constexpr int kDepth = 2, kCornerDepth = 9;  // of the halvings of a cell, away from (0, 0) and towards it

double largest(const std::vector<Vec<Interval, 1>>& numbers) {
  double out = 0;
  for (const Vec<Interval, 1>& x : numbers) out = std::max({out, -x[0].inf(), x[0].sup()});
  return out;
}

// B-spline coefficients of the interpolant: four around each node, those beyond the ends left out.
BsplinePatch<Rational, 1> hermite(int cells) {
  using Series = PowerSeries<Rational, 2>;
  const Rational h(1, cells);
  const int count = 2 * cells + 2;
  std::vector<Vec<Rational, 1>> net(static_cast<std::size_t>(count) * count);
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      if (i == 0 && j == 0) continue;
      const Series x = Series::variable(0, i * h, 2), y = Series::variable(1, j * h, 2), one(Rational(1));
      const Series half(Rational(1, 2)), nine(Rational(9)), a = one - x, b = one - y;
      const Series g = nine * (x * y) * (a * a) * (b * b) * (x * x / (x * x + y * y) - half);
      for (const int s : {-1, 1})
        for (const int t : {-1, 1}) {
          // The first and the last coefficient are the ends' values.
          const bool end_u = (i == 0 && s < 0) || (i == cells && s > 0),
                     end_v = (j == 0 && t < 0) || (j == cells && t > 0);
          const Rational du = end_u ? Rational(0) : Rational(s * h / 3), dv = end_v ? Rational(0) : Rational(t * h / 3);
          const int row = std::clamp(2 * i + (s > 0), 0, count - 1), column = std::clamp(2 * j + (t > 0), 0, count - 1);
          net[static_cast<std::size_t>(row) * count + column][0] = g.derivative({0, 0}) + du * g.derivative({1, 0}) +
                                                                   dv * g.derivative({0, 1}) +
                                                                   du * dv * g.derivative({1, 1});
        }
    }
  std::vector<Rational> knots(4, Rational(0));
  for (int i = 1; i < cells; ++i) knots.insert(knots.end(), 2, i * h);
  knots.insert(knots.end(), 4, Rational(1));
  const auto t = KnotVector<Rational>::make_unchecked(3, std::move(knots));
  return {t, t, std::move(net)};
}

// max |numerator| / (2 s^power) over a cell, s = x² + y²; in the box at (0, 0) `crude` of its side.
// 2 s (g − H) and 2 s² (g − H)_x are the numerators.
template <class Crude>
double quotient_bound(const BezierPatch<Interval, 1>& numerator, int power, const Rational& x0, const Rational& y0,
                      const Rational& side, int depth, const Crude& crude) {
  const bool at_corner = x0 == 0 && y0 == 0;
  if (at_corner && depth == kCornerDepth) return crude(side);
  // Small beside its distance from (0, 0), so that s is nearly constant.
  if (depth >= kDepth && 6 * side <= std::max(x0, y0)) {
    const Interval s = enclose(Rational(x0 * x0 + y0 * y0));
    return (Interval(largest(numerator.net())) / (Interval(2) * (power == 1 ? s : s * s))).sup();
  }
  const auto [left, right] = split(numerator, Direction::u, Interval(0.5));
  double out = 0;
  const Rational half = side / 2;
  for (const int i : {0, 1}) {
    const auto [low, high] = split(i == 0 ? left : right, Direction::v, Interval(0.5));
    for (const int j : {0, 1})
      out = std::max(out, quotient_bound(j == 0 ? low : high, power, Rational(x0 + i * half), Rational(y0 + j * half),
                                         half, depth + 1, crude));
  }
  return out;
}

BezierPatch<Interval, 1> enclosed(const TensorForm<Rational>& form) {
  std::vector<Vec<Interval, 1>> net;
  for (const Rational& b : form.bernstein()) net.push_back({{enclose(b)}});
  return BezierPatch<Interval, 1>(form.degree_u(), form.degree_v(), std::move(net));
}

}  // namespace

BlendSpline BlendSpline::make(int cells) {
  PATCHPROOF_REQUIRES(1 <= cells && cells <= 64, "BlendSpline: 1 to 64 cells");
  BlendSpline out(cells, hermite(cells));
  const RoundingGuard guard;
  using Form = TensorForm<Rational>;
  using Binary = BinaryForm<Rational>;
  const Binary one = Binary::constant(Rational(1));
  for (const PatchPiece<Rational, 1, Rational>& piece : extract_bezier(out.spline_)) {
    const Rational &x0 = piece.box.u_begin, &y0 = piece.box.v_begin, side = piece.box.u_end - x0;
    const auto line = [](const Rational& a, const Rational& b) { return Binary::from_bernstein({a, b}); };
    const Binary bx = line(x0, x0 + side), by = line(y0, y0 + side), ax = line(1 - x0, 1 - x0 - side),
                 ay = line(1 - y0, 1 - y0 - side);
    const Form xx(bx * bx, one), yy(one, by * by), s = xx + yy, two = Form::constant(Rational(2));
    const Form product = Form::constant(Rational(9)) * Form(bx * ax * ax, by * ay * ay);
    const Form spline = Form::from_bernstein(piece.bezier, 0);
    const Form n = product * (xx - yy) - two * (s * spline);
    std::vector<Vec<Rational, 1>> net;
    for (const Rational& b : n.bernstein()) net.push_back({{b}});
    const BezierPatch<Rational, 1> dn =
        derivative_patch(BezierPatch<Rational, 1>(n.degree_u(), n.degree_v(), std::move(net)), Direction::u);
    const Form slope =
        Form::constant(Rational(1 / side)) * (Form::from_bernstein(dn, 0) * s) - two * (Form(bx, one) * n);
    // H on the box at (0, 0), by its Bernstein coefficients there.
    const auto of_spline = [&](bool derivative) {
      return [&, derivative](const Rational& r) {
        BezierPatch<Rational, 1> part = restrict(restrict(piece.bezier, Direction::u, Rational(0), Rational(r / side)),
                                                 Direction::v, Rational(0), Rational(r / side));
        if (derivative) part = derivative_patch(part, Direction::u);
        Rational m(0);
        for (const Vec<Rational, 1>& b : part.net()) m = std::max(m, Rational(abs(b[0])));
        const Rational of_g = derivative ? Rational(9 * (r + r * r)) : Rational(Rational(34, 25) * r * r);
        return enclose(Rational(of_g + (derivative ? Rational(m / r) : m))).sup();
      };
    };
    out.value_.push_back(quotient_bound(enclosed(n), 1, x0, y0, side, 0, of_spline(false)));
    out.slope_.push_back(quotient_bound(enclosed(slope), 2, x0, y0, side, 0, of_spline(true)));
  }
  return out;
}

namespace {

using IntervalVector = Vec<Interval, 3>;

template <ExactField T>
IntervalVector enclosed(const Vec<T, 4>& p) {
  return {{enclose(p[0]), enclose(p[1]), enclose(p[2])}};
}

double length_of(const IntervalVector& p) { return sqrt(square(p[0]) + square(p[1]) + square(p[2])).sup(); }

IntervalVector hull_of(const std::vector<IntervalVector>& points) {
  IntervalVector out = points[0];
  for (const IntervalVector& p : points)
    for (std::size_t c = 0; c < 3; ++c)
      out[c] = Interval(std::min(out[c].inf(), p[c].inf()), std::max(out[c].sup(), p[c].sup()));
  return out;
}

// |d_pq| of the quadrants, and what they make of a cell.
struct Differences {
  std::array<std::array<double, 2>, 2> length;
  struct Deviation {
    Interval point, du, dv;
  };
  Deviation on_cell(const BlendSpline& blend, int i, int j) const {
    Deviation out;
    const int last = blend.cells() - 1;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        const Interval d(length[p][q]);
        const int x = p == 0 ? i : last - i, y = q == 0 ? j : last - j;
        out.point += d * Interval(blend.value(x, y));
        out.du += d * Interval(blend.slope(x, y));
        out.dv += d * Interval(blend.slope(y, x));
      }
    return out;
  }
};

// Largest angle between the normals of S~ and of S, whose derivatives differ by no more than `du` and `dv`.
class AngleBound {
 public:
  explicit AngleBound(int max_boxes) : left_(max_boxes) {}

  // An upper bound of the sine over the box, or nothing.
  std::optional<double> sine(const BezierPatch<Interval, 3>& su, const BezierPatch<Interval, 3>& sv, double du,
                             double dv, int depth) {
    if (left_-- <= 0) return std::nullopt;
    const IntervalVector u = hull_of(su.net()), v = hull_of(sv.net());
    if (depth >= 2) {
      const IntervalVector n = cross(u, v);
      IntervalVector middle;
      for (std::size_t c = 0; c < 3; ++c) {
        const double m = n[c].inf() / 2 + n[c].sup() / 2;
        if (!std::isfinite(m)) return std::nullopt;
        middle[c] = Interval(m);
      }
      const Interval along = dot(middle, n);
      const double of_middle = length_of(middle);
      if (of_middle > 0 && along.inf() > 0) {
        const Interval shortest = Interval(along.inf()) / Interval(of_middle);
        const Interval change =
            Interval(du) * Interval(length_of(v)) + Interval(dv) * Interval(length_of(u)) + Interval(du) * Interval(dv);
        const double sine = (Interval(change.sup()) / Interval(shortest.inf())).sup();
        // Good enough when it is near what points in the middle give.
        const double expected = (du * length(v) + dv * length(u)) / of_middle;
        if (sine < 1 && (sine < 1.2 * expected || depth >= 8)) return sine;
      }
    }
    if (depth >= 12) return std::nullopt;
    const auto [u0, u1] = split(su, depth % 2 == 0 ? Direction::u : Direction::v, Interval(0.5));
    const auto [v0, v1] = split(sv, depth % 2 == 0 ? Direction::u : Direction::v, Interval(0.5));
    const auto low = sine(u0, v0, du, dv, depth + 1);
    if (!low) return low;
    const auto high = sine(u1, v1, du, dv, depth + 1);
    if (!high) return high;
    return std::max(*low, *high);
  }

 private:
  // Of the middle.
  static double length(const IntervalVector& p) {
    double out = 0;
    for (std::size_t c = 0; c < 3; ++c) out = std::hypot(out, p[c].inf() / 2 + p[c].sup() / 2);
    return out;
  }
  int left_;
};

// Knots in the degree `degree` on which splines on all of these knots can be written.
template <ExactField T>
KnotVector<T> common_knots(int degree, const std::vector<const KnotVector<T>*>& all) {
  std::map<T, int> smooth;
  for (const KnotVector<T>* knots : all)
    for (const T& t : knots->breaks()) {
      const int continuity = knots->degree() - knots->multiplicity(t);
      const auto [at, is_new] = smooth.emplace(t, continuity);
      if (!is_new) at->second = std::min(at->second, continuity);
    }
  std::vector<T> out;
  for (const auto& [t, continuity] : smooth)
    out.insert(out.end(), t == T(0) || t == T(1) ? degree + 1 : degree - continuity, t);
  return KnotVector<T>::make_unchecked(degree, std::move(out));
}

template <ExactField T, std::size_t N>
BsplinePatch<T, N> on_knots(BsplinePatch<T, N> s, const KnotVector<T>& u, const KnotVector<T>& v) {
  for (const Direction d : {Direction::u, Direction::v}) {
    const KnotVector<T>& knots = d == Direction::u ? u : v;
    if (knots.degree() > s.degree(d)) s = elevate_degree(s, d, knots.degree() - s.degree(d));
    s = refine(s, d, knots);
  }
  return s;
}

}  // namespace

template <ExactField T>
Result<ApproximatedGregory<T>> approximate(const GregoryPatch<T>& patch, const BlendSpline& blend, int max_boxes) {
  for (const auto* surface : {&patch.u_surface(), &patch.v_surface()})
    for (const Vec<T, 4>& p : surface->net())
      if (!(p[3] == T(1)))
        return Error{
            ErrorCode::unsupported, "",
            "a Gregory patch with weights has no approximation that keeps its edges; only patchproof JSON holds it",
            ""};
  PATCHPROOF_REQUIRES(corners_agree(patch), "approximate: the corners of the Gregory patch agree");
  std::array<std::array<Vec<T, 4>, 2>, 2> d;
  bool blended = false;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      d[p][q] = patch.from_u()[1 + p][1 + q] - patch.from_v()[1 + p][1 + q];
      blended = blended || !(d[p][q] == Vec<T, 4>{});
    }
  // H in the scalar of the patch.
  const auto to_scalar = [](const KnotVector<Rational>& knots) {
    std::vector<T> out;
    for (const Rational& t : knots.knots()) out.push_back(embed<T>(t));
    return KnotVector<T>::make_unchecked(knots.degree(), std::move(out));
  };
  const KnotVector<T> cells = to_scalar(blend.spline().knots(Direction::u)), cubic = KnotVector<T>::bezier(3);
  const auto all_knots = [&](const KnotVector<T>& rows) {
    std::vector<const KnotVector<T>*> all{&rows, &cubic};
    if (blended) all.push_back(&cells);
    return common_knots(std::max(3, rows.degree()), all);
  };
  const KnotVector<T> along_u = all_knots(patch.v_surface().knots(Direction::u)),
                      along_v = all_knots(patch.u_surface().knots(Direction::v));
  std::vector<Vec<T, 4>> mean;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) mean.push_back(T(1) / T(2) * (patch.from_u()[i][j] + patch.from_v()[i][j]));
  std::vector<Vec<T, 4>> net = on_knots(patch.u_surface(), along_u, along_v).net();
  const auto of_v = on_knots(patch.v_surface(), along_u, along_v);
  const auto of_c = on_knots(BsplinePatch<T, 4>(cubic, cubic, std::move(mean)), along_u, along_v);
  for (std::size_t k = 0; k < net.size(); ++k) net[k] = net[k] + of_v.net()[k] - of_c.net()[k];
  if (blended) {
    const int count = blend.spline().count(Direction::u);
    std::vector<Vec<T, 4>> sum(static_cast<std::size_t>(count) * count);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        for (int p = 0; p < 2; ++p)
          for (int q = 0; q < 2; ++q) {
            const Rational& b = blend.spline().point(p == 0 ? i : count - 1 - i, q == 0 ? j : count - 1 - j)[0];
            sum[static_cast<std::size_t>(i) * count + j] += embed<T>(b) * d[p][q];
          }
    const auto of_h = on_knots(BsplinePatch<T, 4>(cells, cells, std::move(sum)), along_u, along_v);
    for (std::size_t k = 0; k < net.size(); ++k) net[k] = net[k] - of_h.net()[k];
  }
  ApproximatedGregory<T> out{BsplinePatch<T, 4>(along_u, along_v, std::move(net)), 0, 0.0};
  if (!blended) return out;

  const RoundingGuard guard;
  Differences differences;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) differences.length[p][q] = length_of(enclosed(d[p][q]));
  for (int i = 0; i < blend.cells(); ++i)
    for (int j = 0; j < blend.cells(); ++j)
      out.point_deviation = std::max(out.point_deviation, differences.on_cell(blend, i, j).point.sup());
  AngleBound angle(max_boxes);
  double sine = 0;
  for (const PatchPiece<T, 4, T>& piece : extract_bezier(out.surface)) {
    const auto cell = [&](const T& t) {
      return std::clamp(static_cast<int>(nearest_double(T(t * T(blend.cells())))), 0, blend.cells() - 1);
    };
    const auto derivative = [&](Direction direction, const T& length) {
      const Interval factor = enclose(T(T(1) / length));
      const BezierPatch<T, 4> exact = derivative_patch(piece.bezier, direction);
      std::vector<IntervalVector> points;
      for (const Vec<T, 4>& p : exact.net()) points.push_back(factor * enclosed(p));
      return BezierPatch<Interval, 3>(exact.degree(Direction::u), exact.degree(Direction::v), std::move(points));
    };
    // The middle of a piece lies inside a cell.
    const T half = T(1) / T(2);
    const auto deviation = differences.on_cell(blend, cell(half * (piece.box.u_begin + piece.box.u_end)),
                                               cell(half * (piece.box.v_begin + piece.box.v_end)));
    const auto of_piece = angle.sine(derivative(Direction::u, piece.box.u_end - piece.box.u_begin),
                                     derivative(Direction::v, piece.box.v_end - piece.box.v_begin), deviation.du.sup(),
                                     deviation.dv.sup(), 0);
    if (!of_piece) {
      out.normal_angle = std::nullopt;
      return out;
    }
    sine = std::max(sine, *of_piece);
  }
  // arcsin s ≤ s π/2, and ≤ tan arcsin s.
  const Interval s(sine);
  const double by_pi = (s * Interval(1.5707963267948968)).sup();
  const double by_tan = sine < 1 ? (s / sqrt(Interval((Interval(1) - s * s).inf()))).sup() : by_pi;
  out.normal_angle = std::min(by_pi, by_tan);
  return out;
}

template Result<ApproximatedGregory<Rational>> approximate(const GregoryPatch<Rational>&, const BlendSpline&, int);
template Result<ApproximatedGregory<Quadratic>> approximate(const GregoryPatch<Quadratic>&, const BlendSpline&, int);

}  // namespace patchproof
