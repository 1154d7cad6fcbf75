// SPDX-License-Identifier: Apache-2.0
#include "model_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "patchproof/patch/denominator.h"
#include "patchproof/spline/curve_denominator.h"
#include "patchproof/spline/spline_domain.h"

namespace patchproof {
namespace {

// 2^1000: below it every bound of a gap is a finite double.
template <ExactField T>
const T& size_limit() {
  static const T limit = [] {
    T power(1);
    for (int i = 0; i < 1000; ++i) power = power + power;
    return power;
  }();
  return limit;
}

template <ExactField T>
bool is_small(const T& x, const T& limit = size_limit<T>()) {
  return x < limit && -limit < x;
}

template <ExactField T>
T magnitude(const T& x) {
  return x < T(0) ? -x : x;
}

// Both w·x and x are; with weight 0 there is no x.
template <ExactField T>
bool is_small_with_weight(const T& wx, const T& w) {
  return is_small(wx) && (w == T(0) || is_small(wx, size_limit<T>() * magnitude(w)));
}

template <ExactField T>
bool is_one(const T& x) {
  return x == T(1);
}

template <ExactField T>
bool any_weight(const std::vector<Vec<T, 4>>& points) {
  return std::any_of(points.begin(), points.end(), [](const Vec<T, 4>& p) { return !is_one(p[3]); });
}

}  // namespace

template <ExactField T>
bool ModelBuilder<T>::fail(ErrorCode code, std::string_view at, std::string message, std::string_view values,
                           std::string_view pointer) {
  error_ = source_.error(code, at, std::move(message), values, pointer);
  return false;
}

template <ExactField T>
template <class Pointer>
bool ModelBuilder<T>::number(std::string_view text, const Pointer& pointer, T& value) {
  Result<T> read = parse_scalar<T>(text, decimals_);
  if (!read) {
    if constexpr (std::is_same_v<T, Rational>) met_root_ = mentions_root(text);
    return fail(read.error().code, text, read.error().message, text, pointer());
  }
  value = std::move(read).value();
  if constexpr (std::is_same_v<T, Quadratic>) {
    if (const int root = value.root(); root != 1) {
      if (root_ == 1) {
        root_ = root;
        root_text_ = text;
      } else if (root != root_) {
        return fail(ErrorCode::mixed_roots, text, "one model holds two different square roots",
                    fmt::format("{} and {}", root_text_, text), pointer());
      }
    }
  }
  if (!is_small(value))
    return fail(ErrorCode::bad_number, text, "the number is not below 2^1000 in size", text, pointer());
  return true;
}

template <ExactField T>
bool ModelBuilder<T>::is_bounded(const Vec<T, 4>& p) {
  return is_small(p[3]) && std::all_of(&p[0], &p[3], [&](const T& wx) { return is_small_with_weight(wx, p[3]); });
}

template <ExactField T>
bool ModelBuilder<T>::number_at(std::string_view text, const std::string& pointer, T& value) {
  return number(
      text, [&]() -> const std::string& { return pointer; }, value);
}

template <ExactField T>
std::optional<Error> ModelBuilder<T>::first_bad_number(const RawSpline& spline) {
  error_.reset();
  T ignored;
  for (int d = 0; d < 2; ++d)
    for (std::size_t k = 0; k < spline.knots[d].size(); ++k)
      if (!number(
              spline.knots[d][k], [&] { return spline.knot_pointer(d, k); }, ignored))
        return error_;
  for (std::size_t k = 0; k < spline.coordinates.size(); ++k) {
    const auto pointer = [&] {
      return spline.coordinate_pointer(k / spline.per_point, static_cast<int>(k % spline.per_point));
    };
    if (!number(spline.coordinates[k], pointer, ignored)) return error_;
  }
  for (std::size_t k = 0; k < spline.weights.size(); ++k)
    if (!number(
            spline.weights[k], [&] { return spline.weight_pointer(k); }, ignored))
      return error_;
  return std::nullopt;
}

template <ExactField T>
std::optional<KnotVector<T>> ModelBuilder<T>::knots(const RawSpline& spline, int d) {
  const long lowest = spline.is_curve() ? 0 : 1;
  const std::string_view along = spline.along(d);
  if (spline.degree[d] < lowest || spline.degree[d] > kMaxDegree) {
    fail(ErrorCode::bad_degree, spline.at, fmt::format("the degree{} is not in {} … {}", along, lowest, kMaxDegree),
         fmt::format("{}", spline.degree[d]), spline.degree_pointer(d));
    return std::nullopt;
  }
  const int degree = static_cast<int>(spline.degree[d]);
  if (!spline.has_knots) return KnotVector<T>::bezier(degree);
  const auto& texts = spline.knots[d];
  const std::string_view first = texts.empty() ? spline.at : texts.front();

  std::vector<T> values(texts.size());
  for (std::size_t k = 0; k < texts.size(); ++k)
    if (!number(
            texts[k], [&] { return spline.knot_pointer(d, k); }, values[k]))
      return std::nullopt;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] < values[k - 1]) {
      fail(ErrorCode::decreasing_knots, texts[k], fmt::format("knot {}{} is smaller than the one before it", k, along),
           fmt::format("{} after {}", texts[k], texts[k - 1]), spline.knot_pointer(d, k));
      return std::nullopt;
    }
  // Curves are taken with knots of any multiplicity: control points without influence hurt nobody there.
  for (std::size_t begin = 0; begin < values.size() && !spline.is_curve();) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    // A domain of nothing but one knot is better called empty.
    if (end - begin > static_cast<std::size_t>(degree) + 1 && end - begin < values.size()) {
      fail(ErrorCode::bad_multiplicity, texts[begin],
           fmt::format("a knot{} stands {} times; degree {} allows {}", along, end - begin, degree, degree + 1),
           texts[begin], spline.knot_pointer(d, begin));
      return std::nullopt;
    }
    begin = end;
  }
  Result<KnotVector<T>> made = KnotVector<T>::make(degree, std::move(values));
  if (!made) {
    const std::string shown =
        made.error().code == ErrorCode::empty_domain ? std::string(first) : fmt::format("{} knots", texts.size());
    fail(made.error().code, first, fmt::format("knots{}: {}", along, made.error().message), shown,
         spline.knots_pointer(d));
    return std::nullopt;
  }
  return std::move(made).value();
}

