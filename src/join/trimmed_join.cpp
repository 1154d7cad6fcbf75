// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/trimmed_join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "patchproof/patch/affine.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/taylor_model.h"

namespace patchproof {
namespace {

constexpr int kOrder = 7;
using Model = TaylorModel<kOrder>;
using Surface = BsplinePatch<Interval, 4, Rational>;
using ParameterCurve = BsplineCurve<Rational, 3>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A part of the range of t, and what is known there.
struct Piece {
  Rational begin, end;
  int depth = 0;
  std::vector<DeviationPiece> gap, angle;  // one for each combination of polynomials that may be meant
};

// One side, with its surface moved so that coordinates are as small as the edge allows.
struct Side {
  Surface surface;
  const ParameterCurve* curve;
  bool flipped, polynomial;
};

bool has_unit_weights(const ParameterCurve& curve) {
  return std::all_of(curve.points().begin(), curve.points().end(), [](const auto& p) { return p[2] == Rational(1); });
}

Surface enclosed(const BsplinePatch<Rational, 4>& patch) {
  std::vector<Vec<Interval, 4>> net;
  for (const auto& p : patch.net()) net.push_back({{enclose(p[0]), enclose(p[1]), enclose(p[2]), enclose(p[3])}});
  return {patch.knots(Direction::u), patch.knots(Direction::v), std::move(net)};
}

// The spans of the knots that a parameter in [x.inf, x.sup] may lie in; the outermost ones reach to infinity.
std::vector<int> spans_meeting(const KnotVector<Rational>& knots, const Interval& x) {
  const auto clamped = [&](double value) {
    const Rational r = from_double(value);
    return r < knots.domain_begin() ? knots.domain_begin() : r > knots.domain_end() ? knots.domain_end() : r;
  };
  const int first = knots.find_span(clamped(x.inf()), patchproof::Side::left),
            last = knots.find_span(clamped(x.sup()), patchproof::Side::right);
  std::vector<int> out;
  for (int span = first; span <= last; ++span)
    if (knots[span] < knots[span + 1]) out.push_back(span);
  return out;
}

// Where a side runs on a part of the edge: models of u and v, and the spans that they meet.
struct Run {
  Model u, v;
  std::vector<int> spans_u, spans_v;
  std::size_t combinations() const { return spans_u.size() * spans_v.size(); }
};

Run run_of(const Side& side, const Model& t, const Rational& inside) {
  const int span = side.curve->knots().find_span(inside);
  const Vec<Model, 3> h = evaluate_in_span<Model>(*side.curve, span, t);
  Run run;
  run.u = side.polynomial ? h[0] : h[0] / h[2];
  run.v = side.polynomial ? h[1] : h[1] / h[2];
  const Interval u = run.u.bernstein_range(), v = run.v.bernstein_range();
  if (!std::isfinite(u.inf()) || !std::isfinite(u.sup()) || !std::isfinite(v.inf()) || !std::isfinite(v.sup()))
    return run;
  run.spans_u = spans_meeting(side.surface.knots(Direction::u), u);
  run.spans_v = spans_meeting(side.surface.knots(Direction::v), v);
  return run;
}

// A homogeneous point and w⁴ times the face's normal.
struct Frame {
  Vec<Model, 4> point;
  Vec<Model, 3> normal;
};
std::vector<Frame> frames(const Side& side, const Run& run) {
  std::vector<Frame> out;
  for (const int i : run.spans_u)
    for (const int j : run.spans_v) {
      const auto d = partial_derivatives_in_span<Model>(side.surface, i, j, run.u, run.v, 1, 1);
      const Vec<Model, 3> n = scaled_normal(d.at(0, 0), d.at(1, 0), d.at(0, 1));
      out.push_back({d.at(0, 0), side.flipped ? -n : n});
    }
  return out;
}

// Bernstein coefficients on [−1, 1], the remainder in each.
DeviationPiece to_piece(const Vec<Model, 3>& numerator, const Model& denominator) {
  const Model* const models[4] = {&numerator[0], &numerator[1], &numerator[2], &denominator};
  DeviationPiece piece;
  piece.coefficients.resize(kOrder + 1);
  for (int k = 0; k < 4; ++k) {
    const auto b = models[k]->bernstein_coefficients();
    for (int i = 0; i <= kOrder; ++i) piece.coefficients[i][k] = b[i];
  }
  for (auto& c : piece.coefficients) c[4] = Interval(1);
  return piece;
}

class Bounder {
 public:
  Bounder(const TrimmedJoin& join, const Budget& budget) : budget_(budget) {
    const KnotVector<Rational>& range = join.a.parameters.knots();
    begin_ = range.domain_begin();
    end_ = range.domain_end();
    // Coordinates relative to a point of the edge: what all points share is not rounded again and again.
    const Rational middle = (begin_ + end_) / Rational(2);
    const Vec<Rational, 2> at = evaluate_rational(join.a.parameters, middle);
    const auto inside = [](const KnotVector<Rational>& k, const Rational& x) {
      return x < k.domain_begin() ? k.domain_begin() : x > k.domain_end() ? k.domain_end() : x;
    };
    const Vec<Rational, 3> origin =
        evaluate_rational(*join.a.surface, inside(join.a.surface->knots(Direction::u), at[0]),
                          inside(join.a.surface->knots(Direction::v), at[1]));
    const AffineMap<Rational> move = translation(-origin);
    for (const TrimmedSide* side : {&join.a, &join.b})
      sides_.push_back({enclosed(apply(move, *side->surface)), &side->parameters, side->flipped,
                        has_unit_weights(side->parameters)});
    collect(join);
  }

