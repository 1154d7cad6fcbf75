// SPDX-License-Identifier: Apache-2.0
// Widths are chosen by the bounds in the header; every sum here is one of those named there.
#include "patchproof/join/fixed_g1.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "patchproof/scalar/fixed_integer.h"

namespace patchproof {
namespace {

// Σ a_i t^i (1−t)^(Degree−i), one vector of components for each i.
template <int Limbs, int Components, int Degree>
using Form = std::array<std::array<FixedInteger<Limbs>, Components>, Degree + 1>;
template <int Limbs>
using Vector3 = std::array<FixedInteger<Limbs>, 3>;

template <int Limbs, int Components>
struct IntegerRows {
  Form<Limbs, Components, 3> edge, behind_a, behind_b;
};

template <int Limbs>
FixedInteger<Limbs> times_small(const FixedInteger<Limbs>& x, int k) {
  return k == 1 ? x : k == 2 ? x + x : x + x + x;
}
constexpr std::array<int, 4> kBinomial3{1, 3, 3, 1};

// sum += x × y and sum −= x × y, in the first three components.
template <int S, class X, class Y>
void add_cross(std::array<FixedInteger<S>, 3>& sum, const X& x, const Y& y) {
  for (int k = 0; k < 3; ++k) {
    add_product(sum[k], x[(k + 1) % 3], y[(k + 2) % 3]);
    subtract_product(sum[k], x[(k + 2) % 3], y[(k + 1) % 3]);
  }
}

// The value at t = 1/2 times 2^Degree.
template <int Limbs, std::size_t Components, std::size_t Size>
std::array<FixedInteger<Limbs>, Components> sum_of(
    const std::array<std::array<FixedInteger<Limbs>, Components>, Size>& f) {
  auto sum = f[0];
  for (std::size_t i = 1; i < Size; ++i)
    for (std::size_t k = 0; k < Components; ++k) sum[k] += f[i][k];
  return sum;
}

// v cut to |r| ≤ 2^31: any direction is allowed, that of v is a good one.
template <int Limbs>
Vector3<1> short_direction(const Vector3<Limbs>& v) {
  const int bits = std::max({v[0].magnitude_bits(), v[1].magnitude_bits(), v[2].magnitude_bits()});
  Vector3<1> r;
  for (int k = 0; k < 3; ++k)
    r[k] = FixedInteger<1>(static_cast<std::int64_t>(v[k].shifted_down(std::max(0, bits - 31)).limb(0)));
  return r;
}

// All coefficients of the product of two forms, Σ_k f_k · g_k, have the sign. Stops at the first that has not.
template <int Sum, class F, class G>
bool all_products_are(Sign sign, const F& f, const G& g) {
  const int last_f = static_cast<int>(f.size()) - 1, last_g = static_cast<int>(g.size()) - 1;
  for (int s = 0; s <= last_f + last_g; ++s) {
    FixedInteger<Sum> sum;
    for (int i = std::max(0, s - last_g); i <= std::min(s, last_f); ++i)
      for (std::size_t k = 0; k < f[i].size(); ++k) add_product(sum, f[i][k], g[s - i][k]);
    if (sum.sign() != sign) return false;
  }
  return true;
}

template <int L>
FixedG1 decide_polynomial(const IntegerRows<L, 3>& rows) {
  Form<L, 3, 2> c;
  Form<L, 3, 3> a, b;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) c[i][k] = times_small(rows.edge[i + 1][k] - rows.edge[i][k], i == 1 ? 2 : 1);
    for (int i = 0; i < 4; ++i) {
      a[i][k] = times_small(rows.behind_a[i][k] - rows.edge[i][k], kBinomial3[i]);
      b[i][k] = times_small(rows.behind_b[i][k] - rows.edge[i][k], kBinomial3[i]);
    }
  }
  Form<2 * L, 3, 6> a_cross_b{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) add_cross(a_cross_b[i + j], a[i], b[j]);
  if (!all_products_are<3 * L>(Sign::zero, a_cross_b, c)) return FixedG1::refuted;

  // (c × a) · r = a · (r × c). The sums are values at 1/2, by the binomial sums 4 and 8 up to 2^(b+3) and 2^(b+4):
  // c × a fits 2L limbs.
  Vector3<2 * L> middle{};
  add_cross(middle, sum_of(c), sum_of(a));
  const Vector3<1> r = short_direction(middle);
  Form<L + 1, 3, 2> r_cross_c{};
  for (int i = 0; i < 3; ++i) add_cross(r_cross_c[i], r, c[i]);
  if (all_products_are<2 * L + 1>(Sign::positive, r_cross_c, a) &&
      all_products_are<2 * L + 1>(Sign::negative, r_cross_c, b))
    return FixedG1::proven_smooth;

