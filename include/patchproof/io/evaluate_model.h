// SPDX-License-Identifier: Apache-2.0
// Points and derivatives of one patch, curve or solid of a model: exact, enclosed, or in double.
//
//   patches   B-spline patches, then GERBS patches, then Gregory patches: numbered from 0, as in reports
//   curves    B-spline curves, then GERBS curves
//   solids    maps of u, v and w
//
// Parameters are exact and lie in the part's own domain. At a knot the value is the limit from the side that is given there.
//
// ENSURES   (1) rows: one for each derivative of a total order up to the one asked, in growing order, u first: S, S_u, S_v,
//           S_uu, S_uv, S_vv; C, C′, C″; V, V_u, V_v, V_w;  (2) R = T: the exact derivatives of the affine point, from the
//           sides given;  (3) R = Interval: encloses them;  (4) R = double: the same formulas at the nearest doubles of the
//           parameters, without a bound;  (5) next to a corner of a Gregory patch, where doubles cancel, intervals and doubles
//           are the exact values rounded;  (6) texts: parameters are read exactly ("0.1" is 1/10), values are those of (2), (3)
//           or (4) as to_text gives them;  (7) many places: as one by one, with any number of threads.
// ERRORS    bad_reference: no such part;  usage: another number of parameters or sides, an order outside 0 … kMostDerivatives, a
//           number with another root than the model's, doubles that overflow;  bad_number: a parameter that is no number;
//           outside_domain;  unsupported: exact values of a transcendental GERBS, second derivatives in a corner of a Gregory
//           patch. `where` is "patch", "curve", "solid", "at", "derivatives" or "scalar", or empty for roots and overflow; of
//           several places it begins with the number of the first that fails: "place 3, at". Many places throw
//           stop_requested under a StopScope that is raised.
// SCALARS   T: the model's, Rational or Quadratic; R: T, Interval, double.
// COST      a bicubic point takes some 50 µs exactly, 10 µs enclosed, 20 µs in double; for many doubles of splines there is
//           patch/evaluate_batch.h, which takes nanoseconds.
// NEIGHBOURS read.h, patch/evaluate_batch.h.
// TEST      tests/io/evaluate_model_test.cpp checks (1)–(7).
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"
#include "patchproof/scalar/interval.h"

namespace patchproof {

inline constexpr int kMostDerivatives = 20;

enum class PartKind { patch, curve, solid };
const char* to_string(PartKind kind);

struct ModelPart {
  PartKind kind = PartKind::patch;
  int number = 0;
};

// How many parts of a kind the model has.
template <ExactField T>
int part_count(const Model<T>& model, PartKind kind);
int part_count(const ModelFile& file, PartKind kind);

// The domain of each of its parameters: two of a patch, one of a curve, three of a solid.
template <ExactField T>
Result<std::vector<std::pair<T, T>>> domain_of(const Model<T>& model, const ModelPart& part);
Result<std::vector<std::pair<std::string, std::string>>> domain_of(const ModelFile& file, const ModelPart& part);

// T: a number type, or std::string.
template <class T>
struct ModelPlace {
  std::vector<T> at;             // one number for each parameter
  std::vector<Side> sides = {};  // as many, or empty: from the right
};

template <Ring R>
struct ModelDerivative {
  std::array<int, 3> order{};  // by u, v, w; of a curve by t, 0, 0
  Vec<R, 3> value;
};

template <Ring R>
struct ModelValues {
  int dimension = 3;  // 2: a plane curve, z = 0
  std::vector<ModelDerivative<R>> rows;
};

template <Ring R, ExactField T>
Result<ModelValues<R>> evaluate_part(const Model<T>& model, const ModelPart& part, const ModelPlace<T>& place,
                                     int derivatives = 0);
// jobs: threads; 0: one for each processor.
template <Ring R, ExactField T>
Result<std::vector<ModelValues<R>>> evaluate_part(const Model<T>& model, const ModelPart& part,
                                                  const std::vector<ModelPlace<T>>& places, int derivatives = 0,
                                                  int jobs = 0);

// ---- the same in texts, whatever numbers the model has -----------------------------------------------------------------

enum class ValueScalar { rational, interval, binary64 };  // rational: exact, with the model's root where it has one

struct DerivativeText {
  std::string name;  // "S_uv", "C''", "C^(4)", "V_w"
  std::array<int, 3> order{};
  std::vector<std::string> value;  // x, y, z; of a plane curve x, y
};

using PlaceText = ModelPlace<std::string>;

Result<std::vector<DerivativeText>> evaluate_model(const ModelFile& file, const ModelPart& part, const PlaceText& place,
                                                   int derivatives = 0, ValueScalar scalar = ValueScalar::rational);
Result<std::vector<std::vector<DerivativeText>>> evaluate_model(const ModelFile& file, const ModelPart& part,
                                                                const std::vector<PlaceText>& places,
                                                                int derivatives = 0,
                                                                ValueScalar scalar = ValueScalar::rational,
                                                                int jobs = 0);

}  // namespace patchproof
