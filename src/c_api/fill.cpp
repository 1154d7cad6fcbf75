// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "c_api/models.h"
#include "c_api/watch.h"
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/io/fill_model.h"

namespace patchproof::c_api {
namespace {

FillRequest fill_request(const patchproof_fill_options& o) {
  FillRequest out;
  require_value(o.repairs, 1, "options.repairs");
  if (o.repairs == 0 && o.repair_angle != 0)
    bad_argument("options.repair_angle", "is set, and does not count: repairs is 0", std::to_string(o.repair_angle));
  if (o.repairs == 1) {
    if (!(o.repair_angle >= 0 && o.repair_angle <= 30))
      bad_argument("options.repair_angle", "is no number of degrees from 0 to 30", std::to_string(o.repair_angle));
    out.repair_degrees = o.repair_angle;
  }
  require_value(o.jobs, 1024, "options.jobs");
  out.jobs = o.jobs;
  return out;
}

void write_tally(const VerdictTally& tally, std::size_t (&out)[3]) {
  out[PATCHPROOF_VERDICT_PROVEN] = static_cast<std::size_t>(tally.proven);
  out[PATCHPROOF_VERDICT_REFUTED] = static_cast<std::size_t>(tally.refuted);
  out[PATCHPROOF_VERDICT_UNDECIDED] = static_cast<std::size_t>(tally.undecided);
}

patchproof_fill_summary summary_of(const FilledModel& filled, const std::string& findings) {
  patchproof_fill_summary out{};
  out.faces = filled.faces.size();
  out.smooth_edges = filled.smooth;
  out.sharp_edges = filled.sharp;
  out.boundary_edges = filled.boundary;
  write_tally(filled.g1, out.g1);
  write_tally(filled.c1, out.c1);
  write_tally(filled.regular, out.regular);
  out.findings = borrowed(findings);
  return out;
}

}  // namespace
}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_fill(patchproof_context* context, patchproof_text curve_mesh, patchproof_text name,
                                  const patchproof_fill_options* options, const patchproof_callback* callback,
                                  patchproof_model** out, patchproof_fill_summary* summary) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    if (summary != nullptr) known_size(summary->struct_size, sizeof *summary, "summary");
    const patchproof_fill_options o = options_of(options, "options");
    const FillRequest request = fill_request(o);
    require_value(o.decimals, PATCHPROOF_DECIMALS_BINARY64, "options.decimals");
    const std::string path(name.length == 0 ? std::string_view("curve mesh") : view(name, "name"));
    CurveMeshFile file =
        take(read_curve_mesh_text(view(curve_mesh, "curve_mesh"), path,
                                  o.decimals == PATCHPROOF_DECIMALS_EXACT ? Decimals::exact : Decimals::binary64));
    Progress progress;
    std::optional<Result<FilledModel>> filled;
    watch(callback, progress, [&] { filled = fill_model(std::move(file.mesh), request, file.units); });
    if (!*filled) {
      Error error = filled->error();
      error.where = error.where.empty() ? path : path + ", " + error.where;
      bad_data(std::move(error));
    }
    ModelContent content{{path,
                          "curve mesh, filled",
                          "",
                          o.decimals == PATCHPROOF_DECIMALS_EXACT ? Decimals::exact : Decimals::binary64,
                          std::move((**filled).model),
                          {}},
                         "",
                         ""};
    for (const std::string& line : exceptions_of(**filled)) content.findings += line + "\n";
    auto model = std::make_unique<patchproof_model>(context->keep, std::move(content));
    if (summary != nullptr) write_struct(summary, summary_of(**filled, model->content->findings), "summary");
    *out = model.release();
  });
}
