// SPDX-License-Identifier: Apache-2.0
// NURBS boundary Gregory patches as ordinary NURBS patches, exactly.
//
// Multiplied by E, the product of b_p(u) + b_q(v) over the quadrants (p, q) whose points Q⁰ and Q¹ differ, the C surface becomes
// polynomial. With numerators N and denominators D of the three surfaces, all homogeneous:
//
//   all weights equal    ( (N^u + N^v) E − N^c,  E )                                degrees max(3 + 2r, d_u + 2r), likewise in v
//   otherwise            ( N^u D^v D^c + N^v D^u D^c − N^c D^u D^v,  D^u D^v D^c )   degrees 6 + 2r + d_u, 6 + 2r + d_v
//
// r: the number of those quadrants, at most 4; d_u, d_v: the degrees of the V surface in u and of the U surface in v. A quadrant
// whose pairs agree costs nothing. At the corner of each of the others E vanishes to second order, so that the 2 × 2 control
// points nearest to it are (0, 0, 0, 0): no patch with positive weights is equal to a Gregory patch with different twists, for
// it would have one S_uv there.
//
// ENSURES  (1) outside those corners the patch is S, everywhere;  (2) the degrees are those above, and the inner knots those of
//          the U and the V surface with the multiplicity that keeps the homogeneous net as smooth as theirs, at least C⁰;
//          (3) zero_corners: true exactly at the corners with four zero points;  (4) the other weights at the corners' boxes
//          are as they come: denominator.h decides about their sign.
// SCALARS  T: ExactField.
// COST     the product of nets of about 12 × 12 points for each box between knots.
// SOURCE   docs/mathematics.md; T. Takamura, M. Ohta, H. Toriya, H. Chiyokura, A method to convert a Gregory patch and a rational
//          boundary Gregory patch to a rational Bézier patch (1990) for the degrees 7 and 11.
// TEST     tests/patch/gregory_expand_test.cpp checks (1)–(4).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "patchproof/patch/gregory_patch.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/tensor_form.h"

