// SPDX-License-Identifier: Apache-2.0
// A model in which splines stand for its GERBS curves and patches, under the same numbers: the same functions where they are splines,
// else outlines (patch/gerbs_outline.h), from which nothing may be concluded.
#pragma once

#include <vector>

#include "patchproof/io/model.h"

namespace patchproof {

template <ExactField T>
struct SplineModel {
  Model<T> model;
  std::vector<std::size_t> outlined_patches, outlined_curves;  // increasing numbers
  std::vector<std::string> notes;  // "patch 0: GERBS surface, expanded exactly to degree (4, 4)"
};

// An expansion of a degree above kMaxDegree, or of more than some seconds, is outlined, too.
template <ExactField T>
SplineModel<T> gerbs_to_splines(const Model<T>& model);

template <ExactField T>
bool has_gerbs(const Model<T>& model) {
  return !model.gerbs_patches.empty() || !model.gerbs_curves.empty();
}

}  // namespace patchproof
