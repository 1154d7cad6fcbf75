// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include <functional>
#include <utility>

namespace patchproof::python {
namespace {

constexpr py::ssize_t kDouble = sizeof(double);

std::string described(const py::array& array) {
  return "an array of " + std::string(py::str(array.dtype())) + " and shape " +
         text_of(Shape(array.shape(), array.shape() + array.ndim()));
}

// What is no array yet is made into one; arrays stay as they are.
py::array as_doubles(const py::object& value, const std::string& name) {
  if (py::isinstance<py::array>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    if (!py::isinstance<py::array_t<double>>(value))
      throw py::type_error(name + ": " + described(array) + "; native float64 is needed: " + name +
                           ".astype(numpy.float64) makes a copy");
    if (reinterpret_cast<std::uintptr_t>(array.data()) % kDouble != 0)
      throw py::type_error(name + ": " + described(array) + " that is not aligned; numpy.copy makes one that is");
    return array;
  }
  const py::object made = py::module_::import("numpy").attr("asarray")(value);
  const auto kind = std::string(py::str(made.attr("dtype").attr("kind")));
  if (kind != "f" && kind != "i" && kind != "u" && made.attr("size").cast<py::ssize_t>() > 0)
    throw py::type_error(name + ": " + described(made) + "; numbers are needed");
  return made.attr("astype")("float64");
}

// The distance of items in doubles, when the first `dimensions` axes can be walked through in equal steps.
py::ssize_t common_stride(const py::array& array, py::ssize_t dimensions, const std::string& name) {
  py::ssize_t step = 0, next = 0;  // in bytes; 0: no axis with two places yet
  for (py::ssize_t d = dimensions; d-- > 0;) {
    if (array.shape(d) == 0) return 1;
    if (array.shape(d) == 1) continue;
    if (step == 0) step = next = array.strides(d);
    if (array.strides(d) != next || step <= 0 || step % kDouble != 0)
      throw py::type_error(
          name + ": " + described(array) +
          " whose items do not follow each other in equal steps forward; numpy.ascontiguousarray makes a copy "
          "that does");
    next *= array.shape(d);
  }
  return step == 0 ? 1 : step / kDouble;
}

py::ssize_t product(const Shape& shape) {
  py::ssize_t out = 1;
  for (const py::ssize_t n : shape) out *= n;
  return out;
}

Shape shape_of(const py::array& array, py::ssize_t dimensions) {
  return Shape(array.shape(), array.shape() + dimensions);
}

const double* data_of(const py::array& array) { return static_cast<const double*>(array.data()); }

}  // namespace

std::string text_of(const Shape& shape) {
  std::string out = "(";
  for (std::size_t d = 0; d < shape.size(); ++d) out += (d == 0 ? "" : " ") + std::to_string(shape[d]) + ",";
  if (shape.size() > 1) out.pop_back();
  return out + ")";
}

Parameters surface_parameters(const py::object& uv) {
  Parameters out;
  if (!py::isinstance<py::tuple>(uv)) {
    const py::array array = as_doubles(uv, "uv");
    const py::ssize_t last = array.ndim() - 1;
    if (last < 0 || array.shape(last) != 2)
      throw py::type_error("uv: " + described(array) + "; (..., 2) is needed, or a tuple of two arrays");
    out.shape = shape_of(array, last);
    const py::ssize_t stride = common_stride(array, last, "uv"), across = array.strides(last);
    if (across % kDouble != 0)
      throw py::type_error("uv: " + described(array) +
                           " whose v lies between doubles; numpy.ascontiguousarray makes a copy");
    out.at = {data_of(array), data_of(array) + across / kDouble, static_cast<std::size_t>(product(out.shape)), stride};
    out.arrays = {array};
    return out;
  }
  const auto pair = py::reinterpret_borrow<py::tuple>(uv);
  if (pair.size() != 2) throw py::type_error("uv: a tuple of " + std::to_string(pair.size()) + "; (u, v) is needed");
  const py::array u = as_doubles(pair[0], "u"), v = as_doubles(pair[1], "v");
  out.shape = shape_of(u, u.ndim());
  if (out.shape != shape_of(v, v.ndim()))
    throw py::type_error("uv: " + described(u) + " for u, " + described(v) + " for v; one shape is needed");
  const py::ssize_t stride = common_stride(u, u.ndim(), "u");
  if (common_stride(v, v.ndim(), "v") != stride)
    throw py::type_error("uv: u and v with different strides; numpy.ascontiguousarray of both makes them equal");
  out.at = {data_of(u), data_of(v), static_cast<std::size_t>(product(out.shape)), stride};
  out.arrays = {u, v};
  return out;
}

Parameters curve_parameters(const py::object& t) {
  const py::array array = as_doubles(t, "t");
  Parameters out;
  out.shape = shape_of(array, array.ndim());
  const py::ssize_t stride = common_stride(array, array.ndim(), "t");
  out.at = {data_of(array), nullptr, static_cast<std::size_t>(product(out.shape)), stride};
  out.arrays = {array};
  return out;
}

py::array grid_parameters(const py::object& u, const char* name) {
  const py::array array = as_doubles(u, name);
  if (array.ndim() != 1 || common_stride(array, 1, name) != 1)
    throw py::type_error(std::string(name) + ": " + described(array) + "; (n,) without gaps is needed");
  return array;
}

py::array new_array(const Shape& shape) { return py::array_t<double>(shape); }

py::array frozen(const double* data, const Shape& shape) {
  py::array out = py::array_t<double>(shape, data);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

Output output(const py::object& out, const Shape& items, const std::string& name) {
  Shape shape = items;
  shape.push_back(3);
  if (!out.is_none() && (!py::isinstance<py::array>(out) || !py::isinstance<py::array_t<double>>(out)))
    throw py::type_error(name + ": " +
                         (py::isinstance<py::array>(out) ? described(py::reinterpret_borrow<py::array>(out))
                                                         : std::string(py::str(py::type::of(out)))) +
                         "; an array of native float64 is needed");
  Output made{out.is_none() ? new_array(shape) : py::reinterpret_borrow<py::array>(out)};
  py::array& array = made.array;
  const auto last = static_cast<py::ssize_t>(items.size());
  if (shape_of(array, array.ndim()) != shape)
    throw py::type_error(name + ": " + described(array) + "; " + text_of(shape) + " is needed");
  if (!array.writeable()) throw py::value_error(name + ": " + described(array) + " that is read-only");
  if (array.size() == 0) {
    static double nowhere;  // is never written; a vector without a place would not be wanted
    made.vectors = {&nowhere, &nowhere, &nowhere, 0, 1};
    return made;
  }
  const py::ssize_t stride = common_stride(array, last, name), across = array.strides(last);
  if (across <= 0 || across % kDouble != 0 || reinterpret_cast<std::uintptr_t>(array.data()) % kDouble != 0)
    throw py::type_error(name + ": " + described(array) + " whose coordinates do not lie in steps of whole doubles");
  auto* const x = static_cast<double*>(array.mutable_data());
  made.vectors = {x, x + across / kDouble, x + 2 * (across / kDouble), static_cast<std::size_t>(product(items)),
                  stride};
  return made;
}

namespace {

// The bytes from the first to behind the last of an array.
std::pair<const char*, const char*> extent(const py::array& a) {
  const char* begin = static_cast<const char*>(a.data());
  const char* end = begin;
  if (a.size() == 0) return {begin, end};
  for (py::ssize_t d = 0; d < a.ndim(); ++d) (a.strides(d) < 0 ? begin : end) += a.strides(d) * (a.shape(d) - 1);
  return {begin, end + a.itemsize()};
}

// Python is asked only where the extents overlap: few calls do, and numpy gives the lock away meanwhile (take_lock).
bool share(const py::array& a, const py::array& b) {
  const auto [a_begin, a_end] = extent(a);
  const auto [b_begin, b_end] = extent(b);
  const std::less<const char*> before;
  if (!before(a_begin, b_end) || !before(b_begin, a_end)) return false;
  const py::object shares_memory = py::module_::import("numpy").attr("shares_memory");
  PyObject* answer = nullptr;
  take_lock([&] { answer = PyObject_CallFunction(shares_memory.ptr(), "OOi", a.ptr(), b.ptr(), 100000); });
  if (answer != nullptr) return py::reinterpret_steal<py::object>(answer).cast<bool>();
  PyErr_Clear();  // too hard to tell
  return true;
}

}  // namespace

void require_apart(const std::vector<Output>& outputs, const std::vector<py::array>& parameters) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const py::array& p : parameters)
      if (share(outputs[i].array, p)) throw py::value_error("out: shares memory with the parameters");
    for (std::size_t j = 0; j < i; ++j)
      if (share(outputs[i].array, outputs[j].array)) throw py::value_error("out: two arrays share memory");
  }
}

}  // namespace patchproof::python
