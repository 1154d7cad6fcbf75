// SPDX-License-Identifier: Apache-2.0
#include "io/svg_layers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace patchproof {
namespace {

constexpr std::size_t kMostCompared = 100;  // curves
constexpr double kStep = 1.5;               // page units: nearer than this, lines of the usual width cover each other
constexpr std::size_t kWhile = 40;          // steps; of a short curve half of it
constexpr double kDash = 9;

using Cell = std::pair<int, int>;

struct Step {
  Cell cell;  // of side kStep
  double length;
};

std::vector<Step> steps_of(const Polyline& line) {
  std::vector<Step> out;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double x = line[k].x - line[k - 1].x, y = line[k].y - line[k - 1].y, length = std::hypot(x, y);
    const int parts = 1 + static_cast<int>(length / kStep);
    for (int j = 0; j < parts; ++j) {
      const double t = (j + 0.5) / parts;
      out.push_back({{static_cast<int>(std::floor((line[k - 1].x + x * t) / kStep)),
                      static_cast<int>(std::floor((line[k - 1].y + y * t) / kStep))},
                     length / parts});
    }
  }
  return out;
}

using Owners = std::map<Cell, std::vector<std::size_t>>;  // which curves pass through a cell

// On how many earlier curves each step lies.
std::vector<int> depths(const std::vector<Step>& steps, const Owners& owners, std::size_t earlier) {
  std::vector<int> out(steps.size(), 0);
  std::vector<std::size_t> run(earlier, 0);  // steps near that curve, up to here
  const std::size_t enough = std::max<std::size_t>(3, std::min(kWhile, steps.size() / 2));
  for (std::size_t s = 0; s <= steps.size(); ++s) {
    std::vector<bool> near(earlier, false);
    if (s < steps.size())
      for (const int dx : {-1, 0, 1})
        for (const int dy : {-1, 0, 1})
          if (const auto at = owners.find({steps[s].cell.first + dx, steps[s].cell.second + dy}); at != owners.end())
            for (const std::size_t k : at->second) near[k] = true;
    for (std::size_t k = 0; k < earlier; ++k) {
      if (near[k]) {
        ++run[k];
        continue;
      }
      if (run[k] >= enough)
        for (std::size_t b = s - run[k]; b < s; ++b) ++out[b];
      run[k] = 0;
    }
  }
  return out;
}

// Dashes and gaps: dashes where nothing lies below run into each other.
std::vector<double> pattern(const std::vector<Step>& steps, const std::vector<int>& depth) {
  std::vector<double> out{0};
  double in_period = 0;
  bool is_gap = false;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const double period = kDash * (1 + depth[s]);
    if (depth[s] == 0 || in_period >= period) in_period = 0;
    const bool wants_gap = depth[s] > 0 && in_period >= kDash;
    if (wants_gap != is_gap) out.push_back(0);
    is_gap = wants_gap;
    out.back() += steps[s].length;
    in_period += steps[s].length;
  }
  if (out.size() == 1) return {};
  if (!is_gap) out.push_back(kDash);  // an even number, the last of which is never reached
  return out;
}

}  // namespace

std::vector<std::vector<std::vector<double>>> dashes_of(const std::vector<std::vector<Polyline>>& curves) {
  std::vector<std::vector<std::vector<double>>> out(curves.size());
  Owners owners;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    out[i].resize(curves[i].size());
    if (curves.size() > kMostCompared) continue;
    std::vector<Cell> own;
    for (std::size_t c = 0; c < curves[i].size(); ++c) {
      const std::vector<Step> steps = steps_of(curves[i][c]);
      out[i][c] = pattern(steps, depths(steps, owners, i));
      for (const Step& step : steps) own.push_back(step.cell);
    }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const Cell& cell : own) owners[cell].push_back(i);
  }
  return out;
}

}  // namespace patchproof
