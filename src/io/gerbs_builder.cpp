// SPDX-License-Identifier: Apache-2.0
// GERBS curves and patches of a model: the step from texts to exact ones.
#include <fmt/format.h>

#include <algorithm>

#include "model_builder.h"
#include "patchproof/patch/affine.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

template <ExactField T>
bool is_narrow(const T& a, const T& b) {
  const T size = std::max({a, T(-a), b, T(-b)});
  return (b - a) * T(1 << 20) * T(1 << 20) < size;
}

}  // namespace

template <ExactField T>
bool ModelBuilder<T>::fail_at(const RawGerbs& raw, const Error& error) {
  return fail(error.code, raw.at, error.where.empty() ? error.message : error.where + ": " + error.message,
              error.values, raw.pointer);
}

template <ExactField T>
std::optional<KnotVector<T>> ModelBuilder<T>::gerbs_knots_of(const RawGerbs& raw, int d) {
  std::vector<T> breaks(raw.knots[d].size());
  const std::string list = raw.pointer + "/knots" + (raw.directions == 2 ? fmt::format("/{}", d) : "");
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    const std::string pointer = fmt::format("{}/{}", list, k);
    if (!number_at(raw.knots[d][k], pointer, breaks[k])) return std::nullopt;
    if (k > 0 && breaks[k] < breaks[k - 1]) {
      fail(ErrorCode::decreasing_knots, raw.knots[d][k], fmt::format("knot {} is smaller than the one before it", k),
           fmt::format("{} after {}", raw.knots[d][k], raw.knots[d][k - 1]), pointer);
      return std::nullopt;
    }
  }
  for (std::size_t k = 1; k < breaks.size(); ++k)
    if (breaks[k - 1] < breaks[k] && is_narrow(breaks[k - 1], breaks[k])) {
      fail(ErrorCode::bad_number, raw.knots[d][k],
           "a span of the knots is below 2^-40 of their size: too short beside them in double precision",
           fmt::format("{} … {}", raw.knots[d][k - 1], raw.knots[d][k]), fmt::format("{}/{}", list, k));
      return std::nullopt;
    }
  Result<KnotVector<T>> made = gerbs_knots(std::move(breaks), raw.closed[d]);
  if (made) return std::move(*made);
  fail(made.error().code, raw.knots[d].empty() ? raw.at : raw.knots[d].front(), made.error().message,
       made.error().values, list);
  return std::nullopt;
}

template <ExactField T>
std::optional<typename ModelBuilder<T>::Local> ModelBuilder<T>::local(const RawLocal& raw,
                                                                      const std::vector<Local>& earlier) {
  Local out;
  if (!raw.same_as.empty()) {
    const std::optional<long> index = to_integer(raw.same_as);
    if (!index || *index < 0 || static_cast<std::size_t>(*index) >= earlier.size()) {
      fail(ErrorCode::bad_reference, raw.same_as,
           fmt::format("only local curves or patches before this one, 0 … {}, can be meant",
                       static_cast<long>(earlier.size()) - 1),
           raw.same_as, raw.pointer + "/same_as");
      return std::nullopt;
    }
    out = earlier[*index];
  } else {
    const RawSpline& spline = raw.spline;
    std::array<int, 2> counts{1, 1};
    for (int d = 0; d < spline.directions; ++d) {
      if (raw.trigonometric[d]) {
        if (spline.degree[d] < 0 || spline.degree[d] > kMaxDegree || !spline.knots[d].empty()) {
          fail(ErrorCode::bad_degree, spline.at,
               fmt::format("a trigonometric direction has 0 … {} harmonics as its degree, and no knots", kMaxDegree),
               fmt::format("{}", spline.degree[d]), spline.degree_pointer(d));
          return std::nullopt;
        }
        if (spline.weight_form != Weights::none) {
          fail(ErrorCode::unsupported, spline.at, "trigonometric curves and patches have no weights", "",
               spline.weights_pointer());
          return std::nullopt;
        }
        out.bases.push_back(TrigonometricFunctions{static_cast<int>(spline.degree[d])});
      } else {
        std::optional<KnotVector<T>> made = knots(spline, d);
        if (!made) return std::nullopt;
        out.bases.push_back(std::move(*made));
      }
      counts[d] = out.bases.back().count();
    }
    std::optional<std::vector<Vec<T, 4>>> made = points(spline, counts);
    if (!made) return std::nullopt;
    out.points = std::move(*made);
    out.dimension = spline.dimension();
    // The weight of a trigonometric one stands at its constant.
    for (std::size_t k = 0; k < out.points.size(); ++k) {
      const bool constant =
          (!raw.trigonometric[0] || k / counts[1] == 0) && (!raw.trigonometric[1] || k % counts[1] == 0);
      if (!constant) out.points[k][3] = T(0);
    }
    const bool rational = spline.weight_form != Weights::none;
    if (rational && spline.directions == 1 &&
        !denominator_is_fine(weight_place(spline), BsplineCurve<T, 4>(*out.bases[0].knots(), out.points)))
      return std::nullopt;
    if (rational && spline.directions == 2 &&
        !denominator_is_fine(weight_place(spline),
                             BsplinePatch<T, 4>(*out.bases[0].knots(), *out.bases[1].knots(), out.points)))
      return std::nullopt;
  }
  if (raw.map.empty()) return out;
  AffineMap<T> map;
  for (std::size_t k = 0; k < 12; ++k) {
    const std::string pointer = fmt::format("{}/map/{}/{}", raw.pointer, k / 4, k % 4);
    if (!number_at(raw.map[k], pointer, k % 4 == 3 ? map.shift[k / 4] : map.linear[k / 4][k % 4])) return std::nullopt;
  }
  for (Vec<T, 4>& p : out.points) {
    p = apply(map, p);
    if (is_bounded(p)) continue;
    fail(ErrorCode::bad_number, raw.at, "the mapped points are not below 2^1000 in size", "", raw.pointer + "/map");
    return std::nullopt;
  }
  if (std::any_of(out.points.begin(), out.points.end(), [](const Vec<T, 4>& p) { return !(p[2] == T(0)); }))
    out.dimension = 3;
  return out;
}

