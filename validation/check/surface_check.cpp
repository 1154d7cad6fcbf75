// SPDX-License-Identifier: Apache-2.0
// Surfaces. The bound of a unit normal n = N/|N|, N = S_u × S_v, with e_u, e_v the bounds of each coordinate of S_u, S_v:
//   |computed N − N| ≤ E = |S_u| d_v + |S_v| d_u + d_u d_v + 4u (|S_u| + d_u)(|S_v| + d_v),   d = √3 e
// (a component a·b − c·d is rounded at most twice for each product and once for the difference; together 4u |a||b|), and
// for vectors |a/|a| − b/|b|| ≤ 2 |a − b| / |b|. Normalising rounds at most 6u more.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "kernels/pieces.h"
#include "validation/check/judge.h"

namespace patchproof::validation {
namespace {

constexpr double kU = 0x1p-53, kSlack = 1 + 0x1p-30;  // kSlack: the roundings of the bound's own computation

// The places of seven vectors of a batch of items, in one of the layouts.
enum class Layout { separate, interleaved, records };
constexpr int kVectors = 7;  // S, S_u, S_v, S_uu, S_uv, S_vv, n
constexpr std::array<const char*, kVectors> kNames{"S", "S_u", "S_v", "S_uu", "S_uv", "S_vv", "n"};

struct Results {
  std::size_t items = 0;
  std::vector<double> numbers;  // item i, vector k, coordinate c at (i·7 + k)·3 + c: records
  double at(std::size_t i, int k, int c) const { return numbers[(i * kVectors + k) * 3 + c]; }
};

class SurfaceCheck {
 public:
  SurfaceCheck(const SurfaceCase& s, const CheckOptions& options, Tallies& tallies)
      : s_(s), options_(options), tallies_(tallies), exact_(exact_patch(s.data())) {
    for (std::size_t i = 0; i < s.u.size(); ++i) truth_.push_back(exact_values(exact_, s.u[i], s.v[i], s.side, 2));
    for (const double u : s.grid_u)
      for (const double v : s.grid_v) {
        all_u_.push_back(u);
        all_v_.push_back(v);
        grid_truth_.push_back(exact_values(exact_, u, v, s.side, 2));
      }
    knots_u_ = KnotVector<double>::make(s.degree_u, s.knots_u).value();
    knots_v_ = KnotVector<double>::make(s.degree_v, s.knots_v).value();
  }

  void run() {
    const Result<BatchSurface> made = BatchSurface::make(s_.data());
    if (!made) return refused("S", InstructionSet::fastest, made.error());
    const BatchSurface& surface = *made;
    std::optional<Results> fused_scattered, fused_grid;  // of the first set with fused multiply-add
    for (const InstructionSet set : options_.sets) {
      const auto scattered = evaluate(surface, set, Layout::separate, false, true);
      const auto grid = evaluate(surface, set, Layout::separate, true, true);
      if (!scattered || !grid) continue;
      judge(surface, set, *scattered, "", s_.u, s_.v, truth_);
      judge(surface, set, *grid, "grid ", all_u_, all_v_, grid_truth_);
      same_whatever_else(surface, set, *scattered, *grid);
      if (fuses_multiply_add(set)) {
        if (fused_scattered) compare(set, *fused_scattered, *scattered, kVectors, "another instruction set");
        if (fused_grid) compare(set, *fused_grid, *grid, kVectors, "another instruction set");
        if (!fused_scattered) fused_scattered = scattered;
        if (!fused_grid) fused_grid = grid;
      }
      enclosures(surface, set, *scattered);
      accurate(surface, set);
    }
  }

 private:
  Tally& tally(const std::string& kernel, InstructionSet set) { return tallies_[{kernel, set, s_.group}]; }

  void refused(const std::string& kernel, InstructionSet set, const Error& error) {
    Tally& t = tally(kernel, set == InstructionSet::fastest ? resolve(set) : set);
    if (t.violations++ == 0) t.violation = s_.name + ": refused: " + error.text();
  }

  SurfaceBatchOptions call_options(InstructionSet set) const {
    SurfaceBatchOptions out;
    out.side_u = out.side_v = s_.side;
    out.instructions = set;
    return out;
  }

