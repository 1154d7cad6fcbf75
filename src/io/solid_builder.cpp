// SPDX-License-Identifier: Apache-2.0
// The part of ModelBuilder that makes solids.
#include <fmt/format.h>

#include "model_builder.h"
#include "text_cursor.h"

namespace patchproof {

template <ExactField T>
std::optional<typename ModelSolid<T>::Control> ModelBuilder<T>::control(const RawSolid& raw, std::size_t k) {
  const RawSolid::Control& given = raw.controls[k];
  typename ModelSolid<T>::Control out;
  if (given.patch.empty()) {
    std::optional<ModelCurve<T>> point = curve(given.point);
    if (!point) return std::nullopt;
    for (int c = 0; c < 3; ++c) out.point[c] = point->curve.points()[0][c];
    return out;
  }
  const std::string pointer = fmt::format("{}/controls/{}", raw.pointer, k);
  const std::optional<long> index = to_integer(given.patch);
  if (!index || *index < 0 || *index >= static_cast<long>(model_.patches.size())) {
    fail(ErrorCode::bad_reference, given.patch,
         model_.patches.empty() ? std::string("the model has no patches")
                                : fmt::format("the model has patches 0 … {}", model_.patches.size() - 1),
         given.patch, pointer);
    return std::nullopt;
  }
  out.patch = static_cast<int>(*index);
  // Then every blend of them is positive.
  for (const Vec<T, 4>& p : model_.patches[out.patch].surface.net())
    if (!(T(0) < p[3])) {
      fail(ErrorCode::unsupported, given.patch, "the weights of a solid's patches must be positive", to_text(p[3]),
           pointer);
      return std::nullopt;
    }
  return out;
}

template <ExactField T>
std::optional<Error> ModelBuilder<T>::add(const RawSolid& raw) {
  using Map = TransfiniteMap<T, 3, 4>;
  error_.reset();
  std::optional<KnotVector<T>> w = knots(raw.blending, 0);
  if (!w) return error_;
  std::vector<typename ModelSolid<T>::Control> controls;
  std::vector<Map> maps;
  for (std::size_t k = 0; k < raw.controls.size(); ++k) {
    std::optional<typename ModelSolid<T>::Control> read = control(raw, k);
    if (!read) return error_;
    const Vec<T, 3>& x = read->point;
    maps.push_back(read->patch < 0 ? Map(Vec<T, 4>{{x[0], x[1], x[2], T(1)}})
                                   : patch_over<3>(0, 1, model_.patches[read->patch].surface));
    controls.push_back(std::move(*read));
  }
  Result<Map> map = Map::blend(2, *w, std::move(maps));
  if (!map) {
    fail(map.error().code, raw.at, map.error().message, map.error().values, raw.pointer);
    return error_;
  }
  model_.solids.push_back({raw.name, std::move(*map), std::move(w), std::move(controls)});
  return error_;
}

template std::optional<Error> ModelBuilder<Rational>::add(const RawSolid&);
template std::optional<Error> ModelBuilder<Quadratic>::add(const RawSolid&);

}  // namespace patchproof
