// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/parse_scalar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstdint>

namespace patchproof {
namespace {

// What is wrong with a number; nullptr: nothing.
using Complaint = const char*;
constexpr Complaint kNotANumber = "not a number";
constexpr Complaint kExponentTooLarge = "an exponent beyond ±4096";
static_assert(kMaxExponent == 4096, "as kExponentTooLarge says");

// std::isdigit asks the locale; a number must not.
bool is_digit(char c) { return c >= '0' && c <= '9'; }

int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

struct Cursor {
  const char* at;
  const char* end;
  bool done() const { return at == end; }
  bool sees(char c) const { return at != end && *at == c; }
  bool sees_digit() const { return at != end && is_digit(*at); }
  bool take(char c) { return sees(c) && (++at, true); }
  bool take(char lower, char upper) { return take(lower) || take(upper); }
  bool take(std::string_view word) {
    if (!std::string_view(at, static_cast<std::size_t>(end - at)).starts_with(word)) return false;
    at += word.size();
    return true;
  }
};

// [sign] digits
Complaint scan_exponent(Cursor& in, long& exponent) {
  const bool negative = in.take('-');
  if (!negative) in.take('+');
  if (!in.sees_digit()) return "an exponent without digits";
  long magnitude = 0;
  for (; in.sees_digit(); ++in.at) {
    magnitude = magnitude * 10 + (*in.at - '0');
    if (magnitude > kMaxExponent) return kExponentTooLarge;
  }
  exponent = negative ? -magnitude : magnitude;
  return nullptr;
}

constexpr int kDigitsInWord = 19;  // 10^19 < 2^64
constexpr std::array<std::uint64_t, kDigitsInWord + 1> kPowersOfTen = [] {
  std::array<std::uint64_t, kDigitsInWord + 1> powers{1};
  for (int i = 1; i <= kDigitsInWord; ++i) powers[i] = powers[i - 1] * 10;
  return powers;
}();
static_assert(sizeof(unsigned long) == sizeof(std::uint64_t), "mpz_set_ui takes a whole word");

// mantissa · 10^-places in lowest terms. Only 2 and 5 can divide both, so no general gcd is needed.
Rational short_decimal(std::uint64_t mantissa, int places) {
  Rational r;
  if (mantissa == 0) return r;
  const int twos = std::min(std::countr_zero(mantissa), places);
  mantissa >>= twos;
  std::uint64_t denominator = kPowersOfTen[places] >> twos;
  for (int fives = places; fives > 0 && mantissa % 5 == 0; --fives) {
    mantissa /= 5;
    denominator /= 5;
  }
  mpq_set_ui(r.backend().data(), mantissa, denominator);
  return r;
}

// digits · 10^scale (base 10) or digits · 2^scale (base 16)
Rational long_number(const std::string& digits, int base, long scale) {
  Rational r;
  mpq_t& q = r.backend().data();
  mpz_set_str(mpq_numref(q), digits.c_str(), base);
  const auto places = static_cast<unsigned long>(scale < 0 ? -scale : scale);
  if (base == 16) {
    scale < 0 ? mpq_div_2exp(q, q, places) : mpq_mul_2exp(q, q, places);
  } else if (scale < 0) {
    mpz_ui_pow_ui(mpq_denref(q), 10, places);
    mpq_canonicalize(q);
  } else {
    Integer power;
    mpz_ui_pow_ui(power.backend().data(), 10, places);
    mpz_mul(mpq_numref(q), mpq_numref(q), power.backend().data());
  }
  return r;
}

// digits [. digits] [e exponent], with a digit on at least one side of the point
Complaint scan_decimal(Cursor& in, Rational& out) {
  const char* const begin = in.at;
  std::uint64_t mantissa = 0;  // right as long as significant ≤ kDigitsInWord
  int significant = 0;
  bool any = false;
  const auto scan_digits = [&] {
    const char* const first = in.at;
    for (; in.sees_digit(); ++in.at) {
      if (significant > 0 || *in.at != '0') ++significant;
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*in.at - '0');
    }
    any = any || in.at != first;
    return static_cast<long>(in.at - first);
  };
  scan_digits();
  const long places = in.take('.') ? scan_digits() : 0;
  const char* const end = in.at;
  if (!any) return kNotANumber;
  long exponent = 0;
  if (in.take('e', 'E'))
    if (const Complaint wrong = scan_exponent(in, exponent)) return wrong;

