// SPDX-License-Identifier: Apache-2.0
// One batch evaluation by the C++ library and by the C API, each timed where it is called, for call_times.py, which alternates
// them with Python's in one process.
#include <chrono>
#include <cstdint>
#include <memory>

#include "patchproof/c_api.h"
#include "patchproof/patch/evaluate_batch.h"

namespace {

struct Surfaces {
  patchproof::BatchSurface cpp;
  patchproof_context* context = nullptr;
  patchproof_surface* c = nullptr;
};

template <class F>
double seconds(const F& f) {
  const auto start = std::chrono::steady_clock::now();
  const bool done = f();
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  return done ? passed.count() : -1;
}

}  // namespace

#define EXPORTED extern "C" __attribute__((visibility("default")))

// NULL: the surface is refused.
EXPORTED void* batch_surface(std::int32_t degree_u, std::int32_t degree_v, const double* knots_u,
                             std::size_t knots_u_length, const double* knots_v, std::size_t knots_v_length,
                             const double* points, std::size_t points_length, const double* weights,
                             std::size_t weights_length) {
  auto made = patchproof::BatchSurface::make({degree_u,
                                              degree_v,
                                              {knots_u, knots_u_length},
                                              {knots_v, knots_v_length},
                                              {points, points_length},
                                              {weights, weights_length}});
  if (!made) return nullptr;
  auto all = std::make_unique<Surfaces>(Surfaces{std::move(*made)});
  patchproof_surface_data data{};
  data.struct_size = sizeof data;
  data.degree_u = degree_u, data.degree_v = degree_v;
  data.knots_u = knots_u, data.knots_u_length = knots_u_length;
  data.knots_v = knots_v, data.knots_v_length = knots_v_length;
  data.points = points, data.points_length = points_length;
  data.weights = weights, data.weights_length = weights_length;
  if (patchproof_context_create(0, &all->context) != PATCHPROOF_OK ||
      patchproof_surface_create(all->context, &data, &all->c) != PATCHPROOF_OK)
    return nullptr;
  return all.release();
}

// Seconds of one call; point, du, dv: x y z …, du and dv may be NULL. Negative: an error.
EXPORTED double cpp_seconds(const void* surfaces, const double* u, const double* v, std::size_t count,
                            std::ptrdiff_t stride, double* point, double* du, double* dv) {
  const auto& s = *static_cast<const Surfaces*>(surfaces);
  return seconds([&] {
    patchproof::SurfaceOutput out;
    out.point = patchproof::VectorArray::interleaved(point);
    if (du != nullptr) out.du = patchproof::VectorArray::interleaved(du);
    if (dv != nullptr) out.dv = patchproof::VectorArray::interleaved(dv);
    return s.cpp.evaluate(patchproof::ParameterArray{u, v, count, stride}, out).has_value();
  });
}

EXPORTED double c_seconds(const void* surfaces, const double* u, const double* v, std::size_t count,
                          std::ptrdiff_t stride, double* point, double* du, double* dv) {
  const auto& s = *static_cast<const Surfaces*>(surfaces);
  return seconds([&] {
    patchproof_derivatives out{};
    out.struct_size = sizeof out;
    out.point = {point, point + 1, point + 2, count, 3};
    if (du != nullptr) out.du = {du, du + 1, du + 2, count, 3};
    if (dv != nullptr) out.dv = {dv, dv + 1, dv + 2, count, 3};
    return patchproof_surface_evaluate(s.context, s.c, {u, v, count, stride}, nullptr, &out) == PATCHPROOF_OK;
  });
}

// The same, into arrays that are made for this call and given back after it.
EXPORTED double cpp_seconds_with_new_arrays(const void* surfaces, const double* u, const double* v, std::size_t count,
                                            std::ptrdiff_t stride, std::int32_t derivatives) {
  return seconds([&] {
    const std::unique_ptr<double[]> point(new double[3 * count]), du(derivatives > 0 ? new double[3 * count] : nullptr),
        dv(derivatives > 0 ? new double[3 * count] : nullptr);
    return cpp_seconds(surfaces, u, v, count, stride, point.get(), du.get(), dv.get()) >= 0;
  });
}
