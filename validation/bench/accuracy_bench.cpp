// SPDX-License-Identifier: Apache-2.0
// What certainty costs: points with a bound, enclosed, in doubled precision and correctly rounded, in cache, beside plain
// points, points from a Bernstein basis (roofline.h) and the plain points of peers.
//   SURFACE/accurate/points|patchproof/SET METHOD      METHOD: plain, bounded, interval, compensated, rounded
//   SURFACE/accurate/points|bernstein/SET              bezier_3x3 only
//   SURFACE/accurate/points|PEER/VARIANT
// Counter: ulp, the worst error in units of the last place of each coordinate (an enclosure: half its width).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <string>

#include "validation/bench/arena.h"
#include "validation/bench/register.h"
#include "validation/bench/roofline.h"
#include "validation/corpus/truth.h"
#include "validation/peers/compare.h"

namespace patchproof::bench {
namespace {

constexpr std::size_t kInCache = 1024, kEach = 7;  // points; every seventh is compared with the exact one

std::span<const double> u() { return random_u().first(kInCache); }
std::span<const double> v() { return random_v().first(kInCache); }

const std::vector<validation::SurfaceCase>& surfaces() {
  static const auto all = validation::surface_workloads();
  return all;
}

// x, y and z of point i at numbers[3·i] …; the largest error of any coordinate, in ulp.
template <class At>
double worst_error(const validation::SurfaceCase& s, At at) {
  const auto patch = validation::exact_patch(s.data());
  double worst = 0;
  for (std::size_t i = 0; i < kInCache; i += kEach) {
    const auto truth = validation::exact_values(patch, u()[i], v()[i], Side::right, 0);
    for (int c = 0; c < 3; ++c) {
      const Rational& exact = truth.vectors[validation::kPoint][c];
      worst = std::max(worst, validation::in_ulps(validation::deviation(at(i, c), exact), exact));
    }
  }
  return worst;
}

void finish(benchmark::State& state, double error) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kInCache));
  state.counters["ulp"] = error;
}

enum class Method { plain, bounded, interval, compensated, rounded };
constexpr std::pair<const char*, Method> kMethods[] = {{"plain", Method::plain},
                                                       {"bounded", Method::bounded},
                                                       {"interval", Method::interval},
                                                       {"compensated", Method::compensated},
                                                       {"rounded", Method::rounded}};

void ours(benchmark::State& state, const validation::SurfaceCase& s, InstructionSet set, Method method) {
  const BatchSurface surface = BatchSurface::make(s.data()).value();
  SurfaceBatchOptions options;
  options.instructions = set;
  double* const to = room().data();
  const VectorArray point = VectorArray::separate(to, to + kInCache, to + 2 * kInCache);
  const VectorArray upper = VectorArray::separate(to + 3 * kInCache, to + 4 * kInCache, to + 5 * kInCache);
  SurfaceOutput points;
  points.point = point;
  const auto run = [&] {
    switch (method) {
      case Method::plain: return surface.evaluate(u(), v(), points, options).has_value();
      case Method::bounded: return surface.evaluate_bounded(u(), v(), point, upper.x, options).has_value();
      case Method::interval: return surface.evaluate_interval(u(), v(), point, upper, options).has_value();
      case Method::compensated: return surface.evaluate_compensated(u(), v(), point, options).has_value();
      case Method::rounded: return surface.evaluate_correctly_rounded(u(), v(), point, options).has_value();
    }
    return false;
  };
  if (!run()) return state.SkipWithError("refused");
  const double error = worst_error(s, [&](std::size_t i, int c) {
    const double low = to[static_cast<std::size_t>(c) * kInCache + i];
    if (method != Method::interval) return low;
    return low + (to[static_cast<std::size_t>(c + 3) * kInCache + i] - low) / 2;
  });
  for (auto _ : state) benchmark::DoNotOptimize(run());
  finish(state, error);
}

void bernstein(benchmark::State& state, const validation::SurfaceCase& s, const RooflineTable& table) {
  BicubicNet net;
  for (int k = 0; k < 16; ++k)
    for (int c = 0; c < 3; ++c) net.b[c][k] = s.points[3 * static_cast<std::size_t>(k) + static_cast<std::size_t>(c)];
  double* const to = room().data();
  const auto run = [&] { table.bernstein(net, u().data(), v().data(), kInCache, to); };
  run();
  const double error =
      worst_error(s, [&](std::size_t i, int c) { return to[static_cast<std::size_t>(c) * kInCache + i]; });
  for (auto _ : state) {
    run();
    benchmark::ClobberMemory();
  }
  finish(state, error);
}

void theirs(benchmark::State& state, const validation::SurfaceCase& s, const peers::Peer& peer, int variant) {
  const auto prepared = peer.prepare(s.data(), variant);
  const auto run = [&] { return prepared->evaluate(u(), v(), peers::Quantities::points, room()); };
  const auto placed = prepared ? run() : std::nullopt;
  if (!placed) return state.SkipWithError("refused");
  const double error =
      worst_error(s, [&](std::size_t i, int c) { return placed->at(static_cast<std::ptrdiff_t>(i), 0, c); });
  for (auto _ : state) benchmark::DoNotOptimize(run());
  finish(state, error);
}

}  // namespace

void register_accuracy_benchmarks() {
  for (const validation::SurfaceCase& s : surfaces()) {
    if (s.degree_u != 3) continue;
    const std::string row = s.name + "/accurate/points|";
    for (const InstructionSet set : available_instruction_sets())
      for (const auto& [name, method] : kMethods)
        benchmark::RegisterBenchmark(
            (row + "patchproof/" + to_string(set) + " " + name).c_str(),
            [&s, set, method = method](benchmark::State& state) { ours(state, s, set, method); });
    if (s.points.size() == 48)
      for (const RooflineTable* t : roofline_tables())
        benchmark::RegisterBenchmark((row + "bernstein/" + to_string(t->set)).c_str(),
                                     [&s, t](benchmark::State& state) { bernstein(state, s, *t); });
    for (const peers::Peer* peer : peers::registered_peers()) {
      if (peer->name() == "patchproof") continue;
      const std::vector<std::string> variants = peer->variants();
      for (int k = 0; k < static_cast<int>(variants.size()); ++k)
        if (peer->prepare(s.data(), k))
          benchmark::RegisterBenchmark((row + peer->name() + "/" + variants[static_cast<std::size_t>(k)]).c_str(),
                                       [&s, peer, k](benchmark::State& state) { theirs(state, s, *peer, k); });
    }
  }
}

}  // namespace patchproof::bench
