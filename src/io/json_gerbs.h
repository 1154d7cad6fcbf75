// SPDX-License-Identifier: Apache-2.0
// GERBS curves and patches of our JSON model, put together number by number.
#pragma once

#include "json_spline.h"

namespace patchproof {

// Nodes below a GERBS curve or patch, beside those of its local curves and patches (JsonSplineNode).
enum JsonGerbsNode {
  kGerbs = 64,
  kGerbsName,
  kBFunction,
  kGerbsKnotVectors,
  kGerbsKnots,
  kGerbsKnot,
  kClosedDirections,
  kClosed,
  kLocals,
  kLocalPatches,
  kLocalCurve,
  kLocalPatch,
  kTrigonometric,
  kSameAs,
  kMap,
  kMapRow,
  kMapNumber,
  kBlend,
  kOverlap,
  kBlendedCurve,
  kGerbsNodesEnd,
};

class JsonGerbs {
 public:
  // A curve (1 direction) or a patch (2) begins where the walker stands.
  void start(int directions, const JsonWalker& walker);
  std::optional<Error> begin(int node, const JsonWalker& walker);
  std::optional<Error> end(int node, const JsonWalker& walker, const SourceFile& source);
  std::optional<Error> leaf(int node, std::string_view text, const JsonWalker& walker);
  // The local curve or patch being read: nodes below kSplineNodes are its.
  JsonSpline& spline() { return spline_; }
  // To be called at the end of the object.
  std::optional<Error> finish(const JsonWalker& walker);
  const RawGerbs& raw() const { return raw_; }

 private:
  RawGerbs raw_;
  JsonSpline spline_;
  RawLocal local_;
  long knot_vectors_ = 0, closed_ = 0, row_ = 0;
  bool has_knots_ = false, has_locals_ = false;
};

}  // namespace patchproof
