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

#include "join/collapsed_edge.h"
#include "join/pairing.h"

namespace patchproof {

namespace {

namespace bg = boost::geometry;
using IsEdge = std::function<bool(int, EdgeName)>;
using BoxPoint = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<BoxPoint>;

constexpr std::array<EdgeName, 4> kEdges{EdgeName::u_min, EdgeName::u_max, EdgeName::v_min, EdgeName::v_max};
// None of these decides a verdict; they only decide which edges are looked at (docs/decisions.md).
constexpr double kDefaultReach = 1e-6;  // match length nobody asked for, of the diagonal
constexpr double kPointLike = 1e-9;     // size of an edge that counts as collapsed, of the diagonal …
constexpr double kSmallOfPatch = 1e-6;  // … if it is also this small beside its patch
constexpr double kSamePlace = 1e-6;     // contacts nearer than this share of an edge are one
constexpr int kSamples = 9;             // places compared when an edge is looked at; the certificate covers all of it

// What is kept of every edge; its curve is made again when it is needed.
struct Edge {
  int patch;
  EdgeName name;
  std::array<Point3, kSamples> samples;
  Box box;
  double length = 0;  // of the polygon of the samples

  const Point3& begin() const { return samples.front(); }
  const Point3& end() const { return samples.back(); }
};

template <ExactField T>
class EdgeMatcher {
 public:
  EdgeMatcher(const std::vector<const BsplinePatch<T, 4>*>& patches, double length, const IsEdge& is_edge)
      : patches_(patches) {
    choose_frame();
    collect_edges(length, is_edge);
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
    const BoxPoint &low = box.min_corner(), &high = box.max_corner();
    const double m = reach_;
    return Box(BoxPoint(low.get<0>() - m, low.get<1>() - m, low.get<2>() - m),
               BoxPoint(high.get<0>() + m, high.get<1>() + m, high.get<2>() + m));
  }

  static void expand(Box& box, const Point3& p) { bg::expand(box, BoxPoint(p[0], p[1], p[2])); }

  // Origin: some control point; exponent: so that no notable control point is farther than about one.
  void choose_frame() {
    std::optional<long> exponent;
    for (const BsplinePatch<T, 4>* patch : patches_) {
      const long weights = weight_exponent(patch->net());
      for (const Vec<T, 4>& h : patch->net()) {
        const Approximate w = approximate(h[3]);
        if (std::abs(w.scaled(-weights)) < kNotableWeight) continue;
        if (!exponent) {
          for (int c = 0; c < 3; ++c) frame_.origin[c] = h[c] / h[3];
          exponent = std::numeric_limits<long>::min();
          continue;
        }
        for (int c = 0; c < 3; ++c) {
          const Approximate x = approximate(T(h[c] - frame_.origin[c] * h[3]));
          if (x.mantissa != 0) exponent = std::max(*exponent, x.exponent - w.exponent + 1);
        }
      }
    }
    frame_.exponent = exponent && *exponent != std::numeric_limits<long>::min() ? *exponent : 0;
  }

