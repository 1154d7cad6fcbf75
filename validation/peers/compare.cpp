// SPDX-License-Identifier: Apache-2.0
#include "validation/peers/compare.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace patchproof::peers {
namespace {

using validation::CurveTruth;
using validation::ExactVector;
using validation::KnownCurve;
using validation::KnownSurface;
using validation::SurfaceTruth;

// An array of doubles at a multiple of 64 bytes, filled with NaN: what a peer forgets to write is seen.
class Room {
 public:
  explicit Room(std::size_t doubles) : storage_(doubles + 8, std::numeric_limits<double>::quiet_NaN()) {
    const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
    span_ = {storage_.data() + (64 - address % 64) % 64 / sizeof(double), doubles};
  }
  std::span<double> span() { return span_; }

 private:
  std::vector<double> storage_;
  std::span<double> span_;
};

// How often derivatives may be taken at t from either side with the same result.
int smoothness(int degree, std::span<const double> knots, double t) {
  if (t <= knots[degree] || knots[knots.size() - 1 - degree] <= t) return degree + 1;
  const auto range = std::equal_range(knots.begin(), knots.end(), t);
  return range.first == range.second ? degree + 1 : degree - static_cast<int>(range.second - range.first);
}

// The vectors that a quantity adds: {index in the record, index in SurfaceTruth::vectors, orders of u and v}.
struct Added {
  int record, truth, order_u, order_v;
};
std::vector<Added> added(Quantities q) {
  using namespace validation;
  switch (q) {
    case Quantities::points: return {{0, kPoint, 0, 0}};
    case Quantities::first: return {{1, kDu, 1, 0}, {2, kDv, 0, 1}};
    case Quantities::normals: return {{3, -1, 1, 1}};
    case Quantities::second: return {{3, kDuu, 2, 0}, {4, kDuv, 1, 1}, {5, kDvv, 0, 2}};
  }
  return {};
}

void add_surface_item(Score& score, Quantities q, const KnownSurface& s, const Placed& placed, std::ptrdiff_t item,
                      double u, double v, const SurfaceTruth& truth) {
  const int smooth_u = smoothness(s.data.degree_u, s.data.knots_u, u),
            smooth_v = smoothness(s.data.degree_v, s.data.knots_v, v);
  for (const Added& a : added(q)) {
    if (a.order_u > smooth_u || a.order_v > smooth_v) continue;
    if (a.truth < 0 && !truth.has_normal) continue;
    add_vector(score, placed, item, a.record, a.truth < 0 ? truth.normal : truth.vectors[a.truth]);
  }
}

CaseScores score_surface(const Peer& peer, int variant, const KnownSurface& s, Arrangement arrangement) {
  CaseScores out;
  const std::unique_ptr<PreparedSurface> prepared = peer.prepare(s.data.data(), variant);
  if (!prepared) {
    out.refused = 1;
    return out;
  }
  const bool grid = arrangement == Arrangement::grid;
  const auto &u = grid ? s.data.grid_u : s.data.u, &v = grid ? s.data.grid_v : s.data.v;
  for (std::size_t q = 0; q < kAllQuantities.size(); ++q) {
    Room room(18 * (grid ? s.grid.size() : s.scattered.size()));
    const std::optional<Placed> placed = grid ? prepared->evaluate_grid(u, v, kAllQuantities[q], room.span())
                                              : prepared->evaluate(u, v, kAllQuantities[q], room.span());
    if (!placed) continue;
    Score& score = out.by_quantity[q];
    ++score.offered;
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (!grid) {
        add_surface_item(score, kAllQuantities[q], s, *placed, i, u[i], v[i], s.scattered[i]);
        continue;
      }
      for (std::size_t j = 0; j < v.size(); ++j)
        add_surface_item(score, kAllQuantities[q], s, *placed, placed->u_fastest ? j * u.size() + i : i * v.size() + j,
                         u[i], v[j], s.grid[i * v.size() + j]);
    }
  }
  return out;
}

CaseScores score_curve(const Peer& peer, int variant, const KnownCurve& c) {
  CaseScores out;
  const std::unique_ptr<PreparedCurve> prepared = peer.prepare(c.data.data(), variant);
  if (!prepared) {
    out.refused = 1;
    return out;
  }
  for (std::size_t q = 0; q < kAllQuantities.size(); ++q) {
    const int vectors = curve_vectors(kAllQuantities[q]);
    if (vectors == 0) continue;
    Room room(9 * c.values.size());
    const std::optional<Placed> placed = prepared->evaluate(c.data.t, false, kAllQuantities[q], room.span());
    if (!placed) continue;
    ++out.by_quantity[q].offered;
    for (std::size_t i = 0; i < c.values.size(); ++i)
      if (vectors - 1 <= smoothness(c.data.degree, c.data.knots, c.data.t[i]))
        add_vector(out.by_quantity[q], *placed, i, vectors - 1, c.values[i][vectors - 1]);
  }
  return out;
}

