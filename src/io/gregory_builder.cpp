// SPDX-License-Identifier: Apache-2.0
// NURBS boundary Gregory patches of a model: the step from texts to exact patches.
#include <algorithm>

#include "model_builder.h"

namespace patchproof {

template <ExactField T>
std::optional<Error> ModelBuilder<T>::add(const RawGregory& raw) {
  error_.reset();
  std::optional<ModelPatch<T>> u = patch(raw.u_surface);
  if (!u) return error_;
  std::optional<ModelPatch<T>> v = patch(raw.v_surface);
  if (!v) return error_;
  // With positive weights no denominator of the C surface vanishes either.
  for (const auto* surface : {&*u, &*v})
    if (!std::all_of(surface->surface.net().begin(), surface->surface.net().end(),
                     [](const Vec<T, 4>& p) { return T(0) < p[3]; })) {
      fail(ErrorCode::bad_weight, raw.at, "the weights of a Gregory patch should be positive", "", raw.pointer);
      return error_;
    }
  Result<GregoryPatch<T>> made = GregoryPatch<T>::make(std::move(u->surface), std::move(v->surface));
  if (!made) {
    fail(made.error().code, raw.at, made.error().message, made.error().values, raw.pointer);
    return error_;
  }
  if (!corners_agree(*made)) {
    fail(ErrorCode::curves_apart, raw.at,
         "the U and the V surface should have one point and the same derivatives at each corner", "", raw.pointer);
    return error_;
  }
  model_.gregory_patches.push_back({raw.name, std::move(*made)});
  return std::nullopt;
}

template std::optional<Error> ModelBuilder<Rational>::add(const RawGregory&);
template std::optional<Error> ModelBuilder<Quadratic>::add(const RawGregory&);

}  // namespace patchproof
