// SPDX-License-Identifier: Apache-2.0
// NURBS boundary Gregory patches: surfaces over [0, 1]² that carry four B-spline edges of any knots and four
// cross-boundary derivatives, none of which has to know of the others.
//
//   S = S^u + S^v − S^c     affine points, each surface projected before the sum
//
//   U surface  degree 3 in u, any B-spline in v:  S^u, S^u_u are what S and S_u are on the edges u = 0 and u = 1
//   V surface  any B-spline in u, degree 3 in v:  S^v, S^v_v are what S and S_v are on the edges v = 0 and v = 1
//   C surface  the rest, bicubic with two points for each place (i, j):
//
//     S^c = proj Σ_ij B_i³(u) B_j³(v) ( β_pq Q⁰_ij + (1 − β_pq) Q¹_ij ),     p = ⌊i/2⌋, q = ⌊j/2⌋
//     β_pq(u,v) = b_p(u)/(b_p(u) + b_q(v)),     b_0(t) = t², b_1(t) = (1 − t)²
//
//   Q⁰ from the U surface (rows i), Q¹ likewise from the V surface (rows j), all homogeneous:
//     Q⁰_i0 = P_i0                Q⁰_i1 = P_i0 + (k/(3 x_1)) (P_i1 − P_i0) + λ_0 P_i0
//     Q⁰_i3 = P_in                Q⁰_i2 = P_in + (k/(3 (1 − x_{s−1}))) (P_i,n−1 − P_in) + λ_1 P_in
//   with k the degree of the rows, x_1 and x_{s−1} their first and last inner knot. λ is 0 when the four weights are positive
//   without it, and otherwise the smallest number that raises each to a quarter of the weight at its end.
//
// S is as smooth as U and V are at their knots, C¹ on the closed square when they are C¹, and not C² at its corners: there S_uv
// has two limits, one along each edge.
//
// REQUIRES  parameters in [0, 1]; second_derivatives: not at a corner.
// ENSURES   (1) make: the C surface above; every one of its 32 weights is positive;
//           (2) evaluate: the formula above, and the corner itself at a corner;
//           (3) frame: S, S_u, S_v; at a corner the derivatives of the two edges there;
//           (4) second_derivatives: from the given side of knots;
//           (5) on an edge S and its first derivatives are those of the surface that carries the edge, whenever corners_agree;
//           (6) corners_agree: at each corner U and V have one point and the same two first derivatives;
//           (7) in double no parameter of the closed square gives a NaN: next to a corner (u, v) is moved along its ray to the
//               distance 2^-256. Derivatives of rational patches lose digits there, as much as the unit roundoff over the
//               distance from the corner: their Q⁰ and Q¹ differ in weight, and what cancels was rounded;
//           (8) evaluate_in_spans: the same formulas at parameters of another ring, of the pieces named.
// ERRORS    make: bad_degree (not 3 across), domains_differ (not [0, 1], or unclamped), bad_multiplicity (rows that may
//           jump), bad_weight (a weight ≤ 0 at an end of a row).
// SCALARS   T: OrderedField, or an enclosure whose weights have certain signs. Exact in exact scalars.
// COST      three surfaces; the C surface 16 products.
// SOURCE    K. Konno, H. Chiyokura, An approach of designing and controlling free-form surfaces by using NURBS boundary Gregory
//           patches, CAGD 13 (1996); the factor k/(3 x_1), λ and the condition at the corners: docs/mathematics.md.
// NEIGHBOURS classical_gregory_patch.h (20 points), gregory_expand.h (as NURBS), mesh/fill_faces.h (makes them).
// TEST      tests/patch/gregory_patch_test.cpp checks (1)–(6), gregory_patch_scalars_test.cpp (7) and (8).
#pragma once

#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/power_series.h"
#include "patchproof/spline/knot_ratio.h"

namespace patchproof {

// S and its first derivatives at one place.
template <class T>
struct SurfaceFrame {
  Vec<T, 3> point, du, dv;
  Vec<T, 3> normal() const { return cross(du, dv); }  // S_u × S_v
};

template <class T>
struct SecondDerivatives {
  Vec<T, 3> duu, duv, dvv;
};

template <Field T, OrderedField K = knot_scalar_t<T>>
class GregoryPatch {
 public:
  using Net = std::array<std::array<Vec<T, 4>, 4>, 4>;  // [i][j], i along u

  static Result<GregoryPatch> make(BsplinePatch<T, 4, K> u_surface, BsplinePatch<T, 4, K> v_surface);

  const BsplinePatch<T, 4, K>& u_surface() const { return u_surface_; }
  const BsplinePatch<T, 4, K>& v_surface() const { return v_surface_; }
  // Q⁰ and Q¹.
  const Net& from_u() const { return from_u_; }
  const Net& from_v() const { return from_v_; }

