// SPDX-License-Identifier: Apache-2.0
#include "model.h"

#include <pybind11/numpy.h>

#include <vector>

namespace patchproof::python {
namespace {

// Descriptions for patchproof_model_create, and the arrays and names that they point into.
struct ModelDescription {
  std::vector<patchproof_surface_data> patches;
  std::vector<patchproof_curve_data> curves;
  std::vector<patchproof_declared_join> joins;
  std::vector<py::object> kept;
  std::string units;

  const double* doubles(const py::handle& array) {
    kept.push_back(py::reinterpret_borrow<py::object>(array));
    return static_cast<const double*>(py::reinterpret_borrow<py::array>(array).data());
  }
  patchproof_text text(const py::handle& value) {
    kept.push_back(py::reinterpret_borrow<py::object>(value));
    Py_ssize_t length = 0;
    const char* const data = PyUnicode_AsUTF8AndSize(value.ptr(), &length);
    if (data == nullptr) throw py::error_already_set();
    return {data, static_cast<std::size_t>(length)};
  }
};

std::size_t size_of(const py::handle& array) { return static_cast<std::size_t>(py::len(array.attr("ravel")())); }

std::int32_t whole(const py::handle& number, const char* name) {
  const long value = PyLong_AsLong(number.ptr());
  if (value == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (value != static_cast<std::int32_t>(value)) throw py::value_error(std::string(name) + ": out of range");
  return static_cast<std::int32_t>(value);
}

void add_patch(ModelDescription& to, const py::tuple& made) {  // what _construct.patch returns
  auto data = sized<patchproof_surface_data>();
  const py::tuple degree = made[0], knots = made[1];
  data.degree_u = whole(degree[0], "degree");
  data.degree_v = whole(degree[1], "degree");
  data.knots_u = to.doubles(knots[0]), data.knots_u_length = size_of(knots[0]);
  data.knots_v = to.doubles(knots[1]), data.knots_v_length = size_of(knots[1]);
  data.points = to.doubles(made[2]), data.points_length = size_of(made[2]);
  if (!made[3].is_none()) data.weights = to.doubles(made[3]), data.weights_length = size_of(made[3]);
  data.name = to.text(made[4]);
  to.patches.push_back(data);
}

void add_curve(ModelDescription& to, const py::tuple& made) {
  auto data = sized<patchproof_curve_data>();
  data.degree = whole(made[0], "degree");
  data.knots = to.doubles(made[1]), data.knots_length = size_of(made[1]);
  data.points = to.doubles(made[2]), data.points_length = size_of(made[2]);
  if (!made[3].is_none()) data.weights = to.doubles(made[3]), data.weights_length = size_of(made[3]);
  data.name = to.text(made[4]);
  to.curves.push_back(data);
}

std::shared_ptr<Model> construct(const py::object& patches, const py::object& curves, const py::object& joins,
                                 const std::string& units) {
  const py::module_ arrays = py::module_::import("patchproof._construct");
  ModelDescription all;
  int number = 0;
  for (const auto& patch : patches) add_patch(all, arrays.attr("patch")(patch, number++));
  number = 0;
  for (const auto& curve : curves) add_curve(all, arrays.attr("curve")(curve, number++));
  number = 0;
  for (const auto& join : joins) {
    const py::tuple made = arrays.attr("join")(join, number++);
    all.joins.push_back({whole(made[0], "joins"), whole(made[1], "joins"), whole(made[2], "joins"),
                         whole(made[3], "joins"), made[4].cast<bool>() ? 1 : 0});
  }
  auto data = sized<patchproof_model_data>();
  data.patches = all.patches.data(), data.patches_length = all.patches.size();
  data.curves = all.curves.data(), data.curves_length = all.curves.size();
  data.joins = all.joins.data(), data.joins_length = all.joins.size();
  data.units = view(units);
  return make_model([&](patchproof_context* context, patchproof_model** out) {
    return patchproof_model_create(context, &data, out);
  });
}

std::string bytes_of(const py::object& text, const char* name) {
  if (!py::isinstance<py::str>(text) && !py::isinstance<py::bytes>(text))
    throw py::type_error(std::string(name) + ": str or bytes are needed, not " +
                         std::string(py::str(py::type::of(text))));
  return utf8(text);
}

std::shared_ptr<Model> read(const py::object& path, const py::object& decimals) {
  const auto name = py::module_::import("os").attr("fsencode")(path).cast<std::string>();
  const std::int32_t how = decimals_of(decimals);
  return make_model([&](patchproof_context* context, patchproof_model** out) {
    return patchproof_model_read_file(context, view(name), how, out);
  });
}

std::shared_ptr<Model> read_text(const py::object& text, const std::string& name, const py::object& decimals) {
  const std::string bytes = bytes_of(text, "text");
  const std::int32_t how = decimals_of(decimals);
  return make_model([&](patchproof_context* context, patchproof_model** out) {
    return patchproof_model_read_text(context, view(bytes), view(name), how, out);
  });
}

// All parts of a model as a tuple, which shares the model's handle and not the Python object.
template <class P, class Info>
py::object parts(py::object& cached, const Model& model, std::size_t count, const Info& get_info) {
  if (cached) return cached;
  py::tuple all(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto info = sized<patchproof_spline_info>();
    call([&](patchproof_context* context) { return get_info(context, model.handle.get(), i, &info); });
    all[i] = py::cast(std::make_shared<P>(model.handle, i, info));
  }
  cached = all;
  return cached;
}

std::string text_of(const Model& model, std::int32_t format) {
  return written(1 << 14, [&](patchproof_context* context, char* buffer, std::size_t length, std::size_t* needed) {
    return patchproof_model_write(context, model.handle.get(), format, buffer, length, needed);
  });
}

// type.tp_new: Model(…) and Model.__new__(Model, …) both make a whole one; pybind11's own leaves one with nothing in it.
PyObject* new_model(PyTypeObject*, PyObject* args, PyObject* named) {
  try {
    // Never destroyed: the interpreter ends before static objects do.
    static const py::cpp_function& make =
        *new py::cpp_function(&construct, py::name("Model"), py::arg("patches") = py::tuple(),
                              py::arg("curves") = py::tuple(), py::arg("joins") = py::tuple(), py::arg("units") = "mm");
    return PyObject_Call(make.ptr(), args, named);
  } catch (py::error_already_set& error) {
    error.restore();
    return nullptr;
  }
}
}  // namespace

Model::Model(ModelHandle made) : handle(std::move(made)), info(sized<patchproof_model_info>()) {
  call([&](patchproof_context* context) { return patchproof_model_get_info(context, handle.get(), &info); });
}

std::int32_t decimals_of(const py::object& word) { return choose(word, {"exact", "binary64"}, "decimals"); }

void forbid_construction(const py::object& type) { reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = nullptr; }

void bind_model(py::module_& module) {
  py::class_<Model, std::shared_ptr<Model>> model(module, "Model", py::is_final(),
                                                  R"(Model(patches=(), curves=(), joins=(), units='mm')
--

Patches and curves with exact numbers. A model never changes; it can be pickled (as JSON) and shared by threads.

    Model(patches=[PatchData(points, knots=(ku, kv), degree=(3, 3))])

patches  PatchData each, or patches whose numbers all are doubles; curves likewise CurveData
joins    DeclaredJoin each: whole edges that belong together. None: certify finds them from the geometry
units    a text; lengths of all results are in these units

Each double counts as exactly the number it is; numbers that are no doubles are read from texts (read_text).)");
  auto* const type = reinterpret_cast<PyTypeObject*>(model.ptr());
  type->tp_new = new_model;
  type->tp_init = [](PyObject*, PyObject*, PyObject*) { return 0; };
  model.def_property_readonly(
      "patches", [](Model& m) { return parts<Patch>(m.patches, m, m.info.patches, patchproof_model_patch_get_info); },
      "The patches, a tuple of Patch: B-splines first, then GERBS, then Gregory patches.");
  model.def_property_readonly(
      "curves", [](Model& m) { return parts<Curve>(m.curves, m, m.info.curves, patchproof_model_curve_get_info); },
      "The curves, a tuple of Curve: B-splines first, then GERBS.");
  model.def_property_readonly(
      "units", [](Model& m) { return to_str(m.info.units); }, "The unit of lengths, as the file has it.");
  model.def_property_readonly(
      "format", [](Model& m) { return to_str(m.info.format); }, "What was read: \"patchproof-model\", \"g2\" …");
  model.def_property_readonly(
      "notes", [](Model& m) { return lines_of(m.info.notes); }, "What the reader noticed, a tuple of str.");
  model.def_property_readonly(
      "solids", [](Model& m) { return m.info.solids; }, "How many solids (maps of u, v, w) it has.");
  model.def(
      "to_json", [](Model& m) { return text_of(m, PATCHPROOF_FORMAT_JSON); }, R"(to_json(self)
--

The model as a text in patchproof's JSON, which keeps every number exactly.)");
  model.def(
      "to_g2", [](Model& m) { return text_of(m, PATCHPROOF_FORMAT_G2); }, R"(to_g2(self)
--

The model as a text in GoTools' .g2 format; numbers are rounded to doubles.)");
  model.def("__reduce__", [](Model& m) {
    return py::make_tuple(member("_pickle", "model"), py::make_tuple(text_of(m, PATCHPROOF_FORMAT_JSON)));
  });
  model.def("__copy__", [](const py::object& m) { return m; });
  model.def("__deepcopy__", [](const py::object& m, const py::object&) { return m; });
  model.def("__repr__", [](Model& m) {
    const auto units = std::string(to_str(m.info.units));
    return "<patchproof.Model: " + std::to_string(m.info.patches) + " patches, " + std::to_string(m.info.curves) +
           " curves" + (units.empty() ? "" : ", " + units) + ">";
  });

  module.def("read", &read, py::arg("path"), py::arg("decimals") = "exact", R"(read(path, decimals='exact')
--

The Model in a file of any text format of docs/formats.md (JSON, .g2, .bpt, OBJ …; not STEP, IGES, BREP).

path      str, bytes or os.PathLike
decimals  "exact": 0.1 is one tenth; "binary64": each number is rounded to the nearest double first

Raises Error, with the place in the file.)");
  module.def("read_text", &read_text, py::arg("text"), py::arg("name") = "text", py::arg("decimals") = "exact",
             R"(read_text(text, name='text', decimals='exact')
--

The Model in the text (str or bytes) of such a file; `name` stands in errors, its extension helps to know the format.)");
}

}  // namespace patchproof::python
