// SPDX-License-Identifier: Apache-2.0
// The JSON of geomdl (NURBS-Python): surfaces with the points along growing v first; weights stand apart and are not
// multiplied into the points. Sampling and display settings (delta, …) are skipped.
#include <fmt/format.h>

#include "json_walker.h"
#include "raw_patch.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node {
  kRoot,
  kShape,
  kShapeType,
  kCount,
  kData,
  kSurface,
  kSurfaceType,
  kRational,
  kDimension,
  kDegreeU,
  kDegreeV,
  kKnotsU,
  kKnotsV,
  kKnotU,
  kKnotV,
  kSizeU,
  kSizeV,
  kNet,
  kPoints,
  kPoint,
  kCoordinate,
  kWeights,
  kWeight,
  kTrims,
  kName,
};

constexpr JsonRule kRules[] = {
    {kNoParent, "", kRoot, JsonType::object},
    {kRoot, "shape", kShape, JsonType::object, true},
    {kShape, "type", kShapeType, JsonType::string, true},
    {kShape, "count", kCount, JsonType::integer},
    {kShape, "data", kData, JsonType::array, true},
    {kData, "", kSurface, JsonType::object},
    {kSurface, "type", kSurfaceType, JsonType::string},
    {kSurface, "name", kName, JsonType::string},
    {kSurface, "rational", kRational, JsonType::boolean, true},
    {kSurface, "dimension", kDimension, JsonType::integer},
    {kSurface, "degree_u", kDegreeU, JsonType::integer, true},
    {kSurface, "degree_v", kDegreeV, JsonType::integer, true},
    {kSurface, "knotvector_u", kKnotsU, JsonType::array, true},
    {kSurface, "knotvector_v", kKnotsV, JsonType::array, true},
    {kKnotsU, "", kKnotU, JsonType::number},
    {kKnotsV, "", kKnotV, JsonType::number},
    {kSurface, "size_u", kSizeU, JsonType::integer, true},
    {kSurface, "size_v", kSizeV, JsonType::integer, true},
    {kSurface, "control_points", kNet, JsonType::object, true},
    {kSurface, "trims", kTrims, JsonType::object},
    {kNet, "points", kPoints, JsonType::array, true},
    {kPoints, "", kPoint, JsonType::array},
    {kPoint, "", kCoordinate, JsonType::number},
    {kNet, "weights", kWeights, JsonType::array},
    {kWeights, "", kWeight, JsonType::number},
};

class GeomdlVisitor final : public JsonVisitor {
 public:
  explicit GeomdlVisitor(ModelSink& sink) : sink_(sink) {}

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    if (node == kSurface) {
      patch_ = RawPatch{};
      patch_.layout = JsonLayout::geomdl;
      patch_.pointer = walker.pointer();
      patch_.at = walker.here();
      patch_.has_knots = true;
      points_ = 0;
      dimension_ = -1;
    } else if (node == kPoint) {
      components_ = 0;
    } else if (node == kTrims) {
      return walker.error(ErrorCode::unsupported, "a trimmed surface is not read");
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    if (node == kPoint) {
      if (points_ == 0) patch_.per_point = static_cast<int>(components_);
      if (components_ != patch_.per_point || (components_ != 2 && components_ != 3))
        return walker.error(ErrorCode::wrong_count, "all points have 2 numbers, or all have 3",
                            std::to_string(components_));
      ++points_;
    } else if (node == kSurface) {
      return finish_surface(walker);
    } else if (node == kShape) {
      const long found = static_cast<long>(sink_.patch_count());
      if (found == 0) return walker.error(ErrorCode::wrong_count, "the file holds no surfaces");
      if (count_ && *count_ != found)
        return walker.error(ErrorCode::wrong_count, fmt::format("{} surfaces are announced", *count_),
                            std::to_string(found));
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    switch (node) {
      case kShapeType:
        if (text != "surface")
          return walker.error(ErrorCode::unsupported, "only shapes of type \"surface\" are read", text);
        break;
      case kSurfaceType:
        if (text != "spline")
          return walker.error(ErrorCode::unsupported, "only surfaces of type \"spline\" are read", text);
        break;
      case kName: patch_.name = text; break;
      case kRational: patch_.weight_form = text == "true" ? Weights::separate : Weights::none; break;
      case kCount: return integer(text, walker, count_.emplace());
      case kDimension: return integer(text, walker, dimension_);
      case kDegreeU: return integer(text, walker, patch_.degree[0]);
      case kDegreeV: return integer(text, walker, patch_.degree[1]);
      case kSizeU: return integer(text, walker, patch_.count[0]);
      case kSizeV: return integer(text, walker, patch_.count[1]);
      case kKnotU: patch_.knots[0].push_back(text); break;
      case kKnotV: patch_.knots[1].push_back(text); break;
      case kCoordinate: ++components_, patch_.coordinates.push_back(text); break;
      case kWeight: patch_.weights.push_back(text); break;
      default: break;
    }
    return std::nullopt;
  }

 private:
  static std::optional<Error> integer(std::string_view text, const JsonWalker& walker, long& value) {
    const std::optional<long> read = to_integer(text);
    if (!read) return walker.error(ErrorCode::syntax, "a whole number of moderate size should stand here", text);
    value = *read;
    return std::nullopt;
  }

  std::optional<Error> finish_surface(const JsonWalker& walker) {
    if (dimension_ >= 0 && dimension_ != patch_.per_point)
      return walker.error(ErrorCode::wrong_count, fmt::format("the dimension is said to be {}", dimension_),
                          fmt::format("points of {} numbers", patch_.per_point));
    if (patch_.weight_form == Weights::none && !patch_.weights.empty())
      return walker.error(ErrorCode::syntax, "weights in a surface that is said not to be rational");
    return sink_.add(patch_);
  }

  ModelSink& sink_;
  RawPatch patch_;
  long points_ = 0, components_ = 0, dimension_ = -1;
  std::optional<long> count_;
};

}  // namespace

std::optional<Error> read_geomdl(const SourceFile& source, ModelSink& sink) {
  GeomdlVisitor visitor(sink);
  return JsonWalker(source, kRules, UnknownKeys::skipped, visitor).walk();
}

}  // namespace patchproof
