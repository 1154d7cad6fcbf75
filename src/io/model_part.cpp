// SPDX-License-Identifier: Apache-2.0
#include "model_part.h"

namespace patchproof {
namespace {

template <ExactField T>
std::pair<T, T> ends(const KnotVector<T>& knots) {
  return {knots.domain_begin(), knots.domain_end()};
}

template <ExactField T>
PartDomain<T> domain(const BsplinePatch<T, 4>& patch) {
  return {ends(patch.knots(Direction::u)), ends(patch.knots(Direction::v))};
}
template <ExactField T>
PartDomain<T> domain(const GerbsSurface<T, 4>& patch) {
  return {ends(patch.knots(Direction::u)), ends(patch.knots(Direction::v))};
}
template <ExactField T>
PartDomain<T> domain(const GregoryPatch<T>&) {
  return {{T(0), T(1)}, {T(0), T(1)}};
}
template <ExactField T>
PartDomain<T> domain(const ModelCurve<T>& model) {
  return {ends(model.curve.knots())};
}
template <ExactField T>
PartDomain<T> domain(const ModelGerbsCurve<T>& model) {
  return {ends(model.curve.knots())};
}
template <ExactField T>
PartDomain<T> domain(const TransfiniteMap<T, 3, 4>& map) {
  PartDomain<T> out;
  for (std::size_t s = 0; s < 3; ++s) out.push_back({map.domain_begin(s), map.domain_end(s)});
  return out;
}

}  // namespace

const char* to_string(PartKind kind) {
  return kind == PartKind::patch ? "patch" : kind == PartKind::curve ? "curve" : "solid";
}

template <ExactField T>
int part_count(const Model<T>& m, PartKind kind) {
  return static_cast<int>(kind == PartKind::patch ? m.patches.size() + m.gerbs_patches.size() + m.gregory_patches.size()
                          : kind == PartKind::curve ? m.curves.size() + m.gerbs_curves.size()
                                                    : m.solids.size());
}
int part_count(const ModelFile& file, PartKind kind) {
  return std::visit([&](const auto& model) { return part_count(model, kind); }, file.model);
}

template <ExactField T>
Result<AnyPart<T>> find_part(const Model<T>& model, const ModelPart& part) {
  const int count = part_count(model, part.kind);
  if (part.number < 0 || part.number >= count) {
    const std::string plural = std::string(to_string(part.kind)) + (part.kind == PartKind::patch ? "es" : "s");
    return Error{ErrorCode::bad_reference, to_string(part.kind),
                 count == 0 ? fmt::format("the model has no {}", plural)
                            : fmt::format("the model has {} 0 to {}", plural, count - 1),
                 std::to_string(part.number)};
  }
  std::size_t i = static_cast<std::size_t>(part.number);
  if (part.kind == PartKind::solid) return AnyPart<T>(&model.solids[i].map);
  if (part.kind == PartKind::curve) {
    if (i < model.curves.size()) return AnyPart<T>(&model.curves[i]);
    return AnyPart<T>(&model.gerbs_curves[i - model.curves.size()]);
  }
  if (i < model.patches.size()) return AnyPart<T>(&model.patches[i].surface);
  i -= model.patches.size();
  if (i < model.gerbs_patches.size()) return AnyPart<T>(&model.gerbs_patches[i].surface);
  return AnyPart<T>(&model.gregory_patches[i - model.gerbs_patches.size()].patch);
}

template <ExactField T>
PartDomain<T> domain_of(const AnyPart<T>& part) {
  return std::visit([](const auto* p) { return domain(*p); }, part);
}

template <ExactField T>
Result<std::vector<std::pair<T, T>>> domain_of(const Model<T>& model, const ModelPart& part) {
  const Result<AnyPart<T>> found = find_part(model, part);
  if (!found) return found.error();
  return domain_of(*found);
}
Result<std::vector<std::pair<std::string, std::string>>> domain_of(const ModelFile& file, const ModelPart& part) {
  return std::visit(
      [&](const auto& model) -> Result<std::vector<std::pair<std::string, std::string>>> {
        const auto found = domain_of(model, part);
        if (!found) return found.error();
        std::vector<std::pair<std::string, std::string>> out;
        for (const auto& [begin, end] : *found) out.emplace_back(to_text(begin), to_text(end));
        return out;
      },
      file.model);
}

#define PATCHPROOF_INSTANTIATE(T)                                           \
  template int part_count(const Model<T>&, PartKind);                       \
  template Result<AnyPart<T>> find_part(const Model<T>&, const ModelPart&); \
  template PartDomain<T> domain_of(const AnyPart<T>&);                      \
  template Result<std::vector<std::pair<T, T>>> domain_of(const Model<T>&, const ModelPart&);
PATCHPROOF_INSTANTIATE(Rational)
PATCHPROOF_INSTANTIATE(Quadratic)
#undef PATCHPROOF_INSTANTIATE

}  // namespace patchproof
