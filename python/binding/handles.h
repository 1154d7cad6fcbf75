// SPDX-License-Identifier: Apache-2.0
// Handles of the C API that free themselves, and calls of it that raise: a status becomes a Python exception here and
// nowhere else.
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "patchproof/c_api.h"

namespace patchproof::python {

namespace py = pybind11;

template <auto Free>
struct FreeHandle {
  template <class T>
  void operator()(T* handle) const noexcept {
    Free(handle);
  }
};

using Context = std::unique_ptr<patchproof_context, FreeHandle<patchproof_context_free>>;
using SurfaceHandle = std::unique_ptr<patchproof_surface, FreeHandle<patchproof_surface_free>>;
using CurveHandle = std::unique_ptr<patchproof_curve, FreeHandle<patchproof_curve_free>>;
using ReportHandle = std::unique_ptr<patchproof_report, FreeHandle<patchproof_report_free>>;
using MeshHandle = std::unique_ptr<patchproof_mesh, FreeHandle<patchproof_mesh_free>>;
using ModelHandle = std::shared_ptr<const patchproof_model>;  // patches keep their model alive

inline ModelHandle own(patchproof_model* model) { return ModelHandle(model, FreeHandle<patchproof_model_free>()); }

// A context serves one call at a time: each call has its own, whatever thread it runs on.
Context make_context();

// Raises what `status` of the last call says; returns for PATCHPROOF_OK only.
void raise_unless_ok(patchproof_context* context, patchproof_status status);

// f(context): a call that takes no time worth speaking of.
template <class F>
void call(const F& f) {
  const Context context = make_context();
  raise_unless_ok(context.get(), f(context.get()));
}

// take() asks for the interpreter's lock. A thread that asks when the interpreter has ended is made to end there, and what would
// be unwound then holds objects of Python, without the lock: it waits for the end of the process instead, as from Python 3.14 on.
template <class F>
void take_lock(const F& take) {
  try {
    take();
  } catch (const abi::__forced_unwind&) {
    for (;;) pause();
  }
}

// f() without the interpreter's lock. (py::gil_scoped_release takes it again in a destructor, which cannot be unwound.)
template <class F>
patchproof_status released(const F& f) {
  PyThreadState* const state = PyEval_SaveThread();
  const patchproof_status status = f();
  take_lock([&] { PyEval_RestoreThread(state); });
  return status;
}

// f(context): a call during which other Python threads run. f must not touch Python.
template <class F>
void call_released(const F& f) {
  const Context context = make_context();
  const patchproof_status status = released([&]() noexcept { return f(context.get()); });
  raise_unless_ok(context.get(), status);
}

// A struct of the C API that knows its size; all else is 0.
template <class S>
S sized() {
  S out{};
  out.struct_size = sizeof(S);
  return out;
}

// The UTF-8 of a str, or the bytes; what is no UTF-8 (lone surrogates) is a UnicodeEncodeError.
std::string utf8(const py::object& text);

inline patchproof_text view(const std::string& text) { return {text.data(), text.size()}; }
py::str to_str(patchproof_text text);  // paths in errors may be no UTF-8: as os.fsdecode
// Lines as a tuple of str; of the empty text an empty one.
py::tuple lines_of(patchproof_text text);

// write(context, buffer, length, &needed): the bytes without the zero at the end. `guess` spares most texts a second call.
template <class F>
std::string written(std::size_t guess, const F& write) {
  std::string buffer(guess, '\0');
  std::size_t needed = 0;
  call_released([&](patchproof_context* context) {
    patchproof_status status = write(context, buffer.data(), buffer.size(), &needed);
    if (status != PATCHPROOF_BUFFER_TOO_SMALL) return status;
    buffer.resize(needed);
    return write(context, buffer.data(), buffer.size(), &needed);
  });
  buffer.resize(needed > 0 ? needed - 1 : 0);
  return buffer;
}

// Something of the Python part of this package: member("_values", "Bounds").
py::object member(const char* module, const char* name);

// The place of `word` among `words`, or ValueError("name: …, not 'word'").
int choose(const py::object& word, std::initializer_list<const char*> words, const char* name);

// A callback that hands progress on to Python and listens to Ctrl-C. What is raised in it stops the call.
class Progress {
 public:
  // function: None, or one that takes (done, all); `all` is None while it is not known.
  explicit Progress(py::object function);
  const patchproof_callback* callback() const { return &callback_; }

  // As call_released; f(context) hands callback() on.
  template <class F>
  void call(const F& f) {
    const Context context = make_context();
    const patchproof_status status = released([&]() noexcept { return f(context.get()); });
    if (raised_) std::rethrow_exception(raised_);
    raise_unless_ok(context.get(), status);
  }

 private:
  std::int32_t report(std::uint64_t done, std::uint64_t all) noexcept;

  py::object function_;
  patchproof_callback callback_;
  std::exception_ptr raised_;
};

}  // namespace patchproof::python
