// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/write.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iterator>

namespace patchproof {
namespace {

constexpr std::size_t kShortDigits = 18;

// 7/5 → 1.4, when the denominator divides a power of ten and the digits are few; otherwise "".
std::string short_decimal(const Rational& x) {
  namespace mp = boost::multiprecision;
  const Integer denominator = mp::denominator(x);
  Integer scale(1);
  for (std::size_t digits = 0; digits <= kShortDigits; ++digits, scale *= 10) {
    if (scale % denominator != 0) continue;
    const Integer numerator = mp::numerator(x) * (scale / denominator);
    std::string text = Integer(mp::abs(numerator)).str();
    if (text.size() <= digits) text.insert(0, digits + 1 - text.size(), '0');
    if (text.size() > kShortDigits + 1) return "";
    if (digits > 0) text.insert(text.size() - digits, ".");
    return numerator < 0 ? "-" + text : text;
  }
  return "";
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string number(const Rational& x) {
  std::string text = short_decimal(x);
  return text.empty() ? quoted(to_text(x)) : text;
}

std::string number(const Quadratic& x) { return x.is_rational() ? number(x.rational_part()) : quoted(to_text(x)); }

using Buffer = fmt::memory_buffer;

template <class... Arguments>
void put(Buffer& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
}

// "[" element(0) ", " element(1) … "]"
template <class Element>
void list(Buffer& out, int count, std::string_view separator, Element element) {
  put(out, "[");
  for (int i = 0; i < count; ++i) {
    if (i > 0) put(out, "{}", separator);
    element(i);
  }
  put(out, "]");
}

template <ExactField T>
void knots(Buffer& out, const BsplinePatch<T, 4>& surface) {
  const auto vector = [&](const KnotVector<T>& k) {
    list(out, static_cast<int>(k.knots().size()), ", ", [&](int i) { put(out, "{}", number(k[i])); });
  };
  const KnotVector<T>&u = surface.knots(Direction::u), &v = surface.knots(Direction::v);
  if (u == KnotVector<T>::bezier(u.degree()) && v == KnotVector<T>::bezier(v.degree())) return;
  put(out, ",\n      \"knots\": [");
  vector(u);
  put(out, ", ");
  vector(v);
  put(out, "]");
}

template <ExactField T>
void patch(Buffer& out, const ModelPatch<T>& patch) {
  const BsplinePatch<T, 4>& surface = patch.surface;
  const int rows = surface.count(Direction::u), columns = surface.count(Direction::v);
  bool homogeneous = false;
  for (const Vec<T, 4>& p : surface.net()) homogeneous = homogeneous || p[3] == T(0);

  put(out, "    {{\n");
  if (!patch.name.empty()) put(out, "      \"name\": {},\n", quoted(patch.name));
  put(out, "      \"degree\": [{}, {}]", surface.degree(Direction::u), surface.degree(Direction::v));
  knots(out, surface);
  put(out, ",\n      \"control_points\": ");
  list(out, rows, ",\n        ", [&](int i) {
    list(out, columns, ", ", [&](int j) {
      const Vec<T, 4>& p = surface.point(i, j);
      list(out, homogeneous ? 4 : 3, ", ", [&](int c) { put(out, "{}", number(homogeneous ? p[c] : p[c] / p[3])); });
    });
  });
  if (patch.is_rational && !homogeneous) {
    put(out, ",\n      \"weights\": ");
    list(out, rows, ",\n        ",
         [&](int i) { list(out, columns, ", ", [&](int j) { put(out, "{}", number(surface.point(i, j)[3])); }); });
  }
  put(out, "\n    }}");
}

}  // namespace

template <ExactField T>
std::string write_model_json(const Model<T>& model) {
  Buffer out;
  put(out, "{{\n  \"format\": \"patchproof-model\",\n  \"version\": 1,\n");
  if (!model.units.empty()) put(out, "  \"units\": {},\n", quoted(model.units));
  put(out, "  \"patches\": [\n");
  for (std::size_t k = 0; k < model.patches.size(); ++k) {
    if (k > 0) put(out, ",\n");
    patch(out, model.patches[k]);
  }
  put(out, "\n  ]");
  if (!model.joins.empty()) {
    put(out, ",\n  \"joins\": [\n");
    for (std::size_t k = 0; k < model.joins.size(); ++k) {
      const DeclaredJoin& join = model.joins[k];
      put(out,
          "{}    {{\"a\": {{\"patch\": {}, \"edge\": \"{}\"}}, \"b\": {{\"patch\": {}, \"edge\": \"{}\"}}, "
          "\"reversed\": {}}}",
          k > 0 ? ",\n" : "", join.patch_a, to_string(join.edge_a), join.patch_b, to_string(join.edge_b),
          join.reversed);
    }
    put(out, "\n  ]");
  }
  put(out, "\n}}\n");
  return fmt::to_string(out);
}

template std::string write_model_json(const Model<Rational>&);
template std::string write_model_json(const Model<Quadratic>&);

}  // namespace patchproof