  // All vectors, or the points alone.
  std::optional<Results> evaluate(const BatchSurface& surface, InstructionSet set, Layout layout, bool grid, bool all) {
    Results out;
    out.items = grid ? s_.grid_u.size() * s_.grid_v.size() : s_.u.size();
    std::vector<double> room(out.items * kVectors * 3 + 1, std::nan(""));
    double* const from = room.data() + 1;  // at no special alignment
    const auto n = static_cast<std::ptrdiff_t>(out.items);
    const auto place = [&](int k) {
      double* const x = from + 3 * n * k;
      return layout == Layout::separate      ? VectorArray::separate(x, x + n, x + 2 * n)
             : layout == Layout::interleaved ? VectorArray::interleaved(x)
                                             : VectorArray::records(from + 3 * k, 3 * kVectors);
    };
    SurfaceOutput to;
    to.point = place(0);
    if (all) to = {place(0), place(1), place(2), place(6), place(3), place(4), place(5)};
    const Result<BatchSummary> done = grid ? surface.evaluate_grid(s_.grid_u, s_.grid_v, to, call_options(set))
                                           : surface.evaluate(s_.u, s_.v, to, call_options(set));
    if (!done) {
      refused(grid ? "grid S" : "S", set, done.error());
      return {};
    }
    out.numbers.resize(out.items * kVectors * 3);
    for (int k = 0; k < (all ? kVectors : 1); ++k) {
      const VectorArray a = place(k);
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        double* const record = &out.numbers[(static_cast<std::size_t>(i) * kVectors + k) * 3];
        record[0] = a.x[i * a.stride];
        record[1] = a.y[i * a.stride];
        record[2] = a.z[i * a.stride];
      }
    }
    return out;
  }

  // The numbers of the polynomial piece that a parameter lies in.
  const kernels::PieceBounds& bounds(const BatchSurface& surface, double u, double v) const {
    const kernels::SurfacePieces& p = surface.pieces();
    const auto index = [&](const kernels::Axis& axis, const KnotVector<double>& knots, double t) {
      const int span = knots.find_span(t, s_.side);
      return std::find(axis.knot_span.begin(), axis.knot_span.end(), span) - axis.knot_span.begin();
    };
    return p.bounds[static_cast<std::size_t>(index(p.u, knots_u_, u) * p.v.count + index(p.v, knots_v_, v))];
  }

  std::string place(double u, double v, int c) const {
    return fmt::format("{} at ({:a}, {:a}){}.{}", s_.name, u, v, s_.side == Side::left ? " from the left" : "",
                       "xyz"[c]);
  }

  static double length(const ExactVector& a) {
    const double x = nearest_double(a[0]), y = nearest_double(a[1]), z = nearest_double(a[2]);
    return std::hypot(x, y, z) * kSlack;
  }
  static double normal_bound(const SurfaceTruth& t, const kernels::PieceBounds& b) {
    const double du = std::sqrt(3.0) * b.error[1] * kSlack, dv = std::sqrt(3.0) * b.error[2] * kSlack;
    const double a = length(t.vectors[kDu]), c = length(t.vectors[kDv]);
    const double n = length(cross(t.vectors[kDu], t.vectors[kDv])) / (kSlack * kSlack);
    const double e = a * dv + c * du + du * dv + 4 * kU * (a + du) * (c + dv);
    return n > 0 && std::isfinite(e) ? (2 * e / n + 6 * kU) * kSlack : std::numeric_limits<double>::infinity();
  }

  void judge(const BatchSurface& surface, InstructionSet set, const Results& r, const std::string& prefix,
             const std::vector<double>& u, const std::vector<double>& v, const std::vector<SurfaceTruth>& truth) {
    for (std::size_t i = 0; i < r.items; ++i) {
      const kernels::PieceBounds& b = bounds(surface, u[i], v[i]);
      for (int k = 0; k < kVectors; ++k) {
        const bool is_normal = k == 6;
        if (is_normal && !truth[i].has_normal) continue;
        const ExactVector& exact = is_normal ? truth[i].normal : truth[i].vectors[k];
        const double bound = is_normal ? normal_bound(truth[i], b) : b.error[k];
        const Rational largest = largest_coordinate(exact);
        const std::string kernel = prefix + kNames[k];
        for (int c = 0; c < 3; ++c)
          Judge(tally(kernel, set), exact[c], largest)
              .number(perhaps_broken(options_, kernel, r.at(i, k, c)), bound, [&] { return place(u[i], v[i], c); });
      }
    }
  }

