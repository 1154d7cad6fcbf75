// SPDX-License-Identifier: Apache-2.0
// Triangles with a proved error, as arrays.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "model.h"

namespace patchproof::python {
namespace {

struct Mesh {
  explicit Mesh(MeshHandle made) : handle(std::move(made)), info(sized<patchproof_mesh_info>()) {
    call([&](patchproof_context* context) { return patchproof_mesh_get_info(context, handle.get(), &info); });
  }
  MeshHandle handle;
  patchproof_mesh_info info;
  py::object vertices, triangles, patches;  // read-only arrays, made when they are first asked for
};
using SharedMesh = std::shared_ptr<Mesh>;

template <class T>
py::object cached_array(const Mesh& mesh, py::object& cached, std::vector<py::ssize_t> shape) {
  if (cached) return cached;
  py::array_t<T> out(std::move(shape));
  const auto length = static_cast<std::size_t>(out.size());
  T* const data = out.mutable_data();
  call([&](patchproof_context* context) {
    if constexpr (std::is_same_v<T, double>)
      return patchproof_mesh_get_data(context, mesh.handle.get(), data, length, nullptr, 0, nullptr, 0);
    else if (&cached == &mesh.triangles)
      return patchproof_mesh_get_data(context, mesh.handle.get(), nullptr, 0, data, length, nullptr, 0);
    else
      return patchproof_mesh_get_data(context, mesh.handle.get(), nullptr, 0, nullptr, 0, data, length);
  });
  out.attr("setflags")(py::arg("write") = false);
  if (!cached) cached = out;
  return cached;
}

py::bytes to_bytes(const Mesh& mesh, const py::object& format) {
  const std::int32_t which = choose(format, {"stl", "obj", "ply", "glb", "vtu"}, "format");
  const std::size_t guess = 4096 + 100 * mesh.info.triangles;
  return py::bytes(
      written(guess, [&](patchproof_context* context, char* buffer, std::size_t length, std::size_t* needed) {
        return patchproof_mesh_write(context, mesh.handle.get(), which, buffer, length, needed);
      }));
}

void write(const Mesh& mesh, const py::object& path, const py::object& format) {
  const py::module_ os_path = py::module_::import("os.path");
  const py::object name = py::module_::import("os").attr("fsdecode")(path);
  const py::tuple parts = os_path.attr("splitext")(name);
  const py::object by_name = parts[1].attr("lower")().attr("lstrip")(".");
  const py::bytes bytes = to_bytes(mesh, format.is_none() ? by_name : format);
  const py::object file = py::module_::import("io").attr("open")(path, "wb");
  try {
    file.attr("write")(bytes);
  } catch (...) {
    file.attr("close")();
    throw;
  }
  file.attr("close")();
}

SharedMesh tessellate(const Model& model, double chord, std::optional<double> angle,
                      std::optional<std::size_t> max_triangles, const py::object& method, int jobs,
                      const py::object& progress) {
  auto options = sized<patchproof_tessellate_options>();
  if (!(chord > 0)) throw py::value_error("chord: a positive length is needed");
  options.chord = chord;
  if (angle && !(*angle > 0)) throw py::value_error("angle: positive degrees are needed, or None");
  options.angle = angle.value_or(0);
  if (max_triangles == 0u) throw py::value_error("max_triangles: a positive number is needed, or None");
  options.max_triangles = max_triangles.value_or(0);
  options.method = choose(method, {"adaptive", "regular"}, "method");
  options.jobs = jobs;
  Progress watch(progress);
  MeshHandle made;
  watch.call([&](patchproof_context* context) {
    patchproof_mesh* mesh = nullptr;
    const patchproof_status status =
        patchproof_tessellate(context, model.handle.get(), &options, watch.callback(), &mesh);
    made.reset(mesh);
    return status;
  });
  return std::make_shared<Mesh>(std::move(made));
}

bool is_watertight(const Mesh& m) { return m.info.cracks == 0 && m.info.branching_edges == 0; }

}  // namespace

void bind_tessellate(py::module_& module) {
  py::class_<Mesh, SharedMesh> mesh(
      module, "Mesh", py::is_final(),
      "Triangles whose distance from the surface is proved. Lengths are in the model's units.");
  forbid_construction(mesh);
  forbid_pickling(mesh, "a Mesh cannot be pickled: keep its arrays, or mesh.to_bytes(\"ply\")");
  mesh.def_property_readonly(
      "vertices",
      [](Mesh& m) {
        return cached_array<double>(m, m.vertices, {static_cast<py::ssize_t>(m.info.vertices), 3});
      },
      "A read-only float64 array (n, 3).");
  mesh.def_property_readonly(
      "triangles",
      [](Mesh& m) {
        return cached_array<std::int32_t>(m, m.triangles, {static_cast<py::ssize_t>(m.info.triangles), 3});
      },
      "Three numbers of vertices each, a read-only int32 array (m, 3).");
  mesh.def_property_readonly(
      "patches",
      [](Mesh& m) { return cached_array<std::int32_t>(m, m.patches, {static_cast<py::ssize_t>(m.info.triangles)}); },
      "The patch that each triangle belongs to, a read-only int32 array (m,).");
  const auto number = [&](const char* name, auto patchproof_mesh_info::*which, const char* doc) {
    mesh.def_property_readonly(
        name, [which](Mesh& m) { return m.info.*which; }, doc);
  };
  number("chord", &patchproof_mesh_info::chord, "The proved distance between surface and triangles; inf: no bound.");
  number("angle", &patchproof_mesh_info::angle, "The proved angle between their normals in degrees; 180: no bound.");
  number("chord_misses", &patchproof_mesh_info::chord_misses, "Triangles for which the chord asked for is not proved.");
  number("angle_misses", &patchproof_mesh_info::angle_misses, "Triangles for which the angle asked for is not proved.");
  number("free_edges", &patchproof_mesh_info::free_edges, "Edges with one triangle, at free edges of the model.");
  number("cracks", &patchproof_mesh_info::cracks, "Edges with one triangle where the model's patches meet.");
  number("branching_edges", &patchproof_mesh_info::branching_edges, "Edges with more than two triangles.");
  mesh.def_property_readonly(
      "is_oriented", [](Mesh& m) { return m.info.oriented != 0; },
      "Whether neighbours run through their common edge in opposite directions.");
  mesh.def_property_readonly(
      "is_watertight", [](Mesh& m) { return is_watertight(m); }, "No cracks and no branching edges.");
  mesh.def_property_readonly(
      "is_closed", [](Mesh& m) { return is_watertight(m) && m.info.free_edges == 0; },
      "Watertight, without free edges.");
  mesh.def_property_readonly(
      "notes", [](Mesh& m) { return lines_of(m.info.notes); }, "Remarks, a tuple of str.");
  mesh.def("to_bytes", &to_bytes, py::arg("format"), R"(to_bytes(self, format)
--

The bytes of a file: "stl", "obj", "ply", "glb" or "vtu".)");
  mesh.def("write", &write, py::arg("path"), py::arg("format") = py::none(), R"(write(self, path, format=None)
--

Writes such a file; format None: by the extension of the path.)");
  mesh.def("__copy__", [](const py::object& m) { return m; });
  mesh.def("__deepcopy__", [](const py::object& m, const py::object&) { return m; });
  mesh.def("__repr__", [](Mesh& m) {
    const auto shown = [](double x) { return std::string(py::str(py::float_(x))); };
    return "<patchproof.Mesh: " + std::to_string(m.info.triangles) + " triangles, chord " + shown(m.info.chord) +
           ", angle " + shown(m.info.angle) + " degrees" + (is_watertight(m) ? ", watertight>" : ">");
  });

  module.def("tessellate", &tessellate, py::arg("model"), py::arg("chord"), py::arg("angle") = py::none(),
             py::kw_only(), py::arg("max_triangles") = py::none(), py::arg("method") = "adaptive", py::arg("jobs") = 0,
             py::arg("progress") = py::none(),
             R"(tessellate(model, chord, angle=None, *, max_triangles=None, method='adaptive', jobs=0, progress=None)
--

Triangles of all patches: a Mesh.

chord          the largest distance between surface and triangles, a length
angle          the largest angle between their normals in degrees; None: not asked
max_triangles  more than these are an Error; None: 2**24
method         "adaptive": as few as prove it; "regular": a grid on each patch
jobs           threads; 0: one for each processor
progress       a function of (done, all), as that of certify)");
}

}  // namespace patchproof::python
