// SPDX-License-Identifier: Apache-2.0
// patchproof._patchproof: the C API as Python classes. What it does is done by include/patchproof/c_api.h.
#include "model.h"

PYBIND11_MODULE(_patchproof, module) {
  using namespace patchproof::python;
  if (patchproof_abi_version() != PATCHPROOF_ABI_VERSION)
    throw py::import_error("this module was built for version " + std::to_string(PATCHPROOF_ABI_VERSION) +
                           " of the interface of libpatchproof, and found version " +
                           std::to_string(patchproof_abi_version()));
  py::options options;
  options.disable_function_signatures();  // docstrings begin with signatures of their own, in Python's words
  module.doc() = "The compiled part of patchproof.";
  module.attr("__version__") = patchproof_version();
  bind_model(module);
  PatchClass patch = bind_patch(module);
  CurveClass curve = bind_curve(module);
  bind_patch_evaluation(patch);
  bind_curve_evaluation(curve);
  bind_exact_evaluation(patch, curve);
  bind_certify(module);
  bind_fill(module);
  bind_tessellate(module);
  // Nobody may give an object another of these classes, whose handle it has not.
  for (const char* name : {"Model", "Patch", "Curve", "Report", "Mesh"}) {
    auto* const type = reinterpret_cast<PyTypeObject*>(module.attr(name).ptr());
    type->tp_flags |= Py_TPFLAGS_IMMUTABLETYPE;
    PyType_Modified(type);
  }
}
