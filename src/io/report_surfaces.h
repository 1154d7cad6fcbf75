// SPDX-License-Identifier: Apache-2.0
// The B-spline surfaces whose edges are certified: a model's patches, and for each Gregory patch its U surface, which carries
// the edges u_min and u_max, and its V surface, which carries v_min and v_max. Where a Gregory patch may have a kink along a
// knot line, it is expanded to one NURBS patch.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <vector>

#include "patchproof/io/model.h"
#include "patchproof/join/edge_match.h"
#include "patchproof/patch/gregory_expand.h"

namespace patchproof {

template <ExactField T>
class ReportSurfaces {
 public:
  explicit ReportSurfaces(const Model<T>& model) : model_(model), plain_(static_cast<int>(model.patches.size())) {
    for (const ModelPatch<T>& patch : model.patches) surfaces_.push_back(&patch.surface);
    for (const ModelGregoryPatch<T>& patch : model.gregory_patches)
      for (const BsplinePatch<T, 4>* surface : {&patch.patch.u_surface(), &patch.patch.v_surface()})
        surfaces_.push_back(surface);
  }

  const std::vector<const BsplinePatch<T, 4>*>& all() const { return surfaces_; }
  // The number in the model of the patch that a surface belongs to.
  int patch_of(int surface) const {
    if (surface < plain_) return surface;
    const int rest = surface - plain_, carriers = 2 * static_cast<int>(model_.gregory_patches.size());
    return plain_ + (rest < carriers ? rest / 2 : expanded_patches_[rest - carriers]);
  }
  // The surface that carries an edge of a patch.
  int carrier(int patch, EdgeName edge) const {
    if (patch < plain_) return patch;
    return plain_ + 2 * (patch - plain_) + (is_across_v(edge) ? 1 : 0);
  }

  bool is_edge(int surface, EdgeName edge) const {
    return surface < plain_ || ((surface - plain_) % 2 == 1) == is_across_v(edge);
  }

  // What was found on the surfaces becomes what is there on the patches.
  void rename(EdgeMatch<T>& match) {
    for (Join<T>& join : match.joins) {
      if (join.kind == JoinKind::knot_line)
        join.patch_a = join.patch_b = with_knot_lines(join.patch_a);
      else if (patch_of(join.patch_a) == patch_of(join.patch_b))
        join.kind = JoinKind::seam;
    }
    for (EdgeRange& e : match.unmatched) e.patch = patch_of(e.patch);
    for (CollapsedEdge& e : match.collapsed) e.patch = patch_of(e.patch);
  }

 private:
  static bool is_across_v(EdgeName edge) { return edge == EdgeName::v_min || edge == EdgeName::v_max; }
  int with_knot_lines(int surface) {
    if (surface < plain_) return surface;
    const int patch = (surface - plain_) / 2;
    const auto [at, is_new] = expanded_surface_.emplace(patch, static_cast<int>(surfaces_.size()));
    if (is_new) {
      expanded_.push_back(expand(model_.gregory_patches[patch].patch).surface);
      expanded_patches_.push_back(patch);
      surfaces_.push_back(&expanded_.back());
    }
    return at->second;
  }

  const Model<T>& model_;
  const int plain_;
  std::vector<const BsplinePatch<T, 4>*> surfaces_;
  std::deque<BsplinePatch<T, 4>> expanded_;
  std::vector<int> expanded_patches_;
  std::map<int, int> expanded_surface_;
};

}  // namespace patchproof
