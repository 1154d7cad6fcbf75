// SPDX-License-Identifier: Apache-2.0
// Our own JSON model (docs/formats.md, docs/model.schema.json). Curves and patches are delivered one by one as the file is
// walked through, so memory holds the finished ones and one that is not.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "json_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node {
  kRoot = kSplineNodes,
  kFormat,
  kVersion,
  kUnits,
  kCurves,
  kCurve,
  kPatches,
  kPatch,
  kJoins,
  kJoin,
  kSideA,
  kSideB,
  kSidePatch,
  kSideEdge,
  kReversed,
};

constexpr JsonRule kRules[] = {
    {kNoParent, "", kRoot, JsonType::object},
    {kRoot, "format", kFormat, JsonType::string, true},
    {kRoot, "version", kVersion, JsonType::integer, true},
    {kRoot, "units", kUnits, JsonType::string},
    {kRoot, "curves", kCurves, JsonType::array},
    {kRoot, "patches", kPatches, JsonType::array},
    {kRoot, "joins", kJoins, JsonType::array},
    {kCurves, "", kCurve, JsonType::object},
    {kCurve, "name", kName, JsonType::string},
    {kCurve, "degree", kDegree, JsonType::integer, true},
    {kCurve, "knots", kKnots, JsonType::array},
    {kCurve, "control_points", kRow, JsonType::array, true},
    {kCurve, "weights", kWeightRow, JsonType::array},
    {kCurve, "homogeneous", kHomogeneous, JsonType::boolean},
    {kPatches, "", kPatch, JsonType::object},
    {kPatch, "name", kName, JsonType::string},
    {kPatch, "degree", kDegrees, JsonType::array},
    {kPatch, "knots", kKnotVectors, JsonType::array},
    {kPatch, "control_points", kNet, JsonType::array},
    {kPatch, "weights", kWeightNet, JsonType::array},
    {kDegrees, "", kDegree, JsonType::integer},
    {kKnotVectors, "", kKnots, JsonType::array},
    {kKnots, "", kKnot, JsonType::number},
    {kNet, "", kRow, JsonType::array},
    {kRow, "", kPoint, JsonType::array},
    {kPoint, "", kCoordinate, JsonType::number},
    {kWeightNet, "", kWeightRow, JsonType::array},
    {kWeightRow, "", kWeight, JsonType::number},
    {kJoins, "", kJoin, JsonType::object},
    {kJoin, "a", kSideA, JsonType::object, true},
    {kJoin, "b", kSideB, JsonType::object, true},
    {kJoin, "reversed", kReversed, JsonType::boolean},
    {kSideA, "patch", kSidePatch, JsonType::integer, true},
    {kSideA, "edge", kSideEdge, JsonType::string, true},
    {kSideB, "patch", kSidePatch, JsonType::integer, true},
    {kSideB, "edge", kSideEdge, JsonType::string, true},
};

class ModelVisitor final : public JsonVisitor {
 public:
  ModelVisitor(const SourceFile& source, ModelSink& sink) : source_(source), sink_(sink) {}

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    if (node < kSplineNodes) return spline_.begin(node, walker);
    switch (node) {
      case kCurve: spline_.start(1, walker); break;
      case kPatch: spline_.start(2, walker); break;
      case kJoin: join_ = {}; break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    if (node < kSplineNodes) return spline_.end(node, walker);
    switch (node) {
      case kRoot: return finish(walker);
      case kCurve:
      case kPatch:
        if (std::optional<Error> error = spline_.finish(source_, walker)) return error;
        return sink_.add(spline_.raw());
      case kJoin: joins_.push_back(join_); break;
      case kSideA: join_.patch_a = side_patch_, join_.edge_a = side_edge_, check_later('a'); break;
      case kSideB: join_.patch_b = side_patch_, join_.edge_b = side_edge_, check_later('b'); break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    if (node < kSplineNodes) return spline_.leaf(node, text, walker);
    switch (node) {
      case kFormat:
        if (text != "patchproof-model")
          return walker.error(ErrorCode::unknown_format, "the format should be \"patchproof-model\"", text);
        break;
      case kVersion:
        if (text != "1") return walker.error(ErrorCode::unsupported, "only version 1 of the format is read", text);
        break;
      case kUnits: sink_.units = text; break;
      case kReversed: join_.reversed = text == "true"; break;
      case kSidePatch: {
        const std::optional<long> index = to_integer(text);
        if (!index || *index < 0 || *index > 0x7fffffff)
          return walker.error(ErrorCode::bad_reference, "patches are counted from 0", text);
        side_patch_ = static_cast<int>(*index);
        side_text_ = text;
        break;
      }
      case kSideEdge: {
        constexpr std::string_view kEdges[] = {"u_min", "u_max", "v_min", "v_max"};
        const auto found = std::find(std::begin(kEdges), std::end(kEdges), text);
        if (found == std::end(kEdges))
          return walker.error(ErrorCode::bad_reference, "an edge is u_min, u_max, v_min or v_max", text);
        side_edge_ = static_cast<EdgeName>(found - std::begin(kEdges));
        break;
      }
      default: break;
    }
    return std::nullopt;
  }

 private:
  // Joins may stand before the patches: the largest index is compared with their number at the end.
  void check_later(char side) {
    if (!largest_ || side_patch_ > largest_->patch) largest_ = Reference{side_patch_, side_text_, joins_.size(), side};
  }

  std::optional<Error> finish(const JsonWalker& walker) {
    const std::size_t patches = sink_.patch_count();
    if (patches == 0 && sink_.curve_count() == 0)
      return walker.error(ErrorCode::wrong_count, "the model has neither patches nor curves");
    if (largest_ && static_cast<std::size_t>(largest_->patch) >= patches)
      return source_.error(ErrorCode::bad_reference, largest_->text,
                           patches == 0 ? std::string("the model has no patches, only curves")
                                        : fmt::format("the model has patches 0 … {}", patches - 1),
                           largest_->text, fmt::format("/joins/{}/{}/patch", largest_->join, largest_->side));
    sink_.joins = std::move(joins_);
    return std::nullopt;
  }

  const SourceFile& source_;
  ModelSink& sink_;
  JsonSpline spline_;
  std::vector<DeclaredJoin> joins_;
  struct Reference {
    int patch;
    std::string_view text;
    std::size_t join;
    char side;
  };
  std::optional<Reference> largest_;
  DeclaredJoin join_{};
  int side_patch_ = 0;
  EdgeName side_edge_ = EdgeName::u_min;
  std::string_view side_text_;
};

}  // namespace

std::optional<Error> read_json_model(const SourceFile& source, ModelSink& sink) {
  ModelVisitor visitor(source, sink);
  return JsonWalker(source, kRules, UnknownKeys::refused, visitor).walk();
}

}  // namespace patchproof
