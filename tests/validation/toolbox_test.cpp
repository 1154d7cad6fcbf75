// SPDX-License-Identifier: Apache-2.0
// Values and derivatives of the curves and surfaces of examples/toolbox, found by an independent program in fractions
// (validation/vectors/toolbox.json): equal in exact numbers, enclosed by intervals, and missed by doubles by no more than
// the error that Tracked bounds.
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "patchproof/io/read.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/tracked.h"

namespace patchproof {

// The nearest double, and one unit in its last place.
template <>
struct embedding<Tracked, Quadratic> {
  static Tracked apply(const Quadratic& x) {
    const double v = embed<double>(x);
    return Tracked(v, Quadratic(from_double(v)) == x ? 0.0 : std::fabs(v) * 0x1p-52);
  }
};

namespace {

const std::filesystem::path kRoot = PATCHPROOF_SOURCE_DIR;

const ModelFile& model_file(const std::string& name) {
  static std::map<std::string, ModelFile> read;
  const auto found = read.find(name);
  if (found != read.end()) return found->second;
  return read.emplace(name, read_model((kRoot / "examples/toolbox" / name).string()).value()).first->second;
}

struct Vector {
  std::string model;
  bool is_curve;
  std::size_t index;
  std::vector<std::string> at;
  Side side;
  bool outside;  // the parameters are: an error is expected
  struct Value {
    std::vector<int> order;
    std::vector<std::string> numbers;
  };
  std::vector<Value> values;
  std::string text;
};

const std::vector<Vector>& vectors() {
  static const std::vector<Vector> all = [] {
    std::ifstream in(kRoot / "validation/vectors/toolbox.json");
    const nlohmann::json document = nlohmann::json::parse(in);
    std::vector<Vector> out;
    for (const nlohmann::json& row : document.at("vectors")) {
      Vector v;
      v.model = row.at("model");
      v.is_curve = row.contains("curve");
      v.index = row.at(v.is_curve ? "curve" : "patch");
      v.at = row.at("at").get<std::vector<std::string>>();
      v.side = row.value("side", "right") == "left" ? Side::left : Side::right;
      v.outside = row.contains("error");
      if (v.outside && row.at("error") != to_string(ErrorCode::outside_domain)) throw std::runtime_error(row.dump());
      for (const nlohmann::json& value : row.value("values", nlohmann::json::array()))
        v.values.push_back({value.at("order"), value.at("value")});
      v.text = row.dump();
      out.push_back(std::move(v));
    }
    return out;
  }();
  return all;
}

// All derivatives up to second order of the piece at that place, in R: {order} or {order in u, order in v}.
template <Ring R, ExactField T>
std::map<std::vector<int>, Vec<R, 3>> derivatives_of(const BsplineCurve<T, 4>& curve, const Vector& v,
                                                     const std::vector<T>& at) {
  const int span = curve.knots().find_span(at[0], v.side);
  std::vector<Vec<R, 4>> homogeneous;
  for (int k = 0; k <= 2; ++k) homogeneous.push_back(derivative_in_span<R>(curve, span, embed<R>(at[0]), k));
  const std::vector<Vec<R, 3>> affine = rational_derivatives(homogeneous);
  return {{{0}, affine[0]}, {{1}, affine[1]}, {{2}, affine[2]}};
}

template <Ring R, ExactField T>
std::map<std::vector<int>, Vec<R, 3>> derivatives_of(const BsplinePatch<T, 4>& patch, const Vector& v,
                                                     const std::vector<T>& at) {
  const int span_u = patch.knots(Direction::u).find_span(at[0], v.side),
            span_v = patch.knots(Direction::v).find_span(at[1], v.side);
  const auto affine = rational_derivatives(
      partial_derivatives_in_span<R>(patch, span_u, span_v, embed<R>(at[0]), embed<R>(at[1]), 2, 2));
  std::map<std::vector<int>, Vec<R, 3>> out;
  for (int k = 0; k <= 2; ++k)
    for (int l = 0; k + l <= 2; ++l) out.emplace(std::vector<int>{k, l}, affine.at(k, l));
  return out;
}

// Calls check(computed number, exact number), and counts the numbers.
template <Ring R, ExactField T, class Check>
long check_vector(const Model<T>& model, const Vector& v, Check check) {
  std::vector<T> at;
  for (const std::string& text : v.at) at.push_back(parse_scalar<T>(text).value());
  const auto computed = v.is_curve ? derivatives_of<R>(model.curves.at(v.index).curve, v, at)
                                   : derivatives_of<R>(model.patches.at(v.index).surface, v, at);
  long count = 0;
  for (const Vector::Value& value : v.values)
    for (std::size_t c = 0; c < value.numbers.size(); ++c, ++count)
      check(computed.at(value.order)[c], parse_scalar<T>(value.numbers[c]).value());
  return count;
}

// Over all vectors that have a value; check is a template on the exact number.
template <Ring R, class Check>
long check_all(Check check) {
  long count = 0;
  for (const Vector& v : vectors()) {
    if (v.outside) continue;
    SCOPED_TRACE(v.text);
    count += std::visit([&](const auto& model) { return check_vector<R>(model, v, check); }, model_file(v.model).model);
  }
  return count;
}

TEST(Toolbox, ExactNumbersAreEqual) {
  long count = 0;
  for (const Vector& v : vectors()) {
    if (v.outside) continue;
    SCOPED_TRACE(v.text);
    count += std::visit(
        [&]<ExactField T>(const Model<T>& model) {
          return check_vector<T>(model, v,
                                 [](const T& x, const T& expected) { EXPECT_EQ(to_text(x), to_text(expected)); });
        },
        model_file(v.model).model);
  }
  EXPECT_GT(count, 3000);
}

TEST(Toolbox, IntervalsEnclose) {
  const RoundingGuard guard;
  const long count = check_all<Interval>([]<ExactField T>(const Interval& x, const T& expected) {
    EXPECT_LE(T(from_double(x.inf())), expected);
    EXPECT_LE(expected, T(from_double(x.sup())));
    EXPECT_LE(x.sup() - x.inf(), 1e-10 * (1 + std::fabs(x.sup())));
  });
  EXPECT_GT(count, 3000);
}

// Tracked computes what double computes, bit by bit, and bounds how far that is from the exact number.
TEST(Toolbox, DoublesStayWithinTheirBounds) {
  std::vector<double> doubles;
  check_all<double>([&](double x, const auto&) { doubles.push_back(x); });
  std::size_t next = 0;
  long wrong_last_place = 0;
  check_all<Tracked>([&]<ExactField T>(const Tracked& x, const T& expected) {
    const double plain = doubles.at(next++);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(x.value()), std::bit_cast<std::uint64_t>(plain));
    ASSERT_TRUE(std::isfinite(plain) && std::isfinite(x.error()));
    const T distance = expected - T(from_double(plain)), bound = T(from_double(x.error()));
    EXPECT_TRUE(distance <= bound && -distance <= bound)
        << plain << " +- " << x.error() << " for " << to_text(expected);
    EXPECT_LE(x.error(), 1e-10 * (1 + std::fabs(plain)));
    wrong_last_place += distance == T(0) ? 0 : 1;
  });
  EXPECT_EQ(next, doubles.size());
  EXPECT_GT(wrong_last_place, 100);  // the bounds are put to work
}

TEST(Toolbox, ParametersOutsideTheDomain) {
  int count = 0;
  for (const Vector& v : vectors()) {
    if (!v.outside) continue;
    const auto& curve = std::get<Model<Rational>>(model_file(v.model).model).curves.at(v.index).curve;
    EXPECT_FALSE(curve.knots().in_domain(parse_scalar<Rational>(v.at.at(0)).value())) << v.text;
    ++count;
  }
  EXPECT_GT(count, 3);
}

// The sides matter: read from the other side of its knots, test12's third curve has other values.
TEST(Toolbox, TheOtherSideIsNoticed) {
  long different = 0;
  for (Vector v : vectors()) {
    if (v.outside || v.model != "test12.json" || v.index != 2 || v.at[0] != "1") continue;
    v.side = v.side == Side::left ? Side::right : Side::left;
    check_vector<Rational>(std::get<Model<Rational>>(model_file(v.model).model), v,
                           [&](const Rational& x, const Rational& expected) { different += x == expected ? 0 : 1; });
  }
  EXPECT_GT(different, 4);
}

// Every curve and surface has vectors, but for the two models that only carry the knots of a basis.
TEST(Toolbox, NothingIsLeftOut) {
  std::set<std::tuple<std::string, bool, std::size_t>> covered;
  for (const Vector& v : vectors()) covered.emplace(v.model, v.is_curve, v.index);
  int models = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "examples/toolbox")) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().filename().string();
    ++models;
    // Knots for their functions (spline/reference_basis_test.cpp), and the solid (io/solids_test.cpp).
    if (name == "test04.json" || name == "bernstein_3.json" || name == "solid.json") continue;
    std::visit(
        [&](const auto& model) {
          for (std::size_t i = 0; i < model.curves.size(); ++i)
            EXPECT_TRUE(covered.contains({name, true, i})) << name << ", curve " << i;
          for (std::size_t i = 0; i < model.patches.size(); ++i)
            EXPECT_TRUE(covered.contains({name, false, i})) << name << ", patch " << i;
        },
        model_file(name).model);
  }
  EXPECT_GE(models, 20);
}

}  // namespace
}  // namespace patchproof
