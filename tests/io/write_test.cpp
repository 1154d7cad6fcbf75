// SPDX-License-Identifier: Apache-2.0
// Laws of include/patchproof/io/write.h.
#include "patchproof/io/write.h"

#include <random>

#include <gtest/gtest.h>

#include "io/io_support.h"

namespace patchproof {
namespace {

template <class T>
void expect_round_trip(const Model<T>& model) {
  const std::string text = write_model_json(model);
  const ModelFile back = test::read_good(text, "written.json");
  ASSERT_TRUE(std::holds_alternative<Model<T>>(back.model));
  EXPECT_TRUE(test::same(std::get<Model<T>>(back.model), model)) << text;
  EXPECT_EQ(write_model_json(std::get<Model<T>>(back.model)), text);
}

TEST(WriteModel, Law1_EveryGoodFileComesBack) {
  for (const auto& path : test::good_files()) {
    SCOPED_TRACE(path.string());
    const ModelFile file = test::read_good(test::bytes_of(path), path.string());
    std::visit([](const auto& model) { expect_round_trip(model); }, file.model);
    if (std::holds_alternative<Model<Quadratic>>(file.model)) continue;  // doubles have no roots
    const ModelFile rounded = test::read_good(test::bytes_of(path), path.string(), Decimals::binary64);
    std::visit([](const auto& model) { expect_round_trip(model); }, rounded.model);
  }
}

class RandomModel {
 public:
  explicit RandomModel(std::uint32_t seed) : random_(seed) {}

  Rational number() {
    const int kind = below(4);
    if (kind == 0) return Rational(below(7) - 3);
    if (kind == 1) return Rational(below(20001) - 10000) / Rational(1000);
    if (kind == 2) return Rational(below(2001) - 1000) / Rational(1 + below(999));
    Rational x = Rational(static_cast<int>(random_() & 0xffffff)) / Rational(1 + below(1000000));
    for (int i = below(6); i > 0; --i) x = x * x;
    return below(2) == 0 ? x : -x;
  }
  Quadratic quadratic() {
    return below(3) == 0 ? Quadratic(number())
                         : Quadratic(number(), Rational(1 + below(9)) / Rational(1 + below(5)), 5);
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)); }

  template <class T, class Number>
  Model<T> model(Number number) {
    Model<T> out;
    out.units = below(2) == 0 ? "mm" : "";
    for (int k = 1 + below(3); k > 0; --k) {
      const KnotVector<T> u = below(2) == 0 ? KnotVector<T>::bezier(1 + below(3)) : knots<T>(1 + below(3));
      const int form =
          below(3);  // plain, rational, rational with a weight of zero (not at a corner: the sum is not zero)
      const KnotVector<T> v = KnotVector<T>::bezier(form == 2 ? 2 : 1 + below(3));
      std::vector<Vec<T, 4>> net;
      bool rational = false;
      for (int i = 0; i < u.control_count() * v.control_count(); ++i) {
        const T w = form == 0 ? T(1) : form == 2 && i == 1 ? T(0) : T(1) / T(1 + below(5));
        rational = rational || !(w == T(1));
        net.push_back({{number(), number(), number(), w}});
      }
      out.patches.push_back(
          {below(2) == 0 ? "" : "a \"name\" with \\, / and √", BsplinePatch<T, 4>(u, v, net), rational});
    }
    for (int k = below(3); k > 0; --k) out.curves.push_back(curve<T>(number));
    out.joins.push_back(
        {below(static_cast<int>(out.patches.size())), 0, EdgeName::v_max, EdgeName::u_min, below(2) == 0});
    return out;
  }

