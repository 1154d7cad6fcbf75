// SPDX-License-Identifier: Apache-2.0
// What certificates say, checked with nothing but evaluations of both patches (patch/rational_patch.h).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "patchproof/join/certificate.h"
#include "support/broken_joins.h"

namespace patchproof::test {

// Point, derivative along the line by the parameter t of line A, and inward cross-boundary derivatives.
template <ExactField T>
struct LineJet {
  Vec<T, 3> x, xt, xs, xss;
};

template <ExactField T>
LineJet<T> jet_at(const Surface<T>& s, const IsoLine<T>& line, const T& along, Side side_along, const T& speed) {
  const bool constant_u = line.constant == Direction::u;
  const PartialDerivatives<T, 3> d = constant_u
                                         ? rational_derivatives(s, line.value, along, 2, 2, line.side, side_along)
                                         : rational_derivatives(s, along, line.value, 2, 2, side_along, line.side);
  const T inward = line.side == Side::right ? T(1) : T(-1);
  return {d.at(0, 0), speed * (constant_u ? d.at(0, 1) : d.at(1, 0)), inward * (constant_u ? d.at(1, 0) : d.at(0, 1)),
          constant_u ? d.at(2, 0) : d.at(0, 2)};
}

// The parameter τ(t) of line B and dτ/dt, by the definition of a pairing.
template <ExactField T>
std::pair<T, T> partner(const Pairing<T>& p, const T& t, Side side) {
  std::size_t i = 0;
  while (i + 2 < p.a.size() && (side == Side::right ? p.a[i + 1] <= t : p.a[i + 1] < t)) ++i;
  const T da = p.a[i + 1] - p.a[i], db = p.b[i + 1] - p.b[i], x = (t - p.a[i]) / da;
  if (p.kind != PairingKind::rational_linear) return {p.b[i] + x * db, db / da};
  const T w = T(1) - x + p.ratio * x;
  return {p.b[i] + p.ratio * x / w * db, p.ratio / (w * w) * db / da};
}

template <ExactField T>
struct PairedJets {
  LineJet<T> a, b;
};
template <ExactField T>
PairedJets<T> jets_at(const Surface<T>& a, const Surface<T>& b, const Join<T>& join, const T& t,
                      Side side = Side::right) {
  const auto [tau, speed] = partner(join.pairing, t, side);
  const Side side_b = join.pairing.reversed() ? (side == Side::right ? Side::left : Side::right) : side;
  return {jet_at(a, join.line_a, t, side, T(1)), jet_at(b, join.line_b, tau, side_b, speed)};
}

// The printed numbers of a witness are the values of its quantity at its place, on the one side of a knot or the other.
template <ExactField T>
void expect_true_witness(const Surface<T>& a, const Surface<T>& b, const Join<T>& join, const Witness& w) {
  const int along_a = join.line_a.constant == Direction::u ? 1 : 0,
            along_b = join.line_b.constant == Direction::u ? 1 : 0;
  const T t = *parse_scalar<T>(w.a[along_a]), tau = *parse_scalar<T>(w.b[along_b]);
  EXPECT_TRUE(*parse_scalar<T>(w.a[1 - along_a]) == join.line_a.value);
  EXPECT_TRUE(*parse_scalar<T>(w.b[1 - along_b]) == join.line_b.value);
  EXPECT_TRUE(join.pairing.a.front() <= t && t <= join.pairing.a.back());
  EXPECT_TRUE(partner(join.pairing, t, Side::right).first == tau);
  bool true_on_one_side = false;
  for (const Side side : {Side::right, Side::left}) {
    const PairedJets<T> j = jets_at(a, b, join, t, side);
    std::vector<T> values;
    if (w.quantity == "x - y") {
      const Vec<T, 3> d = j.a.x - j.b.x;
      values.assign(d.c.begin(), d.c.end());
    } else if (w.quantity == "x_s + y_s") {
      const Vec<T, 3> d = j.a.xs + j.b.xs;
      values.assign(d.c.begin(), d.c.end());
    } else if (w.quantity == "x_ss - y_ss") {
      const Vec<T, 3> d = j.a.xss - j.b.xss;
      values.assign(d.c.begin(), d.c.end());
    } else if (w.quantity == "det(x_t, x_s, y_s)") {
      values = {dot(j.a.xt, cross(j.a.xs, j.b.xs))};
    } else if (w.quantity == "(x_t × x_s) · (y_t × y_s)") {
      values = {dot(cross(j.a.xt, j.a.xs), cross(j.b.xt, j.b.xs))};
      EXPECT_EQ(*scalar_traits<T>::sign(*parse_scalar<T>(w.values.at(0))), Sign::positive);
    } else {
      ADD_FAILURE() << "unknown quantity " << w.quantity;
    }
    ASSERT_EQ(values.size(), w.values.size());
    bool equal = true;
    for (std::size_t i = 0; i < values.size(); ++i) equal = equal && to_text(values[i]) == w.values[i];
    true_on_one_side = true_on_one_side || equal;
  }
  EXPECT_TRUE(true_on_one_side) << w.quantity << " is not what the witness prints: " << w.values[0];
  EXPECT_TRUE(std::any_of(w.values.begin(), w.values.end(), [](const std::string& v) { return v != "0"; }));
}

// |v| <= bound, exactly.
template <ExactField T>
bool no_longer_than(const Vec<T, 3>& v, double bound) {
  const T b = embed<T>(from_double(bound));
  return dot(v, v) <= b * b;
}

// The angle of the oriented normals from exact numbers, in degrees, to about 1e-13 of itself; nothing where one vanishes.
template <ExactField T>
std::optional<double> angle_between_normals(const PairedJets<T>& j) {
  const Vec<T, 3> n = cross(j.a.xt, j.a.xs), m = -T(1) * cross(j.b.xt, j.b.xs), c = cross(n, m);
  const T nn = dot(n, n), mm = dot(m, m);
  if (*scalar_traits<T>::sign(nn) == Sign::zero || *scalar_traits<T>::sign(mm) == Sign::zero) return std::nullopt;
  const double sine = std::sqrt(nearest_double(T(dot(c, c) / (nn * mm))));  // free of scale
  const T d = dot(n, m);
  const double cosine = std::sqrt(nearest_double(T(d * d / (nn * mm)))) * static_cast<int>(*scalar_traits<T>::sign(d));
  return std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

// Gap and angle at count + 1 places stay below the upper bounds.
template <ExactField T>
void expect_bounds_hold(const Surface<T>& a, const Surface<T>& b, const Join<T>& join, const Certificate& c,
                        int count) {
  const T &begin = join.pairing.a.front(), &end = join.pairing.a.back();
  for (int k = 0; k <= count; ++k) {
    const T t = begin + T(k) / T(count) * (end - begin);
    const PairedJets<T> j = jets_at(a, b, join, t, k == count ? Side::left : Side::right);
    if (std::isfinite(c.gap.upper)) {
      EXPECT_TRUE(no_longer_than(j.a.x - j.b.x, c.gap.upper)) << "sample " << k << ": upper " << c.gap.upper;
    }
    const std::optional<double> angle = angle_between_normals(j);
    if (!angle) continue;
    EXPECT_LE(*angle, c.angle.upper * (1 + 1e-12) + 1e-300) << "sample " << k;
    EXPECT_LE(std::min(*angle, 180 - *angle), c.plane_angle.upper * (1 + 1e-12) + 1e-12) << "sample " << k;
  }
}

// REQUIRES places of the bounds that doubles hold exactly.
template <ExactField T>
void expect_lower_bounds_attained(const Surface<T>& a, const Surface<T>& b, const Join<T>& join, const Certificate& c) {
  const int along = join.line_a.constant == Direction::u ? 1 : 0;
  const auto jets = [&](const EnclosedMaximum& m) {
    const T t = embed<T>(from_double(m.at.a[along]));
    EXPECT_TRUE(join.pairing.a.front() <= t && t <= join.pairing.a.back());
    const PairedJets<T> j = jets_at(a, b, join, t, t == join.pairing.a.back() ? Side::left : Side::right);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(m.at.point[i], nearest_double(j.a.x[i]));
    return j;
  };
  const PairedJets<T> gap = jets(c.gap), angle = jets(c.angle), plane = jets(c.plane_angle);
  const Vec<T, 3> d = gap.a.x - gap.b.x;
  const T lower = embed<T>(from_double(c.gap.lower));
  EXPECT_TRUE(lower * lower <= dot(d, d)) << "gap";
  const std::optional<double> at_angle = angle_between_normals(angle), at_plane = angle_between_normals(plane);
  ASSERT_TRUE(at_angle && at_plane);
  EXPECT_GE(*at_angle * (1 + 1e-12), c.angle.lower);
  EXPECT_GE(std::min(*at_plane, 180 - *at_plane) * (1 + 1e-12) + 1e-12, c.plane_angle.lower);
}

inline void expect_identical(const EnclosedMaximum& a, const EnclosedMaximum& b) {
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.converged, b.converged);
  EXPECT_TRUE(a.at.a == b.at.a && a.at.b == b.at.b && a.at.point == b.at.point);
}
inline void expect_identical(const Certificate& a, const Certificate& b) {
  expect_identical(a.gap, b.gap);
  expect_identical(a.angle, b.angle);
  expect_identical(a.plane_angle, b.plane_angle);
  EXPECT_EQ(a.ratio, b.ratio);
  EXPECT_EQ(a.orientation, b.orientation);
  EXPECT_EQ(a.rung, b.rung);
  EXPECT_EQ(a.degenerate.size(), b.degenerate.size());
  const auto same = [](const ExactClass& x, const ExactClass& y) {
    EXPECT_EQ(x.verdict, y.verdict);
    EXPECT_EQ(x.reason, y.reason);
    ASSERT_EQ(x.witness.has_value(), y.witness.has_value());
    if (x.witness) {
      EXPECT_TRUE(x.witness->quantity == y.witness->quantity && x.witness->a == y.witness->a &&
                  x.witness->b == y.witness->b && x.witness->values == y.witness->values);
    }
  };
  same(a.c0, b.c0), same(a.c1, b.c1), same(a.c2, b.c2), same(a.g1, b.g1);
}

// ---- the same join, said differently --------------------------------------------------------------------------------

// B first. y = r x/(1 − x + r x) has the inverse with 1/r, and with r again once both run the other way.
template <ExactField T>
ValidJoin<T> swap_sides(const ValidJoin<T>& j) {
  ValidJoin<T> out{j.name, j.b, j.a, j.join, j.c1, j.c2, j.ratio};
  out.join.line_a = j.join.line_b, out.join.line_b = j.join.line_a;
  Pairing<T>& p = out.join.pairing;
  const bool reversed = p.reversed();
  std::swap(p.a, p.b);
  if (reversed)
    std::reverse(p.a.begin(), p.a.end()), std::reverse(p.b.begin(), p.b.end());
  else
    p.ratio = T(1) / p.ratio;
  return out;
}

// Both patches reversed along the join.
template <ExactField T>
ValidJoin<T> run_backwards(const ValidJoin<T>& j) {
  const Direction da = other(j.join.line_a.constant), db = other(j.join.line_b.constant);
  ValidJoin<T> out{j.name, reverse(j.a, da), reverse(j.b, db), j.join, j.c1, j.c2, j.ratio};
  const auto mirror = [](std::vector<T>& nodes, const KnotVector<T>& k) {
    for (T& t : nodes) t = k.domain_begin() + k.domain_end() - t;
    std::reverse(nodes.begin(), nodes.end());
  };
  mirror(out.join.pairing.a, j.a.knots(da));
  mirror(out.join.pairing.b, j.b.knots(db));
  out.join.pairing.ratio = T(1) / j.join.pairing.ratio;
  return out;
}

}  // namespace patchproof::test
