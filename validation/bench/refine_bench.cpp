// SPDX-License-Identifier: Apache-2.0
// Refinement and exact points. One item is a whole operation; each row is held against exact values, then timed.
//   SURFACE/refine_40x40/net|PEER    20 new knots in each direction, from knots to control points
//   SURFACE/extract/net|PEER         all 17 × 17 Bézier patches
//     ours: with the bands of coefficients, and with these prepared. SISL's and OCCT's results are not copied out.
//     Rational surfaces: ours end with homogeneous points, as SISL keeps them.
//   bezier_3x3/exact_dyadic/point    at doubles of 53 bits;  exact_fraction: at fractions of denominators up to 97
//     fixed width: exact numerators and denominator; + patch: from doubles, nothing prepared; + nearest: rounded to
//     nearest; scalar double: de Casteljau; Rational: the same template, exactly
// Counter: ulp, the worst error in units of the last place of the exact vector's largest coordinate.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/fixed_evaluate.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/refine_batch.h"
#include "validation/bench/arena.h"
#include "validation/corpus/truth.h"
#include "validation/peers/compare.h"

namespace patchproof::bench {
namespace {

using Numbers = std::vector<double>;

const validation::SurfaceCase& workload(const std::string& name) {
  static const auto all = validation::surface_workloads();
  return *std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
}

struct Refining {
  const validation::SurfaceCase& surface;
  bool bezier;
  Numbers new_u, new_v;

