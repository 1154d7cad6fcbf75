// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "c_api/models.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof::c_api {
namespace {

using nlohmann::ordered_json;

Decimals decimals_of(std::int32_t value) {
  require_value(value, PATCHPROOF_BINARY64, "decimals");
  return value == PATCHPROOF_EXACT ? Decimals::exact : Decimals::binary64;
}

// A double as a text that holds it exactly.
std::string exact_text(double x) { return fmt::format("{:a}", x); }

ordered_json list_of(const double* data, std::size_t count) {
  ordered_json out = ordered_json::array();
  for (std::size_t i = 0; i < count; ++i) out.push_back(exact_text(data[i]));
  return out;
}

// How many control points knots belong to.
std::size_t points_of(std::size_t knots, std::int32_t degree, const std::string& where) {
  if (degree < 1) bad_data({ErrorCode::bad_degree, where, "a degree is 1 or more", std::to_string(degree)});
  const std::size_t order = static_cast<std::size_t>(degree) + 1;
  if (knots < 2 * order)
    bad_argument(where, fmt::format("{} knots are too few for degree {}", knots, degree), std::to_string(knots));
  return knots - order;
}

// The arrays of a spline as our JSON has them, rows nested as deep as there are directions.
struct Arrays {
  std::vector<std::pair<const double*, std::size_t>> knots;
  std::vector<std::int32_t> degree;
  const double* points;
  std::size_t points_length;
  const double* weights;
  std::size_t weights_length;
  patchproof_text name;
};

ordered_json spline_json(const Arrays& a, const std::string& where) {
  std::size_t rows = 1, columns = 1;
  ordered_json degree = ordered_json::array(), knots = ordered_json::array();
  for (std::size_t d = 0; d < a.knots.size(); ++d) {
    const std::string at = where + (a.knots.size() == 1 ? ".knots" : d == 0 ? ".knots_u" : ".knots_v");
    require_array(a.knots[d].first, a.knots[d].second, at);
    (d == 0 && a.knots.size() == 2 ? rows : columns) = points_of(a.knots[d].second, a.degree[d], at);
    degree.push_back(a.degree[d]);
    knots.push_back(list_of(a.knots[d].first, a.knots[d].second));
  }
  require_array(a.points, a.points_length, where + ".points");
  require_array(a.weights, a.weights_length, where + ".weights");
  // Neither product overflows: as many knots are in memory.
  if (a.points_length % 3 != 0 || a.points_length / 3 / rows != columns || a.points_length / 3 % rows != 0)
    bad_argument(where + ".points_length", fmt::format("{} · {} control points have 3 numbers each", rows, columns),
                 std::to_string(a.points_length));
  if (a.weights_length != 0 && a.weights_length != a.points_length / 3)
    bad_argument(where + ".weights_length", fmt::format("{} · {} weights, or none", rows, columns),
                 std::to_string(a.weights_length));
  ordered_json points = ordered_json::array(), weights = ordered_json::array();
  for (std::size_t i = 0; i < rows; ++i) {
    ordered_json row = ordered_json::array();
    for (std::size_t j = 0; j < columns; ++j) row.push_back(list_of(a.points + 3 * (i * columns + j), 3));
    points.push_back(std::move(row));
    if (a.weights_length > 0) weights.push_back(list_of(a.weights + i * columns, columns));
  }
  const bool curve = a.knots.size() == 1;
  ordered_json out;
  if (a.name.length > 0) out["name"] = view(a.name, (where + ".name").c_str());
  out["degree"] = curve ? degree[0] : degree;
  out["knots"] = curve ? knots[0] : knots;
  out["control_points"] = curve ? points[0] : points;
  if (a.weights_length > 0) out["weights"] = curve ? weights[0] : weights;
  return out;
}

// Element i of an array of structs that may be longer than ours.
template <class S>
S element(const S* array, std::size_t i, const std::string& name) {
  const char* bytes = reinterpret_cast<const char*>(array) + i * array->struct_size;
  const std::string at = fmt::format("{}[{}]", name, i);
  const S out = options_of(reinterpret_cast<const S*>(bytes), at.c_str());
  if (reinterpret_cast<const S*>(bytes)->struct_size != array->struct_size)
    bad_argument(at + ".struct_size", "differs from that of the first");
  return out;
}

const char* edge_name(std::int32_t edge) {
  require_value(edge, PATCHPROOF_V_MAX, "joins: edge");
  return to_string(static_cast<EdgeName>(edge));
}

std::string model_json(const patchproof_model_data& data) {
  require_array(data.patches, data.patches_length, "patches");
  require_array(data.curves, data.curves_length, "curves");
  require_array(data.joins, data.joins_length, "joins");
  ordered_json out{{"format", "patchproof-model"}, {"version", 1}};
  if (data.units.length > 0) out["units"] = view(data.units, "units");
  if (data.patches_length > 0) out["patches"] = ordered_json::array();
  for (std::size_t i = 0; i < data.patches_length; ++i) {
    const patchproof_surface_data p = element(data.patches, i, "patches");
    out["patches"].push_back(spline_json({{{p.knots_u, p.knots_u_length}, {p.knots_v, p.knots_v_length}},
                                          {p.degree_u, p.degree_v},
                                          p.points,
                                          p.points_length,
                                          p.weights,
                                          p.weights_length,
                                          p.name},
                                         fmt::format("patches[{}]", i)));
  }
  if (data.curves_length > 0) out["curves"] = ordered_json::array();
  for (std::size_t i = 0; i < data.curves_length; ++i) {
    const patchproof_curve_data c = element(data.curves, i, "curves");
    out["curves"].push_back(spline_json(
        {{{c.knots, c.knots_length}}, {c.degree}, c.points, c.points_length, c.weights, c.weights_length, c.name},
        fmt::format("curves[{}]", i)));
  }
  for (std::size_t i = 0; i < data.joins_length; ++i) {
    const patchproof_declared_join& j = data.joins[i];
    out["joins"].push_back({{"a", {{"patch", j.patch_a}, {"edge", edge_name(j.edge_a)}}},
                            {"b", {{"patch", j.patch_b}, {"edge", edge_name(j.edge_b)}}},
                            {"reversed", j.reversed != 0}});
  }
  try {
    return out.dump();
  } catch (const ordered_json::type_error&) {
    bad_data({ErrorCode::syntax, "name, units", "the text is not UTF-8", ""});
  }
}

}  // namespace

