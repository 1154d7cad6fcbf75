// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/edge_match.h"

#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/algorithms/expand.hpp>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/algorithms/make.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <map>
#include <tuple>

#include "join/pairing.h"

namespace patchproof {

namespace {

namespace bg = boost::geometry;
using BoxPoint = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<BoxPoint>;

constexpr std::array<EdgeName, 4> kEdges{EdgeName::u_min, EdgeName::u_max, EdgeName::v_min, EdgeName::v_max};
constexpr int kSamples = 9;  // places compared when an edge is looked at; the certificate covers all of it

// What is kept of every edge; its curve is made again when it is needed.
struct Edge {
  int patch;
  EdgeName name;
  std::array<Point3, kSamples> samples;
  Box box;

  const Point3& begin() const { return samples.front(); }
  const Point3& end() const { return samples.back(); }
};

template <ExactField T>
class EdgeMatcher {
 public:
  EdgeMatcher(const std::vector<const BsplinePatch<T, 4>*>& patches, double length) : patches_(patches) {
    measure();
    match_.length = length > 0 ? length : 1e-6 * match_.diagonal;
    collect_edges();
  }

  EdgeMatch<T> run() {
    std::vector<std::pair<Box, int>> boxes;
    for (std::size_t i = 0; i < edges_.size(); ++i) boxes.emplace_back(edges_[i].box, static_cast<int>(i));
    const bg::index::rtree<std::pair<Box, int>, bg::index::quadratic<16>> tree(boxes);
    std::vector<std::pair<Box, int>> near;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      near.clear();
      tree.query(bg::index::intersects(grown(edges_[i].box)), std::back_inserter(near));
      std::vector<int> partners;
      for (const auto& [box, j] : near)
        if (static_cast<std::size_t>(j) > i) partners.push_back(j);
      std::sort(partners.begin(), partners.end());
      for (int j : partners) join_edges(static_cast<int>(i), j);
    }
    add_knot_lines();
    list_unmatched();
    return std::move(match_);
  }

 private:
  Box grown(const Box& box) const {
    Box out;
    const double m = match_.length;
    bg::set<bg::min_corner, 0>(out, bg::get<bg::min_corner, 0>(box) - m);
    bg::set<bg::min_corner, 1>(out, bg::get<bg::min_corner, 1>(box) - m);
    bg::set<bg::min_corner, 2>(out, bg::get<bg::min_corner, 2>(box) - m);
    bg::set<bg::max_corner, 0>(out, bg::get<bg::max_corner, 0>(box) + m);
    bg::set<bg::max_corner, 1>(out, bg::get<bg::max_corner, 1>(box) + m);
    bg::set<bg::max_corner, 2>(out, bg::get<bg::max_corner, 2>(box) + m);
    return out;
  }

  static void expand(Box& box, const Point3& p) { bg::expand(box, BoxPoint(p[0], p[1], p[2])); }

  // The diagonal of the box of all control points (of those with a weight).
  void measure() {
    Box box = bg::make_inverse<Box>();
    for (const BsplinePatch<T, 4>* patch : patches_)
      for (const Vec<T, 4>& h : patch->net()) {
        const double w = approximate(h[3]);
        if (w != 0) expand(box, {approximate(h[0]) / w, approximate(h[1]) / w, approximate(h[2]) / w});
      }
    if (!patches_.empty()) match_.diagonal = bg::distance(box.min_corner(), box.max_corner());
  }

  void collect_edges() {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      for (EdgeName name : kEdges) {
        const EdgeCurve curve = edge_curve(*patches_[p], name);
        Edge edge{static_cast<int>(p), name, {}, bg::make_inverse<Box>()};
        for (int i = 0; i < kSamples; ++i) expand(edge.box, edge.samples[i] = curve(double(i) / (kSamples - 1)));
        for (const Vec<double, 4>& h : curve.points())
          if (h[3] != 0) expand(edge.box, {h[0] / h[3], h[1] / h[3], h[2] / h[3]});
        if (bg::distance(edge.box.min_corner(), edge.box.max_corner()) <= 1e-9 * match_.diagonal)
          add_collapsed(edge);
        else
          edges_.push_back(edge);
      }
  }

