// SPDX-License-Identifier: Apache-2.0
// Values of patches and curves in double, at arrays of parameters, into arrays.
#include <utility>
#include <vector>

#include "arrays.h"
#include "model.h"

namespace patchproof::python {
namespace {

std::int32_t side_of(const py::object& word) { return choose(word, {"right", "left"}, "side"); }

patchproof_evaluate_options options_of(const py::object& side, int threads) {
  auto out = sized<patchproof_evaluate_options>();
  if (py::isinstance<py::tuple>(side) && py::len(side) == 2) {
    const auto sides = py::reinterpret_borrow<py::tuple>(side);
    out.side_u = side_of(sides[0]);
    out.side_v = side_of(sides[1]);
  } else {
    out.side_u = out.side_v = side_of(side);
  }
  out.threads = threads;
  return out;
}

// One vector that may be asked for.
struct Slot {
  const char* name;
  patchproof_vectors patchproof_derivatives::*member;
  bool wanted;
};

// What is wanted, where it goes, and what the call returns: an array if it is points only, else a record of arrays.
class Results {
 public:
  Results(const char* record, std::vector<Slot> slots, const py::object& out, const Shape& items,
          const std::vector<py::array>& parameters)
      : derivatives(sized<patchproof_derivatives>()) {
    bool points_only = true;
    for (std::size_t i = 1; i < slots.size(); ++i) points_only = points_only && !slots[i].wanted;
    const py::object type = member("_values", record);
    const bool fills_record = py::isinstance(out, type);
    points_only = points_only && !fills_record;
    if (!out.is_none() && !points_only && !fills_record)
      throw py::type_error(std::string("out: ") + record + " of arrays is needed, not " +
                           std::string(py::str(py::type::of(out))));
    py::dict made;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const Slot& slot = slots[i];
      const py::object target = fills_record            ? py::object(out.attr(slot.name))
                                : points_only && i == 0 ? out
                                                        : py::none();
      if (fills_record && target.is_none() && slot.wanted && i > 0)
        throw py::value_error(std::string("out.") + slot.name + " is None, and derivatives or normal ask for it");
      if (fills_record ? target.is_none() : !slot.wanted) continue;
      outputs_.push_back(output(target, items, fills_record ? std::string("out.") + slot.name : "out"));
      derivatives.*slot.member = outputs_.back().vectors;
      made[slot.name] = outputs_.back().array;
    }
    if (outputs_.empty()) throw py::value_error("out: all of its arrays are None");
    require_apart(outputs_, parameters);
    result_ = !out.is_none() ? out : points_only ? py::object(outputs_.front().array) : type(**made);
  }

  py::object result() const { return result_; }

  patchproof_derivatives derivatives;

