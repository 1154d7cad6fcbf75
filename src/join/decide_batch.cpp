// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/decide_batch.h"

#include <algorithm>
#include <cmath>

#include "join/decide_one.h"
#include "join/decide_rational_forms.h"

namespace patchproof {
namespace {

void copy_numbers(const BicubicJoinRows& rows, double (&x)[36], double (&w)[12]) {
  double* to = x;
  for (const BicubicJoinRows::Row* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
    for (const auto& point : *row) to = std::copy(point.begin(), point.end(), to);
  std::fill(w, w + 12, 1);
  if (rows.weights)
    for (int r = 0; r < 3; ++r) std::copy((*rows.weights)[r].begin(), (*rows.weights)[r].end(), w + 4 * r);
}

bool filter_refutes(const BicubicJoinRows& rows) {
  const decide::NearestGuard guard;
  double x[36], w[12];
  copy_numbers(rows, x, w);
  decide::Filtered<decide::OneLane> filtered;
  if (!decide::is_weighted(rows)) {
    decide::Differences<decide::OneLane> d;
    decide::take_differences<decide::OneLane>(x, d);
    decide::WeightedForms<decide::OneLane> forms;
    decide::apply_binomials<decide::OneLane>(d, forms);
    decide::filter_polynomial<decide::OneLane>(d, forms, filtered);
  } else {
    decide::ScaledRows<decide::OneLane> scaled;
    decide::take_scaled<decide::OneLane>(x, w, scaled);
    decide::HomogeneousRows<decide::OneLane> h;
    decide::take_homogeneous<decide::OneLane>(scaled, rows.points == WeightedPoints::cartesian, h);
    double line[5][6];
    decide::edge_line(decide::Doubles<decide::OneLane>(), h.edge, line);
    decide::filter_rational<decide::OneLane>(h, scaled.in_range, line, filtered);
  }
  return filtered.nonzero != 0;
}

// Scaled Bernstein forms of degree 3, homogeneous.
using Exact = std::array<std::vector<Rational>, 4>;

Exact exact_row(const BicubicJoinRows::Row& row, const std::array<double, 4>& weights, WeightedPoints points) {
  Exact out;
  for (int i = 0; i < 4; ++i) {
    const Rational binomial(i == 1 || i == 2 ? 3 : 1), w = binomial * from_double(weights[i]);
    for (int k = 0; k < 3; ++k)
      out[k].push_back(from_double(row[i][k]) * (points == WeightedPoints::cartesian ? w : binomial));
    out[3].push_back(w);
  }
  return out;
}
std::vector<Rational> product(const std::vector<Rational>& f, const std::vector<Rational>& g) {
  std::vector<Rational> out(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) out[i + j] += f[i] * g[j];
  return out;
}
std::vector<Rational> minor(const Exact& f, const Exact& g, int k) {  // f_w g_k − g_w f_k
  std::vector<Rational> out = product(f[3], g[k]);
  const std::vector<Rational> other = product(g[3], f[k]);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= other[i];
  return out;
}
bool is_zero_form(const std::vector<Rational>& f) {
  return std::all_of(f.begin(), f.end(), [](const Rational& x) { return x == 0; });
}

std::array<double, 4> weights_of(const BicubicJoinRows& rows, int which) {
  return rows.weights ? (*rows.weights)[which] : std::array<double, 4>{1, 1, 1, 1};
}

bool exact_c0(const BicubicJoinRows& rows, const BicubicEdge& other) {
  const auto constant = [&](const std::array<double, 4>& w) {
    return w[0] != 0 && w[0] == w[1] && w[0] == w[2] && w[0] == w[3];
  };
  const std::array<double, 4> weights = weights_of(rows, 0);
  if (constant(weights) && constant(other.weights) &&
      (rows.points == WeightedPoints::cartesian || weights == other.weights))
    return rows.edge == other.points;
  const Exact e = exact_row(rows.edge, weights_of(rows, 0), rows.points),
              f = exact_row(other.points, other.weights, rows.points);
  for (int k = 0; k < 3; ++k)
    if (!is_zero_form(minor(e, f, k))) return false;
  return true;
}

// x_s = (E_w A − A_w E) / E_w², y_s = (F_w B − B_w F) / F_w² up to one factor: their sum vanishes.
bool exact_c1(const BicubicJoinRows& rows, const BicubicEdge& other) {
  const Exact e = exact_row(rows.edge, weights_of(rows, 0), rows.points),
              a = exact_row(rows.behind_a, weights_of(rows, 1), rows.points),
              b = exact_row(rows.behind_b, weights_of(rows, 2), rows.points),
              f = exact_row(other.points, other.weights, rows.points);
  const std::vector<Rational> e_squared = product(e[3], e[3]), f_squared = product(f[3], f[3]);
  for (int k = 0; k < 3; ++k) {
    std::vector<Rational> sum = product(minor(e, a, k), f_squared);
    const std::vector<Rational> of_b = product(minor(f, b, k), e_squared);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += of_b[i];
    if (!is_zero_form(sum)) return false;
  }
  return true;
}

template <class Row>
bool all_finite(const Row& row) {
  return std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
}
bool all_positive(const std::array<double, 4>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; });
}

void require_finite(const BicubicJoinRows& rows, const BicubicEdge* other) {
  bool finite = true;
  for (const BicubicJoinRows::Row* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
    for (const auto& point : *row) finite = finite && all_finite(point);
  if (rows.weights)
    for (const auto& row : *rows.weights) finite = finite && all_finite(row);
  if (other != nullptr) {
    for (const auto& point : other->points) finite = finite && all_finite(point);
    finite = finite && all_finite(other->weights);
  }
  PATCHPROOF_REQUIRES(finite, "decide_join: a number of a join is not finite");
}

}  // namespace

namespace decide {

bool is_weighted(const BicubicJoinRows& rows) {
  if (!rows.weights) return false;
  for (const auto& row : *rows.weights)
    for (const double w : row)
      if (w != (*rows.weights)[0][0]) return true;
  return false;
}

bool same_edge(const BicubicJoinRows& rows, const BicubicEdge& other) {
  bool same = true;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) same &= rows.edge[i][k] == other.points[i][k];
    same &= (rows.weights ? (*rows.weights)[0][i] : 1) == other.weights[i];
  }
  return same;
}

