// SPDX-License-Identifier: Apache-2.0
// Exact values of patches and curves: fractions in, fractions out.
#include <pybind11/numpy.h>

#include <string>
#include <string_view>
#include <vector>

#include "model.h"

namespace patchproof::python {
namespace {

std::int32_t side_of(const py::handle& word) {
  return choose(py::reinterpret_borrow<py::object>(word), {"right", "left"}, "side");
}

// An object array of the parameters, whatever they are.
py::array objects(const py::object& parameters) {
  return py::module_::import("numpy").attr("asarray")(parameters, py::arg("dtype") = "object");
}

// Pairs; a tuple of two means (u, v), as for evaluate.
py::array object_pairs(const py::object& uv) {
  if (!py::isinstance<py::tuple>(uv) || py::len(uv) != 2) return objects(uv);
  const auto numpy = py::module_::import("numpy");
  return numpy.attr("stack")(numpy.attr("broadcast_arrays")(objects(uv[py::int_(0)]), objects(uv[py::int_(1)])),
                             py::arg("axis") = -1);
}

std::vector<std::string> texts_of(const py::array& numbers) {
  const py::object to_text = member("_numbers", "to_text");
  std::vector<std::string> out;
  for (const auto& number : numbers.attr("ravel")()) out.push_back(utf8(to_text(number)));
  return out;
}

// One line of numbers after the other, each as Fraction or Quadratic, in arrays of objects: for each derivative (i, j), or
// (i,) of curves, one of shape (..., 3). Of order 0 the array alone.
py::object values(const std::string& lines, const py::tuple& shape, std::size_t items, const py::list& keys) {
  const py::object from_text = member("_numbers", "from_text");
  const py::object empty = py::module_::import("numpy").attr("empty");
  py::list all;
  std::size_t begin = 0;
  while (begin < lines.size()) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    all.append(from_text(lines.substr(begin, end - begin)));
    begin = end + 1;
  }
  const std::size_t rows = keys.size();
  if (all.size() != items * rows * 3)
    throw std::runtime_error("evaluate_exact: another number of values than asked for");
  py::dict out;
  for (std::size_t row = 0; row < rows; ++row) {
    const py::object flat = empty(items * 3, py::arg("dtype") = "object");
    for (std::size_t item = 0; item < items; ++item)
      for (std::size_t k = 0; k < 3; ++k) flat[py::int_(item * 3 + k)] = all[(item * rows + row) * 3 + k];
    out[keys[row]] = flat.attr("reshape")(shape + py::make_tuple(3));
  }
  return rows == 1 ? py::object(out[keys[0]]) : py::object(out);
}

// f(context, texts, options, buffer, length, &needed)
template <class F>
std::string exact_lines(const py::array& parameters, std::size_t numbers, const patchproof_evaluate_options& options,
                        const F& f) {
  const auto texts = texts_of(parameters);
  std::vector<patchproof_text> views;
  for (const std::string& text : texts) views.push_back(view(text));
  return written(64 + 64 * numbers,
                 [&](patchproof_context* context, char* buffer, std::size_t length, std::size_t* needed) {
                   return f(context, views, options, buffer, length, needed);
                 });
}

void require_order(int order) {
  if (order < 0 || order > 20) throw py::value_error("order: 0 to 20 is needed, not " + std::to_string(order));
}

py::object evaluate_patch(const Patch& p, const py::object& uv, int order, const py::object& side) {
  require_order(order);
  auto options = sized<patchproof_evaluate_options>();
  const bool two = py::isinstance<py::tuple>(side) && py::len(side) == 2;
  options.side_u = side_of(two ? py::object(side[py::int_(0)]) : side);
  options.side_v = side_of(two ? py::object(side[py::int_(1)]) : side);
  const py::array at = object_pairs(uv);
  if (at.ndim() == 0 || at.shape(at.ndim() - 1) != 2)
    throw py::type_error("uv: numbers of shape " + std::string(py::str(at.attr("shape"))) + "; (..., 2) is needed");
  const auto items = static_cast<std::size_t>(at.size() / 2);
  py::list keys;
  for (int total = 0; total <= order; ++total)
    for (int j = 0; j <= total; ++j) keys.append(py::make_tuple(total - j, j));
  const auto lines =
      exact_lines(at, items * keys.size() * 3, options, [&](auto* c, const auto& texts, const auto& o, auto... to) {
        return patchproof_model_patch_evaluate_exact(c, p.model.get(), p.index, texts.data(), texts.size(), &o,
                                                     PATCHPROOF_SCALAR_RATIONAL, order, to...);
      });
  return values(lines, at.attr("shape")[py::slice(0, at.ndim() - 1, 1)], items, keys);
}

py::object evaluate_curve(const Curve& p, const py::object& t, int order, const py::object& side) {
  require_order(order);
  auto options = sized<patchproof_evaluate_options>();
  options.side_u = side_of(side);
  const py::array at = objects(t);
  py::list keys;
  for (int total = 0; total <= order; ++total) keys.append(py::int_(total));
  const auto items = static_cast<std::size_t>(at.size());
  const auto lines =
      exact_lines(at, items * keys.size() * 3, options, [&](auto* c, const auto& texts, const auto& o, auto... to) {
        return patchproof_model_curve_evaluate_exact(c, p.model.get(), p.index, texts.data(), texts.size(), &o,
                                                     PATCHPROOF_SCALAR_RATIONAL, order, to...);
      });
  return values(lines, at.attr("shape"), items, keys);
}

}  // namespace

void bind_exact_evaluation(PatchClass& patch, CurveClass& curve) {
  patch.def("evaluate_exact", &evaluate_patch, py::arg("uv"), py::arg("order") = 0, py::arg("side") = "right",
            R"(evaluate_exact(self, uv, order=0, side='right')
--

Exact points and derivatives, of any kind of patch, from the model's own numbers.

uv     numbers of shape (..., 2): ints, Fractions, Decimals, Quadratics, texts ("1/3"), or floats, which count as exactly the
       numbers that they are (0.1 is not one tenth); a tuple of two is (u, v), as for evaluate
order  0: points; n up to 20: all derivatives of a total order up to n as well
side   "right" or "left", or one for u and one for v: which limit counts at a knot

Returns an object array (..., 3) of fractions.Fraction, or of Quadratic where a number of Q(√d) is no fraction; with order > 0
a dict of such arrays: [i, j] is the derivative i times along u and j times along v, [0, 0] the point.)");
  curve.def("evaluate_exact", &evaluate_curve, py::arg("t"), py::arg("order") = 0, py::arg("side") = "right",
            R"(evaluate_exact(self, t, order=0, side='right')
--

Exact points and derivatives, of any kind of curve: as Patch.evaluate_exact, at numbers t of shape (...). With order > 0 a
dict of arrays: [i] is the i-th derivative, [0] the point.)");
}

}  // namespace patchproof::python
