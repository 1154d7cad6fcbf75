// SPDX-License-Identifier: Apache-2.0
// The limits of the machine as benchmarks: see roofline.h. An item is a vector operation, or what is read and written for
// one item of a kernel.
#include <benchmark/benchmark.h>

#include <string>

#include "validation/bench/arena.h"
#include "validation/bench/register.h"
#include "validation/bench/roofline.h"

namespace patchproof::bench {
namespace {

const char* name_of(Stores s) {
  switch (s) {
    case Stores::separate: return "separate";
    case Stores::separate_streamed: return "separate_streamed";
    case Stores::sequential: return "sequential";
    case Stores::sequential_streamed: return "sequential_streamed";
  }
  return "";
}

void register_arithmetic(const char* what, const RooflineTable& t, double (*run)(std::size_t)) {
  benchmark::RegisterBenchmark((std::string("roofline/") + what + "|" + to_string(t.set)).c_str(),
                               [run, &t](benchmark::State& state) {
                                 constexpr std::size_t kCount = 120'000;
                                 for (auto _ : state) benchmark::DoNotOptimize(run(kCount));
                                 state.SetItemsProcessed(state.iterations() * kCount);
                                 state.counters["lanes"] = t.lanes;
                               });
}

// Numbers read and written by the rows of the table: scattered surfaces, grids, curves.
constexpr int kTraffic[][2] = {{2, 3},  {2, 9},  {2, 12}, {2, 18}, {0, 3}, {0, 9},
                               {0, 12}, {0, 18}, {1, 3},  {1, 6},  {1, 9}};

}  // namespace

std::vector<const RooflineTable*> roofline_tables() {
  std::vector<const RooflineTable*> out;
  for (const RooflineTable* t : {
         &kRooflinePortable
#if defined(__x86_64__)
             ,
             &kRooflineSse4, &kRooflineAvx2, &kRooflineAvx512
#endif
       })
    if (is_available(t->set)) out.push_back(t);
  return out;
}

void register_roofline_benchmarks() {
  for (const RooflineTable* t : roofline_tables()) {
    register_arithmetic("multiply_add", *t, t->multiply_add);
    register_arithmetic("divide", *t, t->divide);
    register_arithmetic("root", *t, t->root);
  }
  const RooflineTable& widest = *roofline_tables().back();
  for (const auto& [in, out] : kTraffic)
    for (const Stores stores : kAllStores)
      benchmark::RegisterBenchmark(
          ("roofline/traffic_" + std::to_string(in) + "_" + std::to_string(out) + "|" + name_of(stores)).c_str(),
          [in = in, out = out, stores, &widest](benchmark::State& state) {
            for (auto _ : state) {
              widest.traffic(random_u().data(), random_v().data(), in, room().data(), out, kItems, stores);
              benchmark::ClobberMemory();
            }
            state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kItems));
            state.counters["in"] = in;
            state.counters["out"] = out;
          })
          ->Unit(benchmark::kMillisecond);
}

}  // namespace patchproof::bench
