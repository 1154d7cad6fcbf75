// SPDX-License-Identifier: Apache-2.0
// Gregory patches for tests: random ones whose corners agree, made from nothing but the end derivatives of clamped splines.
#pragma once

#include <vector>

#include "patchproof/patch/gregory_patch.h"
#include "support/patches.h"
#include "support/rational_literal.h"

namespace patchproof::test {

struct GregoryPatchOptions {
  bool rational = false;
  bool dyadic = false;  // knots and control points are doubles
};

// Both surfaces have the points and tangents of one random boundary at the corners; twists, and what lies between the ends
// of the rows, are random. All weights are positive; some rows need λ when rational.
inline GregoryPatch<Rational> random_gregory_patch(RandomRationals& random, const GregoryPatchOptions& options = {}) {
  using Point = Vec<Rational, 4>;
  const auto number = [&] { return options.dyadic ? Rational(random.integer(-64, 64)) / Rational(16) : random(); };
  const auto weight = [&] { return options.rational ? Rational(random.integer(1, 12)) / Rational(4) : Rational(1); };
  const auto point = [&](int i, int j) {
    const Rational w = weight();
    return Point{{w * (6 * i + number() / 4), w * (6 * j + number() / 4), w * number(), w}};
  };
  std::array<std::array<Point, 4>, 4> q;  // a bicubic boundary; what is inside does not matter
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) q[i][j] = point(i, j);
  const std::vector<std::vector<Rational>> menu =
      options.dyadic ? std::vector<std::vector<Rational>>{{}, {"1/4"_q, "5/8"_q}, {"1/2"_q, "1/2"_q, "1/2"_q}}
                     : std::vector<std::vector<Rational>>{{}, {"1/3"_q, "1/3"_q}, {"1/5"_q, "3/7"_q, "3/7"_q, "3/7"_q}};
  const auto surface = [&](Direction along) {
    const int k = random.integer(3, 4);
    const std::vector<Rational>& inner = menu[random.integer(0, 2)];
    std::vector<Rational> knots(k + 1, Rational(0));
    knots.insert(knots.end(), inner.begin(), inner.end());
    knots.insert(knots.end(), k + 1, Rational(1));
    const auto t = KnotVector<Rational>::make(k, knots).value();
    const int n = t.control_count() - 1;
    const Rational first = 3 * t[k + 1] / k, last = 3 * (1 - t[n]) / k;
    std::vector<Point> net(4 * (n + 1));
    for (int row = 0; row < 4; ++row) {
      const auto corner = [&](int m) -> const Point& { return along == Direction::v ? q[row][m] : q[m][row]; };
      for (int m = 0; m <= n; ++m) {
        Point& p = net[along == Direction::v ? row * (n + 1) + m : m * 4 + row];
        const Rational place = Rational(3 * m) / n;
        const Rational w = weight();
        p = {{w * number(), w * number(), w * number(), w}};
        p[along == Direction::v ? 0 : 1] += w * 6 * row;
        p[along == Direction::v ? 1 : 0] += w * 6 * place;
        if (m == 0) p = corner(0);
        if (m == n) p = corner(3);
        if (row == 1 || row == 2) continue;
        if (m == 1) p = corner(0) + first * (corner(1) - corner(0));
        if (m == n - 1) p = corner(3) + last * (corner(2) - corner(3));
      }
    }
    const auto across = KnotVector<Rational>::bezier(3);
    return along == Direction::v ? BsplinePatch<Rational, 4>(across, t, net)
                                 : BsplinePatch<Rational, 4>(t, across, net);
  };
  const auto u = surface(Direction::v);
  return GregoryPatch<Rational>::make(u, surface(Direction::u)).value();
}

// The patch with f applied to every homogeneous control point of both surfaces, in the scalar of its results.
template <class F>
auto mapped_patch(const GregoryPatch<Rational>& patch, F f) {
  using T = std::remove_cvref_t<decltype(f(patch.u_surface().net()[0])[0])>;
  const auto surface = [&](const BsplinePatch<Rational, 4>& s) {
    std::vector<Vec<T, 4>> net;
    for (const Vec<Rational, 4>& p : s.net()) net.push_back(f(p));
    return BsplinePatch<T, 4>(make_knots<T>(s.degree(Direction::u), s.knots(Direction::u).knots()),
                              make_knots<T>(s.degree(Direction::v), s.knots(Direction::v).knots()), std::move(net));
  };
  return GregoryPatch<T>::make(surface(patch.u_surface()), surface(patch.v_surface())).value();
}

template <class T>
GregoryPatch<T> make_patch(const GregoryPatch<Rational>& patch) {
  return mapped_patch(patch, [](const Vec<Rational, 4>& p) { return make_point<T>(p); });
}

}  // namespace patchproof::test
