// SPDX-License-Identifier: Apache-2.0
// Exact values of a model's patches and curves, as texts.
#include <fmt/format.h>

#include "c_api/models.h"
#include "patchproof/io/evaluate_model.h"

namespace patchproof::c_api {
namespace {

struct Request {
  const patchproof_text* texts;
  std::size_t length;
  const patchproof_evaluate_options* options;
  std::int32_t scalar, order;
};

std::vector<PlaceText> places_of(const Request& r, std::size_t per_place, const char* name) {
  require_array(r.texts, r.length, name);
  if (r.length % per_place != 0)
    bad_argument(std::string(name) + "_length", fmt::format("{} texts for each item", per_place),
                 std::to_string(r.length));
  const patchproof_evaluate_options o = options_of(r.options, "options");
  require_value(o.side_u, PATCHPROOF_SIDE_LEFT, "options.side_u");
  require_value(o.side_v, PATCHPROOF_SIDE_LEFT, "options.side_v");
  const std::int32_t sides[2] = {o.side_u, o.side_v};
  std::vector<PlaceText> places(r.length / per_place);
  for (std::size_t i = 0; i < r.length; ++i) {
    PlaceText& place = places[i / per_place];
    place.at.emplace_back(view(r.texts[i], fmt::format("{}[{}]", name, i).c_str()));
    place.sides.push_back(sides[i % per_place] == PATCHPROOF_SIDE_RIGHT ? Side::right : Side::left);
  }
  return places;
}

std::string values_of(const ModelFile& file, const ModelPart& part, const Request& r, std::size_t per_place,
                      const char* name) {
  require_value(r.scalar, PATCHPROOF_SCALAR_INTERVAL, "scalar");
  require_value(r.order, kMostDerivatives, "order");
  const auto values =
      take(evaluate_model(file, part, places_of(r, per_place, name), r.order,
                          r.scalar == PATCHPROOF_SCALAR_RATIONAL ? ValueScalar::rational : ValueScalar::interval, 1));
  std::string out;
  for (const auto& rows : values)
    for (const DerivativeText& row : rows) {
      for (const std::string& x : row.value) out += x + "\n";
      for (std::size_t c = row.value.size(); c < 3; ++c)
        out += r.scalar == PATCHPROOF_SCALAR_RATIONAL ? "0\n" : "[0, 0]\n";
    }
  return out;
}

}  // namespace
}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_model_patch_evaluate_exact(patchproof_context* context, const patchproof_model* model,
                                                        size_t patch, const patchproof_text* uv, size_t uv_length,
                                                        const patchproof_evaluate_options* options, int32_t scalar,
                                                        int32_t order, char* buffer, size_t length,
                                                        size_t* needed) noexcept {
  return call(context, [&] {
    const ModelFile& file = content_of(model, "model").file;
    require_index(patch, std::visit([](const auto& m) { return patch_count(m); }, file.model), "patch");
    write_text(
        values_of(file, {PartKind::patch, static_cast<int>(patch)}, {uv, uv_length, options, scalar, order}, 2, "uv"),
        buffer, length, needed);
  });
}

patchproof_status patchproof_model_curve_evaluate_exact(patchproof_context* context, const patchproof_model* model,
                                                        size_t curve, const patchproof_text* t, size_t t_length,
                                                        const patchproof_evaluate_options* options, int32_t scalar,
                                                        int32_t order, char* buffer, size_t length,
                                                        size_t* needed) noexcept {
  return call(context, [&] {
    const ModelFile& file = content_of(model, "model").file;
    require_index(curve, std::visit([](const auto& m) { return curve_count(m); }, file.model), "curve");
    write_text(
        values_of(file, {PartKind::curve, static_cast<int>(curve)}, {t, t_length, options, scalar, order}, 1, "t"),
        buffer, length, needed);
  });
}