  void collect_edges(double length, const IsEdge& is_edge) {
    Box all = bg::make_inverse<Box>();
    std::vector<Edge> edges;
    std::vector<Box> of_patch(patches_.size(), all);
    for (std::size_t p = 0; p < patches_.size(); ++p)
      for (EdgeName name : kEdges) {
        if (is_edge && !is_edge(static_cast<int>(p), name)) continue;
        const EdgeCurve curve = edge_curve(*patches_[p], name, frame_);
        Edge edge{static_cast<int>(p), name, {}, bg::make_inverse<Box>()};
        bool finite = true;
        for (int i = 0; i < kSamples; ++i) {
          edge.samples[i] = curve(double(i) / (kSamples - 1));
          for (double x : edge.samples[i]) finite = finite && std::isfinite(x);
          if (finite) expand(edge.box, edge.samples[i]);
          if (i > 0) edge.length += distance(edge.samples[i - 1], edge.samples[i]);
        }
        for (const Vec<double, 4>& h : curve.points())
          if (std::abs(h[3]) >= kNotableWeight) expand(edge.box, {h[0] / h[3], h[1] / h[3], h[2] / h[3]});
        bg::expand(all, edge.box);
        bg::expand(of_patch[p], edge.box);
        if (finite)
          edges.push_back(edge);
        else
          unlookable_.push_back(edge);  // doubles cannot follow its curve: listed, never dropped
      }
    const double diagonal = edges.empty() ? 0 : bg::distance(all.min_corner(), all.max_corner());
    local_ = !(length > 0);
    reach_ = local_ ? kDefaultReach * diagonal : Approximate{length, 0}.scaled(-frame_.exponent);
    match_.diagonal = Approximate{diagonal, frame_.exponent}.scaled(0);
    match_.length = local_ ? kDefaultReach * match_.diagonal : length;
    const auto size_of = [](const Box& box) { return bg::distance(box.min_corner(), box.max_corner()); };
    for (Edge& edge : edges) {
      const double size = size_of(edge.box);
      const BsplinePatch<T, 4>& patch = *patches_[edge.patch];
      // Small beside the model and beside its own patch; a small face in a large model has edges all the same.
      const bool small = size <= kPointLike * diagonal && size <= kSmallOfPatch * size_of(of_patch[edge.patch]);
      if (small || (size <= kDefaultReach * diagonal &&
                    is_one_point(cross_boundary_rows(patch, edge_line(patch, edge.name), 0)[0])))
        match_.collapsed.push_back(collapsed_edge(patch, edge.patch, edge.name));
      else
        edges_.push_back(std::move(edge));
    }
  }

  // How near points of the two edges must be: what was asked; by default never more than a tenth of the shorter edge, or a
  // small face's edges would all meet each other.
  double reach(const Edge& a, const Edge& b) const {
    return local_ ? std::min(reach_, std::min(a.length, b.length) / 10) : reach_;
  }

  IsoLine<T> line(const Edge& e) const { return edge_line(*patches_[e.patch], e.name); }
  const KnotVector<T>& along(const Edge& e) const { return patches_[e.patch]->knots(other(line(e).constant)); }
  EdgeCurve curve(const Edge& e) const { return edge_curve(*patches_[e.patch], e.name, frame_); }

  // The largest distance of samples at equal parameters.
  static double sample_distance(const Edge& a, const Edge& b, bool reversed) {
    double largest = 0;
    for (int i = 0; i < kSamples; ++i)
      largest = std::max(largest, distance(a.samples[i], b.samples[reversed ? kSamples - 1 - i : i]));
    return largest;
  }

  void join_edges(int i, int j) {
    const Edge &a = edges_[i], &b = edges_[j];
    const double near = reach(a, b);
    const auto ends_meet = [&](bool reversed) {
      const Point3 &b0 = reversed ? b.end() : b.begin(), &b1 = reversed ? b.begin() : b.end();
      return distance(a.begin(), b0) <= near && distance(a.end(), b1) <= near;
    };
    const std::array<bool, 2> meet{ends_meet(false), ends_meet(true)};  // both when the edges are closed
    if (meet[0] || meet[1]) {  // a wide match length may allow both directions: the better one is meant
      const bool reversed = !meet[0] || (meet[1] && sample_distance(a, b, true) < sample_distance(a, b, false));
      if (sample_distance(a, b, reversed) <= near) return add_whole(a, b, reversed, nullptr);
    }
    if (meet[0] || meet[1]) {
      const EdgeCurve curve_b = curve(b);
      for (const bool reversed : {false, true})
        if (meet[reversed] && lies_on(a, curve_b, meet[!reversed] ? std::optional(reversed) : std::nullopt, near))
          return add_whole(a, b, reversed, &curve_b);
    }
    join_overlap(a, b);
  }

  // All samples of a within the match length of the curve and, when asked, met in this direction.
  static bool lies_on(const Edge& a, const EdgeCurve& b, std::optional<bool> reversed, double near) {
    double last = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto [unit, gap] = b.nearest(a.samples[i]);
      if (!(gap <= near)) return false;
      if (!reversed || i == 0 || i + 1 == kSamples) continue;  // the ends of a closed edge are one place
      const double along = *reversed ? 1 - unit : unit;
      if (along < last) return false;
      last = along;
    }
    return true;
  }

