// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gregory_batch.h"

#include <cmath>
#include <limits>

#include "kernels/batch_call.h"
#include "kernels/error_bounds.h"
#include "kernels/gregory_tiles.h"
#include "kernels/prepare.h"
#include "patchproof/patch/bezier_patch.h"

namespace patchproof {
namespace kernels {

struct GregoryPieces {
  GregoryPatch<Rational> patch;
  BsplinePatch<Rational, 4> exact_u, exact_v;  // of doubles
  BatchSurface u_surface, v_surface;
  GregoryNets nets;
  bool inner;  // all weights are 1, so that Q⁰ and Q¹ differ in the inner points only
  std::array<double, 6> bounds;
};

}  // namespace kernels

namespace {

using kernels::GregoryNets;
using Tile = kernels::GregoryTile;

constexpr std::size_t kTile = kernels::kGregoryTile, kLanes = kernels::kGregoryLanes;
constexpr int kVectors = 6;
constexpr double kNearest = 0x1p-256;  // to a corner, for the blend
constexpr double kExactly = 0x1p-10;   // nearer to a corner than this, patches with weights are evaluated exactly

using Numbers = std::vector<double>;
struct RoundedSurface {
  Numbers knots_u, knots_v, points, weights;
  BsplinePatch<Rational, 4> exact;
  SurfaceData data(const BsplinePatch<Rational, 4>& s) const {
    return {s.degree(Direction::u), s.degree(Direction::v), knots_u, knots_v, points, weights};
  }
};

RoundedSurface rounded_surface(const BsplinePatch<Rational, 4>& s) {
  RoundedSurface out{{}, {}, {}, {}, s};
  std::vector<Rational> knots[2];
  for (const Direction d : {Direction::u, Direction::v})
    for (const Rational& t : s.knots(d).knots()) {
      (d == Direction::u ? out.knots_u : out.knots_v).push_back(nearest_double(t));
      knots[d == Direction::v].push_back(from_double(nearest_double(t)));
    }
  const bool rational = std::any_of(s.net().begin(), s.net().end(), [](const auto& p) { return p[3] != 1; });
  std::vector<Vec<Rational, 4>> net;
  for (const Vec<Rational, 4>& p : s.net()) {
    const double w = nearest_double(p[3]);
    Vec<Rational, 4> h{{0, 0, 0, std::isfinite(w) ? from_double(w) : Rational(0)}};
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = p[3] == 0 ? std::numeric_limits<double>::quiet_NaN() : nearest_double(Rational(p[c] / p[3]));
      out.points.push_back(x);
      if (std::isfinite(x)) h[c] = from_double(x) * h[3];
    }
    if (rational) out.weights.push_back(w);
    net.push_back(h);
  }
  out.exact = BsplinePatch<Rational, 4>(
      KnotVector<Rational>::make_unchecked(s.degree(Direction::u), std::move(knots[0])),
      KnotVector<Rational>::make_unchecked(s.degree(Direction::v), std::move(knots[1])), std::move(net));
  return out;
}

double up(double x) { return x * (1 + 0x1p-40); }
double size_of(const Rational& x) { return up(std::fabs(nearest_double(x))); }
template <std::size_t N>
double size_of(const Vec<Rational, N>& p, std::size_t components = 3) {
  double out = 0;
  for (std::size_t c = 0; c < components; ++c) out = std::max(out, size_of(p[c]));
  return out;
}

// The largest coordinates of a polynomial surface's vectors, by the Bézier points of its pieces.
std::array<double, 6> sizes_of(const BsplinePatch<Rational, 4>& s) {
  std::array<double, 6> out{};
  constexpr int kOrders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (const PatchPiece<Rational, 4, Rational>& piece : extract_bezier(s))
    for (int m = 0; m < kVectors; ++m) {
      BezierPatch<Rational, 4> d = piece.bezier;
      Rational scale(1);
      for (int k = 0; k < kOrders[m][0]; ++k)
        d = derivative_patch(d, Direction::u), scale /= piece.box.u_end - piece.box.u_begin;
      for (int k = 0; k < kOrders[m][1]; ++k)
        d = derivative_patch(d, Direction::v), scale /= piece.box.v_end - piece.box.v_begin;
      for (const Vec<Rational, 4>& p : d.net()) out[m] = std::max(out[m], up(size_of(p) * size_of(scale)));
    }
  return out;
}

GregoryNets nets_of(const GregoryPatch<Rational>& patch) {
  GregoryNets nets;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec<Rational, 4>&q0 = patch.from_u()[i][j], &q1 = patch.from_v()[i][j];
      const std::size_t p = i / 2, q = j / 2;
      const bool corner_i = i % 3 == 0, corner_j = j % 3 == 0;
      double* d = !corner_i && !corner_j ? nets.inner[p][q]
                                         : nets.others[p][q][corner_i && corner_j ? 0
                                                             : corner_j           ? 1
                                                                                  : 2];
      for (std::size_t c = 0; c < 4; ++c) {
        nets.q[i][j][c] = nearest_double(q1[c]);
        d[c] = nearest_double(Rational(q0[c] - q1[c]));
      }
    }
  return nets;
}

