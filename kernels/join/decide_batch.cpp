// SPDX-License-Identifier: Apache-2.0
// Sorts joins by kind into vectors, chooses the instruction set at run time, and hands on what the vectors leave open.
#include "patchproof/join/decide_batch.h"

#include <algorithm>
#include <cmath>

#include "join/decide_one.h"
#include "kernels/join/decide_table.h"

namespace patchproof::kernels {
namespace {

#if defined(__x86_64__)
const DecideTable* table_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::portable: return nullptr;
    case InstructionSet::avx2: return &kDecideAvx2;
    case InstructionSet::avx512: return &kDecideAvx512;
    case InstructionSet::avx512_ifma: return &kDecideIfma;
  }
  return nullptr;
}
#else
const DecideTable* table_of(InstructionSet) { return nullptr; }
#endif

enum Kind { polynomial, cartesian, homogeneous, alone };

// alone: for decide_join, which also finds what is not finite.
Kind kind_of(const BicubicJoinRows& rows, const BicubicEdge* other) {
  if (other != nullptr && !decide::same_edge(rows, *other)) return alone;
  if (!rows.weights) return polynomial;
  const auto& weights = *rows.weights;
  for (const double w : weights[0])
    if (!(w > 0)) return alone;
  if (!decide::is_weighted(rows)) return std::isfinite(weights[0][0]) ? polynomial : alone;
  return rows.points == WeightedPoints::cartesian ? cartesian : homogeneous;
}

class Batch {
 public:
  Batch(const DecideTable& table, std::span<const BicubicJoinRows> rows, std::span<JoinDecision> out)
      : table_(table), rows_(rows), out_(out) {}

  void add(Kind kind, std::size_t join) {
    Waiting& w = waiting_[kind];
    w.joins[w.count++] = join;
    if (w.count == table_.lanes) decide(kind);
  }
  void finish() {
    for (const Kind kind : {polynomial, cartesian, homogeneous})
      if (waiting_[kind].count > 0) decide(kind);
  }

 private:
  static constexpr int kMostLanes = 8;
  struct Waiting {
    std::size_t joins[kMostLanes];
    int count = 0;
  };

  void decide(Kind kind) {
    Waiting& w = waiting_[kind];
    const double *points[kMostLanes], *weights[kMostLanes];
    for (int i = 0; i < table_.lanes; ++i) {
      const BicubicJoinRows& rows = rows_[w.joins[i < w.count ? i : 0]];  // the first fills up
      points[i] = rows.edge[0].data();
      weights[i] = kind == polynomial ? nullptr : (*rows.weights)[0].data();
    }
    const LaneAnswers answers = kind == polynomial ? table_.polynomial(points, Depth::all)
                                                   : table_.rational(points, weights, kind == cartesian, Depth::all);
    for (int i = 0; i < w.count; ++i) write(answers, 1u << i, w.joins[i]);
    w.count = 0;
  }

  void write(const LaneAnswers& answers, unsigned lane, std::size_t join) {
    JoinDecision& decision = out_[join];
    const BicubicJoinRows& rows = rows_[join];
    if (answers.filter & lane) {
      decision = {true, false, FixedG1::refuted, DecidedBy::filter};
    } else if (answers.modular & lane) {
      decision = {true, false, FixedG1::refuted, DecidedBy::modular};
    } else if (answers.coplanar & lane) {
      const bool open = ((answers.c1 | answers.not_c1) & lane) == 0;
      const bool c1 = open ? decide::exact_c1(rows) : (answers.c1 & lane) != 0;
      if (answers.opposed & lane)
        decision = {true, c1, FixedG1::proven_smooth, DecidedBy::modular};
      else
        decision = {true, c1, decide_fixed_g1(rows), DecidedBy::fixed};
    } else {
      decision = decide_join(rows);
    }
  }

  const DecideTable& table_;
  std::span<const BicubicJoinRows> rows_;
  std::span<JoinDecision> out_;
  Waiting waiting_[3];
};

}  // namespace

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::portable: return "portable";
    case InstructionSet::avx2: return "AVX2";
    case InstructionSet::avx512: return "AVX-512";
    case InstructionSet::avx512_ifma: return "AVX-512 IFMA";
  }
  return "unknown";
}

bool is_available(InstructionSet set) {
#if defined(__x86_64__)
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
  switch (set) {
    case InstructionSet::portable: return true;
    case InstructionSet::avx2: return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::avx512: return avx512;
    case InstructionSet::avx512_ifma: return avx512 && __builtin_cpu_supports("avx512ifma");
  }
  return false;
#else
  return set == InstructionSet::portable;
#endif
}

InstructionSet best_instruction_set() {
  static const InstructionSet best = [] {
    for (const InstructionSet set : {InstructionSet::avx512_ifma, InstructionSet::avx512, InstructionSet::avx2})
      if (is_available(set)) return set;
    return InstructionSet::portable;
  }();
  return best;
}

void decide_batch(std::span<const BicubicJoinRows> rows, std::span<const BicubicEdge> other_edges,
                  std::span<JoinDecision> out, InstructionSet set) {
  PATCHPROOF_REQUIRES(out.size() == rows.size(), "decide_batch: one decision for each join");
  PATCHPROOF_REQUIRES(other_edges.empty() || other_edges.size() == rows.size(),
                      "decide_batch: no second edges, or one for each join");
  PATCHPROOF_REQUIRES(is_available(set), "decide_batch: the processor lacks the instruction set");
  const auto other = [&](std::size_t i) { return other_edges.empty() ? nullptr : &other_edges[i]; };
  const DecideTable* table = table_of(set);
  if (table == nullptr) {
    for (std::size_t i = 0; i < rows.size(); ++i) out[i] = decide_join(rows[i], other(i));
    return;
  }
  const decide::NearestGuard guard;
  Batch batch(*table, rows, out);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Kind kind = kind_of(rows[i], other(i));
    if (kind == alone)
      out[i] = decide_join(rows[i], other(i));
    else
      batch.add(kind, i);
  }
  batch.finish();
}

}  // namespace patchproof::kernels