 private:
  GregoryPatch(BsplinePatch<T, 4, K> u, BsplinePatch<T, 4, K> v) : u_surface_(std::move(u)), v_surface_(std::move(v)) {}

  BsplinePatch<T, 4, K> u_surface_, v_surface_;
  Net from_u_, from_v_;
};

// The homogeneous C surface at parameters of a ring that T embeds into. REQUIRES no corner, unless R encloses.
template <Ring R, Field T, OrderedField K>
Vec<R, 4> evaluate_c_surface(const GregoryPatch<T, K>& patch, const R& u, const R& v);

// Which polynomial pieces of the patch: a span of the U surface's knots in v, and of the V surface's in u.
struct GregorySpans {
  int v_of_u_surface, u_of_v_surface;
};
template <Field T, OrderedField K>
GregorySpans find_spans(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                        Side side_v = Side::right);

template <Ring R, Field T, OrderedField K>
Vec<R, 3> evaluate_in_spans(const GregoryPatch<T, K>& patch, const GregorySpans& spans, const R& u, const R& v);

template <Field T, OrderedField K>
Vec<T, 3> evaluate(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                   Side side_v = Side::right);

template <Field T, OrderedField K>
SurfaceFrame<T> frame(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                      Side side_v = Side::right);

template <Field T, OrderedField K>
SecondDerivatives<T> second_derivatives(const GregoryPatch<T, K>& patch, const K& u, const K& v,
                                        Side side_u = Side::right, Side side_v = Side::right);

// S_uv at a corner, along the edge in v (from the U surface) and along the edge in u (from the V surface).
template <class T>
struct TwoTwists {
  Vec<T, 3> from_u, from_v;
};
// At (0,0), (1,0), (1,1), (0,1).
template <Field T, OrderedField K>
std::array<TwoTwists<T>, 4> corner_twists(const GregoryPatch<T, K>& patch);

template <ExactField T, OrderedField K>
bool corners_agree(const GregoryPatch<T, K>& patch);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// λ: the smallest multiple of `ends` that makes every weight at least a quarter of its end's, when one is not positive.
// Nothing when the signs cannot be told.
template <Field T>
std::optional<T> gauge(const std::vector<T>& weights, const std::vector<T>& ends) {
  const auto sign = [](const T& x) -> std::optional<Sign> {
    if constexpr (OrderedField<T>)
      return x < T(0) ? Sign::negative : T(0) < x ? Sign::positive : Sign::zero;
    else
      return scalar_traits<T>::sign(x);
  };
  bool positive = true;
  for (const T& w : weights) {
    const std::optional<Sign> of_w = sign(w);
    if (!of_w) return std::nullopt;
    positive = positive && *of_w == Sign::positive;
  }
  if (positive) return T(0);
  std::optional<T> largest;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const T needed = T(1) / T(4) - weights[i] / ends[i];
    if (!largest) {
      largest = needed;
      continue;
    }
    const std::optional<Sign> larger = sign(needed - *largest);
    if (!larger) return std::nullopt;
    if (*larger == Sign::positive) largest = needed;
  }
  return largest;
}

// Bicubic ends of rows of any degree: the four homogeneous points with the row's points and derivatives at 0 and 1.
template <Field T, OrderedField K>
Result<std::array<std::array<Vec<T, 4>, 4>, 4>> cubic_ends(const BsplinePatch<T, 4, K>& surface, Direction along) {
  const KnotVector<K>& knots = surface.knots(along);
  const int k = knots.degree(), n = knots.control_count();
  const auto point = [&](int row, int m) -> const Vec<T, 4>& {
    return along == Direction::v ? surface.point(row, m) : surface.point(m, row);
  };
  const T first = knot_rate<T>(k, knots[k], knots[k + 1]) / T(3), last = knot_rate<T>(k, knots[n - 1], knots[n]) / T(3);
  std::array<std::array<Vec<T, 4>, 4>, 4> out;
  for (const bool at_end : {false, true}) {
    std::vector<T> weights, ends;
    for (int row = 0; row < 4; ++row) {
      const Vec<T, 4>&end = point(row, at_end ? n - 1 : 0), &next = point(row, at_end ? n - 2 : 1);
      out[row][at_end ? 3 : 0] = end;
      out[row][at_end ? 2 : 1] = end + (at_end ? last : first) * (next - end);
      weights.push_back(out[row][at_end ? 2 : 1][3]);
      ends.push_back(end[3]);
    }
    for (const T& w : ends)
      if constexpr (OrderedField<T>) {
        if (!(T(0) < w))
          return Error{ErrorCode::bad_weight, "", "the weights at the ends of the rows should be positive", ""};
      } else if (scalar_traits<T>::sign(w) != Sign::positive) {
        return Error{ErrorCode::bad_weight, "", "the weights at the ends of the rows should be certainly positive", ""};
      }
    const std::optional<T> lambda = gauge(weights, ends);
    if (!lambda)
      return Error{ErrorCode::bad_weight, "", "the signs of the weights of the C surface cannot be told", ""};
    for (int row = 0; row < 4; ++row) out[row][at_end ? 2 : 1] += *lambda * out[row][at_end ? 3 : 0];
  }
  return out;
}

