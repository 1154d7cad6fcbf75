// SPDX-License-Identifier: Apache-2.0
// Bicubically blended Coons patches whose cross-boundary derivatives disagree about the twists in the corners.
//
// In a corner let τ^v = ∂_u S_v (from the side along u) and τ^u = ∂_v S_u (from the side along v). The bicubic sum with
// τ^v has the wrong S_v on the sides along u unless τ^u = τ^v. With ũ, ṽ the distances from the corner in units of the
// sides' lengths h_u, h_v, and s = ±1 (the corner's direction), Gregory's twist  (ṽ τ^v + ũ τ^u)/(ũ + ṽ)  mends it:
//   S = bicubic sum with τ^v − Σ_corners s h_u h_v (τ^u − τ^v) · ũ² ṽ (1−ũ)² (1−ṽ)² / (ũ + ṽ)
// Each correction is rational, without a pole in the domain but for 0/0 in its own corner, where it is 0 and so are its
// first derivatives; second derivatives do not exist there (that is what disagreeing twists mean).
//
// REQUIRES  as coons_patch.h.
// ENSURES   (1) the four boundaries and the four cross-boundary derivatives are interpolated, identically
//           (interpolates_everywhere proves it on the sides without their ends; the ends are (2));  (2) in a corner the
//           value and the first derivatives are those of the data;  (3) with equal twists it is the bicubic patch.
// SCALARS   T: ExactField, K: ExactField.
// ERRORS    those of bicubic_coons_patch but twists_differ.
// SOURCE    J. Gregory, Smooth interpolation without twist constraints, in Computer Aided Geometric Design (1974) 71–88;
//           G. Farin, Curves and Surfaces for CAGD, 5th ed., §22.5.
// TEST      tests/patch/coons_gregory_patch_test.cpp checks (1)–(3).
#pragma once

#include <utility>

#include "patchproof/patch/coons_patch.h"

namespace patchproof {

template <ExactField T, std::size_t N, ExactField K = knot_scalar_t<T>>
class CoonsGregoryPatch {
 public:
  using Map = TransfiniteMap<T, 2, N, K>;

  static Result<CoonsGregoryPatch> make(const FourSides<T, N, K>& boundary, const FourSides<T, N, K>& across);

  // (S·Q, Q) with Q the product of ũ + ṽ over the corners whose twists differ: zero there, positive elsewhere.
  const TransfiniteMap<T, 2, N + 1, K>& homogeneous() const { return homogeneous_; }
  // The bicubic sum with the twists of the sides along u: S up to first order in every corner.
  const Map& bicubic() const { return bicubic_; }
  bool has_pole_in_corner(const ParameterPlace<K, 2>& place) const {
    return is_zero(fix(fix(component(homogeneous_, N), 0, place.at[0]), 1, place.at[1]));
  }

 private:
  CoonsGregoryPatch(Map bicubic, TransfiniteMap<T, 2, N + 1, K> homogeneous)
      : bicubic_(std::move(bicubic)), homogeneous_(std::move(homogeneous)) {}
  static bool is_zero(const TransfiniteMap<T, 2, 1, K>& constant) {
    return evaluate(constant, ParameterPlace<K, 2>({constant.domain_begin(0), constant.domain_begin(1)}))[0] == T(0);
  }

