// SPDX-License-Identifier: Apache-2.0
// Gordon surfaces: the surface through a network of curves f_j(u) at v = v_j and g_i(v) at u = u_i.
//
//   S(u,v) = Σ_i L_i(u) g_i(v) + Σ_j M_j(v) f_j(u) − Σ_i Σ_j L_i(u) M_j(v) P_ij,    P_ij = f_j(u_i) = g_i(v_j)
//
// with the cardinal functions L_i of the sites u_i and M_j of the v_j (spline/cardinal.h): Lagrange's polynomials, or
// splines on knots of the caller's. Two curves each way and linear functions give the bilinear Coons patch.
//
// REQUIRES  f_j depend on u (coordinate 0) alone, g_i on v (coordinate 1) alone; a constant is a curve shrunk to a point.
// ENSURES   (1) S(u, v_j) = f_j(u) and S(u_i, v) = g_i(v), identically (contains_network proves it);  (2) curves taken from
//           a tensor-product patch of a degree that the cardinal functions reach give that patch;  (3) on linear knots and
//           two sites each way it is the Coons patch of coons_patch.h.
// SCALARS   T: ExactField, K: ExactField.
// ERRORS    wrong_count: as many curves as sites, at least two;  domains_differ: curves along one direction differ, or the
//           sites or knots leave their domain;  curves_apart: names the two curves that do not cross, and both points;
//           those of cardinal_controls.
// SOURCE    W. Gordon, Spline-blended surface interpolation through curve networks, J. Math. Mech. 18 (1969) 931–952.
// TEST      tests/patch/gordon_surface_test.cpp checks (1)–(3).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "patchproof/patch/coons_patch.h"
#include "patchproof/patch/transfinite_calculus.h"
#include "patchproof/spline/cardinal.h"

namespace patchproof {

// Curves along u at v = v[j], along v at u = u[i]; sites in growing order.
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
struct CurveNetwork {
  std::vector<K> u, v;
  std::vector<TransfiniteMap<T, 2, N, K>> along_u, along_v;
};

// With the cardinal functions of these knots.
template <ExactField T, std::size_t N, ExactField K>
Result<TransfiniteMap<T, 2, N, K>> gordon_surface(const CurveNetwork<T, N, K>& network, const KnotVector<K>& knots_u,
                                                  const KnotVector<K>& knots_v);

// With Lagrange's polynomials from the first site to the last.
template <ExactField T, std::size_t N, ExactField K>
Result<TransfiniteMap<T, 2, N, K>> gordon_surface(const CurveNetwork<T, N, K>& network);

// Does the surface contain every curve of the network? A proof, for every parameter.
template <ExactField T, std::size_t N, ExactField K>
bool contains_network(const TransfiniteMap<T, 2, N, K>& surface, const CurveNetwork<T, N, K>& network);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Σ_m N_m(x_s) Σ_i A_mi C_i: the C_i blended by the cardinal functions.
template <ExactField T, std::size_t N, ExactField K>
TransfiniteMap<T, 2, N, K> cardinal_blend(std::size_t s, const KnotVector<K>& knots,
                                          const std::vector<std::vector<K>>& cardinal,
                                          const std::vector<TransfiniteMap<T, 2, N, K>>& curves) {
  using Map = TransfiniteMap<T, 2, N, K>;
  std::vector<Map> controls;
  for (const std::vector<K>& row : cardinal) {
    Map control = embed<T>(row[0]) * curves[0];
    for (std::size_t i = 1; i < curves.size(); ++i) control = control + embed<T>(row[i]) * curves[i];
    controls.push_back(std::move(control));
  }
  return *Map::blend(s, knots, std::move(controls));
}

template <ExactField T, std::size_t N, ExactField K>
std::optional<Error> check_network(const CurveNetwork<T, N, K>& network, const KnotVector<K>& knots_u,
                                   const KnotVector<K>& knots_v) {
  for (const std::size_t s : {0, 1}) {
    const char* const name = s == 0 ? "u" : "v";
    const auto& curves = s == 0 ? network.along_u : network.along_v;
    const std::vector<K>& sites = s == 0 ? network.v : network.u;
    if (curves.size() < 2 || curves.size() != sites.size())
      return Error{ErrorCode::wrong_count, "",
                   std::string("the network needs at least two curves along ") + name + ", each with its parameter",
                   std::to_string(curves.size()) + " curves, " + std::to_string(sites.size()) + " parameters"};
    const KnotVector<K>& knots = s == 0 ? knots_u : knots_v;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      PATCHPROOF_REQUIRES(!curves[i].dependence(1 - s),
                          "gordon_surface: curves along u depend on u alone, and so for v");
      const CoordinateDomain<K>& domain = curves[i].dependence(s);
      if (domain && (domain->first != knots.domain_begin() || domain->second != knots.domain_end()))
        return Error{ErrorCode::domains_differ, "curve " + std::to_string(i) + " along " + name,
                     std::string("the curve and the blending functions in ") + name + " have different domains",
                     "[" + to_text(domain->first) + ", " + to_text(domain->second) + "] and [" +
                         to_text(knots.domain_begin()) + ", " + to_text(knots.domain_end()) + "]"};
    }
  }
  return std::nullopt;
}

}  // namespace detail

