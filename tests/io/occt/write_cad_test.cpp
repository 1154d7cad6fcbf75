// SPDX-License-Identifier: Apache-2.0
// Models written as STEP, IGES and BREP, and read again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/io_support.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/write.h"

namespace patchproof::test {
namespace {

using Patch = BsplinePatch<Rational, 4>;

class WriteCad : public ::testing::Test {
 protected:
  WriteCad() : folder_(std::filesystem::temp_directory_path() / ("write_cad_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~WriteCad() override { std::filesystem::remove_all(folder_); }

  CadModel read_back(const WrittenModel& written, const std::string& name) const {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << written.bytes;
    Result<CadModel> model = read_cad_model(path.string());
    if (!model) throw std::runtime_error(model.error().text());
    return std::move(*model);
  }

 private:
  std::filesystem::path folder_;
};

Model<Rational> model_of(const std::string& patches, const std::string& more = R"("units":"mm",)") {
  return rational_model(read_good(R"({"format":"patchproof-model","version":1,)" + more + patches + "}", "m.json"));
}

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(), [&](const auto& n) { return n.find(text) != std::string::npos; });
}

// Knots, weights and points in space: as doubles the same, or apart by so many units in the last place.
void expect_same(const Patch& a, const Patch& b, double units = 0) {
  for (const Direction d : {Direction::u, Direction::v}) {
    ASSERT_EQ(a.knots(d).knots().size(), b.knots(d).knots().size());
    for (std::size_t i = 0; i < a.knots(d).knots().size(); ++i)
      EXPECT_NEAR(nearest_double(a.knots(d)[i]), nearest_double(b.knots(d)[i]), units * 1e-15);
  }
  ASSERT_EQ(a.net().size(), b.net().size());
  for (std::size_t i = 0; i < a.net().size(); ++i) {
    const auto& p = a.net()[i];
    const auto& q = b.net()[i];
    const auto expect_near = [&](const Rational& x, const Rational& y) {
      const double value = nearest_double(x);
      EXPECT_NEAR(value, nearest_double(y), units * 1e-15 * std::max(1.0, std::abs(value)));
    };
    expect_near(p[3], q[3]);
    for (int c = 0; c < 3; ++c) expect_near(p[c] / p[3], q[c] / q[3]);
  }
}

Model<Rational> random_model(unsigned seed) {
  std::mt19937 random(seed);
  const auto fraction = [&](int low, int high) {
    return Rational(static_cast<int>(random() % static_cast<unsigned>(high - low)) + low) / Rational(997);
  };
  Model<Rational> model;
  model.units = "mm";
  for (int k = 0; k < 4; ++k) {
    const bool rational = k % 2 == 1;
    const auto u = KnotVector<Rational>::make(2, {Rational(0), Rational(0), Rational(0), Rational(1) / Rational(3),
                                                  Rational(1), Rational(1), Rational(1)})
                       .value();
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Rational w = rational ? fraction(500, 2000) : Rational(1);
        const Vec<Rational, 3> p{
            {Rational(i) + fraction(-300, 300), Rational(j) + fraction(-300, 300), fraction(-500, 500)}};
        net.push_back({{p[0] * w, p[1] * w, p[2] * w, w}});
      }
    model.patches.push_back({"patch " + std::to_string(k),
                             Patch::make(u, KnotVector<Rational>::bezier(3), std::move(net)).value(), rational});
  }
  return model;
}

TEST_F(WriteCad, SurfacesComeBackWithTheSameDoubles) {
  for (const auto& [format, name, units] : {std::tuple(CadFormat::step, "m.step", 0.0),
                                            {CadFormat::brep, "m.brep", 0.0},
                                            {CadFormat::iges, "m.iges", 10.0}}) {
    const Model<Rational> model = random_model(20261122);
    const WrittenModel written = write_model_cad(model, format).value();
    EXPECT_TRUE(mentions(written.notes, "rounded to the nearest double"));
    const CadModel back = read_back(written, name);
    ASSERT_EQ(back.faces.size(), model.patches.size()) << name;
    for (std::size_t k = 0; k < model.patches.size(); ++k) {
      SCOPED_TRACE(name + std::to_string(k));
      expect_same(model.patches[k].surface, back.faces[k].surface, units);
    }
  }
}

TEST_F(WriteCad, NamesAreKeptInStepOnly) {
  Model<Rational> model = random_model(7);
  model.patches[1].name = "it's #5 \\ \n \u00e9 end');";
  const WrittenModel step = write_model_cad(model, CadFormat::step).value();
  const CadModel back = read_back(step, "m.step");
  EXPECT_NE(back.faces[0].label.find("'patch 0'"), std::string::npos) << back.faces[0].label;
  EXPECT_NE(back.faces[1].label.find("it?s #5 \\ ? ? end?);"), std::string::npos) << back.faces[1].label;
  EXPECT_TRUE(mentions(step.notes, "printable ASCII"));
  EXPECT_FALSE(mentions(step.notes, "names left out"));
  EXPECT_TRUE(mentions(write_model_cad(model, CadFormat::brep).value().notes, "4 names left out"));
}

const std::string kSquare = R"("patches":[{"degree":[1,1],"control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]}])";

