// SPDX-License-Identifier: Apache-2.0
// Coons patches: the surface through four boundary curves, and with given cross-boundary derivatives.
//
// On [a, b] × [c, d], with û = (u − a)/(b − a), v̂ = (v − c)/(d − c) and P_ij the corners:
//   bilinear   S = (1−v̂) S(u,c) + v̂ S(u,d) + (1−û) S(a,v) + û S(b,v)
//                − [(1−û)(1−v̂) P_00 + (1−û) v̂ P_01 + û (1−v̂) P_10 + û v̂ P_11]
//   bicubic    S = 𝒫_u + 𝒫_v − 𝒫_u 𝒫_v, where 𝒫_u interpolates S(a,v), S_u(a,v), S_u(b,v), S(b,v) by the cubic in u with
//              Bézier controls S(a,v), S(a,v) + (b−a)/3 S_u(a,v), S(b,v) − (b−a)/3 S_u(b,v), S(b,v), and 𝒫_v likewise
// The corner term is subtracted, and it holds the corner points, not the curves: a sum of the three parts interpolates
// nothing (docs/errata.md, E-LAR-01).
//
// REQUIRES  v_min, v_max depend on u (coordinate 0) alone, u_min, u_max on v (coordinate 1) alone; a constant is a
//           degenerate edge.
// ENSURES   (1) the four boundaries are interpolated, identically;  (2) bicubic: so are the four cross-boundary
//           derivatives;  (3) affine maps of the data map the surface;  (4) the boundaries of a bilinear patch give that
//           patch;  (5) rational: the affine surface is the bilinear one of the affine boundary curves, whatever factors
//           their homogeneous points carry.
//           interpolates(…) proves (1), (2) of a surface as identities of polynomials, on every piece.
// SCALARS   T: Field with ==; exact for proofs and rational boundaries. K: OrderedField.
// ERRORS    domains_differ: boundaries that face each other have different domains;  curves_apart: names the corner and
//           the two points that should be one;  bicubic: curves_apart when a cross-boundary derivative does not begin or
//           end with the tangent of the boundary there, twists_differ when ∂_u S_v and ∂_v S_u disagree in a corner (then
//           coons_gregory_patch.h).
// SOURCE    S. Coons, Surfaces for computer-aided design of space forms, MIT MAC-TR-41 (1967); G. Farin, Curves and
//           Surfaces for CAGD, 5th ed., ch. 22.
// TEST      tests/patch/coons_patch_test.cpp checks (1)–(5).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "patchproof/patch/transfinite.h"
#include "patchproof/patch/transfinite_calculus.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof {

// Four functions on the boundary of a patch: its curves, or the derivatives across them (S_v on v_min and v_max, S_u on
// u_min and u_max). v_min is the side v = c, running along u.
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
struct FourSides {
  TransfiniteMap<T, 2, N, K> v_min, v_max, u_min, u_max;
};

template <Field T, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, 2, N, K>> coons_patch(const FourSides<T, N, K>& boundary);

template <Field T, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, 2, N, K>> bicubic_coons_patch(const FourSides<T, N, K>& boundary,
                                                       const FourSides<T, N, K>& across);

// The bilinear patch of rational boundary curves, given by homogeneous points; again to homogeneous points.
template <ExactField T, std::size_t M, ExactField K>
Result<TransfiniteMap<T, 2, M, K>> rational_coons_patch(const FourSides<T, M, K>& boundary);

// Has the surface these boundaries? A proof, for every parameter.
template <ExactField T, std::size_t N, ExactField K>
bool interpolates(const TransfiniteMap<T, 2, N, K>& surface, const FourSides<T, N, K>& boundary);
// The same of affine points.
template <ExactField T, std::size_t M, ExactField K>
bool interpolates_points(const TransfiniteMap<T, 2, M, K>& surface, const FourSides<T, M, K>& boundary);
// Has the surface these derivatives across its boundaries?
template <ExactField T, std::size_t N, ExactField K>
bool interpolates_across(const TransfiniteMap<T, 2, N, K>& surface, const FourSides<T, N, K>& across);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <class T, std::size_t N>
std::string point_text(const Vec<T, N>& p) {
  std::string text = "(";
  for (std::size_t c = 0; c < N; ++c) text += (c == 0 ? "" : ", ") + to_text(p[c]);
  return text + ")";
}

// One corner, and the ends of the sides that meet there.
template <OrderedField K>
struct Corner {
  bool u_end, v_end;
  K u, v;
  std::string name() const {
    return std::string("corner ") + (u_end ? "u_max" : "u_min") + ", " + (v_end ? "v_max" : "v_min");
  }
};