  Refining(const std::string& name, bool extract) : surface(workload(name)), bezier(extract) {
    if (bezier) return;
    new_u = validation::refining_knots(surface.degree_u, surface.knots_u, 20);
    new_v = validation::refining_knots(surface.degree_v, surface.knots_v, 20);
  }
  SurfaceRefinement prepare() const {
    const SurfaceRefinement::Knots knots{surface.degree_u, surface.degree_v, surface.knots_u, surface.knots_v};
    return (bezier ? SurfaceRefinement::make_bezier(knots) : SurfaceRefinement::make_insertion(knots, new_u, new_v))
        .value();
  }
};

// Worst error of Cartesian points against the exact template's.
double worst_error(const Refining& r, const Numbers& points) {
  BsplinePatch<Rational, 4> patch = validation::exact_patch(r.surface.data());
  std::vector<Vec<Rational, 4>> exact;
  if (r.bezier) {
    for (const auto& piece : extract_bezier(patch))
      exact.insert(exact.end(), piece.bezier.net().begin(), piece.bezier.net().end());
  } else {
    for (const double t : r.new_u) patch = insert_knot(patch, Direction::u, from_double(t));
    for (const double t : r.new_v) patch = insert_knot(patch, Direction::v, from_double(t));
    exact = patch.net();
  }
  if (points.size() != 3 * exact.size()) return std::nan("");
  peers::Score score;
  const auto placed = peers::Placed::records(points.data(), 1);
  for (std::size_t i = 0; i < exact.size(); ++i)
    peers::add_vector(score, placed, static_cast<std::ptrdiff_t>(i), 0,
                      {{exact[i][0] / exact[i][3], exact[i][1] / exact[i][3], exact[i][2] / exact[i][3]}});
  return score.worst;
}

// Times `run` when `error` is that of a result worth timing.
void race(benchmark::State& state, double error, const std::function<void()>& run) {
  constexpr double kAcceptable = 1e9;  // ulp: beyond this a peer computes something else
  if (!(error < kAcceptable)) {
    state.SkipWithError("wrong results");
    return;
  }
  for (auto _ : state) {
    run();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["ulp"] = error;
}

void ours(benchmark::State& state, const Refining& r, InstructionSet set, bool prepared) {
  const SurfaceRefinement first = r.prepare();
  const validation::SurfaceCase& s = r.surface;
  const std::span<double> out = room().first(first.point_count() * (s.weights.empty() ? 3 : 4));
  (void)first.apply(s.points, s.weights, out, set).value();
  Numbers points(3 * first.point_count()), weights(first.point_count());
  if (s.weights.empty())
    points.assign(out.begin(), out.end());
  else
    divide_by_weights(out, points, weights);
  race(state, worst_error(r, points), [&] {
    if (prepared)
      benchmark::DoNotOptimize(first.apply(s.points, s.weights, out, set));
    else
      benchmark::DoNotOptimize(r.prepare().apply(s.points, s.weights, out, set));
  });
}

#if defined(PATCHPROOF_HAVE_SISL) || defined(PATCHPROOF_HAVE_OCCT)
void theirs(benchmark::State& state, const Refining& r, const std::string& name) {
  std::shared_ptr<peers::PreparedSurface> surface;
  const auto run = [&](std::span<double> to) {
    return r.bezier ? surface->extract_bezier(to) : surface->refine(r.new_u, r.new_v, to);
  };
  Numbers points(3 * r.prepare().point_count());
  bool found = false;  // the first of its variants that refines
  for (const peers::Peer* peer : peers::registered_peers())
    for (int variant = 0;
         peer->name().starts_with(name) && variant < static_cast<int>(peer->variants().size()) && !found; ++variant) {
      surface = peer->prepare(r.surface.data(), variant);
      found = surface && run(points);
    }
  race(state, found ? worst_error(r, points) : std::nan(""), [&] { benchmark::DoNotOptimize(run({})); });
}
#endif

// ---- exact points ---------------------------------------------------------------------------------------------------

constexpr std::size_t kPoints = 97;  // timed in turn

struct Places {
  std::vector<double> u, v;        // what the double evaluation gets
  std::vector<std::int64_t> a, b;  // fractions a/97, b/89; empty: u, v are the parameters
};
Places places(bool dyadic) {
  Places out;
  for (std::size_t i = 0; i < kPoints; ++i)
    if (dyadic) {
      out.u.push_back(random_u()[i]);
      out.v.push_back(random_v()[i]);
    } else {
      out.a.push_back(static_cast<std::int64_t>(i));
      out.b.push_back(static_cast<std::int64_t>(i * 31 % 89));
      out.u.push_back(static_cast<double>(i) / 97);
      out.v.push_back(static_cast<double>(out.b.back()) / 89);
    }
  return out;
}
Rational exact_parameter(const Places& at, bool v, std::size_t i) {
  if (at.a.empty()) return from_double(v ? at.v[i] : at.u[i]);
  return v ? Rational(at.b[i]) / Rational(89) : Rational(at.a[i]) / Rational(97);
}
FixedParameter fixed_parameter(const Places& at, bool v, std::size_t i) {
  if (at.a.empty()) return FixedParameter::from_double(v ? at.v[i] : at.u[i]).value();
  return v ? FixedParameter::from_ratio(at.b[i], 89) : FixedParameter::from_ratio(at.a[i], 97);
}

// De Casteljau's algorithm in plain loops, along v then u.
Vec<double, 3> scalar_point(const double* net, double u, double v) {
  const auto collapse = [](Vec<double, 3>* p, double t) {
    const double s = 1 - t;
    for (int r = 3; r > 0; --r)
      for (int j = 0; j < r; ++j)
        for (std::size_t c = 0; c < 3; ++c) p[j][c] = s * p[j][c] + t * p[j + 1][c];
  };
  Vec<double, 3> column[4];
  for (int i = 0; i < 4; ++i) {
    Vec<double, 3> row[4];
    for (int j = 0; j < 4; ++j)
      for (std::size_t c = 0; c < 3; ++c) row[j][c] = net[12 * i + 3 * j + static_cast<int>(c)];
    collapse(row, v);
    column[i] = row[0];
  }
  collapse(column, u);
  return column[0];
}

enum class Method { fixed, fixed_and_patch, fixed_and_nearest, scalar, rational };

void exact_point(benchmark::State& state, bool dyadic, Method method) {
  const validation::SurfaceCase& s = workload("bezier_3x3");
  const Places at = places(dyadic);
  const FixedPatch fixed = FixedPatch::make(3, 3, s.points).value();
  std::vector<Vec<Rational, 3>> net(16);
  for (std::size_t i = 0; i < 48; ++i) net[i / 3][i % 3] = from_double(s.points[i]);
  const BezierPatch<Rational, 3> patch(3, 3, net);

  peers::Score score;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec<Rational, 3> exact = evaluate(patch, exact_parameter(at, false, i), exact_parameter(at, true, i));
    const auto point = fixed.evaluate(fixed_parameter(at, false, i), fixed_parameter(at, true, i)).value();
    Vec<double, 3> computed = scalar_point(s.points.data(), at.u[i], at.v[i]);
    for (int c = 0; c < 3 && method != Method::scalar; ++c) {
      if (point.coordinate(c) != exact[static_cast<std::size_t>(c)]) return state.SkipWithError("not exact");
      computed[static_cast<std::size_t>(c)] = point.nearest(c);
    }
    peers::add_vector(score, peers::Placed::records(computed.c.data(), 1), 0, 0, exact);
  }
  const bool is_exact = method == Method::fixed || method == Method::fixed_and_patch || method == Method::rational;
  std::size_t i = 0;
  race(state, is_exact ? 0 : score.worst, [&] {
    i = i + 1 == kPoints ? 0 : i + 1;
    switch (method) {
      case Method::scalar: benchmark::DoNotOptimize(scalar_point(s.points.data(), at.u[i], at.v[i])); break;
      case Method::rational:
        benchmark::DoNotOptimize(evaluate(patch, exact_parameter(at, false, i), exact_parameter(at, true, i)));
        break;
      case Method::fixed:
        benchmark::DoNotOptimize(fixed.evaluate(fixed_parameter(at, false, i), fixed_parameter(at, true, i)));
        break;
      case Method::fixed_and_patch:
        benchmark::DoNotOptimize(
            FixedPatch::make(3, 3, s.points)->evaluate(fixed_parameter(at, false, i), fixed_parameter(at, true, i)));
        break;
      case Method::fixed_and_nearest: {
        const auto point = fixed.evaluate(fixed_parameter(at, false, i), fixed_parameter(at, true, i));
        for (int c = 0; c < 3; ++c) benchmark::DoNotOptimize(point->nearest(c));
      }
    }
  });
}

int register_all() {
  for (const char* name : {"bspline_20x20", "nurbs_20x20"})
    for (const bool bezier : {false, true}) {
      const std::string row = std::string(name) + (bezier ? "/extract/net|" : "/refine_40x40/net|");
      for (const InstructionSet set : available_instruction_sets()) {
        const std::string own = row + "patchproof/" + to_string(set);
        for (const bool prepared : {false, true})
          benchmark::RegisterBenchmark((own + (prepared ? " prepared" : "")).c_str(), [=](benchmark::State& state) {
            ours(state, Refining(name, bezier), set, prepared);
          });
      }
#ifdef PATCHPROOF_HAVE_SISL
      benchmark::RegisterBenchmark((row + "SISL").c_str(),
                                   [=](benchmark::State& state) { theirs(state, Refining(name, bezier), "SISL"); });
#endif
#ifdef PATCHPROOF_HAVE_OCCT
      benchmark::RegisterBenchmark((row + "OCCT").c_str(),
                                   [=](benchmark::State& state) { theirs(state, Refining(name, bezier), "OCCT"); });
#endif
    }
  constexpr std::pair<const char*, Method> methods[] = {{"patchproof/fixed width", Method::fixed},
                                                        {"patchproof/fixed width + patch", Method::fixed_and_patch},
                                                        {"patchproof/fixed width + nearest", Method::fixed_and_nearest},
                                                        {"scalar double", Method::scalar},
                                                        {"Rational", Method::rational}};
  for (const bool dyadic : {true, false})
    for (const auto& [name, method] : methods)
      benchmark::RegisterBenchmark(
          (std::string("bezier_3x3/exact_") + (dyadic ? "dyadic" : "fraction") + "/point|" + name).c_str(), exact_point,
          dyadic, method);
  return 0;
}
[[maybe_unused]] const int registered = register_all();

}  // namespace
}  // namespace patchproof::bench