// |error of S^c| in each vector, and |S^c|.
struct CBounds {
  std::array<double, 6> error, size;
};
CBounds c_bounds(const GregoryPatch<Rational>& patch, bool inner) {
  CBounds out;
  double m = 0, w = 0, s = 0, s_w = 0, smallest = std::numeric_limits<double>::infinity(), affine = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (const auto* net : {&patch.from_u(), &patch.from_v()}) {
        const Vec<Rational, 4>& q = (*net)[i][j];
        m = std::max(m, size_of(q)), w = std::max(w, size_of(q[3]));
        smallest = std::min(smallest, nearest_double(q[3]) * (1 - 0x1p-50));
        affine = std::max(affine, std::max({size_of(Rational(q[0] / q[3])), size_of(Rational(q[1] / q[3])),
                                            size_of(Rational(q[2] / q[3]))}));
      }
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      double of_quadrant = 0, weight = 0;
      for (std::size_t i = 2 * p; i < 2 * p + 2; ++i)
        for (std::size_t j = 2 * q; j < 2 * q + 2; ++j) {
          const Vec<Rational, 4> d = patch.from_u()[i][j] - patch.from_v()[i][j];
          of_quadrant = std::max(of_quadrant, size_of(d)), weight = std::max(weight, size_of(d[3]));
        }
      s = up(s + of_quadrant), s_w = up(s_w + weight);
    }
  if (inner) {
    constexpr double kOfNet[6] = {1, 6, 6, 24, 36, 24}, kOfInner[6] = {0.2, 2, 2, 27, 27, 27};
    for (int v = 0; v < kVectors; ++v) {
      const int n = v == 0  ? kernels::roundings<0, true>()
                    : v < 3 ? kernels::roundings<1, true>()
                            : kernels::roundings<2, true>();
      out.size[v] = up(kOfNet[v] * m + kOfInner[v] * s);
      // Places moved to the distance 2^-256 from a corner, and underflow.
      out.error[v] = up(kernels::gamma(n + 1) * out.size[v] + 0x1p-200 * (m + s) + 0x1p-500);
    }
    return out;
  }
  out.error.fill(std::numeric_limits<double>::infinity());
  out.size.fill(std::numeric_limits<double>::infinity());
  // The quotient: error_bounds.h.
  const double unit = kernels::gamma(kernels::roundings<0, false>() + 1);
  const double of_numerator = up(unit * up(m + s)), of_weight = up(unit * up(w + s_w));
  out.size[0] = affine;
  if (smallest > of_weight)
    out.error[0] = up((of_numerator + affine * of_weight) / (smallest - of_weight)) +
                   up(4 * kernels::kUnitRoundoff * affine) + 0x1p-500;
  return out;
}

// Away from the corner along its ray, by a power of two; at the corner itself, along the diagonal.
void move_away(double& x, double& y) {
  const double r = std::max(x, y);
  if (!(r < kNearest)) return;
  if (r == 0) {
    x = y = kNearest;
    return;
  }
  int exponent = 0;
  std::frexp(r, &exponent);
  x = std::ldexp(x, -255 - exponent), y = std::ldexp(y, -255 - exponent);
}