template <Ring T, std::size_t N, OrderedField K>
const TransfiniteMap<T, 2, N, K>& side_along_u(const FourSides<T, N, K>& sides, const Corner<K>& corner) {
  return corner.v_end ? sides.v_max : sides.v_min;
}
template <Ring T, std::size_t N, OrderedField K>
const TransfiniteMap<T, 2, N, K>& side_along_v(const FourSides<T, N, K>& sides, const Corner<K>& corner) {
  return corner.u_end ? sides.u_max : sides.u_min;
}

template <OrderedField K>
struct CoonsDomain {
  std::array<CoordinateDomain<K>, 2> intervals{};

  K begin(std::size_t s) const { return intervals[s] ? intervals[s]->first : K(0); }
  K end(std::size_t s) const { return intervals[s] ? intervals[s]->second : K(1); }
  K length(std::size_t s) const { return end(s) - begin(s); }
  std::array<Corner<K>, 4> corners() const {
    return {Corner<K>{false, false, begin(0), begin(1)}, Corner<K>{true, false, end(0), begin(1)},
            Corner<K>{false, true, begin(0), end(1)}, Corner<K>{true, true, end(0), end(1)}};
  }
};

// Takes the sides into the domain.
template <Ring T, std::size_t N, OrderedField K>
std::optional<Error> add_sides(CoonsDomain<K>& domain, const FourSides<T, N, K>& sides, const char* what) {
  const TransfiniteMap<T, 2, N, K>* const along[2][2] = {{&sides.v_min, &sides.v_max}, {&sides.u_min, &sides.u_max}};
  for (const std::size_t s : {0, 1})
    for (const auto* side : along[s]) {
      PATCHPROOF_REQUIRES(!side->dependence(1 - s),
                          "Coons patch: v_min, v_max depend on u alone, u_min, u_max on v alone");
      const CoordinateDomain<K>& own = side->dependence(s);
      if (domain.intervals[s] && own && *domain.intervals[s] != *own)
        return Error{ErrorCode::domains_differ, "",
                     std::string(what) + " along " + (s == 0 ? "u" : "v") + " have different domains",
                     "[" + to_text(domain.intervals[s]->first) + ", " + to_text(domain.intervals[s]->second) +
                         "] and [" + to_text(own->first) + ", " + to_text(own->second) + "]"};
      if (own) domain.intervals[s] = own;
    }
  return std::nullopt;
}

// Do two functions have one value in every corner?
template <Field T, std::size_t N, OrderedField K, class First, class Second>
std::optional<Error> check_corners(const CoonsDomain<K>& domain, ErrorCode code, const std::string& message,
                                   First first, Second second) {
  for (const Corner<K>& corner : domain.corners()) {
    const ParameterPlace<K, 2> place({corner.u, corner.v});
    const Vec<T, N> a = first(corner, place), b = second(corner, place);
    if (!(a == b)) return Error{code, corner.name(), message, point_text(a) + " and " + point_text(b)};
  }
  return std::nullopt;
}

template <Ring T, std::size_t N, OrderedField K>
TransfiniteMap<T, 2, N, K> blend_over(const CoonsDomain<K>& domain, std::size_t s,
                                      std::vector<TransfiniteMap<T, 2, N, K>> controls) {
  return *TransfiniteMap<T, 2, N, K>::bezier(s, std::move(controls), domain.begin(s), domain.end(s));
}

// The four controls of the cubic with these ends and these derivatives there.
template <Field T, std::size_t N, OrderedField K>
TransfiniteMap<T, 2, N, K> cubic_over(const CoonsDomain<K>& domain, std::size_t s,
                                      const TransfiniteMap<T, 2, N, K>& begin,
                                      const TransfiniteMap<T, 2, N, K>& rate_begin,
                                      const TransfiniteMap<T, 2, N, K>& end,
                                      const TransfiniteMap<T, 2, N, K>& rate_end) {
  const T third = embed<T>(domain.length(s)) / T(3);
  return blend_over<T, N, K>(domain, s, {begin, begin + third * rate_begin, end - third * rate_end, end});
}

// The bilinear patch of the four corners.
template <Field T, std::size_t N, OrderedField K>
TransfiniteMap<T, 2, N, K> corner_patch(const CoonsDomain<K>& domain, const FourSides<T, N, K>& boundary) {
  using Map = TransfiniteMap<T, 2, N, K>;
  const auto at = [&](const Map& side, std::size_t s, const K& t) { return fix(side, s, t); };
  const auto row = [&](const K& u) {
    return blend_over<T, N, K>(domain, 1, {at(boundary.v_min, 0, u), at(boundary.v_max, 0, u)});
  };
  return blend_over<T, N, K>(domain, 0, {row(domain.begin(0)), row(domain.end(0))});
}

