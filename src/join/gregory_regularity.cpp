// SPDX-License-Identifier: Apache-2.0
// Polynomial patches: S = P + Σ g d (gregory_proof.h).
#include "gregory_regularity.h"

namespace patchproof {
namespace {

using Point4 = Vec<Rational, 4>;
using detail::IntervalVector;

IntervalVector enclose(const Vec<Rational, 3>& p) {
  return {{patchproof::enclose(p[0]), patchproof::enclose(p[1]), patchproof::enclose(p[2])}};
}

// q(s) = a s² + b s over an interval of s in [0, 1], with its vertex looked at.
Interval quadratic(double a, double b, const Interval& s) {
  const auto at = [&](double x) { return Interval(x) * (Interval(a) * Interval(x) + Interval(b)); };
  Interval out = detail::hull(at(s.inf()), at(s.sup()));
  const double vertex = -b / (2 * a);
  if (s.inf() < vertex && vertex < s.sup()) out = detail::hull(out, at(vertex));
  return out;
}

// g_x and g_y over a box of distances from the corner.
std::array<Interval, 2> blend_derivatives(const Interval& x, const Interval& y) {
  const auto share = [](double a, double b) {  // a²/(a² + b²), a > 0
    return square(Interval(a)) / (square(Interval(a)) + square(Interval(b)));
  };
  const double low = y.inf() > 0 ? share(y.inf(), x.sup()).inf() : 0;
  const double high = y.sup() > 0 ? std::min(1.0, share(y.sup(), x.inf()).sup()) : 0;
  const Interval s(std::min(low, high), high);
  const Interval phi = x * y * s, phi_x = y * quadratic(2, -1, s), phi_y = x * quadratic(-2, 3, s);
  const Interval one(1), two(2), nine(9);
  const Interval ax = square(one - x), ay = square(one - y);
  return {nine * ay * (ax * phi_x - two * (one - x) * phi), nine * ax * (ay * phi_y - two * (one - y) * phi)};
}

class Regularity {
 public:
  Regularity(const GregoryPatch<Rational>& patch, int max_boxes, const BoxInspector& inspect)
      : patch_(patch), inspect_(inspect), left_(max_boxes) {
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = 0; q < 2; ++q) {
        const std::size_t i = 1 + p, j = 1 + q;
        const Point4 d = patch.from_u()[i][j] - patch.from_v()[i][j];
        differences_[p][q] = enclose({{d[0], d[1], d[2]}});
      }
  }

  bool run() {
    // Distances from a point of the patch, so that a far origin costs no accuracy.
    const Point4& corner = patch_.u_surface().point(0, 0);
    const Vec<Rational, 3> origin{{corner[0], corner[1], corner[2]}};
    std::vector<Point4> c_points;
    for (const auto& row : patch_.from_u()) c_points.insert(c_points.end(), row.begin(), row.end());
    const BezierPatch<Interval, 3> c = enclosed(BezierPatch<Rational, 4>(3, 3, std::move(c_points)), origin);
    for (const PatchPiece<Rational, 4, Rational>& of_v : extract_bezier(patch_.v_surface()))
      for (const PatchPiece<Rational, 4, Rational>& of_u : extract_bezier(patch_.u_surface())) {
        const ParameterBox<Rational> box{of_v.box.u_begin, of_v.box.u_end, of_u.box.v_begin, of_u.box.v_end};
        const Interval u0 = patchproof::enclose(box.u_begin), u1 = patchproof::enclose(box.u_end),
                       v0 = patchproof::enclose(box.v_begin), v1 = patchproof::enclose(box.v_end);
        if (!cell(box, restrict(enclosed(of_u.bezier, origin), Direction::u, u0, u1),
                  restrict(enclosed(of_v.bezier, origin), Direction::v, v0, v1),
                  restrict(restrict(c, Direction::u, u0, u1), Direction::v, v0, v1)))
          return false;
      }
    return true;
  }
  int left() const { return left_; }
  const Rational& u() const { return stopped_[0]; }
  const Rational& v() const { return stopped_[1]; }

 private:
  // P_u and P_v over a box, scaled to parameters of the whole patch.
  struct Box {
    BezierPatch<Interval, 3> du, dv;
    Rational u_begin, u_end, v_begin, v_end;
  };

