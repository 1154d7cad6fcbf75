// SPDX-License-Identifier: Apache-2.0
// What a model holds, as numbers.
#include "c_api/models.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof::c_api {
namespace {

// The nearest double, and whether it is the number.
template <ExactField T>
double rounded(const T& x, bool& is_exact) {
  const double y = nearest_double(x);
  is_exact = is_exact && embed<T>(from_double(y)) == x;
  return y;
}

template <ExactField T>
std::vector<double> rounded_knots(const KnotVector<T>& knots, bool& is_exact) {
  std::vector<double> out;
  for (const T& t : knots.knots()) out.push_back(rounded(t, is_exact));
  return out;
}

template <ExactField T>
void add_points(const std::vector<Vec<T, 4>>& net, DoubleSpline& out) {
  for (const Vec<T, 4>& p : net) {
    if (p[3] == T(0))
      bad_data({ErrorCode::unsupported, "points", "a control point of weight 0 has no place in space",
                to_text(p[0]) + " " + to_text(p[1]) + " " + to_text(p[2])});
    for (int c = 0; c < 3; ++c) out.points.push_back(rounded(T(p[c] / p[3]), out.is_exact));
    out.weights.push_back(rounded(p[3], out.is_exact));
  }
  if (!out.is_rational) out.weights.clear();
}

void write_spline(const DoubleSpline& spline, const patchproof_spline_buffers* out) {
  require_place(out, "out");
  const patchproof_spline_buffers to = options_of(out, "out");
  // All lengths are looked at before anything is written.
  for (const bool write : {false, true}) {
    const auto list = [&](const std::vector<double>& numbers, double* place, std::size_t length, const char* name) {
      if (write && place != nullptr) std::copy(numbers.begin(), numbers.end(), place);
      if (!write && place != nullptr && length != numbers.size())
        bad_argument(std::string("out.") + name + "_length", "there are " + std::to_string(numbers.size()) + " numbers",
                     std::to_string(length));
    };
    list(spline.knots[0], to.knots_u, to.knots_u_length, "knots_u");
    list(spline.knots[1], to.knots_v, to.knots_v_length, "knots_v");
    list(spline.points, to.points, to.points_length, "points");
    list(spline.weights, to.weights, to.weights_length, "weights");
  }
}

template <ExactField T>
bool are_doubles(const std::vector<Vec<T, 4>>& net) {
  bool is_exact = true;
  for (const Vec<T, 4>& p : net) {
    if (p[3] == T(0)) return false;
    for (int c = 0; c < 3; ++c) rounded(T(p[c] / p[3]), is_exact);
    rounded(p[3], is_exact);
    if (!is_exact) return false;
  }
  return true;
}

// Of a B-spline.
template <class Part>
void describe_spline(const Part& part, patchproof_spline_info& out) {
  bool is_exact = true;
  const auto direction = [&](const auto& knots, int d) {
    (d == 0 ? out.degree_u : out.degree_v) = knots.degree();
    (d == 0 ? out.points_u : out.points_v) = static_cast<std::size_t>(knots.control_count());
    (d == 0 ? out.knots_u : out.knots_v) = knots.knots().size();
    rounded_knots(knots, is_exact);
  };
  if constexpr (requires { part.surface; }) {
    direction(part.surface.knots(Direction::u), 0);
    direction(part.surface.knots(Direction::v), 1);
    is_exact = is_exact && are_doubles(part.surface.net());
  } else {
    direction(part.curve.knots(), 0);
    is_exact = is_exact && are_doubles(part.curve.points());
  }
  out.kind = PATCHPROOF_KIND_BSPLINE;
  out.is_rational = part.is_rational ? 1 : 0;
  out.is_double = is_exact ? 1 : 0;
}

template <class Knots>
void describe_domain(const Knots& knots, double* out) {
  out[0] = nearest_double(knots.domain_begin());
  out[1] = nearest_double(knots.domain_end());
}

template <ExactField T>
patchproof_spline_info info_of_patch(const Model<T>& model, std::size_t patch) {
  require_index(patch, patch_count(model), "patch");
  patchproof_spline_info out{};
  if (patch < model.patches.size()) {
    const ModelPatch<T>& p = model.patches[patch];
    describe_spline(p, out);
    describe_domain(p.surface.knots(Direction::u), out.domain);
    describe_domain(p.surface.knots(Direction::v), out.domain + 2);
    out.name = borrowed(p.name);
  } else if (const std::size_t g = patch - model.patches.size(); g < model.gerbs_patches.size()) {
    const ModelGerbsPatch<T>& p = model.gerbs_patches[g];
    out.kind = PATCHPROOF_KIND_GERBS;
    describe_domain(p.surface.knots(Direction::u), out.domain);
    describe_domain(p.surface.knots(Direction::v), out.domain + 2);
    out.name = borrowed(p.name);
  } else {
    out.kind = PATCHPROOF_KIND_GREGORY;
    out.domain[1] = out.domain[3] = 1;
    out.name = borrowed(model.gregory_patches[g - model.gerbs_patches.size()].name);
  }
  return out;
}

template <ExactField T>
patchproof_spline_info info_of_curve(const Model<T>& model, std::size_t curve) {
  require_index(curve, curve_count(model), "curve");
  patchproof_spline_info out{};
  if (curve < model.curves.size()) {
    describe_spline(model.curves[curve], out);
    describe_domain(model.curves[curve].curve.knots(), out.domain);
    out.name = borrowed(model.curves[curve].name);
  } else {
    const ModelGerbsCurve<T>& c = model.gerbs_curves[curve - model.curves.size()];
    out.kind = PATCHPROOF_KIND_GERBS;
    describe_domain(c.curve.knots(), out.domain);
    out.name = borrowed(c.name);
  }
  return out;
}

}  // namespace