  void add_collapsed(const Edge& edge) {
    const BsplinePatch<T, 4>& patch = *patches_[edge.patch];
    const auto rows = cross_boundary_rows(patch, edge_line(patch, edge.name), 2);
    CollapsedEdge out{edge.patch, edge.name, true, true};
    const Vec<T, 4>& first = rows[0].points().front();
    for (const Vec<T, 4>& p : rows[0].points())
      for (int c = 0; c < 3; ++c) out.exactly = out.exactly && p[c] * first[3] == first[c] * p[3];
    out.tangent_plane = out.exactly && has_tangent_plane(rows);
    match_.collapsed.push_back(out);
  }

  // All limit normals n(t) along the collapsed edge on one line and in one sense: n × r vanishes for one fixed n(0) = r
  // and n · r > 0 throughout.
  static bool has_tangent_plane(const std::vector<BsplineCurve<T, 4>>& rows) {
    using R = proof_ring_t<T>;
    const RoundingGuard guard;
    const std::vector<T> breaks = rows[0].knots().breaks();
    std::optional<FormVector<R>> reference;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      SideRows<T> piece;
      for (int k = 0; k < 3; ++k) piece[k] = bezier_coefficients(rows[k], breaks[i], breaks[i + 1]);
      const ReducedNormal<R> normal = reduce_normal(side_forms<R>(piece));
      if (!normal.found() || normal.has_factor()) return false;
      if (!reference) {
        reference.emplace();
        for (int c = 0; c < 3; ++c)
          if (!normal.n[c].is_empty()) (*reference)[c] = BinaryForm<R>::constant(normal.n[c][0]);
      }
      if (!vanishes(cross(normal.n, *reference))) return false;
      for (const R& x : dot(normal.n, *reference).coefficients())
        if (*scalar_traits<R>::sign(x) != Sign::positive) return false;
    }
    return true;
  }

  IsoLine<T> line(const Edge& e) const { return edge_line(*patches_[e.patch], e.name); }
  const KnotVector<T>& along(const Edge& e) const { return patches_[e.patch]->knots(other(line(e).constant)); }
  EdgeCurve curve(const Edge& e) const { return edge_curve(*patches_[e.patch], e.name); }

  static bool samples_agree(const Edge& a, const Edge& b, bool reversed, double length) {
    for (int i = 0; i < kSamples; ++i)
      if (!(distance(a.samples[i], b.samples[reversed ? kSamples - 1 - i : i]) <= length)) return false;
    return true;
  }

  void join_edges(int i, int j) {
    const Edge &a = edges_[i], &b = edges_[j];
    const auto ends_meet = [&](bool reversed) {
      const Point3 &b0 = reversed ? b.end() : b.begin(), &b1 = reversed ? b.begin() : b.end();
      return distance(a.begin(), b0) <= match_.length && distance(a.end(), b1) <= match_.length;
    };
    const std::array<bool, 2> meet{ends_meet(false), ends_meet(true)};  // both when the edges are closed
    for (const bool reversed : {false, true})
      if (meet[reversed] && samples_agree(a, b, reversed, match_.length)) return add_whole(a, b, reversed, nullptr);
    if (meet[0] || meet[1]) {
      const EdgeCurve curve_b = curve(b);
      for (const bool reversed : {false, true})
        if (meet[reversed] && lies_on(a, curve_b, meet[!reversed] ? std::optional(reversed) : std::nullopt))
          return add_whole(a, b, reversed, &curve_b);
    }
    join_overlap(a, b);
  }

