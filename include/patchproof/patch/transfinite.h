// SPDX-License-Identifier: Apache-2.0
// Transfinite maps: maps of D parameters into T^N that are built from points by blending, adding and multiplying, where the
// control data of a blend may be points or again maps of the whole parameter point.
//
//   M(x) = P                              a constant
//   M(x) = Σ_i N_{i,p}(x_s) C_i(x)        a blend in the coordinate s; Bézier when the knots are
//   M(x) = M_1(x) + … + M_n(x)            a sum
//   M(x) = f(x) M_1(x)                    a product with a map f into T^1
//
// D = 1, 2, 3: curves, surfaces, solids; any D will do. Ruled, Bézier, B-spline, Coons and Gordon surfaces are all built so,
// rational ones as maps to homogeneous points. M is a polynomial on each box between knots, so that two maps can be proved
// equal (transfinite_identity.h) and a map of one or two parameters is a B-spline (transfinite_expand.h).
//
// Derivatives follow the full product rule, ∂_s M = Σ N'_i C_i + Σ N_i ∂_s C_i, since they are taken by evaluating at power
// series (scalar/power_series.h).
//
// REQUIRES  parameters in the domain: [t_p, t_n] of the blends in that coordinate; without a blend anywhere.
//           …_at: any parameters; the piece next to `place` is continued.
// ENSURES   (1) evaluate is the formula above;  (2) a blend with constants only is the B-spline curve of its points, and a
//           blend of such blends in another coordinate the tensor-product patch;  (3) Bézier blends interpolate: M = C_0
//           at the begin and C_n at the end of x_s;  (4) taylor gives all partial derivatives of the piece, exactly;
//           (5) maps whose weights sum to 1 are affinely invariant: A(M) is built from A(C_i);
//           (6) evaluate_at in an enclosure encloses M, in Tracked it bounds the error of double.
// SCALARS   T: Ring (Field for evaluation in T), K: OrderedField. …_at: any Ring R into which T and K embed.
// ERRORS    blend: wrong_count, domains_differ.
// COST      the number of live controls: a blend visits degree + 1 of them.
// SOURCE    A. Paoluzzi, Geometric Programming for Computer-Aided Design, ch. 11–12 (transfinite Bézier and B-splines).
// TEST      tests/patch/transfinite_test.cpp checks (1)–(6).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/scalar/power_series.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {

// The interval of one coordinate; empty: the map does not depend on it.
template <OrderedField K>
using CoordinateDomain = std::optional<std::pair<K, K>>;

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
struct TransfiniteNode;

// A map is a handle of an immutable tree: copies are cheap and share it.
template <Ring T, std::size_t D, std::size_t N, OrderedField K = knot_scalar_t<T>>
class TransfiniteMap {
 public:
  using Point = Vec<T, N>;
  using Function = TransfiniteMap<T, D, 1, K>;
  using Node = TransfiniteNode<T, D, N, K>;

  // The constant map.
  TransfiniteMap(Point point);
  // Σ N_{i,p}(x_s) C_i(x), s = coordinate, 0-based.
  // ERRORS  wrong_count unless there are knots.control_count() controls;  domains_differ when two blends in one coordinate
  //         have different domains.
  static Result<TransfiniteMap> blend(std::size_t coordinate, KnotVector<K> knots,
                                      std::vector<TransfiniteMap> controls);
  // The Bézier blend on [begin, end]. ERRORS as above; wrong_count without controls.
  static Result<TransfiniteMap> bezier(std::size_t coordinate, std::vector<TransfiniteMap> controls,
                                       const K& begin = K(0), const K& end = K(1));

  // REQUIRES (all of them) equal domains in the coordinates that both depend on.
  friend TransfiniteMap operator+(const TransfiniteMap& a, const TransfiniteMap& b) { return a.plus(b); }
  friend TransfiniteMap operator-(const TransfiniteMap& a, const TransfiniteMap& b) { return a.plus(T(-1) * b); }
  friend TransfiniteMap operator*(const T& s, const TransfiniteMap& m) { return m.times(Function(Vec<T, 1>{{s}})); }
  // f(x) · M(x)
  friend TransfiniteMap product(const Function& f, const TransfiniteMap& m) { return m.times(f); }

  // Empty when the map does not depend on x_s.
  const CoordinateDomain<K>& dependence(std::size_t s) const { return node_->domains[s]; }
  // [0, 1] where it does not.
  K domain_begin(std::size_t s) const { return dependence(s) ? dependence(s)->first : K(0); }
  K domain_end(std::size_t s) const { return dependence(s) ? dependence(s)->second : K(1); }

  const Node& node() const { return *node_; }

 private:
  explicit TransfiniteMap(Node node) : node_(std::make_shared<const Node>(std::move(node))) {}
  TransfiniteMap plus(const TransfiniteMap& o) const;
  TransfiniteMap times(const Function& f) const;

  std::shared_ptr<const Node> node_;
};

