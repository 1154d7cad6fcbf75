// SPDX-License-Identifier: Apache-2.0
// Bad input and the error that it must give: its code, its place, and the values exactly as read.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "patchproof/io/read.h"

namespace patchproof::test {

struct Bad {
  std::string what, path, bytes;
  ErrorCode code;
  std::string where, values;
};

inline void expect_error(const Bad& bad, const Result<ModelFile>& file) {
  SCOPED_TRACE(bad.what);
  ASSERT_FALSE(file) << "was read";
  const Error& error = file.error();
  EXPECT_EQ(to_string(error.code), std::string(to_string(bad.code))) << error.text();
  EXPECT_EQ(error.where, bad.where) << error.text();
  EXPECT_EQ(error.values, bad.values) << error.text();
  EXPECT_FALSE(error.message.empty());
}

inline void expect_errors(const std::vector<Bad>& all) {
  for (const Bad& bad : all) expect_error(bad, read_model_text(bad.bytes, bad.path));
}

}  // namespace patchproof::test
