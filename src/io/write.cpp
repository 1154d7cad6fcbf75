// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/write.h"

#include <algorithm>

#include "json_text.h"

namespace patchproof {
namespace {

using Buffer = fmt::memory_buffer;

template <ExactField T>
void knot_list(Buffer& out, const KnotVector<T>& knots) {
  json_list(out, static_cast<int>(knots.knots().size()), ", ", [&](int i) { put(out, "{}", json_number(knots[i])); });
}

template <ExactField T>
void knots(Buffer& out, const BsplinePatch<T, 4>& surface) {
  const KnotVector<T>&u = surface.knots(Direction::u), &v = surface.knots(Direction::v);
  if (u == KnotVector<T>::bezier(u.degree()) && v == KnotVector<T>::bezier(v.degree())) return;
  put(out, ",\n      \"knots\": [");
  knot_list(out, u);
  put(out, ", ");
  knot_list(out, v);
  put(out, "]");
}

template <ExactField T>
bool has_zero_weight(const std::vector<Vec<T, 4>>& points) {
  return std::any_of(points.begin(), points.end(), [](const Vec<T, 4>& p) { return p[3] == T(0); });
}

// [x, y] or [x, y, z]; homogeneous: [w·x, w·y, w] or [w·x, w·y, w·z, w].
template <ExactField T>
void point(Buffer& out, const Vec<T, 4>& p, int dimension, bool homogeneous) {
  json_list(out, dimension + (homogeneous ? 1 : 0), ", ", [&](int c) {
    put(out, "{}", json_number(!homogeneous ? p[c] / p[3] : c == dimension ? p[3] : p[c]));
  });
}

void begin_spline(Buffer& out, const std::string& name) {
  put(out, "    {{\n");
  if (!name.empty()) put(out, "      \"name\": {},\n", json_string(name));
}

template <ExactField T>
void curve(Buffer& out, const ModelCurve<T>& curve) {
  const KnotVector<T>& knots = curve.curve.knots();
  const std::vector<Vec<T, 4>>& points = curve.curve.points();
  PATCHPROOF_REQUIRES(curve.dimension == 3 ||
                          std::all_of(points.begin(), points.end(), [](const Vec<T, 4>& p) { return p[2] == T(0); }),
                      "write_model_json: a curve in the plane has z = 0");
  const bool homogeneous = has_zero_weight(points);
  const int count = static_cast<int>(points.size());
  begin_spline(out, curve.name);
  put(out, "      \"degree\": {}", knots.degree());
  if (!(knots == KnotVector<T>::bezier(knots.degree()))) {
    put(out, ",\n      \"knots\": ");
    knot_list(out, knots);
  }
  if (homogeneous) put(out, ",\n      \"homogeneous\": true");
  put(out, ",\n      \"control_points\": ");
  json_list(out, count, ", ", [&](int i) { point(out, points[i], curve.dimension, homogeneous); });
  if (curve.is_rational && !homogeneous) {
    put(out, ",\n      \"weights\": ");
    json_list(out, count, ", ", [&](int i) { put(out, "{}", json_number(points[i][3])); });
  }
  put(out, "\n    }}");
}

// "degree" … "weights" of a patch, without the braces around it.
template <ExactField T>
void surface(Buffer& out, const BsplinePatch<T, 4>& surface, bool is_rational) {
  const int rows = surface.count(Direction::u), columns = surface.count(Direction::v);
  const bool homogeneous = has_zero_weight(surface.net());
  put(out, "      \"degree\": [{}, {}]", surface.degree(Direction::u), surface.degree(Direction::v));
  knots(out, surface);
  put(out, ",\n      \"control_points\": ");
  json_list(out, rows, ",\n        ", [&](int i) {
    json_list(out, columns, ", ", [&](int j) { point(out, surface.point(i, j), 3, homogeneous); });
  });
  if (is_rational && !homogeneous) {
    put(out, ",\n      \"weights\": ");
    json_list(out, rows, ",\n        ", [&](int i) {
      json_list(out, columns, ", ", [&](int j) { put(out, "{}", json_number(surface.point(i, j)[3])); });
    });
  }
}

template <ExactField T>
void patch(Buffer& out, const ModelPatch<T>& patch) {
  begin_spline(out, patch.name);
  surface(out, patch.surface, patch.is_rational);
  put(out, "\n    }}");
}

template <ExactField T>
void gregory_patch(Buffer& out, const ModelGregoryPatch<T>& patch) {
  begin_spline(out, patch.name);
  for (const auto* of : {&patch.patch.u_surface(), &patch.patch.v_surface()}) {
    const bool is_rational =
        std::any_of(of->net().begin(), of->net().end(), [](const Vec<T, 4>& p) { return !(p[3] == T(1)); });
    put(out, "      \"{}\": {{\n", of == &patch.patch.u_surface() ? "u" : "v");
    surface(out, *of, is_rational);
    put(out, "\n      }}{}", of == &patch.patch.u_surface() ? ",\n" : "");
  }
  put(out, "\n    }}");
}

// "degree" … of a local curve or patch; the points of a trigonometric one are
// its coefficients.
template <ExactField T>
void bases(Buffer& out, const std::vector<const FunctionBasis<T>*>& of) {
  const bool one = of.size() == 1;
  std::string trigonometric;
  for (std::size_t d = 0; d < of.size(); ++d)
    if (of[d]->is_trigonometric()) trigonometric += one ? 't' : "uv"[d];
  const auto degree = [](const FunctionBasis<T>& b) { return b.knots() ? b.knots()->degree() : (b.count() - 1) / 2; };
  const auto list = [&](const FunctionBasis<T>& b) {
    if (b.knots())
      knot_list(out, *b.knots());
    else
      put(out, "[]");
  };
  put(out, "\"degree\": ");
  if (one)
    put(out, "{}", degree(*of[0]));
  else
    put(out, "[{}, {}]", degree(*of[0]), degree(*of[1]));
  if (!trigonometric.empty()) put(out, ", \"trigonometric\": \"{}\"", trigonometric);
  if (one && !trigonometric.empty()) return;
  put(out, ", \"knots\": ");
  if (one)
    list(*of[0]);
  else
    json_list(out, 2, ", ", [&](int d) { list(*of[d]); });
}

// Local curves and patches; each in full at its first appearance.
template <class Local, class PutLocal>
void locals(Buffer& out, const std::vector<Local>& all, PutLocal put_local) {
  put(out, ",\n      \"locals\": ");
  json_list(out, static_cast<int>(all.size()), ",\n        ", [&](int k) {
    const auto first = std::find(all.begin(), all.begin() + k, all[k]);
    if (first != all.begin() + k)
      put(out, "{{\"same_as\": {}}}", first - all.begin());
    else
      put_local(all[k]);
  });
}

template <ExactField T>
void breaks(Buffer& out, const KnotVector<T>& knots) {
  json_list(out, knots.control_count(), ", ", [&](int i) { put(out, "{}", json_number(knots[i + 1])); });
}

// Points of a spline, with weights where one differs from 1; coefficients of
// trigonometric functions.
template <ExactField T>
struct LocalPoints {
  const std::vector<Vec<T, 4>>& points;
  int dimension;
  bool plain;  // no weights
  bool homogeneous() const { return !plain && has_zero_weight(points); }
  bool separate() const { return !plain && !homogeneous(); }
  void put_point(Buffer& out, std::size_t k) const {
    Vec<T, 4> p = points[k];
    if (plain) p[3] = T(1);
    point(out, p, dimension, homogeneous());
  }
};

template <ExactField T>
void gerbs_curve(Buffer& out, const ModelGerbsCurve<T>& curve) {
  const GerbsCurve<T, 4>& c = curve.curve;
  begin_spline(out, curve.name);
  put(out,
      "      \"b_function\": {},\n      \"closed\": {},\n      \"knots\": ", json_string(c.b_function().to_string()),
      c.is_closed());
  breaks(out, c.knots());
  std::vector<LocalCurve<T, 4>> all = c.locals();
  if (c.is_closed()) all.pop_back();
  locals(out, all, [&](const LocalCurve<T, 4>& moved) {
    const LocalCurve<T, 4> l = moved.basis().is_trigonometric() ? moved : LocalCurve<T, 4>(moved.spline());
    const LocalPoints<T> p{l.points(), curve.dimension, l.has_unit_weights()};
    put(out, "{{");
    bases<T>(out, {&l.basis()});
    if (p.homogeneous()) put(out, ", \"homogeneous\": true");
    put(out, ", \"control_points\": ");
    json_list(out, static_cast<int>(l.points().size()), ", ", [&](int k) { p.put_point(out, k); });
    if (p.separate()) {
      put(out, ", \"weights\": ");
      json_list(out, static_cast<int>(l.points().size()), ", ",
                [&](int k) { put(out, "{}", json_number(l.points()[k][3])); });
    }
    put(out, "}}");
  });
  put(out, "\n    }}");
}

template <ExactField T>
void gerbs_patch(Buffer& out, const ModelGerbsPatch<T>& patch) {
  const GerbsSurface<T, 4>& s = patch.surface;
  const auto &u = s.axis(Direction::u), &v = s.axis(Direction::v);
  begin_spline(out, patch.name);
  put(out,
      "      \"b_function\": {},\n      \"closed\": [{}, {}],\n      "
      "\"knots\": [",
      json_string(s.b_function().to_string()), u.closed, v.closed);
  breaks(out, u.knots);
  put(out, ", ");
  breaks(out, v.knots);
  put(out, "]");
  std::vector<LocalSurface<T, 4>> all;
  for (int p = 0; p < u.distinct(); ++p)
    for (int q = 0; q < v.distinct(); ++q) all.push_back(s.local(p, q));
  locals(out, all, [&](const LocalSurface<T, 4>& l) {
    const int rows = l.basis(Direction::u).count(), columns = l.basis(Direction::v).count();
    const LocalPoints<T> p{l.net(), 3, l.has_unit_weights()};
    put(out, "{{");
    bases<T>(out, {&l.basis(Direction::u), &l.basis(Direction::v)});
    put(out, ", \"control_points\": ");
    json_list(out, rows, ", ",
              [&](int i) { json_list(out, columns, ", ", [&](int j) { p.put_point(out, i * columns + j); }); });
    if (p.separate()) {
      put(out, ", \"weights\": ");
      json_list(out, rows, ", ", [&](int i) {
        json_list(out, columns, ", ", [&](int j) { put(out, "{}", json_number(l.net()[i * columns + j][3])); });
      });
    }
    put(out, "}}");
  });
  put(out, "\n    }}");
}

template <ExactField T>
void solid(Buffer& out, const ModelSolid<T>& solid) {
  PATCHPROOF_REQUIRES(solid.knots,
                      "write_model_json: the format holds solids "
                      "that are made from patches and points");
  begin_spline(out, solid.name);
  put(out, "      \"transfinite\": {{\"degree\": {}, ", solid.knots->degree());
  if (!(*solid.knots == KnotVector<T>::bezier(solid.knots->degree()))) {
    put(out, "\"knots\": ");
    knot_list(out, *solid.knots);
    put(out, ", ");
  }
  put(out, "\"controls\": ");
  json_list(out, static_cast<int>(solid.controls.size()), ", ", [&](int k) {
    const auto& control = solid.controls[k];
    const Vec<T, 3>& x = control.point;
    if (control.patch >= 0)
      put(out, "{}", control.patch);
    else
      json_list(out, 3, ", ", [&](int c) { put(out, "{}", json_number(x[c])); });
  });
  put(out, "}}\n    }}");
}

// ,
//   "patches": [ … ]
template <class Elements, class Put>
void section(Buffer& out, const char* key, const Elements& elements, Put put_element) {
  if (elements.empty()) return;
  put(out, ",\n  \"{}\": [\n", key);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (k > 0) put(out, ",\n");
    put_element(elements[k]);
  }
  put(out, "\n  ]");
}

}  // namespace

