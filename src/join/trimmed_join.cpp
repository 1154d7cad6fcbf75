// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/trimmed_join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "patchproof/patch/affine.h"
#include "trimmed_side.h"

namespace patchproof {
namespace {

using namespace trimmed;

// A part of the range of t, and what is known there.
struct Piece {
  Rational begin, end;
  int depth = 0;
  std::vector<DeviationPiece> gap, angle;  // one for each combination of polynomials that may be meant
  bool left_out = false;                   // of the angles: beside a pole that rounding hides
};

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
    const Rational middle = (begin_ + end_) / Rational(2);
    const AffineMap<Rational> move = translation(-origin_near(join.a, middle));
    for (int s = 0; s < 2; ++s)
      for (const bool end : {false, true})
        poles_[s][end] = pole_at(s == 0 ? join.a : join.b, end ? end_ : begin_, middle);
    const Rational beside = (end_ - begin_) * from_double(kBesidePole);
    first_ = is_hidden(0) ? Rational(begin_ + beside) : begin_;
    last_ = is_hidden(1) ? Rational(end_ - beside) : end_;
    for (const TrimmedSide* side : {&join.a, &join.b}) sides_.emplace_back(*side, move);
    const DeadlineScope most(share_of_time(3, 2));  // the rest is for looking at the pieces
    collect(join);
  }

  TrimmedBounds bounds() {
    TrimmedBounds out;
    out.gap = bound(Deviation::gap, 3);
    out.angle = bound(Deviation::angle, 2);
    out.plane_angle = bound(Deviation::plane_angle, 1);
    for (int s = 0; s < 2; ++s)
      for (const bool end : {false, true})
        if (poles_[s][end].is_one)
          out.poles.push_back({s == 0 ? 'a' : 'b', end ? last_ : begin_, end ? end_ : first_, is_hidden(end)});
    for (const Piece& piece : pieces_) {
      if (has_deadline_passed()) break;
      for (const MovedSide& side : sides_)
        out.outside = std::max({out.outside, outside(side, piece.begin), outside(side, piece.end)});
    }
    return out;
  }

 private:
  static constexpr int kDepth = 40;  // that of slivers; pieces are not halved any more

  static constexpr double kBesidePole = 0x1p-24;  // of the edge

  // A pole where rounding has left a normal: at its end that points anywhere, and a little beside it as the surface does.
  bool is_hidden(bool end) const {
    return std::any_of(std::begin(poles_), std::end(poles_),
                       [&](const Pole(&side)[2]) { return side[end].is_one && !side[end].zero; });
  }

  using Clock = DeadlineScope::Clock;
  // When so many of so many parts of the time that is left are over.
  Clock::time_point share_of_time(int all, int some = 1) const {
    if (budget_.deadline == Clock::time_point::max()) return budget_.deadline;
    const Clock::time_point now = Clock::now();
    return now + (budget_.deadline - now) / all * some;
  }

  // How far a parameter curve leaves its surface's domain at t, at least; exactly where it certainly does.
  static double outside(const MovedSide& side, const Rational& t) {
    const int span = side.curve->knots().find_span(t);
    const Vec<Interval, 3> h = evaluate_in_span<Interval>(*side.curve, span, enclose(t));
    double out = 0;
    for (const Direction d : {Direction::u, Direction::v}) {
      const KnotVector<Rational>& k = side.surface.knots(d);
      const int i = d == Direction::u ? 0 : 1;
      const Interval x = h[i] / h[2];
      if (!(x.inf() > enclose(k.domain_end()).sup()) && !(x.sup() < enclose(k.domain_begin()).inf())) continue;
      const Rational exact = evaluate_rational(*side.curve, t)[i];
      out = std::max(
          {out, nearest_double(Rational(k.domain_begin() - exact)), nearest_double(Rational(exact - k.domain_end()))});
    }
    return out;
  }

