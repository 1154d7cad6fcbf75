// SPDX-License-Identifier: Apache-2.0
// Rational patches. Away from the corners S_u and S_v are enclosed by hulls of the three surfaces and of β. In a box at a corner
// whose points Q⁰ and Q¹ differ let F⁰ and F¹ be the C surface with only the one or the other of them there; then
//   S^c = F¹ + λ G,   G = F⁰ − F¹,   λ = β D⁰/(β D⁰ + (1 − β) D¹)      D⁰, D¹ their denominators
// F⁰ and F¹ have one point and the same derivatives in the corner (the corners agree), so that with the distances x, y from it
//   |G| ≤ x |G_x| + y |G_y|,   λ in [0, 1],   |λ_x| ≤ K |β_x| + L,   |β_x| x ≤ 1/2,   |β_x| y ≤ 3√3/8
//   K = max D⁰ max D¹/m²,   L = max |D⁰_x D¹ − D⁰ D¹_x|/(4 m²),   m = min(D⁰, D¹)
// with all maxima over the box, and likewise in y: everything shrinks with the box.
#include <optional>

#include "gregory_regularity.h"

namespace patchproof {
namespace {

using detail::hull;
using detail::IntervalVector;
using Homogeneous = Vec<Interval, 4>;
using Net = BezierPatch<Interval, 4>;

Interval magnitude(const Interval& x) { return Interval(0.0, std::max(-x.inf(), x.sup())); }
Interval around_zero(const Interval& bound) { return Interval(-bound.sup(), bound.sup()); }

// A value and its two derivatives over a box.
template <class V>
struct Enclosure {
  V value, du, dv;
};

template <class V>
Enclosure<V> operator+(const Enclosure<V>& a, const Enclosure<V>& b) {
  return {a.value + b.value, a.du + b.du, a.dv + b.dv};
}
// f · p
Enclosure<Homogeneous> product(const Enclosure<Interval>& f, const Enclosure<Homogeneous>& p) {
  return {f.value * p.value, f.du * p.value + f.value * p.du, f.dv * p.value + f.value * p.dv};
}

// The affine surface. Nothing where the weight is not certainly positive.
std::optional<Enclosure<IntervalVector>> projected(const Enclosure<Homogeneous>& h) {
  if (!(h.value[3].inf() > 0)) return std::nullopt;
  Enclosure<IntervalVector> out;
  for (std::size_t c = 0; c < 3; ++c) {
    out.value[c] = h.value[c] / h.value[3];
    out.du[c] = (h.du[c] - out.value[c] * h.du[3]) / h.value[3];
    out.dv[c] = (h.dv[c] - out.value[c] * h.dv[3]) / h.value[3];
  }
  return out;
}

using Centre = std::array<double, 3>;

// The homogeneous points as seen from `centre`: (A − c w, w). Then only small numbers are multiplied with the derivatives of
// weights and of β.
Net seen_from(const Centre& centre, const Net& net) {
  std::vector<Homogeneous> points = net.net();
  for (Homogeneous& p : points)
    for (std::size_t c = 0; c < 3; ++c) p[c] = p[c] - Interval(centre[c]) * p[3];
  return Net(net.degree(Direction::u), net.degree(Direction::v), std::move(points));
}

struct Box {
  Net u, v;                       // of the U and the V surface
  Net c;                          // the C surface's points Q¹
  std::array<Net, 4> difference;  // Q⁰ − Q¹ of each quadrant, and zero elsewhere
  Rational u_begin, u_end, v_begin, v_end;
};

class RationalRegularity {
 public:
  RationalRegularity(const GregoryPatch<Rational>& patch, int max_boxes, const BoxInspector& inspect)
      : patch_(patch), inspect_(inspect) {
    result_.boxes = max_boxes;
  }

  RegularityResult run() {
    const int limit = result_.boxes;
    left_ = limit;
    result_.proven = all_cells();
    result_.boxes = limit - std::max(0, left_);
    return result_;
  }

