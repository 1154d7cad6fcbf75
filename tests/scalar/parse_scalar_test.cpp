// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/parse_scalar.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <locale>

#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

Rational read(const std::string& text) {
  const Result<Rational> r = parse_scalar<Rational>(text);
  EXPECT_TRUE(r) << text;
  return r ? *r : Rational(-999);
}
Quadratic read_root(const std::string& text) {
  const Result<Quadratic> r = parse_scalar<Quadratic>(text);
  EXPECT_TRUE(r) << text;
  return r ? *r : Quadratic(-999);
}
Rational fraction(long p, long q) { return Rational(p) / Rational(q); }
Quadratic root(int d) { return Quadratic(Rational(0), Rational(1), d); }

template <class T>
void expect_refused(const std::string& text, Decimals decimals = Decimals::exact) {
  const Result<T> r = parse_scalar<T>(text, decimals);
  ASSERT_FALSE(r) << "read as " << to_text(*r) << ": " << text.substr(0, 100);
  EXPECT_EQ(r.error().code, ErrorCode::bad_number);
  EXPECT_FALSE(r.error().message.empty());
  if (text.size() <= static_cast<std::size_t>(kMaxDigits)) {
    EXPECT_EQ(r.error().values, text);
  } else {
    EXPECT_LT(r.error().values.size(), 200u);
    EXPECT_EQ(r.error().values.substr(0, 20), text.substr(0, 20));
  }
}

TEST(ParseScalar, EverySpelling) {
  const std::vector<std::pair<std::string, Rational>> cases = {
      {"42", 42},
      {"-0.1", fraction(-1, 10)},
      {"+.5", fraction(1, 2)},
      {"1.", 1},
      {"-7.", -7},
      {"0", 0},
      {"-0", 0},
      {"-0.000", 0},
      {"007", 7},
      {"0.50", fraction(1, 2)},
      {"1e-3", fraction(1, 1000)},
      {"2.5E+4", 25000},
      {"1e00003", 1000},
      {".25e1", fraction(5, 2)},
      {"1/7", fraction(1, 7)},
      {"-3/4", fraction(-3, 4)},
      {"0.5/3", fraction(1, 6)},
      {"6/4", fraction(3, 2)},
      {"1e2/2.5", 40},
      {"0/5", 0},
      {"0x1.8p-1", fraction(3, 4)},
      {"-0X.8P1", -1},
      {"0x10", 16},
      {"0xAbC", 2748},
      {"0x1.", 1},
      {"0x0.0000000000001p-1022", power_of_two(-1074)},
      {"1e19", Rational("10000000000000000000")},
      {"18446744073709551615", Rational("18446744073709551615")},
      {"18446744073709551616", Rational("18446744073709551616")},
      {"0e4096", 0},
      {"0.00000000000000000000000000025", Rational(1) / (Rational(4) * Rational("1000000000000000000000000000"))}};
  for (const auto& [text, value] : cases) {
    EXPECT_EQ(read(text), value) << text;
    EXPECT_TRUE(read_root(text) == Quadratic(value)) << text;
    EXPECT_FALSE(mentions_root(text));
  }
}

TEST(ParseScalar, EverySpellingOfRoots) {
  const Quadratic one(1), two(2);
  const std::vector<std::pair<std::string, Quadratic>> cases = {
      {"sqrt(2)", root(2)},
      {"-sqrt(5)", -root(5)},
      {"1/2*sqrt(2)", root(2) / two},
      {"1-sqrt(2)", one - root(2)},
      {"sqrt(2)/2", root(2) / two},
      {"1/2+1/2*sqrt(2)", (one + root(2)) / two},
      {"sqrt(3)+1", one + root(3)},
      {"-3*sqrt(2)/4-.5", -Quadratic(3) * root(2) / Quadratic(4) - one / two},
      {"sqrt(8)", two * root(2)},
      {"sqrt(9)", Quadratic(3)},
      {"sqrt(0)", Quadratic(0)},
      {"1+sqrt(1)", two},
      {"0*sqrt(7)", Quadratic(0)},
      {"sqrt(2147483647)", root(2147483647)},
      {"1e1*sqrt(2)", Quadratic(10) * root(2)}};
  for (const auto& [text, value] : cases) {
    EXPECT_TRUE(read_root(text) == value) << text << " read as " << to_text(read_root(text));
    EXPECT_TRUE(mentions_root(text));
    expect_refused<Rational>(text);
  }
}

// Laws 1 and 3, for one number.
void expect_round_trip(const Rational& x) {
  const Rational y = read(to_text(x));
  EXPECT_EQ(y, x);
  EXPECT_EQ(to_text(y), to_text(x)) << "lowest terms";
}

