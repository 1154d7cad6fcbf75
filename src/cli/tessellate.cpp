// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/tessellate_cad.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/read.h"
#include "patchproof/io/tessellate_model.h"

namespace patchproof::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string model, out, method = "auto", json;
  double chord = 0, angle = 180;
  std::size_t max_triangles = MeshRequest{}.max_triangles;
  int jobs = 0;
  bool quiet = false;
  Decimals decimals = Decimals::exact;
};

MeshRequest request_of(const Options& o) { return {o.chord, o.angle, o.max_triangles, o.jobs}; }

// Makes meshes of the file: faces of CAD files are read anew, models once.
using Mesher = std::function<Result<ModelMesh>(const MeshRequest&)>;
Result<Mesher> mesher_of(const Options& o) {
  if (looks_like_cad(o.model)) {
    if (o.method != "auto" && o.method != "delaunay")
      return Error{ErrorCode::unsupported, "--method", "faces with trimming curves are meshed by delaunay", o.method};
    return Mesher([&o](const MeshRequest& request) { return mesh_of_cad(o.model, request); });
  }
  Result<ModelFile> file = read_model(o.model, o.decimals);
  if (!file) return file.error();
  if (o.method == "delaunay")
    return Error{ErrorCode::unsupported, "--method",
                 "delaunay is for trimmed faces of CAD files; for patches there are adaptive and regular", o.method};
  const CellMethod method = o.method == "regular" ? CellMethod::regular : CellMethod::adaptive;
  return Mesher([file = std::make_shared<const ModelFile>(std::move(*file)), method](const MeshRequest& request) {
    return tessellate_model(*file, request, method);
  });
}

std::string report_json(const Options& o, const ModelMesh& made, const MeshJudgement& judged) {
  const CertifiedMesh& mesh = made.mesh;
  const Watertight& closed = judged.watertight;
  nlohmann::ordered_json out;
  out["program"] = "patchproof " PATCHPROOF_VERSION;
  out["model"] = o.model;
  out["units"] = made.units;
  out["method"] = made.method;
  out["asked"] = {{"chord", o.chord}};
  if (o.angle < 180) out["asked"]["angle"] = o.angle;
  out["vertices"] = mesh.vertices.size();
  out["triangles"] = mesh.triangles.size();
  out["collapsed"] = mesh.collapsed;
  const auto number = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  out["chord"] = {{"proved", number(mesh.chord)},
                  {"misses", mesh.chord_misses},
                  {"gap", number(mesh.gap)},
                  {"rounding", judged.rounding}};
  out["angle"] = {{"proved", mesh.angle < 180 ? nlohmann::ordered_json(mesh.angle) : nlohmann::ordered_json(nullptr)},
                  {"misses", mesh.angle_misses}};
  out["watertight"] = {{"is", closed.is_watertight()}, {"closed", closed.is_closed()}, {"edges", closed.edges},
                       {"free_edges", closed.free},    {"cracks", closed.cracks},      {"branching", closed.branching},
                       {"oriented", closed.oriented}};
  out["proved"] = judged.proved;
  out["notes"] = made.notes;
  for (const std::string& note : mesh.notes) out["notes"].push_back(note);
  return out.dump(2) + "\n";
}

std::string summary(const Options& o, const ModelMesh& made, const MeshJudgement& judged) {
  const CertifiedMesh& mesh = made.mesh;
  const Watertight& closed = judged.watertight;
  std::string text = fmt::format("{}: {} vertices, {} triangles ({})\n", o.model, mesh.vertices.size(),
                                 mesh.triangles.size(), made.method);
  if (!o.quiet) {
    for (const std::string& note : made.notes) text += fmt::format("  {}\n", note);
    for (const std::string& note : mesh.notes) text += fmt::format("  {}\n", note);
  }
  text += std::isfinite(mesh.chord) ? fmt::format("chord error: at most {:.6g}{}{}, proved; asked {:g}", mesh.chord,
                                                  made.units.empty() ? "" : " ", made.units, o.chord)
                                    : fmt::format("chord error: no bound; asked {:g}", o.chord);
  if (mesh.chord_misses > 0) text += fmt::format(", not proved for {} triangles", mesh.chord_misses);
  if (mesh.gap > 0)
    text += fmt::format("\n  vertices lie within {:.3g} of the faces they belong to, which is part of it", mesh.gap);
  if (judged.rounding > 0)
    text += fmt::format("\n  single precision moves vertices of the file by at most {:.3g} more", judged.rounding);
  text += mesh.angle < 180 ? fmt::format("\nnormal angle: at most {:.6g} degrees, proved", mesh.angle)
                           : std::string("\nnormal angle: no bound for some triangles");
  if (o.angle < 180) text += fmt::format("; asked {:g}", o.angle);
  if (mesh.angle_misses > 0) text += fmt::format(", not proved for {} triangles", mesh.angle_misses);
  if (mesh.collapsed > 0)
    text += fmt::format("\n{} triangles have two corners in one collapsed point, and are left out", mesh.collapsed);
  text += fmt::format("\nwatertight: {}", closed.is_watertight() ? "yes" : "no");
  if (closed.is_closed())
    text += ", closed";
  else if (closed.free > 0)
    text += fmt::format(", but for {} edges of triangles on free edges of the model", closed.free);
  if (closed.cracks > 0) text += fmt::format(", {} edges of cracks", closed.cracks);
  if (closed.branching > 0) text += fmt::format(", {} edges with more than two triangles", closed.branching);
  if (!closed.oriented) text += ", not orientable";
  return text + "\n";
}