 private:
  bool all_cells() {
    // Distances from a point of the patch, so that a far origin costs no accuracy.
    const Vec<Rational, 4>& corner = patch_.u_surface().point(0, 0);
    for (std::size_t c = 0; c < 3; ++c) origin_[c] = corner[c] / corner[3];
    for (const auto& of_v : extract_bezier(patch_.v_surface()))
      for (const auto& of_u : extract_bezier(patch_.u_surface())) {
        const ParameterBox<Rational> box{of_v.box.u_begin, of_v.box.u_end, of_u.box.v_begin, of_u.box.v_end};
        const auto within = [&](Net net, bool along_u, bool along_v) {
          if (along_u) net = restrict(net, Direction::u, enclose(box.u_begin), enclose(box.u_end));
          if (along_v) net = restrict(net, Direction::v, enclose(box.v_begin), enclose(box.v_end));
          return net;
        };
        const auto difference = [&](std::size_t k) { return within(differences(k), true, true); };
        if (!prove({within(enclosed(of_u.bezier.net(), 3, of_u.bezier.degree(Direction::v)), true, false),
                    within(enclosed(of_v.bezier.net(), of_v.bezier.degree(Direction::u), 3), false, true),
                    within(enclosed(from_v(), 3, 3), true, true),
                    {difference(0), difference(1), difference(2), difference(3)},
                    box.u_begin,
                    box.u_end,
                    box.v_begin,
                    box.v_end}))
          return false;
      }
    return true;
  }

  Net enclosed(const std::vector<Vec<Rational, 4>>& points, int degree_u, int degree_v) const {
    std::vector<Homogeneous> net;
    for (const Vec<Rational, 4>& p : points) {
      Homogeneous h;
      for (std::size_t c = 0; c < 3; ++c) h[c] = enclose(Rational(p[c] - origin_[c] * p[3]));
      h[3] = enclose(p[3]);
      net.push_back(h);
    }
    return Net(degree_u, degree_v, std::move(net));
  }
  std::vector<Vec<Rational, 4>> from_v() const {
    std::vector<Vec<Rational, 4>> points;
    for (const auto& row : patch_.from_v()) points.insert(points.end(), row.begin(), row.end());
    return points;
  }
  // Of the quadrant (p, q), k = 2p + q.
  Net differences(std::size_t k) const {
    std::vector<Vec<Rational, 4>> points(16);
    for (std::size_t i = 2 * (k / 2); i < 2 * (k / 2) + 2; ++i)
      for (std::size_t j = 2 * (k % 2); j < 2 * (k % 2) + 2; ++j)
        points[4 * i + j] = patch_.from_u()[i][j] - patch_.from_v()[i][j];
    return enclosed(points, 3, 3);
  }

  static Enclosure<Homogeneous> enclosure(const Net& net, const Interval& per_u, const Interval& per_v) {
    return {detail::hull_of(net.net()), per_u * detail::hull_of(derivative_patch(net, Direction::u).net()),
            per_v * detail::hull_of(derivative_patch(net, Direction::v).net())};
  }

  // β_pq over a box that does not touch its corner; x and y grow away from it.
  static Enclosure<Interval> blend(const Interval& x, const Interval& y, bool flip_u, bool flip_v) {
    const Interval r2 = square(x) + square(y), r4 = square(r2), two(2);
    const Interval bx = two * x * square(y) / r4, by = -(two * square(x) * y / r4);
    const double low = (square(Interval(x.inf())) / (square(Interval(x.inf())) + square(Interval(y.sup())))).inf();
    const double high = (square(Interval(x.sup())) / (square(Interval(x.sup())) + square(Interval(y.inf())))).sup();
    return {Interval(std::max(0.0, low), std::min(1.0, high)), flip_u ? -bx : bx, flip_v ? -by : by};
  }

