// SPDX-License-Identifier: Apache-2.0
// Evaluation in doubles. Nothing is copied: the kernels read and write the caller's arrays.
#include <fmt/format.h>

#include <array>

#include "c_api/models.h"
#include "patchproof/patch/evaluate_batch.h"

struct patchproof_surface : patchproof::c_api::Handle<patchproof::BatchSurface> {
  using Handle::Handle;
};
struct patchproof_curve : patchproof::c_api::Handle<patchproof::BatchCurve> {
  using Handle::Handle;
};

namespace patchproof::c_api {
namespace {

struct EvaluateOptions {
  Side side_u, side_v;
  int threads;
  SurfaceBatchOptions surface() const { return {side_u, side_v, threads}; }
  CurveBatchOptions curve() const { return {side_u, threads}; }
};

EvaluateOptions evaluate_options(const patchproof_evaluate_options* options) {
  const patchproof_evaluate_options o = options_of(options, "options");
  require_value(o.side_u, PATCHPROOF_SIDE_LEFT, "options.side_u");
  require_value(o.side_v, PATCHPROOF_SIDE_LEFT, "options.side_v");
  if (o.threads < -1 || o.threads > 1024) bad_argument("options.threads", "is −1 to 1024", std::to_string(o.threads));
  const auto side = [](std::int32_t s) { return s == PATCHPROOF_SIDE_RIGHT ? Side::right : Side::left; };
  return {side(o.side_u), side(o.side_v), o.threads == -1 ? 0 : std::max(1, o.threads)};
}

ParameterArray parameters(const patchproof_parameters& at, bool two) {
  if (at.count > PTRDIFF_MAX / sizeof(double))
    bad_argument("at.count", "is more than memory can hold", std::to_string(at.count));
  require_array(at.u, at.count, "at.u");
  if (two) require_array(at.v, at.count, "at.v");
  if (!two && at.v != nullptr) bad_argument("at.v", "is not NULL, and a curve has one parameter");
  return {at.u, two ? at.v : nullptr, at.count, at.stride == 0 ? 1 : at.stride};
}

VectorArray place_of(const patchproof_vectors& out, std::size_t count, const char* name) {
  if (out.x == nullptr && out.y == nullptr && out.z == nullptr) return {};
  if (out.x == nullptr || out.y == nullptr || out.z == nullptr)
    bad_argument(name, "has a place for some of x, y and z only");
  if (out.count != count)
    bad_argument(std::string(name) + ".count", fmt::format("there are {} parameters", count),
                 std::to_string(out.count));
  return {out.x, out.y, out.z, out.stride == 0 ? 1 : out.stride};
}
VectorArray needed_place(const patchproof_vectors& out, std::size_t count, const char* name) {
  const VectorArray place = place_of(out, count, name);
  if (!place.wanted() && count > 0) bad_argument(name, "is NULL");
  return place;
}

SurfaceOutput surface_output(const patchproof_derivatives& out, std::size_t count) {
  return {place_of(out.point, count, "out.point"), place_of(out.du, count, "out.du"),
          place_of(out.dv, count, "out.dv"),       place_of(out.normal, count, "out.normal"),
          place_of(out.duu, count, "out.duu"),     place_of(out.duv, count, "out.duv"),
          place_of(out.dvv, count, "out.dvv")};
}

patchproof_derivatives* checked(patchproof_derivatives* out) {
  require_place(out, "out");
  known_size(out->struct_size, sizeof *out, "out");
  return out;
}

void finish(patchproof_derivatives* out, const Result<BatchSummary>& summary) {
  if (!summary) bad_data(summary.error());
  out->undefined_normals = summary->undefined_normals;
}
void finish(const Result<BatchSummary>& summary) {
  if (!summary) bad_data(summary.error());
}

template <class Data>
std::span<const double> list(const double* data, std::size_t length, const Data& name) {
  require_array(data, length, name);
  return {data, length};
}

int degree_of(std::int32_t degree, const char* name) {
  constexpr std::int32_t kLargest = 1 << 20;
  if (degree > kLargest) bad_argument(name, "no surface has this degree", std::to_string(degree));
  return degree;
}

template <class S>
std::span<const double> points_of(const S& data) {
  if (data.points_length % 3 != 0)
    bad_argument("data.points_length", "a control point has 3 numbers", std::to_string(data.points_length));
  return list(data.points, data.points_length, "data.points");
}

constexpr std::array kSurfaceVectors{SurfaceVector::point, SurfaceVector::du,  SurfaceVector::dv,
                                     SurfaceVector::duu,   SurfaceVector::duv, SurfaceVector::dvv};

}  // namespace
}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_surface_of(patchproof_context* context, const patchproof_model* model, size_t patch,
                                        patchproof_surface** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    const DoubleSpline s = std::visit([&](const auto& m) { return doubles_of(spline_patch(m, patch)); },
                                      content_of(model, "model").file.model);
    hand_over(context,
              take(BatchSurface::make({s.degree[0], s.degree[1], s.knots[0], s.knots[1], s.points, s.weights})), out);
  });
}

