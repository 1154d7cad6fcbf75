// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/evaluate_batch.h"

#include <algorithm>

#include "kernels/batch_call.h"
#include "kernels/kernel_table.h"
#include "kernels/prepare.h"

namespace patchproof {

Result<BatchCurve> BatchCurve::make(const CurveData& data) {
  auto pieces = kernels::prepare(data);
  if (!pieces) return pieces.error();
  return BatchCurve(std::make_shared<const kernels::CurvePieces>(std::move(*pieces)));
}

double BatchCurve::domain_begin() const { return pieces_->t.begin; }
double BatchCurve::domain_end() const { return pieces_->t.end; }
int BatchCurve::degree() const { return pieces_->t.degree; }
bool BatchCurve::is_rational() const { return pieces_->rational; }

double BatchCurve::error_bound(int derivative) const {
  PATCHPROOF_REQUIRES(0 <= derivative && derivative <= 2, "error_bound: derivatives 0, 1, 2");
  double largest = 0;
  for (const kernels::PieceBounds& piece : pieces_->bounds) largest = std::max(largest, piece.error[derivative]);
  return largest;
}

Result<BatchSummary> BatchCurve::evaluate(const ParameterArray& t, const CurveOutput& out,
                                          const CurveBatchOptions& options) const {
  const kernels::KernelTable& table = kernels::kernel_table(options.instructions);
  const auto lists = [&](const double* list, const double*, std::size_t begin, std::size_t count) {
    const auto from = static_cast<std::ptrdiff_t>(begin);
    return table.curve(*pieces_, {out.point.from(from), out.first.from(from), out.second.from(from)},
                       options.side == Side::left, list, count);
  };
  const auto part = [&](std::size_t begin, std::size_t count) { return batch::in_lists(t, begin, count, lists); };
  return batch::run(t.count, batch::kShare, options.threads, part, [&](std::size_t i) {
    return "t = " + kernels::number_text(t.u[static_cast<std::ptrdiff_t>(i) * t.stride]);
  });
}

}  // namespace patchproof
