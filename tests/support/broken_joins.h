// SPDX-License-Identifier: Apache-2.0
// Joins that are right, and the ways to break each of them by one number: a checker that always says yes fails here.
//
// In every valid join the line of B is a whole clamped edge. Which numbers of B are relevant:
//   * boundary row (the control points on the edge): position. Any move of a control point, or a change of its weight,
//     changes the edge curve, so C0 must be refuted, and with it the rest. (A weight is not relevant where its control
//     point coincides with the whole edge: collapsed edges, none here.)
//   * first inner row: the cross-boundary derivative. Moving control point j by d changes y_s by a positive multiple of
//     B_j(t) d. So C1 is refuted always, and G1 whenever n · d is not zero for all t: d leaves the tangent plane.
//     Multiplying the weight (the point stays) moves y_s by a multiple of B_j(t) (P_j − x(t)).
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "patchproof/join/join.h"
#include "patchproof/patch/affine.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/spline/bernstein.h"

namespace patchproof::test {

template <ExactField T>
using Surface = BsplinePatch<T, 4>;

template <ExactField T>
struct ValidJoin {
  std::string name;
  Surface<T> a, b;
  Join<T> join;
  bool c1 = true, c2 = true;
  std::optional<std::string> ratio = "1";  // none when the ratio is not constant
};

inline Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

template <ExactField T>
Vec<T, 4> weighted(const T& x, const T& y, const T& z, const T& w = T(1)) {
  return {{w * x, w * y, w * z, w}};
}

// A pairing of the ranges [a0, a1] and [b0, b1]; b1 < b0 when reversed.
template <ExactField T>
Pairing<T> paired(const T& a0, const T& a1, const T& b0, const T& b1) {
  const T da = a1 - a0, db = b1 < b0 ? b0 - b1 : b1 - b0;
  return {da == db ? PairingKind::identity : PairingKind::affine, {a0, a1}, {b0, b1}, T(1)};
}

template <ExactField T>
Join<T> edge_join(const Surface<T>& a, EdgeName edge_a, const Surface<T>& b, EdgeName edge_b, bool reversed = false) {
  const IsoLine<T> line_a = edge_line(a, edge_a), line_b = edge_line(b, edge_b);
  const auto &ka = a.knots(other(line_a.constant)), &kb = b.knots(other(line_b.constant));
  return {JoinKind::isoparametric,
          0,
          1,
          line_a,
          line_b,
          reversed ? paired(ka.domain_begin(), ka.domain_end(), kb.domain_end(), kb.domain_begin())
                   : paired(ka.domain_begin(), ka.domain_end(), kb.domain_begin(), kb.domain_end())};
}

// ---- surfaces -------------------------------------------------------------------------------------------------------

// Bézier patches with irregular, nowhere degenerate nets of multiples of 1/64 (decimals: of 1/1000).
inline Surface<Rational> wavy_patch(int degree_u, int degree_v, unsigned seed = 1, int unit = 64,
                                    bool rational = false) {
  unsigned state = seed * 2654435761u + 12345u;
  const auto next = [&] {  // in [-unit/2, unit/2], never 0
    state = state * 1664525u + 1013904223u;
    const int n = static_cast<int>(state >> 16) % unit - unit / 2;
    return q(n == 0 ? 1 : n, unit);
  };
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i <= degree_u; ++i)
    for (int j = 0; j <= degree_v; ++j) {
      const Rational x = q(3 * i) + next(), y = q(3 * j) + next(), z = next(), w = rational ? q(2) + next() : q(1);
      net.push_back(weighted(x, y, z, w));
    }
  return {KnotVector<Rational>::bezier(degree_u), KnotVector<Rational>::bezier(degree_v), std::move(net)};
}