namespace patchproof {

template <ExactField T>
struct ExpandedGregory {
  BsplinePatch<T, 4> surface;
  std::array<bool, 4> zero_corners;  // at (0,0), (1,0), (1,1), (0,1)
};

template <ExactField T>
ExpandedGregory<T> expand(const GregoryPatch<T>& patch);

// The part over one box between knots, as a Bézier patch on the unit square.
template <ExactField T>
BezierPatch<T, 4> expand_box(const GregoryPatch<T>& patch, const ParameterBox<T>& box);

// Do the points Q⁰ and Q¹ of the quadrant (p, q) differ?
template <ExactField T>
bool is_blended(const GregoryPatch<T>& patch, std::size_t p, std::size_t q);

// ---------------------------------------------------------------------------------------------------------------------

template <ExactField T>
bool is_blended(const GregoryPatch<T>& patch, std::size_t p, std::size_t q) {
  for (std::size_t i = 2 * p; i < 2 * p + 2; ++i)
    for (std::size_t j = 2 * q; j < 2 * q + 2; ++j)
      if (!(patch.from_u()[i][j] == patch.from_v()[i][j])) return true;
  return false;
}

namespace detail {

// Numerator and denominator of a surface over one box.
template <ExactField T>
struct HomogeneousForms {
  std::array<TensorForm<T>, 3> numerator;
  TensorForm<T> denominator;
  bool constant = false;  // the denominator is the constant 1
};

// constant: whether all weights of the whole surface are 1, so that all boxes have forms of one degree and one scale.
template <ExactField T>
HomogeneousForms<T> forms_of(const BezierPatch<T, 4>& patch, bool constant) {
  HomogeneousForms<T> out;
  for (std::size_t c = 0; c < 3; ++c) out.numerator[c] = TensorForm<T>::from_bernstein(patch, c);
  out.constant = constant;
  out.denominator = out.constant ? TensorForm<T>::constant(T(1)) : TensorForm<T>::from_bernstein(patch, 3);
  return out;
}

// Numerator and denominator of the C surface, both times E (left out of the denominator when all weights are 1).
template <ExactField T>
struct CSurfaceForms {
  HomogeneousForms<T> surface;
  TensorForm<T> blend;  // E
};

template <ExactField T>
CSurfaceForms<T> c_surface_forms(const GregoryPatch<T>& patch, const ParameterBox<T>& box) {
  const auto piece = [&](std::vector<Vec<T, 4>> net, int m) {
    BezierPatch<T, 4> part(m, m, std::move(net));
    part = restrict(part, Direction::u, box.u_begin, box.u_end);
    return restrict(part, Direction::v, box.v_begin, box.v_end);
  };
  // b_p(u) and b_q(v) over the box.
  const auto blending = [&](std::size_t which, const T& begin, const T& end) {
    std::vector<T> b = which == 0 ? std::vector<T>{T(0), T(0), T(1)} : std::vector<T>{T(1), T(0), T(0)};
    return BinaryForm<T>::from_bernstein(restrict(b, begin, end));
  };
  const BinaryForm<T> one = BinaryForm<T>::constant(T(1));
  std::array<std::array<TensorForm<T>, 2>, 2> of_u, of_v, sums;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      of_u[p][q] = TensorForm<T>(blending(p, box.u_begin, box.u_end), one);
      of_v[p][q] = TensorForm<T>(one, blending(q, box.v_begin, box.v_end));
      sums[p][q] = is_blended(patch, p, q) ? of_u[p][q] + of_v[p][q] : TensorForm<T>::constant(T(1));
    }
  CSurfaceForms<T> out;
  out.blend = TensorForm<T>::constant(T(1));
  for (const auto& row : sums)
    for (const TensorForm<T>& e : row) out.blend = out.blend * e;
  std::array<TensorForm<T>, 4> total;
  bool constant = true;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      TensorForm<T> others = TensorForm<T>::constant(T(1));
      for (std::size_t k = 0; k < 4; ++k)
        if (k != 2 * p + q) others = others * sums[k / 2][k % 2];
      std::vector<Vec<T, 4>> from_u(16), from_v(16);
      for (std::size_t i = 2 * p; i < 2 * p + 2; ++i)
        for (std::size_t j = 2 * q; j < 2 * q + 2; ++j) {
          from_u[4 * i + j] = patch.from_u()[i][j];
          from_v[4 * i + j] = patch.from_v()[i][j];
          constant = constant && from_u[4 * i + j][3] == T(1) && from_v[4 * i + j][3] == T(1);
        }
      const BezierPatch<T, 4> q0 = piece(std::move(from_u), 3), q1 = piece(std::move(from_v), 3);
      for (std::size_t c = 0; c < 4; ++c) {
        TensorForm<T> part = TensorForm<T>::from_bernstein(q0, c);
        if (is_blended(patch, p, q)) part = of_u[p][q] * part + of_v[p][q] * TensorForm<T>::from_bernstein(q1, c);
        total[c] = total[c] + others * part;
      }
    }
  out.surface.numerator = {total[0], total[1], total[2]};
  out.surface.constant = constant;
  out.surface.denominator = constant ? out.blend : total[3];
  return out;
}

}  // namespace detail

