// SPDX-License-Identifier: Apache-2.0
// Curve meshes filled with Gregory patches.
#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "model.h"

namespace patchproof::python {
namespace {

py::object proofs(const std::size_t (&counts)[3]) {
  return member("_values", "Proofs")(counts[0], counts[1], counts[2]);
}

py::tuple fill_text(const py::object& text, const std::string& name, std::optional<double> repair,
                    const py::object& decimals, int jobs, const py::object& progress) {
  if (!py::isinstance<py::str>(text) && !py::isinstance<py::bytes>(text))
    throw py::type_error("text: str or bytes are needed, not " + std::string(py::str(py::type::of(text))));
  const auto bytes = utf8(text);
  auto options = sized<patchproof_fill_options>();
  options.decimals = decimals_of(decimals);
  if (repair) options.repairs = 1, options.repair_angle = *repair;
  options.jobs = jobs;
  auto found = sized<patchproof_fill_summary>();
  Progress watch(progress);
  ModelHandle made;
  watch.call([&](patchproof_context* context) {
    patchproof_model* model = nullptr;
    const patchproof_status status =
        patchproof_fill(context, view(bytes), view(name), &options, watch.callback(), &model, &found);
    if (model != nullptr) made = own(model);
    return status;
  });
  const py::object summary = member("_values", "FillSummary")(
      py::arg("faces") = found.faces, py::arg("smooth_edges") = found.smooth_edges,
      py::arg("sharp_edges") = found.sharp_edges, py::arg("boundary_edges") = found.boundary_edges,
      py::arg("g1") = proofs(found.g1), py::arg("c1") = proofs(found.c1), py::arg("regular") = proofs(found.regular),
      py::arg("findings") = lines_of(found.findings));
  return py::make_tuple(std::make_shared<Model>(std::move(made)), summary);
}

py::tuple fill(const py::object& path, std::optional<double> repair, const py::object& decimals, int jobs,
               const py::object& progress) {
  const py::module_ os = py::module_::import("os");
  const auto name = os.attr("fsdecode")(path);
  py::object bytes;
  try {
    const py::object file = py::module_::import("io").attr("open")(path, "rb");
    bytes = file.attr("read")();
    file.attr("close")();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_OSError)) throw;
    const py::object type = member("_errors", "Error");
    const py::object raised = type("cannot_open", name, error.value().attr("strerror"), "");
    PyErr_SetObject(type.ptr(), raised.ptr());
    throw py::error_already_set();
  }
  const auto encoded = os.attr("fsencode")(path).cast<std::string>();
  return fill_text(bytes, encoded, repair, decimals, jobs, progress);
}

}  // namespace

void bind_fill(py::module_& module) {
  module.def("fill", &fill, py::arg("path"), py::arg("repair") = py::none(), py::kw_only(),
             py::arg("decimals") = "exact", py::arg("jobs") = 0, py::arg("progress") = py::none(),
             R"(fill(path, repair=None, *, decimals='exact', jobs=0, progress=None)
--

Fills the curve mesh in a file (docs/formats.md, "Curve meshes") with one Gregory patch for each face, and proves that they
join: (Model, FillSummary).

repair    degrees: what misses the conditions of a smooth filling by at most this is first made exact; None: nothing
          is moved, an edge whose faces miss one tangent plane counts as sharp (see findings), and the rest is an Error
decimals  "exact" or "binary64", as those of read
jobs      threads; 0: one for each processor
progress  a function of (done, all), as that of certify)");
  module.def("fill_text", &fill_text, py::arg("text"), py::arg("name") = "text", py::arg("repair") = py::none(),
             py::kw_only(), py::arg("decimals") = "exact", py::arg("jobs") = 0, py::arg("progress") = py::none(),
             R"(fill_text(text, name='text', repair=None, *, decimals='exact', jobs=0, progress=None)
--

As fill, from the text (str or bytes) of such a file; `name` stands in errors.)");
}

}  // namespace patchproof::python