  void collect(const TrimmedJoin& join) {
    std::vector<Rational> all = join.a.parameters.knots().breaks();
    const std::vector<Rational> more = join.b.parameters.knots().breaks();
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {first_, last_});
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    allowed_ = budget_.nodes + 4 * static_cast<int>(all.size());
    for (std::size_t i = 0; i + 1 < all.size(); ++i) add(all[i], all[i + 1], 0, pieces_);
  }

  // The pieces of [begin, end]: halved at knot lines until a piece lies between them, or is too short to tell. Nothing is
  // known of those that there is no time for.
  void add(const Rational& begin, const Rational& end, int depth, std::vector<Piece>& out) {
    try {
      check_deadline();
      add_pieces(begin, end, depth, out);
    } catch (const deadline_passed&) {
      out.push_back({begin, end, kDepth, {}, {}, end <= first_ || begin >= last_});
    }
  }
  void add_pieces(const Rational& begin, const Rational& end, int depth, std::vector<Piece>& out) {
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
    const bool left_out = end <= first_ || begin >= last_;
    const bool at_begin = !left_out && begin == begin_ && (poles_[0][0].is_one || poles_[1][0].is_one);
    const bool at_end = !left_out && end == end_ && (poles_[0][1].is_one || poles_[1][1].is_one);
    if (at_begin && at_end) ambiguous = worth_halving = true;
    const int limit = pieces_made_ > allowed_ ? depth : kDepth;
    if (ambiguous && worth_halving && depth < limit) {
      // A knot line that is crossed leaves a sliver about the crossing in which both polynomials are taken.
      if (const auto crossing = crossing_of(runs, begin, end)) {
        const Rational sliver = (end_ - begin_) * from_double(kNarrow);
        const Rational before = *crossing - sliver, after = *crossing + sliver;
        if (begin < before) add(begin, before, depth + 1, out);
        add(std::max(begin, before), std::min(after, end), kDepth, out);
        if (after < end) add(after, end, depth + 1, out);
        return;
      }
      add(begin, middle, depth + 1, out);
      add(middle, end, depth + 1, out);
      return;
    }
    ++pieces_made_;
    Piece piece{begin, end, depth, {}, {}, left_out};
    const bool pole = at_begin || at_end;
    const std::vector<Frame> all_a = frames(sides_[0], runs[0]), all_b = frames(sides_[1], runs[1]);
    for (const Frame& a : all_a) {
      check_deadline();
      for (const Frame& b : all_b) {
        Vec<Model, 3> difference;
        for (int c = 0; c < 3; ++c) difference[c] = a.point[c] * b.point[3] - b.point[c] * a.point[3];
        piece.gap.push_back(to_piece(difference, a.point[3] * b.point[3]));
        if (!pole) piece.angle.push_back(to_piece(cross(a.normal, b.normal), dot(a.normal, b.normal)));
        for (int c = 0; c < 3; ++c)
          for (const Interval& x : {a.point[c].bernstein_range()}) size_ = std::max({size_, x.sup(), -x.inf()});
      }
    }
    if (pole) piece.angle = at_pole(runs, t, middle, at_end);
    out.push_back(std::move(piece));
  }

  // About where a parameter curve crosses a knot line between begin and end, found by bisection in double. Nothing depends
  // on it but where pieces end.
  std::optional<Rational> crossing_of(const Run (&runs)[2], const Rational& begin, const Rational& end) const {
    for (int s = 0; s < 2; ++s)
      for (const Direction d : {Direction::u, Direction::v}) {
        const std::vector<int>& spans = d == Direction::u ? runs[s].spans_u : runs[s].spans_v;
        if (spans.size() < 2) continue;
        const double knot = nearest_double(sides_[s].surface.knots(d)[spans[spans.size() / 2]]);
        const int span = sides_[s].curve->knots().find_span((begin + end) / Rational(2));
        const auto beyond = [&](double t) {
          const Vec<double, 3> h = evaluate_in_span<double>(*sides_[s].curve, span, t);
          return h[d == Direction::u ? 0 : 1] - knot * h[2];
        };
        double low = nearest_double(begin), high = nearest_double(end);
        const bool rising = beyond(low) < 0;
        if (!(low < high) || rising == (beyond(high) < 0)) continue;
        for (int i = 0; i < 60; ++i) {
          const double between = low + (high - low) / 2;
          if (!(low < between && between < high)) break;
          ((beyond(between) < 0) == rising ? low : high) = between;
        }
        const Rational found = from_double(low);
        if (begin <= found && found <= end) return found;
      }
    return std::nullopt;
  }

  // Each normal anywhere in its own enclosure: one coefficient.
  std::vector<DeviationPiece> at_pole(const Run (&runs)[2], const Model& t, const Rational& inside, bool at_end) const {
    std::vector<Vec<Interval, 3>> normals[2];
    for (int s = 0; s < 2; ++s) {
      if (poles_[s][at_end].is_one) {
        normals[s] = normal_rates(sides_[s], runs[s], t, inside, at_end);
        continue;
      }
      for (const Frame& frame : frames(sides_[s], runs[s]))
        normals[s].push_back({{frame.normal[0].bernstein_range(), frame.normal[1].bernstein_range(),
                               frame.normal[2].bernstein_range()}});
    }
    std::vector<DeviationPiece> out;
    for (const auto& a : normals[0])
      for (const auto& b : normals[1]) {
        const Vec<Interval, 3> c = cross(a, b);
        out.push_back({{{c[0], c[1], c[2], dot(a, b), Interval(1)}}});
      }
    return out;
  }

  struct Node {
    double upper;
    Piece piece;
    bool operator<(const Node& o) const { return upper != o.upper ? upper < o.upper : piece.begin > o.piece.begin; }
  };

  // Of the time that is left, one of so many shares.
  TrimmedBound bound(Deviation what, int shares) {
    const DeadlineScope share(share_of_time(shares));
    const double worst = what == Deviation::gap ? kInfinity : what == Deviation::angle ? 180 : 90;
    const double floor = what == Deviation::gap ? std::ldexp(size_, -36) : 0x1p-34;  // degrees: 6e-11
    TrimmedBound out{0, 0, begin_, true};
    std::priority_queue<Node> queue;
    double settled = 0;  // of pieces that are not halved again
    Budget one = budget_;
    one.nodes = 64;
    const auto push = [&](Piece piece) {
      if (piece.left_out && what != Deviation::gap) return;
      if (Clock::now() > budget_.deadline) {  // even looking at a thousand pieces takes time
        settled = worst;
        return;
      }
      const auto& forms = what == Deviation::gap ? piece.gap : piece.angle;
      double upper = forms.empty() ? worst : 0, lower = forms.empty() ? 0 : kInfinity, at = 0;
      for (const DeviationPiece& form : forms) {
        const DeviationBound b = bound_deviation({form}, what, one);
        upper = std::max(upper, b.upper);
        // Of several polynomials that may be meant, all must be as far apart at one and the same place: the begin.
        const DeviationBound at_begin =
            forms.size() == 1 ? b : bound_deviation({{{form.coefficients.front()}}}, what, one);
        if (at_begin.lower < lower) lower = at_begin.lower, at = forms.size() == 1 ? b.t : 0;
      }
      if (!forms.empty() && lower > out.lower) {
        out.lower = lower;
        out.t = piece.begin + (piece.end - piece.begin) * from_double(at);
      }
      if (piece.depth >= kDepth || upper <= out.lower)
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
      if (++halvings > allowed_) break;
      const Piece& piece = queue.top().piece;
      const Rational middle = (piece.begin + piece.end) / Rational(2);
      std::vector<Piece> halves;
      add(piece.begin, middle, piece.depth + 1, halves);
      add(middle, piece.end, piece.depth + 1, halves);
      if (has_deadline_passed()) break;  // the whole is known better than halves without time
      queue.pop();
      for (Piece& half : halves) push(std::move(half));
    }
    out.upper = std::max({out.lower, settled, queue.empty() ? 0 : queue.top().upper});
    out.converged = out.upper <= floor || (out.upper < kInfinity && out.upper - out.lower <= out.upper / 100);
    return out;
  }

  const Budget budget_;
  std::vector<MovedSide> sides_;
  Rational begin_, end_;
  std::vector<Piece> pieces_;
  Pole poles_[2][2];       // side, end
  Rational first_, last_;  // between these the angles are bounded
  double size_ = 0;
  int allowed_ = 0, pieces_made_ = 0;  // halvings; pieces
};

