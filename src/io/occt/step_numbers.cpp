// SPDX-License-Identifier: Apache-2.0
#include "step_numbers.h"

#include <charconv>
#include <cmath>

namespace patchproof::occt {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view bytes) : bytes_(bytes) {}

  BadNumbers scan() {
    bool in_data = false;
    long entity = 0;
    while (skip_to_word()) {
      const std::string_view word = this->word();
      if (word.empty()) {  // a mark
        if (bytes_[at_++] == ';') entity = 0;
        continue;
      }
      if (!in_data) {
        in_data = word == "DATA";
      } else if (entity == 0) {
        if (word == "ENDSEC") in_data = false;
        if (word[0] == '#') entity = number_of(word.substr(1));
      } else if (is_bad(word)) {
        out_.try_emplace(entity, BadNumber{line_, std::string(word.substr(0, 60))});
      }
    }
    return std::move(out_);
  }

 private:
  static bool is_mark(char c) { return std::string_view("(),;=").find(c) != std::string_view::npos; }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  // Beyond spaces, texts ('' in them is a quote; they are two texts then) and comments.
  bool skip_to_word() {
    while (at_ < bytes_.size()) {
      const char c = bytes_[at_];
      std::size_t end = at_ + 1;
      if (c == '\'' || c == '"')
        end = bytes_.find(c, end);
      else if (bytes_.substr(at_, 2) == "/*")
        end = bytes_.find("*/", at_ + 2);
      else if (!is_space(c))
        return true;
      else
        --end;
      if (end == std::string_view::npos) return false;
      end += c == '/' ? 2 : 1;
      for (; at_ < end; ++at_) line_ += bytes_[at_] == '\n';
    }
    return false;
  }
  std::string_view word() {
    const std::size_t begin = at_;
    for (; at_ < bytes_.size() && !is_mark(bytes_[at_]) && !is_space(bytes_[at_]); ++at_)
      if (bytes_[at_] == '\'' || bytes_[at_] == '"' || bytes_.substr(at_, 2) == "/*") break;
    return bytes_.substr(begin, at_ - begin);
  }
  static long number_of(std::string_view digits) {
    long out = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), out);
    return out;
  }

  // No reference, enumeration or omission: a number, or a keyword before its parameters.
  bool is_bad(std::string_view word) {
    constexpr double kInfinite = 1e101;
    const char c = word[0];
    if (c == '#' || c == '$' || c == '*' || (c == '.' && word.back() == '.')) return false;
    const bool sign = c == '+';
    double x = 0;
    const auto [end, failure] = std::from_chars(word.data() + sign, word.data() + word.size(), x);
    if (failure == std::errc::result_out_of_range) return word.find("E-") == std::string_view::npos;
    if (failure == std::errc() && end == word.data() + word.size()) return !(std::fabs(x) < kInfinite);
    const bool keyword = c == '!' || c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (!keyword) return true;
    return !skip_to_word() || bytes_[at_] != '(';
  }

  const std::string_view bytes_;
  std::size_t at_ = 0;
  long line_ = 1;
  BadNumbers out_;
};

}  // namespace

BadNumbers bad_step_numbers(std::string_view bytes) { return Scanner(bytes).scan(); }

}  // namespace patchproof::occt
