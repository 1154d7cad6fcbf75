// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/tessellate_cad.h"
#include "io/gerbs_splines.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/mesh_files.h"
#include "patchproof/io/read.h"
#include "patchproof/mesh/adaptive_mesh.h"

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

struct Source {
  std::string units, method;
  std::vector<std::string> notes;
};

MeshRequest request_of(const Options& o) { return {o.chord, o.angle, o.max_triangles, o.jobs}; }

template <ExactField T>
Result<CertifiedMesh> mesh_of(const Model<T>& model, const Options& o, Source& source) {
  if (has_gerbs(model)) {
    SplineModel<T> splines = gerbs_to_splines(model);
    if (!splines.outlined_patches.empty())
      return Error{ErrorCode::unsupported, fmt::format("patch {}", splines.outlined_patches.front()),
                   "no error can be proved yet for a GERBS that is no spline; plot draws it, without a bound", ""};
    source.notes.insert(source.notes.end(), splines.notes.begin(), splines.notes.end());
    return mesh_of(splines.model, o, source);
  }
  if (o.method == "delaunay")
    return Error{ErrorCode::unsupported, "--method",
                 "delaunay is for trimmed faces of CAD files; for patches there are adaptive and regular", o.method};
  source.method = o.method == "auto" ? "adaptive" : o.method;
  source.units = model.units;
  const auto left_out = [&](std::size_t count, const char* what) {
    if (count > 0) source.notes.push_back(fmt::format("left out: {} {}", count, what));
  };
  left_out(model.gregory_patches.size(), "Gregory patches");
  left_out(model.curves.size(), "curves");
  left_out(model.solids.size(), "solids");
  std::vector<BsplinePatch<T, 4>> parts;
  bool torn = false;
  for (const ModelPatch<T>& p : model.patches) {
    std::vector<BsplinePatch<T, 4>> of_patch = split_torn(p.surface);
    torn = torn || of_patch.size() > 1;
    for (auto& part : of_patch) parts.push_back(std::move(part));
  }
  if (parts.empty())
    return Error{ErrorCode::unsupported, "tessellate",
                 model.gregory_patches.empty()
                     ? "the model has no patches"
                     : "Gregory patches are not tessellated: convert writes B-spline patches near them",
                 ""};
  if (torn)
    source.notes.push_back("patches that may jump at a knot are meshed in parts, and patches are counted by parts");
  std::vector<const BsplinePatch<T, 4>*> patches;
  for (const auto& p : parts) patches.push_back(&p);
  EdgeMatch<T> match = match_edges(patches);
  if (!model.joins.empty() && !torn) {
    match.joins.clear();
    for (const DeclaredJoin& j : model.joins)
      match.joins.push_back(whole_edge_join(patches, j.patch_a, j.edge_a, j.patch_b, j.edge_b, j.reversed));
  }
  return adaptive_mesh(patches, match.joins, match.collapsed, request_of(o),
                       o.method == "regular" ? CellMethod::regular : CellMethod::adaptive);
}

std::string bytes_error(const std::string& format) {
  return fmt::format("OUT ends in .stl, .obj, .ply, .glb or .vtu, not in '{}'", format);
}

using Writer = Result<std::string> (*)(const std::vector<MeshPart>&);
Writer writer_of(const std::string& extension) {
  return extension == ".stl"   ? write_stl
         : extension == ".obj" ? write_obj
         : extension == ".ply" ? write_ply
         : extension == ".glb" ? write_glb
         : extension == ".vtu" ? write_vtu
                               : nullptr;
}

bool is_single_precision(const std::string& extension) { return extension == ".stl" || extension == ".glb"; }

// Formats of single precision move each vertex by at most this.
double rounding_of(const CertifiedMesh& mesh, const std::string& extension) {
  if (!is_single_precision(extension)) return 0;
  double largest = 0;
  for (const auto& v : mesh.vertices)
    for (const double x : v.c) largest = std::max(largest, std::abs(x));
  return 1.7321 * (0x1p-24 * largest + 0x1p-149);
}

std::string report_json(const Options& o, const Source& source, const CertifiedMesh& mesh, const Watertight& closed,
                        double rounding, bool proved) {
  nlohmann::ordered_json out;
  out["program"] = "patchproof " PATCHPROOF_VERSION;
  out["model"] = o.model;
  out["units"] = source.units;
  out["method"] = source.method;
  out["asked"] = {{"chord", o.chord}};
  if (o.angle < 180) out["asked"]["angle"] = o.angle;
  out["vertices"] = mesh.vertices.size();
  out["triangles"] = mesh.triangles.size();
  out["collapsed"] = mesh.collapsed;
  const auto number = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  out["chord"] = {
      {"proved", number(mesh.chord)}, {"misses", mesh.chord_misses}, {"gap", number(mesh.gap)}, {"rounding", rounding}};
  out["angle"] = {{"proved", mesh.angle < 180 ? nlohmann::ordered_json(mesh.angle) : nlohmann::ordered_json(nullptr)},
                  {"misses", mesh.angle_misses}};
  out["watertight"] = {{"is", closed.is_watertight()}, {"closed", closed.is_closed()}, {"edges", closed.edges},
                       {"free_edges", closed.free},    {"cracks", closed.cracks},      {"branching", closed.branching},
                       {"oriented", closed.oriented}};
  out["proved"] = proved;
  out["notes"] = source.notes;
  for (const std::string& note : mesh.notes) out["notes"].push_back(note);
  return out.dump(2) + "\n";
}

