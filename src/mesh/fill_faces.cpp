// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/fill_faces.h"

#include <algorithm>
#include <concepts>
#include <functional>
#include <type_traits>

#include "patchproof/parallel.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/tracked.h"

namespace patchproof {
namespace {

template <Field R>
using Row = Piecewise<R, 4, Rational>;

// Intervals need the rounding of the thread they are computed in; Tracked and double need the usual one.
struct NoGuard {};
template <class R>
using GuardFor = std::conditional_t<std::same_as<R, Interval>, RoundingGuard, NoGuard>;

template <Field R, std::size_t M, std::size_t N>
Piecewise<R, M, Rational> embedded(const Piecewise<Rational, N>& f) {
  Piecewise<R, M, Rational> out;
  for (const BezierPiece<Rational, N>& piece : f) {
    out.push_back({piece.begin, piece.end, {}});
    for (const Vec<Rational, N>& p : piece.points) {
      Vec<R, M> point;
      for (std::size_t c = 0; c < N; ++c) point[c] = embed<R>(p[c]);
      out.back().points.push_back(point);
    }
  }
  return out;
}

bool is_zero(const Piecewise<Rational, 1>& f) {
  return std::all_of(f.begin(), f.end(), [](const auto& piece) {
    return std::all_of(piece.points.begin(), piece.points.end(), [](const auto& p) { return p[0] == 0; });
  });
}

template <Field R>
Row<R> cross_derivative(const MeshTopology& topology, const EdgeConnection& connection, const EdgeUse& use,
                        const UseConnection& of_use) {
  const Rational &begin = use.begin(), &end = use.end();
  const Piecewise<R, 1, Rational> k = embedded<R, 1>(of_use.k);
  const Row<R> along_a =
      product(scale(R(use.is_left() ? 1 : -1), k), embedded<R, 4>(window(connection.basis, begin, end)));
  if (is_zero(of_use.h)) return along_a;
  const Row<R> tangent = embedded<R, 4>(window(derivative(topology.curves[use.edge]), begin, end));
  return sum(along_a, product(embedded<R, 1>(of_use.h), tangent));
}

template <Field R>
Row<R> given_cross_derivative(const GivenDerivatives& given) {
  std::vector<Vec<R, 4>> vectors;
  for (const Vec<Rational, 3>& d : given.vectors)
    vectors.push_back({{embed<R>(d[0]), embed<R>(d[1]), embed<R>(d[2]), R(0)}});
  return node_field(given.places, vectors);
}

// The weights of every control point.
template <Field R>
std::vector<R> weights(const Row<R>& row) {
  std::vector<R> out;
  for (const auto& piece : row)
    for (const Vec<R, 4>& p : piece.points) out.push_back(p[3]);
  return out;
}

// boundary + D/3, with as much of the boundary added as positive weights need.
template <Field R>
Result<Row<R>> inner_row(const Row<R>& boundary, const Row<R>& derivative) {
  const Row<R> row = sum(boundary, scale(R(1) / R(3), derivative));
  const Row<R> base = elevate(refine(boundary, breaks(row)), row.front().degree());
  const std::optional<R> m = detail::gauge(weights<R>(row), weights<R>(base));
  if (!m) return Error{ErrorCode::bad_weight, "", "the signs of the weights of an inner row cannot be told", ""};
  if constexpr (OrderedField<R>)
    if (*m == R(0)) return row;
  return sum(row, scale(*m, base));
}

// Four rows on common knots, as a surface whose rows run along v (the U
// surface) or along u.
template <Field R>
BsplinePatch<R, 4> surface(std::array<Row<R>, 4> rows, Direction along, FillMethod method) {
  using K = knot_scalar_t<R>;
  std::vector<Rational> all;
  int degree = 3;
  for (const Row<R>& row : rows) {
    all = common_breaks(all, breaks(row));
    degree = std::max(degree, row.front().degree());
  }
  std::vector<BsplineCurve<R, 4, Rational>> curves;
  for (const Row<R>& row : rows)
    curves.push_back(joined(elevate(refine(row, all), degree), method == FillMethod::c1 ? degree - 1 : degree));
  std::vector<K> knots;
  for (const Rational& t : curves[0].knots().knots()) knots.push_back(embed<K>(t));
  const KnotVector<K> of_rows = KnotVector<K>::make_unchecked(degree, std::move(knots));
  const KnotVector<K> across = KnotVector<K>::bezier(3);
  std::vector<Vec<R, 4>> net;
  const std::size_t n = curves[0].points().size();
  for (std::size_t k = 0; k < 4 * n; ++k)
    net.push_back(along == Direction::v ? curves[k / n].points()[k % n] : curves[k % 4].points()[k / 4]);
  return along == Direction::v ? BsplinePatch<R, 4>(across, of_rows, std::move(net))
                               : BsplinePatch<R, 4>(of_rows, across, std::move(net));
}

template <Field R>
Result<GregoryPatch<R>> fill_face(const MeshTopology& topology, const std::vector<FilledUse<R>>& uses, int face,
                                  FillMethod method) {
  std::array<Row<R>, 4> boundary, inner;
  for (int s = 0; s < 4; ++s) {
    const int index = topology.uses_of_face[face][s];
    const EdgeUse& use = topology.uses[index];
    // Sides 2 and 3 run against u and v.
    const Rational &first = s < 2 ? use.from : use.to, &last = s < 2 ? use.to : use.from;
    boundary[s] = part(embedded<R, 4>(topology.curves[use.edge]), first, last);
    Result<Row<R>> row = inner_row<R>(boundary[s], part(uses[index].derivative, first, last));
    if (!row) return row.error();
    inner[s] = std::move(*row);
  }
  return GregoryPatch<R>::make(surface<R>({boundary[3], inner[3], inner[1], boundary[1]}, Direction::v, method),
                               surface<R>({boundary[0], inner[0], inner[2], boundary[2]}, Direction::u, method));
}

// The first error in the order of the items.
std::optional<Error> first_error(std::size_t count, int jobs,
                                 const std::function<std::optional<Error>(std::size_t)>& item) {
  std::vector<std::optional<Error>> errors(count);
  for_each_item(jobs, count, [&](std::size_t i) { errors[i] = item(i); });
  for (std::optional<Error>& error : errors)
    if (error) return std::move(error);
  return std::nullopt;
}

}  // namespace

template <Field R>
Result<FilledMesh<R>> fill_faces(const CurveMesh& mesh, const MeshTopology& topology, const FillOptions& options,
                                 int jobs) {
  FilledMesh<R> out;
  out.connections.resize(mesh.edges.size());
  out.uses.resize(topology.uses.size());
  const auto edge = [&](std::size_t e) -> std::optional<Error> {
    [[maybe_unused]] const GuardFor<R> guard;
    std::optional<EdgeConnection>& connection = out.connections[e];
    if (topology.kinds[e] == EdgeKind::smooth) {
      Result<EdgeConnection> made = connect_edge(mesh, topology, static_cast<int>(e), options);
      if (!made) return made.error();
      connection = std::move(*made);
    }
    for (const std::vector<int>* side : {&topology.left[e], &topology.right[e]})
      for (const int index : *side) {
        const EdgeUse& use = topology.uses[index];
        FilledUse<R>& filled = out.uses[index];
        if (!connection) {
          filled.derivative = given_cross_derivative<R>(given_derivatives(mesh, topology, use));
          continue;
        }
        filled.connection = connect_use(mesh, topology, *connection, use, options);
        filled.derivative = cross_derivative<R>(topology, *connection, use, *filled.connection);
      }
    return std::nullopt;
  };
  if (std::optional<Error> error = first_error(mesh.edges.size(), jobs, edge)) return std::move(*error);

  std::vector<std::optional<GregoryPatch<R>>> patches(mesh.faces.size());
  const auto face = [&](std::size_t f) -> std::optional<Error> {
    [[maybe_unused]] const GuardFor<R> guard;
    Result<GregoryPatch<R>> patch = fill_face<R>(topology, out.uses, static_cast<int>(f), options.method);
    if (!patch) {
      Error error = patch.error();
      error.where = "face " + mesh.faces[f].id;
      return error;
    }
    patches[f] = std::move(*patch);
    return std::nullopt;
  };
  if (std::optional<Error> error = first_error(mesh.faces.size(), jobs, face)) return std::move(*error);
  for (std::optional<GregoryPatch<R>>& patch : patches) out.patches.push_back(std::move(*patch));
  return out;
}

template Result<FilledMesh<Rational>> fill_faces(const CurveMesh&, const MeshTopology&, const FillOptions&, int);
template Result<FilledMesh<double>> fill_faces(const CurveMesh&, const MeshTopology&, const FillOptions&, int);
template Result<FilledMesh<Tracked>> fill_faces(const CurveMesh&, const MeshTopology&, const FillOptions&, int);
template Result<FilledMesh<Interval>> fill_faces(const CurveMesh&, const MeshTopology&, const FillOptions&, int);

}  // namespace patchproof
