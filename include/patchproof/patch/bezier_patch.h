// SPDX-License-Identifier: Apache-2.0
// Bézier patches on the unit square: S(u,v) = Σ_i Σ_j b_ij B_i^p(u) B_j^q(v), and the Bézier pieces of a B-spline patch.
//
// A Bézier patch has degrees and a net, and no knots, so it exists over any Ring (Integer nets too). Each operation is
// the one on curves (spline/bernstein.h), done on every line of the net along one direction.
//
// REQUIRES  evaluate: unit parameters; any value of T is allowed, also outside [0, 1].
// ENSURES  (1) evaluate equals Σ b_ij B_i B_j, the corners are b_00, b_p0, b_0q, b_pq;  (2) both halves of a split are the
//          patch itself, S_low(s,v) == S(t·s, v) and S_high(s,v) == S(t + (1−t)s, v), and share the line between them;
//          restrict to [a,b] is S(a + (b−a)s, v);  (3) elevate_degree leaves the surface unchanged and reduce_degree
//          undoes it, reduce_degree answers nothing when the surface has the full degree;  (4) reverse and
//          swap_directions are involutions: S'(u,v) == S(1−u,v) and S'(u,v) == S(v,u);  (5) derivative_patch is the
//          partial derivative, in either order the same;  (6) corner twists are S_uv at the corners;  (7) the pieces of a
//          B-spline patch cover its domain in order, and on its box each equals the patch, S_piece(s,t) == S(u,v).
// SCALARS  T: Ring unless a declaration says otherwise; exact when T is. Pieces: T: Field, K: OrderedField.
// COST     de Casteljau O(pq·min(p,q)); pieces O(net · degree).
// SOURCE   G. Farin, Curves and Surfaces for CAGD, 5th ed., ch. 14–16.
// TEST     tests/patch/bezier_patch_test.cpp checks (1)–(7).
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/bezier_extraction.h"

namespace patchproof {

template <Ring T, std::size_t N>
class BezierPatch {
 public:
  using Point = Vec<T, N>;

  // b_ij = net[i · (degree_v + 1) + j]. REQUIRES degrees ≥ 0 and (degree_u + 1)(degree_v + 1) points.
  BezierPatch(int degree_u, int degree_v, std::vector<Point> net)
      : degree_u_(degree_u), degree_v_(degree_v), net_(std::move(net)) {
    PATCHPROOF_REQUIRES(
        degree_u >= 0 && degree_v >= 0 && net_.size() == (degree_u + std::size_t(1)) * (degree_v + std::size_t(1)),
        "BezierPatch: the degrees do not fit the net");
  }

  int degree(Direction d) const { return d == Direction::u ? degree_u_ : degree_v_; }
  int count(Direction d) const { return degree(d) + 1; }
  const Point& point(int i, int j) const { return net_[static_cast<std::size_t>(i) * (degree_v_ + 1) + j]; }
  const std::vector<Point>& net() const { return net_; }

