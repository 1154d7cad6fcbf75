// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof::cli {
namespace {

[[maybe_unused]] Error needs_open_cascade(const std::string& path) {
  return {ErrorCode::unsupported, path,
          "STEP, IGES and BREP files need a build with Open CASCADE (Debian: libocct-data-exchange-dev)", ""};
}

// The surfaces of a CAD model's faces, without their borders, and its edges of no face.
[[maybe_unused]] ModelFile untrimmed(CadModel&& cad) {
  Model<Rational> model;
  model.units = cad.units.substr(0, cad.units.find(" (file"));
  for (CadFace& face : cad.faces) {
    const auto& net = face.surface.net();
    const bool rational = std::any_of(net.begin(), net.end(), [](const auto& p) { return p[3] != Rational(1); });
    model.patches.push_back({std::move(face.label), std::move(face.surface), rational});
  }
  for (CadCurve& c : cad.curves) {
    const auto& points = c.curve.points();
    const bool rational = std::any_of(points.begin(), points.end(), [](const auto& p) { return p[3] != Rational(1); });
    model.curves.push_back({std::move(c.label), std::move(c.curve), rational, 3});
  }
  ModelFile file{cad.path, cad.format, cad.sha256, Decimals::binary64, std::move(model), std::move(cad.notes)};
  if (!cad.faces.empty())
    file.notes.push_back("the faces' surfaces are written untrimmed: borders and shared edges are left out");
  return file;
}

Result<ModelFile> read_any(const std::string& path, Decimals decimals) {
  if (!looks_like_cad(path)) return read_model(path, decimals);
#ifdef PATCHPROOF_HAVE_OCCT_READER
  Result<CadModel> cad = read_cad_model(path);
  if (!cad) return cad.error();
  return untrimmed(std::move(*cad));
#else
  return needs_open_cascade(path);
#endif
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

template <ExactField T>
Result<WrittenModel> written_cad(const Model<T>& model, CadFormat format) {
#ifdef PATCHPROOF_HAVE_OCCT_READER
  return write_model_cad(model, format);
#else
  return (void)model, (void)format, needs_open_cascade("convert");
#endif
}

template <ExactField T>
Result<WrittenModel> written(const Model<T>& model, const std::string& to, int cells) {
  const std::string extension = extension_of(to);
  const bool is_json = extension == ".json" || extension.empty();
  if (!is_json && (!model.gregory_patches.empty() || !model.gerbs_patches.empty() || !model.gerbs_curves.empty())) {
    Result<SplinesOnly<T>> splines = with_splines_only(model, cells);
    if (!splines) return splines.error();
    Result<WrittenModel> out = written(splines->model, to, cells);
    if (out) out->notes.insert(out->notes.begin(), splines->notes.begin(), splines->notes.end());
    return out;
  }
  if (extension == ".g2") return write_model_g2(model);
  if (extension == ".step" || extension == ".stp") return written_cad(model, CadFormat::step);
  if (extension == ".iges" || extension == ".igs") return written_cad(model, CadFormat::iges);
  if (extension == ".brep") return written_cad(model, CadFormat::brep);
  if (is_json) return WrittenModel{write_model_json(model), {}};
  return Error{ErrorCode::usage, "convert", "OUT ends in .json, .g2, .step, .iges or .brep (meshes: plot)", to};
}

int run(const std::string& from, const std::string& to, Decimals decimals, int cells) {
  const Result<ModelFile> file = read_any(from, decimals);
  if (!file) return report_error(file.error());
  std::error_code ignored;
  if (to != "-" && std::filesystem::equivalent(from, to, ignored))
    return report_error({ErrorCode::usage, "convert", "would overwrite its input", to});
  const Result<WrittenModel> out =
      std::visit([&](const auto& model) { return written(model, to == "-" ? "" : to, cells); }, file->model);
  if (!out) return report_error(out.error());
  if (const int failed = write_output(to, out->bytes)) return failed;
  for (const auto* notes : {&file->notes, &out->notes})
    for (const std::string& note : *notes) std::fprintf(stderr, "patchproof: note: %s\n", note.c_str());
  return kProven;
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  const auto from = std::make_shared<std::string>(), to = std::make_shared<std::string>();
  const auto decimals = std::make_shared<Decimals>(Decimals::exact);
  CLI::App* command = app.add_subcommand(
      "convert", "write a model as patchproof JSON, every number exact, or as .g2, .step, .iges or .brep");
  command->add_option("in", *from, "file to read; of CAD files the faces' surfaces")->required()->type_name("IN");
  command->add_option("out", *to, "file to write, its extension chooses the format; '-': JSON on standard output")
      ->required()
      ->type_name("OUT");
  const auto cells = std::make_shared<int>(kApproximationCells);
  command
      ->add_option("--cells", *cells,
                   "cells along each side of the B-spline patches that stand for Gregory patches in .g2 and CAD files")
      ->check(CLI::Range(1, 64))
      ->option_text("N");
  add_decimals(*command, *decimals);
  command->callback([=, &exit_code] { exit_code = run(*from, *to, *decimals, *cells); });
}

}  // namespace patchproof::cli
