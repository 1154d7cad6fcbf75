// SPDX-License-Identifier: Apache-2.0
// Laws 3 and 4 of include/patchproof/io/write.h: .g2.
#include <gtest/gtest.h>

#include <random>

#include "io/io_support.h"
#include "patchproof/io/write.h"

namespace patchproof::test {
namespace {

WrittenModel g2_of(const ModelFile& file) {
  return std::visit([](const auto& model) { return write_model_g2(model).value(); }, file.model);
}

ModelFile one_patch(const std::string& members) {
  return read_good(R"({"format":"patchproof-model","version":1,"patches":[{"degree":[1,1],)" + members + "}]}",
                   "m.json");
}
const std::string kNet = R"("control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,X]]])";
ModelFile with(const std::string& number) {
  std::string net = kNet;
  return one_patch(net.replace(net.find('X'), 1, number));
}

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(), [&](const auto& n) { return n.find(text) != std::string::npos; });
}

// Without names, units and joins, which .g2 does not hold, and in the order of a .g2 file.
template <class T>
Model<T> bare(Model<T> model) {
  model.units.clear();
  model.joins.clear();
  model.solids.clear();
  for (auto& patch : model.patches) patch.name.clear();
  for (auto& curve : model.curves) curve.name.clear();
  return model;
}

// The nearest doubles of all numbers: curves first, as .g2 has them.
template <class T>
std::vector<double> doubles_of(const Model<T>& model) {
  std::vector<double> out;
  const auto add = [&](const auto& numbers) {
    for (const auto& x : numbers) out.push_back(nearest_double(x));
  };
  const auto add_points = [&](const auto& points) {
    for (const auto& p : points)
      for (int c = 0; c < 4; ++c) out.push_back(nearest_double(p[c]));
  };
  for (const auto& c : model.curves) add(c.curve.knots().knots()), add_points(c.curve.points());
  for (const auto& p : model.patches) {
    for (const Direction d : {Direction::u, Direction::v}) add(p.surface.knots(d).knots());
    add_points(p.surface.net());
  }
  return out;
}

TEST(WriteDoubles, Law3_GoodFilesComeBackWithTheSameDoubles) {
  int unchanged = 0, rounded = 0;
  for (const auto& path : good_files()) {
    const ModelFile file = read_good(bytes_of(path), path.string());
    const WrittenModel written = g2_of(file);
    const ModelFile back = read_good(written.bytes, "back.g2");
    std::visit([&](const auto& model) { EXPECT_EQ(doubles_of(model), doubles_of(rational_model(back))) << path; },
               file.model);
    if (mentions(written.notes, "numbers are")) {
      ++rounded;
    } else {
      ++unchanged;
      EXPECT_TRUE(same(bare(rational_model(file)), rational_model(back))) << path;
    }
  }
  EXPECT_GE(unchanged, 5);
  EXPECT_GE(rounded, 3);
}

TEST(WriteDoubles, Law3_ShortDecimalsStayExact) {
  for (const char* number : {"0.1", "-2.5", "1e-7", "0.123456789012345", "123456789", "0", "\"1/8\"", "\"0x1.8p-1\""}) {
    const ModelFile file = with(number);
    const WrittenModel written = g2_of(file);
    EXPECT_TRUE(written.notes.empty()) << number;
    EXPECT_TRUE(same(rational_model(file), rational_model(read_good(written.bytes, "b.g2")))) << number;
  }
}

TEST(WriteDoubles, Law3_LongNumbersHaveSeventeenDigitsAndANote) {
  const WrittenModel third = g2_of(with("\"1/3\""));
  EXPECT_NE(third.bytes.find("0.33333333333333331"), std::string::npos);
  EXPECT_TRUE(mentions(third.notes, "1 of 20 numbers are rounded to the nearest double"));
  const WrittenModel root = g2_of(with("\"sqrt(2)\""));
  EXPECT_NE(root.bytes.find("1.4142135623730951"), std::string::npos);
  EXPECT_TRUE(mentions(root.notes, "rounded"));
  // A double with a long decimal.
  const WrittenModel tenth = g2_of(with("\"0x1.999999999999ap-4\""));
  EXPECT_TRUE(mentions(tenth.notes, "doubles whose decimals are longer"));
  EXPECT_FALSE(mentions(tenth.notes, "rounded"));
  const ModelFile back = read_good(tenth.bytes, "b.g2", Decimals::binary64);
  EXPECT_EQ(rational_model(back).patches[0].surface.net().back()[2], exact("0x1.999999999999ap-4"));
}

TEST(WriteDoubles, Law3_RandomDoublesComeBack) {
  std::mt19937_64 random(20261122);
  std::uniform_int_distribution<long> mantissa(-(1L << 53), 1L << 53);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int k = 0; k < 200; ++k) {
    const double x = std::ldexp(static_cast<double>(mantissa(random)), exponent(random));
    const ModelFile file = with("\"" + to_text(from_double(x)) + "\"");
    const ModelFile back = read_good(g2_of(file).bytes, "b.g2", Decimals::binary64);
    EXPECT_TRUE(same(rational_model(file), rational_model(back))) << x;
  }
}

TEST(WriteDoubles, Law4_WhatIsLeftOutIsSaid) {
  const ModelFile file = read_good(
      R"({"format":"patchproof-model","version":1,"units":"mm","patches":[
        {"name":"a","degree":[1,1],"control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
        {"degree":[1,1],"control_points":[[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]]]}],
        "curves":[{"degree":1,"control_points":[[0,0],[1,1]]}],
        "joins":[{"a":{"patch":0,"edge":"u_max"},"b":{"patch":1,"edge":"u_min"}}]})",
      "m.json");
  const WrittenModel written = g2_of(file);
  EXPECT_TRUE(mentions(written.notes, "1 declared join left out"));
  EXPECT_TRUE(mentions(written.notes, "1 name left out"));
  EXPECT_TRUE(mentions(written.notes, "units mm left out"));
  EXPECT_EQ(written.notes.size(), 3u);
  EXPECT_TRUE(same(bare(rational_model(file)), rational_model(read_good(written.bytes, "b.g2"))));
}

TEST(WriteDoubles, Law4_GeometryThatWouldChangeIsAnError) {
  const auto error_of = [](const ModelFile& file) {
    const Result<WrittenModel> written = write_model_g2(rational_model(file));
    return written ? std::string("none") : written.error().text();
  };
  const ModelFile merged = one_patch(
      R"("knots":[[0,0,"1/3","333333333333333333334/1000000000000000000001",1,1],[0,0,1,1]],
         "control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]],[[3,0,0],[3,1,0]]])");
  const std::string text = error_of(merged);
  EXPECT_NE(text.find("patch 0"), std::string::npos) << text;
  EXPECT_NE(text.find("two knots"), std::string::npos) << text;
  EXPECT_NE(error_of(with("\"1e-400\"")).find("too small"), std::string::npos);
  EXPECT_EQ(error_of(with("\"1e-300\"")), "none");
  EXPECT_FALSE(write_model_g2(Model<Rational>{}));
}

}  // namespace
}  // namespace patchproof::test