template <Field T, std::size_t N, OrderedField K>
std::optional<Error> check_boundary(CoonsDomain<K>& domain, const FourSides<T, N, K>& boundary) {
  if (auto error = add_sides(domain, boundary, "the boundary curves")) return error;
  return check_corners<T, N>(
      domain, ErrorCode::curves_apart, "two boundary curves do not meet",
      [&](const auto& corner, const auto& place) { return evaluate(side_along_u(boundary, corner), place); },
      [&](const auto& corner, const auto& place) { return evaluate(side_along_v(boundary, corner), place); });
}

// Everything a bicubic patch asks for but the twists.
template <Field T, std::size_t N, OrderedField K>
std::optional<Error> check_across(CoonsDomain<K>& domain, const FourSides<T, N, K>& boundary,
                                  const FourSides<T, N, K>& across) {
  if (auto error = check_boundary(domain, boundary)) return error;
  if (auto error = add_sides(domain, across, "the cross-boundary derivatives")) return error;
  if (auto error = check_corners<T, N>(
          domain, ErrorCode::curves_apart, "S_v given across a boundary is not the tangent of the boundary it meets",
          [&](const auto& corner, const auto& place) { return evaluate(side_along_u(across, corner), place); },
          [&](const auto& corner, const auto& place) {
            return evaluate(derivative(side_along_v(boundary, corner), 1), place);
          }))
    return error;
  return check_corners<T, N>(
      domain, ErrorCode::curves_apart, "S_u given across a boundary is not the tangent of the boundary it meets",
      [&](const auto& corner, const auto& place) { return evaluate(side_along_v(across, corner), place); },
      [&](const auto& corner, const auto& place) {
        return evaluate(derivative(side_along_u(boundary, corner), 0), place);
      });
}

// 𝒫_u + 𝒫_v − 𝒫_u 𝒫_v with the twists ∂_u S_v of the sides v_min and v_max.
template <Field T, std::size_t N, OrderedField K>
TransfiniteMap<T, 2, N, K> bicubic_sum(const CoonsDomain<K>& domain, const FourSides<T, N, K>& boundary,
                                       const FourSides<T, N, K>& across) {
  using Map = TransfiniteMap<T, 2, N, K>;
  const Map in_u = cubic_over(domain, 0, boundary.u_min, across.u_min, boundary.u_max, across.u_max);
  const Map in_v = cubic_over(domain, 1, boundary.v_min, across.v_min, boundary.v_max, across.v_max);
  const auto cubic_of = [&](const Map& side) {  // 𝒫_u of a function of u
    const Map rate = derivative(side, 0);
    const K &a = domain.begin(0), b = domain.end(0);
    return cubic_over(domain, 0, fix(side, 0, a), fix(rate, 0, a), fix(side, 0, b), fix(rate, 0, b));
  };
  return in_u + in_v -
         cubic_over(domain, 1, cubic_of(boundary.v_min), cubic_of(across.v_min), cubic_of(boundary.v_max),
                    cubic_of(across.v_max));
}

}  // namespace detail

template <Field T, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, 2, N, K>> coons_patch(const FourSides<T, N, K>& boundary) {
  detail::CoonsDomain<K> domain;
  if (auto error = detail::check_boundary(domain, boundary)) return *error;
  return detail::blend_over<T, N, K>(domain, 1, {boundary.v_min, boundary.v_max}) +
         detail::blend_over<T, N, K>(domain, 0, {boundary.u_min, boundary.u_max}) -
         detail::corner_patch(domain, boundary);
}

template <Field T, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, 2, N, K>> bicubic_coons_patch(const FourSides<T, N, K>& boundary,
                                                       const FourSides<T, N, K>& across) {
  detail::CoonsDomain<K> domain;
  if (auto error = detail::check_across(domain, boundary, across)) return *error;
  if (auto error = detail::check_corners<T, N>(
          domain, ErrorCode::twists_differ, "the derivatives across two boundaries have different twists",
          [&](const auto& corner, const auto& place) {
            return evaluate(derivative(detail::side_along_u(across, corner), 0), place);
          },
          [&](const auto& corner, const auto& place) {
            return evaluate(derivative(detail::side_along_v(across, corner), 1), place);
          }))
    return *error;
  return detail::bicubic_sum(domain, boundary, across);
}

