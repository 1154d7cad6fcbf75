// SPDX-License-Identifier: Apache-2.0
// The vertices of a mesh over several patches: nodes at parameters of patches, and which of them are one vertex.
//
// A node on an edge of a patch has its partners on the edges that are joined to it, at the parameters that the pairing names;
// where a partner is missing it is added. Nodes nearer than kNear (of a span) on an edge are one: where the pairings of a ring of
// edges do not close exactly, that ends the ring. How far the vertex then is from each node is measured by the caller.
#pragma once

#include <array>
#include <map>
#include <unordered_map>
#include <vector>

#include "patchproof/join/edge_match.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

constexpr double kNearNodes = 0x1p-20;

struct MeshNode {
  int patch;
  double u, v;  // in spans
};

// Parameters in spans of a direction, and their knots.
template <ExactField T>
class SpanScale {
 public:
  explicit SpanScale(std::vector<T> breaks) : breaks_(std::move(breaks)) {}
  int count() const { return static_cast<int>(breaks_.size()) - 1; }
  T knot_of(double s) const {
    const int i = std::min(std::max(static_cast<int>(s), 0), count() - 1);
    return breaks_[i] + (breaks_[i + 1] - breaks_[i]) * embed<T>(from_double(s - i));
  }
  double span_of(const T& t) const {
    int i = 0;
    while (i + 1 < count() && !(t < breaks_[i + 1])) ++i;
    return i + nearest_double(T((t - breaks_[i]) / (breaks_[i + 1] - breaks_[i])));
  }

 private:
  std::vector<T> breaks_;
};

template <ExactField T>
class SharedEdges {
 public:
  SharedEdges(const std::vector<const BsplinePatch<T, 4>*>& patches, const std::vector<Join<T>>& joins,
              const std::vector<CollapsedEdge>& collapsed);

  // The node there, made when it is missing.
  int node(int patch, double u, double v);
  // Adds what partners are missing.
  void spread();
  int vertex_of(int node) const;  // a node that stands for all that are one vertex with it
  const std::vector<MeshNode>& nodes() const { return nodes_; }
  // Whether the middle between two nodes of one edge belongs to no join.
  bool is_free(int a, int b) const;

 private:
  struct Side {
    int join;
    bool second;
  };
  struct Key {
    double u, v;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      return std::hash<double>()(k.u) * 1099511628211u ^ std::hash<double>()(k.v);
    }
  };
  int index(int patch, EdgeName edge) const { return 4 * patch + static_cast<int>(edge); }
  std::vector<EdgeName> edges_of(const MeshNode& n) const;
  static double along(const MeshNode& n, EdgeName e) {
    return e == EdgeName::u_min || e == EdgeName::u_max ? n.v : n.u;
  }
  const SpanScale<T>& scale(int patch, EdgeName e) const {
    return scales_[patch][e == EdgeName::u_min || e == EdgeName::u_max ? 1 : 0];
  }
  void unite(int a, int b);
  // The partner's parameter, or less than 0 where the join does not reach.
  double partner(const Side& side, double s) const;

  std::vector<std::array<SpanScale<T>, 2>> scales_;
  const std::vector<Join<T>>& joins_;
  std::vector<std::array<EdgeName, 2>> join_edges_;
  std::vector<std::vector<Side>> sides_;        // of each edge
  std::vector<std::map<double, int>> on_edge_;  // of each edge: the nodes along it
  std::vector<int> collapsed_;                  // of each edge: a node of it, −1: none yet, −2: not collapsed
  std::vector<std::unordered_map<Key, int, Hash>> known_;
  std::vector<MeshNode> nodes_;
  mutable std::vector<int> parent_;
  std::vector<int> waiting_;
};

}  // namespace patchproof
