// SPDX-License-Identifier: Apache-2.0
// How the faces on both sides of a mesh edge are made to join: one vector field across the edge that all of them share, and
// for each of them the multiples of it and of the edge's tangent that its cross-boundary derivative consists of.
//
//   b(t) = ± k(t) a(t) + h(t) c(t)        + to the left of the edge, − to its right;  k > 0;  c = C′, the edge's tangent
//   a     the basis patch: a C¹ field through a vector at each node of the edge
//           end              b_L − b_R, the derivatives into the left and the right face
//           T-node           derivatives of the edges that leave to the left, less those that leave to the right
//           control vectors  d_L − d_R
//         one interval: linear; two: one parabola; more: cubic Hermite pieces with Bessel's slopes
//   k     linear over the range of the face, from the derivative given at one end of it to that at the other
//   h     likewise, without knots of the edge and nodes inside the range; with them (1−t)² and t² times the end values over the
//         first and the last interval, and 0 between
//
// Homogeneous: D = ± w k (a, 0) + h C^h′ with w k linear. Both sides then lie in the plane of a and c at every t: the join is G¹
// wherever a × c ≠ 0; and D is C¹ where the edge is C¹.
//
// REQUIRES  a topology of this mesh.
// ENSURES   (1) at the ends of a face's range b is the derivative prescribed there;  (2) k > 0;  (3) a is C¹, and at every node
//           the node's vector;  (4) a × c has no zero on [0, 1] (a proof by Bernstein coefficients and subdivision);
//           (5) NodeScale::rational divides each node vector by its length, rounded down to a multiple of 2^-16 (shorter
//           ones of 2^-32, 2^-48, …);
//           (6) FillMethod::former: a, k and h piecewise linear, so that D is continuous only;
//           (7) no_zero: true only when the polynomial vector has no zero on [0, 1].
// ERRORS    for smooth edges: control_vector_missing, control_vectors_bent, control_vector_along, control_vector_differs,
//           basis_along_edge.
// SCALARS   Rational; node_field: Field.
// SOURCE    as curve_mesh.h; the sum b = k a + h c, the closed form of k and the choice of h: docs/mathematics.md.
// TEST      tests/mesh/edge_connection_test.cpp checks (1)–(7).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/mesh/curve_mesh.h"

namespace patchproof {

enum class NodeScale { none, rational };
// former: as in the authors' earlier papers, without C¹ inside the faces; for comparison.
enum class FillMethod { c1, former };

struct FillOptions {
  NodeScale scale = NodeScale::none;
  FillMethod method = FillMethod::c1;
};

// Of one use of a smooth edge, over its range.
struct UseConnection {
  Piecewise<Rational, 1> k, h;  // k: of the homogeneous derivative, w times that of the affine one at the ends
};

struct EdgeConnection {
  std::vector<Rational> places;           // of the nodes, from 0 to 1
  std::vector<Vec<Rational, 3>> vectors;  // at them
  Piecewise<Rational, 3> basis;           // a
};

// The connection of a smooth edge. REQUIRES kinds[edge] == smooth.
Result<EdgeConnection> connect_edge(const CurveMesh& mesh, const MeshTopology& topology, int edge,
                                    const FillOptions& options = {});
// And of one of its uses.
UseConnection connect_use(const CurveMesh& mesh, const MeshTopology& topology, const EdgeConnection& connection,
                          const EdgeUse& use, const FillOptions& options = {});

// For a use of a boundary or a sharp edge: where its derivative is given, and w times these derivatives.
struct GivenDerivatives {
  std::vector<Rational> places;
  std::vector<Vec<Rational, 3>> vectors;
};
GivenDerivatives given_derivatives(const CurveMesh& mesh, const MeshTopology& topology, const EdgeUse& use);

bool no_zero(const std::vector<Vec<Rational, 3>>& coefficients);

// The field through vectors at increasing places, as described above; linear between them when not smooth.
// REQUIRES at least two places.
template <Field T, std::size_t N>
Piecewise<T, N, Rational> node_field(const std::vector<Rational>& places, const std::vector<Vec<T, N>>& vectors,
                                     bool smooth = true);

// ---------------------------------------------------------------------------------------------------------------------

template <Field T, std::size_t N>
Piecewise<T, N, Rational> node_field(const std::vector<Rational>& places, const std::vector<Vec<T, N>>& vectors,
                                     bool smooth) {
  const std::size_t m = places.size() - 1;
  PATCHPROOF_REQUIRES(places.size() >= 2 && places.size() == vectors.size(), "node_field: a vector at each place");
  Piecewise<T, N, Rational> out;
  if (m == 1 || !smooth) {
    for (std::size_t i = 0; i < m; ++i) out.push_back({places[i], places[i + 1], {vectors[i], vectors[i + 1]}});
    return out;
  }
  std::vector<Vec<T, N>> chords, slopes(m + 1);
  for (std::size_t i = 0; i < m; ++i)
    chords.push_back(knot_rate<T>(1, places[i], places[i + 1]) * (vectors[i + 1] - vectors[i]));
  for (std::size_t i = 1; i < m; ++i)  // of the parabola through three vectors
    slopes[i] = between(knot_ratio<T>(places[i], places[i - 1], places[i + 1]), chords[i - 1], chords[i]);
  slopes[0] = T(2) * chords[0] - slopes[1];
  slopes[m] = T(2) * chords[m - 1] - slopes[m - 1];
  const T share = T(1) / T(m == 2 ? 2 : 3);
  for (std::size_t i = 0; i < m; ++i) {
    const T step = share * embed<T>(Rational(places[i + 1] - places[i]));
    BezierPiece<T, N, Rational> piece{places[i], places[i + 1], {vectors[i], vectors[i] + step * slopes[i]}};
    if (m > 2) piece.points.push_back(vectors[i + 1] - step * slopes[i + 1]);
    piece.points.push_back(vectors[i + 1]);
    out.push_back(std::move(piece));
  }
  return out;
}

}  // namespace patchproof
