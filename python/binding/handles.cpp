// SPDX-License-Identifier: Apache-2.0
#include "handles.h"

#include <cstring>
#include <new>
#include <optional>

namespace patchproof::python {

Context make_context() {
  patchproof_context* context = nullptr;
  if (patchproof_context_create(0, &context) != PATCHPROOF_OK) throw std::bad_alloc();
  return Context(context);
}

namespace {

[[noreturn]] void raise(const py::object& type, const py::object& value) {
  PyErr_SetObject(type.ptr(), value.ptr());
  throw py::error_already_set();
}

}  // namespace

void raise_unless_ok(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  if (status == PATCHPROOF_OUT_OF_MEMORY) throw std::bad_alloc();
  auto error = sized<patchproof_error>();
  if (patchproof_last_error(context, &error) != PATCHPROOF_OK) error = sized<patchproof_error>();
  if (status == PATCHPROOF_BAD_DATA || status == PATCHPROOF_BAD_ARGUMENT) {
    const py::object type = member("_errors", "Error");
    const py::object code = status == PATCHPROOF_BAD_DATA ? py::object(to_str(error.code)) : py::str("bad_argument");
    raise(type, type(code, to_str(error.where), to_str(error.message), to_str(error.values)));
  }
  const py::object type = member("_errors", "InternalError");
  raise(type, type(std::string(patchproof_status_name(status)) + ": " + patchproof_error_text(context)));
}

py::str to_str(patchproof_text text) {
  const char* const data = text.data == nullptr ? "" : text.data;
  PyObject* const made = PyUnicode_DecodeUTF8(data, static_cast<Py_ssize_t>(text.length), "surrogateescape");
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

py::tuple lines_of(patchproof_text text) {
  py::list lines;
  if (text.length > 0)
    for (const auto& line : to_str(text).attr("splitlines")()) lines.append(line);
  return py::tuple(lines);
}

py::object member(const char* module, const char* name) {
  return py::module_::import((std::string("patchproof.") + module).c_str()).attr(name);
}

int choose(const py::object& word, std::initializer_list<const char*> words, const char* name) {
  std::string all;
  int place = 0;
  for (const char* w : words) {
    if (py::isinstance<py::str>(word) && word.equal(py::str(w))) return place;
    all += std::string(place++ == 0 ? "" : ", ") + "'" + w + "'";
  }
  throw py::value_error(std::string(name) + ": one of " + all + " is needed, not " + std::string(py::repr(word)));
}

std::string utf8(const py::object& text) {
  if (!py::isinstance<py::str>(text)) return text.cast<std::string>();
  Py_ssize_t length = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &length);
  if (bytes == nullptr) throw py::error_already_set();
  return {bytes, static_cast<std::size_t>(length)};
}

Progress::Progress(py::object function) : function_(std::move(function)) {
  if (!function_.is_none() && PyCallable_Check(function_.ptr()) == 0)
    throw py::type_error("progress: a function of (done, all) is needed, not " + std::string(py::repr(function_)));
  callback_.user = this;
  callback_.progress = [](void* user, std::uint64_t done, std::uint64_t all) -> std::int32_t {
    return static_cast<Progress*>(user)->report(done, all);
  };
}

std::int32_t Progress::report(std::uint64_t done, std::uint64_t all) noexcept {
  if (raised_) return 1;
  std::optional<py::gil_scoped_acquire> lock;
  take_lock([&] { lock.emplace(); });
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!function_.is_none()) function_(done, all == 0 ? py::object(py::none()) : py::object(py::int_(all)));
    return 0;
  } catch (...) {
    raised_ = std::current_exception();
    return 1;
  }
}

}  // namespace patchproof::python