 private:
  std::vector<Output> outputs_;
  py::object result_;
};

void require_order(int derivatives) {
  if (derivatives < 0 || derivatives > 2)
    throw py::value_error("derivatives: 0, 1 or 2 is needed, not " + std::to_string(derivatives) +
                          "; evaluate_exact has those of higher order");
}

std::vector<Slot> surface_slots(int derivatives, bool normal) {
  require_order(derivatives);
  const bool first = derivatives >= 1, second = derivatives >= 2;
  return {{"point", &patchproof_derivatives::point, true},    {"du", &patchproof_derivatives::du, first},
          {"dv", &patchproof_derivatives::dv, first},         {"duu", &patchproof_derivatives::duu, second},
          {"duv", &patchproof_derivatives::duv, second},      {"dvv", &patchproof_derivatives::dvv, second},
          {"normal", &patchproof_derivatives::normal, normal}};
}

py::object evaluate(Patch& p, const py::object& uv, int derivatives, bool normal, const py::object& out,
                    const py::object& side, int threads) {
  const Parameters parameters = surface_parameters(uv);
  const auto options = options_of(side, threads);
  Results results("Derivatives", surface_slots(derivatives, normal), out, parameters.shape, parameters.arrays);
  const patchproof_surface* const surface = p.surface();
  call_released([&](patchproof_context* c) {
    return patchproof_surface_evaluate(c, surface, parameters.at, &options, &results.derivatives);
  });
  return results.result();
}

py::object evaluate_grid(Patch& p, const py::object& u, const py::object& v, int derivatives, bool normal,
                         const py::object& out, const py::object& side, int threads) {
  const py::array us = grid_parameters(u, "u"), vs = grid_parameters(v, "v");
  const auto options = options_of(side, threads);
  Results results("Derivatives", surface_slots(derivatives, normal), out, {us.size(), vs.size()}, {us, vs});
  const auto* const u_data = static_cast<const double*>(us.data());
  const auto* const v_data = static_cast<const double*>(vs.data());
  const auto nu = static_cast<std::size_t>(us.size()), nv = static_cast<std::size_t>(vs.size());
  const patchproof_surface* const surface = p.surface();
  call_released([&](patchproof_context* c) {
    return patchproof_surface_evaluate_grid(c, surface, u_data, nu, v_data, nv, &options, &results.derivatives);
  });
  return results.result();
}

py::object evaluate_bounded(Patch& p, const py::object& uv, const py::object& side, int threads) {
  const Parameters parameters = surface_parameters(uv);
  const auto options = options_of(side, threads);
  const Output points = output(py::none(), parameters.shape, "out");
  py::array bounds = new_array(parameters.shape);
  auto* const bound = static_cast<double*>(bounds.mutable_data());
  const patchproof_surface* const surface = p.surface();
  call_released([&](patchproof_context* c) {
    return patchproof_surface_evaluate_bounded(c, surface, parameters.at, &options, points.vectors, bound,
                                               parameters.at.count);
  });
  return py::make_tuple(points.array, bounds);
}

py::object enclose(Patch& p, const py::object& uv, const py::object& side, int threads) {
  const Parameters parameters = surface_parameters(uv);
  const auto options = options_of(side, threads);
  const Output lower = output(py::none(), parameters.shape, "out"), upper = output(py::none(), parameters.shape, "out");
  const patchproof_surface* const surface = p.surface();
  call_released([&](patchproof_context* c) {
    return patchproof_surface_enclose(c, surface, parameters.at, &options, lower.vectors, upper.vectors);
  });
  return py::make_tuple(lower.array, upper.array);
}

py::object evaluate_rounded(Patch& p, const py::object& uv, const py::object& side, int threads) {
  const Parameters parameters = surface_parameters(uv);
  const auto options = options_of(side, threads);
  const Output points = output(py::none(), parameters.shape, "out");
  const patchproof_surface* const surface = p.surface();
  call_released([&](patchproof_context* c) {
    return patchproof_surface_evaluate_rounded(c, surface, parameters.at, &options, points.vectors);
  });
  return points.array;
}

double error_bound(Patch& p, const py::object& vector) {
  const std::int32_t which = choose(vector, {"point", "du", "dv", "duu", "duv", "dvv"}, "vector");
  const patchproof_surface* const surface = p.surface();
  double bound = 0;
  call([&](patchproof_context* c) { return patchproof_surface_error_bound(c, surface, which, &bound); });
  return bound;
}

py::object evaluate_curve(Curve& p, const py::object& t, int derivatives, const py::object& out, const py::object& side,
                          int threads) {
  require_order(derivatives);
  const Parameters parameters = curve_parameters(t);
  auto options = sized<patchproof_evaluate_options>();
  options.side_u = side_of(side);
  options.threads = threads;
  Results results("CurveDerivatives",
                  {{"point", &patchproof_derivatives::point, true},
                   {"dt", &patchproof_derivatives::du, derivatives >= 1},
                   {"dtt", &patchproof_derivatives::duu, derivatives >= 2}},
                  out, parameters.shape, parameters.arrays);
  const patchproof_curve* const curve = p.curve();
  call_released([&](patchproof_context* c) {
    return patchproof_curve_evaluate(c, curve, parameters.at, &options, &results.derivatives);
  });
  return results.result();
}

double curve_error_bound(Curve& p, const py::object& vector) {
  constexpr std::int32_t vectors[] = {PATCHPROOF_VECTOR_POINT, PATCHPROOF_VECTOR_DU, PATCHPROOF_VECTOR_DUU};
  const std::int32_t which = vectors[choose(vector, {"point", "dt", "dtt"}, "vector")];
  const patchproof_curve* const curve = p.curve();
  double bound = 0;
  call([&](patchproof_context* c) { return patchproof_curve_error_bound(c, curve, which, &bound); });
  return bound;
}

}  // namespace

