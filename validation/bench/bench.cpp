// SPDX-License-Identifier: Apache-2.0
// How fast joins are decided. `./dev bench` runs everything; ratios are only meaningful within one run.
//
// Random bicubic joins, a lattice moved by noise, dyadic coordinates of 26 bits, exactly G1 by construction (ratio 3/2):
//   g1_decision/integer   determinant, regularity and side on cleared integers: the rung that certify uses
//   g1_decision/fixed     the same question in integers of fixed width, from doubles to the answer: join/fixed_g1.h
//   g1_decision/rational  the same templates on mpq: what clearing the denominators saves
//   certify_join          everything: classes, witnesses, bounds
// and the same for rational joins (homogeneous reflection, weights of 10 bits). Models (the cup, and those named: ./dev bench MODEL…): one whole
// certify run per iteration, reading included.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>

#include "patchproof/io/read.h"
#include "patchproof/io/report.h"
#include "patchproof/join/certify.h"
#include "patchproof/join/continuity.h"
#include "patchproof/join/fixed_g1.h"
#include "patchproof/join/pieces.h"
#include "validation/bench/register.h"

namespace {

using namespace patchproof;
using Patch = BsplinePatch<Rational, 4>;

struct TwoPatches {
  Patch a, b;
  Join<Rational> join;
};

// A: u in [0, 1] with its edge u_max; B with its edge u_min; the row behind the edge is reflected, scaled by 3/2.
TwoPatches random_join(std::mt19937& random, bool rational) {
  std::uniform_int_distribution<int> noise(-(1 << 22), 1 << 22), weight(1 << 9, 1 << 10);
  const auto knots = KnotVector<Rational>::bezier(3);
  std::vector<Vec<Rational, 4>> a(16), b(16);
  for (int i = 0; i < 16; ++i) {
    const Rational w = rational ? Rational(weight(random)) / Rational(1 << 10) : Rational(1);
    const std::array<int, 3> lattice{(i / 4) << 24, (i % 4) << 24, 0};
    for (int c = 0; c < 3; ++c) a[i][c] = Rational(lattice[c] + noise(random)) / Rational(1 << 20) * w;
    a[i][3] = w;
    b[i] = a[i];
  }
  const Rational ratio = rational ? Rational(1) : Rational(3) / Rational(2);
  for (int j = 0; j < 4; ++j) {
    b[j] = a[12 + j];
    b[4 + j] = a[12 + j] + ratio * (a[12 + j] - a[8 + j]);
  }
  TwoPatches out{Patch(knots, knots, a), Patch(knots, knots, b), {}};
  out.join.line_a = edge_line(out.a, EdgeName::u_max);
  out.join.line_b = edge_line(out.b, EdgeName::u_min);
  out.join.pairing = {PairingKind::identity, {Rational(0), Rational(1)}, {Rational(0), Rational(1)}, Rational(1)};
  return out;
}

std::vector<TwoPatches> random_joins(bool rational) {
  std::mt19937 random(1);
  std::vector<TwoPatches> joins;
  for (int i = 0; i < 256; ++i) joins.push_back(random_join(random, rational));
  return joins;
}

// Is the join G1? Rows to verdict: forms, both normals, determinant, side.
template <Ring R>
bool is_g1(const JoinPiece<Rational>& piece) {
  const JoinForms<R> forms = join_forms<R>(piece);
  const ReducedNormal<R> a = reduce_normal(forms.a), b = reduce_normal(forms.b);
  if (!is_c0(forms) || !a.found() || !b.found() || !is_coplanar(forms, a, b)) return false;
  return *scalar_traits<R>::sign(dot(a.n, b.n)(R(0))) == Sign::negative;
}

template <Ring R>
void g1_decision(benchmark::State& state, bool rational) {
  std::vector<JoinPiece<Rational>> pieces;
  for (const TwoPatches& t : random_joins(rational)) pieces.push_back(join_pieces(t.a, t.b, t.join)[0]);
  const RoundingGuard guard;
  std::size_t i = 0;
  for (auto _ : state) {
    if (!is_g1<R>(pieces[i++ % pieces.size()])) state.SkipWithError("a G1 join was refused");
  }
  state.SetItemsProcessed(state.iterations());
}

void fixed_g1_decision(benchmark::State& state, bool rational) {
  std::vector<BicubicJoinRows> rows;
  for (const TwoPatches& t : random_joins(rational))
    rows.push_back(bicubic_join_rows(join_pieces(t.a, t.b, t.join)[0]).value());
  std::size_t i = 0;
  int proven = 0, refused = 0;
  for (auto _ : state) {
    const std::optional<FixedG1> answer = decide_fixed_g1(rows[i++ % rows.size()]);
    proven += answer == FixedG1::proven_smooth;
    refused += !answer || *answer == FixedG1::refuted;
  }
  if (refused > 0) state.SkipWithError("a G1 join was refused");
  state.counters["proven"] = proven / static_cast<double>(state.iterations());  // the others need the integer rung
  state.SetItemsProcessed(state.iterations());
}

void certify_one(benchmark::State& state, bool rational) {
  const std::vector<TwoPatches> joins = random_joins(rational);
  std::size_t i = 0;
  for (auto _ : state) {
    const TwoPatches& t = joins[i++ % joins.size()];
    if (certify_join(t.a, t.b, t.join).g1.verdict != Verdict::proven) state.SkipWithError("a G1 join was refused");
  }
  state.SetItemsProcessed(state.iterations());
}

void certify_file(benchmark::State& state, const std::string& path) {
  if (!std::filesystem::exists(path)) {
    state.SkipWithError("the model is not here");
    return;
  }
  std::size_t joins = 0;
  CertifyOptions options;
  options.jobs = 1;
  for (auto _ : state) {
    const Result<ModelFile> file = read_model(path);
    if (!file) {
      state.SkipWithError(file.error().text().c_str());
      return;
    }
    joins += certify_model(*file, options).joins.size();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(joins));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string source = PATCHPROOF_SOURCE_DIR;
  for (const bool rational : {false, true}) {
    const std::string kind = rational ? "/rational_bicubic" : "/polynomial_bicubic";
    benchmark::RegisterBenchmark(("g1_decision/integer" + kind).c_str(), g1_decision<Integer>, rational);
    benchmark::RegisterBenchmark(("g1_decision/fixed" + kind).c_str(), fixed_g1_decision, rational);
    benchmark::RegisterBenchmark(("g1_decision/rational" + kind).c_str(), g1_decision<Rational>, rational);
    benchmark::RegisterBenchmark(("certify_join" + kind).c_str(), certify_one, rational);
  }
  patchproof::bench::register_roofline_benchmarks();
  patchproof::bench::register_kernel_benchmarks();
  patchproof::bench::register_accuracy_benchmarks();
  patchproof::bench::register_gregory_benchmarks();
  std::vector<std::string> models{source + "/examples/cup.json"};
  benchmark::Initialize(&argc, argv);
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] == '-') return benchmark::ReportUnrecognizedArguments(argc, argv), 2;
    models.push_back(argv[i]);
  }
  for (const std::string& model : models)
    benchmark::RegisterBenchmark(("certify_model/" + std::filesystem::path(model).filename().string()).c_str(),
                                 certify_file, model)
        ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