  // All samples of a within the match length of the curve and, when asked, met in this direction.
  bool lies_on(const Edge& a, const EdgeCurve& b, std::optional<bool> reversed) const {
    double last = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto [unit, gap] = b.nearest(a.samples[i]);
      if (!(gap <= match_.length)) return false;
      if (!reversed || i == 0 || i + 1 == kSamples) continue;  // the ends of a closed edge are one place
      const double along = *reversed ? 1 - unit : unit;
      if (along < last) return false;
      last = along;
    }
    return true;
  }

  JoinKind kind_of(const Edge& a, const Edge& b) const {
    return a.patch == b.patch ? JoinKind::seam : JoinKind::isoparametric;
  }

  void add_whole(const Edge& a, const Edge& b, bool reversed, const EdgeCurve* differently_run) {
    Join<T> join{kind_of(a, b), a.patch, b.patch, line(a), line(b), {}};
    T b0 = along(b).domain_begin(), b1 = along(b).domain_end();
    if (reversed) std::swap(b0, b1);
    const T &a0 = along(a).domain_begin(), &a1 = along(a).domain_end();
    join.pairing = affine_pairing(a0, a1, b0, b1);
    // Equal speeds show as samples that agree to rounding; then there is nothing to look for.
    const bool same_speed = !differently_run && samples_agree(a, b, reversed, 1e-12 * match_.diagonal);
    if (auto better = same_speed ? std::nullopt : rational_linear_pairing(*patches_[a.patch], *patches_[b.patch], join))
      join.pairing = *better;
    else if (differently_run)
      join.pairing = nearest_point_pairing(curve(a), *differently_run, a0, a1, b0, b1, match_.length / 10);
    push(std::move(join), a, b);
  }

  void push(Join<T> join, const Edge& a, const Edge& b) {
    const auto cover = [&](const Edge& e, const std::vector<T>& nodes) {
      const double x = nearest_double(nodes.front()), y = nearest_double(nodes.back());
      covered_[{e.patch, e.name}].emplace_back(std::min(x, y), std::max(x, y));
    };
    cover(a, join.pairing.a);
    cover(b, join.pairing.b);
    match_.joins.push_back(std::move(join));
  }

  struct Contact {
    double a, b;  // unit parameters
    bool a_is_end, b_is_end;
  };

  // All contacts at one place of a or of b.
  static bool only_touch(const std::vector<Contact>& contacts) {
    double spread_a = 0, spread_b = 0;
    for (const Contact& x : contacts) {
      spread_a = std::max(spread_a, std::abs(x.a - contacts[0].a));
      spread_b = std::max(spread_b, std::abs(x.b - contacts[0].b));
    }
    return spread_a < 1e-6 || spread_b < 1e-6;
  }

  // A partial overlap: ends of one edge on the other give two places where they meet.
  void join_overlap(const Edge& a, const Edge& b) {
    std::vector<Contact> contacts;
    std::optional<EdgeCurve> curve_a, curve_b;
    const auto contact = [&](int end, double on, bool on_is_end, bool from_a) {
      return from_a ? Contact{double(end), on, true, on_is_end} : Contact{on, double(end), on_is_end, true};
    };
    // Ends on ends cost nothing to find; only if ends remain that may lie inside the other edge is its curve searched.
    std::array<std::vector<const Point3*>, 2> inside_candidates;
    const auto add_ends = [&](const Edge& from, const Edge& onto, bool from_a) {
      for (const int end : {0, 1}) {
        const Point3& q = end ? from.end() : from.begin();
        if (distance(onto.begin(), q) <= match_.length) {
          contacts.push_back(contact(end, 0, true, from_a));
        } else if (distance(onto.end(), q) <= match_.length) {
          contacts.push_back(contact(end, 1, true, from_a));
        } else if (bg::intersects(grown(onto.box), BoxPoint(q[0], q[1], q[2]))) {
          inside_candidates[from_a ? 0 : 1].push_back(&q);
        }
      }
    };
    add_ends(a, b, true);
    add_ends(b, a, false);
    if (inside_candidates[0].empty() && inside_candidates[1].empty() && only_touch(contacts)) return;
    const auto add = [&](const Edge& from, const Edge& onto, std::optional<EdgeCurve>& onto_curve, bool from_a) {
      for (const Point3* q : inside_candidates[from_a ? 0 : 1]) {
        if (!onto_curve) onto_curve.emplace(curve(onto));
        const auto [unit, gap] = onto_curve->nearest(*q);
        if (gap <= match_.length) contacts.push_back(contact(q == &from.end() ? 1 : 0, unit, false, from_a));
      }
    };
    add(a, b, curve_b, true);
    add(b, a, curve_a, false);
    if (only_touch(contacts)) return;
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& x, const Contact& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    const Contact &first = contacts.front(), &last = contacts.back();
    if (!curve_a) curve_a.emplace(curve(a));
    if (!curve_b) curve_b.emplace(curve(b));
    // Near a common vertex every pair of edges is close; what is looked at must be longer than that.
    if (distance((*curve_a)(first.a), (*curve_a)(last.a)) <= 10 * match_.length) return;
    for (int i = 1; i + 1 < kSamples; ++i) {
      const double s = double(i) / (kSamples - 1);
      const Point3 p = (*curve_a)(first.a + s * (last.a - first.a)), q = (*curve_b)(first.b + s * (last.b - first.b));
      if (!(distance(p, q) <= match_.length)) return;
    }
    Join<T> join{a.patch == b.patch ? JoinKind::seam : JoinKind::t_junction, a.patch, b.patch, line(a), line(b), {}};
    const auto [a0, b0] = exact_contact(a, b, first);
    const auto [a1, b1] = exact_contact(a, b, last);
    join.pairing = affine_pairing(a0, a1, b0, b1);
    push(std::move(join), a, b);
  }

  // Exact parameters of a contact: an end of an edge is its own parameter; a place inside an edge is a knot or a simple
  // fraction near the one found, whichever comes closest to the other edge's end.
  std::pair<T, T> exact_contact(const Edge& a, const Edge& b, const Contact& c) const {
    const auto end_of = [&](const Edge& e, double unit) {
      return unit < 0.5 ? along(e).domain_begin() : along(e).domain_end();
    };
    if (c.a_is_end && c.b_is_end) return {end_of(a, c.a), end_of(b, c.b)};
    if (c.a_is_end) return {end_of(a, c.a), inside(b, c.b, a, c.a)};
    return {inside(a, c.a, b, c.b), end_of(b, c.b)};
  }

  T inside(const Edge& e, double unit, const Edge& ending, double end) const {
    const T &begin = along(e).domain_begin(), &stop = along(e).domain_end();
    std::vector<T> candidates;
    for (const T& k : along(e).breaks()) {
      const double at = nearest_double(T((k - begin) / (stop - begin)));
      if (std::abs(at - unit) < 1e-5) candidates.push_back(k);
    }
    for (const double radius : {1e-5, 1e-7, 1e-9, 1e-11, 1e-13})
      candidates.push_back(at_unit(begin, stop, embed<T>(simplest_fraction(unit, radius))));
    candidates.push_back(at_unit(begin, stop, embed<T>(from_double(unit))));
    const auto exact_point = [&](const Edge& x, const T& t) {
      const BsplineCurve<T, 4> row = std::move(cross_boundary_rows(*patches_[x.patch], line(x), 0)[0]);
      const Vec<T, 4> h = evaluate(row, t);
      return Vec<T, 3>{{h[0] / h[3], h[1] / h[3], h[2] / h[3]}};
    };
    const Vec<T, 3> target = exact_point(ending, end < 0.5 ? along(ending).domain_begin() : along(ending).domain_end());
    std::optional<T> best_square;
    T best = candidates.front();
    for (const T& t : candidates) {
      const Vec<T, 3> d = exact_point(e, t) - target;
      const T square = dot(d, d);
      if (!best_square || square < *best_square) best_square = square, best = t;
    }
    return best;
  }

  void add_knot_lines() {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      for (const Direction d : {Direction::u, Direction::v}) {
        const KnotVector<T>& knots = patches_[p]->knots(d);
        const KnotVector<T>& across = patches_[p]->knots(other(d));
        const std::vector<T> breaks = knots.breaks();
        for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
          if (knots.multiplicity(breaks[i]) < knots.degree()) continue;
          Join<T> join{JoinKind::knot_line,        static_cast<int>(p),         static_cast<int>(p),
                       {d, breaks[i], Side::left}, {d, breaks[i], Side::right}, {}};
          join.pairing =
              affine_pairing(across.domain_begin(), across.domain_end(), across.domain_begin(), across.domain_end());
          match_.joins.push_back(std::move(join));
        }
      }
  }

  void list_unmatched() {
    for (const Edge& e : edges_) {
      const double begin = nearest_double(along(e).domain_begin()), end = nearest_double(along(e).domain_end());
      // A rest no longer than what tells an overlap from a common vertex is not worth listing.
      double length = 0;
      for (int i = 0; i + 1 < kSamples; ++i) length += distance(e.samples[i], e.samples[i + 1]);
      const double slack = std::max(1e-9, 10 * match_.length / length) * (end - begin);
      std::vector<std::pair<double, double>>& ranges = covered_[{e.patch, e.name}];
      std::sort(ranges.begin(), ranges.end());
      double reached = begin;
      for (const auto& [from, to] : ranges) {
        if (from > reached + slack) match_.unmatched.push_back({e.patch, e.name, reached, from});
        reached = std::max(reached, to);
      }
      if (end > reached + slack) match_.unmatched.push_back({e.patch, e.name, reached, end});
    }
  }

  const std::vector<const BsplinePatch<T, 4>*>& patches_;
  EdgeMatch<T> match_;
  std::vector<Edge> edges_;
  std::map<std::pair<int, EdgeName>, std::vector<std::pair<double, double>>> covered_;
};

}  // namespace

