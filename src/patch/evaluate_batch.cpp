// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/evaluate_batch.h"

#include <algorithm>
#include <cmath>

#include "kernels/batch_call.h"
#include "kernels/kernel_table.h"
#include "kernels/prepare.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {
namespace {

SurfaceOutput from(const SurfaceOutput& out, std::size_t begin) {
  const auto i = static_cast<std::ptrdiff_t>(begin);
  return {out.point.from(i), out.du.from(i),  out.dv.from(i), out.normal.from(i),
          out.duu.from(i),   out.duv.from(i), out.dvv.from(i)};
}

kernels::SurfaceCall call_of(const SurfaceBatchOptions& options) {
  kernels::SurfaceCall call;
  call.left_u = options.side_u == Side::left;
  call.left_v = options.side_v == Side::left;
  return call;
}

std::string describe_uv(double u, double v) {
  return "(u, v) = (" + kernels::number_text(u) + ", " + kernels::number_text(v) + ")";
}

// body(u, v, begin, count) for lists of parameters.
template <class Body>
Result<BatchSummary> run(const ParameterArray& at, int threads, const Body& body) {
  const auto part = [&](std::size_t begin, std::size_t count) { return batch::in_lists(at, begin, count, body); };
  return batch::run(at.count, batch::kShare, threads, part, [&](std::size_t i) {
    const auto place = static_cast<std::ptrdiff_t>(i) * at.stride;
    return describe_uv(at.u[place], at.v[place]);
  });
}

std::size_t first_outside(const kernels::Axis& axis, std::span<const double> t) {
  return static_cast<std::size_t>(
      std::find_if(t.begin(), t.end(), [&](double x) { return !(x >= axis.begin && x <= axis.end); }) - t.begin());
}

Error outside(const char* name, std::size_t i, double t) {
  return {ErrorCode::outside_domain, std::string(name) + "[" + std::to_string(i) + "]",
          "the parameter lies outside the domain", kernels::number_text(t)};
}

// set(call, begin): where the results of a share go.
template <class Set>
Result<BatchSummary> bounded(const kernels::SurfacePieces& pieces, const ParameterArray& at,
                             const SurfaceBatchOptions& options, const Set& set) {
  const kernels::KernelTable& table = kernels::kernel_table(options.instructions);
  return run(at, options.threads, [&](const double* u, const double* v, std::size_t begin, std::size_t count) {
    kernels::SurfaceCall call = call_of(options);
    set(call, begin);
    return table.bounded(pieces, call, u, v, count);
  });
}

// Of the span that the kernels take for t: its first control point, and its knots as those of a patch of one span.
int first_control(const kernels::Axis& axis, double t, bool left) {
  const double* begins = axis.begins(left);
  return axis.knot_span[std::upper_bound(begins + 1, begins + axis.count, t) - begins - 1] - axis.degree;
}
KnotVector<Rational> only_span(const std::vector<double>& knots, const kernels::Axis& axis, int first) {
  std::vector<Rational> out;
  for (int i = 0; i < 2 * axis.degree + 2; ++i) out.push_back(from_double(knots[first + i]));
  return KnotVector<Rational>::make_unchecked(axis.degree, std::move(out));
}

// The doubles nearest to the exact point. False where the denominator is exactly zero.
bool exact_point(const kernels::SurfacePieces& s, const kernels::SurfaceCall& call, double u, double v,
                 const VectorArray& out) {
  const int count_v = static_cast<int>(s.knots_v.size()) - s.v.degree - 1;
  const int first_u = first_control(s.u, u, call.left_u), first_v = first_control(s.v, v, call.left_v);
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i <= s.u.degree; ++i)
    for (int j = 0; j <= s.v.degree; ++j) {
      const std::size_t at = static_cast<std::size_t>(first_u + i) * count_v + first_v + j;
      const Rational w = s.rational ? from_double(s.weights[at]) : Rational(1);
      Vec<Rational, 4> point;
      for (int k = 0; k < 3; ++k) point[k] = from_double(s.points[3 * at + k]) * w;
      point[3] = w;
      net.push_back(point);
    }
  const BsplinePatch<Rational, 4> local(only_span(s.knots_u, s.u, first_u), only_span(s.knots_v, s.v, first_v),
                                        std::move(net));
  const Vec<Rational, 4> a = evaluate(local, from_double(u), from_double(v));
  if (a[3] == Rational(0)) return false;
  *out.x = nearest_double(a[0] / a[3]) + 0.0;  // no −0
  *out.y = nearest_double(a[1] / a[3]) + 0.0;
  *out.z = nearest_double(a[2] / a[3]) + 0.0;
  return true;
}

