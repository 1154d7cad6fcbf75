// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/prove_fill.h"

#include <algorithm>

#include "patchproof/join/certify.h"
#include "patchproof/parallel.h"

namespace patchproof {
namespace {

// The parameter of the patch at parameter t of the edge. Sides 2 and 3 run against u and v.
Rational patch_parameter(const EdgeUse& use, const Rational& t) {
  const Rational along = (t - use.from) / (use.to - use.from);
  return use.side < 2 ? along : Rational(1 - along);
}

IsoLine<Rational> line_of(EdgeName edge) {
  const bool at_begin = edge == EdgeName::u_min || edge == EdgeName::v_min;
  return {edge == EdgeName::u_min || edge == EdgeName::u_max ? Direction::u : Direction::v, Rational(at_begin ? 0 : 1),
          at_begin ? Side::right : Side::left};
}

MeshJoin join_of(const EdgeUse& a, const EdgeUse& b, const Rational& begin, const Rational& end) {
  MeshJoin out{a.edge, edge_of_side(a.side), edge_of_side(b.side), {}};
  const bool whole = begin == a.begin() && end == a.end() && begin == b.begin() && end == b.end();
  out.join.kind = whole ? JoinKind::isoparametric : JoinKind::t_junction;
  out.join.patch_a = a.face;
  out.join.patch_b = b.face;
  out.join.line_a = line_of(out.edge_a);
  out.join.line_b = line_of(out.edge_b);
  Rational a0 = patch_parameter(a, begin), a1 = patch_parameter(a, end), b0 = patch_parameter(b, begin),
           b1 = patch_parameter(b, end);
  if (a1 < a0) {
    std::swap(a0, a1);
    std::swap(b0, b1);
  }
  const bool same_speed = abs(a1 - a0) == abs(b1 - b0);
  out.join.pairing = {same_speed ? PairingKind::identity : PairingKind::affine, {a0, a1}, {b0, b1}, Rational(1)};
  return out;
}

}  // namespace

EdgeName edge_of_side(int side) {
  constexpr EdgeName kEdges[] = {EdgeName::v_min, EdgeName::u_max, EdgeName::v_max, EdgeName::u_min};
  return kEdges[side];
}

std::vector<MeshJoin> mesh_joins(const CurveMesh& mesh, const MeshTopology& topology) {
  std::vector<MeshJoin> out;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    auto left = topology.left[e].begin(), right = topology.right[e].begin();
    while (left != topology.left[e].end() && right != topology.right[e].end()) {
      const EdgeUse &a = topology.uses[*left], &b = topology.uses[*right];
      out.push_back(join_of(a, b, std::max(a.begin(), b.begin()), std::min(a.end(), b.end())));
      const bool both = a.end() == b.end(), a_first = a.end() < b.end();
      if (both || a_first) ++left;
      if (both || !a_first) ++right;
    }
  }
  return out;
}

FillProof prove_fill(const CurveMesh& mesh, const MeshTopology& topology,
                     const std::vector<GregoryPatch<Rational>>& patches, const Request& request, int jobs) {
  FillProof out;
  out.joins = mesh_joins(mesh, topology);
  out.certificates.resize(out.joins.size());
  for_each_item(jobs, out.joins.size(), [&](std::size_t i) {
    const MeshJoin& j = out.joins[i];
    out.certificates[i] = certify_join(carrier(patches[j.join.patch_a], j.edge_a),
                                       carrier(patches[j.join.patch_b], j.edge_b), j.join, request);
  });
  std::vector<const GregoryPatch<Rational>*> all;
  for (const GregoryPatch<Rational>& patch : patches) all.push_back(&patch);
  out.patches = prove_patches(all, jobs);
  return out;
}

}  // namespace patchproof