// What a map is made of.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
struct TransfiniteNode {
  using Map = TransfiniteMap<T, D, N, K>;
  struct Constant {
    Vec<T, N> point;
  };
  struct Blend {
    std::size_t coordinate;
    KnotVector<K> knots;
    std::vector<Map> controls;
  };
  struct Sum {
    std::vector<Map> terms;
  };
  struct Product {
    TransfiniteMap<T, D, 1, K> factor;
    Map map;
  };
  std::variant<Constant, Blend, Sum, Product> kind;
  std::array<CoordinateDomain<K>, D> domains{};
};

// A parameter point, and from which side it is approached in each coordinate.
template <OrderedField K, std::size_t D>
struct ParameterPlace {
  std::array<K, D> at;
  std::array<Side, D> sides{};

  ParameterPlace(std::array<K, D> where, Side side = Side::right) : at(std::move(where)) { sides.fill(side); }
  ParameterPlace(std::array<K, D> where, std::array<Side, D> from) : at(std::move(where)), sides(from) {}
};

// The piece of M that is its limit at `place`, at the parameters x. REQUIRES place in the domain.
template <Ring R, Ring T, std::size_t D, std::size_t N, OrderedField K>
Vec<R, N> evaluate_at(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place,
                      const std::array<R, D>& x);

// M(x), as the limit at the place.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Vec<T, N> evaluate(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place);

// M as a power series about the place: component c's ∂^α is taylor(…)[c].derivative(α). REQUIRES order ≥ 0.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Vec<PowerSeries<T, D>, N> taylor(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place, int order);

// The affine point and series of a map to homogeneous points. REQUIRES a weight at the place that is not certainly zero.
template <Field T, std::size_t D, std::size_t M, OrderedField K>
Vec<T, M - 1> evaluate_rational(const TransfiniteMap<T, D, M, K>& map, const ParameterPlace<K, D>& place) {
  return project(evaluate(map, place));
}
template <Field T, std::size_t D, std::size_t M, OrderedField K>
Vec<PowerSeries<T, D>, M - 1> rational_taylor(const TransfiniteMap<T, D, M, K>& map, const ParameterPlace<K, D>& place,
                                              int order);

// A curve along the coordinate s.
template <std::size_t D, Ring T, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> curve_along(std::size_t s, const BsplineCurve<T, N, K>& curve) {
  return *TransfiniteMap<T, D, N, K>::blend(
      s, curve.knots(), std::vector<TransfiniteMap<T, D, N, K>>(curve.points().begin(), curve.points().end()));
}

// A tensor-product patch over the coordinates s and t.
template <std::size_t D, Ring T, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> patch_over(std::size_t s, std::size_t t, const BsplinePatch<T, N, K>& patch);

