// SPDX-License-Identifier: Apache-2.0
// B-functions that are flat at both ends: what their enclosures and their tables of doubles have in common.
//
// A kind of function gives two things: its Taylor coefficients B^(k)(t)/k! at an enclosure t inside (0, 1), and bounds of them
// beside the ends, where t touches 0 or 1 and a formula would divide by 0. The rest is the same for all.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "patchproof/spline/b_function.h"

namespace patchproof::detail {

// Polynomials for doubles: on each panel one per derivative 0…3.
class DoubleTable {
 public:
  static constexpr int kDerivatives = 4, kDegree = 15;
  explicit DoubleTable(const SmoothBFunction& b);
  std::vector<double> derivatives(double t, int order) const;
  double error(int k) const { return error_[k]; }

 private:
  struct Panel {
    double begin, end, centre, half;  // half is a power of two
    double value_begin, value_end;    // B there, rounded to nearest: the values of the panel are cut to them
    std::array<std::array<double, kDegree + 1>, kDerivatives> c;
  };
  void add(const SmoothBFunction& b, double begin, double end);
  void add_flat(const SmoothBFunction& b, double begin, double end);

  std::vector<Panel> panels_;
  std::array<double, kDerivatives> error_{};
};

class SmoothBFunction {
 public:
  virtual ~SmoothBFunction() = default;
  // B_0 … B_n at t. REQUIRES t within (0, 1), and not around a kink.
  virtual std::vector<Ball> series(const Ball& t, int n) const = 0;
  // At least |B_k| on (0, s], for end = 0, or on [1 − s, 1). REQUIRES k ≥ 1, 0 < s ≤ reach(end).
  virtual double end_bound(int end, double s, int k) const = 0;
  virtual double reach(int end) const = 0;
  // Doubles around a point where B is C^smoothness and no more, and B_0 … B_smoothness on [low, high], below or above it, where it is one end.
  struct Kink {
    double below, above;
    int smoothness;
    // Whether numbers of [x, …] lie below it: the double next below is itself no kink.
    bool has_below(double x) const { return x < below || (x == below && below < above); }
  };
  virtual std::optional<Kink> kink() const { return std::nullopt; }
  virtual std::vector<Ball> series_beside_kink(double, double, bool /*is_below*/, int) const { return {}; }

  const DoubleTable& table() const;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const DoubleTable> table_;
};

std::shared_ptr<const SmoothBFunction> make_logistic();
std::shared_ptr<const SmoothBFunction> make_expo_rational(const BFunction::Intrinsic& parameters);

// ---- numbers --------------------------------------------------------------------------------------------------------

inline Ball exact_ball(double x) { return Ball(x); }
inline Ball ball_between(double low, double high) { return Ball(Interval(low, high)); }
// Series modulo x^(n+1), n + 1 coefficients each.
std::vector<Ball> series_product(const std::vector<Ball>& a, const std::vector<Ball>& b);
std::vector<Ball> series_exp(const std::vector<Ball>& g);  // e^g
// The largest of a family of bounds c^-j y^(j/a) e^(−kappa y) over y ≥ y_0, as a logarithm without the factor of c.
double log_peak(double power, double kappa, double y0);
double exp_up(double logarithm);  // at least e^logarithm, when the logarithm is right to 10^-9 of its size

}  // namespace patchproof::detail
