// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/ball.h"

#include <mpfi_io.h>

#include <cmath>

#include "patchproof/contract.h"

namespace patchproof {
namespace {
thread_local int current_precision = 128;

// MPFR keeps π, logarithms and scratch numbers for each thread, and loses them when it ends.
struct KeptByMpfr {
  ~KeptByMpfr() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  void given_back_at_the_end() {}
};
thread_local KeptByMpfr kept_by_mpfr;

}  // namespace

BallPrecision::BallPrecision(int bits) : previous_(current_precision) {
  PATCHPROOF_REQUIRES(bits >= 2, "BallPrecision: a precision of at least 2 bits");
  current_precision = bits;
}
BallPrecision::~BallPrecision() { current_precision = previous_; }
int BallPrecision::current() { return current_precision; }

Ball::Ball(int value) {
  mpfi_init2(x_, current_precision);
  mpfi_set_si(x_, value);
}
Ball::Ball(double value) {
  PATCHPROOF_REQUIRES(std::isfinite(value), "Ball: NaN and infinity are not numbers");
  mpfi_init2(x_, current_precision);
  mpfi_set_d(x_, value);
}
Ball::Ball(const Rational& value) {
  mpfi_init2(x_, current_precision);
  mpfi_set_q(x_, value.backend().data());
}
Ball::Ball(const Interval& value) {
  mpfi_init2(x_, current_precision);
  mpfi_interv_d(x_, value.inf(), value.sup());
}
Ball::Ball(const Ball& o) {
  mpfi_init2(x_, mpfi_get_prec(o.x_));
  mpfi_set(x_, o.x_);
}
Ball::Ball(Ball&& o) noexcept {
  mpfi_init2(x_, 2);
  mpfi_swap(x_, o.x_);
}
Ball& Ball::operator=(const Ball& o) {
  if (this != &o) {
    mpfi_set_prec(x_, mpfi_get_prec(o.x_));
    mpfi_set(x_, o.x_);
  }
  return *this;
}
Ball& Ball::operator=(Ball&& o) noexcept {
  mpfi_swap(x_, o.x_);
  return *this;
}
Ball::~Ball() { mpfi_clear(x_); }

Ball operator+(const Ball& a, const Ball& b) {
  Ball r;
  mpfi_add(r.x_, a.x_, b.x_);
  return r;
}
Ball operator-(const Ball& a, const Ball& b) {
  Ball r;
  mpfi_sub(r.x_, a.x_, b.x_);
  return r;
}
Ball operator*(const Ball& a, const Ball& b) {
  Ball r;
  mpfi_mul(r.x_, a.x_, b.x_);
  return r;
}
Ball operator/(const Ball& a, const Ball& b) {
  Ball r;
  if (mpfi_has_zero(b.x_) > 0) {  // MPFI would answer NaN for 0/0
    mpfr_set_inf(&r.x_->left, -1);
    mpfr_set_inf(&r.x_->right, 1);
  } else {
    mpfi_div(r.x_, a.x_, b.x_);
  }
  return r;
}
Ball operator-(const Ball& a) {
  Ball r;
  mpfi_neg(r.x_, a.x_);
  return r;
}
Ball sqrt(const Ball& a) {
  PATCHPROOF_REQUIRES(mpfr_sgn(&a.x_->right) >= 0, "sqrt of a negative number");
  Ball cut(a);
  if (mpfr_sgn(&cut.x_->left) < 0) mpfr_set_zero(&cut.x_->left, 1);
  Ball r;
  mpfi_sqrt(r.x_, cut.x_);
  return r;
}
Ball atan(const Ball& a) {
  Ball r;
  kept_by_mpfr.given_back_at_the_end();
  mpfi_atan(r.x_, a.x_);
  return r;
}
Ball exp(const Ball& a) {
  Ball r;
  kept_by_mpfr.given_back_at_the_end();
  mpfi_exp(r.x_, a.x_);
  return r;
}
Ball sin(const Ball& a) {
  Ball r;
  kept_by_mpfr.given_back_at_the_end();
  mpfi_sin(r.x_, a.x_);
  return r;
}
Ball cos(const Ball& a) {
  Ball r;
  kept_by_mpfr.given_back_at_the_end();
  mpfi_cos(r.x_, a.x_);
  return r;
}
Ball Ball::pi() {
  Ball r;
  kept_by_mpfr.given_back_at_the_end();
  mpfi_const_pi(r.x_);
  return r;
}

Interval Ball::to_interval() const {
  return Interval(mpfr_get_d(&x_->left, MPFR_RNDD), mpfr_get_d(&x_->right, MPFR_RNDU));
}

ScaledInterval Ball::to_scaled_interval() const {
  if (mpfi_inf_p(x_)) return {to_interval(), 0};
  const mpfr_exp_t left = mpfr_zero_p(&x_->left) ? mpfr_get_emin() : mpfr_get_exp(&x_->left);
  const mpfr_exp_t right = mpfr_zero_p(&x_->right) ? mpfr_get_emin() : mpfr_get_exp(&x_->right);
  if (mpfr_zero_p(&x_->left) && mpfr_zero_p(&x_->right)) return {};
  const long exponent = left > right ? left : right;
  Ball scaled(*this);
  mpfi_div_2si(scaled.x_, scaled.x_, exponent);
  return {scaled.to_interval(), exponent};
}

bool Ball::contains(const Rational& x) const { return mpfi_is_inside_q(x.backend().data(), x_) > 0; }

bool Ball::is_tight(int bits) const {
  if (!sign()) return false;
  mpfr_t width, size;
  mpfr_init2(width, 64);
  mpfr_init2(size, 64);
  mpfr_sub(width, &x_->right, &x_->left, MPFR_RNDU);
  mpfi_mig(size, x_);
  mpfr_mul_2si(width, width, bits, MPFR_RNDU);
  const bool tight = mpfr_lessequal_p(width, size) != 0;
  mpfr_clear(width);
  mpfr_clear(size);
  return tight;
}

std::optional<Sign> Ball::sign() const {
  const int left = mpfr_sgn(&x_->left), right = mpfr_sgn(&x_->right);
  if (left > 0) return Sign::positive;
  if (right < 0) return Sign::negative;
  if (left == 0 && right == 0) return Sign::zero;
  return std::nullopt;
}

}  // namespace patchproof