// With A/W for each side and D a common multiple of the four W: D·S is the sum of the sides' A·(D/W), blended, less D times
// the bilinear patch of the corner points.
template <ExactField T, std::size_t M, ExactField K>
Result<TransfiniteMap<T, 2, M, K>> rational_coons_patch(const FourSides<T, M, K>& boundary) {
  using Homogeneous = TransfiniteMap<T, 2, M, K>;
  using Function = typename Homogeneous::Function;
  constexpr std::size_t N = M - 1;
  using Map = TransfiniteMap<T, 2, N, K>;
  detail::CoonsDomain<K> domain;
  if (auto error = detail::add_sides(domain, boundary, "the boundary curves")) return *error;
  if (auto error = detail::check_corners<T, N>(
          domain, ErrorCode::curves_apart, "two boundary curves do not meet",
          [&](const auto& corner, const auto& place) {
            return evaluate_rational(detail::side_along_u(boundary, corner), place);
          },
          [&](const auto& corner, const auto& place) {
            return evaluate_rational(detail::side_along_v(boundary, corner), place);
          }))
    return *error;
  const Function one(Vec<T, 1>{{T(1)}});
  // The weight along a side; as a constant where it is one, which keeps the degree low.
  const auto weight = [](const Homogeneous& side) {
    const Function w = component(side, N);
    const Function constant = evaluate(w, ParameterPlace<K, 2>({side.domain_begin(0), side.domain_begin(1)}));
    return identical(w, constant) ? constant : w;
  };
  const auto numerator = [](const Homogeneous& side) {
    return linear_image(side, [](const Vec<T, M>& p) {
      Vec<T, N> a;
      for (std::size_t c = 0; c < N; ++c) a[c] = p[c];
      return a;
    });
  };
  // Of two sides that face each other: the common multiple of their weights, and what each lacks of it.
  struct Pair {
    Function multiple, first_lacks, second_lacks;
  };
  const auto common = [&](const Homogeneous& a, const Homogeneous& b) {
    const Function wa = weight(a), wb = weight(b);
    return identical(wa, wb) ? Pair{wa, one, one} : Pair{product(wa, wb), wb, wa};
  };
  const Pair along_u = common(boundary.v_min, boundary.v_max), along_v = common(boundary.u_min, boundary.u_max);
  const Map in_v = product(along_v.multiple,
                           detail::blend_over<T, N, K>(domain, 1,
                                                       {product(along_u.first_lacks, numerator(boundary.v_min)),
                                                        product(along_u.second_lacks, numerator(boundary.v_max))}));
  const Map in_u = product(along_u.multiple,
                           detail::blend_over<T, N, K>(domain, 0,
                                                       {product(along_v.first_lacks, numerator(boundary.u_min)),
                                                        product(along_v.second_lacks, numerator(boundary.u_max))}));
  const Function denominator = product(along_u.multiple, along_v.multiple);
  std::vector<Map> corners;
  for (const detail::Corner<K>& corner : domain.corners())
    corners.push_back(
        evaluate_rational(detail::side_along_u(boundary, corner), ParameterPlace<K, 2>({corner.u, corner.v})));
  const Map bilinear = detail::blend_over<T, N, K>(domain, 1,
                                                   {detail::blend_over<T, N, K>(domain, 0, {corners[0], corners[1]}),
                                                    detail::blend_over<T, N, K>(domain, 0, {corners[2], corners[3]})});
  const auto lift = [](const Vec<T, N>& a) {
    Vec<T, M> h;
    for (std::size_t c = 0; c < N; ++c) h[c] = a[c];
    h[N] = T(0);
    return h;
  };
  Vec<T, M> unit_weight = detail::zero_point<T, M>();
  unit_weight[N] = T(1);
  return linear_image(in_v + in_u - product(denominator, bilinear), lift) +
         product(denominator, Homogeneous(unit_weight));
}

namespace detail {

template <ExactField T, std::size_t N, ExactField K, class Same>
bool has_sides(const TransfiniteMap<T, 2, N, K>& in_u, const TransfiniteMap<T, 2, N, K>& in_v,
               const FourSides<T, N, K>& sides, Same same) {
  return same(fix(in_v, 1, in_v.domain_begin(1)), sides.v_min) && same(fix(in_v, 1, in_v.domain_end(1)), sides.v_max) &&
         same(fix(in_u, 0, in_u.domain_begin(0)), sides.u_min) && same(fix(in_u, 0, in_u.domain_end(0)), sides.u_max);
}

}  // namespace detail

template <ExactField T, std::size_t N, ExactField K>
bool interpolates(const TransfiniteMap<T, 2, N, K>& surface, const FourSides<T, N, K>& boundary) {
  return detail::has_sides(surface, surface, boundary, [](const auto& a, const auto& b) { return identical(a, b); });
}

template <ExactField T, std::size_t M, ExactField K>
bool interpolates_points(const TransfiniteMap<T, 2, M, K>& surface, const FourSides<T, M, K>& boundary) {
  return detail::has_sides(surface, surface, boundary,
                           [](const auto& a, const auto& b) { return identical_points(a, b); });
}

template <ExactField T, std::size_t N, ExactField K>
bool interpolates_across(const TransfiniteMap<T, 2, N, K>& surface, const FourSides<T, N, K>& across) {
  return detail::has_sides(derivative(surface, 0), derivative(surface, 1), across,
                           [](const auto& a, const auto& b) { return identical(a, b); });
}

}  // namespace patchproof
