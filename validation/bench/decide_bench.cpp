// SPDX-License-Identifier: Apache-2.0
// Exact G1 of bicubic joins: decide/FAMILY|METHOD, one item for each join, with the joins each method accepts as a
// counter. Beside it OCCT's LocalAnalysis_SurfaceContinuity at 23 points of the edge, which asks another question: are
// the normals there within an angle (by default 1e-3)? So it accepts joins that are off by one unit in the last place,
// or by 1e-6.
//   filter     floating filter alone              zero test   det ≡ 0 proved or refuted
//   whole      C1, G1 with sides and regularity, what is open handed on; by decide_batch
//   two edges  the same, and C0 of the edge rows given twice
#include <benchmark/benchmark.h>

#include <string>

#include "kernels/join/decide_table.h"
#include "patchproof/join/decide_batch.h"
#include "tests/support/g1_joins.h"

#ifdef PATCHPROOF_HAVE_OCCT
#include <Geom_BezierSurface.hxx>
#include <LocalAnalysis_SurfaceContinuity.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#endif

namespace patchproof::bench {
namespace {

using kernels::DecideTable;
using kernels::Depth;
using kernels::InstructionSet;

constexpr int kJoins = 256;

struct NamedFamily {
  const char* name;
  test::G1Family family;
  bool spoiled;
  double step;        // 0: one unit in the last place
  int flattened = 0;  // bits that numbers are longer
};
constexpr NamedFamily kFamilies[] = {{"D24", test::kD24, false, 0},
                                     {"D53", test::kD53, false, 0},
                                     {"D53_one_ulp_off", test::kD53, true, 0},
                                     {"D53_least_bit_off", test::kD53, true, 0x1p-46},
                                     {"D53_1e-6_off", test::kD53, true, 1e-6},
                                     {"D63", test::kD53, false, 0, 10},
                                     {"R53", test::kR53, false, 0},
                                     {"R106", test::kR106, false, 0},
                                     {"R106_1e-6_off", test::kR106, true, 1e-6}};

std::vector<BicubicJoinRows> joins_of(const NamedFamily& named) {
  std::vector<BicubicJoinRows> joins = test::make_g1_joins(named.family, kJoins);
  for (BicubicJoinRows& rows : joins) test::flatten(rows, named.flattened);
  if (named.spoiled)
    for (BicubicJoinRows& rows : joins) test::spoil(rows, named.step);
  return joins;
}

void count(benchmark::State& state, int accepted) {
  state.SetItemsProcessed(state.iterations() * kJoins);
  state.counters["accepted"] = accepted;
}

void decide_all(benchmark::State& state, const NamedFamily& named, InstructionSet set, bool two_edges) {
  const std::vector<BicubicJoinRows> joins = joins_of(named);
  std::vector<BicubicEdge> edges;
  for (const BicubicJoinRows& rows : joins)
    if (two_edges) edges.push_back({rows.edge, rows.weights ? (*rows.weights)[0] : std::array<double, 4>{1, 1, 1, 1}});
  std::vector<JoinDecision> out(joins.size());
  for (auto _ : state) kernels::decide_batch(joins, edges, out, set);
  int accepted = 0;
  for (const JoinDecision& decision : out) accepted += decision.g1 == FixedG1::proven_smooth;
  if (accepted != (named.spoiled ? 0 : kJoins)) state.SkipWithError("a wrong decision");
  count(state, accepted);
}

// A part of the ladder. "Accepted" are the joins it does not refute.
void decide_part(benchmark::State& state, const NamedFamily& named, const DecideTable& table, Depth depth) {
  const std::vector<BicubicJoinRows> joins = joins_of(named);
  std::vector<const double*> points, weights;
  for (const BicubicJoinRows& rows : joins) {
    points.push_back(rows.edge[0].data());
    weights.push_back(rows.weights ? (*rows.weights)[0].data() : nullptr);
  }
  int accepted = 0;
  for (auto _ : state) {
    accepted = 0;
    for (int i = 0; i < kJoins; i += table.lanes) {
      const kernels::LaneAnswers answers =
          joins[0].weights ? table.rational(&points[i], &weights[i], true, depth) : table.polynomial(&points[i], depth);
      accepted += table.lanes - __builtin_popcount(answers.filter | answers.modular);
    }
  }
  count(state, accepted);
}

#ifdef PATCHPROOF_HAVE_OCCT
constexpr int kSamples = 23;

Handle(Geom_BezierSurface) surface(const BicubicJoinRows& rows, bool first) {
  TColgp_Array2OfPnt points(1, 4, 1, 4);
  TColStd_Array2OfReal weights(1, 4, 1, 4);
  const auto& behind = first ? rows.behind_a : rows.behind_b;
  const double away = first ? -10 : 10;
  for (int i = 0; i < 4; ++i)
    for (int row = 0; row < 4; ++row) {  // counted from the edge
      const auto& p = row == 0 ? rows.edge[i] : behind[i];
      const double shift = row < 2 ? 0 : away * (row - 1);
      const int at = first ? 4 - row : 1 + row;
      points(at, i + 1) = gp_Pnt(p[0] + shift, p[1], p[2]);
      weights(at, i + 1) = rows.weights ? (*rows.weights)[row == 0 ? 0 : first ? 1 : 2][i] : 1;
    }
  return rows.weights ? new Geom_BezierSurface(points, weights) : new Geom_BezierSurface(points);
}

void occt(benchmark::State& state, const NamedFamily& named) {
  std::vector<std::pair<Handle(Geom_BezierSurface), Handle(Geom_BezierSurface)>> pairs;
  for (const BicubicJoinRows& rows : joins_of(named)) pairs.emplace_back(surface(rows, true), surface(rows, false));
  int accepted = 0;
  for (auto _ : state) {
    accepted = 0;
    for (const auto& [a, b] : pairs) {
      bool smooth = true;
      for (int k = 0; k < kSamples; ++k) {
        const double t = k / (kSamples - 1.0);
        LocalAnalysis_SurfaceContinuity analysis(a, 1, t, b, 0, t, GeomAbs_G1);
        smooth &= static_cast<bool>(analysis.IsG1());
      }
      accepted += smooth;
    }
  }
  count(state, accepted);
}
#endif

int register_all() {
  for (const NamedFamily& named : kFamilies) {
    const std::string family = std::string("decide/") + named.name + "|";
    for (const InstructionSet set :
         {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512, InstructionSet::avx512_ifma}) {
      if (!kernels::is_available(set)) continue;
      const std::string name = family + kernels::name_of(set) + "/";
      benchmark::RegisterBenchmark((name + "whole").c_str(), decide_all, named, set, false);
      benchmark::RegisterBenchmark((name + "two edges").c_str(), decide_all, named, set, true);
#if defined(__x86_64__)
      if (set == InstructionSet::portable) continue;
      const DecideTable& table = set == InstructionSet::avx2     ? kernels::kDecideAvx2
                                 : set == InstructionSet::avx512 ? kernels::kDecideAvx512
                                                                 : kernels::kDecideIfma;
      benchmark::RegisterBenchmark((name + "filter").c_str(), decide_part, named, table, Depth::filter);
      benchmark::RegisterBenchmark((name + "zero test").c_str(), decide_part, named, table, Depth::zero_test);
#endif
    }
#ifdef PATCHPROOF_HAVE_OCCT
    benchmark::RegisterBenchmark((family + "OCCT/23 samples").c_str(), occt, named);
#endif
  }
  return 0;
}
[[maybe_unused]] const int registered = register_all();

}  // namespace
}  // namespace patchproof::bench
