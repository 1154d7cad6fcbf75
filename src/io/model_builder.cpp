// SPDX-License-Identifier: Apache-2.0
#include "model_builder.h"

#include <fmt/format.h>

#include <type_traits>

#include "patchproof/patch/denominator.h"

namespace patchproof {
namespace {

constexpr std::array<char, 2> kDirectionName = {'u', 'v'};

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
bool is_one(const T& x) {
  return x == T(1);
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
std::optional<Error> ModelBuilder<T>::first_bad_number(const RawPatch& patch) {
  error_.reset();
  T ignored;
  for (int d = 0; d < 2; ++d)
    for (std::size_t k = 0; k < patch.knots[d].size(); ++k)
      if (!number(
              patch.knots[d][k], [&] { return patch.knot_pointer(d, k); }, ignored))
        return error_;
  for (std::size_t k = 0; k < patch.coordinates.size(); ++k) {
    const auto pointer = [&] {
      return patch.coordinate_pointer(k / patch.per_point, static_cast<int>(k % patch.per_point));
    };
    if (!number(patch.coordinates[k], pointer, ignored)) return error_;
  }
  for (std::size_t k = 0; k < patch.weights.size(); ++k)
    if (!number(
            patch.weights[k], [&] { return patch.weight_pointer(k); }, ignored))
      return error_;
  return std::nullopt;
}

template <ExactField T>
std::optional<KnotVector<T>> ModelBuilder<T>::knots(const RawPatch& patch, int d) {
  const int degree = static_cast<int>(patch.degree[d]);
  if (!patch.has_knots) return KnotVector<T>::bezier(degree);
  const auto& texts = patch.knots[d];
  const std::string_view first = texts.empty() ? patch.at : texts.front();
  const std::string member =
      patch.layout == JsonLayout::geomdl ? fmt::format("knotvector_{}", kDirectionName[d]) : fmt::format("knots/{}", d);

  std::vector<T> values(texts.size());
  for (std::size_t k = 0; k < texts.size(); ++k)
    if (!number(
            texts[k], [&] { return patch.knot_pointer(d, k); }, values[k]))
      return std::nullopt;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] < values[k - 1]) {
      fail(ErrorCode::decreasing_knots, texts[k],
           fmt::format("knot {} along {} is smaller than the one before it", k, kDirectionName[d]),
           fmt::format("{} after {}", texts[k], texts[k - 1]), patch.knot_pointer(d, k));
      return std::nullopt;
    }
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    // A domain of nothing but one knot is better called empty.
    if (end - begin > static_cast<std::size_t>(degree) + 1 && end - begin < values.size()) {
      fail(ErrorCode::bad_multiplicity, texts[begin],
           fmt::format("a knot along {} stands {} times; degree {} allows {}", kDirectionName[d], end - begin, degree,
                       degree + 1),
           texts[begin], patch.knot_pointer(d, begin));
      return std::nullopt;
    }
    begin = end;
  }
  Result<KnotVector<T>> made = KnotVector<T>::make(degree, std::move(values));
  if (!made) {
    const std::string shown =
        made.error().code == ErrorCode::empty_domain ? std::string(first) : fmt::format("{} knots", texts.size());
    fail(made.error().code, first, fmt::format("knots along {}: {}", kDirectionName[d], made.error().message), shown,
         patch.member_pointer(member));
    return std::nullopt;
  }
  return std::move(made).value();
}

template <ExactField T>
bool ModelBuilder<T>::counts_fit(const RawPatch& patch, const std::array<int, 2>& needed) {
  const std::string pointer = patch.member_pointer("control_points");
  for (int d = 0; d < 2; ++d)
    if (patch.count[d] != needed[d])
      return fail(ErrorCode::wrong_count, patch.at,
                  fmt::format("degree and knots along {} need {} control points", kDirectionName[d], needed[d]),
                  fmt::format("{} control points", patch.count[d]), pointer);
  const std::size_t points = static_cast<std::size_t>(needed[0]) * needed[1];
  if (patch.coordinates.size() != points * patch.per_point)
    return fail(
        ErrorCode::wrong_count, patch.coordinates.empty() ? patch.at : patch.coordinates.front(),
        fmt::format("{} x {} control points need {} coordinates", needed[0], needed[1], points * patch.per_point),
        fmt::format("{} coordinates", patch.coordinates.size()), pointer);
  if (patch.weight_form == Weights::separate && patch.weights.size() != points)
    return fail(ErrorCode::wrong_count, patch.weights.empty() ? patch.at : patch.weights.front(),
                fmt::format("{} x {} control points need {} weights", needed[0], needed[1], points),
                fmt::format("{} weights", patch.weights.size()), patch.weights_pointer());
  return true;
}

