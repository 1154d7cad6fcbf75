// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/evaluate_batch.h"

#include <algorithm>

#include "kernels/batch_call.h"
#include "kernels/kernel_table.h"
#include "kernels/prepare.h"

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

std::string describe_uv(double u, double v) { return "(u, v) = (" + batch::text(u) + ", " + batch::text(v) + ")"; }

std::size_t first_outside(const kernels::Axis& axis, std::span<const double> t) {
  return static_cast<std::size_t>(
      std::find_if(t.begin(), t.end(), [&](double x) { return !(x >= axis.begin && x <= axis.end); }) - t.begin());
}

Error outside(const char* name, std::size_t i, double t) {
  return {ErrorCode::outside_domain, std::string(name) + "[" + std::to_string(i) + "]",
          "the parameter lies outside the domain", batch::text(t)};
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

Result<BatchSummary> BatchSurface::evaluate(std::span<const double> u, std::span<const double> v,
                                            const SurfaceOutput& out, const SurfaceBatchOptions& options) const {
  PATCHPROOF_REQUIRES(u.size() == v.size(), "evaluate: as many u as v");
  const kernels::KernelTable& table = kernels::kernel_table(options.instructions);
  const auto part = [&](std::size_t begin, std::size_t count) {
    kernels::SurfaceCall call = call_of(options);
    call.out = from(out, begin);
    return table.surface(*pieces_, call, u.data() + begin, v.data() + begin, count);
  };
  return batch::run(u.size(), batch::kShare, options.threads, part,
                    [&](std::size_t i) { return describe_uv(u[i], v[i]); });
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

}  // namespace patchproof
