// SPDX-License-Identifier: Apache-2.0
// A moving model as pictures: one for each frame, all in the same view, and one that shows them one after the other.
//
// The moving picture is SVG with style rules only: what all frames have in common stands in it once, and so does a state
// that returns. It runs without end; where nothing can move (or the reader wishes so) its first frame is seen.
//
// ENSURES  (1) all pictures have one viewBox, and a point has one place in all of them;  (2) the moving picture shows in
//          each of n equal parts of its period exactly one frame, in order;  (3) the same frames give the same bytes.
// ERRORS   as plot(); of options `basis` is not for frames.
// NEIGHBOURS plot.h, motion.h.
// TEST     tests/io/animation_test.cpp checks (1)–(3).
#pragma once

#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"
#include "patchproof/io/plot.h"

namespace patchproof {

struct Animation {
  std::vector<std::string> frames;  // svg
  std::string moving;
};

// REQUIRES at least one frame, seconds > 0: the period.
template <ExactField T>
Result<Animation> plot_frames(const std::vector<Model<T>>& frames, const PlotOptions& options, double seconds);

}  // namespace patchproof
