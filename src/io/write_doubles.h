// SPDX-License-Identifier: Apache-2.0
// What the writers of formats with doubles share: rounding that is counted, and the notes about what is left out.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"

namespace patchproof {

class Rounding {
 public:
  // The nearest double. A number that would become 0 or infinite is kept as the error.
  template <ExactField T>
  double operator()(const T& x) {
    const double d = nearest_double(x);
    if (!std::isfinite(d) || (d == 0 && !(x == T(0)))) {
      if (!lost_) lost_ = fmt::format("{:.300}", to_text(x));
      return 0;
    }
    ++numbers_;
    inexact_ += !(T(from_double(d)) == x);
    return d;
  }

  // Notices different knots that have one nearest double.
  template <ExactField T>
  void keep_apart(const KnotVector<T>& knots) {
    const std::vector<T>& t = knots.knots();
    for (std::size_t i = 1; i < t.size() && !merged_; ++i)
      if (!(t[i] == t[i - 1]) && nearest_double(t[i]) == nearest_double(t[i - 1]))
        merged_ = fmt::format("{:.300} and {:.300}", to_text(t[i - 1]), to_text(t[i]));
  }

  // What went wrong so far, if anything did.
  std::optional<Error> error(const std::string& where) const {
    if (lost_) return Error{ErrorCode::bad_number, where, "a number is too small or too large for a double", *lost_};
    if (merged_) return Error{ErrorCode::unsupported, where, "two knots have the same nearest double", *merged_};
    return std::nullopt;
  }

  std::size_t numbers() const { return numbers_; }
  std::size_t inexact() const { return inexact_; }

 private:
  std::size_t numbers_ = 0, inexact_ = 0;
  std::optional<std::string> lost_, merged_;
};

inline std::string plural(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

// What no format of surfaces holds, and names and units where this one holds none.
template <ExactField T>
std::vector<std::string> left_out(const Model<T>& model, bool holds_names, bool holds_units) {
  std::vector<std::string> notes;
  if (!model.solids.empty())
    notes.push_back(plural(model.solids.size(), "solid", "solids") + " left out: the format has none");
  if (!model.joins.empty())
    notes.push_back(plural(model.joins.size(), "declared join", "declared joins") + " left out: the format has none");
  std::size_t names = 0;
  for (const auto& patch : model.patches) names += !patch.name.empty();
  for (const auto& curve : model.curves) names += !curve.name.empty();
  if (names > 0 && !holds_names) notes.push_back(plural(names, "name", "names") + " left out: the format has none");
  if (!model.units.empty() && !holds_units) notes.push_back("units " + model.units + " left out: the format has none");
  return notes;
}

}  // namespace patchproof
