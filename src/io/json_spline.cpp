// SPDX-License-Identifier: Apache-2.0
#include "json_spline.h"

#include <fmt/format.h>

#include "text_cursor.h"

namespace patchproof {

void JsonSpline::start(int directions, const JsonWalker& walker) {
  *this = JsonSpline();
  raw_.directions = directions;
  raw_.layout = JsonLayout::model;
  raw_.pointer = walker.pointer();
  raw_.at = walker.here();
}

void JsonSpline::start_point(const JsonWalker& walker) {
  start(1, walker);
  raw_.layout = JsonLayout::point;
}

std::optional<Error> JsonSpline::begin(int node, const JsonWalker& walker) {
  switch (node) {
    case kKnots:
      if (knot_vectors_ == raw_.directions)
        return walker.error(ErrorCode::wrong_count, "a patch has two knot vectors, for u and for v");
      break;
    case kRow: net_.entries = 0; break;
    case kPoint: components_ = 0; break;
    case kWeightRow: weights_.entries = 0; break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Error> JsonSpline::end(int node, const JsonWalker& walker) {
  const auto wrong_count = [&](std::string message, long count) {
    return walker.error(ErrorCode::wrong_count, std::move(message), std::to_string(count));
  };
  switch (node) {
    case kDegrees:
      if (degrees_ != 2) return wrong_count("two degrees should stand here", degrees_);
      break;
    case kKnots: ++knot_vectors_, raw_.has_knots = true; break;
    case kKnotVectors:
      if (knot_vectors_ != 2) return wrong_count("two knot vectors should stand here", knot_vectors_);
      break;
    case kNet: has_points_ = true; break;
    case kRow:
      has_points_ = true;
      if (!net_.row_fits())
        return wrong_count(fmt::format("the first row has {} control points", net_.row_length), net_.entries);
      break;
    case kPoint: return end_point(walker);
    case kWeightRow:
      if (!weights_.row_fits())
        return wrong_count(fmt::format("the first row has {} weights", weights_.row_length), weights_.entries);
      break;
    case kWeightNet:
      // An empty array is no list of weights either.
      if (weights_.rows == 0) return wrong_count("weights should stand here", 0);
      break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Error> JsonSpline::leaf(int node, std::string_view text, const JsonWalker& walker) {
  switch (node) {
    case kName: raw_.name = text; break;
    case kDegree: {
      const std::optional<long> degree = to_integer(text);
      if (degrees_ == raw_.directions)
        return walker.error(ErrorCode::wrong_count, "a patch has two degrees, for u and for v", text);
      if (!degree) return walker.error(ErrorCode::bad_degree, "the degree is too large", text);
      raw_.degree[degrees_++] = *degree;
      break;
    }
    case kKnot: raw_.knots[knot_vectors_].push_back(text); break;
    case kCoordinate: ++components_, raw_.coordinates.push_back(text); break;
    case kWeight: ++weights_.entries, raw_.weights.push_back(text); break;
    case kHomogeneous: homogeneous_ = text == "true"; break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Error> JsonSpline::end_point(const JsonWalker& walker) {
  if (net_.rows == 0 && net_.entries == 0) {
    // How many a curve's points should have, its key "homogeneous" says, which may be still to come.
    if (!raw_.is_curve() && components_ != 3 && components_ != 4)
      return walker.error(ErrorCode::wrong_count, "a point is [x, y, z], or homogeneous [w·x, w·y, w·z, w]",
                          std::to_string(components_));
    raw_.per_point = static_cast<int>(components_);
  } else if (components_ != raw_.per_point) {
    return walker.error(ErrorCode::wrong_count, fmt::format("the first point has {} numbers", raw_.per_point),
                        std::to_string(components_));
  }
  ++net_.entries;
  return std::nullopt;
}

std::optional<Error> JsonSpline::check_point_length(const SourceFile& source) const {
  const int dimension = raw_.per_point - (homogeneous_ ? 1 : 0);
  if (!raw_.is_curve() || raw_.coordinates.empty() || dimension == 2 || dimension == 3) return std::nullopt;
  return source.error(ErrorCode::wrong_count, raw_.coordinates.front(),
                      homogeneous_ ? "a homogeneous point of a curve is [w·x, w·y, w] or [w·x, w·y, w·z, w]"
                                   : "a point of a curve is [x, y] or [x, y, z], unless \"homogeneous\" is true",
                      std::to_string(raw_.per_point), raw_.points_pointer() + "/0");
}

std::optional<Error> JsonSpline::finish(const SourceFile& source, const JsonWalker& walker) {
  if (raw_.layout == JsonLayout::point) {
    if (components_ != 2 && components_ != 3)
      return walker.error(ErrorCode::wrong_count, "a point is [x, y] or [x, y, z]", std::to_string(components_));
    raw_.per_point = static_cast<int>(components_);
    raw_.count = {1, 1};
    return std::nullopt;
  }
  if (degrees_ == 0) return walker.error(ErrorCode::syntax, "the key \"degree\" is missing");
  if (!has_points_) return walker.error(ErrorCode::syntax, "the key \"control_points\" is missing");
  raw_.count = raw_.is_curve() ? std::array{net_.row_length, 1L} : std::array{net_.rows, net_.row_length};
  if (std::optional<Error> error = check_point_length(source)) return error;
  const bool homogeneous = raw_.is_curve() ? homogeneous_ : raw_.per_point == 4;
  if (homogeneous) raw_.weight_form = Weights::homogeneous;
  if (weights_.rows == 0) return std::nullopt;
  if (homogeneous)
    return walker.error(ErrorCode::syntax, "homogeneous points carry their weights: no \"weights\" beside them");
  raw_.weight_form = Weights::separate;
  if (weights_.rows == net_.rows && weights_.row_length == net_.row_length) return std::nullopt;
  const auto size = [&](const Shape& s) {
    return raw_.is_curve() ? fmt::format("{}", s.row_length) : fmt::format("{} x {}", s.rows, s.row_length);
  };
  return source.error(ErrorCode::wrong_count, raw_.weights.empty() ? raw_.at : raw_.weights.front(),
                      fmt::format("{} control points need as many weights", size(net_)),
                      fmt::format("{} weights", size(weights_)), raw_.weights_pointer());
}

}  // namespace patchproof
