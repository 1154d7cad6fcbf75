// SPDX-License-Identifier: Apache-2.0
// GERBS surfaces with random exact local surfaces, and their partial derivatives by power series in two variables.
#pragma once

#include <utility>
#include <vector>

#include "patchproof/patch/gerbs_surface.h"
#include "support/gerbs.h"

namespace patchproof::test {

using SurfaceLocal = LocalSurface<Rational, 4>;
using Surface = GerbsSurface<Rational, 4>;

// f(u + x, v + y) = Σ c_kl x^k y^l
template <class R>
struct Jet2 {
  std::vector<Jet<R>> c;
  Jet2(int order_u, int order_v) : c(order_u + 1, Jet<R>(order_v + 1, R(0))) {}
  static Jet2 product(const Jet<R>& f, const Jet<R>& g) {
    Jet2 out(static_cast<int>(f.size()) - 1, static_cast<int>(g.size()) - 1);
    for (std::size_t k = 0; k < f.size(); ++k)
      for (std::size_t l = 0; l < g.size(); ++l) out.c[k][l] = f[k] * g[l];
    return out;
  }
  Jet2 like() const { return Jet2(static_cast<int>(c.size()) - 1, static_cast<int>(c[0].size()) - 1); }
  friend Jet2 operator+(Jet2 a, const Jet2& b) {
    for (std::size_t k = 0; k < a.c.size(); ++k)
      for (std::size_t l = 0; l < a.c[k].size(); ++l) a.c[k][l] = a.c[k][l] + b.c[k][l];
    return a;
  }
  friend Jet2 operator*(const R& x, Jet2 a) {
    for (auto& row : a.c)
      for (R& y : row) y = x * y;
    return a;
  }
  friend Jet2 operator*(const Jet2& a, const Jet2& b) {
    Jet2 out = a.like();
    for (std::size_t k = 0; k < a.c.size(); ++k)
      for (std::size_t i = 0; i + k < a.c.size(); ++i)
        for (std::size_t l = 0; l < a.c[k].size(); ++l)
          for (std::size_t j = 0; j + l < a.c[k].size(); ++j)
            out.c[k + i][l + j] = out.c[k + i][l + j] + a.c[k][l] * b.c[i][j];
    return out;
  }
  friend Jet2 operator/(const Jet2& a, const Jet2& b) {
    Jet2 out = a.like();
    for (std::size_t k = 0; k < a.c.size(); ++k)
      for (std::size_t l = 0; l < a.c[k].size(); ++l) {
        R rest = a.c[k][l];
        for (std::size_t i = 0; i <= k; ++i)
          for (std::size_t j = 0; j <= l; ++j)
            if (i + j > 0) rest = rest - b.c[i][j] * out.c[k - i][l - j];
        out.c[k][l] = rest / b.c[0][0];
      }
    return out;
  }
};

// Where a formula is meant, and the parameters it is taken at.
struct Place {
  Rational u, v;
  Side side_u, side_v;
};

// The functions of one direction that live at a place: the index of each, and its jet.
template <class R>
std::vector<std::pair<int, Jet<R>>> jets_of(const FunctionBasis<Rational>& basis, const Rational& place, Side side,
                                            int order) {
  std::vector<std::pair<int, Jet<R>>> out;
  if (const auto* knots = basis.knots()) {
    const int span = knots->find_span(place, side);
    for (int i = span - knots->degree(); i <= span; ++i)
      out.push_back({i, jet_of<R>(bspline_piece(knots->knots(), i, knots->degree(), span), place, order)});
  } else if constexpr (Transcendental<R>) {
    for (int l = 0; l < basis.count(); ++l) {
      const int frequency = (l + 1) / 2;
      Jet<R> f;
      R factor(1);
      for (int k = 0; k <= order; ++k) {
        const auto cs = cos_sin_pi(embed<R>(Rational(Rational(frequency) * place + Rational(k) / Rational(2))));
        f.push_back(factor * cs[l > 0 && l % 2 == 0 ? 1 : 0] / embed<R>(factorial(k)));
        factor = factor * R(frequency) * pi<R>();
      }
      out.push_back({l, f});
    }
  }
  return out;
}

template <class R>
std::vector<Jet2<R>> jets_of(const SurfaceLocal& local, const Place& at, int order_u, int order_v) {
  std::vector<Jet2<R>> sums(4, Jet2<R>(order_u, order_v)), out;
  const auto f = jets_of<R>(local.basis(Direction::u), at.u - local.shift(Direction::u), at.side_u, order_u),
             g = jets_of<R>(local.basis(Direction::v), at.v - local.shift(Direction::v), at.side_v, order_v);
  for (const auto& [i, of_u] : f)
    for (const auto& [j, of_v] : g) {
      const Jet2<R> both = Jet2<R>::product(of_u, of_v);
      const auto& p = local.net()[static_cast<std::size_t>(i) * local.basis(Direction::v).count() + j];
      for (std::size_t c = 0; c < 4; ++c) sums[c] = sums[c] + embed<R>(p[c]) * both;
    }
  for (std::size_t c = 0; c < 3; ++c) out.push_back(sums[c] / sums[3]);
  return out;
}

template <class R>
using Partials = std::vector<Vec<R, 3>>;  // order (k, l) at k (order_v + 1) + l

template <class R>
Partials<R> derivatives_of(const std::vector<Jet2<R>>& jets) {
  Partials<R> out;
  for (std::size_t k = 0; k < jets[0].c.size(); ++k)
    for (std::size_t l = 0; l < jets[0].c[k].size(); ++l) {
      const R factor = embed<R>(Rational(factorial(static_cast<int>(k)) * factorial(static_cast<int>(l))));
      out.push_back({{factor * jets[0].c[k][l], factor * jets[1].c[k][l], factor * jets[2].c[k][l]}});
    }
  return out;
}

template <class R>
Partials<R> reference_derivatives(const SurfaceLocal& local, const Place& at, int order_u, int order_v) {
  return derivatives_of(jets_of<R>(local, at, order_u, order_v));
}

template <class R>
Partials<R> reference_derivatives(const Surface& s, const Place& at, int order_u, int order_v) {
  const auto &ku = s.knots(Direction::u), &kv = s.knots(Direction::v);
  const int j = ku.find_span(at.u, at.side_u), i = kv.find_span(at.v, at.side_v);
  Jet<R> b[2] = {jet_of<R>(s.b_function(), ku[j], ku[j + 1], at.u, order_u),
                 jet_of<R>(s.b_function(), kv[i], kv[i + 1], at.v, order_v)};
  Jet<R> a[2] = {b[0], b[1]};
  for (Jet<R>& f : a) {
    for (R& x : f) x = -x;
    f[0] = f[0] + R(1);
  }
  std::vector<Jet2<R>> sums(3, Jet2<R>(order_u, order_v));
  for (const int p : {0, 1})
    for (const int q : {0, 1}) {
      const Jet2<R> factor = Jet2<R>::product(p == 0 ? a[0] : b[0], q == 0 ? a[1] : b[1]);
      const auto local = jets_of<R>(s.local(j - 1 + p, i - 1 + q), at, order_u, order_v);
      for (std::size_t c = 0; c < 3; ++c) sums[c] = sums[c] + factor * local[c];
    }
  return derivatives_of(sums);
}

// What the library says, as a list.
template <class R, class S>
Partials<R> partials(const S& surface, const Place& at, int order_u, int order_v) {
  const auto table =
      partial_derivatives_at<R>(surface, std::array<Rational, 2>{at.u, at.v}, std::array<Side, 2>{at.side_u, at.side_v},
                                embed<R>(at.u), embed<R>(at.v), order_u, order_v);
  Partials<R> out;
  for (int k = 0; k <= order_u; ++k)
    for (int l = 0; l <= order_v; ++l) out.push_back(table.at(k, l));
  return out;
}

// Of degree 2 in u and 1 in v over the box, with a knot inside in either direction if `inner`.
inline BsplinePatch<Rational, 4> random_patch(RandomRationals& random, const ParameterBox<Rational>& box, bool inner,
                                              Weights weights) {
  const auto knots = [&](int degree, const Rational& begin, const Rational& end) {
    std::vector<Rational> out(degree + 1, begin);
    if (inner) out.push_back((Rational(3) * begin + end) / Rational(4));
    out.insert(out.end(), degree + 1, end);
    return KnotVector<Rational>::make(degree, std::move(out)).value();
  };
  const auto u = knots(2, box.u_begin, box.u_end), v = knots(1, box.v_begin, box.v_end);
  std::vector<Vec<Rational, 4>> net;
  for (int k = 0; k < u.control_count() * v.control_count(); ++k) {
    Vec<Rational, 4> p = random.point<4>();
    p[3] = weights == Weights::one      ? Rational(1)
           : weights == Weights::common ? Rational(3) / Rational(2)
                                        : Rational(random.integer(3, 7)) / Rational(2);
    for (std::size_t c = 0; c < 3; ++c) p[c] = p[c] * p[3];
    net.push_back(p);
  }
  return {u, v, std::move(net)};
}

inline Surface random_surface(RandomRationals& random, const BFunction& b, const std::vector<Rational>& breaks_u,
                              bool closed_u, const std::vector<Rational>& breaks_v, bool closed_v,
                              Weights weights = Weights::one, bool inner = false) {
  const Surface::Axis u{gerbs_knots(breaks_u, closed_u).value(), closed_u},
      v{gerbs_knots(breaks_v, closed_v).value(), closed_v};
  std::vector<SurfaceLocal> locals;
  for (int p = 0; p < u.distinct(); ++p)
    for (int q = 0; q < v.distinct(); ++q)
      locals.push_back(random_patch(random, {u.knots[p], u.knots[p + 2], v.knots[q], v.knots[q + 2]}, inner, weights));
  return Surface::make(b, u, v, locals).value();
}

// All breaks with the sides that exist there, and places between them, in both directions.
inline std::vector<Place> sided_places(const Surface& s) {
  const auto along = [&](Direction d) {
    const std::vector<Rational> at = s.breaks(d);
    std::vector<std::pair<Rational, Side>> out;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (i > 0) out.push_back({at[i], Side::left});
      if (i + 1 == at.size()) break;
      out.push_back({at[i], Side::right});
      out.push_back({Rational((at[i] + Rational(3) * at[i + 1]) / Rational(4)), Side::right});
    }
    return out;
  };
  std::vector<Place> out;
  for (const auto& [u, side_u] : along(Direction::u))
    for (const auto& [v, side_v] : along(Direction::v)) out.push_back({u, v, side_u, side_v});
  return out;
}

}  // namespace patchproof::test
