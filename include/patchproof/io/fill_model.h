// SPDX-License-Identifier: Apache-2.0
// From a mesh of curves to a model of Gregory patches, one for each face, with the proof of how they join.
//
//   repair   only on request: what rounding has missed is made exact (mesh/repair_mesh.h)
//   split    faces of three, five and more sides become faces of four (mesh/split_faces.h)
//   fill     a Gregory patch for each face (mesh/fill_faces.h)
//   prove    every edge between two faces, and every patch by itself (mesh/prove_fill.h)
//
// ENSURES   (1) model: one Gregory patch for each face of `mesh`, in its order and with its id as name;  (2) `mesh` is the
//           mesh that was given, repaired and split where that was asked for or needed, and else itself;  (3) joins: one for
//           each piece of an edge that two faces share, in the order of the edges, with the certificate's verdict: of G1, or of
//           C0 where that is not proven;  (4) the tallies count: g1 the joins of smooth edges, c1 and regular the faces;
//           (5) the result does not depend on the number of threads.
// ERRORS    usage: a repair angle that is not between 0 and 30 degrees; those of repair_mesh, split_faces, analyse, fill_faces,
//           whose `where` names an edge, face or vertex by its id. What is refuted is no error but a finding. Throws
//           stop_requested or deadline_passed under a StopScope that is raised.
// COST      about 3 ms for each face.
// NEIGHBOURS curve_mesh_file.h (reads meshes), write.h (writes models), report.h (certifies any model).
// TEST      tests/io/fill_model_test.cpp checks (1)–(5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"
#include "patchproof/join/certificate.h"
#include "patchproof/join/gregory_proof.h"
#include "patchproof/mesh/curve_mesh.h"
#include "patchproof/mesh/edge_connection.h"

namespace patchproof {

struct FillRequest {
  FillMethod method = FillMethod::c1;
  std::optional<NodeScale> scale;        // empty: rational where there are T-nodes or faces to be split, else none
  std::optional<double> repair_degrees;  // within how much what is nearly exact is made so; empty: nothing is
  int jobs = 0;                          // threads; 0: one for each processor
};

struct FillRepair {
  std::size_t moved = 0;              // points, weights and vectors
  double largest = 0;                 // how far at most, in units of the mesh
  std::vector<std::string> edges;     // whose points or vectors moved, sorted
  std::vector<std::string> vertices;  // whose tangents are farther from one plane, and stayed
};

struct FillSplit {
  std::size_t faces = 0;              // not of four sides
  std::size_t before = 0, after = 0;  // of all faces
};

// A piece of an edge between two faces.
struct FilledJoin {
  std::string edge, face_a, face_b;  // ids
  EdgeKind kind = EdgeKind::smooth;  // smooth or sharp
  Verdict verdict = Verdict::undecided;
  std::string reason;     // where it is not proven
  EnclosedMaximum angle;  // largest angle between the normals along it, in degrees
  // Of a sharp edge: the largest angle between tangent planes of faces at a node, about, in degrees.
  double angle_at_nodes = 0;
};

struct FilledFace {
  std::string face;  // id
  GregoryProof proof;
};

struct VerdictTally {
  int proven = 0, refuted = 0, undecided = 0;
  void add(Verdict verdict) {
    ++(verdict == Verdict::proven ? proven : verdict == Verdict::refuted ? refuted : undecided);
  }
};

struct FilledModel {
  Model<Rational> model;
  CurveMesh mesh;
  std::optional<FillRepair> repair;
  std::optional<FillSplit> split;
  std::size_t smooth = 0, sharp = 0, boundary = 0;  // edges of `mesh`
  std::vector<FilledJoin> joins;
  std::vector<FilledFace> faces;
  VerdictTally g1, c1, regular;

  // Of all three tallies together: refuted where anything is, proven where everything is.
  Verdict verdict() const;
};

Result<FilledModel> fill_model(CurveMesh mesh, const FillRequest& request = {}, const std::string& units = "");

// One line for each sharp edge, and for each join and face of which not everything is proven.
std::vector<std::string> exceptions_of(const FilledModel& filled);

}  // namespace patchproof