patchproof_status patchproof_surface_create(patchproof_context* context, const patchproof_surface_data* data,
                                            patchproof_surface** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    require_place(data, "data");
    const patchproof_surface_data d = options_of(data, "data");
    hand_over(context,
              take(BatchSurface::make({degree_of(d.degree_u, "data.degree_u"), degree_of(d.degree_v, "data.degree_v"),
                                       list(d.knots_u, d.knots_u_length, "data.knots_u"),
                                       list(d.knots_v, d.knots_v_length, "data.knots_v"), points_of(d),
                                       list(d.weights, d.weights_length, "data.weights")})),
              out);
  });
}

patchproof_status patchproof_surface_free(patchproof_surface* surface) noexcept { return free_handle(surface); }

patchproof_status patchproof_curve_of(patchproof_context* context, const patchproof_model* model, size_t curve,
                                      patchproof_curve** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    const DoubleSpline s = std::visit([&](const auto& m) { return doubles_of(spline_curve(m, curve)); },
                                      content_of(model, "model").file.model);
    hand_over(context, take(BatchCurve::make({s.degree[0], s.knots[0], s.points, s.weights})), out);
  });
}

patchproof_status patchproof_curve_create(patchproof_context* context, const patchproof_curve_data* data,
                                          patchproof_curve** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    require_place(data, "data");
    const patchproof_curve_data d = options_of(data, "data");
    hand_over(context,
              take(BatchCurve::make({degree_of(d.degree, "data.degree"), list(d.knots, d.knots_length, "data.knots"),
                                     points_of(d), list(d.weights, d.weights_length, "data.weights")})),
              out);
  });
}

patchproof_status patchproof_curve_free(patchproof_curve* curve) noexcept { return free_handle(curve); }

patchproof_status patchproof_surface_evaluate(patchproof_context* context, const patchproof_surface* surface,
                                              patchproof_parameters at, const patchproof_evaluate_options* options,
                                              patchproof_derivatives* out) noexcept {
  return call(context, [&] {
    const BatchSurface& s = content_of(surface, "surface");
    const ParameterArray uv = parameters(at, true);
    finish(out, s.evaluate(uv, surface_output(*checked(out), uv.count), evaluate_options(options).surface()));
  });
}

patchproof_status patchproof_surface_evaluate_grid(patchproof_context* context, const patchproof_surface* surface,
                                                   const double* u, size_t u_length, const double* v, size_t v_length,
                                                   const patchproof_evaluate_options* options,
                                                   patchproof_derivatives* out) noexcept {
  return call(context, [&] {
    const BatchSurface& s = content_of(surface, "surface");
    const auto us = list(u, u_length, "u"), vs = list(v, v_length, "v");
    if (v_length != 0 && u_length > PTRDIFF_MAX / v_length)
      bad_argument("u_length, v_length", "the grid has more points than memory can hold");
    finish(out, s.evaluate_grid(us, vs, surface_output(*checked(out), u_length * v_length),
                                evaluate_options(options).surface()));
  });
}

