// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include "model_part.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof {
namespace {

std::string name_of(PartKind kind, const std::array<int, 3>& order) {
  const int total = order[0] + order[1] + order[2];
  if (kind == PartKind::curve) return total <= 3 ? "C" + std::string(total, '\'') : fmt::format("C^({})", total);
  std::string out = kind == PartKind::patch ? "S" : "V";
  if (total > 0) out += "_" + std::string(order[0], 'u') + std::string(order[1], 'v') + std::string(order[2], 'w');
  return out;
}

template <Ring R, ExactField T>
Result<std::vector<DerivativeText>> texts(PartKind kind, const AnyPart<T>& part, const PartDomain<T>& domain,
                                          const PlaceText& place, int order) {
  const auto shown = [&place] { return fmt::format("{}", fmt::join(place.at, ",")); };
  return contracts_as_errors(shown, [&]() -> Result<std::vector<DerivativeText>> {
    const Result<PlaceAsked<T>> asked = check_place<T>(domain, place.at.size(), place.sides, order, shown,
                                                       [&](std::size_t s) { return parse_scalar<T>(place.at[s]); });
    if (!asked) return asked.error();
    const Result<ModelValues<R>> found = part_values<R>(part, *asked);
    if (!found) return found.error();
    std::vector<DerivativeText> out;
    for (const ModelDerivative<R>& row : found->rows) {
      out.push_back({name_of(kind, row.order), row.order, {}});
      for (int c = 0; c < found->dimension; ++c) out.back().value.push_back(to_text(row.value[c]));
    }
    return out;
  });
}

template <ExactField T>
Result<std::vector<DerivativeText>> texts(PartKind kind, const AnyPart<T>& part, const PartDomain<T>& domain,
                                          const PlaceText& place, int order, ValueScalar scalar) {
  return scalar == ValueScalar::rational   ? texts<T>(kind, part, domain, place, order)
         : scalar == ValueScalar::interval ? texts<Interval>(kind, part, domain, place, order)
                                           : texts<double>(kind, part, domain, place, order);
}

}  // namespace

Result<std::vector<DerivativeText>> evaluate_model(const ModelFile& file, const ModelPart& part, const PlaceText& place,
                                                   int derivatives, ValueScalar scalar) {
  return std::visit(
      [&](const auto& model) -> Result<std::vector<DerivativeText>> {
        const auto found = find_part(model, part);
        if (!found) return found.error();
        return texts(part.kind, *found, domain_of(*found), place, derivatives, scalar);
      },
      file.model);
}

Result<std::vector<std::vector<DerivativeText>>> evaluate_model(const ModelFile& file, const ModelPart& part,
                                                                const std::vector<PlaceText>& places, int derivatives,
                                                                ValueScalar scalar, int jobs) {
  return std::visit(
      [&](const auto& model) -> Result<std::vector<std::vector<DerivativeText>>> {
        const auto found = find_part(model, part);
        if (!found) return found.error();
        const auto domain = domain_of(*found);
        return at_each_place<std::vector<DerivativeText>>(places.size(), jobs, [&](std::size_t i) {
          return texts(part.kind, *found, domain, places[i], derivatives, scalar);
        });
      },
      file.model);
}

}  // namespace patchproof