// x_s itself, on [begin, end].
template <Ring T, std::size_t D, OrderedField K = knot_scalar_t<T>>
TransfiniteMap<T, D, 1, K> coordinate_function(std::size_t s, const std::type_identity_t<K>& begin = K(0),
                                               const std::type_identity_t<K>& end = K(1)) {
  return *TransfiniteMap<T, D, 1, K>::bezier(s, {Vec<T, 1>{{embed<T>(begin)}}, Vec<T, 1>{{embed<T>(end)}}}, begin, end);
}

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Takes over b's domains; the first coordinate in which both have different ones.
template <OrderedField K, std::size_t D>
std::optional<std::size_t> merge_domains(std::array<CoordinateDomain<K>, D>& a,
                                         const std::array<CoordinateDomain<K>, D>& b) {
  for (std::size_t s = 0; s < D; ++s) {
    if (a[s] && b[s] && *a[s] != *b[s]) return s;
    if (!a[s]) a[s] = b[s];
  }
  return std::nullopt;
}

}  // namespace detail

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K>::TransfiniteMap(Point point)
    : TransfiniteMap(Node{typename Node::Constant{std::move(point)}}) {}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, D, N, K>> TransfiniteMap<T, D, N, K>::blend(std::size_t coordinate, KnotVector<K> knots,
                                                                     std::vector<TransfiniteMap> controls) {
  PATCHPROOF_REQUIRES(coordinate < D, "TransfiniteMap::blend: no such coordinate");
  if (static_cast<int>(controls.size()) != knots.control_count())
    return Error{ErrorCode::wrong_count, "", "the knots need " + std::to_string(knots.control_count()) + " controls",
                 std::to_string(controls.size())};
  std::array<CoordinateDomain<K>, D> domains{};
  domains[coordinate] = std::pair(knots.domain_begin(), knots.domain_end());
  for (std::size_t i = 0; i < controls.size(); ++i)
    if (const auto s = detail::merge_domains(domains, controls[i].node().domains))
      return Error{ErrorCode::domains_differ, "",
                   "control " + std::to_string(i) + " has another domain in parameter " + std::to_string(*s + 1) +
                       " than those before it",
                   to_text(controls[i].domain_begin(*s)) + " … " + to_text(controls[i].domain_end(*s)) + " after " +
                       to_text(domains[*s]->first) + " … " + to_text(domains[*s]->second)};
  return TransfiniteMap(
      Node{typename Node::Blend{coordinate, std::move(knots), std::move(controls)}, std::move(domains)});
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, D, N, K>> TransfiniteMap<T, D, N, K>::bezier(std::size_t coordinate,
                                                                      std::vector<TransfiniteMap> controls,
                                                                      const K& begin, const K& end) {
  if (controls.empty()) return Error{ErrorCode::wrong_count, "", "a Bézier blend needs at least one control", "0"};
  const int degree = static_cast<int>(controls.size()) - 1;
  return blend(coordinate, KnotVector<K>::bezier(degree, begin, end), std::move(controls));
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> TransfiniteMap<T, D, N, K>::plus(const TransfiniteMap& o) const {
  std::array<CoordinateDomain<K>, D> domains = node_->domains;
  PATCHPROOF_REQUIRES(!detail::merge_domains(domains, o.node_->domains), "TransfiniteMap: the domains differ");
  return TransfiniteMap(Node{typename Node::Sum{{*this, o}}, std::move(domains)});
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> TransfiniteMap<T, D, N, K>::times(const Function& f) const {
  std::array<CoordinateDomain<K>, D> domains = node_->domains;
  PATCHPROOF_REQUIRES(!detail::merge_domains(domains, f.node().domains), "TransfiniteMap: the domains differ");
  return TransfiniteMap(Node{typename Node::Product{f, *this}, std::move(domains)});
}

template <Ring R, Ring T, std::size_t D, std::size_t N, OrderedField K>
Vec<R, N> evaluate_at(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place,
                      const std::array<R, D>& x) {
  using Node = TransfiniteNode<T, D, N, K>;
  const auto& kind = map.node().kind;
  Vec<R, N> sum;
  for (std::size_t c = 0; c < N; ++c) sum[c] = R(0);
  if (const auto* constant = std::get_if<typename Node::Constant>(&kind)) {
    for (std::size_t c = 0; c < N; ++c) sum[c] = embed<R>(constant->point[c]);
  } else if (const auto* blend = std::get_if<typename Node::Blend>(&kind)) {
    const std::size_t s = blend->coordinate;
    const int span = blend->knots.find_span(place.at[s], place.sides[s]);
    const std::vector<R> live = basis_in_span<R>(blend->knots, span, x[s]);
    for (std::size_t l = 0; l < live.size(); ++l)
      sum += live[l] * evaluate_at<R>(blend->controls[span - blend->knots.degree() + l], place, x);
  } else if (const auto* terms = std::get_if<typename Node::Sum>(&kind)) {
    for (const auto& term : terms->terms) sum += evaluate_at<R>(term, place, x);
  } else {
    const auto& product = std::get<typename Node::Product>(kind);
    sum = evaluate_at<R>(product.factor, place, x)[0] * evaluate_at<R>(product.map, place, x);
  }
  return sum;
}

namespace detail {

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
void require_in_domain(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place) {
  for (std::size_t s = 0; s < D; ++s)
    PATCHPROOF_REQUIRES(
        !map.dependence(s) || (map.dependence(s)->first <= place.at[s] && place.at[s] <= map.dependence(s)->second),
        "TransfiniteMap: the parameter lies outside the domain");
}

}  // namespace detail

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Vec<T, N> evaluate(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place) {
  detail::require_in_domain(map, place);
  std::array<T, D> x;
  for (std::size_t s = 0; s < D; ++s) x[s] = embed<T>(place.at[s]);
  return evaluate_at<T>(map, place, x);
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Vec<PowerSeries<T, D>, N> taylor(const TransfiniteMap<T, D, N, K>& map, const ParameterPlace<K, D>& place, int order) {
  detail::require_in_domain(map, place);
  std::array<PowerSeries<T, D>, D> x;
  for (std::size_t s = 0; s < D; ++s) x[s] = PowerSeries<T, D>::variable(s, embed<T>(place.at[s]), order);
  return evaluate_at<PowerSeries<T, D>>(map, place, x);
}

template <Field T, std::size_t D, std::size_t M, OrderedField K>
Vec<PowerSeries<T, D>, M - 1> rational_taylor(const TransfiniteMap<T, D, M, K>& map, const ParameterPlace<K, D>& place,
                                              int order) {
  const Vec<PowerSeries<T, D>, M> h = taylor(map, place, order);
  PATCHPROOF_REQUIRES(!detail::is_certainly_zero(h[M - 1].constant_term()),
                      "the homogeneous point lies at infinity: its weight is zero");
  return project(h);
}

template <std::size_t D, Ring T, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> patch_over(std::size_t s, std::size_t t, const BsplinePatch<T, N, K>& patch) {
  using Map = TransfiniteMap<T, D, N, K>;
  const int columns = patch.count(Direction::v);
  std::vector<Map> rows;
  for (int i = 0; i < patch.count(Direction::u); ++i)
    rows.push_back(curve_along<D>(
        t, BsplineCurve<T, N, K>(patch.knots(Direction::v),
                                 {patch.net().begin() + i * columns, patch.net().begin() + (i + 1) * columns})));
  return *Map::blend(s, patch.knots(Direction::u), std::move(rows));
}

}  // namespace patchproof
