// SPDX-License-Identifier: Apache-2.0
// Where a spline lives: the connected parts of its domain, the control points without influence, and parameters for
// drawing it.
//
//   domain      [t_p, t_n], never the whole range of the knots
//   component   a part of the domain between breaks of multiplicity ≥ p + 1; the spline may jump from one to the next, so a
//               line drawn through such a break is an edge that does not exist
//   dead        N_i vanishes on the whole domain:  max(t_i, t_p) ≥ min(t_{i+p+1}, t_n)
//   samples     each non-empty span [a, b] in N = max(1, ⌈c (b − a)⌉) cells at a + (b − a) j/N, c cells per unit length
//
// ENSURES   (1) components: they are not empty, follow each other and fill the domain; each inner end has multiplicity
//               ≥ p + 1, and no break inside a component has;
//           (2) dead_control_points: in increasing order, exactly the i for which N_i is 0 on every span of the domain:
//               t_i = t_{i+p+1}, or a support that misses the inside of the domain;
//           (3) sample_domain: one list for each component, in order. It begins with the component's begin and ends with
//               exactly its end, Side::left; all others have Side::right. All breaks of the component are in it. Parameters
//               grow strictly, so no point stands twice (K exact; rounded parameters closer than rounding may coincide);
//           (4) no cell is longer than 1/c, and with one cell less in its span it would be, or the span is one cell.
// ERRORS    sample_domain: usage, when there would be more than max_cells cells; the values name the span where they ran out.
// REQUIRES  sample_domain: cells_per_unit > 0, max_cells > 0.
// SCALARS   K: OrderedField.
// COST      linear in the knots and the samples; ⌈x⌉ is found by bisection, O(log max_cells) comparisons for each span,
//           without a detour through floating point.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapter IX (basic interval); docs/errata.md on sampled domains.
// NEIGHBOURS knot_vector.h (spans and sides), bezier_extraction.h (periodic knots), smoothness.h (what happens at a break).
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof {

// [begin, end] with begin < end.
template <OrderedField K>
struct DomainComponent {
  K begin, end;

  friend bool operator==(const DomainComponent& a, const DomainComponent& b) {
    return a.begin == b.begin && a.end == b.end;
  }
};

// A parameter, and from which side the spline is meant there.
template <OrderedField K>
struct DomainSample {
  K t;
  Side side;

  friend bool operator==(const DomainSample& a, const DomainSample& b) { return a.t == b.t && a.side == b.side; }
};

// The domain, split at its inner breaks of multiplicity ≥ p + 1.
template <OrderedField K>
std::vector<DomainComponent<K>> components(const KnotVector<K>& knots);

// The indices of the control points that have no influence on the spline.
template <OrderedField K>
std::vector<int> dead_control_points(const KnotVector<K>& knots);

constexpr int kMaxDomainCells = 1 << 24;

// Parameters for each component, at least cells_per_unit cells per unit length of the parameter.
template <OrderedField K>
Result<std::vector<std::vector<DomainSample<K>>>> sample_domain(const KnotVector<K>& knots, const K& cells_per_unit,
                                                                int max_cells = kMaxDomainCells);

// ---------------------------------------------------------------------------------------------------------------------

template <OrderedField K>
std::vector<DomainComponent<K>> components(const KnotVector<K>& knots) {
  std::vector<DomainComponent<K>> out{{knots.domain_begin(), knots.domain_end()}};
  for (const K& t : knots.breaks())
    if (knots.domain_begin() < t && t < knots.domain_end() && knots.multiplicity(t) > knots.degree()) {
      out.back().end = t;
      out.push_back({t, knots.domain_end()});
    }
  return out;
}

template <OrderedField K>
std::vector<int> dead_control_points(const KnotVector<K>& knots) {
  std::vector<int> dead;
  for (int i = 0; i < knots.control_count(); ++i)
    if (!(std::max(knots[i], knots.domain_begin()) < std::min(knots[i + knots.degree() + 1], knots.domain_end())))
      dead.push_back(i);
  return dead;
}

namespace detail {

// max(1, ⌈x⌉), or limit + 1 when that is larger than limit. REQUIRES 0 < limit < 2^30.
template <OrderedField K>
int ceiling_up_to(const K& x, int limit) {
  if (K(limit) < x) return limit + 1;
  int low = 0, high = 1;  // low < x, or low = 0
  while (high < limit && K(high) < x) {
    low = high;
    high = std::min(limit, 2 * high);
  }
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (K(middle) < x ? low : high) = middle;
  }
  return high;
}

}  // namespace detail

template <OrderedField K>
Result<std::vector<std::vector<DomainSample<K>>>> sample_domain(const KnotVector<K>& knots, const K& cells_per_unit,
                                                                int max_cells) {
  PATCHPROOF_REQUIRES(K(0) < cells_per_unit, "sample_domain: a positive number of cells per unit length");
  PATCHPROOF_REQUIRES(0 < max_cells && max_cells < (1 << 30), "sample_domain: between 1 and 2^30 - 1 cells");
  const std::vector<K> breaks = knots.breaks();
  std::vector<int> cells;  // of each span
  int left = max_cells;
  for (std::size_t s = 0; s + 1 < breaks.size(); ++s) {
    const int count = left > 0 ? detail::ceiling_up_to<K>(cells_per_unit * (breaks[s + 1] - breaks[s]), left) : 1;
    if (count > left)
      return Error{ErrorCode::usage, "",
                   "the domain would be cut into more than " + std::to_string(max_cells) + " cells",
                   "cell limit reached in span " + std::to_string(s) + " of " + std::to_string(breaks.size() - 1)};
    cells.push_back(count);
    left -= count;
  }
  std::vector<std::vector<DomainSample<K>>> out;
  std::size_t s = 0;
  for (const DomainComponent<K>& component : components(knots)) {
    std::vector<DomainSample<K>> samples;
    for (; s < cells.size() && breaks[s] < component.end; ++s)
      for (int j = 0; j < cells[s]; ++j)
        samples.push_back(
            {j == 0 ? breaks[s] : breaks[s] + (breaks[s + 1] - breaks[s]) * K(j) / K(cells[s]), Side::right});
    samples.push_back({component.end, Side::left});
    out.push_back(std::move(samples));
  }
  return out;
}

}  // namespace patchproof