TEST(ParseScalarLaws, Law1_RoundTrip) {
  EXPECT_EQ(to_text(fraction(-1, 7)), "-1/7");
  EXPECT_EQ(to_text(Rational(3)), "3");
  EXPECT_EQ(to_text(Integer(-12)), "-12");
  EXPECT_EQ(to_text(Quadratic(fraction(1, 2), Rational(3), 2)), "1/2+3*sqrt(2)");
  EXPECT_EQ(to_text(-root(5)), "-sqrt(5)");
  EXPECT_EQ(to_text(Quadratic(Rational(-2), fraction(-1, 3), 5)), "-2-1/3*sqrt(5)");
  EXPECT_EQ(to_text(Quadratic(fraction(2, 3))), "2/3");
  WildNumbers random;
  for (int i = 0; i < 2000; ++i) {
    expect_round_trip(random.rational(1 + random.below(70)));
    expect_round_trip(random.rational(1 + random.below(3000)));
    const Integer n = random.integer(1 + random.below(3000));
    EXPECT_EQ(read(to_text(n)), Rational(n));
    const Quadratic q(random.rational(1 + random.below(40)), random.rational(1 + random.below(40)),
                      2 + random.below(2));
    EXPECT_TRUE(read_root(to_text(q)) == q) << to_text(q);
  }
}

TEST(ParseScalarLaws, Law1_DoublesRoundTripShortest) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(-1e300), "-1e+300");
  EXPECT_EQ(to_text(kInfinity), "inf");
  EXPECT_EQ(to_text(Interval(-kInfinity, 0.1)), "[-inf, 0.1]");
  EXPECT_THROW(to_text(std::nan("")), contract_error);
  std::vector<double> doubles = edge_doubles();
  WildNumbers random;
  for (int i = 0; i < 2000; ++i) doubles.push_back(random.finite());
  for (double x : doubles) {
    EXPECT_EQ(nearest_double(read(to_text(x))), x);
    char hexadecimal[64];
    std::snprintf(hexadecimal, sizeof hexadecimal, "%a", x);
    EXPECT_EQ(read(hexadecimal), from_double(x)) << hexadecimal;
  }
}

// Every decimal of up to 22 digits takes one of the scanner's two roads: both must agree with plain arithmetic.
TEST(ParseScalarLaws, Law2_ExactDecimals) {
  WildNumbers random;
  for (int i = 0; i < 5000; ++i) {
    const int digits = 1 + random.below(22), places = random.below(digits + 1), exponent = random.below(50) - 25;
    std::string text = random.below(2) ? "-" : "";
    Rational value = 0;
    for (int k = 0; k < digits; ++k) {
      const int digit = random.below(3) ? random.below(10) : 0;
      if (k == digits - places) text += '.';
      text += static_cast<char>('0' + digit);
      value = value * Rational(10) + Rational(digit);
    }
    if (random.below(2)) text += 'e' + std::to_string(exponent);
    const int scale = (text.find('e') == std::string::npos ? 0 : exponent) - places;
    for (int k = 0; k < std::abs(scale); ++k) value = scale > 0 ? value * Rational(10) : value / Rational(10);
    EXPECT_EQ(read(text), text[0] == '-' ? Rational(-value) : value) << text;
  }
}

TEST(ParseScalarLaws, Law2_Binary64IsTheNearestDouble) {
  const auto binary = [](const std::string& text) { return *parse_scalar<Rational>(text, Decimals::binary64); };
  EXPECT_EQ(read("0.1"), fraction(1, 10));
  EXPECT_EQ(binary("0.1"), from_double(0.1));
  EXPECT_EQ(binary("-0.1"), from_double(-0.1));
  EXPECT_EQ(binary("1/3"), from_double(1.0 / 3));
  EXPECT_EQ(binary("0x1.8p-1"), fraction(3, 4));
  EXPECT_EQ(binary("9007199254740993"), Rational("9007199254740992")) << "a tie to even";
  EXPECT_EQ(binary("2.2250738585072011e-308"), from_double(2.2250738585072011e-308));
  EXPECT_EQ(binary("1e-400"), 0) << "0 is the nearest double";
  EXPECT_EQ(binary("1.7976931348623157e308"), from_double(kLargest));
  expect_refused<Rational>("1.7976931348623159e308", Decimals::binary64);
  expect_refused<Rational>("-1e309", Decimals::binary64);
  EXPECT_EQ(read("1e309"), read("1e308") * Rational(10));
  const Quadratic rounded = *parse_scalar<Quadratic>("sqrt(2)", Decimals::binary64);
  EXPECT_TRUE(rounded == Quadratic(from_double(std::sqrt(2.0))));
}