  void compare(InstructionSet set, const Results& a, const Results& b, int vectors, const char* what) {
    for (std::size_t i = 0; i < a.items; ++i)
      for (int k = 0; k < vectors; ++k)
        for (int c = 0; c < 3; ++c)
          same_bits(tally("same bits", set), a.at(i, k, c), perhaps_broken(options_, "same bits", b.at(i, k, c)),
                    [&] { return fmt::format("{}, item {}, {}.{}, {}", s_.name, i, kNames[k], "xyz"[c], what); });
  }

  void same_whatever_else(const BatchSurface& surface, InstructionSet set, const Results& scattered,
                          const Results& grid) {
    for (const bool on_grid : {false, true}) {
      const Results& all = on_grid ? grid : scattered;
      if (const auto points = evaluate(surface, set, Layout::separate, on_grid, false))
        compare(set, all, *points, 1, "points alone");
      if (const auto r = evaluate(surface, set, Layout::interleaved, on_grid, true))
        compare(set, all, *r, kVectors, "interleaved");
      if (const auto r = evaluate(surface, set, Layout::records, on_grid, true))
        compare(set, all, *r, kVectors, "records");
    }
    // The grid's items as scattered ones, many times over: long runs in one piece, and single ones.
    constexpr std::size_t kTimes = 3;
    SurfaceCase again = s_;
    again.u.clear();
    again.v.clear();
    Results expected;
    for (std::size_t i = 0; i < grid.items; ++i)
      for (std::size_t k = 0; k < (i % 4 == 0 ? 9 * kTimes : kTimes); ++k) {
        again.u.push_back(all_u_[i]);
        again.v.push_back(all_v_[i]);
        expected.numbers.insert(expected.numbers.end(), &grid.numbers[i * kVectors * 3],
                                &grid.numbers[i * kVectors * 3] + kVectors * 3);
      }
    expected.items = again.u.size();
    SurfaceCheck other(*this, again);
    if (const auto r = other.evaluate(surface, set, Layout::separate, false, true))
      compare(set, expected, *r, kVectors, "grid and scattered");
  }
  SurfaceCheck(const SurfaceCheck& o, const SurfaceCase& s)
      : s_(s), options_(o.options_), tallies_(o.tallies_), exact_(o.exact_) {}

  void enclosures(const BatchSurface& surface, InstructionSet set, const Results& plain) {
    const std::size_t n = s_.u.size();
    std::vector<double> p(3 * n), bound(n), lower(3 * n), upper(3 * n);
    const auto bounded =
        surface.evaluate_bounded(s_.u, s_.v, VectorArray::interleaved(p.data()), bound.data(), call_options(set));
    if (!bounded) refused("bounded", set, bounded.error());
    const auto interval = surface.evaluate_interval(s_.u, s_.v, VectorArray::interleaved(lower.data()),
                                                    VectorArray::interleaved(upper.data()), call_options(set));
    if (!interval) refused("interval", set, interval.error());
    for (std::size_t i = 0; i < n; ++i) {
      const ExactVector& exact = truth_[i].vectors[kPoint];
      const Rational largest = largest_coordinate(exact);
      for (int c = 0; c < 3; ++c) {
        const auto where = [&] { return place(s_.u[i], s_.v[i], c); };
        if (bounded) {
          Judge(tally("bounded", set), exact[c], largest)
              .number(perhaps_broken(options_, "bounded", p[3 * i + c]), bound[i], where);
          same_bits(tally("same bits", set), plain.at(i, 0, c), p[3 * i + c], where);
        }
        if (interval)
          Judge(tally("interval", set), exact[c], largest)
              .enclosure(perhaps_broken(options_, "interval", lower[3 * i + c]), upper[3 * i + c], where);
      }
    }
  }

  void accurate(const BatchSurface& surface, InstructionSet set) {
    const std::size_t n = s_.u.size();
    std::vector<double> rounded(3 * n), compensated(3 * n);
    const auto a =
        surface.evaluate_correctly_rounded(s_.u, s_.v, VectorArray::interleaved(rounded.data()), call_options(set));
    if (!a) refused("rounded", set, a.error());
    const auto b =
        surface.evaluate_compensated(s_.u, s_.v, VectorArray::interleaved(compensated.data()), call_options(set));
    if (!b) refused("compensated", set, b.error());
    for (std::size_t i = 0; i < n; ++i) {
      const ExactVector& exact = truth_[i].vectors[kPoint];
      const Rational largest = largest_coordinate(exact);
      for (int c = 0; c < 3; ++c) {
        const auto where = [&] { return place(s_.u[i], s_.v[i], c); };
        if (a)
          Judge(tally("rounded", set), exact[c], largest)
              .nearest(perhaps_broken(options_, "rounded", rounded[3 * i + c]), where);
        if (b)
          Judge(tally("compensated", set), exact[c], largest)
              .number(perhaps_broken(options_, "compensated", compensated[3 * i + c]),
                      compensated_bound(surface, exact[c], s_.u[i], s_.v[i], c), where);
      }
    }
  }