// S^c and its derivatives from the homogeneous ones, in place.
void project(Tile& tile, int order, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double w = 1 / tile.c[0][3][i];
    for (int c = 0; c < 3; ++c) {
      const auto h = [&](int v) -> double& { return tile.c[v][c][i]; };
      const auto d = [&](int v) { return tile.c[v][3][i]; };
      h(0) = h(0) * w;
      if (order < 1) continue;
      h(1) = (h(1) - h(0) * d(1)) * w;
      h(2) = (h(2) - h(0) * d(2)) * w;
      if (order < 2) continue;
      h(3) = (h(3) - (2 * (h(1) * d(1)) + h(0) * d(3))) * w;
      h(4) = (h(4) - ((h(1) * d(2) + h(2) * d(1)) + h(0) * d(4))) * w;
      h(5) = (h(5) - (2 * (h(2) * d(2)) + h(0) * d(5))) * w;
    }
  }
}

// The exact distances from the ends, moved away from the corners as those of the kernel are.
std::array<Rational, 2> moved_exactly(double u, double v) {
  double x = std::min(u, 1 - u), y = std::min(v, 1 - v);
  if (!(std::max(x, y) < kNearest)) return {from_double(u), from_double(v)};
  move_away(x, y);
  const auto back = [](double t, double distance) {
    return t < 0.5 ? from_double(distance) : Rational(1 - from_double(distance));
  };
  return {back(u, x), back(v, y)};
}

// All vectors at one place near a corner, found exactly.
void exactly(const kernels::GregoryPieces& s, double u, double v, const SurfaceBatchOptions& options, int order,
             double (&out)[kVectors][3]) {
  using Series = PowerSeries<Rational, 2>;
  const auto [at_u, at_v] = moved_exactly(u, v);
  Vec<Series, 4> h =
      evaluate_c_surface<Series>(s.patch, Series::variable(0, at_u, order), Series::variable(1, at_v, order));
  Vec<Series, 3> c{{h[0] / h[3], h[1] / h[3], h[2] / h[3]}};
  const auto of = [&](const BsplinePatch<Rational, 4>& surface) {
    return rational_derivatives(surface, from_double(u), from_double(v), order, order, options.side_u, options.side_v);
  };
  const PartialDerivatives<Rational, 3> of_u = of(s.exact_u), of_v = of(s.exact_v);
  constexpr std::array<int, 2> kOrders[kVectors] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int m = 0; m < (order == 0 ? 1 : order == 1 ? 3 : kVectors); ++m) {
    const Vec<Rational, 3> all = of_u.at(kOrders[m][0], kOrders[m][1]) + of_v.at(kOrders[m][0], kOrders[m][1]) -
                                 detail::derivative_of(c, kOrders[m]);
    for (std::size_t k = 0; k < 3; ++k) out[m][k] = nearest_double(all[k]);
  }
}

// S_u × S_v of length 1. False when it has no direction in double.
bool unit_normal(const Vec<double, 3>& du, const Vec<double, 3>& dv, double (&n)[3]) {
  // Each brought to about 1, so that no product leaves the range.
  const auto scaled = [](Vec<double, 3> p) {
    const double size = std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
    int exponent = 0;
    std::frexp(size, &exponent);
    for (double& x : p.c) x = std::ldexp(x, -exponent);
    return p;
  };
  const Vec<double, 3> c = cross(scaled(du), scaled(dv));
  const double length = std::sqrt(dot(c, c));
  const bool defined = length > 0x1p-450;
  for (int k = 0; k < 3; ++k) n[k] = defined ? c[k] / length : 0;
  return defined;
}

class Evaluation {
 public:
  Evaluation(const kernels::GregoryPieces& pieces, const SurfaceOutput& out, const SurfaceBatchOptions& options)
      : pieces_(pieces), out_(out), options_(options), set_(resolve(options.instructions)) {
    options_.threads = 1;
    const bool first = out.du.wanted() || out.dv.wanted() || out.normal.wanted();
    order_ = out.duu.wanted() || out.duv.wanted() || out.dvv.wanted() ? 2 : first ? 1 : 0;
  }