template <ExactField T>
bool ModelBuilder<T>::counts_fit(const RawSpline& spline, const std::array<int, 2>& needed) {
  for (int d = 0; d < spline.directions; ++d)
    if (spline.count[d] != needed[d])
      return fail(ErrorCode::wrong_count, spline.at,
                  fmt::format("degree and knots{} need {} control points", spline.along(d), needed[d]),
                  fmt::format("{} control points", spline.count[d]), spline.points_pointer());
  const std::size_t points = static_cast<std::size_t>(needed[0]) * needed[1];
  const std::string net = spline.is_curve() ? fmt::format("{}", points) : fmt::format("{} x {}", needed[0], needed[1]);
  if (spline.coordinates.size() != points * spline.per_point)
    return fail(ErrorCode::wrong_count, spline.coordinates.empty() ? spline.at : spline.coordinates.front(),
                fmt::format("{} control points need {} coordinates", net, points * spline.per_point),
                fmt::format("{} coordinates", spline.coordinates.size()), spline.points_pointer());
  if (spline.weight_form == Weights::separate && spline.weights.size() != points)
    return fail(ErrorCode::wrong_count, spline.weights.empty() ? spline.at : spline.weights.front(),
                fmt::format("{} control points need {} weights", net, points),
                fmt::format("{} weights", spline.weights.size()), spline.weights_pointer());
  return true;
}

template <ExactField T>
bool ModelBuilder<T>::point(const RawSpline& spline, std::size_t k, Vec<T, 4>& out) {
  const int dimension = spline.dimension();
  const std::string_view* texts = spline.coordinates.data() + k * spline.per_point;
  T& weight = out[3] = T(1);
  for (int c = 0; c < dimension; ++c)
    if (!number(
            texts[c], [&] { return spline.coordinate_pointer(k, c); }, out[c]))
      return false;
  if (spline.weight_form == Weights::none) return true;
  const bool separate = spline.weight_form == Weights::separate;
  const std::string_view weight_text = separate ? spline.weights[k] : texts[dimension];
  const auto weight_pointer = [&] {
    return separate ? spline.weight_pointer(k) : spline.coordinate_pointer(k, dimension);
  };
  if (!number(weight_text, weight_pointer, weight)) return false;
  if (is_one(weight)) return true;
  for (int c = 0; c < dimension; ++c) {
    if (separate) out[c] = weight * out[c];
    if (is_small_with_weight(out[c], weight)) continue;
    return fail(ErrorCode::bad_number, texts[c], "the point, with its weight, is not below 2^1000 in size",
                fmt::format("{} with weight {}", texts[c], weight_text), spline.coordinate_pointer(k, c));
  }
  return true;
}

