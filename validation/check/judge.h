// SPDX-License-Identifier: Apache-2.0
// How one number is judged.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "validation/check/check.h"

namespace patchproof::validation {

// |computed − exact| ≤ bound, and how far it was used.
class Judge {
 public:
  Judge(Tally& tally, const Rational& exact, const Rational& largest_of_vector)
      : tally_(tally), exact_(exact), largest_(largest_of_vector) {}

  // `bound`: infinite when there is none.
  void number(double computed, double bound, const std::function<std::string()>& place) const;
  // lower ≤ exact ≤ upper. The error is taken to be half the width: what an enclosure costs.
  void enclosure(double lower, double upper, const std::function<std::string()>& place) const;
  // The very double.
  void nearest(double computed, const std::function<std::string()>& place) const;

 private:
  void record(const Deviation& d, bool holds, double ratio, const std::function<std::string()>& place,
              const std::string& what) const;

  Tally& tally_;
  const Rational& exact_;
  const Rational& largest_;
};

// The number itself, or, of a kernel that is to be broken, another.
double perhaps_broken(const CheckOptions& options, const std::string& kernel, double computed);

// Is the denominator, the last coordinate of a homogeneous point, within rounding of zero? See check.h. `degrees`: p + q.
bool is_negligible(const Vec<Rational, 4>& point, const std::vector<double>& weights, int degrees);

// Drops the items at which call() gives up and may.
template <class Call, class MayGiveUp, class Drop>
void drop_vanishing(Call call, MayGiveUp may_give_up, Drop drop) {
  for (;;) {
    const Result<BatchSummary> done = call();
    if (done || done.error().code != ErrorCode::vanishing_weight) return;
    const std::string& where = done.error().where;  // "parameter 7"
    const std::size_t item = std::stoul(where.substr(where.rfind(' ') + 1));
    if (!may_give_up(item)) return;
    drop(item);
  }
}

// Counts agreement of two numbers that should be the same, bit for bit.
void same_bits(Tally& tally, double a, double b, const std::function<std::string()>& place);

// Hexadecimal: what was computed, exactly.
std::string hex(double x);

}  // namespace patchproof::validation