enum class Ending { well, crashed, timed_out };

// Runs `job` in a child process and brings its scores back.
Ending in_child(const std::function<CaseScores()>& job, unsigned seconds, CaseScores& scores) {
  int ends[2];
  if (pipe(ends) != 0) return Ending::crashed;
  const pid_t child = fork();
  if (child == 0) {
    alarm(seconds);
    std::fclose(stdout);  // some peers print; the table is ours
    std::fclose(stderr);
    const CaseScores done = job();
    const bool written = write(ends[1], &done, sizeof done) == static_cast<ssize_t>(sizeof done);
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  const bool read_whole = child > 0 && read(ends[0], &scores, sizeof scores) == static_cast<ssize_t>(sizeof scores);
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  if (read_whole && WIFEXITED(status) && WEXITSTATUS(status) == 0) return Ending::well;
  scores = {};
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? Ending::timed_out : Ending::crashed;
}

// The whole group in one process; if that does not end well, each of its cases in its own.
CaseScores score_cases(std::size_t count, const std::function<CaseScores(std::size_t)>& one, unsigned seconds) {
  CaseScores together;
  const auto all = [&] {
    CaseScores sum;
    for (std::size_t k = 0; k < count; ++k) sum = sum + one(k);
    return sum;
  };
  if (in_child(all, seconds, together) == Ending::well) return together;
  CaseScores sum;
  for (std::size_t k = 0; k < count; ++k) {
    CaseScores scores;
    const Ending ending = in_child([&] { return one(k); }, seconds, scores);
    sum = sum + scores;
    sum.crashed += ending == Ending::crashed;
    sum.timed_out += ending == Ending::timed_out;
  }
  return sum;
}

}  // namespace

const char* to_string(Arrangement a) {
  return a == Arrangement::scattered ? "scattered" : a == Arrangement::grid ? "grid" : "curve";
}

const char* to_string(Quantities q) {
  switch (q) {
    case Quantities::points: return "points";
    case Quantities::first: return "first";
    case Quantities::normals: return "normals";
    case Quantities::second: return "second";
  }
  return "";
}

void add_vector(Score& score, const Placed& placed, std::ptrdiff_t item, int vector, const ExactVector& exact) {
  const Rational largest = validation::largest_coordinate(exact);
  if (largest == Rational(0) || validation::overflows(largest)) return;
  ++score.vectors;
  for (int c = 0; c < 3; ++c)
    score.worst = std::max(score.worst,
                           validation::in_ulps(validation::deviation(placed.at(item, vector, c), exact[c]), largest));
}

void add_vectors(Score& score, Quantities q, const Placed& placed, std::ptrdiff_t item, const SurfaceTruth& exact) {
  for (const Added& a : added(q))
    if (a.truth >= 0 || exact.has_normal)
      add_vector(score, placed, item, a.record, a.truth < 0 ? exact.normal : exact.vectors[a.truth]);
}

CaseScores operator+(const CaseScores& a, const CaseScores& b) {
  CaseScores out = a;
  for (std::size_t q = 0; q < out.by_quantity.size(); ++q) {
    out.by_quantity[q].vectors += b.by_quantity[q].vectors;
    out.by_quantity[q].worst = std::max(a.by_quantity[q].worst, b.by_quantity[q].worst);
    out.by_quantity[q].offered += b.by_quantity[q].offered;
  }
  out.refused += b.refused;
  out.crashed += b.crashed;
  out.timed_out += b.timed_out;
  return out;
}

std::vector<Row> compare(const Peer& peer, const Known& known, unsigned seconds) {
  std::vector<Row> rows;
  const std::vector<std::string> variants = peer.variants();
  for (int v = 0; v < static_cast<int>(variants.size()); ++v)
    for (const validation::Group& g : validation::groups()) {
      std::vector<const KnownSurface*> surfaces;
      for (const KnownSurface& s : known.surfaces)
        if (s.data.group == g.name) surfaces.push_back(&s);
      std::vector<const KnownCurve*> curves;
      for (const KnownCurve& c : known.curves)
        if (c.data.group == g.name) curves.push_back(&c);
      for (const Arrangement a : {Arrangement::scattered, Arrangement::grid, Arrangement::curve}) {
        const bool curve = a == Arrangement::curve;
        const auto one = [&](std::size_t k) {
          return curve ? score_curve(peer, v, *curves[k]) : score_surface(peer, v, *surfaces[k], a);
        };
        const std::size_t count = curve ? curves.size() : surfaces.size();
        rows.push_back(
            {peer.name(), variants[v], g.name, a, static_cast<int>(count), score_cases(count, one, seconds)});
      }
    }
  return rows;
}

}  // namespace patchproof::peers
