// SPDX-License-Identifier: Apache-2.0
// C0, C1 and G1 of many bicubic joins at once, each decided exactly, eight (AVX-512) or four (AVX2) in one vector.
//
// The rows, det, n_A and n_B are those of fixed_g1.h; F is the edge row of the second patch, when it is given apart.
//     C0   E and F are the same curve: E_w F − F_w E ≡ 0. The same numbers are; unequal weighted rows may still be.
//     C1   C0, and the patches on [0, 1] with these rows have opposite cross derivatives. With F = E:
//          A + B = 2 E; with weights E_w S − S_w E ≡ 0, S = A + B
//     G1   C0, and the answer of fixed_g1.h; additionally, det ≢ 0 is refuted at any length of the numbers when doubles
//          show it
//
// THE LADDER, for each join
//   edges     the edges differ: every class is refuted
//   filter    det in doubles, each coefficient with a proved bound of its error: one that is certainly not zero
//             refutes. Bounds: 23 u C(8, s) P, rational 50 u c_s P, u = 2^-53, P the permanent of the largest sizes of
//             the coordinates; derived in src/join/decide_forms.h
//   modular   det modulo primes below 2^47 or 2^28. The filter's bound also says how large det can be when it is not
//             refuted: |det coefficient| ≤ 2 · bound, far less than 2^(3 (b + 1) + 8.8), which whole numbers below 2^b
//             allow, or 2^(4 h + 13.5) for homogeneous numbers below 2^h. Zero modulo primes whose product is greater
//             is zero; one residue that is not zero refutes. Sides and regularity: n_A · n_B < 0 in doubles, with
//             bounds of their own
//   fixed     decide_fixed_g1: what the two above leave open, and numbers they do not take: edge coordinates or
//             differences of which one kind spreads over more than 103 bits (with weights: points and weights over 61
//             bits, homogeneous ones over 103), sizes outside 2^±900, rows of zeros
//
// REQUIRES  all numbers are finite.
// ENSURES   (1) c0 and c1 are the statements above;  (2) g1 is what decide_fixed_g1 answers, when that is not empty and
//           the join is C0;  (3) otherwise g1 is empty or refuted, and refuted only if not C0 or det ≢ 0;  (4) c0, c1,
//           g1 do not depend on the instruction set, on other joins in the batch, on its order, on the rounding mode of
//           the thread; (5) an edge weight that is not positive leaves g1 of a C0 join empty.
// ERRORS    contract_error for numbers that are not finite; then `out` holds anything.
// COST      tens of nanoseconds for a polynomial join of doubles with AVX-512. No heap, but weighted joins whose C0 or
//           C1 is not plain take microseconds in Rational.
// SOURCE    zero tests modulo primes: J. von zur Gathen, J. Gerhard, Modern Computer Algebra, ch. 5. Residues without
//           final subtraction: P. L. Montgomery, Modular multiplication without trial division, Math. Comp. 44 (1985)
//           519–521.
#pragma once

#include <span>

#include "patchproof/join/fixed_g1.h"

namespace patchproof {

// The edge row of the second patch, points in the sense of the join's rows.points.
struct BicubicEdge {
  BicubicJoinRows::Row points{};
  std::array<double, 4> weights{1, 1, 1, 1};
};

enum class DecidedBy { edges, filter, modular, fixed, nothing };
const char* name_of(DecidedBy rung);

struct JoinDecision {
  bool c0 = false, c1 = false;
  std::optional<FixedG1> g1 = std::nullopt;  // empty: ask continuity.h
  DecidedBy rung = DecidedBy::nothing;       // of g1

  friend bool operator==(const JoinDecision&, const JoinDecision&) = default;
};

// One join, by the rungs edges, fixed and, where the numbers are too long for that, filter. other_edge: null when the
// sides share the edge.
JoinDecision decide_join(const BicubicJoinRows& rows, const BicubicEdge* other_edge = nullptr);

// ---- in the target patchproof::kernels ------------------------------------------------------------------------------

namespace kernels {

enum class InstructionSet { portable, avx2, avx512, avx512_ifma };

const char* name_of(InstructionSet set);
bool is_available(InstructionSet set);  // built for this kind of processor, and the processor has it
InstructionSet best_instruction_set();

// out[i] is the decision of rows[i] with other_edges[i]. REQUIRES out.size() == rows.size(), other_edges is empty (all
// sides share their edges) or of that size too, `set` is available.
void decide_batch(std::span<const BicubicJoinRows> rows, std::span<const BicubicEdge> other_edges,
                  std::span<JoinDecision> out, InstructionSet set = best_instruction_set());

}  // namespace kernels
}  // namespace patchproof
