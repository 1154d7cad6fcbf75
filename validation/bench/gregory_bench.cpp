// SPDX-License-Identifier: Apache-2.0
// Gregory patches in batches, beside the U surface of the same patch alone: gregory/WHAT|KIND. Counter: ulp, the worst error
// of points among some hundred, in units of the last place of the largest coordinate.
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>

#include "patchproof/patch/gregory_batch.h"
#include "validation/bench/arena.h"
#include "validation/bench/register.h"

namespace patchproof::bench {
namespace {

using Point = Vec<Rational, 4>;

// Two surfaces of degree (3, 3) with one boundary and different inner points; with weights when `rational`.
GregoryPatch<Rational> patch_of(bool rational) {
  const auto surface = [&](int seed) {
    std::vector<Point> net;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const bool inner = i % 3 != 0 && j % 3 != 0;
        const Rational w = rational ? Rational(8 + (3 * i + 5 * j) % 7, 8) : Rational(1);
        const Rational height((i * i + 3 * j + (inner ? seed * (i + 2 * j) : 0)) % 11, 4);
        net.push_back({{w * i, w * j, w * height, w}});
      }
    const auto cubic = KnotVector<Rational>::bezier(3);
    return BsplinePatch<Rational, 4>(cubic, cubic, std::move(net));
  };
  return GregoryPatch<Rational>::make(surface(1), surface(4)).value();
}

BatchSurface u_surface_of(const GregoryPatch<Rational>& patch, bool rational) {
  std::vector<double> points, weights;
  for (const Point& p : patch.u_surface().net()) {
    for (std::size_t c = 0; c < 3; ++c) points.push_back(nearest_double(Rational(p[c] / p[3])));
    if (rational) weights.push_back(nearest_double(p[3]));
  }
  const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 1};
  return BatchSurface::make({3, 3, knots, knots, points, weights}).value();
}

SurfaceOutput output(int vectors) {
  const auto at = [&](int k) {
    return VectorArray::interleaved(room().data() + 3 * kItems * static_cast<std::size_t>(k));
  };
  SurfaceOutput out;
  out.point = at(0);
  if (vectors > 1) out.du = at(1), out.dv = at(2);
  if (vectors > 3) out.duu = at(3), out.duv = at(4), out.dvv = at(5);
  return out;
}

template <class Surface, class Exact>
void run(benchmark::State& state, const Surface& surface, int vectors, const Exact& exact) {
  const SurfaceOutput out = output(vectors);
  if (!surface.evaluate(random_u(), random_v(), out)) {
    state.SkipWithError("refused");
    return;
  }
  double worst = 0;
  for (std::size_t i = 0; i < kItems; i += kItems / 211) {
    const Vec<Rational, 3> at = exact(from_double(random_u()[i]), from_double(random_v()[i]));
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(worst, std::fabs(nearest_double(Rational(from_double(out.point.x[3 * i + c]) - at[c]))));
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(surface.evaluate(random_u(), random_v(), out));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kItems));
  state.counters["ulp"] = worst / 0x1p-51;  // the coordinates reach 3
}

}  // namespace

void register_gregory_benchmarks() {
  for (const bool rational : {false, true}) {
    const GregoryPatch<Rational> patch = patch_of(rational);
    const auto batch = std::make_shared<BatchGregory>(BatchGregory::make(patch).value());
    const auto alone = std::make_shared<BatchSurface>(u_surface_of(patch, rational));
    for (const auto& [what, vectors] : {std::pair{"points", 1}, {"first", 3}, {"second", 6}}) {
      const std::string name = std::string("gregory") + (rational ? " rational" : "") + "/" + what + "|";
      benchmark::RegisterBenchmark((name + "gregory").c_str(), [=, n = vectors](benchmark::State& state) {
        run(state, *batch, n, [&](const Rational& u, const Rational& v) { return evaluate(patch, u, v); });
      })->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark((name + "U surface").c_str(), [=, n = vectors](benchmark::State& state) {
        run(state, *alone, n,
            [&](const Rational& u, const Rational& v) { return evaluate_rational(patch.u_surface(), u, v); });
      })->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace patchproof::bench
