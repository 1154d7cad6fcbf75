// SPDX-License-Identifier: Apache-2.0
// From texts to exact patches: the finishing step that all readers share. Everything a file can get wrong about degrees,
// knots, counts, sizes and weights is found here.
#pragma once

#include "construction.h"
#include "raw_spline.h"

namespace patchproof {

// T: Rational or Quadratic.
template <ExactField T>
class ModelBuilder final : public ModelSink {
 public:
  ModelBuilder(const SourceFile& source, Decimals decimals) : source_(source), decimals_(decimals) {}

  std::optional<Error> add(const RawSpline& spline) override;
  std::optional<Error> add(const RawConstruction& construction) override;
  std::optional<Error> add(const RawGregory& patch) override;
  std::optional<Error> add(const RawGerbs& curve_or_patch) override;
  std::optional<Error> add(const RawSolid& solid) override;
  std::optional<Error> first_bad_number(const RawSpline& spline) override;
  std::size_t patch_count() const override { return model_.patches.size(); }
  std::size_t gregory_patch_count() const override { return model_.gregory_patches.size(); }
  std::size_t gerbs_count() const override { return model_.gerbs_patches.size() + model_.gerbs_curves.size(); }
  std::size_t gerbs_patch_count() const override { return model_.gerbs_patches.size(); }
  std::size_t curve_count() const override { return model_.curves.size(); }

  // T = Rational: the error came from a root, so that the file should be read again over Q(√d).
  bool met_root() const { return met_root_; }
  Model<T> finish() &&;

 private:
  // Reads one number. False: error_ says why.
  template <class Pointer>
  bool number(std::string_view text, const Pointer& pointer, T& value);
  static bool is_bounded(const Vec<T, 4>& point);  // with and without its weight
  bool number_at(std::string_view text, const std::string& pointer, T& value);
  // These return nothing, or false, when error_ says why.
  std::optional<KnotVector<T>> knots(const RawSpline& spline, int direction);
  bool counts_fit(const RawSpline& spline, const std::array<int, 2>& needed);
  // The homogeneous point number `k` of the file.
  bool point(const RawSpline& spline, std::size_t k, Vec<T, 4>& out);
  // All of them, with v running fastest.
  std::optional<std::vector<Vec<T, 4>>> points(const RawSpline& spline, const std::array<int, 2>& count);
  // Where the weights of something stand that has a denominator.
  struct WeightPlace {
    std::string_view what, at;  // "curve", "patch"
    std::string pointer;
  };
  static WeightPlace weight_place(const RawSpline& spline);
  bool denominator_is_fine(const WeightPlace& place, const BsplinePatch<T, 4>& surface);
  bool denominator_is_fine(const WeightPlace& place, const BsplineCurve<T, 4>& curve);
  std::optional<ModelCurve<T>> curve(const RawSpline& raw);
  std::optional<ModelPatch<T>> patch(const RawSpline& raw);
  std::optional<Construction<T>> construction(const RawConstruction& raw);
  std::optional<ModelPatch<T>> patch(const RawConstruction& raw);
  // Of GERBS.
  struct Local {
    std::vector<FunctionBasis<T>> bases;
    std::vector<Vec<T, 4>> points;
    int dimension = 3;
  };
  std::optional<Local> local(const RawLocal& raw, const std::vector<Local>& earlier);
  std::optional<KnotVector<T>> gerbs_knots_of(const RawGerbs& raw, int direction);
  bool add_gerbs_curve(const RawGerbs& raw, BFunction b, const std::vector<Local>& locals);
  bool add_gerbs_patch(const RawGerbs& raw, BFunction b, const std::vector<Local>& locals);
  bool add_blend(const RawGerbs& raw, BFunction b);
  bool fail_at(const RawGerbs& raw, const Error& error);
  std::optional<typename ModelSolid<T>::Control> control(const RawSolid& raw, std::size_t k);
  bool fail(ErrorCode code, std::string_view at, std::string message, std::string_view values,
            std::string_view pointer);

  const SourceFile& source_;
  Decimals decimals_;
  Model<T> model_;
  std::optional<Error> error_;
  bool met_root_ = false;
  int root_ = 1;                // Quadratic: the d of the first root met
  std::string_view root_text_;  // and the number it stood in
};

}  // namespace patchproof