template <ExactField T, std::size_t N, ExactField K>
Result<TransfiniteMap<T, 2, N, K>> gordon_surface(const CurveNetwork<T, N, K>& network, const KnotVector<K>& knots_u,
                                                  const KnotVector<K>& knots_v) {
  using Map = TransfiniteMap<T, 2, N, K>;
  if (auto error = detail::check_network(network, knots_u, knots_v)) return *error;
  const auto cardinal_u = cardinal_controls(knots_u, network.u), cardinal_v = cardinal_controls(knots_v, network.v);
  if (!cardinal_u) return Error{cardinal_u.error().code, "u", cardinal_u.error().message, cardinal_u.error().values};
  if (!cardinal_v) return Error{cardinal_v.error().code, "v", cardinal_v.error().message, cardinal_v.error().values};
  std::vector<Map> through_points;  // for each u_i, the P_ij blended along v
  for (std::size_t i = 0; i < network.u.size(); ++i) {
    std::vector<Map> points;
    for (std::size_t j = 0; j < network.v.size(); ++j) {
      const ParameterPlace<K, 2> place({network.u[i], network.v[j]}), before(place.at, Side::left);
      const Vec<T, N> on_u = evaluate(network.along_u[j], place);
      for (const auto& [curve, from] : {std::pair(&network.along_v[i], &place), std::pair(&network.along_v[i], &before),
                                        std::pair(&network.along_u[j], &before)})
        if (const Vec<T, N> other = evaluate(*curve, *from); !(on_u == other))
          return Error{ErrorCode::curves_apart, "u = " + to_text(network.u[i]) + ", v = " + to_text(network.v[j]),
                       "curve " + std::to_string(j) + " along u and curve " + std::to_string(i) +
                           " along v do not cross, or one of them jumps there",
                       detail::point_text(on_u) + " and " + detail::point_text(other)};
      points.push_back(on_u);
    }
    through_points.push_back(detail::cardinal_blend(1, knots_v, *cardinal_v, points));
  }
  return detail::cardinal_blend(0, knots_u, *cardinal_u, network.along_v) +
         detail::cardinal_blend(1, knots_v, *cardinal_v, network.along_u) -
         detail::cardinal_blend(0, knots_u, *cardinal_u, through_points);
}

template <ExactField T, std::size_t N, ExactField K>
Result<TransfiniteMap<T, 2, N, K>> gordon_surface(const CurveNetwork<T, N, K>& network) {
  for (const std::vector<K>* sites : {&network.u, &network.v})
    for (std::size_t i = 0; i + 1 < sites->size() || i < 1; ++i) {
      const char* const name = sites == &network.u ? "u" : "v";
      if (sites->size() < 2)
        return Error{ErrorCode::wrong_count, name, "a network has at least two parameters each way",
                     std::to_string(sites->size())};
      if (!((*sites)[i] < (*sites)[i + 1]))
        return Error{ErrorCode::decreasing_knots, name,
                     "parameter " + std::to_string(i + 1) + " of the network is not larger than the one before it",
                     to_text((*sites)[i + 1]) + " after " + to_text((*sites)[i])};
    }
  return gordon_surface(
      network, KnotVector<K>::bezier(static_cast<int>(network.u.size()) - 1, network.u.front(), network.u.back()),
      KnotVector<K>::bezier(static_cast<int>(network.v.size()) - 1, network.v.front(), network.v.back()));
}

template <ExactField T, std::size_t N, ExactField K>
bool contains_network(const TransfiniteMap<T, 2, N, K>& surface, const CurveNetwork<T, N, K>& network) {
  for (const Side side : {Side::left, Side::right}) {
    for (std::size_t j = 0; j < network.v.size(); ++j)
      if (!identical(fix(surface, 1, network.v[j], side), network.along_u[j])) return false;
    for (std::size_t i = 0; i < network.u.size(); ++i)
      if (!identical(fix(surface, 0, network.u[i], side), network.along_v[i])) return false;
  }
  return true;
}

}  // namespace patchproof
