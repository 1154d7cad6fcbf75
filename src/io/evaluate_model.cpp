// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/evaluate_model.h"

#include <cmath>
#include <tuple>
#include <type_traits>

#include "model_part.h"
#include "patchproof/patch/rational_patch.h"

namespace patchproof {
namespace {

// A parameter in the scalar of the values.
template <Ring R, ExactField T>
R as(const T& x) {
  if constexpr (std::is_same_v<R, double>)
    return nearest_double(x);
  else
    return embed<R>(x);
}

template <Ring R, class F>
auto rounded_upward(F f) {
  if constexpr (std::is_same_v<R, Interval>) {
    const RoundingGuard guard;
    return f();
  } else {
    return f();
  }
}

template <Ring R, Ring U>
ModelValues<R> rows(const PartialDerivatives<U, 3>& derivatives, int order) {
  ModelValues<R> out;
  for (int total = 0; total <= order; ++total)
    for (int l = 0; l <= total; ++l) {
      ModelDerivative<R> row{{total - l, l, 0}, {}};
      for (std::size_t c = 0; c < 3; ++c) row.value[c] = embed<R>(derivatives.at(total - l, l)[c]);
      out.rows.push_back(std::move(row));
    }
  return out;
}

template <Ring R>
ModelValues<R> rows(const std::vector<Vec<R, 3>>& derivatives, int dimension) {
  ModelValues<R> out{dimension, {}};
  for (std::size_t k = 0; k < derivatives.size(); ++k)
    out.rows.push_back({{static_cast<int>(k), 0, 0}, derivatives[k]});
  return out;
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const BsplinePatch<T, 4>& surface, const PlaceAsked<T>& a) {
  const int span_u = surface.knots(Direction::u).find_span(a.at[0], a.sides[0]),
            span_v = surface.knots(Direction::v).find_span(a.at[1], a.sides[1]);
  return rounded_upward<R>([&] {
    return rows<R>(rational_derivatives(partial_derivatives_in_span<R>(surface, span_u, span_v, as<R>(a.at[0]),
                                                                       as<R>(a.at[1]), a.order, a.order)),
                   a.order);
  });
}

// GERBS have exact values where their parts have.
template <Ring R, ExactField T>
std::optional<Error> without_exact_values(bool is_exact, const BFunction& b) {
  if (is_exact || !std::is_same_v<R, T>) return std::nullopt;
  return Error{ErrorCode::unsupported, "scalar", "the values of this GERBS are transcendental: intervals enclose them",
               b.to_string()};
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const GerbsSurface<T, 4>& surface, const PlaceAsked<T>& a) {
  if (auto error = without_exact_values<R, T>(surface.is_exact(), surface.b_function())) return *error;
  return rounded_upward<R>([&] {
    return rows<R>(partial_derivatives_at<R>(surface, std::array<T, 2>{a.at[0], a.at[1]}, {a.sides[0], a.sides[1]},
                                             as<R>(a.at[0]), as<R>(a.at[1]), a.order, a.order),
                   a.order);
  });
}

template <Ring R, ExactField T>
PartialDerivatives<R, 3> series_values(const GregoryPatch<T>& patch, const GregorySpans& spans, const R& u, const R& v,
                                       int order) {
  using Series = PowerSeries<R, 2>;
  const Vec<Series, 3> s =
      evaluate_in_spans<Series>(patch, spans, Series::variable(0, u, order), Series::variable(1, v, order));
  std::vector<Vec<R, 3>> values;
  for (int k = 0; k <= order; ++k)
    for (int l = 0; l <= order; ++l) {
      Vec<R, 3> x;
      if (k + l <= order)
        for (int c = 0; c < 3; ++c) x[c] = s[c].derivative({k, l});
      values.push_back(x);
    }
  return {order, order, std::move(values)};
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const GregoryPatch<T>& patch, const PlaceAsked<T>& a) {
  const T &u = a.at[0], &v = a.at[1];
  if ((u == T(0) || u == T(1)) && (v == T(0) || v == T(1))) {
    if (a.order > 1)
      return Error{ErrorCode::unsupported, "derivatives",
                   "a Gregory patch has no second derivatives at its corners, only limits along the edges", a.shown()};
    const SurfaceFrame<T> s = frame(patch, u, v);
    return rows<R>(PartialDerivatives<T, 3>(1, 1, {s.point, s.dv, s.du, {}}), a.order);
  }
  const GregorySpans spans = find_spans(patch, u, v, a.sides[0], a.sides[1]);
  if constexpr (!std::is_same_v<R, T>) {
    // Next to a corner rounded numbers lose what cancels there (and β its squares): exact values, rounded, stand for them.
    const T reach = T(1) / T(1 << 20);
    const auto is_near = [&](const T& x) { return x < reach || T(1) - reach < x; };
    if (is_near(u) && is_near(v)) return rows<R>(series_values<T>(patch, spans, u, v, a.order), a.order);
  }
  return rounded_upward<R>([&] {
    R x = as<R>(u), y = as<R>(v);
    if constexpr (std::is_same_v<R, double>) std::tie(x, y) = detail::off_the_corners(x, y);
    return rows<R>(series_values<R>(patch, spans, x, y, a.order), a.order);
  });
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const ModelCurve<T>& model, const PlaceAsked<T>& a) {
  const int span = model.curve.knots().find_span(a.at[0], a.sides[0]);
  return rounded_upward<R>([&] {
    std::vector<Vec<R, 4>> homogeneous;
    for (int k = 0; k <= a.order; ++k)
      homogeneous.push_back(derivative_in_span<R>(model.curve, span, as<R>(a.at[0]), k));
    return rows(rational_derivatives(homogeneous), model.dimension);
  });
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const ModelGerbsCurve<T>& model, const PlaceAsked<T>& a) {
  if (auto error = without_exact_values<R, T>(model.curve.is_exact(), model.curve.b_function())) return *error;
  return rounded_upward<R>([&] {
    return rows(derivatives_at<R>(model.curve, a.at[0], a.sides[0], as<R>(a.at[0]), a.order), model.dimension);
  });
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const TransfiniteMap<T, 3, 4>& map, const PlaceAsked<T>& a) {
  const ParameterPlace<T, 3> place({a.at[0], a.at[1], a.at[2]}, a.sides);
  return rounded_upward<R>([&] {
    std::array<PowerSeries<R, 3>, 3> variables;
    for (std::size_t s = 0; s < 3; ++s) variables[s] = PowerSeries<R, 3>::variable(s, as<R>(a.at[s]), a.order);
    const auto homogeneous = evaluate_at<PowerSeries<R, 3>>(map, place, variables);
    PATCHPROOF_REQUIRES(!detail::is_certainly_zero(homogeneous[3].constant_term()),
                        "the homogeneous point lies at infinity: its weight is zero");
    const Vec<PowerSeries<R, 3>, 3> series = project(homogeneous);
    ModelValues<R> out;
    for (int total = 0; total <= a.order; ++total)
      for (int k = total; k >= 0; --k)
        for (int l = total - k; l >= 0; --l) {
          ModelDerivative<R> row{{k, l, total - k - l}, {}};
          for (std::size_t c = 0; c < 3; ++c) row.value[c] = series[c].derivative(row.order);
          out.rows.push_back(std::move(row));
        }
    return out;
  });
}

template <Ring R, ExactField T>
Result<ModelValues<R>> values(const AnyPart<T>& part, const PartDomain<T>& domain, const ModelPlace<T>& place,
                              int order) {
  const auto shown = [&place] {
    std::string out;
    for (const T& x : place.at) out += (out.empty() ? "" : ",") + to_text(x);
    return out;
  };
  return contracts_as_errors(shown, [&]() -> Result<ModelValues<R>> {
    const Result<PlaceAsked<T>> asked = check_place<T>(domain, place.at.size(), place.sides, order, shown,
                                                       [&](std::size_t s) -> Result<T> { return place.at[s]; });
    if (!asked) return asked.error();
    return part_values<R>(part, *asked);
  });
}

}  // namespace

template <Ring R, ExactField T>
Result<ModelValues<R>> part_values(const AnyPart<T>& part, const PlaceAsked<T>& asked) {
  Result<ModelValues<R>> out =
      std::visit([&](const auto* p) -> Result<ModelValues<R>> { return values<R>(*p, asked); }, part);
  if constexpr (std::is_same_v<R, double>)
    for (std::size_t i = 0; out && i < out->rows.size(); ++i)
      for (const double x : out->rows[i].value.c)
        PATCHPROOF_REQUIRES(!std::isnan(x), "the formulas overflow in double here; interval and exact values exist");
  return out;
}

template <Ring R, ExactField T>
Result<ModelValues<R>> evaluate_part(const Model<T>& model, const ModelPart& part, const ModelPlace<T>& place,
                                     int derivatives) {
  const Result<AnyPart<T>> found = find_part(model, part);
  if (!found) return found.error();
  return values<R>(*found, domain_of(*found), place, derivatives);
}

template <Ring R, ExactField T>
Result<std::vector<ModelValues<R>>> evaluate_part(const Model<T>& model, const ModelPart& part,
                                                  const std::vector<ModelPlace<T>>& places, int derivatives, int jobs) {
  const Result<AnyPart<T>> found = find_part(model, part);
  if (!found) return found.error();
  const PartDomain<T> ends = domain_of(*found);
  return at_each_place<ModelValues<R>>(places.size(), jobs,
                                       [&](std::size_t i) { return values<R>(*found, ends, places[i], derivatives); });
}

#define PATCHPROOF_INSTANTIATE(R, T)                                                                           \
  template Result<ModelValues<R>> part_values(const AnyPart<T>&, const PlaceAsked<T>&);                        \
  template Result<ModelValues<R>> evaluate_part(const Model<T>&, const ModelPart&, const ModelPlace<T>&, int); \
  template Result<std::vector<ModelValues<R>>> evaluate_part(const Model<T>&, const ModelPart&,                \
                                                             const std::vector<ModelPlace<T>>&, int, int);
PATCHPROOF_INSTANTIATE(Rational, Rational)
PATCHPROOF_INSTANTIATE(Interval, Rational)
PATCHPROOF_INSTANTIATE(double, Rational)
PATCHPROOF_INSTANTIATE(Quadratic, Quadratic)
PATCHPROOF_INSTANTIATE(Interval, Quadratic)
PATCHPROOF_INSTANTIATE(double, Quadratic)
#undef PATCHPROOF_INSTANTIATE

}  // namespace patchproof