template <ExactField T>
bool ModelBuilder<T>::point(const RawPatch& patch, std::size_t k, Vec<T, 4>& out) {
  const int dimension = patch.dimension();
  const std::string_view* texts = patch.coordinates.data() + k * patch.per_point;
  T& weight = out[3] = T(1);
  for (int c = 0; c < dimension; ++c)
    if (!number(
            texts[c], [&] { return patch.coordinate_pointer(k, c); }, out[c]))
      return false;
  if (patch.weight_form == Weights::none) return true;
  const bool separate = patch.weight_form == Weights::separate;
  const std::string_view weight_text = separate ? patch.weights[k] : texts[dimension];
  const auto weight_pointer = [&] {
    return separate ? patch.weight_pointer(k) : patch.coordinate_pointer(k, dimension);
  };
  if (!number(weight_text, weight_pointer, weight)) return false;
  if (is_one(weight)) return true;
  const T room = size_limit<T>() * (weight < T(0) ? -weight : weight);
  for (int c = 0; c < dimension; ++c) {
    if (separate) out[c] = weight * out[c];
    // Both w·x and x must be small; with weight 0 there is no x.
    if (is_small(out[c]) && (weight == T(0) || is_small(out[c], room))) continue;
    return fail(ErrorCode::bad_number, texts[c], "the point, with its weight, is not below 2^1000 in size",
                fmt::format("{} with weight {}", texts[c], weight_text), patch.coordinate_pointer(k, c));
  }
  return true;
}

template <ExactField T>
bool ModelBuilder<T>::denominator_is_fine(const RawPatch& patch, const BsplinePatch<T, 4>& surface) {
  const DenominatorVerdict<T> verdict = certify_denominator(surface);
  if (verdict.is_nonzero()) return true;
  const ParameterBox<T>& box = verdict.where;
  const std::string where = fmt::format("u in [{}, {}], v in [{}, {}]", to_text(box.u_begin), to_text(box.u_end),
                                        to_text(box.v_begin), to_text(box.v_end));
  const std::string_view at = !patch.weights.empty() ? patch.weights.front() : patch.at;
  const std::string pointer = patch.layout == JsonLayout::model && patch.weight_form == Weights::homogeneous
                                  ? patch.member_pointer("control_points")
                                  : patch.weights_pointer();
  const bool proven = verdict.sign == DenominatorSign::vanishes;
  return fail(ErrorCode::vanishing_weight, at,
              proven ? "the weights make the denominator of the patch zero inside its domain"
                     : "a zero of the denominator of the patch inside its domain could not be excluded",
              where, pointer);
}

template <ExactField T>
std::optional<Error> ModelBuilder<T>::add(const RawPatch& patch) {
  error_.reset();
  for (int d = 0; d < 2; ++d)
    if (patch.degree[d] < 1 || patch.degree[d] > kMaxDegree) {
      fail(ErrorCode::bad_degree, patch.at,
           fmt::format("the degree along {} is not in 1 … {}", kDirectionName[d], kMaxDegree),
           fmt::format("{}", patch.degree[d]),
           patch.layout == JsonLayout::geomdl ? patch.member_pointer(fmt::format("degree_{}", kDirectionName[d]))
                                              : patch.member_pointer(fmt::format("degree/{}", d)));
      return error_;
    }
  std::optional<KnotVector<T>> u = knots(patch, 0);
  if (!u) return error_;
  std::optional<KnotVector<T>> v = knots(patch, 1);
  if (!v) return error_;
  const std::array<int, 2> count = {u->control_count(), v->control_count()};
  if (!counts_fit(patch, count)) return error_;

  std::vector<Vec<T, 4>> net(static_cast<std::size_t>(count[0]) * count[1]);
  bool is_rational = false;
  for (std::size_t k = 0; k < net.size(); ++k) {
    const std::size_t slot = patch.u_fastest ? (k % count[0]) * count[1] + k / count[0] : k;
    if (!point(patch, k, net[slot])) return error_;
    is_rational = is_rational || !is_one(net[slot][3]);
  }
  BsplinePatch<T, 4> surface(std::move(*u), std::move(*v), std::move(net));
  if (is_rational && !denominator_is_fine(patch, surface)) return error_;
  model_.patches.push_back({patch.name, std::move(surface), is_rational});
  return std::nullopt;
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