  kernels::Progress operator()(std::span<const double> u, std::span<const double> v, std::size_t begin,
                               std::size_t count) const {
    kernels::Progress progress;
    for (std::size_t at = 0; at < count; at += kTile) {
      const std::size_t n = std::min(kTile, count - at);
      const kernels::Progress one = tile(u.data() + begin + at, v.data() + begin + at, begin + at, n);
      progress.good += one.good;
      progress.undefined_normals += one.undefined_normals;
      progress.stop = one.stop;
      if (one.stop != kernels::Stop::none) break;
    }
    return progress;
  }

 private:
  kernels::Progress tile(const double* u, const double* v, std::size_t begin, std::size_t n) const {
    for (std::size_t i = 0; i < n; ++i)
      if (!(0 <= u[i] && u[i] <= 1 && 0 <= v[i] && v[i] <= 1)) return {i, kernels::Stop::outside_domain, 0};
    Tile t;
    bool near[kTile];
    for (std::size_t i = 0; i < n; ++i) {
      t.x[0][i] = u[i], t.x[1][i] = 1 - u[i], t.y[0][i] = v[i], t.y[1][i] = 1 - v[i];
      const double closest = std::max(std::min(u[i], 1 - u[i]), std::min(v[i], 1 - v[i]));
      near[i] = closest < kExactly;
      if (closest < kNearest)
        for (int p = 0; p < 2; ++p)
          for (int q = 0; q < 2; ++q) move_away(t.x[p][i], t.y[q][i]);
    }
    for (std::size_t i = n; i % kLanes != 0; ++i)
      for (int e = 0; e < 2; ++e) t.x[e][i] = t.y[e][i] = 0.5;
    if (pieces_.inner)
      kernels::c_tile<true>(set_, order_, pieces_.nets, t, n);
    else
      kernels::c_tile<false>(set_, order_, pieces_.nets, t, n), project(t, order_, n);

    double of_u[kVectors][3][kTile], of_v[kVectors][3][kTile];
    const int wanted = order_ == 0 ? 1 : order_ == 1 ? 3 : kVectors;
    for (const bool is_u : {true, false}) {
      auto& to = is_u ? of_u : of_v;
      SurfaceOutput out;
      VectorArray* arrays[kVectors] = {&out.point, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
      for (int m = 0; m < wanted; ++m) *arrays[m] = VectorArray::separate(to[m][0], to[m][1], to[m][2]);
      const auto done = (is_u ? pieces_.u_surface : pieces_.v_surface).evaluate({u, n}, {v, n}, out, options_);
      if (!done) return {0, kernels::Stop::vanishing_weight, 0};
    }
    for (int m = 0; m < wanted; ++m)
      for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i) t.c[m][c][i] = (of_u[m][c][i] + of_v[m][c][i]) - t.c[m][c][i];
    if (!pieces_.inner)
      for (std::size_t i = 0; i < n; ++i) {
        if (!near[i]) continue;
        double all[kVectors][3];
        exactly(pieces_, u[i], v[i], options_, order_, all);
        for (int m = 0; m < wanted; ++m)
          for (int c = 0; c < 3; ++c) t.c[m][c][i] = all[m][c];
      }
    return {n, kernels::Stop::none, write(t, begin, n)};
  }