  bool cell(const ParameterBox<Rational>& box, BezierPatch<Interval, 3> u, BezierPatch<Interval, 3> v,
            BezierPatch<Interval, 3> c) {
    const int degree_u = std::max(3, v.degree(Direction::u)), degree_v = std::max(3, u.degree(Direction::v));
    for (BezierPatch<Interval, 3>* surface : {&u, &v, &c}) {
      *surface = elevate_degree(*surface, Direction::u, degree_u - surface->degree(Direction::u));
      *surface = elevate_degree(*surface, Direction::v, degree_v - surface->degree(Direction::v));
    }
    std::vector<IntervalVector> net;
    for (std::size_t k = 0; k < c.net().size(); ++k) net.push_back(u.net()[k] + v.net()[k] - c.net()[k]);
    const BezierPatch<Interval, 3> sum(degree_u, degree_v, std::move(net));
    const auto derivative = [&](Direction d, const Rational& length) {
      const Interval factor = patchproof::enclose(Rational(1 / length));
      return map_net(derivative_patch(sum, d), [&](const IntervalVector& p) { return factor * p; });
    };
    return prove({derivative(Direction::u, box.u_end - box.u_begin), derivative(Direction::v, box.v_end - box.v_begin),
                  box.u_begin, box.u_end, box.v_begin, box.v_end});
  }

  template <class T, std::size_t N, class F>
  static BezierPatch<Interval, 3> map_net(const BezierPatch<T, N>& patch, F f) {
    std::vector<IntervalVector> net;
    for (const Vec<T, N>& p : patch.net()) net.push_back(f(p));
    return BezierPatch<Interval, 3>(patch.degree(Direction::u), patch.degree(Direction::v), std::move(net));
  }
  static BezierPatch<Interval, 3> enclosed(const BezierPatch<Rational, 4>& patch, const Vec<Rational, 3>& origin) {
    return map_net(patch, [&](const Point4& p) { return enclose(Vec<Rational, 3>{{p[0], p[1], p[2]}} - origin); });
  }

  bool prove(const Box& box, int halvings = detail::kHalvings) {
    if (left_-- <= 0 || halvings == 0) {
      stopped_ = {box.u_begin, box.v_begin};
      return false;
    }
    const Interval u(patchproof::enclose(box.u_begin).inf(), patchproof::enclose(box.u_end).sup()),
        v(patchproof::enclose(box.v_begin).inf(), patchproof::enclose(box.v_end).sup());
    IntervalVector du = detail::hull_of(box.du.net()), dv = detail::hull_of(box.dv.net());
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = 0; q < 2; ++q) {
        const Interval one(1), x = detail::unit_distance(p == 0 ? u : one - u),
                               y = detail::unit_distance(q == 0 ? v : one - v);
        const auto [gx, gy] = blend_derivatives(x, y);
        du += (p == 0 ? gx : -gx) * differences_[p][q];
        dv += (q == 0 ? gy : -gy) * differences_[p][q];
      }
    if (inspect_) inspect_({box.u_begin, box.u_end, box.v_begin, box.v_end}, du, dv);
    if (detail::is_one_sided(cross(du, dv))) return true;
    // The longer side is halved.
    const double size_u = (box.u_end - box.u_begin).convert_to<double>(),
                 size_v = (box.v_end - box.v_begin).convert_to<double>();
    const Direction d = size_u >= size_v ? Direction::u : Direction::v;
    auto [du_low, du_high] = split(box.du, d, Interval(0.5));
    auto [dv_low, dv_high] = split(box.dv, d, Interval(0.5));
    Box low{std::move(du_low), std::move(dv_low), box.u_begin, box.u_end, box.v_begin, box.v_end};
    Box high{std::move(du_high), std::move(dv_high), box.u_begin, box.u_end, box.v_begin, box.v_end};
    if (d == Direction::u)
      low.u_end = high.u_begin = (box.u_begin + box.u_end) / 2;
    else
      low.v_end = high.v_begin = (box.v_begin + box.v_end) / 2;
    return prove(low, halvings - 1) && prove(high, halvings - 1);
  }
  const GregoryPatch<Rational>& patch_;
  const BoxInspector& inspect_;
  std::array<std::array<IntervalVector, 2>, 2> differences_;
  int left_;
  std::array<Rational, 2> stopped_;
};

}  // namespace

RegularityResult prove_regular_polynomial(const GregoryPatch<Rational>& patch, int max_boxes,
                                          const BoxInspector& inspect) {
  Regularity regularity(patch, max_boxes, inspect);
  const bool proven = regularity.run();
  return {proven, max_boxes - std::max(0, regularity.left()), {regularity.u(), regularity.v()}};
}

}  // namespace patchproof
