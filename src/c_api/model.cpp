// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "c_api/models.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof::c_api {
namespace {

Decimals decimals_of(std::int32_t value) {
  require_value(value, PATCHPROOF_DECIMALS_BINARY64, "decimals");
  return value == PATCHPROOF_DECIMALS_EXACT ? Decimals::exact : Decimals::binary64;
}

// Doubles as texts that hold them exactly.
void add_numbers(std::string& out, const double* data, std::size_t count) {
  out += '[';
  for (std::size_t i = 0; i < count; ++i)
    fmt::format_to(std::back_inserter(out), "{}\"{:a}\"", i == 0 ? "" : ",", data[i]);
  out += ']';
}

// REQUIRES UTF-8; else the call ends.
std::string quoted(patchproof_text text, const std::string& where) {
  try {
    return nlohmann::json(view(text, where.c_str())).dump();
  } catch (const nlohmann::json::type_error&) {
    bad_data({ErrorCode::syntax, where, "the text is not UTF-8", ""});
  }
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

// Appends the spline. (Not through a JSON library's objects: theirs end the program when memory runs out.)
void add_spline(std::string& out, const Arrays& a, const std::string& where) {
  const bool curve = a.knots.size() == 1;
  std::size_t rows = 1, columns = 1;
  std::string knots, degrees;
  for (std::size_t d = 0; d < a.knots.size(); ++d) {
    const std::string at = where + (curve ? ".knots" : d == 0 ? ".knots_u" : ".knots_v");
    require_array(a.knots[d].first, a.knots[d].second, at);
    (d == 0 && !curve ? rows : columns) = points_of(a.knots[d].second, a.degree[d], at);
    fmt::format_to(std::back_inserter(degrees), "{}{}", d == 0 ? "" : ",", a.degree[d]);
    if (d > 0) knots += ',';
    add_numbers(knots, a.knots[d].first, a.knots[d].second);
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
  // In a patch a list of rows, in a curve the one row.
  const auto list = [&](const char* key, const auto& add_row) {
    fmt::format_to(std::back_inserter(out), ",\"{}\":{}", key, curve ? "" : "[");
    for (std::size_t i = 0; i < rows; ++i) {
      if (i > 0) out += ',';
      add_row(i);
    }
    if (!curve) out += ']';
  };
  fmt::format_to(std::back_inserter(out), "{{\"degree\":{1}{0}{2},\"knots\":{1}{3}{2}", degrees, curve ? "" : "[",
                 curve ? "" : "]", knots);
  if (a.name.length > 0) out += ",\"name\":" + quoted(a.name, where + ".name");
  list("control_points", [&](std::size_t i) {
    out += '[';
    for (std::size_t j = 0; j < columns; ++j) {
      if (j > 0) out += ',';
      add_numbers(out, a.points + 3 * (i * columns + j), 3);
    }
    out += ']';
  });
  if (a.weights_length > 0) list("weights", [&](std::size_t i) { add_numbers(out, a.weights + i * columns, columns); });
  out += '}';
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
  require_value(edge, PATCHPROOF_EDGE_V_MAX, "joins: edge");
  return to_string(static_cast<EdgeName>(edge));
}

std::string model_json(const patchproof_model_data& data) {
  require_array(data.patches, data.patches_length, "patches");
  require_array(data.curves, data.curves_length, "curves");
  require_array(data.joins, data.joins_length, "joins");
  std::string out = "{\"format\":\"patchproof-model\",\"version\":1";
  if (data.units.length > 0) out += ",\"units\":" + quoted(data.units, "units");
  const auto list = [&](const char* key, std::size_t length, const auto& add) {
    if (length == 0) return;
    fmt::format_to(std::back_inserter(out), ",\"{}\":[", key);
    for (std::size_t i = 0; i < length; ++i) {
      if (i > 0) out += ',';
      add(i);
    }
    out += ']';
  };
  list("patches", data.patches_length, [&](std::size_t i) {
    const patchproof_surface_data p = element(data.patches, i, "patches");
    add_spline(out,
               {{{p.knots_u, p.knots_u_length}, {p.knots_v, p.knots_v_length}},
                {p.degree_u, p.degree_v},
                p.points,
                p.points_length,
                p.weights,
                p.weights_length,
                p.name},
               fmt::format("patches[{}]", i));
  });
  list("curves", data.curves_length, [&](std::size_t i) {
    const patchproof_curve_data c = element(data.curves, i, "curves");
    add_spline(
        out, {{{c.knots, c.knots_length}}, {c.degree}, c.points, c.points_length, c.weights, c.weights_length, c.name},
        fmt::format("curves[{}]", i));
  });
  list("joins", data.joins_length, [&](std::size_t i) {
    const patchproof_declared_join& j = data.joins[i];
    fmt::format_to(std::back_inserter(out),
                   R"({{"a":{{"patch":{},"edge":"{}"}},"b":{{"patch":{},"edge":"{}"}},"reversed":{}}})", j.patch_a,
                   edge_name(j.edge_a), j.patch_b, edge_name(j.edge_b), j.reversed != 0);
  });
  return out + "}";
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
    const std::string file(name);
    if (looks_like_cad(file))
      bad_data(
          {ErrorCode::unsupported, file, "the library reads text formats; the program patchproof reads CAD files", ""});
    hand_over(context, content_of_file(take(read_model(file, decimals_of(decimals)))), out);
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
    require_value(format, PATCHPROOF_FORMAT_G2, "format");
    const std::string bytes = std::visit(
        [&](const auto& m) {
          if (format == PATCHPROOF_FORMAT_JSON) return write_model_json(m);
          if (!m.gregory_patches.empty())
            bad_data({ErrorCode::unsupported, "format",
                      "a Gregory patch is no B-spline; the program patchproof converts it to one near it, with bounds",
                      ".g2"});
          return take(write_model_g2(m)).bytes;
        },
        content.file.model);
    write_text(bytes, buffer, length, needed);
  });
}
