// SPDX-License-Identifier: Apache-2.0
// The JSON of geomdl (NURBS-Python): a list of curves, or a list of surfaces with the points along growing v first; weights
// stand apart and are not multiplied into the points. Sampling and display settings (delta, …) are skipped.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "json_walker.h"
#include "raw_spline.h"
#include "text_cursor.h"

namespace patchproof {
namespace {

enum Node {
  kRoot,
  kShape,
  kShapeType,
  kCount,
  kData,
  kSpline,
  kSplineType,
  kRational,
  kDimension,
  kDegree,
  kDegreeU,
  kDegreeV,
  kKnots,
  kKnotsU,
  kKnotsV,
  kKnot,
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
    {kData, "", kSpline, JsonType::object},
    {kSpline, "type", kSplineType, JsonType::string},
    {kSpline, "name", kName, JsonType::string},
    {kSpline, "rational", kRational, JsonType::boolean, true},
    {kSpline, "dimension", kDimension, JsonType::integer},
    {kSpline, "degree", kDegree, JsonType::integer},
    {kSpline, "degree_u", kDegreeU, JsonType::integer},
    {kSpline, "degree_v", kDegreeV, JsonType::integer},
    {kSpline, "knotvector", kKnots, JsonType::array},
    {kSpline, "knotvector_u", kKnotsU, JsonType::array},
    {kSpline, "knotvector_v", kKnotsV, JsonType::array},
    {kKnots, "", kKnot, JsonType::number},
    {kKnotsU, "", kKnotU, JsonType::number},
    {kKnotsV, "", kKnotV, JsonType::number},
    {kSpline, "size_u", kSizeU, JsonType::integer},
    {kSpline, "size_v", kSizeV, JsonType::integer},
    {kSpline, "control_points", kNet, JsonType::object, true},
    {kSpline, "trims", kTrims, JsonType::object},
    {kNet, "points", kPoints, JsonType::array, true},
    {kPoints, "", kPoint, JsonType::array},
    {kPoint, "", kCoordinate, JsonType::number},
    {kNet, "weights", kWeights, JsonType::array},
    {kWeights, "", kWeight, JsonType::number},
};

// The keys that a surface must have, and those of a curve.
constexpr int kSurfaceKeys[] = {kDegreeU, kDegreeV, kKnotsU, kKnotsV, kSizeU, kSizeV};
constexpr int kCurveKeys[] = {kDegree, kKnots};

class GeomdlVisitor final : public JsonVisitor {
 public:
  explicit GeomdlVisitor(ModelSink& sink) : sink_(sink) {}

  std::optional<Error> begin(int node, const JsonWalker& walker) override {
    seen_.insert(node);
    if (node == kSpline) {
      spline_ = RawSpline{};
      spline_.layout = JsonLayout::geomdl;
      spline_.pointer = walker.pointer();
      spline_.at = walker.here();
      spline_.has_knots = true;
      points_ = 0;
      dimension_ = -1;
      seen_.clear();
    } else if (node == kPoint) {
      components_ = 0;
    } else if (node == kTrims) {
      return walker.error(ErrorCode::unsupported, "a trimmed surface is not read");
    }
    return std::nullopt;
  }

  std::optional<Error> end(int node, const JsonWalker& walker) override {
    if (node == kPoint) {
      if (points_ == 0) spline_.per_point = static_cast<int>(components_);
      if (components_ != spline_.per_point || (components_ != 2 && components_ != 3))
        return walker.error(ErrorCode::wrong_count, "all points have 2 numbers, or all have 3",
                            std::to_string(components_));
      ++points_;
    } else if (node == kSpline) {
      return finish_spline(walker);
    } else if (node == kShape) {
      return finish_shape(walker);
    }
    return std::nullopt;
  }

  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker) override {
    seen_.insert(node);
    switch (node) {
      case kShapeType:
        if (text != "surface" && text != "curve")
          return walker.error(ErrorCode::unsupported, "only shapes of type \"curve\" and \"surface\" are read", text);
        shape_ = text;
        break;
      case kSplineType:
        if (text != "spline")
          return walker.error(ErrorCode::unsupported, "only curves and surfaces of type \"spline\" are read", text);
        break;
      case kName: spline_.name = text; break;
      case kRational: spline_.weight_form = text == "true" ? Weights::separate : Weights::none; break;
      case kCount: return integer(text, walker, count_.emplace());
      case kDimension: return integer(text, walker, dimension_);
      case kDegree:
      case kDegreeU: return integer(text, walker, spline_.degree[0]);
      case kDegreeV: return integer(text, walker, spline_.degree[1]);
      case kSizeU: return integer(text, walker, spline_.count[0]);
      case kSizeV: return integer(text, walker, spline_.count[1]);
      case kKnot:
      case kKnotU: spline_.knots[0].push_back(text); break;
      case kKnotV: spline_.knots[1].push_back(text); break;
      case kCoordinate: ++components_, spline_.coordinates.push_back(text); break;
      case kWeight: spline_.weights.push_back(text); break;
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

  // A spline is a curve when it has one of a curve's keys: "type" of the shape may stand after the data.
  std::optional<Error> finish_spline(const JsonWalker& walker) {
    const bool is_curve = seen_.contains(kDegree) || seen_.contains(kKnots);
    const std::span<const int> wanted = is_curve ? std::span<const int>(kCurveKeys) : kSurfaceKeys;
    for (const JsonRule& rule : kRules)
      if (rule.parent == kSpline && std::ranges::count(wanted, rule.node) > 0 && !seen_.contains(rule.node))
        return walker.error(ErrorCode::syntax, fmt::format("the key \"{}\" is missing", rule.key));
    if (is_curve)
      for (const int node : kSurfaceKeys)
        if (seen_.contains(node))
          return walker.error(ErrorCode::syntax, "keys of a curve and of a surface in one object");
    if (is_curve) spline_.directions = 1, spline_.count = {points_, 1};
    if (dimension_ >= 0 && dimension_ != spline_.per_point)
      return walker.error(ErrorCode::wrong_count, fmt::format("the dimension is said to be {}", dimension_),
                          fmt::format("points of {} numbers", spline_.per_point));
    if (spline_.weight_form == Weights::none && !spline_.weights.empty())
      return walker.error(ErrorCode::syntax, "weights beside points that are said not to be rational");
    return sink_.add(spline_);
  }

  std::optional<Error> finish_shape(const JsonWalker& walker) const {
    const std::size_t curves = sink_.curve_count(), found = sink_.patch_count() + curves;
    if (found == 0) return walker.error(ErrorCode::wrong_count, "the file holds neither curves nor surfaces");
    if (shape_ == "curve" ? curves < found : curves > 0)
      return walker.error(ErrorCode::syntax, "curves and surfaces where the shape's type promises one of them", shape_);
    if (count_ && *count_ != static_cast<long>(found))
      return walker.error(ErrorCode::wrong_count, fmt::format("{} {}s are announced", *count_, shape_),
                          std::to_string(found));
    return std::nullopt;
  }

  ModelSink& sink_;
  RawSpline spline_;
  std::set<int> seen_;  // nodes of the curve or surface
  std::string shape_;
  long points_ = 0, components_ = 0, dimension_ = -1;
  std::optional<long> count_;
};

}  // namespace

std::optional<Error> read_geomdl(const SourceFile& source, ModelSink& sink) {
  GeomdlVisitor visitor(sink);
  return JsonWalker(source, kRules, UnknownKeys::skipped, visitor).walk();
}

}  // namespace patchproof
