// SPDX-License-Identifier: Apache-2.0
// Walks through a JSON file along a table of rules: which keys an object has, what an array holds. No tree is built, depth
// costs no stack, and numbers are handed over as they are written.
#pragma once

#include <bitset>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "source_file.h"

namespace patchproof {

enum class JsonType {
  object,
  array,
  string,
  number,   // a JSON number, or a string that holds one
  integer,  // a JSON number without fraction and exponent
  boolean,
  ignored,  // anything, skipped
};

// The value under `key` of the object `parent` (or an element of the array `parent`, key "") is the node `node`. A node may
// stand under several keys and parents. Rules with the same parent and key, one after another, are alternatives of
// different types; the first of them says whether the key is required. The root's parent is kNoParent.
inline constexpr int kNoParent = -1;
struct JsonRule {
  int parent;
  std::string_view key;
  int node;
  JsonType type;
  bool required = false;
};

inline constexpr std::size_t kMaxRules = 160;

enum class UnknownKeys { refused, skipped };

class JsonWalker;

// What a format does with the nodes. A returned error ends the walk.
class JsonVisitor {
 public:
  virtual ~JsonVisitor() = default;
  virtual std::optional<Error> begin(int, const JsonWalker&) { return std::nullopt; }
  virtual std::optional<Error> end(int, const JsonWalker&) { return std::nullopt; }
  // A string's content, or a number's or boolean's text.
  virtual std::optional<Error> leaf(int, std::string_view, const JsonWalker&) { return std::nullopt; }
};

class JsonWalker {
 public:
  JsonWalker(const SourceFile& source, std::span<const JsonRule> rules, UnknownKeys unknown, JsonVisitor& visitor);
  std::optional<Error> walk();

  // Of the value being handled: "/patches/3/knots/0".
  std::string pointer() const;
  // In an object: the key under which that value stands. REQUIRES not to be called for the root.
  const std::string& key() const { return frames_.back().key; }
  // Just before the place up to which the file has been read.
  std::string_view here() const;
  Error error(ErrorCode code, std::string message, std::string_view values = {}) const;

 private:
  friend struct JsonEvents;  // the parser's SAX interface, in json_walker.cpp
  struct Frame {
    const JsonRule* rule;     // of the object or array itself
    const JsonRule* element;  // the first for the array's elements or the current key's value; nullptr: skipped
    std::bitset<kMaxRules> seen = {};  // object: the keys so far, by their place in the table
    std::size_t index = 0;             // array
    std::string key = {};              // object
  };
  const JsonRule* find(int parent, std::string_view key) const;
  const JsonRule* expected() const;
  // The one of `first` and its alternatives that takes a value of this type; nullptr when there is none.
  const JsonRule* accepting(const JsonRule* first, JsonType found, std::string_view text = {}) const;
  std::string expectation(const JsonRule* first) const;
  bool fail(Error error);
  bool scalar(JsonType found, std::string_view text, const char* name);
  bool open(JsonType found, const char* name);
  bool close();
  bool enter_key(const std::string& name);
  bool number();
  bool string(const std::string& value);
  bool parse_error(int id, std::string message);
  void value_done();
  std::string_view number_text() const;
  std::string_view word_here() const;

  const SourceFile& source_;
  std::span<const JsonRule> rules_;
  UnknownKeys unknown_;
  JsonVisitor& visitor_;
  const char* position_;
  std::vector<Frame> frames_;
  std::size_t skipped_depth_ = 0;      // inside a skipped object or array
  std::deque<std::string> rewritten_;  // numbers in strings that were written with escapes, such as "1\/3"
  std::optional<Error> error_;
};

}  // namespace patchproof
