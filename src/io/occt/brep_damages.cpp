// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "brep_text.h"

namespace patchproof::occt {
namespace {

const std::optional<Damage>* damage_of(const std::vector<BrepEntity>& entities, int index) {
  return index > 0 && entities[index - 1].damage ? &entities[index - 1].damage : nullptr;
}

}  // namespace

Damages BrepText::damages() const {
  Damages out(shapes.size());
  // Of an edge that lies on this surface, or of a wire.
  const auto on_surface = [&](const auto& self, int shape, int surface) -> const std::optional<Damage>* {
    if (shapes[shape].kind == "Ed")
      for (const BrepParameters& p : shapes[shape].parameters)
        if (p.surface == surface)
          if (const auto* damage = damage_of(curves2d, p.curve)) return damage;
    if (shapes[shape].kind == "Wi")
      for (const int part : shapes[shape].parts)
        if (const auto* damage = self(self, part, surface)) return damage;
    return nullptr;
  };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const BrepShape& shape = shapes[i];
    const auto take = [&](const std::optional<Damage>* damage) {
      if (!out[i] && damage && *damage) out[i] = *damage;
    };
    take(&shape.damage);
    take(damage_of(surfaces, shape.surface));
    for (const int curve : shape.curves) take(damage_of(curves, curve));
    for (const int part : shape.parts) take(&out[part]);
    if (shape.kind == "Fa")
      for (const int part : shape.parts) take(on_surface(on_surface, part, shape.surface));
  }
  return out;
}

std::string BrepText::mended(std::string_view bytes) const {
  std::vector<Replacement> all = numbers;
  const auto replace = [&](const std::vector<BrepEntity>& entities, const char* by) {
    for (const BrepEntity& entity : entities)
      if (entity.damage) all.push_back({entity.begin, entity.end, by});
  };
  replace(curves2d, "1 0 0 1 0 ");
  replace(curves, "1 0 0 0 1 0 0 ");
  replace(surfaces, "1 0 0 0 0 0 1 1 0 0 0 1 0 ");
  std::sort(all.begin(), all.end(), [](const Replacement& a, const Replacement& b) { return a.begin < b.begin; });
  std::string out;
  std::size_t at = 0;
  for (const Replacement& r : all) {
    out.append(bytes.substr(at, r.begin - at)).append(r.by);
    at = r.end;
  }
  return out.append(bytes.substr(at));
}

}  // namespace patchproof::occt