int run(const Options& o) {
  const std::string extension = fs::path(o.out).extension().string();
  const std::optional<MeshFormat> format = mesh_format_of(extension);
  if (!format)
    return report_error({ErrorCode::usage, o.out,
                         fmt::format("OUT ends in .stl, .obj, .ply, .glb or .vtu, not in '{}'", extension), ""});
  std::error_code ignored;
  for (const std::string& to : {o.out, o.json})
    if (!to.empty() && to != "-" && fs::equivalent(o.model, to, ignored))
      return report_error({ErrorCode::usage, "tessellate", "would overwrite its input", to});
  if (auto error = check_request(request_of(o))) return report_error(*error);
  const auto mesher = mesher_of(o);
  const Result<ModelMesh> made = mesher ? mesh_for_file(*format, request_of(o), *mesher) : mesher.error();
  if (!made) {
    Error error = made.error();
    if (error.where.find(o.model) == std::string::npos)
      error.where = o.model + (error.where.empty() ? "" : ", " + error.where);
    return report_error(error);
  }
  const MeshJudgement judged = judge_mesh(made->mesh, request_of(o), *format);
  const Result<std::string> bytes = write_mesh(made->mesh, fs::path(o.model).stem().string(), *format);
  if (!bytes) return report_error(bytes.error());
  if (const int failed = write_output(o.out, *bytes)) return failed;
  if (!o.json.empty())
    if (const int failed = write_output(o.json, report_json(o, *made, judged))) return failed;
  if (o.json != "-")
    if (const int failed = write_output("-", summary(o, *made, judged))) return failed;
  return judged.proved ? kProven : kRefuted;
}

}  // namespace

void add_tessellate(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("tessellate", "triangles with a proved error, watertight (stl, obj, ply, glb, vtu)");
  command->footer(
      "Exit codes: 0 what was asked is proved, 1 it is not (the mesh is written all the same), 2 bad input or usage.");
  command->add_option("model", o->model, "model or CAD file to read")->required()->type_name("MODEL");
  command->add_option("out", o->out, "mesh to write: .stl, .obj, .ply, .glb or .vtu")->required()->type_name("OUT");
  command
      ->add_option("--chord", o->chord,
                   "largest distance between surface and triangles, in units of the model (of CAD files: mm)")
      ->required()
      ->option_text("LENGTH");
  command->add_option("--angle", o->angle, "largest angle between their normals [not asked]")->option_text("DEGREES");
  command
      ->add_option("--method", o->method,
                   "adaptive: cells halved where needed; regular: equal cells; delaunay: faces with trimming curves "
                   "[by the model]")
      ->check(CLI::IsMember({"adaptive", "regular", "delaunay"}))
      ->option_text("adaptive|regular|delaunay");
  command->add_option("--json", o->json, "write a report ('-': on standard output, in place of the summary)")
      ->option_text("REPORT");
  command->add_option("--max-triangles", o->max_triangles, "refuse to make more [16777216]")
      ->check(CLI::Range(std::size_t{2}, std::size_t{1} << 28))
      ->option_text("N");
  command->add_option("--jobs", o->jobs, "threads; the result does not depend on it [one per processor]")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  add_decimals(*command, o->decimals);
  command->add_flag("--quiet", o->quiet, "print the summary only");
  command->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace patchproof::cli
