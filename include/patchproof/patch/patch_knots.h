// SPDX-License-Identifier: Apache-2.0
// Knots, degrees and parts of a patch: the algorithms on curves, done on every line of the net along one direction.
//
// The control points of a tensor-product patch along one direction are those of curves on the same knots, so whatever
// leaves every such curve unchanged leaves the surface unchanged.
//
// REQUIRES what the curve algorithm requires of the knots of that direction.
// ENSURES  (1) insert_knot, raise_multiplicity, refine, elevate_degree, clamp: the surface is unchanged, S'(u,v) == S(u,v);
//          (2) remove_knot undoes insert_knot and reduce_degree undoes elevate_degree; they answer nothing when a line of
//          the net would change;  (3) restrict and split are S on their part of the domain, clamped there; the value at
//          the cut is the limit from inside the part;  (4) reverse: S'(u,v) == S(begin + end − u, v), an involution;
//          map_domain: S'(c + (d − c)(u − a)/(b − a), v) == S(u,v); moebius: the affine surface at another pace;
//          (5) operations in u and in v commute;  (6) no knot of the result of remove_redundant_knots can be removed.
// SCALARS  T: Ring, K: OrderedField; elevate_degree: T Field; remove_knot, reduce_degree: exact fields.
// COST     that of the curve algorithm times the number of lines.
// NEIGHBOURS spline/knot_insertion.h, degree.h, bezier_extraction.h, reparametrize.h.
// TEST     tests/patch/patch_knots_test.cpp checks (1)–(6).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/degree.h"
#include "patchproof/spline/knot_insertion.h"
#include "patchproof/spline/reparametrize.h"

namespace patchproof {

// The patch whose lines along d are op(line), or nothing when op answers nothing for one of them.
// REQUIRES op maps a BsplineCurve to an optional one, with the same knots for all lines.
template <Ring T, std::size_t N, OrderedField K, class Op>
std::optional<BsplinePatch<T, N, K>> try_map_rows(const BsplinePatch<T, N, K>& patch, Direction d, Op op) {
  KnotVector<K> knots = patch.knots(d);
  bool first = true, possible = true;
  auto net = detail::map_lines(
      patch.net(), patch.count(Direction::u), patch.count(Direction::v), d, [&](std::vector<Vec<T, N>> line) {
        if (!possible) return std::vector<Vec<T, N>>();
        std::optional<BsplineCurve<T, N, K>> image = op(BsplineCurve<T, N, K>(patch.knots(d), std::move(line)));
        possible = image.has_value();
        if (!possible) return std::vector<Vec<T, N>>();
        if (first) knots = image->knots();
        PATCHPROOF_REQUIRES(image->knots() == knots, "try_map_rows: the lines came back with different knots");
        first = false;
        return image->points();
      });
  if (!possible) return std::nullopt;
  if (d == Direction::u)
    return BsplinePatch<T, N, K>(std::move(knots), patch.knots(Direction::v), std::move(net.points));
  return BsplinePatch<T, N, K>(patch.knots(Direction::u), std::move(knots), std::move(net.points));
}

// The patch whose lines along d are op(line). REQUIRES op maps a BsplineCurve to one, with the same knots for all lines.
template <Ring T, std::size_t N, OrderedField K, class Op>
BsplinePatch<T, N, K> map_rows(const BsplinePatch<T, N, K>& patch, Direction d, Op op) {
  return *try_map_rows(patch, d, [&](const BsplineCurve<T, N, K>& c) { return std::optional(op(c)); });
}

// The same surface with the knot t inserted `times` times.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> insert_knot(const BsplinePatch<T, N, K>& patch, Direction d, const K& t, int times = 1) {
  return map_rows(patch, d, [&](const auto& c) { return insert_knot(c, t, times); });
}

// The same surface with t of at least the given multiplicity.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> raise_multiplicity(const BsplinePatch<T, N, K>& patch, Direction d, const K& t,
                                         int multiplicity) {
  return map_rows(patch, d, [&](const auto& c) { return raise_multiplicity(c, t, multiplicity); });
}

// The same surface on finer knots.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> refine(const BsplinePatch<T, N, K>& patch, Direction d, const KnotVector<K>& finer) {
  return map_rows(patch, d, [&](const auto& c) { return refine(c, finer); });
}

// The same surface with the multiplicity of t lowered by one, when there is such a surface.
template <ExactField T, std::size_t N, ExactField K>
std::optional<BsplinePatch<T, N, K>> remove_knot(const BsplinePatch<T, N, K>& patch, Direction d, const K& t) {
  return try_map_rows(patch, d, [&](const auto& c) { return remove_knot(c, t); });
}

// The same surface on the fewest knots in one direction.
template <ExactField T, std::size_t N, ExactField K>
BsplinePatch<T, N, K> remove_redundant_knots(BsplinePatch<T, N, K> patch, Direction d) {
  for (const K& t : patch.knots(d).breaks())
    while (std::optional<BsplinePatch<T, N, K>> smaller = remove_knot(patch, d, t)) patch = std::move(*smaller);
  return patch;
}

// The same surface with the degree raised by `times`.
template <Field T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> elevate_degree(const BsplinePatch<T, N, K>& patch, Direction d, int times = 1) {
  return map_rows(patch, d, [&](const auto& c) { return elevate_degree(c, times); });
}

// The same surface with the degree lowered by `times`, when there is one.
template <ExactField T, std::size_t N, ExactField K>
std::optional<BsplinePatch<T, N, K>> reduce_degree(const BsplinePatch<T, N, K>& patch, Direction d, int times = 1) {
  return try_map_rows(patch, d, [&](const auto& c) { return reduce_degree(c, times); });
}

// The same surface with clamped knots.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> clamp(const BsplinePatch<T, N, K>& patch, Direction d) {
  return map_rows(patch, d, [](const auto& c) { return clamp(c); });
}

// The part over [a, b] of one direction. REQUIRES domain_begin <= a < b <= domain_end.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> restrict(const BsplinePatch<T, N, K>& patch, Direction d, const K& a, const K& b) {
  return map_rows(patch, d, [&](const auto& c) { return restrict(c, a, b); });
}

// The part over a box of the domain.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> restrict(const BsplinePatch<T, N, K>& patch, const ParameterBox<K>& box) {
  return restrict(restrict(patch, Direction::u, box.u_begin, box.u_end), Direction::v, box.v_begin, box.v_end);
}

// The parts before and after t. REQUIRES domain_begin < t < domain_end.
template <Ring T, std::size_t N, OrderedField K>
std::pair<BsplinePatch<T, N, K>, BsplinePatch<T, N, K>> split(const BsplinePatch<T, N, K>& patch, Direction d,
                                                              const K& t) {
  const KnotVector<K>& knots = patch.knots(d);
  return {restrict(patch, d, knots.domain_begin(), t), restrict(patch, d, t, knots.domain_end())};
}

// The same surface run backwards in one direction, on the same domain.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> reverse(const BsplinePatch<T, N, K>& patch, Direction d) {
  return map_rows(patch, d, [](const auto& c) { return reverse(c); });
}

// The same surface over [begin, end] in one direction. REQUIRES begin < end.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> map_domain(const BsplinePatch<T, N, K>& patch, Direction d, const K& begin, const K& end) {
  return map_rows(patch, d, [&](const auto& c) { return map_domain(c, begin, end); });
}

// The same rational surface at another pace in one direction (spline/reparametrize.h): homogeneous points only.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> moebius(const BsplinePatch<T, N, K>& patch, Direction d, const K& r) {
  return map_rows(patch, d, [&](const auto& c) { return moebius(c, r); });
}

}  // namespace patchproof