  Form<2 * L, 3, 5> n_a{}, n_b{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      add_cross(n_a[i + j], c[i], a[j]);
      add_cross(n_b[i + j], c[i], b[j]);
    }
  return all_products_are<4 * L>(Sign::negative, n_a, n_b) ? FixedG1::proven_smooth : FixedG1::cannot_tell;
}

// Coefficients of E ∧ E_t up to a factor: m (E_p ∧ E_q) at degree p + q − 1.
struct EdgePair {
  int p, q, m;
};
constexpr std::array<EdgePair, 6> kEdgePairs{{{0, 1, 1}, {0, 2, 2}, {0, 3, 1}, {1, 2, 3}, {1, 3, 2}, {2, 3, 1}}};

// sum += x ∧ y: the direction x_w y − y_w x in the components 0 to 2, the moment x × y in 3 to 5.
template <int L>
void add_line(std::array<FixedInteger<2 * L>, 6>& sum, const std::array<FixedInteger<L>, 4>& x,
              const std::array<FixedInteger<L>, 4>& y) {
  for (int k = 0; k < 3; ++k) {
    add_product(sum[k], x[3], y[k]);
    subtract_product(sum[k], y[3], x[k]);
    add_product(sum[3 + k], x[(k + 1) % 3], y[(k + 2) % 3]);
    subtract_product(sum[3 + k], x[(k + 2) % 3], y[(k + 1) % 3]);
  }
}

// sum += D × x + x_w M: the normal of the plane through the line (D, M) and the point x.
template <int L>
void add_normal(Vector3<3 * L>& sum, const std::array<FixedInteger<2 * L>, 6>& line,
                const std::array<FixedInteger<L>, 4>& x) {
  add_cross(sum, line, x);
  for (int k = 0; k < 3; ++k) add_product(sum[k], line[3 + k], x[3]);
}

template <int L>
FixedG1 decide_rational(const IntegerRows<L, 4>& rows) {
  Form<2 * L, 6, 4> line{};
  for (const EdgePair& e : kEdgePairs) {
    auto q = rows.edge[e.q];
    for (auto& x : q) x = times_small(x, e.m);
    add_line<L>(line[e.p + e.q - 1], rows.edge[e.p], q);
  }
  Form<L, 4, 3> a, b;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) {
      a[i][k] = times_small(rows.behind_a[i][k], kBinomial3[i]);
      b[i][k] = times_small(rows.behind_b[i][k], kBinomial3[i]);
    }
  Form<2 * L, 6, 6> rungs{};  // A ∧ B, moment first: then the meeting condition is one scalar product
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) add_line<L>(rungs[i + j], a[i], b[j]);
  for (auto& rung : rungs)
    for (int k = 0; k < 3; ++k) std::swap(rung[k], rung[3 + k]);
  if (!all_products_are<4 * L>(Sign::zero, line, rungs)) return FixedG1::refuted;

  // (D × A + A_w M) · r = A · (r × D) + A_w (M · r). At 1/2, by the sums 10 and 8: 3 · 2^(3b+1) · 80 < 2^(3b+9),
  // which fits 3L limbs.
  Vector3<3 * L> middle{};
  add_normal<L>(middle, sum_of(line), sum_of(a));
  const Vector3<1> r = short_direction(middle);
  Form<2 * L + 1, 4, 4> plane{};
  for (int i = 0; i < 5; ++i) {
    Vector3<2 * L + 1> r_cross_d{};
    add_cross(r_cross_d, r, line[i]);
    for (int k = 0; k < 3; ++k) {
      plane[i][k] = r_cross_d[k];
      add_product(plane[i][3], line[i][3 + k], r[k]);
    }
  }
  if (all_products_are<3 * L + 1>(Sign::positive, plane, a) && all_products_are<3 * L + 1>(Sign::negative, plane, b))
    return FixedG1::proven_smooth;

  Form<3 * L, 3, 7> n_a{}, n_b{};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) {
      add_normal<L>(n_a[i + j], line[i], a[j]);
      add_normal<L>(n_b[i + j], line[i], b[j]);
    }
  return all_products_are<6 * L>(Sign::negative, n_a, n_b) ? FixedG1::proven_smooth : FixedG1::cannot_tell;
}

// A finite double as mantissa · 2^exponent.
struct Dyadic {
  std::int64_t mantissa;
  int exponent;
};
Dyadic dyadic(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int field = static_cast<int>(bits >> 52) & 2047;
  PATCHPROOF_REQUIRES(field != 2047, "decide_fixed_g1: the number is not finite");
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const auto size = static_cast<std::int64_t>(field == 0 ? fraction : fraction | std::uint64_t{1} << 52);
  return {bits >> 63 != 0 ? -size : size, std::max(field, 1) - 1075};
}

