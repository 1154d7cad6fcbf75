// SPDX-License-Identifier: Apache-2.0
// What is prepared once and called by all: batches of surfaces and curves on every instruction set, refinements, decisions.
#include "patchproof/join/decide_batch.h"
#include "patchproof/patch/evaluate_batch.h"
#include "patchproof/patch/fixed_evaluate.h"
#include "patchproof/patch/refine_batch.h"
#include "support/batch_results.h"
#include "support/g1_joins.h"
#include "support/scalars.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

const std::vector<double> kKnotsU{0, 0, 0, 0, 1, 2, 2, 4, 4, 4, 4}, kKnotsV{0, 0, 0, 1, 3, 3, 3};

struct Net {
  std::vector<double> points, weights;
  Net(std::size_t count, std::uint64_t seed) : points(3 * count), weights(count) {
    std::mt19937_64 engine(seed);
    const auto number = [&] { return static_cast<double>(engine() % 20001) / 1e4 - 1; };
    for (double& x : points) x = 10 * number();
    for (double& w : weights) w = 1.5 + number();
  }
};

struct Places {
  std::vector<double> u, v, lines_u, lines_v;
  Places() {
    for (int i = 0; i <= 20; ++i) lines_u.push_back(i * 0.2), lines_v.push_back(i * 0.15);
    for (int i = 0; i < 700; ++i)
      u.push_back(i % 41 * 0.1 > 4 ? 4 : i % 41 * 0.1), v.push_back(i % 31 * 0.1 > 3 ? 3 : i % 31 * 0.1);
  }
};

TEST(ThreadsBatch, SurfacesOnEveryInstructionSet) {
  const Net net(7 * 4, 3);
  const Places at;
  const BatchSurface plain = BatchSurface::make({3, 2, kKnotsU, kKnotsV, net.points, {}}).value(),
                     rational = BatchSurface::make({3, 2, kKnotsU, kKnotsV, net.points, net.weights}).value();
  Together all;
  for (const BatchSurface* surface : {&plain, &rational})
    for (const InstructionSet set : available_instruction_sets()) {
      const SurfaceBatchOptions options{.side_u = Side::left, .instructions = set};
      const std::string name = std::string(to_string(set)) + (surface->is_rational() ? ", rational: " : ": ");
      all.add(name + "everything", [=, &at] {
        Results results(at.u.size());
        const auto done = surface->evaluate(at.u, at.v, results.out, options).value();
        return say(done.undefined_normals, std::vector(std::begin(results.numbers), std::end(results.numbers)));
      });
      all.add(name + "grid", [=, &at] {
        Results results(at.lines_u.size() * at.lines_v.size(), 0x47);
        return say(surface->evaluate_grid(at.lines_u, at.lines_v, results.out, options).value().undefined_normals,
                   results.numbers[0], results.numbers[2], results.numbers[6]);
      });
      all.add(name + "bounds", [=, &at] {
        std::vector<double> point(3 * at.u.size()), lower = point, upper = point, bound(at.u.size());
        const auto into = [](std::vector<double>& x) { return VectorArray::interleaved(x.data()); };
        return say(surface->evaluate_bounded(at.u, at.v, into(point), bound.data(), options).has_value(), point, bound,
                   surface->evaluate_interval(at.u, at.v, into(lower), into(upper), options).has_value(), lower, upper);
      });
      all.add(name + "roundings", [=, &at] {
        std::vector<double> near(3 * at.u.size()), nearest = near;
        const auto into = [](std::vector<double>& x) { return VectorArray::interleaved(x.data()); };
        return say(surface->evaluate_compensated(at.u, at.v, into(near), options).has_value(), near,
                   surface->evaluate_correctly_rounded(at.u, at.v, into(nearest), options).has_value(), nearest);
      });
      all.add(name + "error bounds", [=] {
        Said out;
        for (const auto m : {SurfaceVector::point, SurfaceVector::du, SurfaceVector::dv, SurfaceVector::duu,
                             SurfaceVector::duv, SurfaceVector::dvv})
          out.add(surface->error_bound(m));
        return out.text();
      });
    }
  all.add("an error", [&] {
    double xyz[3];
    SurfaceOutput out;
    out.point = VectorArray::interleaved(xyz);
    const std::vector<double> u{17}, v{1};
    return plain.evaluate(u, v, out).error().text();
  });
  all.run();
}

