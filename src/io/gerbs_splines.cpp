// SPDX-License-Identifier: Apache-2.0
#include "gerbs_splines.h"

#include <fmt/format.h>

#include <algorithm>

#include "patchproof/patch/gerbs_expand.h"
#include "patchproof/patch/gerbs_outline.h"
#include "raw_spline.h"

namespace patchproof {
namespace {

// Some seconds of exact expansion.
constexpr double kMostWork = 3e5, kMostWorkOfPatch = 1e7;

template <ExactField T>
bool is_rational(const std::vector<Vec<T, 4>>& points) {
  return std::any_of(points.begin(), points.end(), [](const Vec<T, 4>& p) { return !(p[3] == T(1)); });
}

// The degree that the expansion would have in one direction, at most.
int expanded_degree(const BFunction& b, const std::vector<int>& locals) {
  const auto largest = std::minmax_element(locals.begin(), locals.end());
  const std::size_t of_b = std::max(b.numerator().size(), b.denominator().size());
  return static_cast<int>(of_b) - 1 + *largest.second;
}

template <ExactField T>
bool is_too_high(const GerbsCurve<T, 4>& curve) {
  if (!curve.is_exact()) return true;
  std::vector<int> degrees;
  for (const auto& c : curve.locals()) degrees.push_back(c.basis().knots()->degree() * (c.has_unit_weights() ? 1 : 2));
  const int degree = expanded_degree(curve.b_function(), degrees);
  return degree > kMaxDegree || static_cast<double>(curve.breaks().size()) * degree * degree * degree > kMostWork;
}

template <ExactField T>
bool is_too_high(const GerbsSurface<T, 4>& surface) {
  if (!surface.is_exact()) return true;
  double work = 1;
  for (const Direction d : {Direction::u, Direction::v}) {
    std::vector<int> degrees;
    for (int p = 0; p < surface.knots(Direction::u).control_count(); ++p)
      for (int q = 0; q < surface.knots(Direction::v).control_count(); ++q)
        degrees.push_back(surface.local(p, q).basis(d).knots()->degree());
    const int degree = expanded_degree(surface.b_function(), degrees);
    if (degree > kMaxDegree) return true;
    work *= static_cast<double>(surface.breaks(d).size()) * degree * degree;
  }
  return work > kMostWorkOfPatch;
}

}  // namespace

template <ExactField T>
SplineModel<T> gerbs_to_splines(const Model<T>& model) {
  SplineModel<T> out{model, {}, {}, {}};
  out.model.gerbs_curves.clear();
  out.model.gerbs_patches.clear();
  for (const ModelGerbsPatch<T>& patch : model.gerbs_patches) {
    const std::size_t number = out.model.patches.size();
    Result<BsplinePatch<T, 4>> made =
        is_too_high(patch.surface) ? Error{ErrorCode::unsupported, "", "", ""} : to_patch(patch.surface);
    if (made) {
      out.notes.push_back(fmt::format("patch {}: GERBS surface, expanded exactly to degree ({}, {})", number,
                                      made->degree(Direction::u), made->degree(Direction::v)));
    } else {
      out.outlined_patches.push_back(number);
      made = outline(patch.surface);
    }
    const bool rational = is_rational(made->net());
    out.model.patches.push_back({patch.name, std::move(*made), rational});
  }
  for (const ModelGerbsCurve<T>& curve : model.gerbs_curves) {
    const std::size_t number = out.model.curves.size();
    Result<BsplineCurve<T, 4>> made =
        is_too_high(curve.curve) ? Error{ErrorCode::unsupported, "", "", ""} : to_spline(curve.curve);
    if (made) {
      out.notes.push_back(fmt::format("curve {}: GERBS curve, expanded exactly to degree {}", number, made->degree()));
    } else {
      out.outlined_curves.push_back(number);
      made = outline(curve.curve);
    }
    const bool rational = is_rational(made->points());
    out.model.curves.push_back({curve.name, std::move(*made), rational, curve.dimension});
  }
  return out;
}

template SplineModel<Rational> gerbs_to_splines(const Model<Rational>&);
template SplineModel<Quadratic> gerbs_to_splines(const Model<Quadratic>&);

}  // namespace patchproof