template <ExactField T>
std::optional<std::vector<Vec<T, 4>>> ModelBuilder<T>::points(const RawSpline& spline,
                                                              const std::array<int, 2>& count) {
  if (!counts_fit(spline, count)) return std::nullopt;
  std::vector<Vec<T, 4>> out(static_cast<std::size_t>(count[0]) * count[1]);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t slot = spline.u_fastest ? (k % count[0]) * count[1] + k / count[0] : k;
    if (!point(spline, k, out[slot])) return std::nullopt;
  }
  return out;
}

template <ExactField T>
typename ModelBuilder<T>::WeightPlace ModelBuilder<T>::weight_place(const RawSpline& spline) {
  const bool with_points = spline.layout == JsonLayout::model && spline.weight_form == Weights::homogeneous;
  return {spline.is_curve() ? "curve" : "patch", !spline.weights.empty() ? spline.weights.front() : spline.at,
          with_points ? spline.points_pointer() : spline.weights_pointer()};
}

template <ExactField T>
bool ModelBuilder<T>::denominator_is_fine(const WeightPlace& place, const BsplinePatch<T, 4>& surface) {
  const DenominatorVerdict<T> verdict = certify_denominator(surface);
  if (verdict.is_nonzero()) return true;
  const ParameterBox<T>& box = verdict.where;
  const bool proven = verdict.sign == DenominatorSign::vanishes;
  return fail(ErrorCode::vanishing_weight, place.at,
              proven ? "the weights make the denominator of the patch zero inside its domain"
                     : "a zero of the denominator of the patch inside its domain could not be excluded",
              fmt::format("u in [{}, {}], v in [{}, {}]", to_text(box.u_begin), to_text(box.u_end),
                          to_text(box.v_begin), to_text(box.v_end)),
              place.pointer);
}

template <ExactField T>
bool ModelBuilder<T>::denominator_is_fine(const WeightPlace& place, const BsplineCurve<T, 4>& curve) {
  // Isolating roots asks for greatest common divisors, whose coefficients grow with the degree: where weights are long the
  // bounded search for patches decides, or refuses.
  constexpr std::size_t kMaxWork = 1'500'000;
  std::size_t digits = 0;
  for (const Vec<T, 4>& p : curve.points()) digits += to_text(p[3]).size();
  const std::size_t degree = curve.degree();
  if (degree * degree * digits > kMaxWork) {
    DenominatorLimits limits;
    limits.averages =
        static_cast<long>(std::max<std::size_t>(1000, 40'000'000 / (digits / curve.points().size() + 40)));
    const auto verdict =
        certify_denominator(BsplinePatch<T, 4>(curve.knots(), KnotVector<T>::bezier(0), curve.points()), limits);
    return verdict.is_nonzero() ||
           fail(ErrorCode::vanishing_weight, place.at,
                verdict.sign == DenominatorSign::vanishes
                    ? "the weights make the denominator of the curve zero inside its domain"
                    : "a zero of the denominator of the curve inside its domain could not be excluded",
                fmt::format("t in [{}, {}]", to_text(verdict.where.u_begin), to_text(verdict.where.u_end)),
                place.pointer);
  }
  std::string where;
  for (const DenominatorZero<T>& zero : certify_denominator(curve).zeros) {
    if (!where.empty()) where += ", ";
    where += zero.is_exact() ? "t = " + to_text(zero.begin)
                             : fmt::format("t in [{}, {}]", to_text(zero.begin), to_text(zero.end));
  }
  return where.empty() ||
         fail(ErrorCode::vanishing_weight, place.at,
              "the weights make the denominator of the curve zero inside its domain", where, place.pointer);
}

template <ExactField T>
std::optional<ModelCurve<T>> ModelBuilder<T>::curve(const RawSpline& raw) {
  std::optional<KnotVector<T>> t = knots(raw, 0);
  if (!t) return std::nullopt;
  std::optional<std::vector<Vec<T, 4>>> control = points(raw, {t->control_count(), 1});
  if (!control) return std::nullopt;
  const bool is_rational = any_weight(*control);
  BsplineCurve<T, 4> curve(std::move(*t), std::move(*control));
  if (is_rational && !denominator_is_fine(weight_place(raw), curve)) return std::nullopt;
  return ModelCurve<T>{raw.name, std::move(curve), is_rational, raw.dimension()};
}

