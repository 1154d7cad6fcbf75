// SPDX-License-Identifier: Apache-2.0
// .bpt and .bez: a number of Bézier patches, then the points of each, along growing v first. A .bpt patch begins with its
// two degrees; a .bez patch is bicubic. Both may carry # comments.
#include <fmt/format.h>

#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

std::optional<Error> read_patches(const SourceFile& source, ModelSink& sink, bool with_degrees) {
  TextCursor cursor(source, TextCursor::Comments::hash);
  const Result<long> patches = cursor.integer("the number of patches");
  if (!patches) return patches.error();
  const std::string_view header = cursor.last();
  if (*patches < 1)
    return source.error(ErrorCode::wrong_count, header, "the number of patches is not positive", header);

  RawSpline patch;
  for (long p = 0; p < *patches; ++p) {
    if (cursor.at_end())
      return source.error(ErrorCode::wrong_count, header,
                          fmt::format("{} patches are announced but the file ends after {}", *patches, p), header);
    patch.degree = {3, 3};
    if (with_degrees)
      for (int d = 0; d < 2; ++d) {
        const Result<long> degree = cursor.integer(d == 0 ? "the degree along u" : "the degree along v");
        if (!degree) return degree.error();
        if (d == 0) patch.at = cursor.last();
        if (*degree < 1 || *degree > kMaxDegree)
          return source.error(ErrorCode::bad_degree, cursor.last(),
                              fmt::format("the degree is not in 1 … {}", kMaxDegree), cursor.last());
        patch.degree[d] = *degree;
      }
    patch.count = {patch.degree[0] + 1, patch.degree[1] + 1};
    patch.coordinates.clear();
    const std::size_t needed = 3 * static_cast<std::size_t>(patch.count[0] * patch.count[1]);
    if (!cursor.take(needed, patch.coordinates)) {
      if (auto error = sink.first_bad_number(patch)) return error;
      return cursor.ended(ErrorCode::syntax, fmt::format("the file ends inside patch {} of {}", p + 1, *patches),
                          fmt::format("{} of {} coordinates", patch.coordinates.size(), needed));
    }
    if (!with_degrees) patch.at = patch.coordinates.front();
    if (auto error = sink.add(patch)) return error;
  }
  if (!cursor.at_end()) {
    const std::string_view token = cursor.next();
    return source.error(ErrorCode::wrong_count, token,
                        fmt::format("text after the last of the {} patches that are announced", *patches), token);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Error> read_bpt(const SourceFile& source, ModelSink& sink) { return read_patches(source, sink, true); }
std::optional<Error> read_bez(const SourceFile& source, ModelSink& sink) { return read_patches(source, sink, false); }

}  // namespace patchproof
