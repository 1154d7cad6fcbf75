// SPDX-License-Identifier: Apache-2.0
// Walks through the tokens of a text file, or through its lines. Shared by the Newell, .bpt, .bez and .g2 readers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "source_file.h"

namespace patchproof {

class TextCursor {
 public:
  enum class Comments { none, hash };  // hash: from # to the end of the line
  TextCursor(const SourceFile& source, Comments comments) : source_(source), hash_(comments == Comments::hash) {}

  // The next word between blanks and line ends; empty at the end of the file.
  std::string_view next();
  // The next line with something on it, trimmed; empty at the end of the file.
  std::string_view next_line();
  bool at_end();
  // The last token or line read, or the begin of the file: where a file that ends too early is said to end.
  std::string_view last() const { return last_.data() ? last_ : source_.bytes.substr(0, 0); }

  // The next token as a whole number. ERRORS syntax, `what` says what should stand there.
  Result<long> integer(std::string_view what);
  // Appends `count` tokens; false when the file ends before.
  bool take(std::size_t count, std::vector<std::string_view>& tokens);
  Error ended(ErrorCode code, std::string message, std::string_view values = {}) const;

  const SourceFile& source() const { return source_; }

 private:
  void skip_blanks();

  const SourceFile& source_;
  bool hash_;
  std::size_t position_ = 0;
  std::string_view last_;
};

// The whole text as a whole number.
std::optional<long> to_integer(std::string_view text);
// The parts of a line between commas, trimmed; an empty part stays an empty part.
std::vector<std::string_view> split_at_commas(std::string_view line);

}  // namespace patchproof