  const long scale = exponent - places;
  if (significant <= kDigitsInWord && scale <= 0 && scale >= -kDigitsInWord) {
    out = short_decimal(mantissa, static_cast<int>(-scale));
  } else if (scale > 0 && significant + scale <= kDigitsInWord) {
    out = short_decimal(mantissa * kPowersOfTen[static_cast<std::size_t>(scale)], 0);
  } else {
    std::string digits;
    digits.reserve(static_cast<std::size_t>(end - begin));
    for (const char* p = begin; p != end; ++p)
      if (*p != '.') digits += *p;
    out = long_number(digits, 10, scale);
  }
  return nullptr;
}

// hex digits [. hex digits] [p exponent]; the cursor stands behind 0x
Complaint scan_hexadecimal(Cursor& in, Rational& out) {
  std::string digits;
  const auto scan_digits = [&] {
    for (; !in.done() && hex_digit(*in.at) >= 0; ++in.at) digits += *in.at;
    return digits.size();
  };
  const std::size_t whole = scan_digits();
  const std::size_t all = in.take('.') ? scan_digits() : whole;
  if (all == 0) return kNotANumber;
  long exponent = 0;
  if (in.take('p', 'P'))
    if (const Complaint wrong = scan_exponent(in, exponent)) return wrong;
  out = long_number(digits, 16, exponent - 4 * static_cast<long>(all - whole));
  return nullptr;
}

// decimal, decimal / decimal, or a hexadecimal number; no sign
Complaint scan_quotient(Cursor& in, Rational& out) {
  if (in.take("0x") || in.take("0X")) return scan_hexadecimal(in, out);
  if (const Complaint wrong = scan_decimal(in, out)) return wrong;
  if (!in.take('/')) return nullptr;
  Rational denominator;
  if (const Complaint wrong = scan_decimal(in, denominator)) return wrong;
  if (denominator == 0) return "a zero denominator";
  out /= denominator;
  return nullptr;
}

bool take_sign(Cursor& in) {
  if (in.take('-')) return true;
  in.take('+');
  return false;
}

Complaint at_end(const Cursor& in) { return in.done() ? nullptr : "text after the end of the number"; }

Complaint scan(std::string_view text, Rational& out) {
  Cursor in{text.data(), text.data() + text.size()};
  const bool negative = take_sign(in);
  if (const Complaint wrong = scan_quotient(in, out)) return wrong;
  if (negative) mpq_neg(out.backend().data(), out.backend().data());
  return at_end(in);
}

// The cursor stands behind "sqrt(".
Complaint scan_root(Cursor& in, Quadratic& out) {
  if (!in.sees_digit()) return "sqrt of something that is not a whole number";
  long d = 0;
  for (; in.sees_digit(); ++in.at) {
    d = d * 10 + (*in.at - '0');
    if (d > INT_MAX) return "sqrt of a number beyond 2^31";
  }
  if (!in.take(')')) return "sqrt without closing parenthesis";
  const auto root = std::lround(std::sqrt(static_cast<double>(d)));  // exact for squares below 2^31
  out = root * root == d ? Quadratic(static_cast<int>(root)) : Quadratic(Rational(0), Rational(1), static_cast<int>(d));
  return nullptr;
}

// quotient, or [quotient *] sqrt(d) [/ decimal]
Complaint scan_term(Cursor& in, Quadratic& out, bool& has_root) {
  Rational factor(1);
  has_root = in.take("sqrt(");
  if (!has_root) {
    if (const Complaint wrong = scan_quotient(in, factor)) return wrong;
    if (in.take('*')) {
      if (!in.take("sqrt(")) return "only sqrt(...) may follow the sign *";
      has_root = true;
    }
  }
  out = Quadratic(1);
  if (has_root) {
    if (const Complaint wrong = scan_root(in, out)) return wrong;
    if (in.take('/')) {
      Rational divisor;
      if (const Complaint wrong = scan_decimal(in, divisor)) return wrong;
      if (divisor == 0) return "a zero denominator";
      factor /= divisor;
    }
  }
  out = Quadratic(factor) * out;
  return nullptr;
}

// At most one rational term and one with a root, in either order.
Complaint scan(std::string_view text, Quadratic& out) {
  Cursor in{text.data(), text.data() + text.size()};
  bool negative = take_sign(in), first_has_root = false;
  if (const Complaint wrong = scan_term(in, out, first_has_root)) return wrong;
  if (negative) out = -out;
  if (!in.sees('+') && !in.sees('-')) return at_end(in);
  negative = take_sign(in);
  Quadratic second;
  bool second_has_root = false;
  if (const Complaint wrong = scan_term(in, second, second_has_root)) return wrong;
  if (first_has_root == second_has_root) return "a sum of anything but one rational number and one root";
  out = negative ? out - second : out + second;
  return at_end(in);
}

Error bad_number(std::string_view text, std::string message) {
  constexpr std::size_t kKept = 80;  // of each end of a text too long to repeat
  std::string values(text);
  if (text.size() > static_cast<std::size_t>(kMaxDigits))
    values = std::string(text.substr(0, kKept)) + " … " + std::string(text.substr(text.size() - kKept));
  return {ErrorCode::bad_number, "", std::move(message), std::move(values)};
}

}  // namespace

