// SPDX-License-Identifier: Apache-2.0
#include "validation/corpus/workloads.h"

#include <algorithm>

#include "validation/corpus/random.h"

namespace patchproof::validation {
namespace {

std::vector<double> uneven_knots(int degree, int count, Random& random) {
  std::vector<double> lengths(count - degree), knots(degree + 1, 0.0);
  double sum = 0, at = 0;
  for (double& l : lengths) sum += l = random.between(0.3, 1.8);
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i) knots.push_back((at += lengths[i]) / sum);
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

SurfaceCase surface(const char* name, int degree, int count, bool rational, std::uint64_t seed) {
  Random random(seed);
  SurfaceCase s;
  s.group = s.name = name;
  s.degree_u = s.degree_v = degree;
  s.knots_u = uneven_knots(degree, count, random);
  s.knots_v = uneven_knots(degree, count, random);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      for (const double x : {i + random.between(-0.3, 0.3), j + random.between(-0.3, 0.3), random.between(-2, 2)})
        s.points.push_back(x);
      if (rational) s.weights.push_back(random.between(0.5, 2));
    }
  return s;
}

CurveCase curve(const char* name, int degree, int count, bool rational, std::uint64_t seed) {
  Random random(seed);
  CurveCase c;
  c.group = c.name = name;
  c.degree = degree;
  c.knots = uneven_knots(degree, count, random);
  for (int i = 0; i < count; ++i) {
    for (const double x : {0.2 * i + random.between(-0.3, 0.3), random.between(-1, 1), random.between(-1, 1)})
      c.points.push_back(x);
    if (rational) c.weights.push_back(random.between(0.5, 2));
  }
  return c;
}

}  // namespace

std::vector<SurfaceCase> surface_workloads() {
  return {surface("bezier_3x3", 3, 4, false, 11), surface("bezier_5x5", 5, 6, false, 12),
          surface("bezier_7x7", 7, 8, false, 13), surface("bspline_20x20", 3, 20, false, 14),
          surface("nurbs_20x20", 3, 20, true, 15)};
}

std::vector<CurveCase> curve_workloads() {
  return {curve("curve_100", 3, 100, false, 16), curve("nurbs_curve_100", 3, 100, true, 17)};
}

std::vector<double> random_parameters(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> out(count);
  for (double& t : out) t = random.between(0, 1);
  return out;
}

std::vector<double> even_parameters(std::size_t count) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  return out;
}

std::vector<double> refining_knots(int degree, const std::vector<double>& knots, int count) {
  std::vector<double> breaks(knots.begin() + degree, knots.end() - degree), added;
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  for (int k = 0; k < count; ++k) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
      if (breaks[i + 1] - breaks[i] > breaks[longest + 1] - breaks[longest]) longest = i;
    const double middle = breaks[longest] + (breaks[longest + 1] - breaks[longest]) / 2;
    breaks.insert(breaks.begin() + static_cast<std::ptrdiff_t>(longest) + 1, middle);
    added.push_back(middle);
  }
  std::sort(added.begin(), added.end());
  return added;
}

}  // namespace patchproof::validation
