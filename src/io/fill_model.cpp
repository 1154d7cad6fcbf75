// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/fill_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "patchproof/mesh/prove_fill.h"
#include "patchproof/mesh/repair_mesh.h"
#include "patchproof/mesh/split_faces.h"

namespace patchproof {
namespace {

// A rational number a little above the sine of an angle of at most 30 degrees.
Rational sine_of(double degrees) { return from_double(std::sin(degrees * std::numbers::pi / 180) * (1 + 1e-12)); }

FillRepair findings_of(const RepairedMesh& repaired, const CurveMesh& before) {
  FillRepair out{repaired.moves.size(), repaired.largest, {}, {}};
  std::set<std::string> edges;
  for (const RepairMove& move : repaired.moves) {
    const bool is_vector = move.part == RepairMove::Part::left_vector || move.part == RepairMove::Part::right_vector;
    edges.insert(before.edges[is_vector ? before.control_vectors[move.index].edge : move.edge].id);
  }
  out.edges.assign(edges.begin(), edges.end());
  for (const int v : repaired.vertices) out.vertices.push_back(before.vertices[v].id);
  return out;
}

// The largest angle between the tangent planes of faces at one node of an edge, about, in degrees.
double angle_at_nodes(const MeshTopology& topology, int edge) {
  std::map<Rational, std::vector<Vec<double, 3>>> normals;
  for (const std::vector<int>* side : {&topology.left[edge], &topology.right[edge]})
    for (const int index : *side) {
      const EdgeUse& use = topology.uses[index];
      for (const bool at_end : {false, true}) {
        const Rational& t = at_end ? use.end() : use.begin();
        const Vec<Rational, 3> n = outward_normal(topology, use, t, at_end ? use.end_derivative : use.begin_derivative);
        const Rational size = std::max({Rational(abs(n[0])), Rational(abs(n[1])), Rational(abs(n[2]))});
        normals[t].push_back({{nearest_double(n[0] / size), nearest_double(n[1] / size), nearest_double(n[2] / size)}});
      }
    }
  double largest = 0;
  for (const auto& at : normals)
    for (const Vec<double, 3>& n : at.second) {
      const Vec<double, 3>& first = at.second.front();
      const Vec<double, 3> c = cross(first, n);
      largest = std::max(largest, std::atan2(std::sqrt(dot(c, c)), dot(first, n)) * 180 / std::numbers::pi);
    }
  return largest;
}

void judge(const MeshTopology& topology, const FillProof& proof, FilledModel& out) {
  for (std::size_t i = 0; i < proof.joins.size(); ++i) {
    const MeshJoin& join = proof.joins[i];
    const Certificate& c = proof.certificates[i];
    const EdgeKind kind = topology.kinds[join.edge];
    const Verdict verdict = c.c0.verdict == Verdict::proven ? c.g1.verdict : c.c0.verdict;
    if (kind == EdgeKind::smooth) out.g1.add(verdict);
    out.joins.push_back({out.mesh.edges[join.edge].id, out.mesh.faces[join.join.patch_a].id,
                         out.mesh.faces[join.join.patch_b].id, kind, verdict, c.g1.reason, c.angle,
                         kind == EdgeKind::sharp ? angle_at_nodes(topology, join.edge) : 0});
  }
  for (std::size_t f = 0; f < proof.patches.size(); ++f) {
    out.c1.add(proof.patches[f].is_c1() ? Verdict::proven : Verdict::refuted);
    out.regular.add(proof.patches[f].regular.verdict);
    out.faces.push_back({out.mesh.faces[f].id, proof.patches[f]});
  }
}

}  // namespace

Verdict FilledModel::verdict() const {
  const VerdictTally* const all[] = {&g1, &c1, &regular};
  const auto any = [&](int VerdictTally::*count) {
    return std::any_of(std::begin(all), std::end(all), [&](const VerdictTally* t) { return t->*count > 0; });
  };
  return any(&VerdictTally::refuted)     ? Verdict::refuted
         : any(&VerdictTally::undecided) ? Verdict::undecided
                                         : Verdict::proven;
}

Result<FilledModel> fill_model(CurveMesh mesh, const FillRequest& request, const std::string& units) {
  if (request.repair_degrees && !(*request.repair_degrees >= 0 && *request.repair_degrees <= 30))
    return Error{ErrorCode::usage, "repair", "an angle from 0 to 30 degrees",
                 fmt::format("{}", *request.repair_degrees)};
  FilledModel out;
  if (request.repair_degrees) {
    Result<RepairedMesh> repaired = repair_mesh(mesh, {sine_of(*request.repair_degrees)});
    if (!repaired) return repaired.error();
    out.repair = findings_of(*repaired, mesh);
    mesh = std::move(repaired->mesh);
  }
  const std::size_t faces = mesh.faces.size();
  const std::size_t other =
      std::count_if(mesh.faces.begin(), mesh.faces.end(), [](const MeshFace& f) { return f.sides.size() != 4; });
  // Vectors across an edge become uneven in length at T-nodes, and those of a split face are T-nodes.
  const NodeScale by_mesh = other > 0 || !mesh.t_nodes.empty() ? NodeScale::rational : NodeScale::none;
  const FillOptions options{request.scale.value_or(by_mesh), request.method};
  if (other > 0) {
    Result<CurveMesh> split = split_faces(mesh, options);
    if (!split) return split.error();
    out.split = FillSplit{other, faces, split->faces.size()};
    mesh = std::move(*split);
  }
  const Result<MeshTopology> topology = analyse(mesh);
  if (!topology) return topology.error();
  Result<FilledMesh<Rational>> filled = fill_faces<Rational>(mesh, *topology, options, request.jobs);
  if (!filled) {
    Error error = filled.error();
    if (other > 0) error.message += " (edges F/0, F/1, … are those that face F was split along)";
    return error;
  }
  const FillProof proof = prove_fill(mesh, *topology, filled->patches, {}, request.jobs);
  out.mesh = std::move(mesh);
  judge(*topology, proof, out);
  out.model.units = units;
  for (std::size_t f = 0; f < out.mesh.faces.size(); ++f)
    out.model.gregory_patches.push_back({out.mesh.faces[f].id, std::move(filled->patches[f])});
  const auto count = [&](EdgeKind kind) { return std::count(topology->kinds.begin(), topology->kinds.end(), kind); };
  out.smooth = count(EdgeKind::smooth);
  out.sharp = count(EdgeKind::sharp);
  out.boundary = count(EdgeKind::boundary);
  return out;
}

std::vector<std::string> exceptions_of(const FilledModel& filled) {
  std::vector<std::string> out;
  for (const FilledJoin& join : filled.joins) {
    const std::string place = fmt::format("edge {}, faces {} and {}", join.edge, join.face_a, join.face_b);
    constexpr double kNearlySmooth = 1;  // degrees
    if (join.kind == EdgeKind::sharp)
      out.push_back(fmt::format(
          "{}: sharp, its faces' tangent planes are {:.2g} degrees apart at a node{}; largest angle in [{:.5g}, "
          "{:.5g}] degrees",
          place, join.angle_at_nodes, join.angle_at_nodes < kNearlySmooth ? " (--repair would make them one)" : "",
          join.angle.lower, join.angle.upper));
    else if (join.verdict != Verdict::proven)
      out.push_back(fmt::format("{}: G1 {}: {}", place, to_string(join.verdict), join.reason));
  }
  for (const FilledFace& face : filled.faces) {
    const GregoryProof& p = face.proof;
    if (!p.is_c1())
      out.push_back(fmt::format("face {}: C1 refuted: {}", face.face,
                                !p.c1 ? "the derivatives across a knot line jump" : "the three surfaces do not fit"));
    if (p.regular.verdict != Verdict::proven)
      out.push_back(fmt::format("face {}: regular {}: {}", face.face, to_string(p.regular.verdict), p.regular.reason));
  }
  return out;
}

}  // namespace patchproof
