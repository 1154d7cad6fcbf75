// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <regex>

#include "cli/commands.h"
#include "patchproof/io/animation.h"
#include "patchproof/io/motion.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string model, motion, out, format = "both";
  int frames = 24, cells = 0;
  double seconds = 2;
  bool has_cells = false, force = false;
  Decimals decimals = Decimals::exact;
};

struct OutputFile {
  std::string name, bytes;
};

std::string frame_name(int number, const char* extension) { return fmt::format("frame_{:04}.{}", number, extension); }

bool is_of_an_animation(const std::string& name) {
  static const std::regex names("frame_[0-9]{4}\\.(json|svg)|animation\\.svg");
  return std::regex_match(name, names);
}

// Whether frames may be written there. With --force an earlier animation is in the way of nothing.
std::optional<Error> refusal(const Options& o) {
  std::error_code failure;
  const fs::path out(o.out);
  const auto status = fs::status(out, failure);
  if (status.type() == fs::file_type::not_found) {
    const fs::path parent = out.has_parent_path() ? out.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, failure))
      return Error{ErrorCode::cannot_open, o.out, "there is no directory to make it in", parent.string()};
    return std::nullopt;
  }
  if (failure) return Error{ErrorCode::cannot_open, o.out, "cannot be read", failure.message()};
  if (status.type() != fs::file_type::directory)
    return Error{ErrorCode::usage, o.out, "frames are written into a directory", ""};
  const bool is_empty = fs::is_empty(out, failure);
  if (failure) return Error{ErrorCode::cannot_open, o.out, "cannot be read", failure.message()};
  if (!is_empty && !o.force)
    return Error{ErrorCode::usage, o.out, "the directory is not empty; --force writes into it all the same", ""};
  for (const std::string& input : {o.model, o.motion})
    if (is_of_an_animation(fs::path(input).filename().string()) &&
        fs::equivalent(fs::absolute(fs::path(input)).parent_path(), out, failure))
      return Error{ErrorCode::usage, "animate", "would overwrite its input", input};
  return std::nullopt;
}

Error in_file(const std::string& path, Error error) {
  error.where = error.where.empty() ? path : path + ", " + error.where;
  return error;
}

template <ExactField T>
Result<std::vector<OutputFile>> make_files(const Options& o, const Model<T>& model) {
  if (model.gerbs_curves.empty() && model.gerbs_patches.empty())
    return Error{ErrorCode::usage, o.model, "the model has no GERBS curves and patches, and only these can move", ""};
  const Result<ModelMotion<T>> motion = read_motion(o.motion, model, o.decimals);
  if (!motion) return motion.error();
  std::vector<Model<T>> frames;
  for (int k = 0; k < o.frames; ++k) frames.push_back(frame(model, *motion, k, o.frames));
  std::vector<OutputFile> files;
  if (o.format != "svg")
    for (int k = 0; k < o.frames; ++k) files.push_back({frame_name(k + 1, "json"), write_model_json(frames[k])});
  if (o.format == "json") return files;
  PlotOptions options;
  options.title = fs::path(o.model).stem().string();
  options.control = false;
  if (o.has_cells) options.cells = o.cells;
  Result<Animation> animation = plot_frames(frames, options, o.seconds);
  if (!animation) return in_file(o.model, animation.error());
  for (int k = 0; k < o.frames; ++k) files.push_back({frame_name(k + 1, "svg"), std::move(animation->frames[k])});
  files.push_back({"animation.svg", std::move(animation->moving)});
  return files;
}

// All of them or none.
int write_files(const Options& o, const std::vector<OutputFile>& files) {
  std::error_code failure;
  const bool is_new = fs::create_directory(o.out, failure);
  if (failure) return report_error({ErrorCode::cannot_open, o.out, "cannot be made", failure.message()});
  std::vector<fs::path> earlier;
  for (const auto& entry : fs::directory_iterator(o.out, failure))
    if (entry.is_regular_file(failure) && is_of_an_animation(entry.path().filename().string()))
      earlier.push_back(entry.path());
  for (const fs::path& path : earlier)
    if (!fs::remove(path, failure))
      return report_error({ErrorCode::cannot_open, path.string(), "cannot be replaced", failure.message()});
  for (std::size_t i = 0; i < files.size(); ++i) {
    const int code = write_output((fs::path(o.out) / files[i].name).string(), files[i].bytes);
    if (code == 0) continue;
    for (std::size_t k = 0; k < i; ++k) fs::remove(fs::path(o.out) / files[k].name, failure);
    if (is_new) fs::remove(o.out, failure);
    return code;
  }
  return 0;
}

int run(const Options& o) {
  if (const auto error = refusal(o)) return report_error(*error);
  const Result<ModelFile> file = read_model(o.model, o.decimals);
  if (!file) return report_error(file.error());
  const auto files = std::visit([&](const auto& model) { return make_files(o, model); }, file->model);
  if (!files) return report_error(files.error());
  if (const int code = write_files(o, *files); code != 0) return code;
  std::string text = fmt::format("{}: {} frames", o.out, o.frames);
  if (o.format != "svg") text += fmt::format("; {} … as models", frame_name(1, "json"));
  if (o.format != "json") text += fmt::format("; {} … as pictures, animation.svg shows them", frame_name(1, "svg"));
  return write_output("-", text + "\n");
}

}  // namespace

void add_animate(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("animate", "GERBS curves and patches whose local curves move: frames, and a moving picture");
  command->add_option("model", o->model, "model with GERBS curves or patches")->required()->type_name("MODEL");
  command->add_option("motion", o->motion, "how its local curves and patches move (docs/formats.md)")
      ->required()
      ->type_name("MOTION");
  command->add_option("out", o->out, "directory to write to, which is made")->required()->type_name("OUT_DIR");
  command->add_option("--frames", o->frames, "frames of one period, there and back [24]")
      ->check(CLI::Range(2, kMostFrames))
      ->option_text("N");
  command->add_option("--format", o->format, "models, pictures, or both [both]")
      ->check(CLI::IsMember({"json", "svg", "both"}))
      ->option_text("json|svg|both");
  command->add_option("--seconds", o->seconds, "how long one period of the moving picture lasts [2]")
      ->check(CLI::Range(0.01, 3600.0))
      ->option_text("S");
  CLI::Option* cells = command->add_option("--cells", o->cells, "cells in each span of the pictures")
                           ->check(CLI::Range(1, 1000))
                           ->option_text("N");
  command->add_flag("--force", o->force,
                    "write into a directory that is not empty; an earlier animation there is replaced");
  add_decimals(*command, o->decimals);
  command->callback([=, &exit_code] {
    o->has_cells = cells->count() > 0;
    exit_code = run(*o);
  });
}

}  // namespace patchproof::cli