// The octant of the unit sphere between the x- and y-axis, u from the equator to the pole. The quarter circle has the
// weights 1, w1, w2 (√2/2 and 1; or 1 and 2 in Q).
template <ExactField T>
Surface<T> sphere_octant(const T& w1, const T& w2) {
  const std::vector<T> w{T(1), w1, w2}, c{T(1), T(1), T(0)}, s{T(0), T(1), T(1)};
  std::vector<Vec<T, 4>> net;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) net.push_back(weighted<T>(c[i] * c[j], c[i] * s[j], s[i], w[i] * w[j]));
  return {KnotVector<T>::bezier(2), KnotVector<T>::bezier(2), std::move(net)};
}

// The quarter of a cylinder of radius 3 and height 5: u along the axis, v around.
template <ExactField T>
Surface<T> cylinder_quarter(const T& w1, const T& w2) {
  const std::vector<T> w{T(1), w1, w2}, c{T(3), T(3), T(0)}, s{T(0), T(3), T(3)};
  std::vector<Vec<T, 4>> net;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j) net.push_back(weighted<T>(c[j], s[j], T(5 * i), w[j]));
  return {KnotVector<T>::bezier(1), KnotVector<T>::bezier(2), std::move(net)};
}

// Turned by 90° about z.
template <ExactField T>
Surface<T> quarter_turn(const Surface<T>& s) {
  return map_points(s, [](const Vec<T, 4>& p) { return Vec<T, 4>{{-p[1], p[0], p[2], p[3]}}; });
}

// The index in the net of control point j of row k (0: on the edge). REQUIRES clamped knots.
template <ExactField T>
std::size_t net_index(const Surface<T>& s, const IsoLine<T>& line, int k, int j) {
  const int across = line.side == Side::right ? k : s.count(line.constant) - 1 - k;
  const int i_u = line.constant == Direction::u ? across : j, i_v = line.constant == Direction::u ? j : across;
  return static_cast<std::size_t>(i_u) * s.count(Direction::v) + i_v;
}

template <ExactField T>
Surface<T> with_point(const Surface<T>& s, std::size_t index, const Vec<T, 4>& point) {
  std::vector<Vec<T, 4>> net = s.net();
  net[index] = point;
  return {s.knots(Direction::u), s.knots(Direction::v), std::move(net)};
}

// ---- the family -----------------------------------------------------------------------------------------------------

// A patch beyond the edge u = 1 of the bicubic Bézier patch a whose tangent planes agree although no ratio is constant:
// y_s = −(1 + t) x_s + (t/3) x_t, which needs degree 4 along the edge.
inline Surface<Rational> g1_neighbour(const Surface<Rational>& a) {
  using Points = std::vector<Vec<Rational, 4>>;
  const auto times = [](const Rational& g0, const Rational& g1, const Points& f) {  // (g0 (1−t) + g1 t) f
    const int n = static_cast<int>(f.size());
    Points out(n + 1);
    for (int i = 0; i < n; ++i) {
      out[i] += Rational(g0 * q(n - i, n)) * f[i];
      out[i + 1] += Rational(g1 * q(i + 1, n)) * f[i];
    }
    return out;
  };
  Points edge, xs, xt;
  for (int j = 0; j < 4; ++j) edge.push_back(a.point(3, j)), xs.push_back(q(3) * (a.point(2, j) - a.point(3, j)));
  for (int j = 0; j < 3; ++j) xt.push_back(q(3) * (edge[j + 1] - edge[j]));
  const Points first = times(q(-1), q(-2), xs), second = elevate_degree(times(q(0), q(1, 3), xt)),
               line = elevate_degree(edge);
  std::vector<Vec<Rational, 4>> net = line;
  for (int j = 0; j < 5; ++j) net.push_back(line[j] + q(1, 3) * (first[j] + second[j]));
  for (int i : {2, 3})
    for (int j = 0; j < 5; ++j) net.push_back(line[j] + Vec<Rational, 4>{{q(4 * i), q(j), q(i - j, 4), q(0)}});
  return {KnotVector<Rational>::bezier(3), KnotVector<Rational>::bezier(4), std::move(net)};
}

