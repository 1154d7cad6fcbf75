// SPDX-License-Identifier: Apache-2.0
// Motions of GERBS curves and patches in files (docs/formats.md), and the frames that they make of a model.
//
//   {"format": "patchproof-motion", "version": 1, "pace": "polynomial(1)",
//    "motions": [{"curve": 0, "locals": [1, 2], "translate": [1, 0, 0]},
//                {"patch": 0, "locals": [[0, 1]], "about": [0, 0, 0], "rotate": {"axis": [0, 0, 1], "half_tangent": "1/4"},
//                 "scale": [1, 1, "3/2"], "shear": {"xy": "1/3"}}]}
//
// Curves and patches have their numbers in the model; local curves are counted from 0, local patches are [row, column]; without
// "locals" all move. A shear "xy" of k adds k·y to x. "pace" is the B-function that says how the phase goes there and back
// (patch/gerbs_motion.h); without it the phase is linear.
//
// ENSURES  (1) every number is exact;  (2) a motion is read as a whole and fits the model, or is an Error;  (3) frame k of n is
//          the model with its GERBS curves and patches moved to frame_phase(pace, k, n), and nothing else changed.
// ERRORS   bad_reference: a curve, patch or local that the model does not have, or one that is no GERBS;  wrong_count,
//          bad_number (numbers beyond ±10^100, too), mixed_roots, syntax, unsupported, unknown_format;  not_monotone and
//          usage: the pace, as BFunction::parse;  `where` is file:line at a JSON pointer.
// NEIGHBOURS read.h, animation.h.
// TEST     tests/io/motion_test.cpp checks (1)–(3).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"
#include "patchproof/patch/gerbs_motion.h"

namespace patchproof {

template <ExactField T>
struct ModelMotion {
  BFunction pace;
  std::vector<std::vector<LocalMotion<T>>> curves, patches;  // of each of the model's GERBS curves and patches
};

inline constexpr int kMostFrames = 1000;

// A motion of this model.
template <ExactField T>
Result<ModelMotion<T>> read_motion(const std::string& path, const Model<T>& model, Decimals decimals = Decimals::exact);
template <ExactField T>
Result<ModelMotion<T>> read_motion_text(std::string_view bytes, const std::string& path, const Model<T>& model,
                                        Decimals decimals = Decimals::exact);

// REQUIRES a motion of this model; 0 ≤ k ≤ n, n ≥ 1.
template <ExactField T>
Model<T> frame(const Model<T>& model, const ModelMotion<T>& motion, int k, int n);

}  // namespace patchproof
