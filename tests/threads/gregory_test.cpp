// SPDX-License-Identifier: Apache-2.0
// Gregory patches that all threads read: in every scalar, in batches, and proved regular.
#include "patchproof/join/gregory_proof.h"
#include "patchproof/patch/gregory_approximate.h"
#include "patchproof/patch/gregory_batch.h"
#include "patchproof/patch/gregory_expand.h"
#include "support/gregory_patches.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

template <class T>
void add_operations(Together& all, const std::string& scalar, const GregoryPatch<T>& patch, const Rational& at_u,
                    const Rational& at_v) {
  using K = knot_scalar_t<T>;
  const K u = make_knot<T>(at_u), v = make_knot<T>(at_v);
  all.add(scalar, [&patch, u, v] {
    [[maybe_unused]] const GuardFor<T> guard{};
    const SurfaceFrame<T> at = frame(patch, u, v);
    const SecondDerivatives<T> second = second_derivatives(patch, u, v);
    return say(evaluate(patch, u, v), at.du, at.dv, at.normal(), second.duu, second.duv, second.dvv);
  });
}

TEST(ThreadsGregory, PatchesAreReadByAllInEveryScalar) {
  RandomRationals random;
  const GregoryPatch<Rational> exact = random_gregory_patch(random, {.rational = true, .dyadic = true});
  const auto interval = [&] {
    const RoundingGuard guard;
    return make_patch<Interval>(exact);
  }();
  const auto ball = make_patch<Ball>(exact);
  const auto rounded = make_patch<double>(exact);
  const Rational u = Rational(5) / Rational(16), v = Rational(3) / Rational(4);
  Together all;
  add_operations(all, "Rational", exact, u, v);
  add_operations(all, "Interval", interval, u, v);
  add_operations(all, "Ball", ball, u, v);
  add_operations(all, "double", rounded, u, v);
  all.add("corners", [&] {
    Said out;
    for (const auto& twists : corner_twists(exact)) out.add(twists.from_u), out.add(twists.from_v);
    out.add(corners_agree(exact));
    return out.text();
  });
  all.run();
}

TEST(ThreadsGregory, BatchesAreReadByAll) {
  RandomRationals random;
  Together all;
  std::vector<BatchGregory> batches;
  for (const bool rational : {false, true})
    batches.push_back(BatchGregory::make(random_gregory_patch(random, {rational, true})).value());
  std::vector<double> u, v;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 12; ++j) u.push_back(i / 12.0), v.push_back(j * j / 144.0);
  for (const BatchGregory& batch : batches)
    for (const InstructionSet set : available_instruction_sets())
      all.add(std::string(to_string(set)), [&u, &v, &batch, set] {
        std::vector<double> point(3 * u.size()), du = point, normal = point, duv = point;
        SurfaceOutput out;
        out.point = VectorArray::interleaved(point.data());
        out.du = VectorArray::interleaved(du.data());
        out.normal = VectorArray::interleaved(normal.data());
        out.duv = VectorArray::interleaved(duv.data());
        const auto done = batch.evaluate(u, v, out, {.instructions = set});
        return say(done.has_value(), point, du, normal, duv, batch.error_bound(SurfaceVector::point));
      });
  all.run();
}

TEST(ThreadsGregory, PatchesAreProvedAndApproximatedByAll) {
  RandomRationals random;
  const GregoryPatch<Rational> patch = random_gregory_patch(random, {.rational = false, .dyadic = true});
  Together all;
  all.add("proof", [&] {
    const GregoryProof proof = prove_patch(patch, 200);
    return say(proof.matched, proof.corners, proof.c1, proof.positive, proof.regular.verdict, proof.regular.reason,
               proof.boxes);
  });
  all.add("as a NURBS patch", [&] { return say(expand(patch).surface); });
  const BlendSpline blend = BlendSpline::make(4);
  all.add("as a patch of positive weights", [&] {
    const auto near = approximate(patch, blend, 200).value();
    return say(near.surface, near.point_deviation, near.normal_angle);
  });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
