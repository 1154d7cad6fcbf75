// SPDX-License-Identifier: Apache-2.0
#include "trimmed_loops.h"

#include <algorithm>
#include <cmath>

#include "cells.h"

namespace patchproof {
namespace {

SurfacePieces coordinate(const BsplineCurve<Rational, 3>& curve, std::size_t c) {
  std::vector<Vec<Rational, 4>> net;
  for (const Vec<Rational, 3>& p : curve.points())
    for (int twice = 0; twice < 2; ++twice) net.push_back({{p[c], Rational(0), Rational(0), p[2]}});
  const auto line = KnotVector<Rational>::make_unchecked(1, {Rational(0), Rational(0), Rational(1), Rational(1)});
  return SurfacePieces::of(BsplinePatch<Rational, 4>(curve.knots(), line, std::move(net)), PieceParameters::knots);
}

}  // namespace

ParameterCurve::ParameterCurve(const BsplineCurve<Rational, 3>& curve)
    : coordinates_{coordinate(curve, 0), coordinate(curve, 1)},
      begin_(nearest_double(curve.knots().domain_begin())),
      end_(nearest_double(curve.knots().domain_end())) {}

Vec<Interval, 2> ParameterCurve::at(double t) const {
  return {{coordinates_[0].point(t, 0)[0], coordinates_[1].point(t, 0)[0]}};
}

std::array<double, 2> ParameterCurve::bend(double a, double b) const {
  const ParameterBox<double> box{a, b, 0, 1};
  return {coordinates_[0].bound(box).chord(b - a, 0), coordinates_[1].bound(box).chord(b - a, 0)};
}

Vec<double, 2> middle(const Vec<Interval, 2>& p) {
  const Vec<double, 3> m = middle(Vec<Interval, 3>{{p[0], p[1], Interval(0)}});
  return {{m[0], m[1]}};
}

std::optional<std::vector<Joint>> close_loops(const std::vector<DirectedUse>& uses, const std::array<double, 2>& size) {
  struct Pair {
    double distance;
    std::size_t end, begin;
  };
  const std::size_t n = uses.size();
  std::vector<Joint> out(n);
  std::vector<bool> ended(n), begun(n);
  const auto match = [&](bool gap, auto distance, auto limit) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        if (ended[i] || begun[j]) continue;
        const double d = distance(uses[i], uses[j]);
        if (d <= limit(uses[i], uses[j])) pairs.push_back({d, i, j});
      }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    for (const Pair& p : pairs) {
      if (ended[p.end] || begun[p.begin]) continue;
      ended[p.end] = begun[p.begin] = true;
      out[p.end] = {static_cast<int>(p.begin), gap};
    }
  };
  const auto in_plane = [&](const DirectedUse& a, const DirectedUse& b) {
    return std::hypot((a.end[0] - b.begin[0]) / size[0], (a.end[1] - b.begin[1]) / size[1]);
  };
  const auto in_space = [](const DirectedUse& a, const DirectedUse& b) {
    return std::hypot(a.to[0] - b.from[0], a.to[1] - b.from[1], a.to[2] - b.from[2]);
  };
  constexpr double kSamePlace = 1e-5;  // of the domain; what the difference does to the mesh is measured
  match(false, in_plane, [](const DirectedUse&, const DirectedUse&) { return kSamePlace; });
  match(true, in_space, [](const DirectedUse& a, const DirectedUse& b) { return 2 * (a.tolerance + b.tolerance); });
  if (std::find(ended.begin(), ended.end(), false) != ended.end()) return std::nullopt;
  return out;
}

}  // namespace patchproof