  std::size_t write(const Tile& t, std::size_t begin, std::size_t n) const {
    const VectorArray* arrays[kVectors] = {&out_.point, &out_.du, &out_.dv, &out_.duu, &out_.duv, &out_.dvv};
    for (int m = 0; m < kVectors; ++m) {
      const VectorArray to = arrays[m]->from(static_cast<std::ptrdiff_t>(begin));
      if (!to.wanted()) continue;
      double* const starts[3] = {to.x, to.y, to.z};
      for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i) starts[c][static_cast<std::ptrdiff_t>(i) * to.stride] = t.c[m][c][i];
    }
    std::size_t undefined = 0;
    if (!out_.normal.wanted()) return undefined;
    for (std::size_t i = 0; i < n; ++i) {
      const VectorArray to = out_.normal.from(static_cast<std::ptrdiff_t>(begin + i));
      double normal[3];
      const auto vector = [&](int m) { return Vec<double, 3>{{t.c[m][0][i], t.c[m][1][i], t.c[m][2][i]}}; };
      if (!unit_normal(vector(1), vector(2), normal)) ++undefined;
      *to.x = normal[0], *to.y = normal[1], *to.z = normal[2];
    }
    return undefined;
  }

  const kernels::GregoryPieces& pieces_;
  const SurfaceOutput& out_;
  SurfaceBatchOptions options_;
  InstructionSet set_;
  int order_;
};

}  // namespace

Result<BatchGregory> BatchGregory::make(const GregoryPatch<Rational>& patch) {
  PATCHPROOF_REQUIRES(corners_agree(patch), "BatchGregory: the corners agree");
  const RoundedSurface of_u = rounded_surface(patch.u_surface()), of_v = rounded_surface(patch.v_surface());
  Result<BatchSurface> u = BatchSurface::make(of_u.data(patch.u_surface()));
  if (!u) return u.error();
  Result<BatchSurface> v = BatchSurface::make(of_v.data(patch.v_surface()));
  if (!v) return v.error();
  const bool inner = of_u.weights.empty() && of_v.weights.empty();
  kernels::GregoryPieces out{patch, of_u.exact, of_v.exact, std::move(*u), std::move(*v), nets_of(patch), inner, {}};
  for (const double& x : std::span(&out.nets.q[0][0][0], sizeof(GregoryNets) / sizeof(double)))
    if (!std::isfinite(x))
      return Error{ErrorCode::bad_number, "", "a point of the C surface is not finite in double", ""};
  const CBounds c = c_bounds(patch, inner);
  const auto sizes_u = inner ? sizes_of(out.exact_u) : std::array<double, 6>{},
             sizes_v = inner ? sizes_of(out.exact_v) : std::array<double, 6>{};
  double affine = 0;  // of U and V: positive weights make means of their points
  for (const Numbers* points : {&of_u.points, &of_v.points})
    for (const double x : *points) affine = std::max(affine, std::fabs(x));
  for (int m = 0; m < kVectors; ++m) {
    const auto vector = static_cast<SurfaceVector>(m);
    const double sizes = inner ? sizes_u[m] + sizes_v[m] : 2 * affine;
    out.bounds[m] = up(out.u_surface.error_bound(vector) + out.v_surface.error_bound(vector) + c.error[m] +
                       3 * kernels::kUnitRoundoff * (sizes + c.size[m]));
  }
  return BatchGregory(std::make_shared<const kernels::GregoryPieces>(std::move(out)));
}

const GregoryPatch<Rational>& BatchGregory::patch() const { return pieces_->patch; }
const BsplinePatch<Rational, 4>& BatchGregory::u_surface() const { return pieces_->exact_u; }
const BsplinePatch<Rational, 4>& BatchGregory::v_surface() const { return pieces_->exact_v; }
bool BatchGregory::is_polynomial() const { return pieces_->inner; }
double BatchGregory::error_bound(SurfaceVector vector) const { return pieces_->bounds[static_cast<int>(vector)]; }

Result<BatchSummary> BatchGregory::evaluate(std::span<const double> u, std::span<const double> v,
                                            const SurfaceOutput& out, const SurfaceBatchOptions& options) const {
  PATCHPROOF_REQUIRES(u.size() == v.size(), "batch evaluation: as many u as v");
  const Evaluation evaluation(*pieces_, out, options);
  return batch::run(
      u.size(), batch::kShare, options.threads,
      [&](std::size_t begin, std::size_t count) { return evaluation(u, v, begin, count); },
      [&](std::size_t i) {
        return "(u, v) = (" + kernels::number_text(u[i]) + ", " + kernels::number_text(v[i]) + ")";
      });
}

}  // namespace patchproof