template <ExactField T>
std::optional<ModelPatch<T>> ModelBuilder<T>::patch(const RawSpline& raw) {
  std::optional<KnotVector<T>> u = knots(raw, 0);
  if (!u) return std::nullopt;
  std::optional<KnotVector<T>> v = knots(raw, 1);
  if (!v) return std::nullopt;
  std::optional<std::vector<Vec<T, 4>>> net = points(raw, {u->control_count(), v->control_count()});
  if (!net) return std::nullopt;
  const bool is_rational = any_weight(*net);
  BsplinePatch<T, 4> surface(std::move(*u), std::move(*v), std::move(*net));
  if (is_rational && !denominator_is_fine(weight_place(raw), surface)) return std::nullopt;
  return ModelPatch<T>{raw.name, std::move(surface), is_rational};
}

template <ExactField T>
std::optional<Error> ModelBuilder<T>::add(const RawSpline& spline) {
  error_.reset();
  if (spline.is_curve()) {
    std::optional<ModelCurve<T>> made = curve(spline);
    if (made) model_.curves.push_back(std::move(*made));
  } else {
    std::optional<ModelPatch<T>> made = patch(spline);
    if (made) model_.patches.push_back(std::move(*made));
  }
  return error_;
}

template <ExactField T>
std::optional<Construction<T>> ModelBuilder<T>::construction(const RawConstruction& raw) {
  Construction<T> out;
  out.kind = raw.kind;
  out.along_u = raw.along_u;
  for (const auto& [key, list] : raw.curves) {
    auto& controls = out.curves[key];
    for (const RawSpline& spline : list) {
      std::optional<ModelCurve<T>> read = curve(spline);
      if (!read) return std::nullopt;
      controls.push_back({std::move(*read), spline.layout == JsonLayout::point});
    }
  }
  for (const auto& list : raw.parameters) {
    std::vector<T>& values = out.parameters[list.first];
    for (const std::string_view text : list.second) {
      const auto pointer = [&] { return fmt::format("{}/{}/{}", raw.pointer, list.first, values.size() - 1); };
      if (!number(text, pointer, values.emplace_back())) return std::nullopt;
    }
  }
  if (raw.kind == RawConstruction::Kind::transfinite) {
    out.blending = knots(raw.blending, 0);
    if (!out.blending) return std::nullopt;
  }
  return out;
}

template <ExactField T>
std::optional<ModelPatch<T>> ModelBuilder<T>::patch(const RawConstruction& raw) {
  const std::optional<Construction<T>> exact = construction(raw);
  if (!exact) return std::nullopt;
  Result<ExpandedConstruction<T>> made = expand(*exact);
  if (!made) {
    const Error& error = made.error();
    fail(error.code, raw.at, error.where.empty() ? error.message : error.where + ": " + error.message, error.values,
         raw.pointer);
    return std::nullopt;
  }
  for (const Vec<T, 4>& p : made->surface.net())
    if (!is_bounded(p)) {
      fail(ErrorCode::bad_number, raw.at, "the expanded patch is not below 2^1000 in size", "", raw.pointer);
      return std::nullopt;
    }
  if (made->is_rational && !denominator_is_fine({"patch", raw.at, raw.pointer}, made->surface)) return std::nullopt;
  const BsplinePatch<T, 4>& surface = made->surface;
  if (exact->blending)
    for (const int control : dead_control_points(*exact->blending))
      this->notes.push_back(fmt::format("patch {}: control {} has no influence", model_.patches.size(), control));
  this->notes.push_back(fmt::format("patch {}: {}, expanded exactly to degree ({}, {})", model_.patches.size(),
                                    made->kind, surface.degree(Direction::u), surface.degree(Direction::v)));
  return ModelPatch<T>{raw.name, surface, any_weight(surface.net())};
}

template <ExactField T>
std::optional<Error> ModelBuilder<T>::add(const RawConstruction& construction) {
  error_.reset();
  std::optional<ModelPatch<T>> made = patch(construction);
  if (made) model_.patches.push_back(std::move(*made));
  return error_;
}

template <ExactField T>
Model<T> ModelBuilder<T>::finish() && {
  model_.joins = std::move(joins);
  model_.units = std::move(units);
  return std::move(model_);
}

template class ModelBuilder<Rational>;
template class ModelBuilder<Quadratic>;

}  // namespace patchproof