  // In the plane or in space, with or without weights, one of them zero at times.
  template <class T, class Number>
  ModelCurve<T> curve(Number number) {
    const int degree = below(4), form = degree == 2 ? below(3) : below(2), dimension = 2 + below(2);
    const KnotVector<T> t = form == 2 || below(2) == 0 ? KnotVector<T>::bezier(degree) : knots<T>(degree, 3);
    std::vector<Vec<T, 4>> points;
    bool rational = false;
    for (int i = 0; i < t.control_count(); ++i) {
      const T w = form == 0 ? T(1) : form == 2 && i == 1 ? T(0) : T(1) / T(1 + below(5));
      rational = rational || !(w == T(1));
      points.push_back({{number(), number(), dimension == 2 ? T(0) : T(number()), w}});
    }
    return {below(2) == 0 ? "" : "curve", BsplineCurve<T, 4>(t, points), rational, dimension};
  }

 private:
  // `more`: how often an inner knot may stand beyond degree + 1.
  template <class T>
  KnotVector<T> knots(int degree, int more = 0) {
    std::vector<T> out;
    Rational t = Rational(below(100) - 50) / Rational(7);
    for (int i = 0; i < 3; ++i) {
      const int times = i == 1 ? 1 + below(degree + 1 + more) : degree + 1;
      for (int k = 0; k < times; ++k) out.push_back(T(t));
      t += Rational(1 + below(9)) / Rational(1 + below(9));
    }
    return KnotVector<T>::make(degree, out).value();
  }
  std::mt19937 random_;
};

TEST(WriteModel, Law1_RandomRationalModels) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomModel random(seed);
    expect_round_trip(random.model<Rational>([&] { return random.number(); }));
  }
}

TEST(WriteModel, Law1_RandomModelsWithRoots) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    RandomModel random(seed);
    Model<Quadratic> model = random.model<Quadratic>([&] { return random.quadratic(); });
    // At least one root, so that the reader must choose Quadratic.
    std::vector<Vec<Quadratic, 4>> net = model.patches[0].surface.net();
    net[0][0] = Quadratic(Rational(0), Rational(1), 5);
    auto& surface = model.patches[0].surface;
    surface = BsplinePatch<Quadratic, 4>(surface.knots(Direction::u), surface.knots(Direction::v), net);
    expect_round_trip(model);
  }
}

TEST(WriteModel, ShortDecimalsAreWrittenAsNumbers) {
  const auto file =
      test::read_good(test::json_patch("[[[1.4,-0.05,1e3],[0,1,\"1/3\"]],[[1,0,1e-30],[1,1,0.1]]]"), "m.json");
  const std::string text = write_model_json(test::rational_model(file));
  EXPECT_NE(text.find("[1.4, -0.05, 1000], [0, 1, \"1/3\"]"), std::string::npos) << text;
  EXPECT_EQ(text.find("knots"), std::string::npos);
  EXPECT_EQ(text.find("weights"), std::string::npos);
}

// Without patches there is no list of them, and the numbers of a curve in the plane come in pairs.
TEST(WriteModel, CurvesOnly) {
  const auto file = test::read_good(test::json_curve(test::kArc), "m.json");
  const std::string text = write_model_json(test::rational_model(file));
  EXPECT_EQ(text.find("patches"), std::string::npos) << text;
  EXPECT_NE(text.find("\"control_points\": [[0, 0], [1, 1], [2, 0]]"), std::string::npos) << text;
}

TEST(WriteModel, RequiresPlaneCurvesInThePlane) {
  Model<Rational> model;
  model.curves.push_back(
      {"", BsplineCurve<Rational, 4>::bezier({{{Rational(0), Rational(0), Rational(1), Rational(1)}}}), false, 2});
  EXPECT_THROW(write_model_json(model), contract_error);
  model.curves[0].dimension = 3;
  EXPECT_NO_THROW(write_model_json(model));
}

TEST(WriteModel, Law2_SameBytes) {
  RandomModel a(7), b(7);
  EXPECT_EQ(write_model_json(a.model<Rational>([&] { return a.number(); })),
            write_model_json(b.model<Rational>([&] { return b.number(); })));
}

}  // namespace
}  // namespace patchproof
