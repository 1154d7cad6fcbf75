// SPDX-License-Identifier: Apache-2.0
// Our own JSON model (docs/formats.md, docs/model.schema.json). Patches are delivered one by one as the file is walked
// through, so memory holds the finished patches and one unfinished patch.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "json_walker.h"
#include "raw_patch.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node {
  kRoot,
  kFormat,
  kVersion,
  kUnits,
  kPatches,
  kPatch,
  kName,
  kDegrees,
  kDegree,
  kKnots,
  kKnotVector,
  kKnot,
  kNet,
  kRow,
  kPoint,
  kCoordinate,
  kWeights,
  kWeightRow,
  kWeight,
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
    {kRoot, "patches", kPatches, JsonType::array, true},
    {kRoot, "joins", kJoins, JsonType::array},
    {kPatches, "", kPatch, JsonType::object},
    {kPatch, "name", kName, JsonType::string},
    {kPatch, "degree", kDegrees, JsonType::array, true},
    {kPatch, "knots", kKnots, JsonType::array},
    {kPatch, "control_points", kNet, JsonType::array, true},
    {kPatch, "weights", kWeights, JsonType::array},
    {kDegrees, "", kDegree, JsonType::integer},
    {kKnots, "", kKnotVector, JsonType::array},
    {kKnotVector, "", kKnot, JsonType::number},
    {kNet, "", kRow, JsonType::array},
    {kRow, "", kPoint, JsonType::array},
    {kPoint, "", kCoordinate, JsonType::number},
    {kWeights, "", kWeightRow, JsonType::array},
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

// How a nested array is filled: rows so far, entries of the row, entries of the first row.
struct Shape {
  long rows = 0, entries = 0, row_length = 0;
  bool row_fits() {
    if (rows++ == 0) row_length = entries;
    return entries == row_length;
  }
};