// All numbers seen are whole multiples of 2^lowest and below 2^highest in size.
struct ExponentRange {
  int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min();

  template <std::size_t N>
  void include(const std::array<double, N>& row) {
    for (const double x : row) {
      const Dyadic d = dyadic(x);
      if (d.mantissa == 0) continue;
      const auto size = static_cast<std::uint64_t>(d.mantissa < 0 ? -d.mantissa : d.mantissa);
      lowest = std::min(lowest, d.exponent + std::countr_zero(size));
      highest = std::max(highest, d.exponent + static_cast<int>(std::bit_width(size)));
    }
  }
  int bits() const { return lowest > highest ? 0 : highest - lowest; }
};

// x / 2^lowest. REQUIRES it is a whole number that fits.
template <int L>
FixedInteger<L> whole(double x, int lowest) {
  const Dyadic d = dyadic(x);
  if (d.mantissa == 0) return FixedInteger<L>();
  const int shift = d.exponent - lowest;
  return shift >= 0 ? FixedInteger<L>(d.mantissa) << shift : FixedInteger<L>(d.mantissa >> -shift);
}

template <int L>
FixedG1 decide_polynomial(const BicubicJoinRows& rows, int lowest) {
  IntegerRows<L, 3> over;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      over.edge[i][k] = whole<L>(rows.edge[i][k], lowest);
      over.behind_a[i][k] = whole<L>(rows.behind_a[i][k], lowest);
      over.behind_b[i][k] = whole<L>(rows.behind_b[i][k], lowest);
    }
  return decide_polynomial<L>(over);
}

template <int L>
FixedG1 decide_rational(const BicubicJoinRows& rows, int lowest, int lowest_weight) {
  IntegerRows<L, 4> over;
  const auto convert = [&](Form<L, 4, 3>& to, const BicubicJoinRows::Row& row, const std::array<double, 4>& weights) {
    for (int i = 0; i < 4; ++i) {
      to[i][3] = whole<L>(weights[i], lowest_weight);
      for (int k = 0; k < 3; ++k) {
        to[i][k] = whole<L>(row[i][k], lowest);
        if (rows.points == WeightedPoints::cartesian) to[i][k] = to[i][k] * to[i][3];
      }
    }
  };
  convert(over.edge, rows.edge, (*rows.weights)[0]);
  convert(over.behind_a, rows.behind_a, (*rows.weights)[1]);
  convert(over.behind_b, rows.behind_b, (*rows.weights)[2]);
  return decide_rational<L>(over);
}

bool all_equal(const std::array<std::array<double, 4>, 3>& weights) {
  for (const auto& row : weights)
    for (const double w : row)
      if (w != weights[0][0]) return false;
  return true;
}

constexpr int kBits1 = 64 - 5, kBits2 = 128 - 5;

bool to_double(const Rational& x, double& out) {
  out = nearest_double(x);
  return std::isfinite(out) && from_double(out) == x;
}

// The point p as a row's entry, without its weight.
bool to_point(const Vec<Rational, 4>& p, WeightedPoints form, std::array<double, 3>& out) {
  if (form == WeightedPoints::cartesian && p[3] == 0) return false;
  for (int k = 0; k < 3; ++k)
    if (!to_double(form == WeightedPoints::cartesian ? Rational(p[k] / p[3]) : p[k], out[k])) return false;
  return true;
}

// line + step · cross as rows of doubles.
bool to_row(const std::vector<Vec<Rational, 4>>& line, const std::vector<Vec<Rational, 4>>& cross, const Rational& step,
            WeightedPoints form, BicubicJoinRows::Row& row, std::array<double, 4>& weights) {
  for (int i = 0; i < 4; ++i) {
    const Vec<Rational, 4> p = line[i] + step * cross[i];
    if (!to_point(p, form, row[i]) || !to_double(p[3], weights[i])) return false;
  }
  return true;
}

std::vector<Vec<Rational, 4>> scaled_row(const std::vector<Vec<Rational, 4>>& row, const Rational& factor) {
  std::vector<Vec<Rational, 4>> out;
  for (const Vec<Rational, 4>& p : row) out.push_back(factor * p);
  return out;
}

