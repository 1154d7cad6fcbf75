// SPDX-License-Identifier: Apache-2.0
// GERBS surfaces: local surfaces blended by a B-function in both directions, open or closed in each.
//
//   S(u,v) = (1−α, α) C (1−β, β)ᵀ,    α = B(w_u), β = B(w_v),    C = [[c_{j−1,i−1}, c_{j−1,i}], [c_{j,i−1}, c_{j,i}]]
//
// for u in span j, v in span i of knots of degree 1, as for curves (spline/gerbs_curve.h). Local surface c_pq has its centre at
// (u_{p+1}, v_{q+1}). Derivatives follow the full product rule: S^{kl} = Σ_p Σ_q Σ_a Σ_b C(k,a) C(l,b) a_p^(a) b_q^(b) c_pq^{k−a,l−b}.
// Closed in a direction: the last row (column) of local surfaces is the first, a period further.
//
// REQUIRES  local surfaces whose weights have no zero where they are used.
// ENSURES   (1) partial_derivatives_at is the formula above;  (2) Hermite: at (u_{p+1}, v_{q+1}) the derivatives of orders
//           k, l ≤ n are those of c_pq, for B of order n and local surfaces that are Cⁿ; S is Cⁿ in each variable;  (3) local
//           surfaces that are all one surface give that surface;  (4) a closed surface ends as it begins, with n derivatives;
//           (5) edge: the GERBS curve that S is on an edge of the domain, and with order 1 the derivative across it.
// SCALARS   T: OrderedField, K: OrderedField; values in R: Field, where B and the local surfaces have values in R.
// ERRORS    wrong_count, outside_domain, not_closed, bad_degree: as GerbsCurve, for the rows and columns of local surfaces.
// SOURCE    L. T. Dechevsky, A. Lakså, B. Bang, Expo-rational B-splines, Int. J. Pure Appl. Math. 27 (2006) 319–362.
// NEIGHBOURS gerbs_expand.h (as an ordinary patch).
// TEST      tests/patch/gerbs_surface_test.cpp checks (1)–(5).
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/patch/boundary.h"
#include "patchproof/patch/local_surface.h"
#include "patchproof/spline/gerbs_curve.h"

namespace patchproof {

template <OrderedField T, std::size_t M, OrderedField K = knot_scalar_t<T>>
class GerbsSurface {
 public:
  using Local = LocalSurface<T, M, K>;

  // One direction: its knots (of degree 1) and whether it is closed.
  struct Axis {
    KnotVector<K> knots;
    bool closed = false;
    int distinct() const { return knots.control_count() - (closed ? 1 : 0); }  // rows that are given
    friend bool operator==(const Axis&, const Axis&) = default;
  };

  // The distinct local surfaces, row by row: those of one p follow each other.
  static Result<GerbsSurface> make(BFunction b, Axis u, Axis v, const std::vector<Local>& locals);

  const BFunction& b_function() const { return b_; }
  const Axis& axis(Direction d) const { return axes_[d == Direction::u ? 0 : 1]; }
  const KnotVector<K>& knots(Direction d) const { return axis(d).knots; }
  // 0 ≤ p < knots(u).control_count(), 0 ≤ q < knots(v).control_count()
  const Local& local(int p, int q) const {
    return locals_[static_cast<std::size_t>(p) * knots(Direction::v).control_count() + q];
  }
  ParameterBox<K> domain() const {
    const KnotVector<K>&u = knots(Direction::u), &v = knots(Direction::v);
    return {u.domain_begin(), u.domain_end(), v.domain_begin(), v.domain_end()};
  }
  bool is_exact() const {
    return b_.is_exact() &&
           std::none_of(locals_.begin(), locals_.end(), [](const Local& c) { return c.is_trigonometric(); });
  }
  // The knots and those of local surfaces: between them S is one formula.
  std::vector<K> breaks(Direction d) const;
  // f(c) for each local surface.
  template <class F>
  GerbsSurface map_locals(F f) const {
    GerbsSurface out = *this;
    for (Local& local : out.locals_) local = f(local);
    return out;
  }

 private:
  GerbsSurface(BFunction b, Axis u, Axis v, std::vector<Local> locals)
      : b_(std::move(b)), axes_{std::move(u), std::move(v)}, locals_(std::move(locals)) {}