template <ExactField T>
EdgeMatch<T> match_edges(const std::vector<const BsplinePatch<T, 4>*>& patches, double length) {
  return EdgeMatcher<T>(patches, length).run();
}

template <ExactField T>
Join<T> whole_edge_join(const std::vector<const BsplinePatch<T, 4>*>& patches, int patch_a, EdgeName edge_a,
                        int patch_b, EdgeName edge_b, bool reversed) {
  const auto line_a = edge_line(*patches[patch_a], edge_a), line_b = edge_line(*patches[patch_b], edge_b);
  const KnotVector<T>& along_a = patches[patch_a]->knots(other(line_a.constant));
  const KnotVector<T>& along_b = patches[patch_b]->knots(other(line_b.constant));
  Join<T> join{patch_a == patch_b ? JoinKind::seam : JoinKind::isoparametric, patch_a, patch_b, line_a, line_b, {}};
  join.pairing =
      reversed
          ? affine_pairing(along_a.domain_begin(), along_a.domain_end(), along_b.domain_end(), along_b.domain_begin())
          : affine_pairing(along_a.domain_begin(), along_a.domain_end(), along_b.domain_begin(), along_b.domain_end());
  if (auto better = rational_linear_pairing(*patches[patch_a], *patches[patch_b], join)) join.pairing = *better;
  return join;
}

template EdgeMatch<Rational> match_edges(const std::vector<const BsplinePatch<Rational, 4>*>&, double);
template EdgeMatch<Quadratic> match_edges(const std::vector<const BsplinePatch<Quadratic, 4>*>&, double);
template Join<Rational> whole_edge_join(const std::vector<const BsplinePatch<Rational, 4>*>&, int, EdgeName, int,
                                        EdgeName, bool);
template Join<Quadratic> whole_edge_join(const std::vector<const BsplinePatch<Quadratic, 4>*>&, int, EdgeName, int,
                                         EdgeName, bool);

}  // namespace patchproof