// A + B = 2 E decides without weights and suffices with them; sums of doubles show it while none overflows.
bool exact_c1(const BicubicJoinRows& rows) {
  ScaledRows<OneLane> plain;
  copy_numbers(rows, plain.points, plain.weights);
  const bool weighted = is_weighted(rows);
  if (!weighted) std::fill(plain.weights, plain.weights + 12, 1);
  if (std::all_of(plain.points, plain.points + 36, [](double x) { return std::fabs(x) < kLargestInRange; })) {
    const NearestGuard guard;
    const bool middle = reflected<OneLane>(plain, weighted && rows.points == WeightedPoints::cartesian);
    if (middle || !weighted) return middle;
  }
  Exact sum = exact_row(rows.behind_a, weights_of(rows, 1), rows.points);
  const Exact e = exact_row(rows.edge, weights_of(rows, 0), rows.points),
              b = exact_row(rows.behind_b, weights_of(rows, 2), rows.points);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 4; ++i) sum[k][i] += b[k][i];
  for (int k = 0; k < 3; ++k)
    if (!is_zero_form(minor(e, sum, k))) return false;
  return true;
}

}  // namespace decide

const char* name_of(DecidedBy rung) {
  switch (rung) {
    case DecidedBy::edges: return "edges";
    case DecidedBy::filter: return "filter";
    case DecidedBy::modular: return "modular";
    case DecidedBy::fixed: return "fixed";
    case DecidedBy::nothing: break;
  }
  return "nothing";
}

JoinDecision decide_join(const BicubicJoinRows& rows, const BicubicEdge* other_edge) {
  require_finite(rows, other_edge);
  const decide::NearestGuard guard;
  JoinDecision decision;
  const bool shared = other_edge == nullptr || decide::same_edge(rows, *other_edge);
  decision.c0 = shared || exact_c0(rows, *other_edge);
  if (!decision.c0) {
    decision.g1 = FixedG1::refuted;
    decision.rung = DecidedBy::edges;
    return decision;
  }
  if (all_positive(weights_of(rows, 0)) && (shared || all_positive(other_edge->weights))) {
    decision.g1 = decide_fixed_g1(rows);
    if (decision.g1) {
      decision.rung = DecidedBy::fixed;
    } else if (filter_refutes(rows)) {
      decision.g1 = FixedG1::refuted;
      decision.rung = DecidedBy::filter;
    }
  }
  // C1 needs one tangent plane.
  if (decision.g1 != FixedG1::refuted) decision.c1 = shared ? decide::exact_c1(rows) : exact_c1(rows, *other_edge);
  return decision;
}

}  // namespace patchproof
