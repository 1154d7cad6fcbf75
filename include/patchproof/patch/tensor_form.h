// SPDX-License-Identifier: Apache-2.0
// Polynomials in two variables on the unit square as tensor products of binary forms:
//
//   f(u,v) = Σ a_ij u^i (1−u)^(m−i) v^j (1−v)^(n−j),      a_ij = C(m,i) C(n,j) times the Bernstein coefficient b_ij
//
// As with curves (spline/binary_form.h) the binomials stand in the coefficients, so that products are plain convolutions and
// nothing is ever divided: how the numerators and denominators of blended surfaces are multiplied out.
//
// ENSURES  (1) from_bernstein and bernstein are inverse to each other;  (2) + − × are those of the polynomials, sums in the
//          larger degrees;  (3) elevated: the same polynomial in higher degrees;  (4) the empty form is zero, of any degrees;
//          (5) operator(): the value.
// SCALARS  R: Ring; bernstein: Field.
// COST     of a product: the product of the numbers of coefficients.
// TEST     tests/patch/tensor_form_test.cpp checks (1)–(5).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/patch/bezier_patch.h"
#include "patchproof/spline/binary_form.h"

namespace patchproof {

template <Ring R>
class TensorForm {
 public:
  TensorForm() = default;  // zero
  TensorForm(int degree_u, int degree_v)
      : degree_u_(degree_u), degree_v_(degree_v), a_((degree_u + 1) * static_cast<std::size_t>(degree_v + 1)) {}
  static TensorForm constant(const R& value) {
    TensorForm out(0, 0);
    out.a_[0] = value;
    return out;
  }
  // f(u) g(v) of two binary forms.
  TensorForm(const BinaryForm<R>& f, const BinaryForm<R>& g) : TensorForm(f.degree(), g.degree()) {
    for (int i = 0; i <= degree_u_; ++i)
      for (int j = 0; j <= degree_v_; ++j) at(i, j) = f[i] * g[j];
  }
  // Component c of a Bézier patch.
  template <std::size_t N>
  static TensorForm from_bernstein(const BezierPatch<R, N>& patch, std::size_t c);

  bool is_empty() const { return a_.empty(); }
  int degree_u() const { return degree_u_; }
  int degree_v() const { return degree_v_; }
  R& at(int i, int j) { return a_[static_cast<std::size_t>(i) * (degree_v_ + 1) + j]; }
  const R& at(int i, int j) const { return a_[static_cast<std::size_t>(i) * (degree_v_ + 1) + j]; }

  // In these degrees. REQUIRES none is smaller than the form's.
  TensorForm elevated(int degree_u, int degree_v) const;
  // b_ij, j running fastest; of the empty form one 0.
  std::vector<R> bernstein() const requires Field<R>;
  R operator()(const R& u, const R& v) const;

  friend TensorForm operator*(const TensorForm& f, const TensorForm& g) {
    if (f.is_empty() || g.is_empty()) return {};
    TensorForm out(f.degree_u_ + g.degree_u_, f.degree_v_ + g.degree_v_);
    for (int i = 0; i <= f.degree_u_; ++i)
      for (int j = 0; j <= f.degree_v_; ++j)
        for (int k = 0; k <= g.degree_u_; ++k)
          for (int l = 0; l <= g.degree_v_; ++l) out.at(i + k, j + l) += f.at(i, j) * g.at(k, l);
    return out;
  }
  friend TensorForm operator+(const TensorForm& f, const TensorForm& g) {
    if (f.is_empty()) return g;
    if (g.is_empty()) return f;
    const int m = std::max(f.degree_u_, g.degree_u_), n = std::max(f.degree_v_, g.degree_v_);
    TensorForm out = f.elevated(m, n);
    const TensorForm other = g.elevated(m, n);
    for (std::size_t k = 0; k < out.a_.size(); ++k) out.a_[k] += other.a_[k];
    return out;
  }
  friend TensorForm operator-(TensorForm f) {
    for (R& a : f.a_) a = -a;
    return f;
  }
  friend TensorForm operator-(const TensorForm& f, const TensorForm& g) { return f + -g; }

 private:
  int degree_u_ = 0, degree_v_ = 0;
  std::vector<R> a_;
};

// ---------------------------------------------------------------------------------------------------------------------

template <Ring R>
template <std::size_t N>
TensorForm<R> TensorForm<R>::from_bernstein(const BezierPatch<R, N>& patch, std::size_t c) {
  TensorForm out(patch.degree(Direction::u), patch.degree(Direction::v));
  const std::vector<R> of_u = binomials<R>(out.degree_u_), of_v = binomials<R>(out.degree_v_);
  for (int i = 0; i <= out.degree_u_; ++i)
    for (int j = 0; j <= out.degree_v_; ++j) out.at(i, j) = of_u[i] * of_v[j] * patch.point(i, j)[c];
  return out;
}

template <Ring R>
TensorForm<R> TensorForm<R>::elevated(int degree_u, int degree_v) const {
  PATCHPROOF_REQUIRES(degree_u_ <= degree_u && degree_v_ <= degree_v, "TensorForm: elevated to a lower degree");
  if (is_empty()) return TensorForm(degree_u, degree_v);
  if (degree_u_ == degree_u && degree_v_ == degree_v) return *this;
  return *this * TensorForm(BinaryForm<R>(binomials<R>(degree_u - degree_u_)),
                            BinaryForm<R>(binomials<R>(degree_v - degree_v_)));
}

template <Ring R>
std::vector<R> TensorForm<R>::bernstein() const requires Field<R> {
  if (is_empty()) return {R(0)};
  const std::vector<R> of_u = binomials<R>(degree_u_), of_v = binomials<R>(degree_v_);
  std::vector<R> out;
  for (int i = 0; i <= degree_u_; ++i)
    for (int j = 0; j <= degree_v_; ++j) out.push_back(at(i, j) / (of_u[i] * of_v[j]));
  return out;
}

template <Ring R>
R TensorForm<R>::operator()(const R& u, const R& v) const {
  if (is_empty()) return R(0);
  std::vector<R> column;
  for (int i = 0; i <= degree_u_; ++i)
    column.push_back(
        BinaryForm<R>(std::vector<R>(a_.begin() + static_cast<std::ptrdiff_t>(i) * (degree_v_ + 1),
                                     a_.begin() + static_cast<std::ptrdiff_t>(i + 1) * (degree_v_ + 1)))(v));
  return BinaryForm<R>(std::move(column))(u);
}

}  // namespace patchproof
