// SPDX-License-Identifier: Apache-2.0
// The race: our kernels and the peers on the same workloads in one run, each held against exact values before it is timed.
// Counters: ulp, the worst error among some hundred results of the very call that is timed (peers/compare.h); of our own
// rows also operations, divisions and roots for each item (operations.h), and the numbers read and written.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>

#include "validation/bench/arena.h"
#include "validation/bench/operations.h"
#include "validation/bench/register.h"
#include "validation/corpus/truth.h"
#include "validation/peers/compare.h"

namespace patchproof::bench {
namespace {

using peers::Arrangement;
using peers::Placed;
using peers::Quantities;

constexpr std::size_t kChecked = 211;  // results of each row that are compared with exact ones
constexpr double kAcceptable = 1e9;    // ulp: beyond this a peer computes something else, and is not timed

const std::vector<validation::SurfaceCase>& surfaces() {
  static const auto all = validation::surface_workloads();
  return all;
}
const std::vector<validation::CurveCase>& curves() {
  static const auto all = validation::curve_workloads();
  return all;
}

// Exact values at some items, computed once for each workload and arrangement.
std::size_t checked_item(std::size_t k) { return k * (kItems / kChecked); }

const std::vector<validation::SurfaceTruth>& truth_of(const validation::SurfaceCase& s, Arrangement a) {
  static std::map<std::pair<std::string, Arrangement>, std::vector<validation::SurfaceTruth>> known;
  auto& values = known[{s.name, a}];
  if (values.empty()) {
    const auto patch = validation::exact_patch(s.data());
    for (std::size_t k = 0; k < kChecked; ++k) {
      const std::size_t i = checked_item(k);
      const bool grid = a == Arrangement::grid;
      values.push_back(validation::exact_values(patch, grid ? grid_line()[i / kGridSide] : random_u()[i],
                                                grid ? grid_line()[i % kGridSide] : random_v()[i], Side::right, 2));
    }
  }
  return values;
}

const std::vector<validation::CurveTruth>& truth_of(const validation::CurveCase& c, bool sorted) {
  static std::map<std::pair<std::string, bool>, std::vector<validation::CurveTruth>> known;
  auto& values = known[{c.name, sorted}];
  if (values.empty()) {
    const auto curve = validation::exact_curve(c.data());
    for (std::size_t k = 0; k < kChecked; ++k)
      values.push_back(
          validation::exact_values(curve, (sorted ? sorted_u() : random_u())[checked_item(k)], Side::right, 2));
  }
  return values;
}

// A row of the race: what is timed, and how its results are judged. The verdict is kept between calls of the benchmark.
struct Runner {
  std::function<std::optional<Placed>()> run;
  std::function<double(const Placed&)> worst_error;
  std::vector<std::pair<std::string, double>> counters;
  std::optional<double> error;
};

void race(benchmark::State& state, Runner& runner) {
  if (!runner.error) {
    const std::span<double> all = room();
    std::fill(all.begin(), all.end(), std::nan(""));
    const std::optional<Placed> placed = runner.run();
    runner.error = placed ? runner.worst_error(*placed) : std::nan("");
  }
  if (!(*runner.error < kAcceptable)) {
    state.SkipWithError("wrong results");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(runner.run());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kItems));
  state.counters["ulp"] = *runner.error;
  for (const auto& [name, value] : runner.counters) state.counters[name] = value;
}

void register_race(const std::string& name, Runner runner) {
  const auto shared = std::make_shared<Runner>(std::move(runner));
  benchmark::RegisterBenchmark(name.c_str(), [shared](benchmark::State& state) {
    race(state, *shared);
  })->Unit(benchmark::kMillisecond);
}

// Our own rows say what they need of the machine.
std::optional<int> lanes_of(const peers::Peer& peer, const std::string& variant) {
  if (peer.name() != "patchproof") return {};
  if (variant.starts_with("avx512")) return 8;
  if (variant.starts_with("avx2")) return 4;
  return variant.starts_with("portable") ? 1 : 2;
}
std::vector<std::pair<std::string, double>> counters(const Operations& o, int in, int vectors) {
  return {{"operations", o.simple}, {"divisions", o.divide}, {"roots", o.root}, {"in", in}, {"out", 3.0 * vectors}};
}

void register_surface(const peers::Peer& peer, int variant, const validation::SurfaceCase& s, Arrangement a,
                      Quantities what) {
  const std::shared_ptr<peers::PreparedSurface> prepared = peer.prepare(s.data(), variant);
  if (!prepared) return;
  const bool grid = a == Arrangement::grid;
  std::vector<double> probe_room(18 * 16 + 8);
  double* const aligned = probe_room.data() + (64 - reinterpret_cast<std::uintptr_t>(probe_room.data()) % 64) / 8;
  const std::vector<double> few{0.125, 0.25, 0.5, 0.75};
  if (!(grid ? prepared->evaluate_grid(few, few, what, {aligned, 18 * 16})
             : prepared->evaluate(few, few, what, {aligned, 18 * 4})))
    return;
  Runner runner;
  runner.run = [=] {
    return grid ? prepared->evaluate_grid(grid_line(), grid_line(), what, room())
                : prepared->evaluate(random_u(), random_v(), what, room());
  };
  runner.worst_error = [=, &s](const Placed& placed) {
    peers::Score score;
    for (std::size_t k = 0; k < kChecked; ++k) {
      const std::size_t i = checked_item(k);
      const std::size_t at = placed.u_fastest ? (i % kGridSide) * kGridSide + i / kGridSide : i;
      for (const Quantities q : peers::kAllQuantities)
        if (q == Quantities::points || q == what || (q == Quantities::first && what != Quantities::points))
          peers::add_vectors(score, q, placed, static_cast<std::ptrdiff_t>(at), truth_of(s, a)[k]);
    }
    return score.worst;
  };
  const std::string variant_name = peer.variants()[static_cast<std::size_t>(variant)];
  if (const auto lanes = lanes_of(peer, variant_name))
    runner.counters = counters(surface_operations(s, a, what, *lanes), grid ? 0 : 2, peers::surface_vectors(what));
  register_race(s.name + "/" + to_string(a) + "/" + to_string(what) + "|" + peer.name() + "/" + variant_name,
                std::move(runner));
}

void register_curve(const peers::Peer& peer, int variant, const validation::CurveCase& c, bool sorted,
                    Quantities what) {
  const std::shared_ptr<peers::PreparedCurve> prepared = peer.prepare(c.data(), variant);
  if (!prepared) return;
  Runner runner;
  runner.run = [=] { return prepared->evaluate(sorted ? sorted_u() : random_u(), sorted, what, room()); };
  runner.worst_error = [=, &c](const Placed& placed) {
    peers::Score score;
    for (std::size_t k = 0; k < kChecked; ++k)
      for (int m = 0; m < peers::curve_vectors(what); ++m)
        peers::add_vector(score, placed, static_cast<std::ptrdiff_t>(checked_item(k)), m, truth_of(c, sorted)[k][m]);
    return score.worst;
  };
  const std::string variant_name = peer.variants()[static_cast<std::size_t>(variant)];
  if (const auto lanes = lanes_of(peer, variant_name))
    runner.counters = counters(curve_operations(c, sorted, what, *lanes), 1, peers::curve_vectors(what));
  register_race(
      c.name + "/" + (sorted ? "sorted" : "scattered") + "/" + to_string(what) + "|" + peer.name() + "/" + variant_name,
      std::move(runner));
}

void load_plugins() {
  const char* const named = std::getenv("PATCHPROOF_PLUGINS");
  std::istringstream paths(named ? named : "");
  for (std::string path; std::getline(paths, path, ':');)
    if (const auto loaded = peers::load_peer(path); !loaded) {
      std::fprintf(stderr, "bench: %s\n", loaded.error().text().c_str());
      std::exit(2);
    }
}

}  // namespace

void register_kernel_benchmarks() {
  load_plugins();
  for (const peers::Peer* peer : peers::registered_peers())
    for (int variant = 0; variant < static_cast<int>(peer->variants().size()); ++variant) {
      for (const validation::SurfaceCase& s : surfaces()) {
        const bool cubic = s.degree_u == 3, one_patch = s.points.size() == 3 * 16;
        for (const Quantities q : peers::kAllQuantities) {
          const bool first_or_less = q == Quantities::points || q == Quantities::first;
          if (first_or_less || (cubic && s.weights.empty() && (q == Quantities::second || one_patch)))
            register_surface(*peer, variant, s, Arrangement::scattered, q);
          if (first_or_less && cubic) register_surface(*peer, variant, s, Arrangement::grid, q);
        }
      }
      for (const validation::CurveCase& c : curves())
        for (const Quantities q : {Quantities::points, Quantities::first})
          for (const bool sorted : {true, false}) register_curve(*peer, variant, c, sorted, q);
    }
}

}  // namespace patchproof::bench
