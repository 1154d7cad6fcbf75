// SPDX-License-Identifier: Apache-2.0
// The corpus: surfaces and curves made of doubles, and parameters, at which every kernel is held against the exact value.
//
// Ordinary ones (random, each degree from 1 to 9) and hard ones, in groups named after what makes them hard. Each case
// has among its parameters both ends of the domain, knots, and the doubles next to these.
//
// ENSURES  (1) the same options give the same corpus on every machine;  (2) knots, points and weights are finite, the
//          knots are legal, all parameters lie in the domain;  (3) every denominator is proven to have no zero.
// TEST     tests/validation/corpus_test.cpp checks (1)–(3).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::validation {

struct SurfaceCase {
  std::string group, name;
  int degree_u = 0, degree_v = 0;
  std::vector<double> knots_u, knots_v, points, weights;
  std::vector<double> u, v;            // scattered: item i at (u[i], v[i])
  std::vector<double> grid_u, grid_v;  // increasing
  Side side = Side::right;             // in both directions

  SurfaceData data() const { return {degree_u, degree_v, knots_u, knots_v, points, weights}; }
};

struct CurveCase {
  std::string group, name;
  int degree = 0;
  std::vector<double> knots, points, weights;
  std::vector<double> t;
  Side side = Side::right;

  CurveData data() const { return {degree, knots, points, weights}; }
};

struct CorpusOptions {
  std::uint64_t seed = 1;
  int count = 12;          // parameters of a surface or curve, besides the special ones
  std::string group = {};  // only this one; empty: all
};

// What makes the cases of a group hard, in one line each, in the order of the corpus.
struct Group {
  const char* name;
  const char* what;
};
const std::vector<Group>& groups();

std::vector<SurfaceCase> surface_cases(const CorpusOptions& options);
std::vector<CurveCase> curve_cases(const CorpusOptions& options);

}  // namespace patchproof::validation