class ModelVisitor final : public JsonVisitor {
 public:
  ModelVisitor(const SourceFile& source, ModelSink& sink) : source_(source), sink_(sink) {}

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    switch (node) {
      case kPatch:
        patch_ = RawPatch{};
        patch_.layout = JsonLayout::model;
        patch_.pointer = walker.pointer();
        patch_.at = walker.here();
        net_ = weights_ = Shape{};
        degrees_ = knot_vectors_ = components_ = 0;
        break;
      case kKnotVector:
        if (knot_vectors_ == 2)
          return walker.error(ErrorCode::wrong_count, "a patch has two knot vectors, for u and for v");
        break;
      case kRow: net_.entries = 0; break;
      case kPoint: components_ = 0; break;
      case kWeightRow: weights_.entries = 0; break;
      case kJoin: join_ = {}; break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    switch (node) {
      case kRoot: return finish(walker);
      case kPatch: return finish_patch(walker);
      case kDegrees:
        if (degrees_ != 2)
          return walker.error(ErrorCode::wrong_count, "two degrees should stand here", count_text(degrees_));
        break;
      case kKnotVector: ++knot_vectors_; break;
      case kKnots:
        patch_.has_knots = true;
        if (knot_vectors_ != 2)
          return walker.error(ErrorCode::wrong_count, "two knot vectors should stand here", count_text(knot_vectors_));
        break;
      case kRow:
        if (!net_.row_fits())
          return walker.error(ErrorCode::wrong_count,
                              fmt::format("the first row has {} control points", net_.row_length),
                              count_text(net_.entries));
        break;
      case kPoint: return finish_point(walker);
      case kWeightRow:
        if (!weights_.row_fits())
          return walker.error(ErrorCode::wrong_count, fmt::format("the first row has {} weights", weights_.row_length),
                              count_text(weights_.entries));
        break;
      case kWeights:
        // An empty array is no list of weights either.
        if (weights_.rows == 0) return walker.error(ErrorCode::wrong_count, "weights should stand here", "0");
        break;
      case kJoin: joins_.push_back(join_); break;
      case kSideA: join_.patch_a = side_patch_, join_.edge_a = side_edge_, check_later('a'); break;
      case kSideB: join_.patch_b = side_patch_, join_.edge_b = side_edge_, check_later('b'); break;
      default: break;
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    switch (node) {
      case kFormat:
        if (text != "patchproof-model")
          return walker.error(ErrorCode::unknown_format, "the format should be \"patchproof-model\"", text);
        break;
      case kVersion:
        if (text != "1") return walker.error(ErrorCode::unsupported, "only version 1 of the format is read", text);
        break;
      case kUnits: sink_.units = text; break;
      case kName: patch_.name = text; break;
      case kDegree: {
        const std::optional<long> degree = to_integer(text);
        if (degrees_ == 2)
          return walker.error(ErrorCode::wrong_count, "a patch has two degrees, for u and for v", text);
        if (!degree) return walker.error(ErrorCode::bad_degree, "the degree is too large", text);
        patch_.degree[degrees_++] = *degree;
        break;
      }
      case kKnot: patch_.knots[knot_vectors_].push_back(text); break;
      case kCoordinate: ++components_, patch_.coordinates.push_back(text); break;
      case kWeight: ++weights_.entries, patch_.weights.push_back(text); break;
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
  static std::string count_text(long count) { return std::to_string(count); }

  // Joins may stand before the patches: the largest index is compared with their number at the end.
  void check_later(char side) {
    if (!largest_ || side_patch_ > largest_->patch) largest_ = Reference{side_patch_, side_text_, joins_.size(), side};
  }

  std::optional<Error> finish_point(const JsonWalker& walker) {
    if (net_.rows == 0 && net_.entries == 0) {
      if (components_ != 3 && components_ != 4)
        return walker.error(ErrorCode::wrong_count, "a point is [x, y, z], or homogeneous [w·x, w·y, w·z, w]",
                            count_text(components_));
      patch_.per_point = static_cast<int>(components_);
    } else if (components_ != patch_.per_point) {
      return walker.error(ErrorCode::wrong_count, fmt::format("the first point has {} numbers", patch_.per_point),
                          count_text(components_));
    }
    ++net_.entries;
    return std::nullopt;
  }

  std::optional<Error> finish_patch(const JsonWalker& walker) {
    patch_.count = {net_.rows, net_.row_length};
    if (patch_.per_point == 4) patch_.weight_form = Weights::homogeneous;
    if (weights_.rows > 0) {
      if (patch_.per_point == 4)
        return walker.error(ErrorCode::syntax,
                            "homogeneous points of four numbers carry their weights: no \"weights\" beside them");
      patch_.weight_form = Weights::separate;
      if (weights_.rows != net_.rows || weights_.row_length != net_.row_length)
        return source_.error(ErrorCode::wrong_count, patch_.weights.empty() ? patch_.at : patch_.weights.front(),
                             fmt::format("{} x {} control points need as many weights", net_.rows, net_.row_length),
                             fmt::format("{} x {} weights", weights_.rows, weights_.row_length),
                             patch_.pointer + "/weights");
    }
    return sink_.add(patch_);
  }

  std::optional<Error> finish(const JsonWalker& walker) {
    const std::size_t patches = sink_.patch_count();
    if (patches == 0) return walker.error(ErrorCode::wrong_count, "the model has no patches");
    if (largest_ && static_cast<std::size_t>(largest_->patch) >= patches)
      return source_.error(ErrorCode::bad_reference, largest_->text,
                           fmt::format("the model has patches 0 … {}", patches - 1), largest_->text,
                           fmt::format("/joins/{}/{}/patch", largest_->join, largest_->side));
    sink_.joins = std::move(joins_);
    return std::nullopt;
  }

  const SourceFile& source_;
  ModelSink& sink_;
  RawPatch patch_;
  Shape net_, weights_;
  long degrees_ = 0, knot_vectors_ = 0, components_ = 0;
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