  Map bicubic_;
  TransfiniteMap<T, 2, N + 1, K> homogeneous_;
};

// S(u,v). REQUIRES the place in the domain.
template <ExactField T, std::size_t N, ExactField K>
Vec<T, N> evaluate(const CoonsGregoryPatch<T, N, K>& patch, const ParameterPlace<K, 2>& place) {
  return patch.has_pole_in_corner(place) ? evaluate(patch.bicubic(), place)
                                         : evaluate_rational(patch.homogeneous(), place);
}

// S as a power series about the place. REQUIRES order ≤ 1 in a corner whose twists differ.
template <ExactField T, std::size_t N, ExactField K>
Vec<PowerSeries<T, 2>, N> taylor(const CoonsGregoryPatch<T, N, K>& patch, const ParameterPlace<K, 2>& place,
                                 int order) {
  if (!patch.has_pole_in_corner(place)) return rational_taylor(patch.homogeneous(), place, order);
  PATCHPROOF_REQUIRES(order <= 1, "CoonsGregoryPatch: second derivatives do not exist in a corner whose twists differ");
  return taylor(patch.bicubic(), place, order);
}

// Has the surface these boundaries and these derivatives across them? With S = F/Q, on each side:
// F = boundary·Q and ∂F − boundary·∂Q = across·Q, as identities of polynomials.
template <ExactField T, std::size_t N, ExactField K>
bool interpolates_everywhere(const CoonsGregoryPatch<T, N, K>& patch, const FourSides<T, N, K>& boundary,
                             const FourSides<T, N, K>& across);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// (numerator, 0) + denominator · (0, …, 0, 1)
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N + 1, K> with_denominator(const TransfiniteMap<T, D, N, K>& numerator,
                                                const TransfiniteMap<T, D, 1, K>& denominator) {
  return linear_image(numerator,
                      [](const Vec<T, N>& a) {
                        Vec<T, N + 1> h = zero_point<T, N + 1>();
                        for (std::size_t c = 0; c < N; ++c) h[c] = a[c];
                        return h;
                      }) +
         linear_image(denominator, [](const Vec<T, 1>& w) {
           Vec<T, N + 1> h = zero_point<T, N + 1>();
           h[N] = w[0];
           return h;
         });
}

template <Ring T, std::size_t D, std::size_t M, OrderedField K>
TransfiniteMap<T, D, M - 1, K> numerator(const TransfiniteMap<T, D, M, K>& map) {
  return linear_image(map, [](const Vec<T, M>& h) {
    Vec<T, M - 1> a;
    for (std::size_t c = 0; c + 1 < M; ++c) a[c] = h[c];
    return a;
  });
}

}  // namespace detail

template <ExactField T, std::size_t N, ExactField K>
Result<CoonsGregoryPatch<T, N, K>> CoonsGregoryPatch<T, N, K>::make(const FourSides<T, N, K>& boundary,
                                                                    const FourSides<T, N, K>& across) {
  using Function = typename Map::Function;
  detail::CoonsDomain<K> domain;
  if (auto error = detail::check_across(domain, boundary, across)) return *error;
  Map bicubic = detail::bicubic_sum(domain, boundary, across);

  const Function one(Vec<T, 1>{{T(1)}});
  // The distance from one end of a side, in units of its length.
  const auto distance = [&](std::size_t s, bool from_end) {
    const Vec<T, 1> zero{{T(0)}}, unit{{T(1)}};
    return *Function::bezier(s, {from_end ? unit : zero, from_end ? zero : unit}, domain.begin(s), domain.end(s));
  };
  Function denominator = one;
  Map corrections(detail::zero_point<T, N>());  // the sum of the corrections is corrections/denominator
  for (const detail::Corner<K>& corner : domain.corners()) {
    const ParameterPlace<K, 2> place({corner.u, corner.v});
    const Vec<T, N> difference = evaluate(derivative(detail::side_along_v(across, corner), 1), place) -
                                 evaluate(derivative(detail::side_along_u(across, corner), 0), place);
    if (difference == detail::zero_point<T, N>()) continue;
    const Function u = distance(0, corner.u_end), v = distance(1, corner.v_end), sum = u + v;
    const Function away = product(one - u, one - v);
    const Function bump = product(product(product(u, u), v), product(away, away));
    const T size = embed<T>(domain.length(0)) * embed<T>(domain.length(1)) * T(corner.u_end == corner.v_end ? 1 : -1);
    corrections = product(sum, corrections) + product(product(denominator, bump), Map(size * difference));
    denominator = product(denominator, sum);
  }
  auto homogeneous = detail::with_denominator(product(denominator, bicubic) - corrections, denominator);
  return CoonsGregoryPatch(std::move(bicubic), std::move(homogeneous));
}

template <ExactField T, std::size_t N, ExactField K>
bool interpolates_everywhere(const CoonsGregoryPatch<T, N, K>& patch, const FourSides<T, N, K>& boundary,
                             const FourSides<T, N, K>& across) {
  const auto side_holds = [&](std::size_t s, bool at_end, const auto& curve, const auto& rate) {
    const K t = at_end ? patch.homogeneous().domain_end(s) : patch.homogeneous().domain_begin(s);
    const auto value = fix(patch.homogeneous(), s, t), change = fix(derivative(patch.homogeneous(), s), s, t);
    const auto weight = component(value, N), weight_change = component(change, N);
    return identical(detail::numerator(value), product(weight, curve)) &&
           identical(detail::numerator(change) - product(weight_change, curve), product(weight, rate));
  };
  return side_holds(1, false, boundary.v_min, across.v_min) && side_holds(1, true, boundary.v_max, across.v_max) &&
         side_holds(0, false, boundary.u_min, across.u_min) && side_holds(0, true, boundary.u_max, across.u_max);
}

}  // namespace patchproof