  TrimmedBounds bounds() {
    TrimmedBounds out;
    out.gap = bound(Deviation::gap);
    out.angle = bound(Deviation::angle);
    out.plane_angle = bound(Deviation::plane_angle);
    for (const Piece& piece : pieces_)
      for (const Side& side : sides_)
        for (const Rational& t : {piece.begin, piece.end}) {
          const Vec<Rational, 2> at = evaluate_rational(*side.curve, t);
          for (const Direction d : {Direction::u, Direction::v}) {
            const KnotVector<Rational>& k = side.surface.knots(d);
            const Rational& x = at[d == Direction::u ? 0 : 1];
            out.outside = std::max({out.outside, nearest_double(Rational(k.domain_begin() - x)),
                                    nearest_double(Rational(x - k.domain_end()))});
          }
        }
    return out;
  }

 private:
  void collect(const TrimmedJoin& join) {
    std::vector<Rational> all = join.a.parameters.knots().breaks();
    const std::vector<Rational> more = join.b.parameters.knots().breaks();
    all.insert(all.end(), more.begin(), more.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (std::size_t i = 0; i + 1 < all.size(); ++i) add(all[i], all[i + 1], 0, pieces_);
  }

  // The pieces of [begin, end]: halved at knot lines until a piece lies between them, or is too short to tell.
  void add(const Rational& begin, const Rational& end, int depth, std::vector<Piece>& out) {
    constexpr int kDepth = 40;
    constexpr double kNarrow = 0x1p-40;  // of the range of the parameters
    const Rational middle = (begin + end) / Rational(2);
    const Model t = Model::variable(enclose(middle), enclose(Rational((end - begin) / Rational(2))));
    Run runs[2];
    bool ambiguous = false, worth_halving = false;
    for (int s = 0; s < 2; ++s) {
      runs[s] = run_of(sides_[s], t, middle);
      if (runs[s].combinations() == 1) continue;
      ambiguous = true;
      const auto is_wide = [&](const Model& x, Direction d) {
        const KnotVector<Rational>& k = sides_[s].surface.knots(d);
        const Interval r = x.bernstein_range();
        return r.sup() - r.inf() > kNarrow * nearest_double(Rational(k.domain_end() - k.domain_begin()));
      };
      worth_halving = worth_halving || runs[s].combinations() == 0 ||
                      (runs[s].spans_u.size() > 1 && is_wide(runs[s].u, Direction::u)) ||
                      (runs[s].spans_v.size() > 1 && is_wide(runs[s].v, Direction::v));
    }
    const int limit = pieces_made_ > budget_.nodes ? depth : kDepth;
    if (ambiguous && worth_halving && depth < limit) {
      add(begin, middle, depth + 1, out);
      add(middle, end, depth + 1, out);
      return;
    }
    ++pieces_made_;
    Piece piece{begin, end, depth, {}, {}};
    for (const Frame& a : frames(sides_[0], runs[0]))
      for (const Frame& b : frames(sides_[1], runs[1])) {
        Vec<Model, 3> difference;
        for (int c = 0; c < 3; ++c) difference[c] = a.point[c] * b.point[3] - b.point[c] * a.point[3];
        piece.gap.push_back(to_piece(difference, a.point[3] * b.point[3]));
        piece.angle.push_back(to_piece(cross(a.normal, b.normal), dot(a.normal, b.normal)));
        for (int c = 0; c < 3; ++c)
          for (const Interval& x : {a.point[c].bernstein_range()}) size_ = std::max({size_, x.sup(), -x.inf()});
      }
    out.push_back(std::move(piece));
  }

  struct Node {
    double upper;
    Piece piece;
    bool operator<(const Node& o) const { return upper != o.upper ? upper < o.upper : piece.begin > o.piece.begin; }
  };

  TrimmedBound bound(Deviation what) {
    constexpr int kMaxDepth = 45;
    const double worst = what == Deviation::gap ? kInfinity : what == Deviation::angle ? 180 : 90;
    const double floor = what == Deviation::gap ? std::ldexp(size_, -40) : 0x1p-34;  // degrees: 6e-11
    TrimmedBound out{0, 0, begin_, true};
    std::priority_queue<Node> queue;
    double settled = 0;  // of pieces that are not halved again
    Budget one = budget_;
    one.nodes = 64;
    const auto push = [&](Piece piece) {
      const auto& forms = what == Deviation::gap ? piece.gap : piece.angle;
      double upper = forms.empty() ? worst : 0, lower = forms.empty() ? 0 : kInfinity, at = 0;
      for (const DeviationPiece& form : forms) {
        const DeviationBound b = bound_deviation({form}, what, one);
        upper = std::max(upper, b.upper);
        if (b.lower < lower) lower = b.lower, at = b.t;
      }
      // With several polynomials in question the smallest lower bound holds only if they share the witness.
      if (forms.size() == 1 && lower > out.lower) {
        out.lower = lower;
        out.t = piece.begin + (piece.end - piece.begin) * from_double(at);
      }
      if (piece.depth >= kMaxDepth || upper <= out.lower || forms.size() > 1)
        settled = std::max(settled, upper);
      else
        queue.push({upper, std::move(piece)});
    };
    for (const Piece& piece : pieces_) push(piece);
    const auto is_tight = [&](double upper) {
      return upper <= floor || (upper < kInfinity && upper - out.lower <= std::ldexp(upper, -budget_.tight_bits));
    };
    int halvings = 0;
    while (!queue.empty() && !is_tight(queue.top().upper) && queue.top().upper > settled) {
      if (++halvings > budget_.nodes || std::chrono::steady_clock::now() > budget_.deadline) break;
      const Piece piece = queue.top().piece;
      queue.pop();
      const Rational middle = (piece.begin + piece.end) / Rational(2);
      std::vector<Piece> halves;
      add(piece.begin, middle, piece.depth + 1, halves);
      add(middle, piece.end, piece.depth + 1, halves);
      for (Piece& half : halves) push(std::move(half));
    }
    out.upper = std::max({out.lower, settled, queue.empty() ? 0 : queue.top().upper});
    out.converged = out.upper <= floor || (out.upper < kInfinity && out.upper - out.lower <= out.upper / 100);
    return out;
  }

  const Budget budget_;
  std::vector<Side> sides_;
  Rational begin_, end_;
  std::vector<Piece> pieces_;
  double size_ = 0;
  int pieces_made_ = 0;
};

// The line that a side runs along, and its parameter along it at both ends of the edge.
struct StraightSide {
  IsoLine<Rational> line;
  Rational begin, end;
};

// A polynomial curve that is constant in one parameter and linear in the other: control points that are linear in the
// averages of degree successive knots.
std::optional<StraightSide> straight_side(const TrimmedSide& side) {
  const ParameterCurve& curve = side.parameters;
  const KnotVector<Rational>& knots = curve.knots();
  const int p = curve.degree(), n = knots.control_count();
  if (!has_unit_weights(curve) || !knots.is_clamped()) return std::nullopt;
  for (const Direction constant : {Direction::u, Direction::v}) {
    const int fixed = constant == Direction::u ? 0 : 1, running = 1 - fixed;
    const Rational& value = curve.points()[0][fixed];
    const Rational &begin = curve.points().front()[running], &end = curve.points().back()[running];
    const KnotVector<Rational>&across = side.surface->knots(constant), &along = side.surface->knots(other(constant));
    if (!across.in_domain(value) || !along.in_domain(begin) || !along.in_domain(end) || begin == end) continue;
    bool straight = true;
    for (int i = 0; i < n && straight; ++i) {
      Rational average(0);
      for (int j = 1; j <= p; ++j) average += knots[i + j];
      average /= Rational(p);
      const Rational linear =
          begin + (end - begin) * (average - knots.domain_begin()) / (knots.domain_end() - knots.domain_begin());
      straight = curve.points()[i][fixed] == value && curve.points()[i][running] == linear;
    }
    // Inside a smooth surface both sides of the line say the same; at an edge only one exists.
    const patchproof::Side from = value == across.domain_begin() ? patchproof::Side::right : patchproof::Side::left;
    if (straight) return StraightSide{{constant, value, from}, begin, end};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Join<Rational>> to_isoparametric(const TrimmedJoin& join) {
  const auto a = straight_side(join.a), b = straight_side(join.b);
  if (!a || !b) return std::nullopt;
  // Inside a surface the face may lie on either side of the line, and there the exact classes would not know which.
  for (const auto& [side, straight] : {std::pair(&join.a, &*a), std::pair(&join.b, &*b)}) {
    const KnotVector<Rational>& across = side->surface->knots(straight->line.constant);
    if (straight->line.value != across.domain_begin() && straight->line.value != across.domain_end())
      return std::nullopt;
  }
  Join<Rational> out;
  out.line_a = a->line;
  out.line_b = b->line;
  out.pairing.a = {a->begin, a->end};
  out.pairing.b = {b->begin, b->end};
  if (a->end < a->begin) {
    std::swap(out.pairing.a[0], out.pairing.a[1]);
    std::swap(out.pairing.b[0], out.pairing.b[1]);
  }
  const Rational speed = (b->end - b->begin) / (a->end - a->begin);
  out.pairing.kind = speed == Rational(1) || speed == Rational(-1) ? PairingKind::identity : PairingKind::affine;
  return out;
}

TrimmedBounds bound_trimmed(const TrimmedJoin& join, const Budget& budget) {
  PATCHPROOF_REQUIRES(join.a.parameters.knots().domain_begin() == join.b.parameters.knots().domain_begin() &&
                          join.a.parameters.knots().domain_end() == join.b.parameters.knots().domain_end(),
                      "bound_trimmed: the parameter curves have different ranges");
  return Bounder(join, budget).bounds();
}

}  // namespace patchproof
