// SPDX-License-Identifier: Apache-2.0
// Bernstein coefficients as bounds in doubles, and their parts: half a dozen additions and products rounded upward at a time.
// REQUIRES a RoundingGuard alive.
#pragma once

#include <array>
#include <cstddef>

#include "patchproof/scalar/interval.h"
#include "patchproof/vec.h"

namespace patchproof {

using Bounds = std::array<double, 6>;  // (−inf, sup) of x, y, z

inline Interval component(const Bounds& p, std::size_t c) { return Interval(-p[2 * c], p[2 * c + 1]); }
inline Vec<Interval, 3> intervals(const Bounds& p) { return {{component(p, 0), component(p, 1), component(p, 2)}}; }
inline void put(Bounds& p, std::size_t c, const Interval& x) {
  p[2 * c] = -x.inf();
  p[2 * c + 1] = x.sup();
}

// p ← (1 − t) p + t q. For weights in [0, 1] an upper bound of a product with x is the larger one with the weight's ends.
class Average {
 public:
  explicit Average(const Interval& t) : t_(t), s_(Interval(1) - t), inside_(t.inf() >= 0 && s_.inf() >= 0) {
    for (std::size_t k = 0; k < 6; ++k) {
      ends_[0][k] = s_.inf();
      ends_[1][k] = s_.sup();
      ends_[2][k] = t_.inf();
      ends_[3][k] = t_.sup();
    }
  }
  void operator()(Bounds& to, const Bounds& p, const Bounds& q) const {
    if (!inside_) {
      const Vec<Interval, 3> a = intervals(p), b = intervals(q);
      for (std::size_t c = 0; c < 3; ++c) put(to, c, s_ * a[c] + t_ * b[c]);
      return;
    }
    Bounds out;
    for (std::size_t k = 0; k < 6; ++k) {
      const double a = ends_[0][k] * p[k], b = ends_[1][k] * p[k], c = ends_[2][k] * q[k], d = ends_[3][k] * q[k];
      out[k] = (a > b ? a : b) + (c > d ? c : d);
    }
    to = out;
  }

 private:
  Interval t_, s_;
  bool inside_;
  double ends_[4][6];
};

// The line's coefficients on [a, b]: `count` points, `step` apart.
inline void restrict_line(Bounds* p, int count, int step, const Interval& a, const Interval& b) {
  const Interval one(1);
  const auto left = [&](const Interval& t) {
    const Average average(t);
    for (int r = 1; r < count; ++r)
      for (int j = count - 1; j >= r; --j) average(p[j * step], p[(j - 1) * step], p[j * step]);
  };
  const auto right = [&](const Interval& t) {
    const Average average(t);
    for (int r = 1; r < count; ++r)
      for (int j = 0; j + r < count; ++j) average(p[j * step], p[j * step], p[(j + 1) * step]);
  };
  const bool from_begin = a.is_point() && a.inf() == 0, to_end = b.is_point() && b.inf() == 1;
  if (from_begin && to_end) return;
  if (from_begin) return left(b);
  if (to_end) return right(a);
  if (b.inf() >= (one - a).inf()) {  // the longer part first: nothing small is divided by
    left(b);
    right(a / b);
  } else {
    right(a);
    left((b - a) / (one - a));
  }
}

}  // namespace patchproof
