// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/refine_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "kernels/refine/refine.h"

namespace patchproof {
namespace {

namespace refine_kernels = kernels::refine;

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
constexpr double kTiniest = std::numeric_limits<double>::denorm_min();

struct alignas(64) CacheLine {
  double numbers[8];
};

const refine_kernels::Table& table_for(InstructionSet set) {
  const InstructionSet own = resolve(set);
  PATCHPROOF_REQUIRES(is_available(own), "the instruction set is not available here");
  switch (own) {
#if defined(PATCHPROOF_KERNELS_X86)
    case InstructionSet::sse4: return refine_kernels::kSse4;
    case InstructionSet::avx2: return refine_kernels::kAvx2;
    case InstructionSet::avx512: return refine_kernels::kAvx512;
#elif defined(PATCHPROOF_KERNELS_NEON)
    case InstructionSet::neon: return refine_kernels::kNeon;
#endif
    default: return refine_kernels::kPortable;
  }
}

Result<KnotVector<double>> checked_knots(int degree, std::span<const double> knots) {
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (!std::isfinite(knots[i]))
      return Error{ErrorCode::bad_number, "knot " + std::to_string(i), "a knot is not finite",
                   std::to_string(knots[i])};
  auto made = KnotVector<double>::make(degree, {knots.begin(), knots.end()});
  if (made.has_value() && !std::isfinite(knots.back() - knots.front()))
    return Error{ErrorCode::bad_number, "", "the distance of the first and the last knot overflows", ""};
  return made;
}

refine_kernels::Band view(const RefinementBand<double>& band, int pieces) {
  return {band.degree + 1, band.rows(), band.rows() / pieces, band.first.data(), band.coefficients.data()};
}

// γ_N M + C (1 + M) 2^-1074 rounded up: 1/(1 − N u) ≤ 1 + 2 N u, and the roundings here, are below the factor added as
// long as N < 2^20; four units of 2^-1074 make good what the small terms lose.
double bound_of(int roundings, double underflow, double largest) {
  constexpr double up = 1 + 0x1p-30;
  return (roundings * kUnit) * up * largest + kTiniest * (underflow * up * (1 + largest) + 4);
}

}  // namespace

Result<SurfaceRefinement::Axis> SurfaceRefinement::insertion_axis(int degree, std::span<const double> knots,
                                                                  std::span<const double> added) {
  const auto old = checked_knots(degree, knots);
  if (!old) return old.error();
  for (std::size_t i = 0; i < added.size(); ++i)
    if (!old->in_domain(added[i]))
      return Error{ErrorCode::outside_domain, "new knot " + std::to_string(i), "a new knot lies outside the domain",
                   std::to_string(added[i])};
  std::vector<double> sorted;
  if (!std::is_sorted(added.begin(), added.end())) {
    sorted.assign(added.begin(), added.end());
    std::sort(sorted.begin(), sorted.end());
    added = sorted;
  }
  std::vector<double> all(knots.size() + added.size());
  std::merge(knots.begin(), knots.end(), added.begin(), added.end(), all.begin());
  const auto finer = KnotVector<double>::make_unchecked(degree, std::move(all));
  return Axis{refinement_band<double>(*old, finer), finer.knots(), 1};
}

Result<SurfaceRefinement::Axis> SurfaceRefinement::bezier_axis(int degree, std::span<const double> knots) {
  const auto old = checked_knots(degree, knots);
  if (!old) return old.error();
  Axis axis{bezier_band<double>(*old), old->breaks(), 0};
  axis.pieces = static_cast<int>(axis.knots.size()) - 1;
  return axis;
}

Result<SurfaceRefinement> SurfaceRefinement::make_insertion(const Knots& knots, std::span<const double> new_u,
                                                            std::span<const double> new_v) {
  auto u = insertion_axis(knots.degree_u, knots.knots_u, new_u);
  if (!u) return u.error();
  auto v = insertion_axis(knots.degree_v, knots.knots_v, new_v);
  if (!v) return v.error();
  return SurfaceRefinement(std::move(*u), std::move(*v));
}

Result<SurfaceRefinement> SurfaceRefinement::make_bezier(const Knots& knots) {
  auto u = bezier_axis(knots.degree_u, knots.knots_u);
  if (!u) return u.error();
  auto v = bezier_axis(knots.degree_v, knots.knots_v);
  if (!v) return v.error();
  return SurfaceRefinement(std::move(*u), std::move(*v));
}

Result<CurveRefinement> CurveRefinement::make_insertion(int degree, std::span<const double> knots,
                                                        std::span<const double> added) {
  const double unit[] = {0, 1};
  auto line = SurfaceRefinement::make_insertion({0, degree, unit, knots}, {}, added);
  if (!line) return line.error();
  return CurveRefinement(std::move(*line));
}

Result<CurveRefinement> CurveRefinement::make_bezier(int degree, std::span<const double> knots) {
  const double unit[] = {0, 1};
  auto line = SurfaceRefinement::make_bezier({0, degree, unit, knots});
  if (!line) return line.error();
  return CurveRefinement(std::move(*line));
}

Result<RefinementBounds> SurfaceRefinement::apply(std::span<const double> points, std::span<const double> weights,
                                                  std::span<double> out, InstructionSet instructions) const {
  const auto& table = table_for(instructions);
  const RefinementBand<double>&u = u_.band, &v = v_.band;
  const std::size_t count = static_cast<std::size_t>(u.old_count) * static_cast<std::size_t>(v.old_count);
  if (points.size() != 3 * count)
    return Error{ErrorCode::wrong_count, "points", "the knots need " + std::to_string(count) + " control points",
                 std::to_string(points.size()) + " numbers"};
  if (!weights.empty() && weights.size() != count)
    return Error{ErrorCode::wrong_count, "weights", "one weight for each control point, or none",
                 std::to_string(weights.size())};
  PATCHPROOF_REQUIRES(out.size() == point_count() * (weights.empty() ? 3 : 4), "refine: the output has a wrong size");

  const double weight = weights.empty() ? 1 : table.largest(weights.data(), count);
  const double coordinate = table.largest(points.data(), points.size()) * weight * (1 + 0x1p-50);
  if (!(coordinate <= 0x1p1022 && weight <= 0x1p1022))
    return Error{ErrorCode::bad_number, "", "a coordinate or weight is not finite, or their products may overflow", ""};

  std::vector<const double*> lines(u.degree + std::size_t(1));
  refine_kernels::Job job;
  job.u = view(u, u_.pieces);
  job.v = view(v, v_.pieces);
  job.count_u = u.old_count;
  job.count_v = v.old_count;
  job.points = points.data();
  job.weights = weights.empty() ? nullptr : weights.data();
  job.out = out.data();
  job.lines = lines.data();
  const std::size_t scratch_lines = (refine_kernels::scratch_size(job) + 7) / 8;
  std::array<CacheLine, 256> here;  // enough for nets of usual width
  std::unique_ptr<CacheLine[]> there;
  if (scratch_lines > here.size()) there = std::make_unique_for_overwrite<CacheLine[]>(scratch_lines);
  job.scratch = (there ? there[0] : here[0]).numbers;
  table.refine(job);

  const int roundings = 6 * (u.degree + v.degree) + 2;
  const double a = u.degree + 2.0, b = v.degree + 2.0, underflow = a * a + b * b;
  RefinementBounds bounds;
  bounds.coordinate = bound_of(roundings + (weights.empty() ? 0 : 1), underflow, coordinate);
  bounds.weight = weights.empty() ? 0 : bound_of(roundings, underflow, weight);
  return bounds;
}

void divide_by_weights(std::span<const double> homogeneous, std::span<double> points, std::span<double> weights) {
  const std::size_t n = weights.size();
  PATCHPROOF_REQUIRES(homogeneous.size() == 4 * n && points.size() == 3 * n, "divide_by_weights: sizes differ");
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < 3; ++c) points[3 * i + c] = homogeneous[4 * i + c] / homogeneous[4 * i + 3];
    weights[i] = homogeneous[4 * i + 3];
  }
}

}  // namespace patchproof
