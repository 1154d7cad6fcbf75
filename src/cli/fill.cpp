// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/io/fill_model.h"
#include "patchproof/io/write.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string from, to;
  std::string method = "c1", scale = "auto";
  std::optional<double> repair;  // degrees
  int jobs = 0;
  bool quiet = false;
  Decimals decimals = Decimals::exact;
};

std::string plural(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

std::string text_of(const VerdictTally& tally) {
  std::string out = fmt::format("{} proven", tally.proven);
  if (tally.refuted > 0) out += fmt::format(", {} refuted", tally.refuted);
  if (tally.undecided > 0) out += fmt::format(", {} undecided", tally.undecided);
  return out;
}

// What was done to the mesh before it was filled.
std::string preparation_of(const FilledModel& filled, const std::string& units) {
  std::string out;
  if (filled.repair) {
    out += fmt::format("repaired: {} moved, by at most {} {}\n",
                       plural(filled.repair->moved, "point or vector", "points and vectors"),
                       to_text(filled.repair->largest), units);
    if (!filled.repair->edges.empty()) out += fmt::format("  of edges {}\n", fmt::join(filled.repair->edges, ", "));
    for (const std::string& vertex : filled.repair->vertices)
      out += fmt::format("  vertex {}: its tangents are farther from one plane, and stay\n", vertex);
  }
  if (filled.split)
    out += fmt::format("split: {} not of four sides; {} in place of {}\n", plural(filled.split->faces, "face", "faces"),
                       plural(filled.split->after, "face", "faces"), filled.split->before);
  return out;
}

Error at(const std::string& path, Error error) {
  error.where = error.where.empty() ? path : path + ", " + error.where;
  return error;
}

// Empty: by the mesh.
std::optional<NodeScale> scale_of(const std::string& word) {
  if (word == "auto") return std::nullopt;
  return word == "rational" ? NodeScale::rational : NodeScale::none;
}

int run(const Options& options) {
  if (const std::string extension = std::filesystem::path(options.to).extension().string();
      extension != ".json" && std::filesystem::path(options.to).has_extension())
    return report_error({ErrorCode::usage, "fill", "OUT ends in .json; convert makes other formats of it", options.to});
  if (options.repair && !(*options.repair >= 0 && *options.repair <= 30))
    return report_error(
        {ErrorCode::usage, "--repair", "an angle from 0 to 30 degrees", fmt::format("{}", *options.repair)});
  Result<CurveMeshFile> file = read_curve_mesh(options.from, options.decimals);
  if (!file) return report_error(file.error());
  std::error_code ignored;
  if (options.to != "-" && std::filesystem::equivalent(options.from, options.to, ignored))
    return report_error({ErrorCode::usage, "fill", "would overwrite its input", options.to});
  const FillRequest request{options.method == "former" ? FillMethod::former : FillMethod::c1, scale_of(options.scale),
                            options.repair, options.jobs};
  const Result<FilledModel> filled = fill_model(std::move(file->mesh), request, file->units);
  if (!filled) return report_error(at(options.from, filled.error()));
  if (const int failed = write_output(options.to, write_model_json(filled->model))) return failed;

  std::string text = preparation_of(*filled, file->units);
  text +=
      fmt::format("{}: {}, {} ({} smooth, {} sharp, {} boundary)\n", options.from,
                  plural(filled->mesh.faces.size(), "face", "faces"),
                  plural(filled->mesh.edges.size(), "edge", "edges"), filled->smooth, filled->sharp, filled->boundary);
  if (!options.quiet)
    for (const std::string& line : exceptions_of(*filled)) text += "  " + line + "\n";
  text += fmt::format("G1 across smooth edges: {}\nC1 inside patches: {}\nnormal nowhere zero: {}\n",
                      text_of(filled->g1), text_of(filled->c1), text_of(filled->regular));
  if (options.to == "-")  // where the model is
    std::fputs(text.c_str(), stderr);
  else if (const int failed = write_output("-", text))
    return failed;
  const Verdict verdict = filled->verdict();
  return verdict == Verdict::refuted ? kRefuted : verdict == Verdict::undecided ? kUndecided : kProven;
}

}  // namespace

void add_fill(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("fill", "fill a mesh of curves with Gregory patches, and prove how they join");
  command->add_option("mesh", options->from, "curve mesh to fill (docs/formats.md)")->required()->type_name("MESH");
  command->add_option("out", options->to, "model to write; '-': on standard output, and the summary on standard error")
      ->required()
      ->type_name("OUT");
  command
      ->add_option("--method", options->method,
                   "c1: C1 inside every face; former: the earlier method, for comparison [c1]")
      ->check(CLI::IsMember({"c1", "former"}))
      ->option_text("c1|former");
  command
      ->add_option(
          "--scale", options->scale,
          "node vectors of the basis patches as they are (none), or divided by their rounded lengths (rational); auto: "
          "rational where there are T-nodes or faces to be split [auto]")
      ->check(CLI::IsMember({"auto", "none", "rational"}))
      ->option_text("auto|none|rational");
  command
      ->add_option(
          "--repair", options->repair,
          "first make exact what is nearly so: tangents at a vertex in one plane, opposite control vectors, C1 at "
          "knots, ends on nodes, where they miss it by at most this angle")
      ->check(CLI::Range(0.0, 30.0))
      ->option_text("DEGREES");
  command->add_option("--jobs", options->jobs, "threads; the result does not depend on it [one per processor]")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  add_decimals(*command, options->decimals);
  command->add_flag("--quiet", options->quiet, "print the summary only");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace patchproof::cli
