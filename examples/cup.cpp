// SPDX-License-Identifier: Apache-2.0
// A cup with a handle: 35 bicubic patches whose joins show every class. All coordinates are short decimals, in mm.
//
// The body is a profile in (radius, height) carried around in four quarter turns. A quarter turn is the cubic
// (1,0) (1,k) (k,1) (0,1) with k = 0.552, which is no circle but meets its neighbours with equal tangents: C1. Up the
// outside, over the rim and down the inside, with the class of the join between one ring and the next:
//     underside  (a pole with a tangent plane)
//     foot       C0 only: a kink of about 27 degrees
//     lower      G1, cross-boundary derivatives in the constant ratio 3/2
//     upper      C2: one cubic, split
//     lip        C1
//     rim        C1
//     inside     G1, ratio between 1 and 6/5 along the edge; ends in a second pole
// In the third quarter the upper ring is split at half of the turn: two edges meet one (T-junctions), and beside it the
// ratio is 1/2 or 2. The handle has three parts of two halves each; the last part lies 0.00002 mm beside the second.
#include "models.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/affine.h"
#include "patchproof/patch/patch_knots.h"

namespace patchproof::examples {
namespace {

using Point2 = Vec<Rational, 2>;
using Patch = BsplinePatch<Rational, 4>;
using Profile = std::vector<Point2>;  // (radius, height)

const std::vector<Point2> kQuarter{{{1_q, 0_q}}, {{1_q, 0.552_q}}, {{0.552_q, 1_q}}, {{0_q, 1_q}}};

// The profile carried around the z axis from the angle quarter · 90° to the next.
ModelPatch<Rational> quarter_turn(const std::string& name, const Profile& profile, int quarter) {
  std::vector<Row> rows;
  for (const Point2& p : profile) {
    Row row;
    for (const Point2& q : kQuarter) {
      Point2 c = q;
      for (int turn = 0; turn < quarter; ++turn) c = {{-c[1], c[0]}};
      row.push_back({{p[0] * c[0], p[0] * c[1], p[1]}});
    }
    rows.push_back(std::move(row));
  }
  return bezier_model_patch(name + std::to_string(quarter + 1), rows);
}

// The part [a, b] of a patch in one direction, on [0, 1] again.
ModelPatch<Rational> part(const ModelPatch<Rational>& patch, const std::string& name, Direction d, const Rational& a,
                          const Rational& b) {
  return {name, map_domain(restrict(patch.surface, d, a, b), d, 0_q, 1_q), false};
}

// Inside wall and bottom. The first row under the rim lies 5 mm below it where quarters of one parity begin and 6 mm
// where they end: the derivatives into the wall keep the direction −z while their length changes along the edge.
ModelPatch<Rational> inside(int quarter) {
  const Profile profile{{{33_q, 70_q}}, {{33_q, 65_q}}, {{30_q, 8_q}}, {{0_q, 8_q}}};
  const ModelPatch<Rational> even = quarter_turn("inside", profile, quarter);
  std::vector<Vec<Rational, 4>> net = even.surface.net();
  for (int j = 0; j < 4; ++j)
    if ((j < 2) == (quarter % 2 == 1)) net[4 + j][2] = 64_q;
  return {even.name, Patch(even.surface.knots(Direction::u), even.surface.knots(Direction::v), std::move(net)), false};
}

// Half of an elliptic tube around a spine in the plane y = 0. `spine` and `up` hold (x, z).
ModelPatch<Rational> half_tube(const std::string& name, const std::vector<Point2>& spine, const std::vector<Point2>& up,
                               int side) {
  const std::vector<Point2> half{{{2.5_q, 0_q}}, {{2.5_q, 6_q}}, {{-2.5_q, 6_q}}, {{-2.5_q, 0_q}}};
  std::vector<Row> rows;
  for (std::size_t i = 0; i < spine.size(); ++i) {
    Row row;
    for (const Point2& h : half)
      row.push_back({{spine[i][0] + h[0] * up[i][0], Rational(side) * h[1], spine[i][1] + h[0] * up[i][1]}});
    rows.push_back(std::move(row));
  }
  return bezier_model_patch(name + (side < 0 ? "-right" : "-left"), rows);
}

}  // namespace

NamedModel cup() {
  const Profile underside{{{0_q, 3_q}}, {{8_q, 3_q}}, {{16_q, 2_q}}, {{20_q, 0_q}}};
  const Profile foot{{{20_q, 0_q}}, {{22_q, 0_q}}, {{24_q, 2_q}}, {{24_q, 5_q}}};
  const Profile body{{{24_q, 5_q}}, {{24_q, 14_q}}, {{34_q, 58_q}}, {{36_q, 70_q}}};
  const Profile lip{{{36_q, 70_q}}, {{37_q, 76_q}}, {{37.5_q, 80_q}}, {{36.5_q, 80_q}}};
  const Profile rim{{{36.5_q, 80_q}}, {{35.5_q, 80_q}}, {{33_q, 75_q}}, {{33_q, 70_q}}};

  Model<Rational> model;
  model.units = "mm";
  auto& patches = model.patches;
  for (int q = 0; q < 4; ++q) patches.push_back(quarter_turn("underside", underside, q));
  for (int q = 0; q < 4; ++q) patches.push_back(quarter_turn("foot", foot, q));
  for (int q = 0; q < 4; ++q)
    patches.push_back(part(quarter_turn("body", body, q), "lower" + std::to_string(q + 1), Direction::u, 0_q, 0.5_q));
  for (int q = 0; q < 4; ++q) {
    const std::string name = "upper" + std::to_string(q + 1);
    const ModelPatch<Rational> upper = part(quarter_turn("body", body, q), name, Direction::u, 0.5_q, 1_q);
    if (q != 2) {
      patches.push_back(upper);
      continue;
    }
    patches.push_back(part(upper, name + "a", Direction::v, 0_q, 0.5_q));
    patches.push_back(part(upper, name + "b", Direction::v, 0.5_q, 1_q));
  }
  for (int q = 0; q < 4; ++q) patches.push_back(quarter_turn("lip", lip, q));
  for (int q = 0; q < 4; ++q) patches.push_back(quarter_turn("rim", rim, q));
  for (int q = 0; q < 4; ++q) patches.push_back(inside(q));

  const std::vector<std::vector<Point2>> spines{{{{33.5_q, 60_q}}, {{41.5_q, 62_q}}, {{50_q, 62_q}}, {{55_q, 56_q}}},
                                                {{{55_q, 56_q}}, {{60_q, 50_q}}, {{60_q, 40_q}}, {{53_q, 32_q}}},
                                                {{{53_q, 32_q}}, {{46_q, 24_q}}, {{34_q, 20_q}}, {{25_q, 20_q}}}};
  const std::vector<std::vector<Point2>> ups{{{{0_q, 1_q}}, {{0.2_q, 1.1_q}}, {{0.5_q, 0.9_q}}, {{0.8_q, 0.6_q}}},
                                             {{{0.8_q, 0.6_q}}, {{1.1_q, 0.3_q}}, {{1.1_q, -0.3_q}}, {{0.8_q, -0.6_q}}},
                                             {{{0.8_q, -0.6_q}}, {{0.5_q, -0.9_q}}, {{0.2_q, -1.1_q}}, {{0_q, -1_q}}}};
  for (int k = 0; k < 3; ++k)
    for (const int side : {-1, 1}) {
      patches.push_back(half_tube("handle" + std::to_string(k + 1), spines[k], ups[k], side));
      if (k == 2)
        patches.back().surface = apply(translation<Rational>({{0.00002_q, 0_q, 0_q}}), patches.back().surface);
    }
  return {"cup.json", write_model_json(model)};
}

}  // namespace patchproof::examples
