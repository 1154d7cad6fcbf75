// SPDX-License-Identifier: Apache-2.0
// The bytes of one input file and the names of places in them. Readers keep texts as views into these bytes, so a line is
// counted only when an error needs it.
#pragma once

#include <string>
#include <string_view>

#include "patchproof/error.h"

namespace patchproof {

struct SourceFile {
  std::string path;
  std::string_view bytes;

  // 1-based; 0 when `part` is no view into the bytes. COST linear in the file.
  long line_of(std::string_view part) const;
  // "teapot.bpt:12", or "model.json:12 at /patches/3" when there is a JSON pointer; `at` is a view into the bytes.
  std::string place(std::string_view at, std::string_view pointer = {}) const;
  // Values longer than a few lines are cut in the middle; control characters are spelt \xNN.
  Error error(ErrorCode code, std::string_view at, std::string message, std::string_view values = {},
              std::string_view pointer = {}) const;
};

// The content of a regular file. ERRORS cannot_open, unsupported (larger than kMaxFileBytes).
inline constexpr long long kMaxFileBytes = 1LL << 30;
Result<std::string> load_file(const std::string& path);

// Do these bytes begin a STEP, IGES or BREP file?
bool begins_cad_file(std::string_view bytes);

// 64 lower-case hexadecimal digits.
std::string sha256_of(std::string_view bytes);

}  // namespace patchproof
