// SPDX-License-Identifier: Apache-2.0
#include "shared_edges.h"

#include <algorithm>
#include <cmath>

namespace patchproof {
namespace {

template <ExactField T>
std::vector<EdgeName> edge_of_line(const BsplinePatch<T, 4>& patch, const IsoLine<T>& line) {
  const KnotVector<T>& knots = patch.knots(line.constant);
  const bool u = line.constant == Direction::u;
  if (line.value == knots.domain_begin()) return {u ? EdgeName::u_min : EdgeName::v_min};
  if (line.value == knots.domain_end()) return {u ? EdgeName::u_max : EdgeName::v_max};
  return {};
}

// x on the nodes `from`, affine or rational linear in between, carried to `to`.
template <ExactField T>
T carried(const std::vector<T>& from, const std::vector<T>& to, const T& ratio, const T& x) {
  const bool rising = from.front() < from.back();
  std::size_t k = 0;
  while (k + 2 < from.size() && (rising ? !(x < from[k + 1]) : !(from[k + 1] < x))) ++k;
  const T y = (x - from[k]) / (from[k + 1] - from[k]);
  const T z = ratio == T(1) ? y : T(ratio * y / (T(1) - y + ratio * y));
  return to[k] + z * (to[k + 1] - to[k]);
}

}  // namespace

template <ExactField T>
SharedEdges<T>::SharedEdges(const std::vector<const BsplinePatch<T, 4>*>& patches, const std::vector<Join<T>>& joins,
                            const std::vector<CollapsedEdge>& collapsed)
    : joins_(joins),
      join_edges_(joins.size()),
      sides_(4 * patches.size()),
      on_edge_(4 * patches.size()),
      collapsed_(4 * patches.size(), -2),
      known_(patches.size()) {
  for (const auto* p : patches)
    scales_.push_back({SpanScale<T>(p->knots(Direction::u).breaks()), SpanScale<T>(p->knots(Direction::v).breaks())});
  for (std::size_t j = 0; j < joins.size(); ++j) {
    const Join<T>& join = joins[j];
    const auto a = edge_of_line(*patches[join.patch_a], join.line_a),
               b = edge_of_line(*patches[join.patch_b], join.line_b);
    if (a.empty() || b.empty()) continue;  // a knot line inside a patch: its nodes are the same anyway
    join_edges_[j] = {a[0], b[0]};
    sides_[index(join.patch_a, a[0])].push_back({static_cast<int>(j), false});
    sides_[index(join.patch_b, b[0])].push_back({static_cast<int>(j), true});
  }
  for (const CollapsedEdge& c : collapsed) collapsed_[index(c.patch, c.edge)] = -1;
}

template <ExactField T>
std::vector<EdgeName> SharedEdges<T>::edges_of(const MeshNode& n) const {
  std::vector<EdgeName> out;
  if (n.u == 0) out.push_back(EdgeName::u_min);
  if (n.u == scales_[n.patch][0].count()) out.push_back(EdgeName::u_max);
  if (n.v == 0) out.push_back(EdgeName::v_min);
  if (n.v == scales_[n.patch][1].count()) out.push_back(EdgeName::v_max);
  return out;
}

template <ExactField T>
int SharedEdges<T>::vertex_of(int node) const {
  while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
  return node;
}

template <ExactField T>
void SharedEdges<T>::unite(int a, int b) {
  a = vertex_of(a);
  b = vertex_of(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

template <ExactField T>
int SharedEdges<T>::node(int patch, double u, double v) {
  const auto [found, is_new] = known_[patch].try_emplace({u, v}, static_cast<int>(nodes_.size()));
  const int id = found->second;
  if (!is_new) return id;
  nodes_.push_back({patch, u, v});
  parent_.push_back(id);
  const auto edges = edges_of(nodes_.back());
  for (const EdgeName e : edges) {
    const int at = index(patch, e);
    on_edge_[at].emplace(along(nodes_.back(), e), id);
    if (collapsed_[at] == -1)
      collapsed_[at] = id;
    else if (collapsed_[at] >= 0)
      unite(collapsed_[at], id);
  }
  if (!edges.empty()) waiting_.push_back(id);
  return id;
}

template <ExactField T>
double SharedEdges<T>::partner(const Side& side, double s) const {
  const Join<T>& join = joins_[side.join];
  const Pairing<T>& pairing = join.pairing;
  const int own = side.second ? join.patch_b : join.patch_a, its = side.second ? join.patch_a : join.patch_b;
  const EdgeName own_edge = join_edges_[side.join][side.second ? 1 : 0],
                 its_edge = join_edges_[side.join][side.second ? 0 : 1];
  const std::vector<T>&from = side.second ? pairing.b : pairing.a, &to = side.second ? pairing.a : pairing.b;
  const SpanScale<T>& own_scale = scale(own, own_edge);
  T t = own_scale.knot_of(s);
  const T &low = std::min(from.front(), from.back()), &high = std::max(from.front(), from.back());
  // An end that was rounded outside still is the end.
  if (t < low || high < t) {
    const T& end = t < low ? low : high;
    if (std::abs(own_scale.span_of(end) - s) > kNearNodes) return -1;
    t = end;
  }
  const T ratio = side.second ? T(T(1) / pairing.ratio) : pairing.ratio;
  return scale(its, its_edge).span_of(carried(from, to, ratio, t));
}

template <ExactField T>
void SharedEdges<T>::spread() {
  while (!waiting_.empty()) {
    const int id = waiting_.back();
    waiting_.pop_back();
    const MeshNode here = nodes_[id];
    for (const EdgeName e : edges_of(here))
      for (const Side& side : sides_[index(here.patch, e)]) {
        const double s = partner(side, along(here, e));
        if (s < 0) continue;
        const Join<T>& join = joins_[side.join];
        const int its = side.second ? join.patch_a : join.patch_b;
        const EdgeName its_edge = join_edges_[side.join][side.second ? 0 : 1];
        const auto& there = on_edge_[index(its, its_edge)];
        const auto next = there.lower_bound(s - kNearNodes);
        int other = -1;
        if (next != there.end() && next->first <= s + kNearNodes) {
          other = next->second;
          const auto after = std::next(next);
          if (after != there.end() && std::abs(after->first - s) < std::abs(next->first - s)) other = after->second;
        } else {
          const auto& scales = scales_[its];
          const double last = its_edge == EdgeName::u_max   ? scales[0].count()
                              : its_edge == EdgeName::v_max ? scales[1].count()
                                                            : 0;
          const bool u_fixed = its_edge == EdgeName::u_min || its_edge == EdgeName::u_max;
          other = u_fixed ? node(its, last, s) : node(its, s, last);
        }
        unite(id, other);
      }
  }
}

template <ExactField T>
bool SharedEdges<T>::is_free(int a, int b) const {
  const MeshNode &p = nodes_[a], &q = nodes_[b];
  if (p.patch != q.patch) return false;
  for (const EdgeName e : edges_of(p)) {
    const auto of_q = edges_of(q);
    if (std::find(of_q.begin(), of_q.end(), e) == of_q.end()) continue;
    const double middle = 0.5 * (along(p, e) + along(q, e));
    bool joined = false;
    for (const Side& side : sides_[index(p.patch, e)]) joined = joined || partner(side, middle) >= 0;
    if (!joined) return true;
  }
  return false;
}

template class SharedEdges<Rational>;
template class SharedEdges<Quadratic>;

}  // namespace patchproof
