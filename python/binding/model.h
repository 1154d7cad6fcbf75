// SPDX-License-Identifier: Apache-2.0
// The classes of the module: a model, and the patches and curves that keep it alive.
#pragma once

#include <atomic>
#include <mutex>

#include "handles.h"

namespace patchproof::python {

// A patch or a curve by its number in a model.
struct Part {
  Part(ModelHandle in_model, std::size_t at, patchproof_spline_info what)
      : model(std::move(in_model)), index(at), info(what) {}

  ModelHandle model;
  std::size_t index;
  patchproof_spline_info info;  // its texts live as long as the model
};

// What evaluates doubles is prepared when it is first asked for, once, by whatever thread.
template <class H>
class Prepared {
 public:
  // make(context, &handle). Called without the interpreter's lock; so no thread waits with that for another.
  template <class Make>
  auto get(const Make& make) {
    if (auto* const ready = ready_.load(std::memory_order_acquire)) return ready;
    call_released([&](patchproof_context* context) -> patchproof_status {
      const std::lock_guard lock(mutex_);
      if (handle_) return PATCHPROOF_OK;
      typename H::pointer made = nullptr;
      const patchproof_status status = make(context, &made);
      handle_.reset(made);
      ready_.store(made, std::memory_order_release);
      return status;
    });
    return ready_.load(std::memory_order_acquire);
  }

 private:
  std::mutex mutex_;
  H handle_;
  std::atomic<typename H::pointer> ready_{nullptr};
};

struct Patch : Part {
  using Part::Part;
  const patchproof_surface* surface() {
    return prepared.get([&](patchproof_context* context, patchproof_surface** out) {
      return patchproof_surface_of(context, model.get(), index, out);
    });
  }
  Prepared<SurfaceHandle> prepared;
};

struct Curve : Part {
  using Part::Part;
  const patchproof_curve* curve() {
    return prepared.get([&](patchproof_context* context, patchproof_curve** out) {
      return patchproof_curve_of(context, model.get(), index, out);
    });
  }
  Prepared<CurveHandle> prepared;
};

struct Model {
  explicit Model(ModelHandle made);

  ModelHandle handle;
  patchproof_model_info info;
  py::object patches, curves;  // tuples, made when they are first asked for
};

// make(context, &model), during which other threads run.
template <class Make>
std::shared_ptr<Model> make_model(const Make& make) {
  patchproof_model* made = nullptr;
  call_released([&](patchproof_context* context) { return make(context, &made); });
  return std::make_shared<Model>(own(made));
}

std::int32_t decimals_of(const py::object& word);

using PatchClass = py::class_<Patch, std::shared_ptr<Patch>>;
using CurveClass = py::class_<Curve, std::shared_ptr<Curve>>;

void bind_model(py::module_& module);
PatchClass bind_patch(py::module_& module);
CurveClass bind_curve(py::module_& module);
void bind_patch_evaluation(PatchClass& patch);
void bind_curve_evaluation(CurveClass& curve);
void bind_exact_evaluation(PatchClass& patch, CurveClass& curve);
void bind_certify(py::module_& module);
void bind_fill(py::module_& module);
void bind_tessellate(py::module_& module);

// Objects of this class come from calls only: Class() and Class.__new__ raise TypeError, and a copy is the object itself, for
// it never changes.
void forbid_construction(const py::object& type);
// pickle: TypeError, with what to do instead.
template <class Class>
void forbid_pickling(Class& type, const char* instead) {
  type.def("__reduce__", [instead](const py::object&) -> py::object { throw py::type_error(instead); });
}

}  // namespace patchproof::python
