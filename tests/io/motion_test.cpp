// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/motion.h"

#include <gtest/gtest.h>

#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof {
namespace {

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

// A plain curve, a GERBS curve with the number 1, and a GERBS patch with the number 0. `x`: a number of the model.
std::string model_text(const std::string& x = "1") {
  return R"~({"format": "patchproof-model", "version": 1,
    "curves": [{"degree": 1, "control_points": [[0, 0], [1, 1]]}],
    "gerbs_curves": [{"b_function": "polynomial(1)", "knots": [0, 1, 2], "locals": [
      {"degree": 1, "knots": [0, 0, 2, 2], "control_points": [[0, 0], [2, 4]]}, {"same_as": 0}, {"same_as": 0}]}],
    "gerbs_patches": [{"b_function": "polynomial(1)", "knots": [[0, 1], [0, 1, 2]], "locals": [
      {"degree": [1, 1], "knots": [[0, 0, 1, 1], [0, 0, 2, 2]], "control_points": [[[0, 0, 0], [0, 2, 0]], [[1, 0, 0], [1, 2, )~" +
         x + R"~(]]]},
      {"same_as": 0}, {"same_as": 0}, {"same_as": 0}, {"same_as": 0}, {"same_as": 0}]}]})~";
}
template <class T>
Model<T> model(const std::string& x = "1") {
  const Result<ModelFile> file = read_model_text(model_text(x), "model.json");
  EXPECT_TRUE(file) << file.error().text();
  return std::get<Model<T>>(file->model);
}
std::string motion_text(const std::string& motions, const std::string& more = "") {
  return R"~({"format": "patchproof-motion", "version": 1)~" + more + R"~(, "motions": [)~" + motions + "]}";
}

TEST(MotionFile, Law1_EveryNumberIsExact) {
  const auto read = read_motion_text(
      motion_text(
          R"~({"curve": 1, "locals": [2], "about": [0.1, "1/3", -2], "translate": [1e-3, 0, 7], "scale": [1, "2/3", 1],
                      "rotate": {"axis": [1, 2, 3], "half_tangent": "1/7"}, "shear": {"xy": 0.25, "zx": "-1/9"}},
                     {"patch": 0, "locals": [[1, 2], [0, 0]], "translate": [0, 0, 1]})~",
          R"~(, "pace": "polynomial(2)")~"),
      "motion.json", model<Rational>());
  ASSERT_TRUE(read) << read.error().text();
  AffineMotion<Rational> all;
  all.about = {{q(1, 10), q(1, 3), q(-2)}};
  all.translation = {{q(1, 1000), q(0), q(7)}};
  all.scale[1] = q(2, 3);
  all.axis = {{q(1), q(2), q(3)}};
  all.half_tangent = q(1, 7);
  all.shear[0][1] = q(1, 4);
  all.shear[2][0] = q(-1, 9);
  AffineMotion<Rational> up;
  up.translation[2] = q(1);
  EXPECT_TRUE(read->pace == BFunction::polynomial(2).value());
  EXPECT_TRUE((read->curves == std::vector<std::vector<LocalMotion<Rational>>>{{{2, 0, all}}}));
  EXPECT_TRUE((read->patches == std::vector<std::vector<LocalMotion<Rational>>>{{{1, 2, up}, {0, 0, up}}}));
  const auto rounded = read_motion_text(motion_text(R"~({"curve": 1, "locals": [0], "translate": [0.1, 0, 0]})~"),
                                        "motion.json", model<Rational>(), Decimals::binary64);
  ASSERT_TRUE(rounded);
  EXPECT_EQ(rounded->curves[0][0].motion.translation[0], from_double(0.1));
  const auto root = read_motion_text(motion_text(R"~({"curve": 1, "locals": [0], "translate": ["sqrt(2)/2", 0, 0]})~"),
                                     "motion.json", model<Quadratic>("\"sqrt(2)\""));
  ASSERT_TRUE(root) << root.error().text();
  EXPECT_TRUE(root->curves[0][0].motion.translation[0] == Quadratic(q(0), q(1, 2), 2));
}

