// SPDX-License-Identifier: Apache-2.0
// The models of this folder as functions, and the few words in which they are written down.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "patchproof/io/model.h"

namespace patchproof::examples {

// 0.552_q is the fraction 69/125, not a double: the text of the literal is read exactly.
inline Rational operator""_q(const char* text) { return *parse_scalar<Rational>(text); }

using Row = std::vector<Vec<Rational, 3>>;  // control points along v

// A polynomial patch from points in space; rows[i][j], i along u, j along v.
inline ModelPatch<Rational> polynomial_patch(std::string name, KnotVector<Rational> u, KnotVector<Rational> v,
                                             const std::vector<Row>& rows) {
  std::vector<Vec<Rational, 4>> net;
  for (const Row& row : rows)
    for (const Vec<Rational, 3>& p : row) net.push_back({{p[0], p[1], p[2], Rational(1)}});
  return {std::move(name), BsplinePatch<Rational, 4>(std::move(u), std::move(v), std::move(net)), false};
}

// The same with Bézier knots on [0, 1] in both directions.
inline ModelPatch<Rational> bezier_model_patch(std::string name, const std::vector<Row>& rows) {
  return polynomial_patch(std::move(name), KnotVector<Rational>::bezier(static_cast<int>(rows.size()) - 1),
                          KnotVector<Rational>::bezier(static_cast<int>(rows[0].size()) - 1), rows);
}

struct NamedModel {
  std::string path;  // below the folder of examples
  std::string json;
};

NamedModel cup();
std::vector<NamedModel> quadrics();
std::vector<NamedModel> seven_cases();

}  // namespace patchproof::examples