template <ExactField T>
BezierPatch<T, 4> expand_box(const GregoryPatch<T>& patch, const ParameterBox<T>& box) {
  const auto part = [&](const BsplinePatch<T, 4>& surface) {
    const bool constant =
        std::all_of(surface.net().begin(), surface.net().end(), [](const Vec<T, 4>& p) { return p[3] == T(1); });
    return detail::forms_of(extract_bezier(restrict(surface, box)).front().bezier, constant);
  };
  const detail::HomogeneousForms<T> u = part(patch.u_surface()), v = part(patch.v_surface());
  const detail::CSurfaceForms<T> c = detail::c_surface_forms(patch, box);
  std::array<TensorForm<T>, 4> out;
  if (u.constant && v.constant && c.surface.constant) {
    for (std::size_t k = 0; k < 3; ++k) out[k] = (u.numerator[k] + v.numerator[k]) * c.blend - c.surface.numerator[k];
    out[3] = c.blend;
  } else {
    const TensorForm<T> vc = v.denominator * c.surface.denominator, uc = u.denominator * c.surface.denominator,
                        uv = u.denominator * v.denominator;
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = u.numerator[k] * vc + v.numerator[k] * uc - c.surface.numerator[k] * uv;
    out[3] = uv * c.surface.denominator;
  }
  int m = 0, n = 0;
  for (const TensorForm<T>& f : out) m = std::max(m, f.degree_u()), n = std::max(n, f.degree_v());
  std::vector<Vec<T, 4>> net((m + 1) * static_cast<std::size_t>(n + 1));
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<T> b = out[k].elevated(m, n).bernstein();
    for (std::size_t i = 0; i < b.size(); ++i) net[i][k] = b[i];
  }
  return BezierPatch<T, 4>(m, n, std::move(net));
}

template <ExactField T>
ExpandedGregory<T> expand(const GregoryPatch<T>& patch) {
  const KnotVector<T>&of_u = patch.v_surface().knots(Direction::u), &of_v = patch.u_surface().knots(Direction::v);
  const std::vector<T> us = of_u.breaks(), vs = of_v.breaks();
  // All boxes of one strip side by side along v, then the strips along u.
  std::vector<std::vector<BezierPatch<T, 4>>> boxes;
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    boxes.emplace_back();
    for (std::size_t j = 0; j + 1 < vs.size(); ++j)
      boxes.back().push_back(expand_box(patch, {us[i], us[i + 1], vs[j], vs[j + 1]}));
  }
  const int m = boxes[0][0].degree(Direction::u), n = boxes[0][0].degree(Direction::v);
  // A knot of multiplicity μ in rows of degree k leaves C^(k−μ), at most C¹ here: E and N^c are smooth, the rows are not.
  const auto knots = [](const KnotVector<T>& rows, const std::vector<T>& breaks, int degree) {
    std::vector<T> out;
    for (const T& t : breaks) {
      const bool is_end = t == breaks.front() || t == breaks.back();
      const int smooth = std::max(0, rows.degree() - rows.multiplicity(t));
      out.insert(out.end(), is_end ? degree + 1 : std::max(1, degree - smooth), t);
    }
    return KnotVector<T>::make_unchecked(degree, std::move(out));
  };
  const KnotVector<T> along_u = knots(of_u, us, m), along_v = knots(of_v, vs, n);
  std::vector<std::vector<BezierPiece<T, 4, T>>> lines(along_v.control_count());  // along u, for each column of the net
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    std::vector<std::vector<Vec<T, 4>>> strip;  // [row of the box][point along v]
    for (int row = 0; row <= m; ++row) {
      std::vector<BezierPiece<T, 4, T>> pieces;
      for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
        pieces.push_back({vs[j], vs[j + 1], {}});
        for (int k = 0; k <= n; ++k) pieces.back().points.push_back(boxes[i][j].point(row, k));
      }
      strip.push_back(join_pieces(pieces, along_v).points());
    }
    for (std::size_t column = 0; column < lines.size(); ++column) {
      lines[column].push_back({us[i], us[i + 1], {}});
      for (int row = 0; row <= m; ++row) lines[column].back().points.push_back(strip[row][column]);
    }
  }
  std::vector<Vec<T, 4>> net(static_cast<std::size_t>(along_u.control_count()) * lines.size());
  for (std::size_t column = 0; column < lines.size(); ++column) {
    const std::vector<Vec<T, 4>> points = join_pieces(lines[column], along_u).points();
    for (std::size_t row = 0; row < points.size(); ++row) net[row * lines.size() + column] = points[row];
  }
  return {BsplinePatch<T, 4>(along_u, along_v, std::move(net)),
          {is_blended(patch, 0, 0), is_blended(patch, 1, 0), is_blended(patch, 1, 1), is_blended(patch, 0, 1)}};
}

}  // namespace patchproof
