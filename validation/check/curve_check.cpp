// SPDX-License-Identifier: Apache-2.0
// Curves: the same questions as for surfaces.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "kernels/pieces.h"
#include "validation/check/judge.h"

namespace patchproof::validation {
namespace {

constexpr std::array<const char*, 3> kNames{"C", "C'", "C''"};

// C, C', C'' of all items as records; `all`: or C alone. Sorted parameters take another way through the kernels.
std::optional<std::vector<double>> evaluate(const BatchCurve& curve, const CurveCase& c, const std::vector<double>& t,
                                            InstructionSet set, bool records, bool all, Tally& tally) {
  const auto n = static_cast<std::ptrdiff_t>(t.size());
  std::vector<double> room(9 * t.size() + 1, std::nan("")), out(9 * t.size());
  double* const from = room.data() + 1;
  const auto place = [&](int k) {
    double* const x = from + 3 * n * k;
    return records ? VectorArray::records(from + 3 * k, 9) : VectorArray::separate(x, x + n, x + 2 * n);
  };
  CurveOutput to;
  to.point = place(0);
  if (all) to = {place(0), place(1), place(2)};
  CurveBatchOptions options;
  options.side = c.side;
  options.instructions = set;
  const Result<BatchSummary> done = curve.evaluate(t, to, options);
  if (!done) {
    if (tally.violations++ == 0) tally.violation = c.name + ": refused: " + done.error().text();
    return {};
  }
  for (int k = 0; k < (all ? 3 : 1); ++k) {
    const VectorArray a = place(k);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      out[9 * i + 3 * k] = a.x[i * a.stride];
      out[9 * i + 3 * k + 1] = a.y[i * a.stride];
      out[9 * i + 3 * k + 2] = a.z[i * a.stride];
    }
  }
  return out;
}

}  // namespace

void check_curve(const CurveCase& given, const CheckOptions& options, Tallies& tallies) {
  const BsplineCurve<Rational, 4> exact_c = exact_curve(given.data());
  CurveCase c = given;
  const auto tally = [&](const std::string& kernel, InstructionSet set) -> Tally& {
    return tallies[{kernel, set, c.group}];
  };
  const Result<BatchCurve> curve = BatchCurve::make(c.data());
  if (!curve) {
    Tally& t = tally("C", resolve(InstructionSet::fastest));
    if (t.violations++ == 0) t.violation = c.name + ": refused: " + curve.error().text();
    return;
  }
  for (const InstructionSet set : options.sets)
    if (!c.weights.empty())
      drop_vanishing(
          [&] {
            std::vector<double> room(3 * c.t.size());
            CurveOutput to;
            to.point = VectorArray::interleaved(room.data());
            CurveBatchOptions call;
            call.side = c.side;
            call.instructions = set;
            return curve->evaluate(c.t, to, call);
          },
          [&](std::size_t i) {
            return is_negligible(evaluate(exact_c, from_double(c.t[i]), c.side), c.weights, c.degree);
          },
          [&](std::size_t i) { c.t.erase(c.t.begin() + static_cast<std::ptrdiff_t>(i)); });
  const KnotVector<double> knots = KnotVector<double>::make(c.degree, c.knots).value();
  std::vector<CurveTruth> truth;
  for (const double t : c.t) truth.push_back(exact_values(exact_c, t, c.side, 2));
  // Sorted, each parameter many times: whole vectors in one piece.
  constexpr std::size_t kTimes = 20;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < c.t.size(); ++i) order.insert(order.end(), kTimes, i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return c.t[a] < c.t[b]; });
  std::vector<double> sorted;
  for (const std::size_t i : order) sorted.push_back(c.t[i]);

  std::optional<std::vector<double>> fused;
  for (const InstructionSet set : options.sets) {
    Tally &first = tally("C", set), &same = tally("same bits", set);
    const auto plain = evaluate(*curve, c, c.t, set, false, true, first);
    const auto records = evaluate(*curve, c, c.t, set, true, true, first);
    const auto points = evaluate(*curve, c, c.t, set, false, false, first);
    const auto runs = evaluate(*curve, c, sorted, set, false, true, first);
    if (!plain || !records || !points || !runs) continue;
    for (std::size_t i = 0; i < c.t.size(); ++i) {
      const kernels::CurvePieces& pieces = curve->pieces();
      const int span = knots.find_span(c.t[i], c.side);
      const auto piece =
          std::find(pieces.t.knot_span.begin(), pieces.t.knot_span.end(), span) - pieces.t.knot_span.begin();
      for (int k = 0; k < 3; ++k) {
        const Rational largest = largest_coordinate(truth[i][k]);
        for (int x = 0; x < 3; ++x) {
          const std::size_t at = 9 * i + 3 * k + x;
          const auto place = [&] {
            return fmt::format("{} at {:a}{}.{}", c.name, c.t[i], c.side == Side::left ? " from the left" : "",
                               "xyz"[x]);
          };
          Judge(tally(kNames[k], set), truth[i][k][x], largest)
              .number(perhaps_broken(options, kNames[k], (*plain)[at]), pieces.bounds[piece].error[k], place);
          same_bits(same, (*plain)[at], (*records)[at], place);
          if (k == 0) same_bits(same, (*plain)[at], (*points)[at], place);
          if (fused && fuses_multiply_add(set)) same_bits(same, (*fused)[at], (*plain)[at], place);
        }
      }
    }
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = 0; k < 9; ++k)
        same_bits(same, (*plain)[9 * order[i] + k], (*runs)[9 * i + k],
                  [&] { return fmt::format("{} at {:a}, alone and in a run", c.name, sorted[i]); });
    if (fuses_multiply_add(set) && !fused) fused = plain;
  }
}

}  // namespace patchproof::validation