std::string summary(const Options& o, const Source& source, const CertifiedMesh& mesh, const Watertight& closed,
                    double rounding) {
  std::string text = fmt::format("{}: {} vertices, {} triangles ({})\n", o.model, mesh.vertices.size(),
                                 mesh.triangles.size(), source.method);
  if (!o.quiet) {
    for (const std::string& note : source.notes) text += fmt::format("  {}\n", note);
    for (const std::string& note : mesh.notes) text += fmt::format("  {}\n", note);
  }
  text += std::isfinite(mesh.chord) ? fmt::format("chord error: at most {:.6g}{}{}, proved; asked {:g}", mesh.chord,
                                                  source.units.empty() ? "" : " ", source.units, o.chord)
                                    : fmt::format("chord error: no bound; asked {:g}", o.chord);
  if (mesh.chord_misses > 0) text += fmt::format(", not proved for {} triangles", mesh.chord_misses);
  if (mesh.gap > 0)
    text += fmt::format("\n  vertices lie within {:.3g} of the faces they belong to, which is part of it", mesh.gap);
  if (rounding > 0)
    text += fmt::format("\n  single precision moves vertices of the file by at most {:.3g} more", rounding);
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
  const Writer write = writer_of(extension);
  if (!write) return report_error({ErrorCode::usage, o.out, bytes_error(extension), ""});
  std::error_code ignored;
  for (const std::string& to : {o.out, o.json})
    if (!to.empty() && to != "-" && fs::equivalent(o.model, to, ignored))
      return report_error({ErrorCode::usage, "tessellate", "would overwrite its input", to});
  if (auto error = check_request(request_of(o))) return report_error(*error);
  Source source;
  const auto made = [&](const Options& request) -> Result<CertifiedMesh> {
    source = {};
    if (looks_like_cad(o.model)) {
      if (o.method != "auto" && o.method != "delaunay")
        return Error{ErrorCode::unsupported, "--method", "faces with trimming curves are meshed by delaunay", o.method};
      source.method = "delaunay";
      return mesh_of_cad(o.model, request_of(request), source.units, source.notes);
    }
    Result<ModelFile> file = read_model(o.model, o.decimals);
    if (!file) return file.error();
    for (const std::string& note : file->notes) source.notes.push_back(note);
    return std::visit([&](const auto& model) { return mesh_of(model, request, source); }, file->model);
  };
  // What the file's single precision moves comes on top: there is room for it, and more where that is not enough.
  Options first = o;
  if (is_single_precision(extension)) first.chord = 0.995 * o.chord;
  Result<CertifiedMesh> mesh = made(first);
  if (mesh && mesh->chord <= o.chord && mesh->chord + rounding_of(*mesh, extension) > o.chord) {
    Options less = o;
    less.chord = o.chord - 1.01 * rounding_of(*mesh, extension);
    if (less.chord > 0) mesh = made(less);
  }
  if (!mesh) {
    Error error = mesh.error();
    if (error.where.find(o.model) == std::string::npos)
      error.where = o.model + (error.where.empty() ? "" : ", " + error.where);
    return report_error(error);
  }
  const Watertight closed = check_watertight(*mesh);
  const double rounding = rounding_of(*mesh, extension);
  const bool proved =
      mesh->chord_misses == 0 && mesh->angle_misses == 0 && mesh->chord + rounding <= o.chord && closed.is_watertight();

  MeshPart part{fs::path(o.model).stem().string(), {CellKind::simplex, 2, mesh->vertices, {}}, {}, {}};
  for (const auto& t : mesh->triangles) part.mesh.corners.insert(part.mesh.corners.end(), t.begin(), t.end());
  const Result<std::string> bytes = write({part});
  if (!bytes) return report_error(bytes.error());
  if (const int failed = write_output(o.out, *bytes)) return failed;
  if (!o.json.empty())
    if (const int failed = write_output(o.json, report_json(o, source, *mesh, closed, rounding, proved))) return failed;
  if (o.json != "-")
    if (const int failed = write_output("-", summary(o, source, *mesh, closed, rounding))) return failed;
  return proved ? kProven : kRefuted;
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