inline std::vector<ValidJoin<Rational>> valid_joins() {
  std::vector<ValidJoin<Rational>> out;
  const auto add = [&](std::string name, const Surface<Rational>& a, EdgeName ea, const Surface<Rational>& b,
                       EdgeName eb, bool c1 = true, bool c2 = true, std::optional<std::string> ratio = "1",
                       bool reversed = false) {
    out.push_back({std::move(name), a, b, edge_join(a, ea, b, eb, reversed), c1, c2, std::move(ratio)});
  };
  const auto split_u = [](const Surface<Rational>& s) { return split(s, Direction::u, q(1, 2)); };
  const auto [a, b] = split_u(wavy_patch(3, 3));
  add("bicubic C2", a, EdgeName::u_max, b, EdgeName::u_min);
  const auto [a_decimal, b_decimal] = split_u(wavy_patch(3, 3, 7, 1000));
  add("bicubic C2 of decimals", a_decimal, EdgeName::u_max, b_decimal, EdgeName::u_min);
  std::size_t third_row = net_index(b, edge_line(b, EdgeName::u_min), 2, 1);
  add("bicubic C1", a, EdgeName::u_max,
      with_point(
          b, third_row,
          b.net()[third_row] + weighted(q(0), q(0), q(1), q(0)) + Vec<Rational, 4>{{q(0), q(0), q(1, 64), q(0)}}),
      EdgeName::u_min, true, false);
  add("ratio 3/2", a, EdgeName::u_max, map_domain(b, Direction::u, q(0), q(1, 3)), EdgeName::u_min, false, false,
      "3/2");
  const Surface<Rational> bicubic = wavy_patch(3, 3, 5);
  add("ratio not constant", bicubic, EdgeName::u_max, g1_neighbour(bicubic), EdgeName::u_min, false, false,
      std::nullopt);
  const auto [ra, rb] = split_u(wavy_patch(3, 3, 3, 64, true));
  add("rational bicubic", ra, EdgeName::u_max, rb, EdgeName::u_min);
  // In Q the quarter circle is faster at its beginning than at its end.
  const Surface<Rational> octant = sphere_octant(q(1), q(2)), quarter = cylinder_quarter(q(1), q(2));
  add("sphere in Q", octant, EdgeName::v_max, quarter_turn(octant), EdgeName::v_min, false, false, "2");
  add("cylinder in Q", quarter, EdgeName::v_max, quarter_turn(quarter), EdgeName::v_min, false, false, "2");
  const Surface<Rational> finer = insert_knot(
      insert_knot(elevate_degree(elevate_degree(b, Direction::v, 2), Direction::u), Direction::v, q(1, 3), 2),
      Direction::u, q(5, 7));
  add("degrees and knots differ", insert_knot(a, Direction::v, q(1, 4)), EdgeName::u_max, finer, EdgeName::u_min);
  add("reversed", a, EdgeName::u_max, reverse(b, Direction::v), EdgeName::u_min, true, true, "1", true);
  add("directions swapped", a, EdgeName::u_max, swap_directions(b), EdgeName::v_min);
  add("other speed along the edge", a, EdgeName::u_max, map_domain(b, Direction::v, q(-2), q(5, 3)), EdgeName::u_min);

  const Surface<Rational> part = restrict(b, Direction::v, q(1, 3), q(4, 5));
  ValidJoin<Rational> junction{"T-junction", a, part, edge_join(a, EdgeName::u_max, part, EdgeName::u_min)};
  junction.join.kind = JoinKind::t_junction;
  junction.join.pairing = paired(q(1, 3), q(4, 5), q(1, 3), q(4, 5));
  out.push_back(junction);

  // B(τ) = B₀(φ(τ)), so the pairing is the inverse of φ.
  const Surface<Rational> pace = moebius(b, Direction::v, q(2, 3));
  ValidJoin<Rational> moved{"Moebius pace", a, pace, edge_join(a, EdgeName::u_max, pace, EdgeName::u_min)};
  moved.join.pairing.kind = PairingKind::rational_linear;
  moved.join.pairing.ratio = q(3, 2);
  out.push_back(moved);
  return out;
}