// A point that the compensated kernel cannot round for certain is computed exactly: all such points of a correctly rounded
// call; of a compensated one those that are no numbers.
Result<BatchSummary> compensated(const kernels::SurfacePieces& pieces, const ParameterArray& at,
                                 const VectorArray& point, const SurfaceBatchOptions& options, bool correctly_rounded) {
  PATCHPROOF_REQUIRES(point.wanted(), "compensated evaluation: a place for the points");
  const kernels::KernelTable& table = kernels::kernel_table(options.instructions);
  const auto lists = [&](const double* u, const double* v, std::size_t begin, std::size_t count) {
    constexpr std::size_t kPart = 4096;
    unsigned char undecided[kPart];
    for (std::size_t done = 0; done < count; done += kPart) {
      const std::size_t n = std::min(kPart, count - done);
      kernels::SurfaceCall call = call_of(options);
      call.out.point = point.from(static_cast<std::ptrdiff_t>(begin + done));
      kernels::Progress progress = table.compensated(pieces, call, u + done, v + done, n, undecided);
      if (progress.stop != kernels::Stop::none) {
        progress.good += done;
        return progress;
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (!undecided[i]) continue;
        const VectorArray one = call.out.point.from(static_cast<std::ptrdiff_t>(i));
        const bool number = std::isfinite(*one.x) && std::isfinite(*one.y) && std::isfinite(*one.z);
        if (number && !correctly_rounded) continue;
        if (!exact_point(pieces, call, u[done + i], v[done + i], one))
          return kernels::Progress{done + i, kernels::Stop::vanishing_weight, 0};
      }
    }
    return kernels::Progress{count, kernels::Stop::none, 0};
  };
  return run(at, options.threads, lists);
}

}  // namespace

Result<BatchSurface> BatchSurface::make(const SurfaceData& data) {
  auto pieces = kernels::prepare(data);
  if (!pieces) return pieces.error();
  return BatchSurface(std::make_shared<const kernels::SurfacePieces>(std::move(*pieces)));
}

ParameterBox<double> BatchSurface::domain() const {
  return {pieces_->u.begin, pieces_->u.end, pieces_->v.begin, pieces_->v.end};
}
int BatchSurface::degree(Direction d) const { return (d == Direction::u ? pieces_->u : pieces_->v).degree; }
bool BatchSurface::is_rational() const { return pieces_->rational; }

double BatchSurface::error_bound(SurfaceVector vector) const {
  double largest = 0;
  for (const kernels::PieceBounds& piece : pieces_->bounds)
    largest = std::max(largest, piece.error[static_cast<int>(vector)]);
  return largest;
}

Result<BatchSummary> BatchSurface::evaluate(const ParameterArray& at, const SurfaceOutput& out,
                                            const SurfaceBatchOptions& options) const {
  const kernels::KernelTable& table = kernels::kernel_table(options.instructions);
  return run(at, options.threads, [&](const double* u, const double* v, std::size_t begin, std::size_t count) {
    kernels::SurfaceCall call = call_of(options);
    call.out = from(out, begin);
    return table.surface(*pieces_, call, u, v, count);
  });
}

Result<BatchSummary> BatchSurface::evaluate_grid(std::span<const double> u, std::span<const double> v,
                                                 const SurfaceOutput& out, const SurfaceBatchOptions& options) const {
  const kernels::KernelTable& table = kernels::kernel_table(options.instructions);
  if (const std::size_t i = first_outside(pieces_->u, u); i < u.size()) return outside("u", i, u[i]);
  if (const std::size_t j = first_outside(pieces_->v, v); j < v.size()) return outside("v", j, v[j]);
  if (u.empty() || v.empty()) return BatchSummary{};
  const std::size_t columns = v.size(), share = std::max(std::size_t{1}, batch::kShare / columns) * columns;
  // Whole rows, or one item.
  const auto part = [&](std::size_t begin, std::size_t count) {
    kernels::SurfaceCall call = call_of(options);
    call.out = from(out, begin);
    const std::size_t rows = std::max(std::size_t{1}, count / columns);
    return table.grid(*pieces_, call, u.data() + begin / columns, rows, v.data() + begin % columns, count / rows);
  };
  return batch::run(u.size() * columns, share, options.threads, part,
                    [&](std::size_t i) { return describe_uv(u[i / columns], v[i % columns]); });
}

Result<BatchSummary> BatchSurface::evaluate_bounded(const ParameterArray& at, const VectorArray& point, double* bound,
                                                    const SurfaceBatchOptions& options) const {
  return bounded(*pieces_, at, options, [&](kernels::SurfaceCall& call, std::size_t begin) {
    call.out.point = point.from(static_cast<std::ptrdiff_t>(begin));
    call.bound = bound == nullptr ? nullptr : bound + begin;
  });
}

Result<BatchSummary> BatchSurface::evaluate_interval(const ParameterArray& at, const VectorArray& lower,
                                                     const VectorArray& upper,
                                                     const SurfaceBatchOptions& options) const {
  PATCHPROOF_REQUIRES(lower.wanted() == upper.wanted(), "evaluate_interval: both ends or none");
  return bounded(*pieces_, at, options, [&](kernels::SurfaceCall& call, std::size_t begin) {
    call.lower = lower.from(static_cast<std::ptrdiff_t>(begin));
    call.upper = upper.from(static_cast<std::ptrdiff_t>(begin));
  });
}

Result<BatchSummary> BatchSurface::evaluate_compensated(const ParameterArray& at, const VectorArray& point,
                                                        const SurfaceBatchOptions& options) const {
  return compensated(*pieces_, at, point, options, false);
}

Result<BatchSummary> BatchSurface::evaluate_correctly_rounded(const ParameterArray& at, const VectorArray& point,
                                                              const SurfaceBatchOptions& options) const {
  return compensated(*pieces_, at, point, options, true);
}

}  // namespace patchproof
