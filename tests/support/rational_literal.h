// SPDX-License-Identifier: Apache-2.0
// "2/3"_q
#pragma once

#include <cstddef>

#include "patchproof/scalar/parse_scalar.h"

namespace patchproof::test {

inline Rational operator""_q(const char* text, std::size_t) { return parse_scalar<Rational>(text).value(); }

}  // namespace patchproof::test
