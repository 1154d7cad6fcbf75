// SPDX-License-Identifier: Apache-2.0
// Numbers and names in reports for people.
#pragma once

#include <string>

namespace patchproof {

// Names from files may hold anything: control characters would forge lines or colours.
std::string escaped(const std::string& text);

// "face #12", and "face 7" where the label says so itself.
std::string named(const std::string& what, const std::string& label);

// "[lower, upper]", five digits rounded outward; the JSON has all of them. One number when both are equal.
std::string bound_text(double lower, double upper);

// Characters, not bytes.
long width_of(const std::string& text);

}  // namespace patchproof
