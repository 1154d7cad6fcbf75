// SPDX-License-Identifier: Apache-2.0
// numpy arrays as the C API sees them: pointers and strides, no copies. An array is taken as it lies or refused with a
// TypeError that says why; lists and numbers, which are no arrays yet, are made into arrays.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "handles.h"

namespace patchproof::python {

using Shape = std::vector<py::ssize_t>;
std::string text_of(const Shape& shape);

// Parameters of `count` items, which form an array of `shape`.
struct Parameters {
  patchproof_parameters at{};
  Shape shape;
  std::vector<py::array> arrays;  // what `at` points into
};
// uv: an array (..., 2), or a tuple of two arrays (...) with one stride.
Parameters surface_parameters(const py::object& uv);
// t: an array (...).
Parameters curve_parameters(const py::object& t);
// An array (n,) without gaps.
py::array grid_parameters(const py::object& u, const char* name);

// A new array, not yet filled: in C order.
py::array new_array(const Shape& shape);
// A read-only copy.
py::array frozen(const double* data, const Shape& shape);

// Where a result goes: an array of shape (..., 3) of the caller's, or a new one.
struct Output {
  py::array array;
  patchproof_vectors vectors{};
};
Output output(const py::object& out, const Shape& items, const std::string& name);

// ValueError where two of the outputs, or an output and parameters, share numbers.
void require_apart(const std::vector<Output>& outputs, const std::vector<py::array>& parameters);

}  // namespace patchproof::python