 private:
  int degree_u_, degree_v_;
  std::vector<Point> net_;
};

// The patch over one box of its domain.
template <Ring T, std::size_t N, OrderedField K>
struct PatchPiece {
  ParameterBox<K> box;
  BezierPatch<T, N> bezier;
};

// S(u,v) by de Casteljau's algorithm in both directions.
template <Ring T, std::size_t N>
Vec<T, N> evaluate(const BezierPatch<T, N>& patch, const T& u, const T& v);

// The same surface on [0, t] and on [t, 1] of one direction.
template <Ring T, std::size_t N>
std::pair<BezierPatch<T, N>, BezierPatch<T, N>> split(const BezierPatch<T, N>& patch, Direction d, const T& t);

// The part over [a, b] of one direction, on the unit square again. a > b reverses it.
template <Ring T, std::size_t N>
BezierPatch<T, N> restrict(const BezierPatch<T, N>& patch, Direction d, const T& a, const T& b);

// The same surface with a degree higher by `by`. T: Field.
template <Field T, std::size_t N>
BezierPatch<T, N> elevate_degree(const BezierPatch<T, N>& patch, Direction d, int by = 1);

// The same surface with a degree lower by one, when there is one.
template <ExactField T, std::size_t N>
std::optional<BezierPatch<T, N>> reduce_degree(const BezierPatch<T, N>& patch, Direction d);

template <Ring T, std::size_t N>
BezierPatch<T, N> reverse(const BezierPatch<T, N>& patch, Direction d);

// u and v exchanged.
template <Ring T, std::size_t N>
BezierPatch<T, N> swap_directions(const BezierPatch<T, N>& patch);

// ∂S/∂u or ∂S/∂v, of degree one lower in that direction (the zero constant for degree 0).
template <Ring T, std::size_t N>
BezierPatch<T, N> derivative_patch(const BezierPatch<T, N>& patch, Direction d);

// S_uv at (0,0), (1,0), (0,1), (1,1): p·q times the second difference of the net at the corner.
template <Ring T, std::size_t N>
std::array<Vec<T, N>, 4> corner_twists(const BezierPatch<T, N>& patch);

// The patch as a B-spline patch on [0, 1]².
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
BsplinePatch<T, N, K> to_bspline(const BezierPatch<T, N>& patch);

// One piece per box between distinct knots; the v boxes of the first u interval come first.
template <Field T, std::size_t N, OrderedField K>
std::vector<PatchPiece<T, N, K>> extract_bezier(const BsplinePatch<T, N, K>& patch);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <Ring T, std::size_t N, class Op>
BezierPatch<T, N> map_bezier_lines(const BezierPatch<T, N>& patch, Direction d, Op op) {
  auto net = map_lines(patch.net(), patch.count(Direction::u), patch.count(Direction::v), d, op);
  return BezierPatch<T, N>(net.count_u - 1, net.count_v - 1, std::move(net.points));
}

}  // namespace detail

template <Ring T, std::size_t N>
Vec<T, N> evaluate(const BezierPatch<T, N>& patch, const T& u, const T& v) {
  std::vector<Vec<T, N>> across;
  across.reserve(patch.count(Direction::u));
  for (int i = 0; i < patch.count(Direction::u); ++i) {
    const auto first = patch.net().begin() + static_cast<std::ptrdiff_t>(i) * patch.count(Direction::v);
    across.push_back(de_casteljau(std::vector<Vec<T, N>>(first, first + patch.count(Direction::v)), v));
  }
  return de_casteljau(across, u);
}

template <Ring T, std::size_t N>
std::pair<BezierPatch<T, N>, BezierPatch<T, N>> split(const BezierPatch<T, N>& patch, Direction d, const T& t) {
  std::vector<std::vector<Vec<T, N>>> high;
  auto low = detail::map_bezier_lines(patch, d, [&](const std::vector<Vec<T, N>>& line) {
    auto halves = split(line, t);
    high.push_back(std::move(halves.right));
    return std::move(halves.left);
  });
  std::size_t next = 0;
  return {std::move(low),
          detail::map_bezier_lines(patch, d, [&](const std::vector<Vec<T, N>>&) { return std::move(high[next++]); })};
}

template <Ring T, std::size_t N>
BezierPatch<T, N> restrict(const BezierPatch<T, N>& patch, Direction d, const T& a, const T& b) {
  return detail::map_bezier_lines(patch, d, [&](const auto& line) { return restrict(line, a, b); });
}

template <Field T, std::size_t N>
BezierPatch<T, N> elevate_degree(const BezierPatch<T, N>& patch, Direction d, int by) {
  return detail::map_bezier_lines(patch, d, [&](const auto& line) { return elevate_degree(line, by); });
}

template <ExactField T, std::size_t N>
std::optional<BezierPatch<T, N>> reduce_degree(const BezierPatch<T, N>& patch, Direction d) {
  bool possible = patch.degree(d) > 0;
  auto reduced = detail::map_bezier_lines(patch, d, [&](const std::vector<Vec<T, N>>& line) {
    auto lower = possible ? reduce_degree(line) : std::nullopt;
    possible = lower.has_value();
    return possible ? *std::move(lower) : std::vector<Vec<T, N>>(std::max<std::size_t>(line.size() - 1, 1));
  });
  if (!possible) return std::nullopt;
  return reduced;
}

