// SPDX-License-Identifier: Apache-2.0
// The JSON of tinyspline: one curve, its coordinates in one list.
#include "json_walker.h"
#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node { kRoot, kDegree, kDimension, kCoordinates, kCoordinate, kKnots, kKnot };

constexpr JsonRule kRules[] = {
    {kNoParent, "", kRoot, JsonType::object},
    {kRoot, "degree", kDegree, JsonType::integer, true},
    {kRoot, "dimension", kDimension, JsonType::integer, true},
    {kRoot, "control_points", kCoordinates, JsonType::array, true},
    {kCoordinates, "", kCoordinate, JsonType::number},
    {kRoot, "knots", kKnots, JsonType::array, true},
    {kKnots, "", kKnot, JsonType::number},
};

class TinysplineVisitor final : public JsonVisitor {
 public:
  explicit TinysplineVisitor(ModelSink& sink) : sink_(sink) {
    curve_.directions = 1;
    curve_.has_knots = true;
    curve_.layout = JsonLayout::tinyspline;
  }

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    if (node == kRoot) curve_.at = walker.here();
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    if (node == kCoordinate) curve_.coordinates.push_back(text);
    if (node == kKnot) curve_.knots[0].push_back(text);
    if (node == kDegree) return integer(text, walker, curve_.degree[0]);
    if (node != kDimension) return std::nullopt;
    long dimension = 0;
    if (auto error = integer(text, walker, dimension)) return error;
    if (dimension != 2 && dimension != 3)
      return walker.error(ErrorCode::unsupported, "only curves of dimension 2 and 3 are read", text);
    curve_.per_point = static_cast<int>(dimension);
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker&) override {
    if (node != kRoot) return std::nullopt;
    // A rest that makes no point is found where coordinates are counted.
    curve_.count = {static_cast<long>(curve_.coordinates.size()) / curve_.per_point, 1};
    return sink_.add(curve_);
  }

 private:
  static std::optional<Error> integer(std::string_view text, const JsonWalker& walker, long& value) {
    const std::optional<long> read = to_integer(text);
    if (!read) return walker.error(ErrorCode::syntax, "a whole number of moderate size should stand here", text);
    value = *read;
    return std::nullopt;
  }

  ModelSink& sink_;
  RawSpline curve_;
};

}  // namespace

std::optional<Error> read_tinyspline(const SourceFile& source, ModelSink& sink) {
  TinysplineVisitor visitor(sink);
  return JsonWalker(source, kRules, UnknownKeys::skipped, visitor).walk();
}

}  // namespace patchproof
