// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/gregory_proof.h"

#include <algorithm>

#include "gregory_regularity.h"
#include "patchproof/parallel.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof {
namespace {

using Patch = GregoryPatch<Rational>;
using Point4 = Vec<Rational, 4>;

const Point4& row_point(const BsplinePatch<Rational, 4>& surface, Direction along, int row, int k) {
  return along == Direction::v ? surface.point(row, k) : surface.point(k, row);
}

// The conditions at both ends of the four rows of one surface.
bool is_matched(const BsplinePatch<Rational, 4>& surface, Direction along, const Patch::Net& c_points) {
  const KnotVector<Rational>& knots = surface.knots(along);
  const int n = knots.control_count(), degree = knots.degree();
  const auto c = [&](int row, int k) -> const Point4& {
    return along == Direction::v ? c_points[row][k] : c_points[k][row];
  };
  for (const bool at_end : {false, true}) {
    const Rational rate =
        at_end ? Rational(degree / (knots[n] - knots[n - 1])) : Rational(degree / (knots[degree + 1] - knots[degree]));
    std::optional<Rational> common;
    for (int row = 0; row < 4; ++row) {
      const Point4 &end = row_point(surface, along, row, at_end ? n - 1 : 0),
                   &next = row_point(surface, along, row, at_end ? n - 2 : 1);
      const Point4 &q0 = c(row, at_end ? 3 : 0), &q1 = c(row, at_end ? 2 : 1);
      if (!(q0 == end)) return false;
      const Point4 rest = Rational(3) * (q1 - q0) - rate * (next - end);
      const Rational mu = rest[3] / end[3];
      if (!(rest == mu * end) || (common && *common != mu)) return false;
      common = mu;
    }
  }
  return true;
}

std::vector<Rational> component(const std::vector<Point4>& points, int c) {
  std::vector<Rational> out;
  for (const Point4& p : points) out.push_back(p[c]);
  return out;
}

// Across a knot line the homogeneous derivative jumps by J(s) = Σ B_i(s) J_i, the surface by none iff J is a multiple of
// X(s) = Σ B_i(s) R_i at every s: iff the polynomials J_k X_4 − J_4 X_k vanish.
bool has_c1_rows(const BsplinePatch<Rational, 4>& surface, Direction along) {
  const KnotVector<Rational>& knots = surface.knots(along);
  for (const Rational& t : knots.breaks()) {
    // A B-spline is C^(degree − multiplicity); where that is less than C¹ its control points decide.
    if (t <= 0 || t >= 1 || knots.multiplicity(t) < knots.degree()) continue;
    std::vector<Point4> position, jump;
    for (int row = 0; row < 4; ++row) {
      std::vector<Point4> points;
      for (int k = 0; k < knots.control_count(); ++k) points.push_back(row_point(surface, along, row, k));
      const BsplineCurve<Rational, 4> curve(knots, std::move(points));
      position.push_back(evaluate(curve, t));
      jump.push_back(derivative(curve, t, 1, Side::right) - derivative(curve, t, 1, Side::left));
    }
    for (int k = 0; k < 3; ++k)
      if (product(component(jump, k), component(position, 3)) != product(component(jump, 3), component(position, k)))
        return false;
  }
  return true;
}

bool has_positive_weights(const Patch& patch) {
  const auto positive = [](const Point4& p) { return p[3] > 0; };
  const auto all = [&](const std::vector<Point4>& net) { return std::all_of(net.begin(), net.end(), positive); };
  const auto all_of_net = [&](const Patch::Net& net) {
    return std::all_of(net.begin(), net.end(),
                       [&](const auto& row) { return std::all_of(row.begin(), row.end(), positive); });
  };
  return all(patch.u_surface().net()) && all(patch.v_surface().net()) && all_of_net(patch.from_u()) &&
         all_of_net(patch.from_v());
}

bool is_polynomial(const Patch& patch) {
  const auto one = [](const Point4& p) { return p[3] == 1; };
  const auto all = [&](const auto& net) { return std::all_of(net.begin(), net.end(), one); };
  return all(patch.u_surface().net()) && all(patch.v_surface().net()) &&
         std::all_of(patch.from_u().begin(), patch.from_u().end(), all) &&
         std::all_of(patch.from_v().begin(), patch.from_v().end(), all);
}

// A place of a coarse grid where the normal is exactly zero.
std::optional<std::array<Rational, 2>> exact_zero(const Patch& patch) {
  constexpr int kCells = 4;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const Rational u(i, kCells), v(j, kCells);
      if (frame(patch, u, v).normal() == Vec<Rational, 3>{}) return std::array<Rational, 2>{u, v};
    }
  return std::nullopt;
}