  // (1/2 + 2^-20) ulp, where the moduli of the terms of numerator and denominator certainly sum up to less than 2^30
  // times their values. Each sum is at most 2^(p + q) times the largest control value of the piece.
  double compensated_bound(const BatchSurface&, const Rational& exact, double u, double v, int c) const {
    const int span_u = knots_u_.find_span(u, s_.side), span_v = knots_v_.find_span(v, s_.side);
    double largest = 0, largest_weight = 0, smallest_weight = std::numeric_limits<double>::infinity();
    for (int i = span_u - s_.degree_u; i <= span_u; ++i)
      for (int j = span_v - s_.degree_v; j <= span_v; ++j) {
        const std::size_t k = static_cast<std::size_t>(i) * knots_v_.control_count() + j;
        const double w = s_.weights.empty() ? 1 : s_.weights[k];
        largest = std::max(largest, std::abs(w * s_.points[3 * k + c]) * kSlack);
        largest_weight = std::max(largest_weight, std::abs(w));
        smallest_weight = std::min(smallest_weight, w);
      }
    const double terms = std::ldexp(kSlack, s_.degree_u + s_.degree_v - 30);
    const double value = std::abs(nearest_double(exact)) / kSlack;
    const bool well = smallest_weight > 0 && terms * largest_weight <= smallest_weight && value > 0x1p-900 &&
                      terms * largest <= value * smallest_weight;
    return well ? nearest_double(ulp(exact)) * (0.5 + 0x1p-20) : std::numeric_limits<double>::infinity();
  }

  const SurfaceCase& s_;
  const CheckOptions& options_;
  Tallies& tallies_;
  BsplinePatch<Rational, 4> exact_;
  std::vector<SurfaceTruth> truth_, grid_truth_;
  std::vector<double> all_u_, all_v_;  // of the grid's items
  KnotVector<double> knots_u_ = KnotVector<double>::bezier(0), knots_v_ = KnotVector<double>::bezier(0);
};

}  // namespace

void check_surface(const SurfaceCase& given, const CheckOptions& options, Tallies& tallies) {
  SurfaceCase s = given;
  const Result<BatchSurface> surface = BatchSurface::make(given.data());
  if (surface && !s.weights.empty()) {
    const auto patch = exact_patch(given.data());
    const auto negligible = [&](double u, double v) {
      return is_negligible(evaluate(patch, from_double(u), from_double(v), s.side, s.side), s.weights,
                           s.degree_u + s.degree_v);
    };
    for (const InstructionSet set : options.sets) {
      SurfaceBatchOptions call;
      call.side_u = call.side_v = s.side;
      call.instructions = set;
      std::vector<double> room(3 * std::max(s.u.size(), s.grid_u.size() * s.grid_v.size()));
      SurfaceOutput to;
      to.point = VectorArray::interleaved(room.data());
      drop_vanishing([&] { return surface->evaluate(s.u, s.v, to, call); },
                     [&](std::size_t i) { return negligible(s.u[i], s.v[i]); },
                     [&](std::size_t i) {
                       s.u.erase(s.u.begin() + static_cast<std::ptrdiff_t>(i));
                       s.v.erase(s.v.begin() + static_cast<std::ptrdiff_t>(i));
                     });
      const auto columns = s.grid_v.size();
      drop_vanishing(
          [&] { return surface->evaluate_grid(s.grid_u, s.grid_v, to, call); },
          [&](std::size_t i) { return negligible(s.grid_u[i / columns], s.grid_v[i % columns]); },
          [&](std::size_t i) { s.grid_u.erase(s.grid_u.begin() + static_cast<std::ptrdiff_t>(i / columns)); });
    }
  }
  SurfaceCheck(s, options, tallies).run();
}

}  // namespace patchproof::validation
