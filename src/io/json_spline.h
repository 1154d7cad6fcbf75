// SPDX-License-Identifier: Apache-2.0
// The parts that curves and patches of our JSON model share, put together number by number.
#pragma once

#include "json_walker.h"
#include "raw_spline.h"

namespace patchproof {

// Nodes below a curve or a patch. A curve's degree, knots, points and weights are one kDegree, kKnots, kRow and kWeightRow;
// a patch has a list of each.
enum JsonSplineNode {
  kName,
  kDegrees,
  kDegree,
  kKnotVectors,
  kKnots,
  kKnot,
  kNet,
  kRow,
  kPoint,
  kCoordinate,
  kWeightNet,
  kWeightRow,
  kWeight,
  kHomogeneous,
  kSplineNodes,  // how many there are
};

class JsonSpline {
 public:
  // A curve (1 direction) or a patch (2) begins where the walker stands.
  void start(int directions, const JsonWalker& walker);
  // A single point, [x, y] or [x, y, z], that stands for a curve: its numbers are kCoordinate nodes.
  void start_point(const JsonWalker& walker);
  // What JsonVisitor asks, for the nodes above.
  std::optional<Error> begin(int node, const JsonWalker& walker);
  std::optional<Error> end(int node, const JsonWalker& walker);
  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker);
  // Nothing but a name has been read so far.
  bool is_empty() const { return degrees_ == 0 && !has_points_ && weights_.rows == 0 && !raw_.has_knots; }
  // To be called at the end of the object: are its parts there, and do they fit together?
  std::optional<Error> finish(const SourceFile& source, const JsonWalker& walker);
  // What was read. After finish(), complete.
  const RawSpline& raw() const { return raw_; }

 private:
  // How a nested array is filled: rows so far, entries of the row, entries of the first row.
  struct Shape {
    long rows = 0, entries = 0, row_length = 0;
    bool row_fits() {
      if (rows++ == 0) row_length = entries;
      return entries == row_length;
    }
  };
  std::optional<Error> end_point(const JsonWalker& walker);
  std::optional<Error> check_point_length(const SourceFile& source) const;

  RawSpline raw_;
  Shape net_, weights_;
  long degrees_ = 0, knot_vectors_ = 0, components_ = 0;
  bool has_points_ = false, homogeneous_ = false;
};

}  // namespace patchproof