TEST(MotionFile, Law2_WithoutLocalsAllMove) {
  const auto read = read_motion_text(motion_text(R"~({"curve": 1}, {"patch": 0}, {"curve": 1, "locals": []})~"),
                                     "motion.json", model<Rational>());
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_TRUE(read->pace == BFunction::polynomial(0).value());
  EXPECT_EQ(read->curves[0].size(), 3u);
  ASSERT_EQ(read->patches[0].size(), 6u);
  EXPECT_EQ(read->patches[0][5].p, 1);
  EXPECT_EQ(read->patches[0][5].q, 2);
}

TEST(MotionFile, Law2_AMotionOfAnotherModelIsRefused) {
  struct Case {
    const char* motion;
    ErrorCode code;
    const char* where;
  };
  for (const Case& c :
       {Case{R"~({"curve": 0})~", ErrorCode::bad_reference, "/motions/0/curve"},
        Case{R"~({"curve": 2})~", ErrorCode::bad_reference, "/motions/0/curve"},
        Case{R"~({"patch": 1})~", ErrorCode::bad_reference, "/motions/0/patch"},
        Case{R"~({"patch": 99999999999999999999})~", ErrorCode::bad_reference, "/motions/0/patch"},
        Case{R"~({"patch": 0}, {"patch": 0, "locals": [[0, 0], [2, 0]]})~", ErrorCode::bad_reference,
             "/motions/1/locals/1"},
        Case{R"~({"patch": 0, "locals": [0]})~", ErrorCode::wrong_count, "/motions/0/locals/0"},
        Case{R"~({"curve": 1, "locals": [3]})~", ErrorCode::bad_reference, "/motions/0/locals/0"},
        Case{R"~({"curve": 1, "translate": [1, 2, 3, 4]})~", ErrorCode::wrong_count, "/motions/0/translate/3"},
        Case{R"~({"curve": 1, "translate": [1, 2, "sqrt(2)"]})~", ErrorCode::bad_number, "/motions/0/translate/2"}}) {
    const auto read = read_motion_text(motion_text(c.motion), "motion.json", model<Rational>());
    ASSERT_FALSE(read) << c.motion;
    EXPECT_EQ(read.error().code, c.code) << read.error().text();
    EXPECT_TRUE(read.error().where.starts_with("motion.json:")) << read.error().text();
    EXPECT_TRUE(read.error().where.ends_with(std::string(" at ") + c.where)) << read.error().text();
  }
  for (const char* text : {"", " \n", "{", "[]", "{}", "null"})
    EXPECT_FALSE(read_motion_text(text, "motion.json", model<Rational>())) << text;
  const auto roots = read_motion_text(motion_text(R"~({"curve": 1, "translate": ["sqrt(3)", 0, 0]})~"), "motion.json",
                                      model<Quadratic>("\"sqrt(2)\""));
  ASSERT_FALSE(roots);
  EXPECT_EQ(roots.error().code, ErrorCode::mixed_roots);
}

TEST(MotionFile, Law3_FramesMoveGerbsOnly) {
  const Model<Rational> rest = model<Rational>();
  const auto motion = read_motion_text(motion_text(R"~({"curve": 1, "locals": [1], "translate": [0, 0, 5]},
                                                      {"patch": 0, "locals": [[1, 1]], "scale": [2, 2, 2]})~"),
                                       "motion.json", rest);
  ASSERT_TRUE(motion) << motion.error().text();
  EXPECT_EQ(write_model_json(frame(rest, *motion, 0, 8)), write_model_json(rest));
  EXPECT_EQ(write_model_json(frame(rest, *motion, 8, 8)), write_model_json(rest));
  for (const int k : {1, 4, 7}) {
    const Model<Rational> moved_model = frame(rest, *motion, k, 8);
    const Rational phase = frame_phase(motion->pace, k, 8);
    EXPECT_TRUE(moved_model.curves[0].curve.points() == rest.curves[0].curve.points());
    EXPECT_EQ(moved_model.gerbs_curves[0].dimension, 3);
    EXPECT_TRUE(moved_model.gerbs_curves[0].curve.locals() ==
                moved(rest.gerbs_curves[0].curve, motion->curves[0], phase).locals());
    EXPECT_TRUE(moved_model.gerbs_patches[0].surface.local(1, 1) ==
                moved(rest.gerbs_patches[0].surface, motion->patches[0], phase).local(1, 1));
    const std::string text = write_model_json(moved_model);
    const auto again = read_model_text(text, "frame.json");
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(write_model_json(std::get<Model<Rational>>(again->model)), text);
  }
}

}  // namespace
}  // namespace patchproof