  BFunction b_;
  std::array<Axis, 2> axes_;
  std::vector<Local> locals_;
};

// All partial derivatives up to (order_u, order_v) of the formula that is the limit at `inside` from the sides; u and v of any
// scalar. REQUIRES `inside` in the domain.
template <Field R, OrderedField T, std::size_t M, OrderedField K>
PartialDerivatives<R, M - 1> partial_derivatives_at(const GerbsSurface<T, M, K>& surface,
                                                    const std::array<K, 2>& inside, const std::array<Side, 2>& sides,
                                                    const R& u, const R& v, int order_u, int order_v);

// What S is on an edge of its domain; with order 1, the derivative across it. REQUIRES splines across the edge, and for order 1 a
// B-function of order 1 or more and no local surface that is both rational and trigonometric.
template <OrderedField T, std::size_t M, OrderedField K>
GerbsCurve<T, M, K> edge(const GerbsSurface<T, M, K>& surface, EdgeName name, int order = 0);

// ---------------------------------------------------------------------------------------------------------------------

template <OrderedField T, std::size_t M, OrderedField K>
Result<GerbsSurface<T, M, K>> GerbsSurface<T, M, K>::make(BFunction b, Axis u, Axis v,
                                                          const std::vector<Local>& locals) {
  const std::size_t rows = std::max(0, u.distinct()), columns = std::max(0, v.distinct());
  const auto checked = [&](const Axis& axis, const std::string& name, std::size_t count) -> std::optional<Error> {
    auto error = detail::wrong_local_count(axis.knots, axis.closed, count, "rows of local surfaces");
    if (error) error->message = "in " + name + ": " + error->message;
    return error;
  };
  if (auto error = checked(u, "u", rows)) return *error;
  if (auto error = checked(v, "v", columns)) return *error;
  if (locals.size() != rows * columns)
    return Error{ErrorCode::wrong_count, "",
                 "the knots need " + std::to_string(rows) + " x " + std::to_string(columns) + " local surfaces",
                 std::to_string(locals.size())};
  const K period_u = u.knots.domain_end() - u.knots.domain_begin(),
          period_v = v.knots.domain_end() - v.knots.domain_begin();
  std::vector<Local> all;
  for (int p = 0; p < u.knots.control_count(); ++p)
    for (int q = 0; q < v.knots.control_count(); ++q) {
      const bool again_u = p == static_cast<int>(rows), again_v = q == static_cast<int>(columns);
      const Local& local = locals[(again_u ? 0 : p) * columns + (again_v ? 0 : q)];
      all.push_back(again_u || again_v ? local.shifted(again_u ? period_u : K(0), again_v ? period_v : K(0)) : local);
      for (const auto& [d, axis, i] : {std::tuple(Direction::u, &u, p), std::tuple(Direction::v, &v, q)}) {
        const auto [begin, end] = detail::used_on(axis->knots, i);
        if (!all.back().covers(d, begin, end))
          return Error{ErrorCode::outside_domain, "",
                       "local surface (" + std::to_string(p) + ", " + std::to_string(q) +
                           ") is not defined everywhere it is used in " + (d == Direction::u ? "u" : "v"),
                       to_text(begin) + " … " + to_text(end)};
      }
    }
  return GerbsSurface(std::move(b), std::move(u), std::move(v), std::move(all));
}

template <OrderedField T, std::size_t M, OrderedField K>
std::vector<K> GerbsSurface<T, M, K>::breaks(Direction d) const {
  const KnotVector<K>&of_u = knots(Direction::u), &of_v = knots(Direction::v);
  std::vector<K> out = knots(d).breaks();
  for (int p = 0; p < of_u.control_count(); ++p)
    for (int q = 0; q < of_v.control_count(); ++q) {
      const auto [begin, end] = detail::used_on(knots(d), d == Direction::u ? p : q);
      for (const K& t : local(p, q).breaks_between(d, begin, end)) out.push_back(t);
    }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

template <Field R, OrderedField T, std::size_t M, OrderedField K>
PartialDerivatives<R, M - 1> partial_derivatives_at(const GerbsSurface<T, M, K>& surface,
                                                    const std::array<K, 2>& inside, const std::array<Side, 2>& sides,
                                                    const R& u, const R& v, int order_u, int order_v) {
  const KnotVector<K>&knots_u = surface.knots(Direction::u), &knots_v = surface.knots(Direction::v);
  const int j = knots_u.find_span(inside[0], sides[0]), i = knots_v.find_span(inside[1], sides[1]);
  const auto local = [&](int p, int q) {
    return partial_derivatives_at<R>(surface.local(p, q), inside, sides, u, v, order_u, order_v);
  };
  using Table = PartialDerivatives<R, M - 1>;
  // (1 − B) first + B second in one direction.
  const auto blended = [&](const Table& first, const Table& second, const std::vector<R>& b, bool along_u) {
    std::vector<Vec<R, M - 1>> out;
    for (int k = 0; k <= order_u; ++k)
      for (int l = 0; l <= order_v; ++l) {
        const int r = along_u ? k : l;
        const std::vector<R> choose = binomial_row<R>(r);
        Vec<R, M - 1> sum = first.at(k, l);
        for (int a = 0; a <= r; ++a) {
          const int x = along_u ? k - a : k, y = along_u ? l : l - a;
          sum += (choose[a] * b[a]) * (second.at(x, y) - first.at(x, y));
        }
        out.push_back(std::move(sum));
      }
    return Table(order_u, order_v, std::move(out));
  };
  const auto row = [&](int p) {
    const Table first = local(p, i - 1);
    if (surface.local(p, i - 1) == surface.local(p, i)) return first;
    return blended(first, local(p, i),
                   detail::blend_derivatives(surface.b_function(), knots_v[i], knots_v[i + 1], v, order_v), false);
  };
  const Table first = row(j - 1);
  if (surface.local(j - 1, i - 1) == surface.local(j, i - 1) && surface.local(j - 1, i) == surface.local(j, i))
    return first;
  return blended(first, row(j), detail::blend_derivatives(surface.b_function(), knots_u[j], knots_u[j + 1], u, order_u),
                 true);
}

template <OrderedField T, std::size_t M, OrderedField K>
GerbsCurve<T, M, K> edge(const GerbsSurface<T, M, K>& surface, EdgeName name, int order) {
  const Direction constant = name == EdgeName::u_min || name == EdgeName::u_max ? Direction::u : Direction::v;
  const bool first = name == EdgeName::u_min || name == EdgeName::v_min;
  const KnotVector<K>& across = surface.knots(constant);
  const auto& along = surface.axis(other(constant));
  std::vector<LocalCurve<T, M, K>> locals;
  for (int k = 0; k < along.distinct(); ++k) {
    const int row = first ? 0 : across.control_count() - 1;
    const auto& local = constant == Direction::u ? surface.local(row, k) : surface.local(k, row);
    locals.push_back(edge_curve(local, constant, first ? across.domain_begin() : across.domain_end(),
                                first ? Side::right : Side::left, order));
  }
  return *GerbsCurve<T, M, K>::make(surface.b_function(), along.knots, std::move(locals), along.closed);
}

}  // namespace patchproof
