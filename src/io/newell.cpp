// SPDX-License-Identifier: Apache-2.0
// Newell's format, line by line: a number of bicubic patches, 16 vertex indices (from 1) for each, a number of vertices,
// x,y,z for each. The first four indices are the row at u = 0, along growing v.
#include <fmt/format.h>

#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

// A line with nothing but a count ≥ 1.
Result<long> count_line(TextCursor& cursor, std::string_view what) {
  const std::string_view line = cursor.next_line();
  if (line.empty())
    return cursor.ended(ErrorCode::syntax, fmt::format("the file ends where the number of {} should stand", what));
  const std::optional<long> count = to_integer(line);
  if (!count)
    return cursor.source().error(ErrorCode::syntax, line, fmt::format("the number of {} should stand here", what),
                                 line);
  if (*count < 1)
    return cursor.source().error(ErrorCode::wrong_count, line, fmt::format("the number of {} is not positive", what),
                                 line);
  return *count;
}

// `count` lines of `width` texts each, one after another.
Result<std::vector<std::string_view>> table(TextCursor& cursor, long count, std::size_t width, std::string_view what,
                                            std::string_view header) {
  std::vector<std::string_view> texts;
  for (long row = 0; row < count; ++row) {
    const std::string_view line = cursor.next_line();
    if (line.empty())
      return cursor.source().error(ErrorCode::wrong_count, header,
                                   fmt::format("{} {} are announced but the file ends after {}", count, what, row),
                                   header);
    const std::vector<std::string_view> parts = split_at_commas(line);
    if (parts.size() != width)
      return cursor.source().error(ErrorCode::wrong_count, line,
                                   fmt::format("{} numbers separated by commas should stand here", width), line);
    texts.insert(texts.end(), parts.begin(), parts.end());
  }
  return texts;
}

}  // namespace

std::optional<Error> read_newell(const SourceFile& source, ModelSink& sink) {
  TextCursor cursor(source, TextCursor::Comments::none);
  const Result<long> patches = count_line(cursor, "patches");
  if (!patches) return patches.error();
  const auto indices = table(cursor, *patches, 16, "patches", cursor.last());
  if (!indices) return indices.error();
  const Result<long> vertices = count_line(cursor, "vertices");
  if (!vertices) return vertices.error();
  const auto coordinates = table(cursor, *vertices, 3, "vertices", cursor.last());
  if (!coordinates) return coordinates.error();
  if (!cursor.at_end()) {
    const std::string_view line = cursor.next_line();
    return source.error(ErrorCode::wrong_count, line, fmt::format("text after the last of {} vertices", *vertices),
                        line);
  }

  RawSpline patch;
  patch.degree = {3, 3};
  patch.count = {4, 4};
  for (long p = 0; p < *patches; ++p) {
    patch.coordinates.clear();
    patch.at = (*indices)[16 * p];
    for (int k = 0; k < 16; ++k) {
      const std::string_view text = (*indices)[16 * p + k];
      const std::optional<long> index = to_integer(text);
      if (!index)
        return source.error(ErrorCode::syntax, text.empty() ? patch.at : text, "a vertex index should stand here",
                            text);
      if (*index < 1 || *index > *vertices)
        return source.error(ErrorCode::bad_reference, text, fmt::format("the file has vertices 1 … {}", *vertices),
                            text);
      const auto vertex = coordinates->begin() + 3 * (*index - 1);
      patch.coordinates.insert(patch.coordinates.end(), vertex, vertex + 3);
    }
    if (auto error = sink.add(patch)) return error;
  }
  return std::nullopt;
}

}  // namespace patchproof
