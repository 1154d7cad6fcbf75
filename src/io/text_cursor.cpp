// SPDX-License-Identifier: Apache-2.0
#include "text_cursor.h"

#include <charconv>

#include <fmt/format.h>

namespace patchproof {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

void TextCursor::skip_blanks() {
  const std::string_view text = source_.bytes;
  while (position_ < text.size()) {
    if (is_blank(text[position_])) {
      ++position_;
    } else if (hash_ && text[position_] == '#') {
      while (position_ < text.size() && text[position_] != '\n') ++position_;
    } else {
      return;
    }
  }
}

std::string_view TextCursor::next() {
  skip_blanks();
  const std::string_view text = source_.bytes;
  const std::size_t begin = position_;
  while (position_ < text.size() && !is_blank(text[position_]) && !(hash_ && text[position_] == '#')) ++position_;
  if (begin == position_) return {};
  return last_ = text.substr(begin, position_ - begin);
}

std::string_view TextCursor::next_line() {
  skip_blanks();
  const std::string_view text = source_.bytes;
  const std::size_t begin = position_;
  while (position_ < text.size() && text[position_] != '\n' && !(hash_ && text[position_] == '#')) ++position_;
  if (begin == position_) return {};
  return last_ = trimmed(text.substr(begin, position_ - begin));
}

bool TextCursor::at_end() {
  skip_blanks();
  return position_ == source_.bytes.size();
}

Result<long> TextCursor::integer(std::string_view what) {
  const std::string_view token = next();
  if (token.empty()) return ended(ErrorCode::syntax, fmt::format("the file ends where {} should stand", what));
  if (const std::optional<long> value = to_integer(token)) return *value;
  return source_.error(ErrorCode::syntax, token, fmt::format("{} should be a whole number", what), token);
}

bool TextCursor::take(std::size_t count, std::vector<std::string_view>& tokens) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view token = next();
    if (token.empty()) return false;
    tokens.push_back(token);
  }
  return true;
}

Error TextCursor::ended(ErrorCode code, std::string message, std::string_view values) const {
  return source_.error(code, last(), std::move(message), values);
}

std::optional<long> to_integer(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  long value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split_at_commas(std::string_view line) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace patchproof