template <ExactField T>
Result<T> parse_scalar(std::string_view text, Decimals decimals) {
  if (text.size() > static_cast<std::size_t>(kMaxDigits))
    return bad_number(text, "a number of " + std::to_string(text.size()) + " characters; at most " +
                                std::to_string(kMaxDigits) + " are read");
  T value;
  if (const Complaint wrong = scan(text, value)) return bad_number(text, wrong);
  if (decimals == Decimals::binary64) {
    const double rounded = nearest_double(value);
    if (!std::isfinite(rounded)) return bad_number(text, "a number beyond the largest double");
    value = embed<T>(from_double(rounded));
  }
  return value;
}

template Result<Rational> parse_scalar<Rational>(std::string_view, Decimals);
template Result<Quadratic> parse_scalar<Quadratic>(std::string_view, Decimals);

bool mentions_root(std::string_view text) { return text.find("sqrt") != std::string_view::npos; }

std::string to_text(const Rational& x) { return x.str(); }
std::string to_text(const Integer& x) { return x.str(); }

std::string to_text(const Quadratic& x) {
  if (x.is_rational()) return to_text(x.rational_part());
  const Rational b = x.root_coefficient();
  std::string text = x.rational_part() == 0 ? "" : to_text(x.rational_part());
  if (b < 0)
    text += '-';
  else if (!text.empty())
    text += '+';
  const Rational size = b < 0 ? Rational(-b) : b;
  if (size != 1) text += to_text(size) + '*';
  return text + "sqrt(" + std::to_string(x.root()) + ")";
}

std::string to_text(double x) {
  PATCHPROOF_REQUIRES(!std::isnan(x), "to_text: NaN is not a number of any report");
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  PATCHPROOF_REQUIRES(error == std::errc(), "to_text: a double has at most 24 characters");
  return std::string(buffer.data(), end);
}

std::string to_text(const Interval& x) { return "[" + to_text(x.inf()) + ", " + to_text(x.sup()) + "]"; }

}  // namespace patchproof
