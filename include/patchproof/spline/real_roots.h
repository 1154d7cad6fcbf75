// SPDX-License-Identifier: Apache-2.0
// Where a polynomial with exact coefficients vanishes inside (0, 1): disjoint intervals, one root each.
//
// ENSURES  (1) the roots of f in the open interval (0, 1), multiple ones counted once, correspond one to one to the
//          intervals returned, in growing order; [a, a] is the exact root a, in (a, b) with a < b lies one root and neither
//          end is a root, except that 0 and 1 may be;  (2) every interval is narrower than `width`;
//          (3) odd_part(f) has f's sign wherever f is not zero in (0, 1), and only simple roots: those where f changes sign.
// SCALARS  F: ExactField.
// SOURCE   Descartes' rule of signs on Bernstein coefficients: G. Collins, A. Akritas, SYMSAC 1976; square-free first, so
//          the subdivision ends.
#pragma once

#include <utility>
#include <vector>

#include "patchproof/spline/binary_form.h"

namespace patchproof {

// REQUIRES f is not the zero polynomial.
template <ExactField F>
std::vector<std::pair<F, F>> isolate_roots(const BinaryForm<F>& f, const F& width);

// The product of f's factors of odd multiplicity, up to a positive constant. REQUIRES f is not the zero polynomial.
template <ExactField F>
BinaryForm<F> odd_part(const BinaryForm<F>& f);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <ExactField F>
int sign_variations(const std::vector<F>& b) {
  int variations = 0;
  Sign last = Sign::zero;
  for (const F& x : b) {
    const Sign s = *scalar_traits<F>::sign(x);
    if (s == Sign::zero) continue;
    if (last != Sign::zero && s != last) ++variations;
    last = s;
  }
  return variations;
}

// Bernstein coefficients on [0, 1/2] and [1/2, 1], both times 2^n: additions only.
template <ExactField F>
std::pair<std::vector<F>, std::vector<F>> halves(std::vector<F> b) {
  const std::size_t n = b.size();
  std::vector<F> left, right(n);
  for (std::size_t r = 0; r < n; ++r) {
    left.push_back(b[0]);
    right[n - 1 - r] = b[n - 1 - r];
    for (std::size_t j = 0; j + 1 < n - r; ++j) b[j] = b[j] + b[j + 1];
  }
  F scale(1);
  for (std::size_t i = n; i-- > 0;) {
    left[i] = scale * left[i];
    right[n - 1 - i] = scale * right[n - 1 - i];
    scale = scale + scale;
  }
  return {std::move(left), std::move(right)};
}

template <ExactField F>
void isolate(std::vector<F> b, const F& begin, const F& end, const F& width, std::vector<std::pair<F, F>>& out) {
  const auto zero = [](const F& x) { return *scalar_traits<F>::sign(x) == Sign::zero; };
  const int variations = sign_variations(b);
  if (variations == 0) return;
  if (variations == 1 && end - begin < width && !zero(b.front()) && !zero(b.back())) {
    out.emplace_back(begin, end);
    return;
  }
  check_deadline();
  const F middle = (begin + end) / F(2);
  auto [left, right] = halves(std::move(b));
  const bool root_at_middle = zero(right.front());
  isolate(std::move(left), begin, middle, width, out);
  if (root_at_middle) out.emplace_back(middle, middle);
  isolate(std::move(right), middle, end, width, out);
}

}  // namespace detail

template <ExactField F>
std::vector<std::pair<F, F>> isolate_roots(const BinaryForm<F>& f, const F& width) {
  BinaryForm<F> g = strip_ends(f, end_orders(f));
  const BinaryForm<F> multiple = gcd(g, g.derivative());
  if (multiple.degree() > 0) g = divide_exactly(g, multiple);
  std::vector<F> b = g.coefficients();
  const std::vector<F> c = binomials<F>(g.degree());
  for (int i = 0; i <= g.degree(); ++i) b[i] = b[i] / c[i];
  std::vector<std::pair<F, F>> roots;
  detail::isolate(std::move(b), F(0), F(1), width, roots);
  return roots;
}

template <ExactField F>
BinaryForm<F> odd_part(const BinaryForm<F>& f) {
  const BinaryForm<F> g = strip_ends(f, end_orders(f));
  // Of the factors of multiplicity m or more, each once, and of what they still divide: split off those of exactly m.
  BinaryForm<F> multiple = gcd(g, g.derivative()), simple = divide_exactly(g, multiple),
                odd = BinaryForm<F>::constant(F(1));
  for (int m = 1; simple.degree() > 0; ++m) {
    const BinaryForm<F> higher = gcd(simple, multiple);
    if (m % 2 == 1) odd = odd * divide_exactly(simple, higher);
    multiple = divide_exactly(multiple, higher);
    simple = higher;
  }
  return *scalar_traits<F>::sign(g[0]) == *scalar_traits<F>::sign(odd[0]) ? odd : -odd;
}

}  // namespace patchproof