ModelContent content_of_file(ModelFile file) {
  std::string notes;
  for (const std::string& note : file.notes) notes += note + "\n";
  return {std::move(file), std::move(notes), ""};
}

}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_model_read_file(patchproof_context* context, patchproof_text path, int32_t decimals,
                                             patchproof_model** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    const std::string_view name = view(path, "path");
    if (name.find('\0') != std::string_view::npos) bad_argument("path", "holds a zero byte");
    hand_over(context, content_of_file(take(read_model(std::string(name), decimals_of(decimals)))), out);
  });
}

patchproof_status patchproof_model_read_text(patchproof_context* context, patchproof_text bytes, patchproof_text name,
                                             int32_t decimals, patchproof_model** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    const std::string path(name.length == 0 ? std::string_view("model") : view(name, "name"));
    hand_over(context, content_of_file(take(read_model_text(view(bytes, "bytes"), path, decimals_of(decimals)))), out);
  });
}

patchproof_status patchproof_model_create(patchproof_context* context, const patchproof_model_data* data,
                                          patchproof_model** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    require_place(data, "data");
    ModelFile file = take(read_model_text(model_json(options_of(data, "data")), "arrays"));
    hand_over(context, content_of_file(std::move(file)), out);
  });
}

patchproof_status patchproof_model_free(patchproof_model* model) noexcept { return free_handle(model); }

patchproof_status patchproof_model_write(patchproof_context* context, const patchproof_model* model, int32_t format,
                                         char* buffer, size_t length, size_t* needed) noexcept {
  return call(context, [&] {
    const ModelContent& content = content_of(model, "model");
    require_value(format, PATCHPROOF_G2, "format");
    const std::string bytes = std::visit(
        [&](const auto& m) { return format == PATCHPROOF_JSON ? write_model_json(m) : take(write_model_g2(m)).bytes; },
        content.file.model);
    write_text(bytes, buffer, length, needed);
  });
}