template <ExactField T>
std::string write_model_json(const Model<T>& model) {
  Buffer out;
  put(out, "{{\n  \"format\": \"patchproof-model\",\n  \"version\": 1");
  if (!model.units.empty()) put(out, ",\n  \"units\": {}", json_string(model.units));
  section(out, "curves", model.curves, [&](const ModelCurve<T>& c) { curve(out, c); });
  section(out, "gerbs_curves", model.gerbs_curves, [&](const ModelGerbsCurve<T>& c) { gerbs_curve(out, c); });
  section(out, "patches", model.patches, [&](const ModelPatch<T>& p) { patch(out, p); });
  section(out, "gerbs_patches", model.gerbs_patches, [&](const ModelGerbsPatch<T>& p) { gerbs_patch(out, p); });
  section(out, "gregory_patches", model.gregory_patches, [&](const ModelGregoryPatch<T>& p) { gregory_patch(out, p); });
  section(out, "solids", model.solids, [&](const ModelSolid<T>& s) { solid(out, s); });
  section(out, "joins", model.joins, [&](const DeclaredJoin& join) {
    put(out,
        "    {{\"a\": {{\"patch\": {}, \"edge\": \"{}\"}}, \"b\": {{\"patch\": "
        "{}, \"edge\": \"{}\"}}, "
        "\"reversed\": {}}}",
        join.patch_a, to_string(join.edge_a), join.patch_b, to_string(join.edge_b), join.reversed);
  });
  put(out, "\n}}\n");
  return fmt::to_string(out);
}

template std::string write_model_json(const Model<Rational>&);
template std::string write_model_json(const Model<Quadratic>&);

}  // namespace patchproof