template <ExactField T>
bool ModelBuilder<T>::add_gerbs_curve(const RawGerbs& raw, BFunction b, const std::vector<Local>& locals) {
  std::optional<KnotVector<T>> knots = gerbs_knots_of(raw, 0);
  if (!knots) return false;
  std::vector<LocalCurve<T, 4>> made;
  int dimension = 2;
  for (const Local& l : locals) {
    dimension = std::max(dimension, l.dimension);
    made.push_back(l.bases[0].is_trigonometric() ? *LocalCurve<T, 4>::trigonometric(l.points)
                                                 : LocalCurve<T, 4>(BsplineCurve<T, 4>(*l.bases[0].knots(), l.points)));
  }
  Result<GerbsCurve<T, 4>> curve =
      GerbsCurve<T, 4>::make(std::move(b), std::move(*knots), std::move(made), raw.closed[0]);
  if (!curve) return fail_at(raw, curve.error());
  model_.gerbs_curves.push_back({raw.name, std::move(*curve), dimension});
  return true;
}

template <ExactField T>
bool ModelBuilder<T>::add_gerbs_patch(const RawGerbs& raw, BFunction b, const std::vector<Local>& locals) {
  using Surface = GerbsSurface<T, 4>;
  std::optional<KnotVector<T>> u = gerbs_knots_of(raw, 0);
  if (!u) return false;
  std::optional<KnotVector<T>> v = gerbs_knots_of(raw, 1);
  if (!v) return false;
  std::vector<LocalSurface<T, 4>> made;
  for (const Local& l : locals) made.push_back(*LocalSurface<T, 4>::make(l.bases[0], l.bases[1], l.points));
  Result<Surface> surface =
      Surface::make(std::move(b), {std::move(*u), raw.closed[0]}, {std::move(*v), raw.closed[1]}, made);
  if (!surface) return fail_at(raw, surface.error());
  model_.gerbs_patches.push_back({raw.name, std::move(*surface)});
  return true;
}

template <ExactField T>
bool ModelBuilder<T>::add_blend(const RawGerbs& raw, BFunction b) {
  T overlap;
  if (!number_at(raw.overlap, raw.pointer + "/blend/overlap", overlap)) return false;
  std::vector<BsplineCurve<T, 4>> curves;
  int dimension = 2;
  for (const char* which : {"first", "second"}) {
    const std::optional<Local> made = local(raw.blended.at(which), {});
    if (!made) return false;
    dimension = std::max(dimension, made->dimension);
    curves.emplace_back(*made->bases[0].knots(), made->points);
  }
  Result<GerbsCurve<T, 4>> curve = GerbsCurve<T, 4>::blend(std::move(b), curves[0], curves[1], overlap);
  if (!curve) return fail_at(raw, curve.error());
  model_.gerbs_curves.push_back({raw.name, std::move(*curve), dimension});
  return true;
}

template <ExactField T>
std::optional<Error> ModelBuilder<T>::add(const RawGerbs& raw) {
  error_.reset();
  Result<BFunction> b = BFunction::parse(raw.b_function);
  if (!b) {
    fail(b.error().code, raw.at, b.error().message, b.error().values, raw.pointer + "/b_function");
    return error_;
  }
  if (raw.is_blend()) {
    add_blend(raw, std::move(*b));
    return error_;
  }
  std::vector<Local> locals;
  for (const RawLocal& l : raw.locals) {
    std::optional<Local> made = local(l, locals);
    if (!made) return error_;
    locals.push_back(std::move(*made));
  }
  if (raw.directions == 1)
    add_gerbs_curve(raw, std::move(*b), locals);
  else
    add_gerbs_patch(raw, std::move(*b), locals);
  return error_;
}

template std::optional<Error> ModelBuilder<Rational>::add(const RawGerbs&);
template std::optional<Error> ModelBuilder<Quadratic>::add(const RawGerbs&);

}  // namespace patchproof