template <ExactField T>
const ModelPatch<T>& spline_patch(const Model<T>& model, std::size_t patch) {
  require_index(patch, patch_count(model), "patch");
  if (patch >= model.patches.size())
    bad_data({ErrorCode::unsupported, "patch " + std::to_string(patch),
              patch < model.patches.size() + model.gerbs_patches.size() ? "a GERBS patch is no B-spline"
                                                                        : "a Gregory patch is no B-spline",
              ""});
  return model.patches[patch];
}

template <ExactField T>
const ModelCurve<T>& spline_curve(const Model<T>& model, std::size_t curve) {
  require_index(curve, curve_count(model), "curve");
  if (curve >= model.curves.size())
    bad_data({ErrorCode::unsupported, "curve " + std::to_string(curve), "a GERBS curve is no B-spline", ""});
  return model.curves[curve];
}

template <ExactField T>
DoubleSpline doubles_of(const ModelPatch<T>& patch) {
  DoubleSpline out;
  out.is_rational = patch.is_rational;
  for (const Direction d : {Direction::u, Direction::v}) {
    const KnotVector<T>& knots = patch.surface.knots(d);
    const int i = d == Direction::u ? 0 : 1;
    out.degree[i] = knots.degree();
    out.knots[i] = rounded_knots(knots, out.is_exact);
  }
  add_points(patch.surface.net(), out);
  return out;
}

template <ExactField T>
DoubleSpline doubles_of(const ModelCurve<T>& curve) {
  DoubleSpline out;
  out.is_rational = curve.is_rational;
  out.degree[0] = curve.curve.degree();
  out.knots[0] = rounded_knots(curve.curve.knots(), out.is_exact);
  add_points(curve.curve.points(), out);
  return out;
}

template const ModelPatch<Rational>& spline_patch(const Model<Rational>&, std::size_t);
template const ModelPatch<Quadratic>& spline_patch(const Model<Quadratic>&, std::size_t);
template const ModelCurve<Rational>& spline_curve(const Model<Rational>&, std::size_t);
template const ModelCurve<Quadratic>& spline_curve(const Model<Quadratic>&, std::size_t);
template DoubleSpline doubles_of(const ModelPatch<Rational>&);
template DoubleSpline doubles_of(const ModelPatch<Quadratic>&);
template DoubleSpline doubles_of(const ModelCurve<Rational>&);
template DoubleSpline doubles_of(const ModelCurve<Quadratic>&);

}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_model_get_info(patchproof_context* context, const patchproof_model* model,
                                            patchproof_model_info* out) noexcept {
  return call(context, [&] {
    const ModelContent& content = content_of(model, "model");
    patchproof_model_info info{};
    std::visit(
        [&](const auto& m) {
          info.patches = patch_count(m);
          info.gerbs_patches = m.gerbs_patches.size();
          info.gregory_patches = m.gregory_patches.size();
          info.curves = curve_count(m);
          info.gerbs_curves = m.gerbs_curves.size();
          info.solids = m.solids.size();
          info.units = borrowed(m.units);
        },
        content.file.model);
    info.format = borrowed(content.file.format);
    info.notes = borrowed(content.notes);
    write_struct(out, info, "out");
  });
}

patchproof_status patchproof_model_patch_get_info(patchproof_context* context, const patchproof_model* model,
                                                  size_t patch, patchproof_spline_info* out) noexcept {
  return call(context, [&] {
    write_struct(
        out, std::visit([&](const auto& m) { return info_of_patch(m, patch); }, content_of(model, "model").file.model),
        "out");
  });
}

patchproof_status patchproof_model_curve_get_info(patchproof_context* context, const patchproof_model* model,
                                                  size_t curve, patchproof_spline_info* out) noexcept {
  return call(context, [&] {
    write_struct(
        out, std::visit([&](const auto& m) { return info_of_curve(m, curve); }, content_of(model, "model").file.model),
        "out");
  });
}

patchproof_status patchproof_model_patch_get_data(patchproof_context* context, const patchproof_model* model,
                                                  size_t patch, const patchproof_spline_buffers* out) noexcept {
  return call(context, [&] {
    write_spline(std::visit([&](const auto& m) { return doubles_of(spline_patch(m, patch)); },
                            content_of(model, "model").file.model),
                 out);
  });
}

patchproof_status patchproof_model_curve_get_data(patchproof_context* context, const patchproof_model* model,
                                                  size_t curve, const patchproof_spline_buffers* out) noexcept {
  return call(context, [&] {
    write_spline(std::visit([&](const auto& m) { return doubles_of(spline_curve(m, curve)); },
                            content_of(model, "model").file.model),
                 out);
  });
}