// The edge of its domain that a side runs along, and its parameter along it at both ends.
struct StraightSide {
  IsoLine<Rational> line;
  Rational begin, end;
};

// A polynomial curve that is constant in one parameter and linear in the other: control points that are linear in the
// averages of degree successive knots. All within `slack` of the lengths of the domain.
std::optional<StraightSide> straight_side(const TrimmedSide& side, const Rational& slack) {
  const ParameterCurve& curve = side.parameters;
  const KnotVector<Rational>& knots = curve.knots();
  const int p = curve.degree(), n = knots.control_count();
  if (!has_unit_weights(curve) || !knots.is_clamped()) return std::nullopt;
  const auto near = [&](const Rational& x, const Rational& y, const KnotVector<Rational>& k) {
    return abs(Rational(x - y)) <= slack * (k.domain_end() - k.domain_begin());
  };
  const auto at_end_of = [&](const KnotVector<Rational>& k, const Rational& x) {
    return near(x, k.domain_begin(), k) ? k.domain_begin() : near(x, k.domain_end(), k) ? k.domain_end() : x;
  };
  for (const Direction constant : {Direction::u, Direction::v}) {
    const int fixed = constant == Direction::u ? 0 : 1, running = 1 - fixed;
    const KnotVector<Rational>&across = side.surface->knots(constant), &along = side.surface->knots(other(constant));
    const Rational value = at_end_of(across, curve.points().front()[fixed]);
    // Inside a surface the face may lie on either side of the line, and the exact classes would not know on which.
    if (value != across.domain_begin() && value != across.domain_end()) continue;
    const Rational begin = at_end_of(along, curve.points().front()[running]),
                   end = at_end_of(along, curve.points().back()[running]);
    if (!along.in_domain(begin) || !along.in_domain(end) || begin == end) continue;
    bool straight = true;
    for (int i = 0; i < n && straight; ++i) {
      Rational average(0);
      for (int j = 1; j <= p; ++j) average += knots[i + j];
      average /= Rational(p);
      const Rational linear =
          begin + (end - begin) * (average - knots.domain_begin()) / (knots.domain_end() - knots.domain_begin());
      straight = near(curve.points()[i][fixed], value, across) && near(curve.points()[i][running], linear, along);
    }
    const patchproof::Side from = value == across.domain_begin() ? patchproof::Side::right : patchproof::Side::left;
    if (straight) return StraightSide{{constant, value, from}, begin, end};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Join<Rational>> to_isoparametric(const TrimmedJoin& join, const Rational& slack) {
  const auto a = straight_side(join.a, slack), b = straight_side(join.b, slack);
  if (!a || !b) return std::nullopt;
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
  const DeadlineScope scope(budget.deadline);
  try {
    return Bounder(join, budget).bounds();
  } catch (const deadline_passed&) {  // before the edge was cut into pieces
    const Rational& begin = join.a.parameters.knots().domain_begin();
    return {{0, kInfinity, begin, false}, {0, 180, begin, false}, {0, 90, begin, false}, 0, {}};
  }
}

}  // namespace patchproof
