// SPDX-License-Identifier: Apache-2.0
// Patches and curves: what they are made of, and the same under other knots.
#include <vector>

#include "arrays.h"
#include "model.h"

namespace patchproof::python {
namespace {

const char* kind_of(const Part& part) {
  constexpr const char* kinds[] = {"bspline", "gerbs", "gregory"};
  return kinds[part.info.kind];
}

bool is_spline(const Part& part) { return part.info.kind == PATCHPROOF_KIND_BSPLINE; }

std::string named(const Part& part) {
  const auto name = std::string(to_str(part.info.name));
  return std::to_string(part.index) + (name.empty() ? "" : " " + std::string(py::repr(py::str(name))));
}

std::vector<double> numbers(const Patch& p, double* patchproof_spline_buffers::*which,
                            std::size_t patchproof_spline_buffers::*length, std::size_t count) {
  std::vector<double> out(count);
  auto buffers = sized<patchproof_spline_buffers>();
  buffers.*which = out.data();
  buffers.*length = count;
  call([&](patchproof_context* c) { return patchproof_model_patch_get_data(c, p.model.get(), p.index, &buffers); });
  return out;
}
std::vector<double> numbers(const Curve& p, double* patchproof_spline_buffers::*which,
                            std::size_t patchproof_spline_buffers::*length, std::size_t count) {
  std::vector<double> out(count);
  auto buffers = sized<patchproof_spline_buffers>();
  buffers.*which = out.data();
  buffers.*length = count;
  call([&](patchproof_context* c) { return patchproof_model_curve_get_data(c, p.model.get(), p.index, &buffers); });
  return out;
}

template <class P>
py::array knots(const P& p, bool along_v) {
  const std::size_t count = along_v ? p.info.knots_v : p.info.knots_u;
  const auto all =
      along_v ? numbers(p, &patchproof_spline_buffers::knots_v, &patchproof_spline_buffers::knots_v_length, count)
              : numbers(p, &patchproof_spline_buffers::knots_u, &patchproof_spline_buffers::knots_u_length, count);
  return frozen(all.data(), {static_cast<py::ssize_t>(count)});
}

Shape net(const Patch& p) {
  return {static_cast<py::ssize_t>(p.info.points_u), static_cast<py::ssize_t>(p.info.points_v)};
}
Shape net(const Curve& p) { return {static_cast<py::ssize_t>(p.info.points_u)}; }

template <class P>
py::object points(const P& p) {
  if (!is_spline(p)) return py::none();
  Shape shape = net(p);
  std::size_t count = 3;
  for (const py::ssize_t n : shape) count *= static_cast<std::size_t>(n);
  shape.push_back(3);
  const auto all = numbers(p, &patchproof_spline_buffers::points, &patchproof_spline_buffers::points_length, count);
  return frozen(all.data(), shape);
}

template <class P>
py::object weights(const P& p) {
  if (!is_spline(p) || p.info.is_rational == 0) return py::none();
  const Shape shape = net(p);
  std::size_t count = 1;
  for (const py::ssize_t n : shape) count *= static_cast<std::size_t>(n);
  const auto all = numbers(p, &patchproof_spline_buffers::weights, &patchproof_spline_buffers::weights_length, count);
  return frozen(all.data(), shape);
}

std::vector<std::string> knot_texts(const py::object& knots) {
  if (py::isinstance<py::str>(knots)) throw py::type_error("knots: a sequence of numbers is needed, not a text");
  const py::object to_text = member("_numbers", "to_text");
  std::vector<std::string> out;
  for (const auto& knot : knots) out.push_back(utf8(to_text(knot)));
  return out;
}

std::vector<patchproof_text> views(const std::vector<std::string>& texts) {
  std::vector<patchproof_text> out;
  for (const std::string& text : texts) out.push_back(view(text));
  return out;
}

std::int32_t direction_of(const py::object& word) { return choose(word, {"u", "v"}, "direction"); }

// What patches and curves have alike.
template <class P, class Class>
void bind_common(Class& type, const char* parts) {
  type.def_property_readonly(
      "name", [](const P& p) { return to_str(p.info.name); }, "Its name in the model, or \"\".");
  type.def_property_readonly(
      "index", [](const P& p) { return p.index; }, "Its number in the model.");
  type.def_property_readonly(
      "kind", [](const P& p) { return kind_of(p); }, "\"bspline\", \"gerbs\" or \"gregory\".");
  type.def_property_readonly(
      "is_rational", [](const P& p) { return p.info.is_rational != 0; }, "Whether it has weights.");
  type.def_property_readonly(
      "is_double", [](const P& p) { return p.info.is_double != 0; },
      "Whether all its numbers are doubles. If not, evaluate works with the nearest ones, evaluate_exact with the "
      "numbers "
      "themselves.");
  type.def("__reduce__", [parts](const P& p) {
    const auto model = py::cast(std::make_shared<Model>(p.model));
    return py::make_tuple(member("_pickle", "part"), py::make_tuple(model, parts, p.index));
  });
  type.def("__copy__", [](const py::object& p) { return p; });
  type.def("__deepcopy__", [](const py::object& p, const py::object&) { return p; });
}

}  // namespace

PatchClass bind_patch(py::module_& module) {
  PatchClass patch(module, "Patch", py::is_final(), R"(A surface patch of a model, S(u, v).

It keeps what it needs of its model alive. GERBS and Gregory patches have no degree, knots, points and weights (None), and
only evaluate_exact.)");
  forbid_construction(patch);
  bind_common<Patch>(patch, "patches");
  patch.def_property_readonly(
      "degree",
      [](const Patch& p) -> py::object {
        if (!is_spline(p)) return py::none();
        return py::make_tuple(p.info.degree_u, p.info.degree_v);
      },
      "(p, q), the degrees along u and v.");
  patch.def_property_readonly(
      "knots",
      [](const Patch& p) -> py::object {
        if (!is_spline(p)) return py::none();
        return py::make_tuple(knots(p, false), knots(p, true));
      },
      "(along u, along v): read-only float64 arrays of nu + p + 1 and nv + q + 1 knots, the nearest doubles.");
  patch.def_property_readonly(
      "points", [](const Patch& p) { return points(p); },
      "Control points, a read-only float64 array (nu, nv, 3), the nearest doubles.");
  patch.def_property_readonly(
      "weights", [](const Patch& p) { return weights(p); },
      "Weights, a read-only float64 array (nu, nv), the nearest doubles; None: all are 1.");
  patch.def_property_readonly(
      "domain",
      [](const Patch& p) {
        const double* const d = p.info.domain;
        return py::make_tuple(py::make_tuple(d[0], d[1]), py::make_tuple(d[2], d[3]));
      },
      "((u from, to), (v from, to)), the nearest doubles; both ends included.");
  patch.def("__repr__", [](const Patch& p) {
    std::string form = kind_of(p);
    if (is_spline(p))
      form += " of degree (" + std::to_string(p.info.degree_u) + ", " + std::to_string(p.info.degree_v) + "), " +
              std::to_string(p.info.points_u) + "×" + std::to_string(p.info.points_v) + " points" +
              (p.info.is_rational != 0 ? ", rational" : "");
    return "<patchproof.Patch " + named(p) + ": " + form + ">";
  });
  patch.def(
      "insert_knots",
      [](const Patch& p, const py::object& direction, const py::object& knots) {
        const std::int32_t along = direction_of(direction);
        const auto texts = knot_texts(knots);
        const auto all = views(texts);
        return make_model([&](patchproof_context* c, patchproof_model** out) {
          return patchproof_model_patch_insert_knots(c, p.model.get(), p.index, along, all.data(), all.size(), out);
        });
      },
      py::arg("direction"), py::arg("knots"), R"(insert_knots(self, direction, knots)
--

The model with this patch on finer knots: exactly the same surface.

direction  "u" or "v"
knots      a sequence of ints, Fractions, floats (exactly as they are) or texts ("1/3"); each is inserted once)");
  patch.def(
      "elevate",
      [](const Patch& p, const py::object& direction, int times) {
        const std::int32_t along = direction_of(direction);
        return make_model([&](patchproof_context* c, patchproof_model** out) {
          return patchproof_model_patch_elevate(c, p.model.get(), p.index, along, times, out);
        });
      },
      py::arg("direction"), py::arg("times") = 1, R"(elevate(self, direction, times=1)
--

The model with the degree of this patch along "u" or "v" raised by `times`: exactly the same surface.)");
  patch.def(
      "extract_bezier",
      [](const Patch& p) {
        return make_model([&](patchproof_context* c, patchproof_model** out) {
          return patchproof_model_patch_extract_bezier(c, p.model.get(), p.index, out);
        });
      },
      R"(extract_bezier(self)
--

A model of the Bézier pieces, those along v running fastest, each over its own part of the domain.)");
  return patch;
}

CurveClass bind_curve(py::module_& module) {
  CurveClass curve(module, "Curve", py::is_final(), R"(A curve of a model, C(t).

It keeps what it needs of its model alive. GERBS curves have no degree, knots, points and weights (None), and only
evaluate_exact.)");
  forbid_construction(curve);
  bind_common<Curve>(curve, "curves");
  curve.def_property_readonly(
      "degree",
      [](const Curve& p) -> py::object {
        if (!is_spline(p)) return py::none();
        return py::int_(p.info.degree_u);
      },
      "The degree.");
  curve.def_property_readonly(
      "knots",
      [](const Curve& p) -> py::object {
        if (!is_spline(p)) return py::none();
        return knots(p, false);
      },
      "A read-only float64 array of n + degree + 1 knots, the nearest doubles.");
  curve.def_property_readonly(
      "points", [](const Curve& p) { return points(p); },
      "Control points, a read-only float64 array (n, 3), the nearest doubles.");
  curve.def_property_readonly(
      "weights", [](const Curve& p) { return weights(p); },
      "Weights, a read-only float64 array (n,), the nearest doubles; None: all are 1.");
  curve.def_property_readonly(
      "domain", [](const Curve& p) { return py::make_tuple(p.info.domain[0], p.info.domain[1]); },
      "(from, to), the nearest doubles; both ends included.");
  curve.def("__repr__", [](const Curve& p) {
    std::string form = kind_of(p);
    if (is_spline(p))
      form += " of degree " + std::to_string(p.info.degree_u) + ", " + std::to_string(p.info.points_u) + " points" +
              (p.info.is_rational != 0 ? ", rational" : "");
    return "<patchproof.Curve " + named(p) + ": " + form + ">";
  });
  curve.def(
      "insert_knots",
      [](const Curve& p, const py::object& knots) {
        const auto texts = knot_texts(knots);
        const auto all = views(texts);
        return make_model([&](patchproof_context* c, patchproof_model** out) {
          return patchproof_model_curve_insert_knots(c, p.model.get(), p.index, all.data(), all.size(), out);
        });
      },
      py::arg("knots"), R"(insert_knots(self, knots)
--

The model with this curve on finer knots: exactly the same curve. Numbers are as those of Patch.insert_knots.)");
  curve.def(
      "elevate",
      [](const Curve& p, int times) {
        return make_model([&](patchproof_context* c, patchproof_model** out) {
          return patchproof_model_curve_elevate(c, p.model.get(), p.index, times, out);
        });
      },
      py::arg("times") = 1, R"(elevate(self, times=1)
--

The model with the degree of this curve raised by `times`: exactly the same curve.)");
  curve.def(
      "extract_bezier",
      [](const Curve& p) {
        return make_model([&](patchproof_context* c, patchproof_model** out) {
          return patchproof_model_curve_extract_bezier(c, p.model.get(), p.index, out);
        });
      },
      R"(extract_bezier(self)
--

A model of the Bézier pieces, each over its own part of the domain.)");
  return curve;
}

}  // namespace patchproof::python