TEST(ThreadsBatch, CurvesOnEveryInstructionSet) {
  const Net net(7, 4);
  const Places at;
  const BatchCurve plain = BatchCurve::make({3, kKnotsU, net.points, {}}).value(),
                   rational = BatchCurve::make({3, kKnotsU, net.points, net.weights}).value();
  Together all;
  for (const BatchCurve* curve : {&plain, &rational})
    for (const InstructionSet set : available_instruction_sets())
      all.add(to_string(set), [=, &at] {
        std::vector<double> point(3 * at.u.size()), first = point, second = point;
        CurveOutput out;
        out.point = VectorArray::interleaved(point.data());
        out.first = VectorArray::interleaved(first.data());
        out.second = VectorArray::interleaved(second.data());
        const bool done = curve->evaluate(at.u, out, {.instructions = set}).has_value();
        return say(done, point, first, second, curve->error_bound(0), curve->error_bound(2));
      });
  all.run();
}

TEST(ThreadsBatch, RefinementsOnEveryInstructionSet) {
  const Net net(7 * 4, 5);
  const std::vector<double> new_u{0.5, 3, 3}, new_v{2};
  const SurfaceRefinement::Knots knots{3, 2, kKnotsU, kKnotsV};
  const auto inserted = SurfaceRefinement::make_insertion(knots, new_u, new_v).value(),
             bezier = SurfaceRefinement::make_bezier(knots).value();
  Together all;
  for (const SurfaceRefinement* refinement : {&inserted, &bezier})
    for (const InstructionSet set : available_instruction_sets())
      for (const bool weights : {false, true})
        all.add(to_string(set), [=, &net] {
          std::vector<double> out((weights ? 4 : 3) * refinement->point_count());
          const auto bounds =
              refinement
                  ->apply(net.points, weights ? std::span<const double>(net.weights) : std::span<const double>(), out,
                          set)
                  .value();
          return say(out, bounds.coordinate, bounds.weight, refinement->knots(Direction::u));
        });
  all.run();
}

TEST(ThreadsBatch, PointsInIntegersOfFixedWidth) {
  const Net net(16, 6);
  const FixedPatch patch = FixedPatch::make(3, 3, net.points, net.weights).value();
  Together all;
  all.add("points", [&] {
    Said out;
    for (int i = 0; i <= 8; ++i) {
      const auto at = patch.evaluate(FixedParameter::from_ratio(i, 8), *FixedParameter::from_double(0.3)).value();
      for (int c = 0; c < 3; ++c) out.add(at.coordinate(c)), out.add(at.nearest(c));
    }
    return out.text();
  });
  all.run();
}

TEST(ThreadsBatch, JoinsAreDecidedOnEveryInstructionSet) {
  std::vector<BicubicJoinRows> rows;
  for (const G1Family* family : {&kD24, &kD53, &kC1, &kR53})
    for (const BicubicJoinRows& each : make_g1_joins(*family, 12)) rows.push_back(each);
  for (std::size_t i = 0; i < rows.size(); i += 3) spoil(rows[i]);
  Together all;
  for (const auto set : {kernels::InstructionSet::portable, kernels::InstructionSet::avx2,
                         kernels::InstructionSet::avx512, kernels::InstructionSet::avx512_ifma}) {
    if (!kernels::is_available(set)) continue;
    all.add(kernels::name_of(set), [&rows, set] {
      std::vector<JoinDecision> out(rows.size());
      kernels::decide_batch(rows, {}, out, set);
      Said said;
      for (const JoinDecision& each : out) said.add(each.c0), said.add(each.c1), said.add(each.g1), said.add(each.rung);
      return said.text();
    });
  }
  all.run();
}

}  // namespace
}  // namespace patchproof::test