  // Nothing where a denominator is not certainly positive.
  std::optional<Enclosure<IntervalVector>> c_surface(const Box& box, const Interval& u, const Interval& v,
                                                     const Interval& per_u, const Interval& per_v,
                                                     const Centre& centre) const {
    Enclosure<Homogeneous> smooth = enclosure(seen_from(centre, box.c), per_u, per_v);
    std::optional<Enclosure<Homogeneous>> near;  // of the quadrant whose corner the box touches
    Interval near_x, near_y;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool flip_u = k / 2 == 1, flip_v = k % 2 == 1;
      const Interval one(1), x = detail::unit_distance(flip_u ? one - u : u),
                             y = detail::unit_distance(flip_v ? one - v : v);
      const Enclosure<Homogeneous> difference = enclosure(seen_from(centre, box.difference[k]), per_u, per_v);
      if (x.inf() <= 0 && y.inf() <= 0) {
        if (near) return std::nullopt;  // a box that touches two corners is too large
        near = difference;
        near_x = x, near_y = y;
        continue;
      }
      smooth = smooth + product(blend(x, y, flip_u, flip_v), difference);
    }
    if (!near) return projected(smooth);
    const Enclosure<Homogeneous>&h1 = smooth, h0 = smooth + *near;
    const auto f0 = projected(h0), f1 = projected(h1);
    if (!f0 || !f1) return std::nullopt;
    const Interval d0 = h0.value[3], d1 = h1.value[3];
    const Interval least = square(Interval(std::min(d0.inf(), d1.inf())));
    const Interval k = Interval(d0.sup()) * Interval(d1.sup()) / least;
    const Interval half(0.5), steep = Interval(0.6496), four(4);  // 3√3/8 < 0.6496
    const auto rate = [&](const Interval& d0_t, const Interval& d1_t) {
      return magnitude(d0_t * d1 - d0 * d1_t) / (four * least);
    };
    const Interval l_u = rate(h0.du[3], h1.du[3]), l_v = rate(h0.dv[3], h1.dv[3]);
    Enclosure<IntervalVector> out = *f1;
    for (std::size_t c = 0; c < 3; ++c) {
      const Interval gu = f0->du[c] - f1->du[c], gv = f0->dv[c] - f1->dv[c];
      const Interval mu = magnitude(gu), mv = magnitude(gv), lambda(0.0, 1.0);
      const Interval g = near_x * mu + near_y * mv;
      out.value[c] += lambda * around_zero(g);
      out.du[c] += lambda * gu + around_zero(k * (half * mu + steep * mv) + l_u * g);
      out.dv[c] += lambda * gv + around_zero(k * (half * mv + steep * mu) + l_v * g);
    }
    return out;
  }

  bool is_regular(const Box& box) const {
    const Interval u(enclose(box.u_begin).inf(), enclose(box.u_end).sup()),
        v(enclose(box.v_begin).inf(), enclose(box.v_end).sup());
    const Interval per_u = enclose(Rational(1 / (box.u_end - box.u_begin))),
                   per_v = enclose(Rational(1 / (box.v_end - box.v_begin)));
    Centre centre;
    const Homogeneous around = detail::hull_of(box.u.net());
    for (std::size_t c = 0; c < 3; ++c) {
      centre[c] = (around[c].inf() + around[c].sup()) / (around[3].inf() + around[3].sup());
      if (!std::isfinite(centre[c])) return false;
    }
    const auto su = projected(enclosure(seen_from(centre, box.u), per_u, per_v)),
               sv = projected(enclosure(seen_from(centre, box.v), per_u, per_v)),
               sc = c_surface(box, u, v, per_u, per_v, centre);
    if (!su || !sv || !sc) return false;
    const IntervalVector du = su->du + sv->du - sc->du, dv = su->dv + sv->dv - sc->dv;
    if (inspect_) inspect_({box.u_begin, box.u_end, box.v_begin, box.v_end}, du, dv);
    return detail::is_one_sided(cross(du, dv));
  }

  bool prove(const Box& box, int halvings = detail::kHalvings) {
    if (left_-- <= 0 || halvings == 0) {
      result_.stopped = {box.u_begin, box.v_begin};
      return false;
    }
    if (is_regular(box)) return true;
    const Direction d = box.u_end - box.u_begin >= box.v_end - box.v_begin ? Direction::u : Direction::v;
    auto [low, high] = halves(box, d);
    return prove(low, halvings - 1) && prove(high, halvings - 1);
  }

  static std::pair<Box, Box> halves(const Box& box, Direction d) {
    Box low = box, high = box;
    const auto cut = [&](Net Box::*net) {
      auto [first, second] = split(box.*net, d, Interval(0.5));
      low.*net = std::move(first), high.*net = std::move(second);
    };
    cut(&Box::u);
    cut(&Box::v);
    cut(&Box::c);
    for (std::size_t k = 0; k < 4; ++k) {
      auto [first, second] = split(box.difference[k], d, Interval(0.5));
      low.difference[k] = std::move(first), high.difference[k] = std::move(second);
    }
    if (d == Direction::u)
      low.u_end = high.u_begin = (box.u_begin + box.u_end) / 2;
    else
      low.v_end = high.v_begin = (box.v_begin + box.v_end) / 2;
    return {std::move(low), std::move(high)};
  }

  const GregoryPatch<Rational>& patch_;
  const BoxInspector& inspect_;
  Vec<Rational, 3> origin_;
  int left_ = 0;
  RegularityResult result_;
};

}  // namespace

RegularityResult prove_regular_rational(const GregoryPatch<Rational>& patch, int max_boxes,
                                        const BoxInspector& inspect) {
  return RationalRegularity(patch, max_boxes, inspect).run();
}

}  // namespace patchproof
