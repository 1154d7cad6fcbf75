// SPDX-License-Identifier: Apache-2.0
// Knot insertion, elevation and extraction: exact, on a copy of the model.
#include <fmt/format.h>

#include <algorithm>

#include "c_api/models.h"
#include "io/raw_spline.h"
#include "patchproof/patch/patch_knots.h"

namespace patchproof::c_api {
namespace {

Direction direction_of(std::int32_t value) {
  require_value(value, PATCHPROOF_DIRECTION_V, "direction");
  return value == PATCHPROOF_DIRECTION_U ? Direction::u : Direction::v;
}

// New knots may be anything inside the domain, as long as no knot stands there more often than a reader takes.
template <ExactField T>
std::vector<T> new_knots(const KnotVector<T>& knots, const patchproof_text* texts, std::size_t length) {
  require_array(texts, length, "knots");
  std::vector<T> out;
  for (std::size_t i = 0; i < length; ++i) {
    const std::string where = fmt::format("knots[{}]", i), text(view(texts[i], where.c_str()));
    const Result<T> t = parse_scalar<T>(text);
    if (!t) bad_data({t.error().code, where, t.error().message, t.error().values});
    if (!(knots.domain_begin() < *t && *t < knots.domain_end()))
      bad_data({ErrorCode::outside_domain, where,
                fmt::format("lies not inside the domain [{}, {}]", to_text(knots.domain_begin()),
                            to_text(knots.domain_end())),
                text});
    if (std::count(out.begin(), out.end(), *t) + knots.multiplicity(*t) > knots.degree())
      bad_data({ErrorCode::bad_multiplicity, where,
                fmt::format("would stand more often than degree + 1 = {} times", knots.degree() + 1), text});
    out.push_back(*t);
  }
  return out;
}

int raised(int degree, std::int32_t times) {
  if (times < 0) bad_argument("times", "is negative", std::to_string(times));
  if (times > kMaxDegree - degree)
    bad_data({ErrorCode::bad_degree, "times", fmt::format("the degree would exceed {}", kMaxDegree),
              fmt::format("{} + {}", degree, times)});
  return times;
}

// A copy of the model in which edit(model of its numbers) has changed something.
template <class Edit>
void hand_over_edited(const patchproof_context* context, const patchproof_model* model, patchproof_model** out,
                      const Edit& edit) {
  require_place(out, "out");
  ModelFile file = content_of(model, "model").file;
  file.sha256.clear();  // no longer what the file holds
  file.notes.clear();
  std::visit(edit, file.model);
  hand_over(context, content_of_file(std::move(file)), out);
}

template <ExactField T>
Model<T> model_like(const Model<T>& model) {
  Model<T> out;
  out.units = model.units;
  return out;
}

template <ExactField T>
BsplineCurve<T, 4> curve_of_piece(const BezierPiece<T, 4>& piece) {
  return BsplineCurve<T, 4>(KnotVector<T>::bezier(piece.degree(), piece.begin, piece.end), piece.points);
}

template <ExactField T>
Model<T> bezier_patches(const Model<T>& model, const ModelPatch<T>& patch) {
  Model<T> out = model_like(model);
  const std::vector<T> u = patch.surface.knots(Direction::u).breaks(), v = patch.surface.knots(Direction::v).breaks();
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    const BsplinePatch<T, 4> strip = restrict(patch.surface, Direction::u, u[i], u[i + 1]);
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      out.patches.push_back({patch.name, restrict(strip, Direction::v, v[j], v[j + 1]), patch.is_rational});
  }
  return out;
}

}  // namespace
}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_model_patch_insert_knots(patchproof_context* context, const patchproof_model* model,
                                                      size_t patch, int32_t direction, const patchproof_text* knots,
                                                      size_t length, patchproof_model** out) noexcept {
  return call(context, [&] {
    const Direction d = direction_of(direction);
    hand_over_edited(context, model, out, [&]<ExactField T>(Model<T>& m) {
      BsplinePatch<T, 4> surface = spline_patch(m, patch).surface;
      for (const T& t : new_knots(surface.knots(d), knots, length)) surface = insert_knot(surface, d, t);
      m.patches[patch].surface = std::move(surface);
    });
  });
}

patchproof_status patchproof_model_curve_insert_knots(patchproof_context* context, const patchproof_model* model,
                                                      size_t curve, const patchproof_text* knots, size_t length,
                                                      patchproof_model** out) noexcept {
  return call(context, [&] {
    hand_over_edited(context, model, out, [&]<ExactField T>(Model<T>& m) {
      BsplineCurve<T, 4> line = spline_curve(m, curve).curve;
      for (const T& t : new_knots(line.knots(), knots, length)) line = insert_knot(line, t);
      m.curves[curve].curve = std::move(line);
    });
  });
}

patchproof_status patchproof_model_patch_elevate(patchproof_context* context, const patchproof_model* model,
                                                 size_t patch, int32_t direction, int32_t times,
                                                 patchproof_model** out) noexcept {
  return call(context, [&] {
    const Direction d = direction_of(direction);
    hand_over_edited(context, model, out, [&]<ExactField T>(Model<T>& m) {
      const BsplinePatch<T, 4>& surface = spline_patch(m, patch).surface;
      m.patches[patch].surface = elevate_degree(surface, d, raised(surface.knots(d).degree(), times));
    });
  });
}

patchproof_status patchproof_model_curve_elevate(patchproof_context* context, const patchproof_model* model,
                                                 size_t curve, int32_t times, patchproof_model** out) noexcept {
  return call(context, [&] {
    hand_over_edited(context, model, out, [&]<ExactField T>(Model<T>& m) {
      const BsplineCurve<T, 4>& line = spline_curve(m, curve).curve;
      m.curves[curve].curve = elevate_degree(line, raised(line.degree(), times));
    });
  });
}

patchproof_status patchproof_model_patch_extract_bezier(patchproof_context* context, const patchproof_model* model,
                                                        size_t patch, patchproof_model** out) noexcept {
  return call(context, [&] {
    hand_over_edited(context, model, out,
                     [&]<ExactField T>(Model<T>& m) { m = bezier_patches(m, spline_patch(m, patch)); });
  });
}

patchproof_status patchproof_model_curve_extract_bezier(patchproof_context* context, const patchproof_model* model,
                                                        size_t curve, patchproof_model** out) noexcept {
  return call(context, [&] {
    hand_over_edited(context, model, out, [&]<ExactField T>(Model<T>& m) {
      const ModelCurve<T>& line = spline_curve(m, curve);
      Model<T> pieces = model_like(m);
      for (const BezierPiece<T, 4>& piece : extract_bezier(line.curve))
        pieces.curves.push_back({line.name, curve_of_piece(piece), line.is_rational, line.dimension});
      m = std::move(pieces);
    });
  });
}
