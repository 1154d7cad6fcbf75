// SPDX-License-Identifier: Apache-2.0
// Law 5 of include/patchproof/io/write.h.
#include <gtest/gtest.h>

#include "patchproof/io/write.h"
#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/gregory_approximate.h"
#include "support/gregory_patches.h"

namespace patchproof::test {
namespace {

Model<Rational> model_of(const GregoryPatchOptions& options = {}) {
  RandomRationals random;
  Model<Rational> model;
  model.patches.push_back(
      {"plane",
       to_bspline(BezierPatch<Rational, 4>(1, 1, {{{0, 0, 0, 1}}, {{0, 1, 0, 1}}, {{1, 0, 0, 1}}, {{1, 1, 0, 1}}})),
       false});
  for (const char* name : {"first", "second"})
    model.gregory_patches.push_back({name, random_gregory_patch(random, options)});
  return model;
}

TEST(SplinesOnly, Law5_OnePatchForEachBehindTheOthersWithABound) {
  const Model<Rational> model = model_of();
  const SplinesOnly<Rational> out = with_splines_only(model, 4).value();
  ASSERT_EQ(out.model.patches.size(), 3U);
  EXPECT_TRUE(out.model.gregory_patches.empty());
  EXPECT_EQ(out.model.patches[2].name, "second");
  ASSERT_EQ(out.notes.size(), 1U);
  double largest = 0;
  for (const auto& p : model.gregory_patches)
    largest = std::max(largest, approximate(p.patch, BlendSpline::make(4)).value().point_deviation);
  const std::string& note = out.notes[0];
  const auto at = note.find("points within ");
  ASSERT_NE(at, std::string::npos) << note;
  const double said = std::stod(note.substr(at + 14));
  EXPECT_GE(said, largest);
  EXPECT_LE(said, largest * 1.001);
}

TEST(SplinesOnly, Law5_G2IsWrittenSoAndSaysSo) {
  const WrittenModel out = write_model_g2(model_of({.dyadic = true})).value();
  ASSERT_FALSE(out.notes.empty());
  EXPECT_NE(out.notes[0].find("2 of 2 Gregory patches approximated"), std::string::npos) << out.notes[0];
  std::size_t patches = 0;
  for (std::size_t at = out.bytes.find("200 1 0 0"); at != std::string::npos; at = out.bytes.find("200 1 0 0", at + 1))
    ++patches;
  EXPECT_EQ(patches, 3U);
}

TEST(SplinesOnly, Error_WeightsNameThePatch) {
  const auto out = with_splines_only(model_of({.rational = true}));
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().where, "patch 1");
  EXPECT_EQ(out.error().code, ErrorCode::unsupported);
}

TEST(SplinesOnly, Law5_NothingToReplace) {
  Model<Rational> model = model_of();
  model.gregory_patches.clear();
  const auto out = with_splines_only(model).value();
  EXPECT_TRUE(out.notes.empty());
  EXPECT_EQ(out.model.patches.size(), 1U);
}

}  // namespace
}  // namespace patchproof::test