template <Ring R, class T>
Vec<R, 4> embed_point(const Vec<T, 4>& p) {
  Vec<R, 4> out;
  for (std::size_t c = 0; c < 4; ++c) out[c] = embed<R>(p[c]);
  return out;
}

// In double: a place closer to a corner than 2^-256, moved away from it along its ray, so that β's squares do not underflow.
// Only the corners at 0 can be so close.
inline std::pair<double, double> off_the_corners(double u, double v) {
  static const double kNearest = std::ldexp(1, -256);
  const auto moved = [&](double x, double y) {
    const double r = std::max(x, y);
    return r > 0 && r < kNearest ? kNearest / r : double(1);
  };
  const double to_u = u, from_u = 1 - u, to_v = v, from_v = 1 - v;
  if (const double f = moved(to_u, to_v); f != 1) return {u * f, v * f};
  if (const double f = moved(from_u, to_v); f != 1) return {1 - from_u * f, v * f};
  if (const double f = moved(to_u, from_v); f != 1) return {u * f, 1 - from_v * f};
  return {u, v};
}

}  // namespace detail

template <Field T, OrderedField K>
Result<GregoryPatch<T, K>> GregoryPatch<T, K>::make(BsplinePatch<T, 4, K> u_surface, BsplinePatch<T, 4, K> v_surface) {
  for (const BsplinePatch<T, 4, K>* surface : {&u_surface, &v_surface}) {
    const Direction across = surface == &u_surface ? Direction::u : Direction::v;
    const Direction along = across == Direction::u ? Direction::v : Direction::u;
    const char* name = across == Direction::u ? "the U surface" : "the V surface";
    if (surface->degree(across) != 3 || surface->count(across) != 4)
      return Error{ErrorCode::bad_degree, "", std::string(name) + " should be one cubic piece across its edges",
                   "degree " + std::to_string(surface->degree(across)) + ", " + std::to_string(surface->count(across)) +
                       " points"};
    for (const Direction d : {across, along}) {
      const KnotVector<K>& knots = surface->knots(d);
      const bool clamped =
          knots.multiplicity(K(0)) == knots.degree() + 1 && knots.multiplicity(K(1)) == knots.degree() + 1;
      if (!(knots.domain_begin() == K(0)) || !(knots.domain_end() == K(1)) || !clamped)
        return Error{ErrorCode::domains_differ, "", std::string(name) + " should have clamped knots over [0, 1]", ""};
    }
    for (const K& t : surface->knots(along).breaks())
      if (K(0) < t && t < K(1) && surface->knots(along).multiplicity(t) > surface->degree(along))
        return Error{ErrorCode::bad_multiplicity, "", std::string(name) + " may jump at a knot", ""};
    if (surface->degree(along) < 1)
      return Error{ErrorCode::bad_degree, "", std::string(name) + " should not be constant along its edges", "0"};
  }
  GregoryPatch patch(std::move(u_surface), std::move(v_surface));
  Result<Net> from_u = detail::cubic_ends(patch.u_surface_, Direction::v);
  if (!from_u) return from_u.error();
  Result<Net> from_v = detail::cubic_ends(patch.v_surface_, Direction::u);
  if (!from_v) return from_v.error();
  patch.from_u_ = std::move(*from_u);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) patch.from_v_[i][j] = (*from_v)[j][i];
  return patch;
}

template <Ring R, Field T, OrderedField K>
Vec<R, 4> evaluate_c_surface(const GregoryPatch<T, K>& patch, const R& u, const R& v) {
  const std::vector<R> along_u = bernstein_basis(3, u), along_v = bernstein_basis(3, v);
  const std::array<R, 2> blend_u{u * u, (R(1) - u) * (R(1) - u)}, blend_v{v * v, (R(1) - v) * (R(1) - v)};
  Vec<R, 4> sum;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      Vec<R, 4> from_v, difference;
      bool differ = false;  // β is left out where it has no effect: then it may be 0/0 at the corner
      for (std::size_t i = 2 * p; i < 2 * p + 2; ++i)
        for (std::size_t j = 2 * q; j < 2 * q + 2; ++j) {
          const R factor = along_u[i] * along_v[j];
          const Vec<T, 4>&q0 = patch.from_u()[i][j], &q1 = patch.from_v()[i][j];
          from_v += factor * detail::embed_point<R>(q1);
          if constexpr (requires(const T& x) { x == x; })
            if (q0 == q1) continue;
          differ = true;
          difference += factor * detail::embed_point<R>(q0 - q1);
        }
      sum += from_v;
      if (differ) sum += (blend_u[p] / (blend_u[p] + blend_v[q])) * difference;
    }
  return sum;
}

