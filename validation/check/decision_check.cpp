// SPDX-License-Identifier: Apache-2.0
// Decisions of joins in batches against the exact rung: forms over Integer, which share no code with doubles or residues.
// A number is one join; without a bound: its G1 is left to the exact rung.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "patchproof/join/continuity.h"
#include "patchproof/join/decide_batch.h"
#include "patchproof/join/pieces.h"
#include "patchproof/spline/homogeneous.h"
#include "validation/check/judge.h"
#include "validation/corpus/random.h"

namespace patchproof::validation {
namespace {

struct Family {
  const char* name;
  int bits;          // of the coordinates
  bool weighted;     // one weight for each column of control points
  double ratio;      // B − E = −ratio (A − E): negative: a fold; 0: random, not smooth
  int scale = 0;     // a power of two
  bool off = false;  // one coordinate by one unit in the last place
};
constexpr Family kFamilies[] = {{"joins_smooth", 20, false, 1.5},
                                {"joins_c1", 48, false, 1},
                                {"joins_long", 50, false, 0.5},
                                {"joins_off_by_an_ulp", 48, false, 1, 0, true},
                                {"joins_weighted", 20, true, 1},
                                {"joins_weighted_long", 45, true, 1},
                                {"joins_weighted_off_by_an_ulp", 40, true, 1, 0, true},
                                {"joins_folded", 30, false, -1},
                                {"joins_huge", 40, false, 1, 400},
                                {"joins_tiny", 40, false, 2, -400},
                                {"joins_kinked", 30, false, 0}};
constexpr int kJoins = 27;  // no multiple of any number of lanes

BicubicJoinRows make_join(const Family& f, Random& random) {
  BicubicJoinRows rows;
  // Whole numbers below 2^bits over a lattice, times a power of two.
  const auto coordinate = [&](double base) {
    const double range = std::ldexp(1.0, f.bits - 6);
    return std::ldexp(std::floor(random.between(-range, range)) + base * 8 * range, f.scale - f.bits + 6);
  };
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      const double along = k == 1 ? i : 0, across = k == 0 ? 1 : 0;
      rows.edge[i][k] = coordinate(along);
      rows.behind_a[i][k] = coordinate(along - across);
      rows.behind_b[i][k] = f.ratio == 0 ? coordinate(along + across)
                                         : rows.edge[i][k] - f.ratio * (rows.behind_a[i][k] - rows.edge[i][k]);
    }
  if (f.weighted) {
    rows.weights.emplace();
    for (int i = 0; i < 4; ++i) {
      const double w = std::floor(random.between(1 << 19, 1 << 21)) * 0x1p-20;
      for (auto& row : *rows.weights) row[i] = w;
    }
  }
  if (f.off) {
    double& x = rows.behind_b[2][2];
    x = std::nextafter(x, 1e9);
  }
  return rows;
}

JoinPiece<Rational> exact_piece(const BicubicJoinRows& rows) {
  const auto points = [&](const BicubicJoinRows::Row& row, int which) {
    std::vector<Vec<Rational, 4>> out;
    for (int i = 0; i < 4; ++i)
      out.push_back(
          to_homogeneous(Vec<Rational, 3>{{from_double(row[i][0]), from_double(row[i][1]), from_double(row[i][2])}},
                         rows.weights ? from_double((*rows.weights)[which][i]) : Rational(1)));
    return out;
  };
  JoinPiece<Rational> piece{0, 1, 0, 1, {}, {}};
  const auto edge = points(rows.edge, 0), a = points(rows.behind_a, 1), b = points(rows.behind_b, 2);
  piece.a[0] = piece.b[0] = edge;
  for (int i = 0; i < 4; ++i) {
    piece.a[1].push_back(Rational(3) * (a[i] - edge[i]));
    piece.b[1].push_back(Rational(3) * (b[i] - edge[i]));
  }
  piece.a[2].resize(4);
  piece.b[2].resize(4);
  return piece;
}

struct Truth {
  bool c1, coplanar, opposed;
};
Truth exact_decision(const BicubicJoinRows& rows) {
  const RoundingGuard guard;
  const JoinForms<Integer> forms = join_forms<Integer>(exact_piece(rows));
  Truth t{match_cross_derivatives(forms).equal, vanishes(coplanarity(forms.a, forms.b)), false};
  const ReducedNormal<Integer> a = reduce_normal(forms.a), b = reduce_normal(forms.b);
  t.opposed = a.found() && b.found() && *scalar_traits<Integer>::sign(dot(a.n, b.n)[0]) == Sign::negative;
  return t;
}

// The names of the decisions' own sets.
InstructionSet set_of(kernels::InstructionSet set) {
  switch (set) {
    case kernels::InstructionSet::portable: return InstructionSet::portable;
    case kernels::InstructionSet::avx2: return InstructionSet::avx2;
    default: return InstructionSet::avx512;
  }
}

}  // namespace

void check_decisions(const CheckOptions& options, Tallies& tallies) {
  using Sets = kernels::InstructionSet;
  for (std::size_t f = 0; f < std::size(kFamilies); ++f) {
    Random random(options.corpus.seed * 1009 + f);
    std::vector<BicubicJoinRows> joins;
    for (int i = 0; i < kJoins; ++i) joins.push_back(make_join(kFamilies[f], random));
    std::vector<Truth> truth;
    for (const BicubicJoinRows& rows : joins) truth.push_back(exact_decision(rows));
    for (const Sets set : {Sets::portable, Sets::avx2, Sets::avx512, Sets::avx512_ifma}) {
      const InstructionSet plain = set_of(set);
      if (!kernels::is_available(set) ||
          std::find(options.sets.begin(), options.sets.end(), plain) == options.sets.end())
        continue;
      const std::string kernel = set == Sets::avx512_ifma ? "decide ifma" : "decide";
      Tally& tally = tallies[{kernel, plain, kFamilies[f].name}];
      std::vector<JoinDecision> decisions(joins.size());
      kernels::decide_batch(joins, {}, decisions, set);
      for (std::size_t i = 0; i < joins.size(); ++i) {
        JoinDecision d = decisions[i];
        if (kernel == options.broken_kernel && options.broken_by > 0) d.c1 = !d.c1;
        const Truth& t = truth[i];
        ++tally.numbers;
        tally.without_bound += !d.g1;
        const bool holds = d.c0 && d.c1 == t.c1 && (!d.g1 || (*d.g1 == FixedG1::refuted) == !t.coplanar) &&
                           (d.g1 != FixedG1::proven_smooth || t.opposed);
        if (!holds && tally.violations++ == 0)
          tally.violation = fmt::format("{}, join {}: C0 {}, C1 {}, G1 by {}; exact: C1 {}, coplanar {}, opposed {}",
                                        kFamilies[f].name, i, d.c0, d.c1, name_of(d.rung), t.c1, t.coplanar, t.opposed);
      }
    }
  }
}

}  // namespace patchproof::validation