template <Ring T, std::size_t N>
BezierPatch<T, N> reverse(const BezierPatch<T, N>& patch, Direction d) {
  return detail::map_bezier_lines(patch, d, [](const auto& line) { return reverse(line); });
}

template <Ring T, std::size_t N>
BezierPatch<T, N> swap_directions(const BezierPatch<T, N>& patch) {
  return BezierPatch<T, N>(patch.degree(Direction::v), patch.degree(Direction::u),
                           detail::transposed(patch.net(), patch.count(Direction::u), patch.count(Direction::v)));
}

template <Ring T, std::size_t N>
BezierPatch<T, N> derivative_patch(const BezierPatch<T, N>& patch, Direction d) {
  return detail::map_bezier_lines(patch, d, [](const auto& line) { return hodograph(line); });
}

template <Ring T, std::size_t N>
std::array<Vec<T, N>, 4> corner_twists(const BezierPatch<T, N>& patch) {
  const auto mixed = derivative_patch(derivative_patch(patch, Direction::u), Direction::v);
  const int p = mixed.degree(Direction::u), q = mixed.degree(Direction::v);
  return {mixed.point(0, 0), mixed.point(p, 0), mixed.point(0, q), mixed.point(p, q)};
}

template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> to_bspline(const BezierPatch<T, N>& patch) {
  return BsplinePatch<T, N, K>(KnotVector<K>::bezier(patch.degree(Direction::u)),
                               KnotVector<K>::bezier(patch.degree(Direction::v)), patch.net());
}

template <Field T, std::size_t N, OrderedField K>
std::vector<PatchPiece<T, N, K>> extract_bezier(const BsplinePatch<T, N, K>& patch) {
  using Curve = BsplineCurve<T, N, K>;
  const KnotVector<K>&knots_u = patch.knots(Direction::u), &knots_v = patch.knots(Direction::v);
  const std::size_t pieces_u = knots_u.breaks().size() - 1, pieces_v = knots_v.breaks().size() - 1;
  const int p = knots_u.degree(), q = knots_v.degree();
  std::vector<std::vector<BezierPiece<T, N, K>>> rows;
  for (int i = 0; i < knots_u.control_count(); ++i) {
    const auto first = patch.net().begin() + static_cast<std::ptrdiff_t>(i) * knots_v.control_count();
    rows.push_back(extract_bezier(Curve(knots_v, std::vector<Vec<T, N>>(first, first + knots_v.control_count()))));
  }
  std::vector<PatchPiece<T, N, K>> out;
  out.reserve(pieces_u * pieces_v);
  // nets[a · pieces_v + b]: the net of piece (a, b), filled column by column.
  std::vector<std::vector<Vec<T, N>>> nets(pieces_u * pieces_v, std::vector<Vec<T, N>>((p + 1) * (q + 1)));
  std::vector<BezierPiece<T, N, K>> column_pieces;
  for (std::size_t b = 0; b < pieces_v; ++b)
    for (int j = 0; j <= q; ++j) {
      std::vector<Vec<T, N>> column;
      for (const auto& row : rows) column.push_back(row[b].points[j]);
      column_pieces = extract_bezier(Curve(knots_u, std::move(column)));
      for (std::size_t a = 0; a < pieces_u; ++a)
        for (int i = 0; i <= p; ++i) nets[a * pieces_v + b][i * (q + 1) + j] = std::move(column_pieces[a].points[i]);
    }
  for (std::size_t a = 0; a < pieces_u; ++a)
    for (std::size_t b = 0; b < pieces_v; ++b)
      out.push_back({{column_pieces[a].begin, column_pieces[a].end, rows[0][b].begin, rows[0][b].end},
                     BezierPatch<T, N>(p, q, std::move(nets[a * pieces_v + b]))});
  return out;
}

}  // namespace patchproof