// A number of either size that the products of intervals keep within the range of doubles.
bool is_moderate(const Rational& x) {
  static const Rational large(Integer(1) << 200);
  return x < large && large * x > 1;
}

// The same surface in another size, and with one factor in all homogeneous points: the normal vanishes where it did.
Patch in_moderate_numbers(const Patch& patch) {
  const Point4& corner = patch.u_surface().point(0, 0);
  const Rational& weight = corner[3];
  Rational size(0);
  for (const auto* surface : {&patch.u_surface(), &patch.v_surface()})
    for (const Point4& p : surface->net())
      for (std::size_t c = 0; c < 3; ++c)
        size = std::max(size, Rational(abs(Rational(p[c] / p[3] - corner[c] / weight))));
  if (size == 0 || (is_moderate(size) && is_moderate(weight))) return patch;
  const auto scaled = [&](const BsplinePatch<Rational, 4>& s) {
    std::vector<Point4> net;
    for (const Point4& p : s.net()) {
      Point4 q = Rational(1 / weight) * p;
      for (std::size_t c = 0; c < 3; ++c) q[c] = (q[c] - corner[c] / weight * q[3]) / size;
      net.push_back(q);
    }
    return BsplinePatch<Rational, 4>(s.knots(Direction::u), s.knots(Direction::v), std::move(net));
  };
  return Patch::make(scaled(patch.u_surface()), scaled(patch.v_surface())).value();
}

ExactClass decide_regularity(const Patch& given, int max_boxes, int& boxes) {
  const Patch patch = in_moderate_numbers(given);
  const RoundingGuard guard;
  const RegularityResult result =
      is_polynomial(patch) ? prove_regular_polynomial(patch, max_boxes) : prove_regular_rational(patch, max_boxes);
  boxes = result.boxes;
  if (result.proven) return {Verdict::proven, "", std::nullopt};
  return {Verdict::undecided,
          "the normal could not be kept away from zero near (" + to_text(result.stopped[0]) + ", " +
              to_text(result.stopped[1]) + ")",
          std::nullopt};
}

}  // namespace

GregoryProof prove_patch(const GregoryPatch<Rational>& patch, int max_boxes) {
  GregoryProof out;
  out.matched = is_matched(patch.u_surface(), Direction::v, patch.from_u()) &&
                is_matched(patch.v_surface(), Direction::u, patch.from_v());
  out.corners = corners_agree(patch);
  out.c1 = has_c1_rows(patch.u_surface(), Direction::v) && has_c1_rows(patch.v_surface(), Direction::u);
  out.positive = has_positive_weights(patch);
  if (!out.matched || !out.corners || !out.positive) {  // what the proof is built on
    out.regular.reason = !out.positive ? "not all weights are positive" : "its surfaces do not fit in the corners";
    return out;
  }
  out.regular = decide_regularity(patch, max_boxes, out.boxes);
  if (out.regular.verdict == Verdict::undecided)
    if (const auto zero = exact_zero(patch)) {
      out.regular.verdict = Verdict::refuted;
      const std::array<std::string, 2> at{to_text((*zero)[0]), to_text((*zero)[1])};
      out.regular.reason = "the normal vanishes at (" + at[0] + ", " + at[1] + ")";
      out.regular.witness = Witness{"S_u × S_v", at, at, {"0", "0", "0"}};
    }
  return out;
}

std::vector<GregoryProof> prove_patches(const std::vector<const GregoryPatch<Rational>*>& patches, int jobs) {
  std::vector<GregoryProof> out(patches.size());
  for_each_item(jobs, patches.size(), [&](std::size_t i) { out[i] = prove_patch(*patches[i]); });
  return out;
}

}  // namespace patchproof
