// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/b_function.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/real_roots.h"
#include "spline/smooth_b_function.h"

namespace patchproof {
namespace {

Error usage(const std::string& where, const std::string& message, const std::string& values) {
  return {ErrorCode::usage, where, message, values};
}

bool is_order(int n) { return 0 <= n && n <= BFunction::kMaxOrder; }

// How many of the first differences from the front vanish, less those that must: B(0) = 0 and B^(j)(0) = 0 for j ≤ order.
int flatness(const std::vector<Rational>& b) {
  int order = 0;
  while (order + 2 < static_cast<int>(b.size()) && b[order + 1] == b[0]) ++order;
  return order;
}

std::string joined(const std::vector<Rational>& numbers) {
  std::string out;
  for (const Rational& x : numbers) out += (out.empty() ? "" : ",") + to_text(x);
  return out;
}

// Functions of the same parameters share their tables, as long as one of them lives and some time longer.
std::shared_ptr<const detail::SmoothBFunction> shared_tables(const BFunction::Intrinsic& x, const std::string& name) {
  constexpr std::size_t kKept = 8;
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const detail::SmoothBFunction>> known;
  static std::deque<std::shared_ptr<const detail::SmoothBFunction>> latest;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const detail::SmoothBFunction>& place = known[name];
  auto out = place.lock();
  if (!out) {
    std::erase_if(known, [&name](const auto& entry) { return entry.first != name && entry.second.expired(); });
    place = out = detail::make_expo_rational(x);
    latest.push_back(out);
    if (latest.size() > kKept) latest.pop_front();
  }
  return out;
}

}  // namespace

BFunction::BFunction(Kind kind, std::vector<Rational> numerator, std::vector<Rational> denominator)
    : kind_(kind), numerator_(std::move(numerator)), denominator_(std::move(denominator)) {}

// ∫ B_a^(a+b), made 1 at the end: Bernstein coefficients a + 1 times 0, then b + 1 times 1.
Result<BFunction> BFunction::beta(int a, int b) {
  if (!is_order(a) || !is_order(b))
    return usage("B-function", "an order is at least 0 and at most " + std::to_string(kMaxOrder),
                 std::to_string(is_order(a) ? b : a));
  std::vector<Rational> numerator(a + 1, Rational(0));
  numerator.resize(a + b + 2, Rational(1));
  return BFunction(Kind::polynomial, std::move(numerator), {Rational(1)});
}

Result<BFunction> BFunction::rational(int order) {
  if (!is_order(order))
    return usage("B-function", "an order is at least 0 and at most " + std::to_string(kMaxOrder),
                 std::to_string(order));
  if (order == 0) return beta(0, 0);
  std::vector<Rational> numerator(order + 2, Rational(0)), denominator = numerator;
  numerator.back() = denominator.front() = denominator.back() = Rational(1);
  return BFunction(Kind::rational, std::move(numerator), std::move(denominator));
}

BFunction BFunction::trigonometric() { return BFunction(Kind::trigonometric, {}, {}); }

BFunction BFunction::logistic() {
  static const std::shared_ptr<const detail::SmoothBFunction> shared = detail::make_logistic();
  BFunction out(Kind::logistic, {}, {});
  out.smooth_ = shared;
  return out;
}

Result<BFunction> BFunction::expo_rational(const Rational& alpha, const Rational& beta, const Rational& gamma,
                                           const Rational& lambda) {
  const auto refuse = [&](const char* name, const Rational& value, const std::string& why) -> Result<BFunction> {
    return usage(std::string("expo-rational B-function, ") + name, why, to_text(value));
  };
  if (alpha <= 0) return refuse("alpha", alpha, "it is not positive");
  if (beta <= 0) return refuse("beta", beta, "it is not positive");
  if (gamma <= 0) return refuse("gamma", gamma, "it is not positive");
  if (lambda <= 0 || lambda >= 1)
    return refuse("lambda", lambda, "it lies outside (0, 1), so that a derivative at an end would not vanish");
  const Rational half = Rational(1) / Rational(2), sixteenth = Rational(1) / Rational(16);
  const auto lies = [](const Rational& x, const Rational& low, const Rational& high) { return low <= x && x <= high; };
  if (!lies(alpha, half, Rational(8))) return refuse("alpha", alpha, "enclosures exist for 1/2 to 8");
  if (!lies(alpha * gamma, half, Rational(8)))
    return refuse("gamma", gamma, "enclosures exist for alpha gamma from 1/2 to 8");
  if (!lies(beta, sixteenth, Rational(16))) return refuse("beta", beta, "enclosures exist for 1/16 to 16");
  if (!lies(lambda, sixteenth, 1 - sixteenth)) return refuse("lambda", lambda, "enclosures exist for 1/16 to 15/16");
  BFunction out(Kind::expo_rational, {}, {});
  out.intrinsic_ = Intrinsic{alpha, beta, gamma, lambda};
  out.smooth_ = shared_tables(*out.intrinsic_, out.to_string());
  return out;
}

Result<BFunction> BFunction::from_polynomial(std::vector<Rational> b) {
  const std::string where = "B-function of a polynomial";
  if (b.size() < 2 || b.size() > kMaxCoefficients)
    return usage(where, "a polynomial of degree 1 to " + std::to_string(kMaxCoefficients - 1) + " is needed",
                 std::to_string(b.size()) + " coefficients");
  if (b.front() != 0) return Error{ErrorCode::not_monotone, where, "B(0) is not 0", to_text(b.front())};
  if (b.back() != 1) return Error{ErrorCode::not_monotone, where, "B(1) is not 1", to_text(b.back())};
  while (auto lower = reduce_degree(b)) b = std::move(*lower);
  // B′ ≥ 0 unless an odd factor changes its sign inside, since it is positive somewhere. Zeros without a change are no harm.
  const auto slope = BinaryForm<Rational>::from_bernstein(hodograph(b));
  const BinaryForm<Rational> odd = odd_part(slope);
  if (odd.degree() > 0) {
    const Rational width = Rational(1) / Rational(1 << 20);
    const auto roots = isolate_roots(odd, width);
    if (!roots.empty()) {
      const auto& [low, high] = roots.front();
      return Error{ErrorCode::not_monotone, where, "its derivative changes sign",
                   low == high ? "at " + to_text(low) : "between " + to_text(low) + " and " + to_text(high)};
    }
  }
  return BFunction(Kind::polynomial, std::move(b), {Rational(1)});
}

std::string BFunction::to_string() const {
  switch (kind_) {
    case Kind::polynomial: {
      const int a = flatness(numerator_), b = static_cast<int>(numerator_.size()) - 2 - a;
      const bool is_beta =
          b >= 0 && std::all_of(numerator_.begin() + a + 1, numerator_.end(), [](const Rational& x) { return x == 1; });
      if (!is_beta) return "bernstein(" + joined(numerator_) + ")";
      if (a == b) return "polynomial(" + std::to_string(a) + ")";
      return "beta(" + std::to_string(a) + "," + std::to_string(b) + ")";
    }
    case Kind::rational: return "rational(" + std::to_string(numerator_.size() - 2) + ")";
    case Kind::trigonometric: return "trigonometric";
    case Kind::logistic: return "logistic";
    case Kind::expo_rational: break;
  }
  return "expo-rational(" + joined({intrinsic_->alpha, intrinsic_->beta, intrinsic_->gamma, intrinsic_->lambda}) + ")";
}

Result<BFunction> BFunction::parse(std::string_view text) {
  const auto wrong = [&text](const std::string& why) {
    return Error{ErrorCode::syntax, "B-function", why, std::string(text.substr(0, 80))};
  };
  const std::size_t open = text.find('(');
  const std::string_view name = text.substr(0, open);
  std::vector<std::string_view> words;
  if (open != std::string_view::npos) {
    if (text.back() != ')') return wrong("a closing bracket is missing");
    std::string_view rest = text.substr(open + 1, text.size() - open - 2);
    while (words.size() <= kMaxCoefficients) {
      const std::size_t comma = rest.find(',');
      words.push_back(rest.substr(0, comma));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
  }
  std::vector<Rational> numbers;
  for (const std::string_view word : words) {
    const Result<Rational> x = parse_scalar<Rational>(word);
    if (!x) {
      Error error = x.error();
      error.where = "B-function";
      return error;
    }
    numbers.push_back(*x);
  }
  const auto whole = [&](std::size_t i) -> std::optional<int> {
    int n = 0;
    const auto [end, code] = std::from_chars(words[i].data(), words[i].data() + words[i].size(), n);
    if (code != std::errc() || end != words[i].data() + words[i].size()) return std::nullopt;
    return n;
  };
  const std::size_t count = numbers.size();
  if (name == "polynomial" || name == "rational" || name == "beta") {
    if (count != (name == "beta" ? 2U : 1U)) return wrong("another number of orders is needed");
    const std::optional<int> a = whole(0), b = whole(count - 1);
    if (!a || !b) return wrong("an order is a whole number");
    return name == "rational" ? rational(*a) : beta(*a, *b);
  }
  if (name == "bernstein") return from_polynomial(std::move(numbers));
  if (name == "trigonometric" && words.empty() && open == std::string_view::npos) return trigonometric();
  if (name == "logistic" && words.empty() && open == std::string_view::npos) return logistic();
  if (name == "expo-rational") {
    if (open == std::string_view::npos) return expo_rational();
    if (count != 4) return wrong("four intrinsic parameters are needed: alpha, beta, gamma, lambda");
    return expo_rational(numbers[0], numbers[1], numbers[2], numbers[3]);
  }
  return wrong(
      "polynomial(n), beta(a,b), rational(n), trigonometric, logistic, expo-rational(alpha,beta,gamma,lambda) or "
      "bernstein(b0,…,bn) is needed");
}

std::optional<int> BFunction::order_at_begin() const {
  if (kind_ == Kind::polynomial) return flatness(numerator_);
  if (kind_ == Kind::rational) return static_cast<int>(numerator_.size()) - 2;
  if (kind_ == Kind::trigonometric) return 1;
  return std::nullopt;
}
std::optional<int> BFunction::order_at_end() const {
  if (kind_ == Kind::polynomial) return flatness(reverse(numerator_));
  return order_at_begin();
}
std::optional<int> BFunction::order() const {
  const std::optional<int> a = order_at_begin(), b = order_at_end();
  return a ? std::optional(std::min(*a, *b)) : a;
}

std::optional<int> BFunction::smoothness() const {
  const auto kink = smooth_ ? smooth_->kink() : std::nullopt;
  return kink ? std::optional(kink->smoothness) : std::nullopt;
}

bool BFunction::is_symmetric() const {
  if (kind_ == Kind::expo_rational) return intrinsic_->gamma == 1 && intrinsic_->lambda == Rational(1) / Rational(2);
  if (kind_ != Kind::polynomial) return true;
  for (std::size_t i = 0; i < numerator_.size(); ++i)
    if (numerator_[i] + numerator_[numerator_.size() - 1 - i] != 1) return false;
  return true;
}

const std::vector<Rational>& BFunction::numerator() const {
  PATCHPROOF_REQUIRES(is_exact(), "B-function: only exact ones have a numerator");
  return numerator_;
}
const std::vector<Rational>& BFunction::denominator() const {
  PATCHPROOF_REQUIRES(is_exact(), "B-function: only exact ones have a denominator");
  return denominator_;
}
const BFunction::Intrinsic& BFunction::intrinsic() const {
  PATCHPROOF_REQUIRES(intrinsic_.has_value(), "B-function: only expo-rational ones have intrinsic parameters");
  return *intrinsic_;
}
const detail::SmoothBFunction& BFunction::smooth() const {
  PATCHPROOF_REQUIRES(smooth_ != nullptr, "B-function: this one has no enclosures of its own");
  return *smooth_;
}

double double_error(const BFunction& b, int k) {
  PATCHPROOF_REQUIRES(!b.is_exact() && 0 <= k && k < detail::DoubleTable::kDerivatives,
                      "double_error: 0 ≤ k ≤ 3, not exact");
  if (b.kind() != BFunction::Kind::trigonometric) return b.smooth().table().error(k);
  // Sine and cosine are within 2^-51 (transcendental.cpp); a square of one at most 1; π^k/2 takes 2k + 1 roundings.
  if (k == 0) return kBFunctionDoubleError;
  return std::pow(3.2, k) / 2 * (0x1p-51 + (2 * k + 2) * 0x1p-53);
}

}  // namespace patchproof
