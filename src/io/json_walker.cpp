// SPDX-License-Identifier: Apache-2.0
#include "json_walker.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace patchproof {
namespace {

// Reads through a position that the walker sees, so that places can be named.
struct WatchedIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char** at;
  reference operator*() const { return **at; }
  WatchedIterator& operator++() {
    ++*at;
    return *this;
  }
  bool operator==(const WatchedIterator& other) const { return *at == *other.at; }
};

const char* to_string(JsonType type) {
  switch (type) {
    case JsonType::object: return "an object";
    case JsonType::array: return "an array";
    case JsonType::string: return "a string";
    case JsonType::number: return "a number, or a string that holds one,";
    case JsonType::integer: return "a whole number";
    case JsonType::boolean: return "true or false";
    case JsonType::ignored: return "anything";
  }
  return "";
}

std::string escaped(std::string_view key) {  // RFC 6901
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

bool is_number_char(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

// Levenshtein's distance, for "did you mean".
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

JsonWalker::JsonWalker(const SourceFile& source, std::span<const JsonRule> rules, UnknownKeys unknown,
                       JsonVisitor& visitor)
    : source_(source), rules_(rules), unknown_(unknown), visitor_(visitor), position_(source.bytes.data()) {
  PATCHPROOF_REQUIRES(rules.size() <= kMaxRules, "JsonWalker: too many rules");
}

std::string JsonWalker::pointer() const {
  std::string out;
  for (const Frame& frame : frames_) {
    if (frame.rule->type == JsonType::array)
      out += fmt::format("/{}", frame.index);
    else if (!frame.key.empty())
      out += "/" + escaped(frame.key);
  }
  return out.empty() ? "/" : out;
}

std::string_view JsonWalker::here() const {
  // The parser is one character ahead after a number.
  const std::size_t used = static_cast<std::size_t>(position_ - source_.bytes.data());
  return source_.bytes.substr(used > 0 ? used - 1 : 0, 0);
}

Error JsonWalker::error(ErrorCode code, std::string message, std::string_view values) const {
  return source_.error(code, here(), std::move(message), values, pointer());
}

bool JsonWalker::fail(Error error) {
  error_ = std::move(error);
  return false;
}

const JsonRule* JsonWalker::find(int parent, std::string_view key) const {
  for (const JsonRule& rule : rules_)
    if (rule.parent == parent && rule.key == key) return &rule;
  return nullptr;
}

const JsonRule* JsonWalker::expected() const { return frames_.empty() ? find(kNoParent, "") : frames_.back().element; }

const JsonRule* JsonWalker::accepting(const JsonRule* first, JsonType found, std::string_view text) const {
  const auto takes = [&](JsonType type) {
    return type == found || (type == JsonType::number && found == JsonType::string) ||
           (type == JsonType::integer && found == JsonType::number && text.find_first_of(".eE") == text.npos);
  };
  const JsonRule* const end = rules_.data() + rules_.size();
  for (const JsonRule* rule = first; rule != end && rule->parent == first->parent && rule->key == first->key; ++rule)
    if (takes(rule->type)) return rule;
  return nullptr;
}

// "an object or an array"
std::string JsonWalker::expectation(const JsonRule* first) const {
  std::string out = to_string(first->type);
  const JsonRule* const end = rules_.data() + rules_.size();
  for (const JsonRule* rule = first + 1; rule < end && rule->parent == first->parent && rule->key == first->key; ++rule)
    out += std::string(" or ") + to_string(rule->type);
  return out;
}

void JsonWalker::value_done() {
  if (frames_.empty()) return;
  if (frames_.back().rule->type == JsonType::array)
    ++frames_.back().index;
  else
    frames_.back().key.clear();
}

bool JsonWalker::scalar(JsonType found, std::string_view text, const char* name) {
  if (skipped_depth_ > 0) return true;
  const JsonRule* first = expected();
  if (first != nullptr && first->type != JsonType::ignored) {
    const JsonRule* rule = accepting(first, found, text);
    if (rule == nullptr)
      return fail(
          error(ErrorCode::syntax, fmt::format("{} should stand here, not {}", expectation(first), name), text));
    error_ = visitor_.leaf(rule->node, text, *this);
    if (error_) return false;
  }
  value_done();
  return true;
}

bool JsonWalker::open(JsonType found, const char* name) {
  if (skipped_depth_ > 0) return ++skipped_depth_, true;
  const JsonRule* first = expected();
  if (first == nullptr || first->type == JsonType::ignored) return skipped_depth_ = 1, true;
  const JsonRule* rule = accepting(first, found);
  if (rule == nullptr)
    return fail(error(ErrorCode::syntax, fmt::format("{} should stand here, not {}", expectation(first), name)));
  error_ = visitor_.begin(rule->node, *this);
  if (error_) return false;
  Frame frame{rule, nullptr};
  if (found == JsonType::array) frame.element = find(rule->node, "");
  frames_.push_back(std::move(frame));
  return true;
}

bool JsonWalker::close() {
  if (skipped_depth_ > 0) {
    if (--skipped_depth_ == 0) value_done();
    return true;
  }
  const Frame frame = std::move(frames_.back());
  frames_.pop_back();
  if (frame.rule->type == JsonType::object)
    for (std::size_t i = 0; i < rules_.size(); ++i)
      if (rules_[i].parent == frame.rule->node && rules_[i].required && !frame.seen[i])
        return fail(error(ErrorCode::syntax, fmt::format("the key \"{}\" is missing", rules_[i].key)));
  error_ = visitor_.end(frame.rule->node, *this);
  if (error_) return false;
  value_done();
  return true;
}

// The number that ends just before the character which the parser has read ahead. The bytes of the file are better than
// what the parser hands over: that carries the decimal point of the locale, and integers not at all.
std::string_view JsonWalker::number_text() const {
  const char* const begin = source_.bytes.data();
  const char* end = position_;
  if (end != begin && !is_number_char(end[-1])) --end;
  const char* first = end;
  while (first != begin && is_number_char(first[-1])) --first;
  return std::string_view(first, static_cast<std::size_t>(end - first));
}

// The letters, digits and signs around the place where the parser stopped, or the one character that stands there.
std::string_view JsonWalker::word_here() const {
  const auto belongs = [](char c) {
    return is_number_char(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '/';
  };
  const char* const begin = source_.bytes.data();
  const char* const end = begin + source_.bytes.size();
  const char* first = position_ == begin ? position_ : position_ - 1;
  const char* last = first;
  while (first != begin && belongs(first[-1])) --first;
  while (last != end && belongs(*last)) ++last;
  if (first == last && last != end) ++last;
  return std::string_view(first, static_cast<std::size_t>(last - first));
}

bool JsonWalker::number() { return scalar(JsonType::number, number_text(), "a number"); }

bool JsonWalker::string(const std::string& value) {
  // A number inside a string is handed over as a view into the file, too, unless escapes make the two differ.
  const JsonRule* first = skipped_depth_ > 0 ? nullptr : expected();
  const JsonRule* rule = first == nullptr ? nullptr : accepting(first, JsonType::string);
  if (rule == nullptr || rule->type != JsonType::number) return scalar(JsonType::string, value, "a string");
  const std::size_t end = static_cast<std::size_t>(position_ - source_.bytes.data()) - 1;  // the closing quote
  const std::size_t begin = source_.bytes.rfind('"', end - 1) + 1;
  const std::string_view written = source_.bytes.substr(begin, end - begin);
  return scalar(JsonType::string, written == value ? written : rewritten_.emplace_back(value), "a string");
}

bool JsonWalker::enter_key(const std::string& name) {
  if (skipped_depth_ > 0) return true;
  Frame& frame = frames_.back();
  frame.key = name;
  frame.element = find(frame.rule->node, name);
  if (frame.element == nullptr || name.empty()) {
    if (unknown_ == UnknownKeys::skipped) return frame.element = nullptr, true;
    const JsonRule* closest = nullptr;
    for (const JsonRule& rule : rules_)
      if (rule.parent == frame.rule->node && name.size() < 64 && distance(rule.key, name) <= 2 &&
          (closest == nullptr || distance(rule.key, name) < distance(closest->key, name)))
        closest = &rule;
    const std::string hint = closest == nullptr ? "" : fmt::format("; did you mean \"{}\"?", closest->key);
    return fail(error(ErrorCode::syntax, "this key is not known" + hint, name));
  }
  const std::size_t bit = static_cast<std::size_t>(frame.element - rules_.data());
  if (frame.seen[bit]) return fail(error(ErrorCode::syntax, "this key stands twice in one object", name));
  frame.seen.set(bit);
  return true;
}

bool JsonWalker::parse_error(int id, std::string message) {
  constexpr int kOutOfRange = 406;  // a number beyond the doubles
  if (id == kOutOfRange) return fail(error(ErrorCode::bad_number, "a number beyond the largest double", number_text()));
  if (const std::size_t column = message.find("column "); column != std::string::npos)
    if (const std::size_t colon = message.find(": ", column); colon != std::string::npos) message.erase(0, colon + 2);
  message.erase(std::min(message.size(), message.find("; last read")));  // everything read so far, at worst
  const std::string_view word = word_here();
  const bool at_end = position_ == source_.bytes.data() + source_.bytes.size();
  const std::string_view number_begins = "0123456789+-.nNiI";  // nan and inf, too
  if (!at_end && !word.empty() && number_begins.find(word.front()) != std::string_view::npos)
    return fail(error(ErrorCode::bad_number, "not a number", word));
  return fail(error(ErrorCode::syntax, message, word));
}

// nlohmann-json's SAX interface.
struct JsonEvents {
  using Json = nlohmann::json;
  JsonWalker& walker;

  bool null() { return walker.scalar(JsonType::ignored, "null", "null"); }
  bool boolean(bool value) { return walker.scalar(JsonType::boolean, value ? "true" : "false", "true or false"); }
  bool number_integer(Json::number_integer_t) { return walker.number(); }
  bool number_unsigned(Json::number_unsigned_t) { return walker.number(); }
  bool number_float(Json::number_float_t, const std::string&) { return walker.number(); }
  bool string(std::string& value) { return walker.string(value); }
  bool binary(Json::binary_t&) { return false; }  // not in JSON texts
  bool start_object(std::size_t) { return walker.open(JsonType::object, "an object"); }
  bool key(std::string& name) { return walker.enter_key(name); }
  bool end_object() { return walker.close(); }
  bool start_array(std::size_t) { return walker.open(JsonType::array, "an array"); }
  bool end_array() { return walker.close(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception& reason) {
    return walker.parse_error(reason.id, reason.what());
  }
};

std::optional<Error> JsonWalker::walk() {
  const char* end = source_.bytes.data() + source_.bytes.size();
  JsonEvents events{*this};
  const bool complete = nlohmann::json::sax_parse(WatchedIterator{&position_}, WatchedIterator{&end}, &events);
  if (!complete && !error_) error_ = error(ErrorCode::syntax, "this is not well-formed JSON");
  return error_;
}

}  // namespace patchproof
