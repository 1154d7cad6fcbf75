// SPDX-License-Identifier: Apache-2.0
#include "report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace patchproof {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out;
}

std::string named(const std::string& what, const std::string& label) {
  return label.rfind(what + " ", 0) == 0 ? label : what + " " + label;
}

std::string bound_text(double lower, double upper) {
  if (lower == upper) return fmt::format("{}", lower);
  const auto outward = [](double x, bool up) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(x))) - 4);
    if (!(unit > 0)) return x;  // below the smallest normal number there are not five digits
    double digits = up ? std::ceil(x / unit) : std::floor(x / unit);
    // The quotient was rounded: what is printed must still be on the right side.
    const auto printed = [&] { return std::strtod(fmt::format("{:.5g}", digits * unit).c_str(), nullptr); };
    while (up ? printed() < x : printed() > x) digits += up ? 1 : -1;
    return digits * unit;
  };
  return fmt::format("[{:.5g}, {:.5g}]", lower == 0 ? 0.0 : outward(lower, false),
                     std::isfinite(upper) ? outward(upper, true) : upper);
}

long width_of(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

}  // namespace patchproof
