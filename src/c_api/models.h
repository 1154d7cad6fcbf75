// SPDX-License-Identifier: Apache-2.0
// The content of a model's handle, and its parts by number.
#pragma once

#include <string>
#include <vector>

#include "c_api/handles.h"
#include "patchproof/io/model.h"

namespace patchproof::c_api {

struct ModelContent {
  ModelFile file;
  std::string notes, findings;  // one to a line
};

ModelContent content_of_file(ModelFile file);

// A B-spline patch (curve) of the model; the call ends where the number is that of another kind.
template <ExactField T>
const ModelPatch<T>& spline_patch(const Model<T>& model, std::size_t patch);
template <ExactField T>
const ModelCurve<T>& spline_curve(const Model<T>& model, std::size_t curve);

template <ExactField T>
std::size_t patch_count(const Model<T>& model) {
  return model.patches.size() + model.gerbs_patches.size() + model.gregory_patches.size();
}
template <ExactField T>
std::size_t curve_count(const Model<T>& model) {
  return model.curves.size() + model.gerbs_curves.size();
}

// The nearest doubles of a spline with homogeneous control points.
struct DoubleSpline {
  std::vector<double> knots[2], points, weights;
  int degree[2] = {0, 0};
  bool is_rational = false, is_exact = true;  // exact: nothing was rounded
};
template <ExactField T>
DoubleSpline doubles_of(const ModelPatch<T>& patch);
template <ExactField T>
DoubleSpline doubles_of(const ModelCurve<T>& curve);

}  // namespace patchproof::c_api

struct patchproof_model : patchproof::c_api::Handle<patchproof::c_api::ModelContent> {
  using Handle::Handle;
};