// The points with all coordinates whole, and all weights: decimals and other fractions have a common denominator. Space
// is scaled by it, and the homogeneous coordinate by its own.
std::optional<BicubicJoinRows> cleared_rows(const std::vector<Vec<Rational, 4>>& edge,
                                            const std::vector<Vec<Rational, 4>>& cross_a,
                                            const std::vector<Vec<Rational, 4>>& cross_b, bool polynomial) {
  const Rational third = Rational(1) / Rational(3);
  std::array<std::vector<Vec<Rational, 4>>, 3> points{edge, edge, edge};
  for (int i = 0; i < 4; ++i) {
    points[1][i] = edge[i] + third * cross_a[i];
    points[2][i] = edge[i] + third * cross_b[i];
  }
  std::array<Integer, 4> common{1, 1, 1, 1};
  for (const auto& row : points)
    for (const Vec<Rational, 4>& p : row)
      for (int k = 0; k < 4; ++k) {
        Integer& lcm = common[k < 3 ? 0 : 3];
        mpz_lcm(lcm.backend().data(), lcm.backend().data(), mpq_denref(p[k].backend().data()));
      }
  common[1] = common[2] = common[0];
  BicubicJoinRows rows;
  rows.points = WeightedPoints::homogeneous;
  std::array<std::array<double, 4>, 3> weights;
  BicubicJoinRows::Row* to[] = {&rows.edge, &rows.behind_a, &rows.behind_b};
  for (int r = 0; r < 3; ++r)
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k)
        if (!to_double(points[r][i][k] * Rational(common[k]), k < 3 ? (*to[r])[i][k] : weights[r][i]))
          return std::nullopt;
  if (!polynomial) rows.weights = weights;
  return rows;
}

}  // namespace

std::optional<BicubicJoinRows> bicubic_join_rows(const JoinPiece<Rational>& piece) {
  for (const SideRows<Rational>* side : {&piece.a, &piece.b})
    if ((*side)[0].size() != 4 || (*side)[1].size() != 4) return std::nullopt;
  const auto is_polynomial = [](const SideRows<Rational>& side) {
    return std::all_of(side[0].begin(), side[0].end(), [&](const auto& p) { return p[3] == side[0][0][3]; }) &&
           std::all_of(side[1].begin(), side[1].end(), [](const auto& p) { return p[3] == 0; });
  };
  const Rational wa = piece.a[0][0][3], wb = piece.b[0][0][3];
  const bool polynomial = is_polynomial(piece.a) && is_polynomial(piece.b);
  const Rational factor_a = polynomial ? Rational(1 / wa) : Rational(wa < 0 ? -1 : 1), factor_b = factor_a * wa / wb;
  const auto edge = scaled_row(piece.a[0], factor_a), cross_a = scaled_row(piece.a[1], factor_a),
             cross_b = scaled_row(piece.b[1], factor_b), edge_b = scaled_row(piece.b[0], factor_b);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      if (edge[i][k] != edge_b[i][k]) return std::nullopt;

  // A third of the derivative gives back the control points of a Bézier patch on [0, 1].
  const Rational third = Rational(1) / Rational(3), one(1);
  for (const WeightedPoints form : {WeightedPoints::homogeneous, WeightedPoints::cartesian}) {
    BicubicJoinRows rows;
    std::array<std::array<double, 4>, 3> weights;
    const auto behind = [&](const auto& cross, BicubicJoinRows::Row& row, std::array<double, 4>& w) {
      return to_row(edge, cross, third, form, row, w) || to_row(edge, cross, one, form, row, w);
    };
    if (!to_row(edge, cross_a, Rational(0), form, rows.edge, weights[0]) ||
        !behind(cross_a, rows.behind_a, weights[1]) || !behind(cross_b, rows.behind_b, weights[2]))
      continue;
    rows.points = form;
    if (!polynomial) rows.weights = weights;
    return rows;
  }
  return cleared_rows(edge, cross_a, cross_b, polynomial);
}

std::optional<FixedG1> decide_fixed_g1(const BicubicJoinRows& rows) {
  ExponentRange coordinates, weights;
  for (const BicubicJoinRows::Row* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
    for (const auto& point : *row) coordinates.include(point);
  if (rows.weights) {
    for (const auto& row : *rows.weights) weights.include(row);
    for (const double w : (*rows.weights)[0])
      if (!(w > 0)) return std::nullopt;
  }
  if (!rows.weights || all_equal(*rows.weights)) {
    if (coordinates.bits() <= kBits1) return decide_polynomial<1>(rows, coordinates.lowest);
    if (coordinates.bits() <= kBits2) return decide_polynomial<2>(rows, coordinates.lowest);
    return std::nullopt;
  }
  const int bits = rows.points == WeightedPoints::cartesian ? coordinates.bits() + weights.bits()
                                                            : std::max(coordinates.bits(), weights.bits());
  if (bits <= kBits1) return decide_rational<1>(rows, coordinates.lowest, weights.lowest);
  if (bits <= kBits2) return decide_rational<2>(rows, coordinates.lowest, weights.lowest);
  return std::nullopt;
}

}  // namespace patchproof
