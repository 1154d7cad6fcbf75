// SPDX-License-Identifier: Apache-2.0
// Numbers and what is made of them as text that differs wherever they do.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/scalar/taylor_model.h"
#include "patchproof/scalar/tracked.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/curve.h"

namespace patchproof::test {

class Said {
 public:
  const std::string& text() const { return text_; }

  template <class X>
  requires(std::is_integral_v<X> || std::is_enum_v<X>) void add(X x) {
    text_ += std::to_string(static_cast<long long>(x));
    text_ += ' ';
  }
  void add(double x) { add(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x))); }
  void add(const std::string& x) { text_ += x, text_ += ' '; }
  void add(const char* x) { add(std::string(x)); }
  void add(const Rational& x) { add(to_text(x)); }
  void add(const Quadratic& x) { add(to_text(x)); }
  void add(const Interval& x) { add(x.inf()), add(x.sup()); }
  void add(const Tracked& x) { add(x.value()), add(x.error()); }
  void add(const Ball& x) {  // to twice the digits of doubles
    const Interval all = x.to_interval();
    add(all);
    if (std::isfinite(all.inf())) add((x - Ball(all.inf())).to_interval());
  }
  template <int N>
  void add(const TaylorModel<N>& x) {
    for (int k = 0; k <= N; ++k) add(x.coefficient(k));
    add(x.remainder());
  }

  template <class X, std::size_t N>
  void add(const Vec<X, N>& x) {
    for (std::size_t i = 0; i < N; ++i) add(x[i]);
  }
  template <class X, std::size_t N>
  void add(const std::array<X, N>& x) {
    for (const X& each : x) add(each);
  }
  template <class X>
  void add(const std::vector<X>& x) {
    add(x.size());
    for (const X& each : x) add(each);
  }
  template <class X, class Y>
  void add(const std::pair<X, Y>& x) {
    add(x.first), add(x.second);
  }
  template <class X>
  void add(const std::optional<X>& x) {
    add(x.has_value());
    if (x) add(*x);
  }
  template <class X>
  void add(const Result<X>& x) {
    x ? add(*x) : add(x.error().text());
  }

  template <class K>
  void add(const KnotVector<K>& x) {
    add(x.degree()), add(x.knots());
  }
  template <class T, std::size_t N, class K>
  void add(const BsplineCurve<T, N, K>& x) {
    add(x.knots()), add(x.points());
  }
  template <class T, std::size_t N, class K>
  void add(const BezierPiece<T, N, K>& x) {
    add(x.begin), add(x.end), add(x.points);
  }
  template <class T, std::size_t N, class K>
  void add(const BsplinePatch<T, N, K>& x) {
    add(x.knots(Direction::u)), add(x.knots(Direction::v)), add(x.net());
  }
  template <class T, std::size_t N, class K>
  void add(const PatchPiece<T, N, K>& x) {
    add(x.box.u_begin), add(x.box.u_end), add(x.box.v_begin), add(x.box.v_end), add(x.bezier.net());
  }
  template <class T, std::size_t N>
  void add(const PartialDerivatives<T, N>& x) {
    for (int k = 0; k <= x.order_u(); ++k)
      for (int l = 0; l <= x.order_v(); ++l) add(x.at(k, l));
  }

 private:
  std::string text_;
};

template <class... X>
std::string say(const X&... x) {
  Said out;
  (out.add(x), ...);
  return out.text();
}

}  // namespace patchproof::test
