// SPDX-License-Identifier: Apache-2.0
// The words of a BREP file: integers that must be right, and numbers whose damage is noted, each with its line.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brep_text.h"

namespace patchproof::occt {

inline constexpr double kInfinite = 1e100;  // what Open CASCADE takes for infinity; it writes 2e100

// Ends the reading; caught in check_brep_text.
struct Stop {
  Error error;
};

enum class Number {
  parameter,   // below ten times kInfinite: unbounded curves are meant to have such ranges
  coordinate,  // below kInfinite
  positive     // and above 0
};

class BrepWords {
 public:
  BrepWords(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

 protected:
  [[noreturn]] void stop(ErrorCode code, std::string message, std::string_view word = {}) const {
    const std::string inside = entity_.empty() ? table_ : table_ + ", " + entity_;
    throw Stop{{code, fmt::format("{}:{}{}", path_, line_, inside.empty() ? "" : " at " + inside), std::move(message),
                shown(word)}};
  }
  static std::string shown(std::string_view word) {
    std::string out(word.substr(0, 60));
    for (char& c : out)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    return out + (word.size() > 60 ? "…" : "");
  }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skip_space() {
    for (; at_ < bytes_.size() && is_space(bytes_[at_]); ++at_) line_ += bytes_[at_] == '\n';
  }
  std::string_view word(const char* what) {
    skip_space();
    if (at_ == bytes_.size()) stop(ErrorCode::syntax, std::string("the file ends where ") + what + " should stand");
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(begin, at_ - begin);
  }
  std::string_view coming() {
    skip_space();
    std::size_t end = at_;
    while (end < bytes_.size() && !is_space(bytes_[end])) ++end;
    return bytes_.substr(at_, end - at_);
  }

  long integer(const char* what, long least, long most, ErrorCode outside = ErrorCode::syntax) {
    const std::string_view text = word(what);
    const bool sign = text.size() > 1 && text[0] == '+';
    long x = 0;
    const auto [end, failure] = std::from_chars(text.data() + sign, text.data() + text.size(), x);
    const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
    if (failure != std::errc() || (!rest.empty() && rest[0] != 'C' && rest[0] != 'G'))
      stop(ErrorCode::syntax, fmt::format("{} should stand here", what), text);
    at_ -= rest.size();  // "44CN": an index, and a class of continuity
    if (x < least || x > most) stop(outside, fmt::format("{} is not between {} and {}", what, least, most), text);
    return x;
  }
  bool flag(const char* what) { return integer(what, 0, 1) == 1; }
  int count(const char* what) { return static_cast<int>(integer(what, 0, kMany)); }
  int index(const char* what, const std::vector<BrepEntity>& of) {
    return static_cast<int>(integer(what, 0, static_cast<long>(of.size()), ErrorCode::bad_reference));
  }

  // The number, or 0 for one that cannot be used; that is noted.
  template <class Name>
  double number(Number kind, Name name) {
    const std::string_view text = word("a number");
    const bool sign = text.size() > 1 && text[0] == '+';
    double x = 0;
    const auto [end, failure] = std::from_chars(text.data() + sign, text.data() + text.size(), x);
    const bool whole = end == text.data() + text.size();
    if (failure == std::errc::result_out_of_range && whole) {
      // Too large, or so small that it is 0.
      const std::size_t exponent = text.find_first_of("eE");
      if (exponent != std::string_view::npos && text.substr(exponent + 1, 1) == "-") return 0;
      x = HUGE_VAL;
    } else if (failure != std::errc() || !whole) {
      x = NAN;
    }
    const bool infinite = !(std::fabs(x) < (kind == Number::parameter ? 10 : 1) * kInfinite);
    if (!infinite && (kind != Number::positive || x > 0)) return x;
    const char* why = !std::isfinite(x) ? "no finite number"
                      : infinite        ? "which Open CASCADE takes for infinity"
                                        : "not positive: Open CASCADE knows no such weights";
    note(infinite ? ErrorCode::bad_number : ErrorCode::unsupported,
         fmt::format("{} is {}, {}", name(), shown(text), why));
    if (mends_) replacements_.push_back({at_ - text.size(), at_, kind == Number::positive ? "1" : "0"});
    return 0;
  }
  void numbers(int n, Number kind, const char* name) {
    for (int i = 0; i < n; ++i) number(kind, [&] { return name; });
  }
  void coordinates(int n, const char* name) { numbers(n, Number::coordinate, name); }

  // The first damage of an entity counts.
  void note(ErrorCode code, const std::string& what) {
    if (!damage_) damage_ = Damage{code, fmt::format("{} (line {}): {}", entity_, line_, what)};
  }

  static constexpr long kMany = 1'000'000'000;

  const std::string& path_;
  const std::string_view bytes_;
  std::size_t at_ = 0;
  long line_ = 1;
  bool mends_ = false;            // single numbers; else the whole entity
  std::string table_, entity_;    // where the reading stands
  std::optional<Damage> damage_;  // of the entity
  std::vector<BrepText::Replacement> replacements_;
};

}  // namespace patchproof::occt