TEST(ParseScalarLaws, Law3_LowestTerms) {
  for (const char* text :
       {"0.5", "6/4", "0x8p-4", "25e-2", "0.00000000000000000000000000000000000000000005", "10/2.5"}) {
    const Rational x = read(text);
    EXPECT_EQ(gcd(numerator(x), denominator(x)), 1) << text;
    EXPECT_GT(denominator(x), 0) << text;
  }
}

TEST(ParseScalarErrors, NotANumber) {
  for (const char* text :
       {"",      " ",        "-",     "+",        ".",     "-.",  "e5",
        ".e5",   "1e",       "1e+",   "1e1.5",    "1.2.3", "--1", "+-1",
        "1-",    "1+1",      " 1",    "1 ",       "1 2",   "1,5", "1_000",
        "nan",   "-nan",     "inf",   "Infinity", "1/",    "/2",  "1/-2",
        "1/+2",  "1//2",     "1/2/3", "1/ 2",     "0x",    "0x.", "0xp1",
        "0x1p",  "0xg",      "1x2",   "0x1/2",    "1/0x2", "1p3", "1f",
        "1e5e5", "\xC2\xBD", "٣",     "1\n",      "1*2",   "()",  "-0.565656565656572.45286195286198"}) {
    expect_refused<Rational>(text);
    expect_refused<Quadratic>(text);
  }
  using namespace std::string_literals;
  expect_refused<Rational>("1\0"s);
  expect_refused<Rational>("1\0002"s);
}

TEST(ParseScalarErrors, NotARoot) {
  for (const char* text : {"sqrt",
                           "sqrt(",
                           "sqrt()",
                           "sqrt(2",
                           "sqrt 2",
                           "sqrt(-2)",
                           "sqrt(+2)",
                           "sqrt(1/2)",
                           "sqrt(2.0)",
                           "sqrt( 2)",
                           "sqrt(2)sqrt(2)",
                           "sqrt(2)*2",
                           "sqrt(2)+sqrt(2)",
                           "sqrt(2)-sqrt(3)",
                           "1+2",
                           "1+sqrt(2)+1",
                           "1+-sqrt(2)",
                           "1*sqrt(2",
                           "2sqrt(2)",
                           "*sqrt(2)",
                           "sqrt(2)/0",
                           "sqrt(2)/",
                           "sqrt(2147483648)",
                           "sqrt(99999999999999999999)",
                           "SQRT(2)",
                           "sqrt(sqrt(2))",
                           "sqrt(2)/-2",
                           "1+"})
    expect_refused<Quadratic>(text);
}

TEST(ParseScalarErrors, ZeroDenominators) {
  for (const char* text : {"1/0", "0/0", "1/0.00", "1/0e5", "1/.0"}) expect_refused<Rational>(text);
}

TEST(ParseScalarErrors, Limits) {
  const std::string longest(kMaxDigits, '9');
  EXPECT_EQ(to_text(read(longest)), longest);
  EXPECT_EQ(read("0." + std::string(kMaxDigits - 3, '0') + "1"),
            Rational(1) / read("1e" + std::to_string(kMaxDigits - 2)));
  expect_refused<Rational>(longest + "9");
  expect_refused<Rational>(std::string(1000000, '1'));
  expect_refused<Quadratic>(std::string(1000000, '1'));
  EXPECT_EQ(read("1e4096") * read("1e-4096"), 1);
  EXPECT_EQ(read("0x1p4096"), power_of_two(4096));
  for (const char* text : {"1e4097", "1e-4097", "0x1p4097", "1e99999999999999999999", "0e4097"})
    expect_refused<Rational>(text);
}

// German habits: a decimal comma and groups of three.
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ParseScalar, IndependentOfTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const std::locale streams_before = std::locale::global(std::locale(std::locale::classic(), new German));
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})  // C's own, where one is installed
    if (std::setlocale(LC_ALL, name)) break;
  EXPECT_EQ(read("0.1"), fraction(1, 10));
  EXPECT_EQ(read("1234567.5e-1"), fraction(12345675, 100));
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(Rational(1234567)), "1234567");
  EXPECT_EQ(to_text(Integer(1234567)), "1234567");
  EXPECT_EQ(to_text(Quadratic(Rational(1000), Rational(1000), 1000003)), "1000+1000*sqrt(1000003)");
  EXPECT_EQ(to_text(Interval(1000.5, 1e22)), "[1000.5, 1e+22]");
  expect_refused<Rational>("0,1");
  expect_refused<Rational>("1.000,5");
  std::locale::global(streams_before);
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace patchproof::test
