// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "c_api/models.h"
#include "c_api/watch.h"
#include "patchproof/io/tessellate_model.h"

namespace patchproof::c_api {
namespace {

struct MeshContent {
  CertifiedMesh mesh;
  Watertight watertight;
  std::string notes;  // one to a line
};

MeshContent content_of_mesh(ModelMesh made) {
  MeshContent out{std::move(made.mesh), {}, {}};
  out.watertight = check_watertight(out.mesh);
  for (const std::vector<std::string>* notes : {&made.notes, &out.mesh.notes})
    for (const std::string& note : *notes) out.notes += note + "\n";
  return out;
}

MeshRequest mesh_request(const patchproof_tessellate_options& o) {
  MeshRequest out;
  if (!(o.chord > 0 && std::isfinite(o.chord)))
    bad_argument("options.chord", "is no finite number above 0", std::to_string(o.chord));
  if (!(o.angle >= 0 && o.angle <= 180))
    bad_argument("options.angle", "is no number of degrees from 0 to 180", std::to_string(o.angle));
  require_value(o.jobs, 1024, "options.jobs");
  out.chord = o.chord;
  if (o.angle > 0) out.angle = o.angle;
  if (o.max_triangles > 0) out.max_triangles = o.max_triangles;
  out.jobs = o.jobs;
  return out;
}

// Lists of three and of one number for each item.
template <class Number, class Items, class At>
void write_items(const Items& items, std::size_t width, Number* out, std::size_t length, const char* name, bool write,
                 const At& at) {
  if (out == nullptr) return;
  if (!write && length != width * items.size())
    bad_argument(std::string(name) + "_length", "there are " + std::to_string(width * items.size()) + " numbers",
                 std::to_string(length));
  if (!write) return;
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t k = 0; k < width; ++k) out[width * i + k] = at(items[i], k);
}

constexpr MeshFormat kFormats[] = {MeshFormat::stl, MeshFormat::obj, MeshFormat::ply, MeshFormat::glb, MeshFormat::vtu};

}  // namespace
}  // namespace patchproof::c_api

struct patchproof_mesh : patchproof::c_api::Handle<patchproof::c_api::MeshContent> {
  using Handle::Handle;
};

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_tessellate(patchproof_context* context, const patchproof_model* model,
                                        const patchproof_tessellate_options* options,
                                        const patchproof_callback* callback, patchproof_mesh** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    require_place(options, "options");
    const ModelFile& file = content_of(model, "model").file;
    const patchproof_tessellate_options o = options_of(options, "options");
    require_value(o.method, PATCHPROOF_METHOD_REGULAR, "options.method");
    const MeshRequest request = mesh_request(o);
    Progress progress;
    std::optional<ModelMesh> made;
    watch(callback, progress, [&] {
      made = take(tessellate_model(
          file, request, o.method == PATCHPROOF_METHOD_ADAPTIVE ? CellMethod::adaptive : CellMethod::regular));
    });
    hand_over(context, content_of_mesh(std::move(*made)), out);
  });
}

patchproof_status patchproof_mesh_free(patchproof_mesh* mesh) noexcept { return free_handle(mesh); }

patchproof_status patchproof_mesh_get_info(patchproof_context* context, const patchproof_mesh* mesh,
                                           patchproof_mesh_info* out) noexcept {
  return call(context, [&] {
    const MeshContent& content = content_of(mesh, "mesh");
    const CertifiedMesh& m = content.mesh;
    const Watertight& w = content.watertight;
    patchproof_mesh_info info{};
    info.vertices = m.vertices.size();
    info.triangles = m.triangles.size();
    info.chord = m.chord;
    info.angle = m.angle;
    info.chord_misses = m.chord_misses;
    info.angle_misses = m.angle_misses;
    info.free_edges = w.free;
    info.cracks = w.cracks;
    info.branching_edges = w.branching;
    info.oriented = w.oriented ? 1 : 0;
    info.notes = borrowed(content.notes);
    write_struct(out, info, "out");
  });
}

patchproof_status patchproof_mesh_get_data(patchproof_context* context, const patchproof_mesh* mesh, double* vertices,
                                           size_t vertices_length, int32_t* triangles, size_t triangles_length,
                                           int32_t* patches, size_t patches_length) noexcept {
  return call(context, [&] {
    const CertifiedMesh& m = content_of(mesh, "mesh").mesh;
    for (const bool write : {false, true}) {  // all lengths are looked at before anything is written
      write_items(m.vertices, 3, vertices, vertices_length, "vertices", write,
                  [](const Vec<double, 3>& v, std::size_t k) { return v[k]; });
      write_items(m.triangles, 3, triangles, triangles_length, "triangles", write,
                  [](const std::array<int, 3>& t, std::size_t k) { return t[k]; });
      write_items(m.faces, 1, patches, patches_length, "patches", write, [](int f, std::size_t) { return f; });
    }
  });
}

patchproof_status patchproof_mesh_write(patchproof_context* context, const patchproof_mesh* mesh, int32_t format,
                                        char* buffer, size_t length, size_t* needed) noexcept {
  return call(context, [&] {
    const CertifiedMesh& m = content_of(mesh, "mesh").mesh;
    require_value(format, PATCHPROOF_MESH_VTU, "format");
    write_text(take(write_mesh(m, "patchproof", kFormats[format])), buffer, length, needed);
  });
}
