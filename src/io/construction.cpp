// SPDX-License-Identifier: Apache-2.0
#include "construction.h"

#include <fmt/format.h>

#include <algorithm>

#include "patchproof/patch/coons_patch.h"
#include "patchproof/patch/gordon_surface.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/patch/transfinite_expand.h"

namespace patchproof {
namespace {

template <ExactField T, std::size_t N>
using Map = TransfiniteMap<T, 2, N>;
template <ExactField T>
using Controls = std::vector<ControlCurve<T>>;

template <ExactField T>
bool is_rational(const Controls<T>& controls) {
  return std::any_of(controls.begin(), controls.end(), [](const ControlCurve<T>& c) { return c.curve.is_rational; });
}

// N = 3: the points of a polynomial curve; N = 4: homogeneous ones.
template <std::size_t N, ExactField T>
Map<T, N> constant(const Vec<T, 4>& p) {
  Vec<T, N> point;
  for (std::size_t c = 0; c < N; ++c) point[c] = p[c];
  return Map<T, N>(point);
}

// The curve as a map that depends on coordinate s alone.
template <std::size_t N, ExactField T>
Map<T, N> curve_map(const ControlCurve<T>& control, std::size_t s) {
  const BsplineCurve<T, 4>& curve = control.curve.curve;
  if (control.is_point) return constant<N>(curve.points()[0]);
  std::vector<Map<T, N>> points;
  for (const Vec<T, 4>& p : curve.points()) points.push_back(constant<N>(p));
  return *Map<T, N>::blend(s, curve.knots(), std::move(points));  // a curve has as many points as its knots need
}

template <std::size_t N, ExactField T>
std::vector<Map<T, N>> curve_maps(const Controls<T>& controls, std::size_t s) {
  std::vector<Map<T, N>> out;
  for (const ControlCurve<T>& control : controls) out.push_back(curve_map<N>(control, s));
  return out;
}

template <std::size_t N, ExactField T>
FourSides<T, N> four_sides(const Construction<T>& construction, const std::string& prefix) {
  const auto side = [&](const char* name, std::size_t s) {
    return curve_map<N>(construction.curves.at(prefix + name).front(), s);
  };
  return {side("v_min", 0), side("v_max", 0), side("u_min", 1), side("u_max", 1)};
}

// Is the expansion to a spline on these knots too much work?
template <ExactField T>
std::optional<Error> check_size(const Construction<T>& construction, const KnotVector<T>& u, const KnotVector<T>& v) {
  double curves = 0;
  std::size_t digits = 0;
  for (const auto& [key, list] : construction.curves) {
    curves += static_cast<double>(list.size());
    for (const ControlCurve<T>& c : list)
      for (const Vec<T, 4>& p : c.curve.curve.points())
        for (const T& x : p.c) digits = std::max(digits, to_text(x).size());
  }
  const double length = std::max(1.0, static_cast<double>(digits) / 50);  // of numbers, in those of ordinary files
  const double points = (u.degree() + 1.0) * (v.degree() + 1.0);
  const double boxes = static_cast<double>(u.breaks().size() - 1) * static_cast<double>(v.breaks().size() - 1);
  if (boxes * points * points * curves * length <= kMaxExpansion) return std::nullopt;
  return Error{ErrorCode::unsupported, "",
               fmt::format("the expanded patch would be too large: spans x control points of each, squared, x curves "
                           "may be {:.0g}",
                           kMaxExpansion),
               fmt::format("{} x {} spans of degree ({}, {}), {} curves, numbers of up to {} characters",
                           u.breaks().size() - 1, v.breaks().size() - 1, u.degree(), v.degree(), curves, digits)};
}

// The map's own error, or the B-spline that it is.
template <ExactField T, std::size_t N>
Result<ExpandedConstruction<T>> expanded(const Construction<T>& construction, const Result<Map<T, N>>& map,
                                         bool is_rational, std::string kind) {
  if (!map) return map.error();
  const KnotVector<T> u = spline_knots(*map, 0), v = spline_knots(*map, 1);
  for (const KnotVector<T>* knots : {&u, &v})
    if (knots->degree() > kMaxDegree)
      return Error{ErrorCode::bad_degree, "",
                   fmt::format("the expanded patch would have a degree above {}", kMaxDegree),
                   fmt::format("{}", knots->degree())};
  if (auto error = check_size(construction, u, v)) return *error;
  if constexpr (N == 4)
    return ExpandedConstruction<T>{to_bspline_patch(*map), is_rational, std::move(kind)};
  else
    return ExpandedConstruction<T>{to_homogeneous(to_bspline_patch(*map)), is_rational, std::move(kind)};
}

template <ExactField T>
Result<ExpandedConstruction<T>> expand_coons(const Construction<T>& construction) {
  bool rational = false;
  std::size_t across = 0;
  for (const auto& [key, list] : construction.curves) {
    rational = rational || is_rational(list);
    across += key.starts_with("across_") ? 1 : 0;
  }
  if (across != 0 && across != 4)
    return Error{ErrorCode::wrong_count, "",
                 "the derivatives across all four boundaries are needed, or none: across_v_min, across_v_max, "
                 "across_u_min, across_u_max",
                 fmt::format("{}", across)};
  if (across == 4 && rational)
    return Error{ErrorCode::unsupported, "", "a bicubically blended Coons patch of rational curves is not made", ""};
  if (across == 4)
    return expanded(construction,
                    bicubic_coons_patch(four_sides<3>(construction, ""), four_sides<3>(construction, "across_")), false,
                    "bicubically blended Coons patch");
  if (rational)
    return expanded(construction, rational_coons_patch(four_sides<4>(construction, "")), true,
                    "bilinearly blended Coons patch of rational curves");
  return expanded(construction, coons_patch(four_sides<3>(construction, "")), false, "bilinearly blended Coons patch");
}

template <ExactField T>
Result<ExpandedConstruction<T>> expand_transfinite(const Construction<T>& construction) {
  const Controls<T>& controls = construction.curves.at("controls");
  const std::size_t along = construction.along_u ? 0 : 1;
  return expanded(construction, Map<T, 4>::blend(along, *construction.blending, curve_maps<4>(controls, 1 - along)),
                  is_rational(controls), fmt::format("transfinite patch, blended along {}", along == 0 ? "u" : "v"));
}

template <ExactField T>
Result<ExpandedConstruction<T>> expand_gordon(const Construction<T>& construction) {
  const Controls<T>&along_u = construction.curves.at("along_u"), &along_v = construction.curves.at("along_v");
  if (is_rational(along_u) || is_rational(along_v))
    return Error{ErrorCode::unsupported, "", "a Gordon surface through rational curves is not made", ""};
  const std::size_t most = std::max(along_u.size(), along_v.size());
  if (most > kMaxDegree + 1)  // before a system of so many equations is solved
    return Error{ErrorCode::bad_degree, "", fmt::format("the expanded patch would have a degree above {}", kMaxDegree),
                 fmt::format("{} curves", most)};
  // What the surface has at least, before anything is solved or blended.
  for (const auto& [parameters, curves_here] :
       {std::pair(&construction.parameters.at("u"), &along_v), std::pair(&construction.parameters.at("v"), &along_u)}) {
    double digits = 0;
    for (const T& x : *parameters) digits = std::max(digits, static_cast<double>(to_text(x).size()));
    if (const double n = static_cast<double>(curves_here->size()); n * n * n * n * digits > kMaxSystem)
      return Error{ErrorCode::unsupported, "", "the blending functions of the Gordon surface would be too much work",
                   fmt::format("{} curves at parameters of up to {} digits", curves_here->size(), digits)};
  }
  const auto knots_at_least = [](const Controls<T>& along, std::size_t sites) {
    const KnotVector<T>* most = nullptr;
    for (const ControlCurve<T>& c : along)
      if (!c.is_point && (!most || c.curve.curve.knots().breaks().size() > most->breaks().size()))
        most = &c.curve.curve.knots();
    int degree = static_cast<int>(sites) - 1;
    for (const ControlCurve<T>& c : along) degree = std::max(degree, c.is_point ? 0 : c.curve.curve.degree());
    degree = std::max(degree, 1);
    std::vector<T> knots(degree + 1, T(0));
    const std::size_t spans = most ? most->breaks().size() - 1 : 1;
    for (std::size_t k = 1; k < spans; ++k) knots.push_back(T(static_cast<int>(k)));
    knots.insert(knots.end(), degree + 1, T(static_cast<int>(spans)));
    return KnotVector<T>::make_unchecked(degree, std::move(knots));
  };
  if (auto error =
          check_size(construction, knots_at_least(along_u, along_v.size()), knots_at_least(along_v, along_u.size())))
    return *error;
  const CurveNetwork<T, 3> network{construction.parameters.at("u"), construction.parameters.at("v"),
                                   curve_maps<3>(along_u, 0), curve_maps<3>(along_v, 1)};
  return expanded(construction, gordon_surface(network), false,
                  fmt::format("Gordon surface through {} and {} curves", along_u.size(), along_v.size()));
}

}  // namespace

template <ExactField T>
Result<ExpandedConstruction<T>> expand(const Construction<T>& construction) {
  switch (construction.kind) {
    case RawConstruction::Kind::coons: return expand_coons(construction);
    case RawConstruction::Kind::transfinite: return expand_transfinite(construction);
    case RawConstruction::Kind::gordon: break;
  }
  return expand_gordon(construction);
}

template Result<ExpandedConstruction<Rational>> expand(const Construction<Rational>&);
template Result<ExpandedConstruction<Quadratic>> expand(const Construction<Quadratic>&);

}  // namespace patchproof
