// SPDX-License-Identifier: Apache-2.0
// Pieces of JSON text, numbers exact: a decimal where that is exact and short, else a string such as "1/3".
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

std::string json_number(const Rational& x);
std::string json_number(const Quadratic& x);
// In quotation marks; bytes that are no UTF-8 are replaced.
std::string json_string(const std::string& text);

template <class... Arguments>
void put(fmt::memory_buffer& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
}

// "[" element(0) ", " element(1) … "]"
template <class Element>
void json_list(fmt::memory_buffer& out, int count, std::string_view separator, Element element) {
  put(out, "[");
  for (int i = 0; i < count; ++i) {
    if (i > 0) put(out, "{}", separator);
    element(i);
  }
  put(out, "]");
}

}  // namespace patchproof
