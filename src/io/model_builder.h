// SPDX-License-Identifier: Apache-2.0
// From texts to exact patches: the finishing step that all readers share. Everything a file can get wrong about degrees,
// knots, counts, sizes and weights is found here.
#pragma once

#include "raw_patch.h"

namespace patchproof {

// T: Rational or Quadratic.
template <ExactField T>
class ModelBuilder final : public ModelSink {
 public:
  ModelBuilder(const SourceFile& source, Decimals decimals) : source_(source), decimals_(decimals) {}

  std::optional<Error> add(const RawPatch& patch) override;
  std::optional<Error> first_bad_number(const RawPatch& patch) override;
  std::size_t patch_count() const override { return model_.patches.size(); }

  // T = Rational: the error came from a root, so that the file should be read again over Q(√d).
  bool met_root() const { return met_root_; }
  Model<T> finish() &&;

 private:
  // Reads one number. False: error_ says why.
  template <class Pointer>
  bool number(std::string_view text, const Pointer& pointer, T& value);
  std::optional<KnotVector<T>> knots(const RawPatch& patch, int direction);
  bool counts_fit(const RawPatch& patch, const std::array<int, 2>& needed);
  // The homogeneous point number `k` of the file.
  bool point(const RawPatch& patch, std::size_t k, Vec<T, 4>& out);
  bool denominator_is_fine(const RawPatch& patch, const BsplinePatch<T, 4>& surface);
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