TEST_F(WriteCad, LengthsAreMillimetres) {
  const auto far_corner = [&](const std::string& units, CadFormat format, const std::string& name) {
    const Model<Rational> model = model_of(kSquare, units.empty() ? "" : "\"units\":\"" + units + "\",");
    const WrittenModel written = write_model_cad(model, format).value();
    EXPECT_EQ(mentions(written.notes, "millimetres"), units != "mm" && format != CadFormat::brep) << units;
    return nearest_double(read_back(written, name).faces[0].surface.net()[2][0]);
  };
  EXPECT_EQ(far_corner("mm", CadFormat::step, "a.step"), 1);
  EXPECT_EQ(far_corner("inch", CadFormat::step, "b.step"), 25.4);
  EXPECT_EQ(far_corner("m", CadFormat::iges, "c.iges"), 1000);
  EXPECT_EQ(far_corner("parsec", CadFormat::step, "d.step"), 1);
  EXPECT_EQ(far_corner("", CadFormat::step, "e.step"), 1);
  EXPECT_EQ(far_corner("inch", CadFormat::brep, "f.brep"), 1);
}

TEST_F(WriteCad, PolesSeamsAndUnclampedKnots) {
  // A cone with a collapsed edge, a quarter of a cylinder with open knots.
  const Model<Rational> model = model_of(R"("patches":[
    {"degree":[1,1],"control_points":[[[0,0,0],[0,0,0]],[[1,0,0],[1,1,0]]]},
    {"degree":[2,1],"knots":[[0,1,2,3,4,5],[0,0,1,1]],
     "control_points":[[[0,0,0],[0,0,1]],[[1,1,0],[1,1,1]],[[2,0,0],[2,0,1]]]}])");
  const CadModel back = read_back(write_model_cad(model, CadFormat::step).value(), "m.step");
  ASSERT_EQ(back.faces.size(), 2u);
  expect_same(model.patches[0].surface, back.faces[0].surface);
  // The second is clamped: over [2, 3] it is the same surface.
  const Patch& clamped = back.faces[1].surface;
  EXPECT_EQ(clamped.knots(Direction::u).domain_begin(), Rational(2));
  EXPECT_EQ(clamped.knots(Direction::u).domain_end(), Rational(3));
  EXPECT_EQ(clamped.net()[0], (Vec<Rational, 4>{{exact("1/2"), exact("1/2"), Rational(0), Rational(1)}}));
  EXPECT_EQ(clamped.net()[2], (Vec<Rational, 4>{{Rational(1), Rational(1), Rational(0), Rational(1)}}));
}

TEST_F(WriteCad, WhatOpenCascadeCannotHoldIsRefused) {
  const auto error_of = [](const Model<Rational>& model) {
    const Result<WrittenModel> written = write_model_cad(model, CadFormat::step);
    return written ? std::string("none") : written.error().text();
  };
  EXPECT_NE(error_of({}).find("at least one"), std::string::npos);
  const std::string weight = error_of(model_of(R"("patches":[{"degree":[2,1],
    "control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]]],"weights":[[1,1],["-1/2","-1/2"],[1,1]]}])"));
  EXPECT_NE(weight.find("patch 0"), std::string::npos) << weight;
  EXPECT_NE(weight.find("weights are positive"), std::string::npos) << weight;
  EXPECT_NE(error_of(model_of(R"("patches":[{"degree":[1,1],"knots":[[0,0,1,1,2,2],[0,0,1,1]],
    "control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]],[[1,0,1],[1,1,1]],[[2,0,0],[2,1,0]]]}])"))
                .find("jump"),
            std::string::npos);
  EXPECT_NE(error_of(model_of(R"("curves":[{"degree":0,"control_points":[[0,0]]}])")).find("curve 0"),
            std::string::npos);
  std::string points;
  for (int i = 0; i <= 26; ++i) points += (i ? ",[" : "[") + std::to_string(i) + ",0]";
  EXPECT_NE(error_of(model_of(R"("curves":[{"degree":26,"control_points":[)" + points + "]}]")).find("degrees"),
            std::string::npos);
}

TEST_F(WriteCad, CurvesAreEdges) {
  const WrittenModel written =
      write_model_cad(model_of(R"("curves":[{"name":"c","degree":2,"control_points":[[0,0],[1,0.5],[2,0]]}])"),
                      CadFormat::step)
          .value();
  EXPECT_NE(written.bytes.find("B_SPLINE_CURVE_WITH_KNOTS"), std::string::npos);
  EXPECT_NE(written.bytes.find("GEOMETRIC_CURVE_SET('c'"), std::string::npos);
}

}  // namespace
}  // namespace patchproof::test