  void add_whole(const Edge& a, const Edge& b, bool reversed, const EdgeCurve* differently_run) {
    Join<T> join{a.patch == b.patch ? JoinKind::seam : JoinKind::isoparametric, a.patch, b.patch, line(a), line(b), {}};
    T b0 = along(b).domain_begin(), b1 = along(b).domain_end();
    if (reversed) std::swap(b0, b1);
    const T &a0 = along(a).domain_begin(), &a1 = along(a).domain_end();
    join.pairing = affine_pairing(a0, a1, b0, b1);
    // Equal speeds show as samples that agree to rounding; then there is nothing to look for.
    const bool same_speed = !differently_run && sample_distance(a, b, reversed) <= 1e-6 * reach_;
    if (auto better = same_speed ? std::nullopt : rational_linear_pairing(*patches_[a.patch], *patches_[b.patch], join))
      join.pairing = *better;
    else if (differently_run)
      join.pairing = nearest_point_pairing(curve(a), *differently_run, a0, a1, b0, b1, reach(a, b) / 10);
    push(std::move(join), a, b);
  }

  void push(Join<T> join, const Edge& a, const Edge& b) {
    const auto cover = [&](const Edge& e, const std::vector<T>& nodes) {
      const T &begin = along(e).domain_begin(), &end = along(e).domain_end();
      const double x = nearest_double(T((nodes.front() - begin) / (end - begin)));
      const double y = nearest_double(T((nodes.back() - begin) / (end - begin)));
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
    return spread_a < kSamePlace || spread_b < kSamePlace;
  }

  // Partial overlaps: ends of one edge on the other give places where they meet; between neighbouring ones the edges lie
  // on each other or not. A closed edge's end is two places.
  void join_overlap(const Edge& a, const Edge& b) {
    const double near = reach(a, b);
    std::vector<Contact> contacts;
    const auto contact = [&](int end, double on, bool on_is_end, bool from_a) {
      return from_a ? Contact{double(end), on, true, on_is_end} : Contact{on, double(end), on_is_end, true};
    };
    // Ends on ends cost nothing to find; only if ends remain that may lie inside the other edge is its curve searched.
    std::array<std::vector<const Point3*>, 2> inside_candidates;
    const auto add_ends = [&](const Edge& from, const Edge& onto, bool from_a) {
      for (const int end : {0, 1}) {
        const Point3& q = end ? from.end() : from.begin();
        const bool at_begin = distance(onto.begin(), q) <= near, at_end = distance(onto.end(), q) <= near;
        if (at_begin) contacts.push_back(contact(end, 0, true, from_a));
        if (at_end) contacts.push_back(contact(end, 1, true, from_a));
        if (!at_begin && !at_end && bg::intersects(grown(onto.box), BoxPoint(q[0], q[1], q[2])))
          inside_candidates[from_a ? 0 : 1].push_back(&q);
      }
    };
    add_ends(a, b, true);
    add_ends(b, a, false);
    if (inside_candidates[0].empty() && inside_candidates[1].empty() && only_touch(contacts)) return;
    const EdgeCurve curve_a = curve(a), curve_b = curve(b);
    for (const bool from_a : {true, false})
      for (const Point3* q : inside_candidates[from_a ? 0 : 1]) {
        const auto [unit, gap] = (from_a ? curve_b : curve_a).nearest(*q);
        const Edge& from = from_a ? a : b;
        if (gap <= near) contacts.push_back(contact(q == &from.end() ? 1 : 0, unit, false, from_a));
      }
    if (only_touch(contacts)) return;
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& x, const Contact& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    // What is looked at must be longer than the neighbourhood of a common vertex.
    const double shortest = std::min(10 * near, std::min(a.length, b.length) / 10);
    std::size_t first = 0;
    while (first < contacts.size()) {
      const auto last_of = [&](std::size_t i) {  // the contacts at one place of a
        std::size_t k = i;
        while (k < contacts.size() && contacts[k].a - contacts[i].a < kSamePlace) ++k;
        return k;
      };
      const std::size_t next = last_of(first), stop = next < contacts.size() ? last_of(next) : next;
      for (std::size_t i = first; i < next; ++i)
        for (std::size_t j = next; j < stop; ++j)
          if (run_together(curve_a, contacts[i].a, contacts[j].a, curve_b, contacts[i].b, contacts[j].b, near,
                           shortest)) {
            add_overlap(a, b, contacts[i], contacts[j]);
            i = next, j = stop;
          }
      first = next;
    }
  }

  void add_overlap(const Edge& a, const Edge& b, const Contact& from, const Contact& to) {
    Join<T> join{a.patch == b.patch ? JoinKind::seam : JoinKind::t_junction, a.patch, b.patch, line(a), line(b), {}};
    const auto [a0, b0] = exact_contact(a, b, from);
    const auto [a1, b1] = exact_contact(a, b, to);
    if (!(a0 < a1) || b0 == b1) return;
    join.pairing = affine_pairing(a0, a1, b0, b1);
    push(std::move(join), a, b);
  }

  // Exact parameters of a contact: an end of an edge is its own parameter; a place inside an edge is found from the other
  // edge's end.
  std::pair<T, T> exact_contact(const Edge& a, const Edge& b, const Contact& c) const {
    const auto end_of = [&](const Edge& e, double unit) {
      return unit < 0.5 ? along(e).domain_begin() : along(e).domain_end();
    };
    const auto row = [&](const Edge& e) { return std::move(cross_boundary_rows(*patches_[e.patch], line(e), 0)[0]); };
    const auto inside = [&](const Edge& e, double unit, const Edge& ending, double end) {
      return exact_parameter(row(e), evaluate(row(ending), end_of(ending, end)), unit);
    };
    if (c.a_is_end && c.b_is_end) return {end_of(a, c.a), end_of(b, c.b)};
    if (c.a_is_end) return {end_of(a, c.a), inside(b, c.b, a, c.a)};
    return {inside(a, c.a, b, c.b), end_of(b, c.b)};
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
    for (const std::vector<Edge>* list : {&edges_, &unlookable_})
      for (const Edge& e : *list) {
        // A rest no longer than the neighbourhood of a vertex is not listed, as long as it is a small part of the edge.
        const double slack = e.length > 0 ? std::clamp(10 * reach_ / e.length, 1e-9, 1e-3) : 0;
        const auto add = [&](double from, double to) {
          const T &begin = along(e).domain_begin(), &end = along(e).domain_end();
          const auto at = [&](double unit) { return nearest_double(at_unit(begin, end, embed<T>(from_double(unit)))); };
          match_.unmatched.push_back({e.patch, e.name, at(from), at(to)});
        };
        std::vector<std::pair<double, double>>& ranges = covered_[{e.patch, e.name}];
        std::sort(ranges.begin(), ranges.end());
        double reached = 0;
        for (const auto& [from, to] : ranges) {
          if (from > reached + slack) add(reached, from);
          reached = std::max(reached, to);
        }
        if (1 > reached + slack) add(reached, 1);
      }
  }

  const std::vector<const BsplinePatch<T, 4>*>& patches_;
  EdgeMatch<T> match_;
  Frame<T> frame_;
  double reach_ = 0;    // the match length, in the frame
  bool local_ = false;  // nobody asked for a match length
  std::vector<Edge> edges_, unlookable_;
  std::map<std::pair<int, EdgeName>, std::vector<std::pair<double, double>>> covered_;
};

}  // namespace

template <ExactField T>
EdgeMatch<T> match_edges(const std::vector<const BsplinePatch<T, 4>*>& patches, double length, const IsEdge& is_edge) {
  return EdgeMatcher<T>(patches, length, is_edge).run();
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

template EdgeMatch<Rational> match_edges(const std::vector<const BsplinePatch<Rational, 4>*>&, double, const IsEdge&);
template EdgeMatch<Quadratic> match_edges(const std::vector<const BsplinePatch<Quadratic, 4>*>&, double, const IsEdge&);
template Join<Rational> whole_edge_join(const std::vector<const BsplinePatch<Rational, 4>*>&, int, EdgeName, int,
                                        EdgeName, bool);
template Join<Quadratic> whole_edge_join(const std::vector<const BsplinePatch<Quadratic, 4>*>&, int, EdgeName, int,
                                         EdgeName, bool);

}  // namespace patchproof