template <Field T, OrderedField K>
GregorySpans find_spans(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  return {patch.u_surface().knots(Direction::v).find_span(v, side_v),
          patch.v_surface().knots(Direction::u).find_span(u, side_u)};
}

template <Ring R, Field T, OrderedField K>
Vec<R, 3> evaluate_in_spans(const GregoryPatch<T, K>& patch, const GregorySpans& spans, const R& u, const R& v) {
  const auto projected = [](const Vec<R, 4>& h) {
    Vec<R, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = h[c] / h[3];
    return p;
  };
  return projected(evaluate_in_span<R>(patch.u_surface(), 3, spans.v_of_u_surface, u, v)) +
         projected(evaluate_in_span<R>(patch.v_surface(), spans.u_of_v_surface, 3, u, v)) -
         projected(evaluate_c_surface<R>(patch, u, v));
}

namespace detail {

template <OrderedField K>
bool is_corner(const K& u, const K& v) {
  return (u == K(0) || u == K(1)) && (v == K(0) || v == K(1));
}

// The power series of S about (u, v). REQUIRES no corner.
template <Field T, OrderedField K>
Vec<PowerSeries<T, 2>, 3> series(const GregoryPatch<T, K>& patch, K u, K v, int order, Side side_u, Side side_v) {
  using Series = PowerSeries<T, 2>;
  if constexpr (std::same_as<K, double>) std::tie(u, v) = off_the_corners(u, v);
  return evaluate_in_spans<Series>(patch, find_spans(patch, u, v, side_u, side_v),
                                   Series::variable(0, embed<T>(u), order), Series::variable(1, embed<T>(v), order));
}

template <class T>
Vec<T, 3> derivative_of(const Vec<PowerSeries<T, 2>, 3>& series, const std::array<int, 2>& order) {
  return {{series[0].derivative(order), series[1].derivative(order), series[2].derivative(order)}};
}

}  // namespace detail

template <Field T, OrderedField K>
Vec<T, 3> evaluate(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  if (detail::is_corner(u, v)) return evaluate_rational(patch.u_surface(), u, v);
  return detail::derivative_of(detail::series(patch, u, v, 0, side_u, side_v), {0, 0});
}

template <Field T, OrderedField K>
SurfaceFrame<T> frame(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  if (detail::is_corner(u, v)) {
    const PartialDerivatives<T, 3> of_u = rational_derivatives(patch.u_surface(), u, v, 0, 1);
    return {of_u.at(0, 0), rational_derivatives(patch.v_surface(), u, v, 1, 0).at(1, 0), of_u.at(0, 1)};
  }
  const auto s = detail::series(patch, u, v, 1, side_u, side_v);
  return {detail::derivative_of(s, {0, 0}), detail::derivative_of(s, {1, 0}), detail::derivative_of(s, {0, 1})};
}

template <Field T, OrderedField K>
SecondDerivatives<T> second_derivatives(const GregoryPatch<T, K>& patch, const K& u, const K& v, Side side_u,
                                        Side side_v) {
  PATCHPROOF_REQUIRES(!detail::is_corner(u, v), "second_derivatives: a Gregory patch has none at its corners");
  const auto s = detail::series(patch, u, v, 2, side_u, side_v);
  return {detail::derivative_of(s, {2, 0}), detail::derivative_of(s, {1, 1}), detail::derivative_of(s, {0, 2})};
}

template <Field T, OrderedField K>
std::array<TwoTwists<T>, 4> corner_twists(const GregoryPatch<T, K>& patch) {
  const auto at = [&](int u, int v) -> TwoTwists<T> {
    return {rational_derivatives(patch.u_surface(), K(u), K(v), 1, 1).at(1, 1),
            rational_derivatives(patch.v_surface(), K(u), K(v), 1, 1).at(1, 1)};
  };
  return {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
}

template <ExactField T, OrderedField K>
bool corners_agree(const GregoryPatch<T, K>& patch) {
  for (const int u : {0, 1})
    for (const int v : {0, 1}) {
      const PartialDerivatives<T, 3> a = rational_derivatives(patch.u_surface(), K(u), K(v), 1, 1);
      const PartialDerivatives<T, 3> b = rational_derivatives(patch.v_surface(), K(u), K(v), 1, 1);
      if (!(a.at(0, 0) == b.at(0, 0) && a.at(1, 0) == b.at(1, 0) && a.at(0, 1) == b.at(0, 1))) return false;
    }
  return true;
}

}  // namespace patchproof
