// SPDX-License-Identifier: Apache-2.0
#include "json_text.h"

#include <nlohmann/json.hpp>

#include "patchproof/scalar/parse_scalar.h"

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

}  // namespace

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_number(const Rational& x) {
  std::string text = short_decimal(x);
  return text.empty() ? json_string(to_text(x)) : text;
}

std::string json_number(const Quadratic& x) {
  return x.is_rational() ? json_number(x.rational_part()) : json_string(to_text(x));
}

}  // namespace patchproof
