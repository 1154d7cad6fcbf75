// SPDX-License-Identifier: Apache-2.0
// Least-squares fits found by an independent program in fractions (validation/vectors/least_squares.json): equal in exact
// numbers, and within the proven bounds in doubles.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "patchproof/spline/fit_double.h"
#include "patchproof/spline/sample_parameters.h"

namespace patchproof {
namespace {

const std::filesystem::path kRoot = PATCHPROOF_SOURCE_DIR;

struct Fit {
  std::string name;
  KnotVector<Rational> knots;
  CurveSamples<Rational, 2> samples;
  std::vector<Vec<Rational, 2>> controls;
  std::vector<std::vector<Rational>> collocation;
};

std::vector<Rational> numbers(const nlohmann::json& texts) {
  std::vector<Rational> out;
  for (const std::string& text : texts.get<std::vector<std::string>>())
    out.push_back(parse_scalar<Rational>(text).value());
  return out;
}

std::vector<Vec<Rational, 2>> points(const nlohmann::json& rows) {
  std::vector<Vec<Rational, 2>> out;
  for (const nlohmann::json& row : rows) {
    const std::vector<Rational> x = numbers(row);
    out.push_back({{x.at(0), x.at(1)}});
  }
  return out;
}

const std::vector<Fit>& fits() {
  static const std::vector<Fit> all = [] {
    std::ifstream in(kRoot / "validation/vectors/least_squares.json");
    std::vector<Fit> out;
    const nlohmann::json document = nlohmann::json::parse(in);
    for (const nlohmann::json& fit : document.at("fits")) {
      std::vector<std::vector<Rational>> collocation;
      if (fit.contains("collocation"))
        for (const nlohmann::json& row : fit.at("collocation")) collocation.push_back(numbers(row));
      out.push_back({fit.at("name"),
                     KnotVector<Rational>::make(fit.at("degree"), numbers(fit.at("knots"))).value(),
                     {numbers(fit.at("parameters")), points(fit.at("samples"))},
                     points(fit.at("controls")),
                     std::move(collocation)});
    }
    return out;
  }();
  return all;
}

TEST(LeastSquaresVectors, KnotsAndParametersAreUniform) {
  ASSERT_EQ(fits().size(), 2u);
  for (const Fit& fit : fits()) {
    SCOPED_TRACE(fit.name);
    EXPECT_EQ(uniform_clamped_knots<Rational>(fit.knots.degree(), fit.knots.control_count()).value(), fit.knots);
    EXPECT_EQ(uniform_parameters(fit.samples.points.size(), fit.knots.domain_begin(), fit.knots.domain_end()).value(),
              fit.samples.parameters);
  }
}

TEST(LeastSquaresVectors, ExactControlPointsAreEqual) {
  for (const Fit& fit : fits()) {
    SCOPED_TRACE(fit.name);
    EXPECT_EQ(fit_curve(fit.knots, fit.samples).value().points(), fit.controls);
  }
}

TEST(LeastSquaresVectors, TheCollocationMatrixIsEqual) {
  int compared = 0;
  for (const Fit& fit : fits())
    for (std::size_t a = 0; a < fit.collocation.size(); ++a, ++compared)
      EXPECT_EQ(basis(fit.knots, fit.samples.parameters[a]), fit.collocation[a]) << fit.name << ", row " << a;
  EXPECT_EQ(compared, 9);
}

TEST(LeastSquaresVectors, DoublesStayWithinTheirBounds) {
  for (const Fit& fit : fits()) {
    SCOPED_TRACE(fit.name);
    const auto found = fit_curve_double(fit.knots, fit.samples).value();
    ASSERT_TRUE(found.is_certified());
    EXPECT_LT(found.largest_error(), 1e-12);
    for (std::size_t j = 0; j < fit.controls.size(); ++j)
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_LE(abs(Rational(from_double(found.curve.points()[j][c]) - fit.controls[j][c])),
                  from_double(found.errors[j][c]));
  }
}

}  // namespace
}  // namespace patchproof
