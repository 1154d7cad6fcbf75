// SPDX-License-Identifier: Apache-2.0
// Numbers in plain text: one sample on each line, blanks or commas between its numbers, '#' before a comment.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/source_file.h"
#include "patchproof/error.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/least_squares.h"

namespace patchproof::cli {

// The words of a text, as views into its bytes. Lines without words are left out.
struct NumberText {
  std::unique_ptr<std::string> bytes;  // stays where it is when this is moved
  SourceFile file;
  std::vector<std::vector<std::string_view>> lines;
};

Result<NumberText> load_numbers(const std::string& path);
// A list given on the command line; `name` stands for the file in errors.
NumberText split_numbers(std::string name, std::string text);

bool mentions_root(const NumberText& text);

// ERRORS bad_number, with the line.  mixed_roots: different roots in `root` and here; root is 1 as long as there is none.
template <ExactField T>
Result<T> read_number(const NumberText& text, std::string_view word, Decimals decimals, int& root);

// Points in three coordinates, those not given 0. A single number is a value: it stands in y, for a graph over the parameter.
template <ExactField T>
struct Samples {
  int dimension = 0;
  CurveSamples<T, 3> data;
};
// What a line holds beside the coordinates.
struct SampleForm {
  bool parameter_first, weight_last;
};

// ERRORS empty_input; wrong_count: not one to three coordinates, or another number than on the first line; as read_number.
template <ExactField T>
Result<Samples<T>> read_samples(const NumberText& text, const SampleForm& form, Decimals decimals, int& root);

}  // namespace patchproof::cli
