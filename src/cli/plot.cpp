// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/plot.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "cli/commands.h"
#include "patchproof/io/read.h"

namespace patchproof::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> paths;  // models, and where to write
  std::string format;
  bool basis = false, control = false, no_control = false, normals = false;
  int cells = 0, curve = -1, patch = -1, solid = -1, sections = 0;
  bool has_sections = false, has_cells = false, has_curve = false, has_patch = false, has_solid = false;
  Decimals decimals = Decimals::exact;
};

constexpr const char* kFormats = "svg, obj, stl, vtu or glb";

// Where each picture goes.
struct Target {
  std::string model, out;
};

Result<std::vector<Target>> targets(const Options& o, const std::string& extension) {
  const std::string& out = o.paths.back();
  std::error_code ignored;
  std::vector<Target> all;
  const bool folder = out != "-" && fs::is_directory(out, ignored);
  if (o.paths.size() > 2 && !folder)
    return Error{ErrorCode::usage, out, "several models need an existing directory to write to", ""};
  if (folder && o.format.empty())
    return Error{ErrorCode::usage, out, "is a directory; --format says what to write into it", ""};
  std::map<std::string, std::string> owners;
  for (std::size_t i = 0; i + 1 < o.paths.size(); ++i) {
    Target t{o.paths[i], out};
    if (folder) {
      t.out = (fs::path(out) / fs::path(t.model).stem()).string() + "." + extension;
      const auto [owner, is_new] = owners.emplace(t.out, t.model);
      if (!is_new)
        return Error{ErrorCode::usage, t.out, "two models would be written to one file",
                     owner->second + ", " + t.model};
    }
    for (std::size_t k = 0; k + 1 < o.paths.size(); ++k)
      if (t.out != "-" && fs::equivalent(o.paths[k], t.out, ignored))
        return Error{ErrorCode::usage, "plot", "would overwrite its input", t.out};
    all.push_back(std::move(t));
  }
  return all;
}

int run(const Options& o) {
  const std::string& out = o.paths.back();
  std::string extension = !o.format.empty() ? o.format : out == "-" ? "svg" : fs::path(out).extension().string();
  const auto format = plot_format(extension);
  std::error_code ignored;
  if (!format && !fs::is_directory(out, ignored))
    return report_error({ErrorCode::usage, out,
                         extension.empty()
                             ? fmt::format("the name has no extension; --format says what to write: {}", kFormats)
                             : fmt::format("the format is unknown; it is one of {}", kFormats),
                         extension});
  const auto all = targets(o, extension);
  if (!all) return report_error(all.error());
  PlotOptions options;
  options.basis = o.basis;
  if (o.control || o.no_control) options.control = o.control;
  options.normals = o.normals;
  if (o.has_sections) options.sections = o.sections;
  if (o.has_cells) options.cells = o.cells;
  if (o.has_curve) options.curve = o.curve;
  if (o.has_patch) options.patch = o.patch;
  if (o.has_solid) options.solid = o.solid;
  // All pictures are made before the first is written: a bad model among good ones leaves no file.
  std::vector<std::string> files;
  for (const Target& t : *all) {
    const Result<ModelFile> file = read_model(t.model, o.decimals);
    if (!file) return report_error(file.error());
    options.title = fs::path(t.model).stem().string();
    auto bytes = std::visit([&](const auto& model) { return plot(model, *format, options); }, file->model);
    if (!bytes) {
      const Error& e = bytes.error();
      return report_error({e.code, t.model + (e.where.empty() ? "" : ", " + e.where), e.message, e.values});
    }
    files.push_back(std::move(*bytes));
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    if (const int code = write_output((*all)[i].out, files[i]); code != 0) return code;
  return kProven;
}

}  // namespace

void add_plot(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plot", "pictures of models (svg), and meshes of them (obj, stl, vtu, glb)");
  command
      ->add_option("models", o->paths,
                   "models to read, then the file to write ('-' for standard output), or a directory with --format")
      ->required()
      ->expected(2, -1)
      ->type_name("MODEL... OUT");
  command->add_option("--format", o->format, "instead of by OUT's extension")
      ->check(CLI::IsMember({"svg", "obj", "stl", "vtu", "glb"}))
      ->option_text("svg|obj|stl|vtu|glb");
  command->add_flag("--basis", o->basis, "the basis functions over their knots instead of the geometry");
  CLI::Option* control =
      command->add_flag("--control", o->control, "control nets of patches, too; of Gregory patches those of U and V");
  command->add_flag("--no-control", o->no_control, "no control polygons")->excludes(control);
  command->add_flag("--normals", o->normals, "normals at edges and, from both sides, at knot lines of patches");
  CLI::Option* sections = command->add_option("--sections", o->sections, "so many sections z = const of the surfaces")
                              ->check(CLI::Range(1, 1000))
                              ->option_text("N");
  CLI::Option* cells = command->add_option("--cells", o->cells, "cells in each span of the knots")
                           ->check(CLI::Range(1, 1000000))
                           ->option_text("N");
  CLI::Option* curve = command->add_option("--curve", o->curve, "only this curve, from 0")->option_text("I");
  CLI::Option* patch = command->add_option("--patch", o->patch, "only this patch, from 0")->option_text("I");
  CLI::Option* solid = command->add_option("--solid", o->solid, "only this solid, from 0")->option_text("I");
  add_decimals(*command, o->decimals);
  command->callback([=, &exit_code] {
    o->has_sections = sections->count() > 0;
    o->has_cells = cells->count() > 0;
    o->has_curve = curve->count() > 0;
    o->has_patch = patch->count() > 0;
    o->has_solid = solid->count() > 0;
    exit_code = run(*o);
  });
}

}  // namespace patchproof::cli
