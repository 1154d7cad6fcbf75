// SPDX-License-Identifier: Apache-2.0
// One part of a model, whatever it is: its domain, the parameters asked for, and its values there.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "patchproof/io/evaluate_model.h"
#include "patchproof/parallel.h"

namespace patchproof {

template <ExactField T>
using AnyPart = std::variant<const BsplinePatch<T, 4>*, const GerbsSurface<T, 4>*, const GregoryPatch<T>*,
                             const ModelCurve<T>*, const ModelGerbsCurve<T>*, const TransfiniteMap<T, 3, 4>*>;

template <ExactField T>
Result<AnyPart<T>> find_part(const Model<T>& model, const ModelPart& part);

template <ExactField T>
using PartDomain = std::vector<std::pair<T, T>>;

template <ExactField T>
PartDomain<T> domain_of(const AnyPart<T>& part);

// What is asked of a part, with parameters in its domain.
template <ExactField T>
struct PlaceAsked {
  std::vector<T> at;
  std::array<Side, 3> sides;
  int order;
  std::function<std::string()> shown;  // the parameters in messages
};

// next(s): parameter s, one after the other.
template <ExactField T, class Next>
Result<PlaceAsked<T>> check_place(const PartDomain<T>& domain, std::size_t given, const std::vector<Side>& sides,
                                  int order, std::function<std::string()> shown, Next next) {
  const std::size_t count = domain.size();
  if (order < 0 || order > kMostDerivatives)
    return Error{ErrorCode::usage, "derivatives", fmt::format("an order from 0 to {}", kMostDerivatives),
                 std::to_string(order)};
  if (!sides.empty() && sides.size() != count)
    return Error{ErrorCode::usage, "at", fmt::format("{} sides are needed, or none", count),
                 std::to_string(sides.size())};
  PlaceAsked<T> out{{}, {Side::right, Side::right, Side::right}, order, std::move(shown)};
  std::copy(sides.begin(), sides.end(), out.sides.begin());
  for (std::size_t s = 0; s < count; ++s) {
    if (given <= s || (s + 1 == given) != (s + 1 == count)) {
      const char* const needed[] = {"one parameter T is needed", "two parameters U,V are needed",
                                    "three parameters U,V,W are needed"};
      return Error{ErrorCode::usage, "at", needed[count - 1], out.shown()};
    }
    const Result<T> x = next(s);
    if (!x) return Error{x.error().code, "at", x.error().message, x.error().values};
    const auto& [begin, end] = domain[s];
    if (*x < begin || end < *x)
      return Error{
          ErrorCode::outside_domain, "at",
          fmt::format("{} lies outside the domain [{}, {}]", count == 1 ? 't' : "uvw"[s], to_text(begin), to_text(end)),
          to_text(*x)};
    out.at.push_back(*x);
  }
  return out;
}

template <Ring R, ExactField T>
Result<ModelValues<R>> part_values(const AnyPart<T>& part, const PlaceAsked<T>& asked);

// f(): what another root than the model's, or doubles that overflow, do not let pass is an error.
template <class F>
auto contracts_as_errors(const std::function<std::string()>& shown, F f) -> decltype(f()) {
  try {
    return f();
  } catch (const contract_error& e) {
    return Error{ErrorCode::usage, "", e.what(), shown()};
  }
}

// item(i) for each place, several at a time; the first error, with its number.
template <class Value, class Item>
Result<std::vector<Value>> at_each_place(std::size_t count, int jobs, Item item) {
  std::vector<std::optional<Result<Value>>> found(count);
  for_each_item(jobs, count, [&](std::size_t i) { found[i] = item(i); });
  std::vector<Value> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (!*found[i]) {
      Error error = found[i]->error();
      error.where = fmt::format("place {}{}{}", i, error.where.empty() ? "" : ", ", error.where);
      return error;
    }
    out.push_back(std::move(**found[i]));
  }
  return out;
}

}  // namespace patchproof
