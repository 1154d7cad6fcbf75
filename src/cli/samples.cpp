// SPDX-License-Identifier: Apache-2.0
#include "cli/samples.h"

#include <fmt/format.h>

#include <algorithm>

namespace patchproof::cli {

NumberText split_numbers(std::string name, std::string text) {
  NumberText out{std::make_unique<std::string>(std::move(text)), {std::move(name), {}}, {}};
  out.file.bytes = *out.bytes;
  const auto separates = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; };
  for (std::string_view rest = out.file.bytes; !rest.empty();) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> words;
    while (true) {
      int commas = 0;
      for (; !line.empty() && separates(line.front()); line.remove_prefix(1)) commas += line.front() == ',';
      // An empty field is a word that no number is.
      if (commas > 1 || (commas == 1 && (words.empty() || line.empty()))) words.push_back(line.substr(0, 0));
      if (line.empty()) break;
      const auto end = std::find_if(line.begin(), line.end(), separates);
      words.push_back(line.substr(0, static_cast<std::size_t>(end - line.begin())));
      line.remove_prefix(words.back().size());
    }
    if (!words.empty()) out.lines.push_back(std::move(words));
  }
  return out;
}

Result<NumberText> load_numbers(const std::string& path) {
  Result<std::string> bytes = load_file(path);
  if (!bytes) return bytes.error();
  return split_numbers(path, std::move(*bytes));
}

bool mentions_root(const NumberText& text) {
  for (const auto& line : text.lines)
    for (const std::string_view word : line)
      if (patchproof::mentions_root(word)) return true;
  return false;
}

template <ExactField T>
Result<T> read_number(const NumberText& text, std::string_view word, Decimals decimals, int& root) {
  Result<T> x = parse_scalar<T>(word, decimals);
  if (!x) return text.file.error(x.error().code, word, x.error().message, word);
  if constexpr (std::same_as<T, Quadratic>) {
    const int own = x->root();
    if (own != 1 && root != 1 && own != root)
      return text.file.error(ErrorCode::mixed_roots, word,
                             "a square root of " + std::to_string(own) + " beside one of " + std::to_string(root),
                             word);
    if (own != 1) root = own;
  }
  return x;
}
template Result<Rational> read_number<Rational>(const NumberText&, std::string_view, Decimals, int&);
template Result<Quadratic> read_number<Quadratic>(const NumberText&, std::string_view, Decimals, int&);

template <ExactField T>
Result<Samples<T>> read_samples(const NumberText& text, const SampleForm& form, Decimals decimals, int& root) {
  const std::size_t before = form.parameter_first ? 1 : 0, behind = form.weight_last ? 1 : 0;
  if (text.lines.empty()) return Error{ErrorCode::empty_input, text.file.path, "holds no samples", ""};
  const std::size_t words = text.lines.front().size();
  Samples<T> out;
  out.dimension = static_cast<int>(words) - static_cast<int>(before + behind);
  if (out.dimension < 1 || out.dimension > 3)
    return text.file.error(ErrorCode::wrong_count, text.lines.front().front(),
                           fmt::format("a sample has one, two or three coordinates{}{}",
                                       before ? " behind its parameter" : "", behind ? " before its weight" : ""),
                           std::to_string(words) + " numbers");
  for (const auto& line : text.lines) {
    if (line.size() != words)
      return text.file.error(ErrorCode::wrong_count, line.front(),
                             fmt::format("{} numbers as on the lines before", words), std::to_string(line.size()));
    std::vector<T> numbers;
    for (const std::string_view word : line) {
      Result<T> x = read_number<T>(text, word, decimals, root);
      if (!x) return x.error();
      numbers.push_back(std::move(*x));
    }
    if (before) out.data.parameters.push_back(numbers.front());
    if (behind) out.data.weights.push_back(numbers.back());
    Vec<T, 3> point;
    for (int c = 0; c < out.dimension; ++c) point[out.dimension == 1 ? 1 : c] = numbers[before + c];
    out.data.points.push_back(std::move(point));
  }
  return out;
}
template Result<Samples<Rational>> read_samples<Rational>(const NumberText&, const SampleForm&, Decimals, int&);
template Result<Samples<Quadratic>> read_samples<Quadratic>(const NumberText&, const SampleForm&, Decimals, int&);

}  // namespace patchproof::cli