inline std::vector<ValidJoin<Quadratic>> valid_quadratic_joins() {
  const Quadratic w(q(0), q(1, 2), 2), one(1);
  const Surface<Quadratic> octant = sphere_octant(w, one), quarter = cylinder_quarter(w, one);
  const Surface<Quadratic> next = quarter_turn(octant), next_quarter = quarter_turn(quarter);
  return {{"sphere in Q(√2)", octant, next, edge_join(octant, EdgeName::v_max, next, EdgeName::v_min), true, false},
          {"cylinder in Q(√2)", quarter, next_quarter,
           edge_join(quarter, EdgeName::v_max, next_quarter, EdgeName::v_min), true, false}};
}

// ---- the mutations --------------------------------------------------------------------------------------------------

// B with one number changed, and what that must refute.
template <ExactField T>
struct BrokenJoin {
  std::string name;
  Surface<T> b;
  bool c0, g1;  // certainly refuted? C1 is, always. A move inside the tangent plane may still fold the patch back.
};

// The distance from the double next to x to the next one: 2^-1074 for 0.
inline Rational unit_in_last_place(double x) {
  const double up = std::nextafter(std::fabs(x), std::numeric_limits<double>::infinity());
  return from_double(up) - from_double(std::fabs(x));
}

// Is n_A · d(x) not zero somewhere on the line? 24 places decide it for the degrees of this family.
template <ExactField T, class Direction3>
bool leaves_tangent_plane(const ValidJoin<T>& valid, Direction3 d) {
  const IsoLine<T>& line = valid.join.line_a;
  const T &begin = valid.join.pairing.a.front(), &end = valid.join.pairing.a.back();
  for (int k = 0; k < 24; ++k) {
    const T t = begin + T(k) / T(23) * (end - begin);
    const T u = line.constant == Direction::u ? line.value : t, v = line.constant == Direction::u ? t : line.value;
    const Vec<T, 3> n = normal(valid.a, u, v, Side::left, Side::left),
                    x = evaluate_rational(valid.a, u, v, Side::left, Side::left);
    if (*scalar_traits<T>::sign(dot(n, d(x))) != Sign::zero) return true;
  }
  return false;
}

template <ExactField T>
std::vector<BrokenJoin<T>> broken_joins(const ValidJoin<T>& valid) {
  std::vector<BrokenJoin<T>> out;
  const IsoLine<T>& line = valid.join.line_b;
  for (int row : {0, 1})
    for (int j = 0; j < valid.b.count(other(line.constant)); ++j) {
      const std::size_t index = net_index(valid.b, line, row, j);
      const Vec<T, 4> h = valid.b.net()[index];
      const std::string where = "row " + std::to_string(row) + ", point " + std::to_string(j);
      for (int c = 0; c < 3; ++c) {
        const T x = h[c] / h[3];
        std::vector<std::pair<std::string, T>> moves{
            {"one unit in the last place", embed<T>(unit_in_last_place(nearest_double(x)))},
            {"1e-30", embed<T>(*parse_scalar<Rational>("1e-30"))}};
        if (*scalar_traits<T>::sign(x) != Sign::zero) moves.emplace_back("sign flipped", -(x + x));
        const bool off_plane = row == 0 || leaves_tangent_plane(valid, [&](const Vec<T, 3>&) {
                                 Vec<T, 3> e{{T(0), T(0), T(0)}};
                                 e[c] = T(1);
                                 return e;
                               });
        for (const auto& [how, by] : moves) {
          Vec<T, 4> moved = h;
          moved[c] = h[c] + by * h[3];
          out.push_back({where + ", " + "xyz"[c] + ": " + how, with_point(valid.b, index, moved), row == 0, off_plane});
        }
      }
      const T factor = T(1) + embed<T>(from_double(0x1p-52));
      const Vec<T, 3> p{{h[0] / h[3], h[1] / h[3], h[2] / h[3]}};
      out.push_back({where + ": weight", with_point(valid.b, index, factor * h), row == 0,
                     row == 0 || leaves_tangent_plane(valid, [&](const Vec<T, 3>& x) { return p - x; })});
    }
  return out;
}

}  // namespace patchproof::test
