// SPDX-License-Identifier: Apache-2.0
#include "io/drawing_patches.h"
#include "patchproof/mesh/tessellate_transfinite.h"

namespace patchproof {

template <ExactField T>
std::size_t face_spans(const TransfiniteMap<T, 3, 4>& map) {
  std::array<std::size_t, 3> n{};
  for (std::size_t s = 0; s < 3; ++s) n[s] = breaks(map, s).size() - 1;
  return 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]);
}

namespace {

// The six faces of the grid: for each axis and end, the vertices with the other two indices running.
void add_faces(std::vector<Tessellation<2>>& faces, const Tessellation<3>& solid) {
  std::array<std::size_t, 3> count{1, 1, 1}, stride{1, 1, 1};
  const auto& x = solid.parameters;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    stride[axis] = axis == 0 ? 1 : stride[axis - 1] * count[axis - 1];
    while (count[axis] * stride[axis] < x.size() &&
           x[count[axis] * stride[axis]][axis] > x[(count[axis] - 1) * stride[axis]][axis])
      ++count[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::size_t end : {std::size_t{0}, count[axis] - 1}) {
      const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
      Tessellation<2> face{{CellKind::cuboid, 2, {}, {}}, {}, {}};
      for (std::size_t j = 0; j < count[b]; ++j)
        for (std::size_t i = 0; i < count[a]; ++i) {
          const std::size_t v = end * stride[axis] + i * stride[a] + j * stride[b];
          face.mesh.vertices.push_back(solid.mesh.vertices[v]);
          face.parameters.push_back({{x[v][a], x[v][b]}});
        }
      const std::array shape{static_cast<int>(count[a]) - 1, static_cast<int>(count[b]) - 1};
      face.mesh.corners = detail::grid_cuboids(shape);
      faces.push_back(std::move(face));
    }
}

}  // namespace

template <ExactField T>
Result<PatchDrawing> draw_solid(const ModelSolid<T>& model, int index, int cells) {
  PatchDrawing out;
  out.is_solid = true;
  out.name = title_of("solid", index, model.name);
  out.cells = {cells, cells};
  const auto pieces = tessellate(model.map, cells);
  if (!pieces) return Error{pieces.error().code, out.name, pieces.error().message, pieces.error().where};
  for (const Tessellation<3>& piece : *pieces) add_faces(out.pieces, piece);
  return out;
}

template std::size_t face_spans(const TransfiniteMap<Rational, 3, 4>&);
template std::size_t face_spans(const TransfiniteMap<Quadratic, 3, 4>&);
template Result<PatchDrawing> draw_solid(const ModelSolid<Rational>&, int, int);
template Result<PatchDrawing> draw_solid(const ModelSolid<Quadratic>&, int, int);

}  // namespace patchproof