patchproof_status patchproof_curve_evaluate(patchproof_context* context, const patchproof_curve* curve,
                                            patchproof_parameters at, const patchproof_evaluate_options* options,
                                            patchproof_derivatives* out) noexcept {
  return call(context, [&] {
    const BatchCurve& c = content_of(curve, "curve");
    const ParameterArray t = parameters(at, false);
    const SurfaceOutput places = surface_output(*checked(out), t.count);
    if (places.dv.wanted() || places.normal.wanted() || places.duv.wanted() || places.dvv.wanted())
      bad_argument("out", "of a curve there are point, du and duu");
    finish(out, c.evaluate(t, {places.point, places.du, places.duu}, evaluate_options(options).curve()));
  });
}

patchproof_status patchproof_surface_error_bound(patchproof_context* context, const patchproof_surface* surface,
                                                 int32_t vector, double* out) noexcept {
  return call(context, [&] {
    const BatchSurface& s = content_of(surface, "surface");
    require_value(vector, PATCHPROOF_VECTOR_DVV, "vector");
    require_place(out, "out");
    *out = s.error_bound(kSurfaceVectors[static_cast<std::size_t>(vector)]);
  });
}

patchproof_status patchproof_curve_error_bound(patchproof_context* context, const patchproof_curve* curve,
                                               int32_t vector, double* out) noexcept {
  return call(context, [&] {
    const BatchCurve& c = content_of(curve, "curve");
    require_place(out, "out");
    if (vector != PATCHPROOF_VECTOR_POINT && vector != PATCHPROOF_VECTOR_DU && vector != PATCHPROOF_VECTOR_DUU)
      bad_argument("vector", "of a curve there are point, du and duu", std::to_string(vector));
    *out = c.error_bound(vector == PATCHPROOF_VECTOR_POINT ? 0 : vector == PATCHPROOF_VECTOR_DU ? 1 : 2);
  });
}

patchproof_status patchproof_surface_evaluate_bounded(patchproof_context* context, const patchproof_surface* surface,
                                                      patchproof_parameters at,
                                                      const patchproof_evaluate_options* options,
                                                      patchproof_vectors point, double* bound,
                                                      size_t bound_length) noexcept {
  return call(context, [&] {
    const BatchSurface& s = content_of(surface, "surface");
    const ParameterArray uv = parameters(at, true);
    require_array(bound, uv.count, "bound");
    if (bound_length != uv.count)
      bad_argument("bound_length", fmt::format("there are {} parameters", uv.count), std::to_string(bound_length));
    finish(s.evaluate_bounded(uv, needed_place(point, uv.count, "point"), bound, evaluate_options(options).surface()));
  });
}

patchproof_status patchproof_surface_enclose(patchproof_context* context, const patchproof_surface* surface,
                                             patchproof_parameters at, const patchproof_evaluate_options* options,
                                             patchproof_vectors lower, patchproof_vectors upper) noexcept {
  return call(context, [&] {
    const BatchSurface& s = content_of(surface, "surface");
    const ParameterArray uv = parameters(at, true);
    finish(s.evaluate_interval(uv, needed_place(lower, uv.count, "lower"), needed_place(upper, uv.count, "upper"),
                               evaluate_options(options).surface()));
  });
}

patchproof_status patchproof_surface_evaluate_rounded(patchproof_context* context, const patchproof_surface* surface,
                                                      patchproof_parameters at,
                                                      const patchproof_evaluate_options* options,
                                                      patchproof_vectors point) noexcept {
  return call(context, [&] {
    const BatchSurface& s = content_of(surface, "surface");
    const ParameterArray uv = parameters(at, true);
    if (uv.count == 0) return;
    finish(
        s.evaluate_correctly_rounded(uv, needed_place(point, uv.count, "point"), evaluate_options(options).surface()));
  });
}