void bind_patch_evaluation(PatchClass& patch) {
  patch.def("evaluate", &evaluate, py::arg("uv"), py::arg("derivatives") = 0, py::arg("normal") = false,
            py::arg("out") = py::none(), py::arg("side") = "right", py::arg("threads") = 1,
            R"(evaluate(self, uv, derivatives=0, normal=False, out=None, side='right', threads=1)
--

Points, and derivatives where asked for, at many parameters: in double, by SIMD kernels, without copies.

uv           float64 array (..., 2), or a tuple (u, v) of two arrays of one shape (...). Arrays are read where they lie,
             whatever their strides, as long as items follow each other in equal steps forward; others, and other dtypes,
             raise TypeError and are never copied silently. Lists and numbers are made into arrays.
derivatives  0: points only; 1: du and dv as well; 2: duu, duv and dvv as well
normal       True: unit normals as well, 0 0 0 where du × dv is 0
out          where the values go and what is returned: a float64 array (..., 3), or Derivatives of such arrays, of which
             all that are not None are filled. They must not overlap the parameters. After an error part may be written.
side         "right" or "left", or one for u and one for v: which limit counts at a knot
threads      how many threads work; -1: one for each processor

Returns a float64 array (..., 3) of points in the model's units; with derivatives or normal a Derivatives of arrays. Each
coordinate is within error_bound(...) of the exact value at these doubles; the same (u, v) always gives the same bits.
Raises Error for a parameter outside the domain (NaN is), which names the first, and where the weights vanish.)");
  patch.def("evaluate_grid", &evaluate_grid, py::arg("u"), py::arg("v"), py::arg("derivatives") = 0,
            py::arg("normal") = false, py::arg("out") = py::none(), py::arg("side") = "right", py::arg("threads") = 1,
            R"(evaluate_grid(self, u, v, derivatives=0, normal=False, out=None, side='right', threads=1)
--

As evaluate, at all (u[i], v[j]): arrays of shape (nu, nv, 3) from float64 arrays u (nu,) and v (nv,) without gaps. Faster
than evaluate, with the same bits.)");
  patch.def("evaluate_bounded", &evaluate_bounded, py::arg("uv"), py::arg("side") = "right", py::arg("threads") = 1,
            R"(evaluate_bounded(self, uv, side='right', threads=1)
--

(points, bounds): arrays (..., 3) and (...). The exact coordinates of each point at these doubles are proved to be within
its own bound (inf where nothing is known).)");
  patch.def("enclose", &enclose, py::arg("uv"), py::arg("side") = "right", py::arg("threads") = 1,
            R"(enclose(self, uv, side='right', threads=1)
--

(lower, upper): arrays (..., 3) with lower <= exact <= upper in each coordinate, which is proved.)");
  patch.def("evaluate_rounded", &evaluate_rounded, py::arg("uv"), py::arg("side") = "right", py::arg("threads") = 1,
            R"(evaluate_rounded(self, uv, side='right', threads=1)
--

The doubles nearest to the exact coordinates: an array (..., 3).)");
  patch.def("error_bound", &error_bound, py::arg("vector") = "point", R"(error_bound(self, vector='point')
--

How far any coordinate of "point", "du", "dv", "duu", "duv" or "dvv" from evaluate is from the exact value, at most and
anywhere; inf where nothing is known.)");
}

void bind_curve_evaluation(CurveClass& curve) {
  curve.def("evaluate", &evaluate_curve, py::arg("t"), py::arg("derivatives") = 0, py::arg("out") = py::none(),
            py::arg("side") = "right", py::arg("threads") = 1,
            R"(evaluate(self, t, derivatives=0, out=None, side='right', threads=1)
--

Points, and derivatives where asked for, at many parameters: in double, by SIMD kernels, without copies.

t            float64 array (...), read where it lies as Patch.evaluate does
derivatives  0: points only; 1: dt = dC/dt as well; 2: dtt as well
out          a float64 array (..., 3), or CurveDerivatives of such arrays
side         "right" or "left": which limit counts at a knot
threads      how many threads work; -1: one for each processor

Returns a float64 array (..., 3) of points in the model's units; with derivatives a CurveDerivatives of arrays.)");
  curve.def("error_bound", &curve_error_bound, py::arg("vector") = "point", R"(error_bound(self, vector='point')
--

How far any coordinate of "point", "dt" or "dtt" from evaluate is from the exact value, at most and anywhere.)");
}

}  // namespace patchproof::python
