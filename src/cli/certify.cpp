// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <sstream>

#include "cli/commands.h"
#include "patchproof/io/cad.h"
#include "patchproof/io/curve_files.h"
#include "patchproof/io/profile.h"
#include "patchproof/io/read.h"
#include "patchproof/io/report.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::vector<std::string> models;
  std::optional<std::string> require;
  std::optional<double> gap, angle, curvature, match;
  std::string profile;
  double budget = 10, smooth_below = 5;
  int jobs = 0;
  Decimals decimals = Decimals::exact;
  std::string json;
  bool quiet = false, keep_going = false, time = false;
};

// One line on standard error, only when it is a terminal.
class ProgressBar {
 public:
  ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}
  void show(std::size_t done, std::size_t all) {
    if (!terminal_ || all < 200) return;
    const int percent = static_cast<int>(100 * done / all);
    if (percent == last_.exchange(percent)) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    std::fprintf(stderr, "\r[%-40.*s] %3d %%", percent * 40 / 100, "########################################", percent);
    if (done == all) std::fprintf(stderr, "\r\x1b[K");
  }

 private:
  bool terminal_;
  std::atomic<int> last_{-1};
  std::mutex mutex_;
};

// A number in [low, high]; not-a-number is none. (CLI::Range lets it pass.)
CLI::Validator between(double low, double high) {
  const std::string range = fmt::format("[{:g}, {:g}]", low, high);
  return CLI::Validator(
      [=](std::string& text) {
        double x = 0;
        return CLI::detail::lexical_cast(text, x) && low <= x && x <= high ? "" : text + " is not a number in " + range;
      },
      range);
}

int exit_code_of(Outcome outcome) {
  return outcome == Outcome::pass ? kProven : outcome == Outcome::fail ? kRefuted : kUndecided;
}

// fail outranks undecided outranks pass.
Outcome worse(Outcome a, Outcome b) {
  if (a == Outcome::fail || b == Outcome::fail) return Outcome::fail;
  return a == Outcome::undecided || b == Outcome::undecided ? Outcome::undecided : Outcome::pass;
}

// Patches with exact numbers, or trimmed faces.
using Input = std::variant<ModelFile, CadModel>;

Result<Input> read_input(const std::string& path, Decimals decimals, [[maybe_unused]] bool keep_going) {
  if (looks_like_cad(path)) {
#ifdef PATCHPROOF_HAVE_OCCT_READER
    Result<CadModel> model = read_cad_model(path, keep_going ? UnusableFaces::leave_out : UnusableFaces::refuse);
    if (!model) return model.error();
    return Input(std::move(*model));
#else
    return Error{ErrorCode::unsupported, path,
                 "STEP, IGES and BREP files are read by builds with Open CASCADE (Debian: libocct-data-exchange-dev)",
                 ""};
#endif
  }
  Result<ModelFile> file = read_model(path, decimals);
  if (!file) return file.error();
  if (std::visit(
          [](const auto& m) {
            return m.patches.empty() && m.gregory_patches.empty() && m.curves.empty() && m.gerbs_patches.empty() &&
                   m.gerbs_curves.empty();
          },
          file->model))
    return Error{ErrorCode::wrong_count, path, "the model has neither patches nor curves: no joins to certify", ""};
  return Input(std::move(*file));
}

std::string_view units_of(const Input& input) {
  if (const CadModel* cad = std::get_if<CadModel>(&input)) return cad->units;
  return std::visit([](const auto& model) -> std::string_view { return model.units; },
                    std::get<ModelFile>(input).model);
}

// The curves of a file that holds nothing else.
std::optional<CurveFile> only_curves(const Input& input) {
  if (const CadModel* cad = std::get_if<CadModel>(&input)) {
    if (!cad->faces.empty() || !cad->left_out.empty() || !cad->edges.empty()) return std::nullopt;
    return curves_of(*cad);
  }
  const ModelFile& file = std::get<ModelFile>(input);
  if (!std::visit(
          [](const auto& m) {
            return m.patches.empty() && m.gregory_patches.empty() && m.gerbs_patches.empty() && m.gerbs_curves.empty();
          },
          file.model))
    return std::nullopt;
  return curves_of(file);
}

bool has_curves(const Input& input) {
  if (const CadModel* cad = std::get_if<CadModel>(&input)) return !cad->curves.empty();
  return std::visit([](const auto& m) { return !m.curves.empty(); }, std::get<ModelFile>(input).model);
}

// An option that none of the files gives a meaning would be ignored silently.
std::optional<Error> without_meaning(const Options& options, const std::vector<Input>& files) {
  const bool curves = std::any_of(files.begin(), files.end(), has_curves);
  const bool all_cad =
      std::all_of(files.begin(), files.end(), [](const Input& f) { return std::holds_alternative<CadModel>(f); });
  if (options.curvature && !curves)
    return Error{ErrorCode::usage, "--curvature", "is asked of joins of curves, and there are no curves",
                 options.models.front()};
  if (options.match && !curves && all_cad)
    return Error{ErrorCode::usage, "--match", "which faces of a CAD model meet, the file says", options.models.front()};
  return std::nullopt;
}

int list_profiles() {
  std::string text;
  for (const Profile& profile : all_profiles()) {
    text += fmt::format("{}: {}\n  source: {}\n", profile.name, profile.title, profile.source);
    if (!profile.remark.empty()) text += fmt::format("  remark: {}\n", profile.remark);
    for (const Criterion& c : profile.criteria)
      text += fmt::format("  {} {:<46} at most {} {}{}{}\n", c.code, c.what, c.threshold, c.unit,
                          c.quantity == Quantity::unchecked ? " (not checked)" : "",
                          c.entity.empty() ? "" : fmt::format(" [{}]", c.entity));
  }
  return write_output("-", text);
}

int run(const Options& options) {
  CertifyOptions certify;
  if (options.require)
    certify.request.require = *options.require == "C0"   ? Continuity::c0
                              : *options.require == "C1" ? Continuity::c1
                                                         : Continuity::g1;
  certify.request.gap_tolerance = options.gap;
  certify.request.angle_tolerance = options.angle;
  certify.request.seconds_per_join = options.budget;
  certify.given = certify.request;
  certify.profile = find_profile(options.profile);
  certify.curvature_tolerance = options.curvature;
  certify.match_length = options.match.value_or(0);
  certify.smooth_below = options.smooth_below;
  certify.jobs = options.jobs;
  ProgressBar bar;
  certify.progress = [&](std::size_t done, std::size_t all) { bar.show(done, all); };

  // All files are read before anything is reported: bad input leaves no partial report.
  std::vector<Input> files;
  for (const std::string& path : options.models) {
    Result<Input> file = read_input(path, options.decimals, options.keep_going);
    if (!file) return report_error(file.error());
    if (certify.profile)
      if (const auto request = tolerances_of(*certify.profile, units_of(*file), certify.given); !request)
        return report_error(request.error());
    files.push_back(std::move(*file));
    std::error_code ignored;
    if (options.json != "-" && std::filesystem::equivalent(path, options.json, ignored))
      return report_error({ErrorCode::usage, "--json", "would overwrite the model", options.json});
  }
  if (const auto error = without_meaning(options, files)) return report_error(*error);
  // Files that hold only curves are one model: ends meet across them.
  std::vector<CurveFile> curves;
  for (std::size_t i = 0; i < files.size();) {
    std::optional<CurveFile> own = files.size() + curves.size() > 1 ? only_curves(files[i]) : std::nullopt;
    if (own && !curves.empty())
      files.erase(files.begin() + static_cast<std::ptrdiff_t>(i));  // reported with the first of them
    else
      ++i;
    if (own) curves.push_back(std::move(*own));
  }
  Outcome outcome = Outcome::pass;
  std::ostringstream json, table;
  if (!options.json.empty() && files.size() > 1) json << "[";
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (certify.profile) certify.request = *tolerances_of(*certify.profile, units_of(files[i]), certify.given);
    const auto began = std::chrono::steady_clock::now();
    Result<Report> certified = curves.size() > 1 && only_curves(files[i])
                                   ? certify_curve_files(curves, certify)
                                   : std::visit(
                                         [&]<class File>(const File& file) -> Result<Report> {
                                           if constexpr (std::is_same_v<File, CadModel>)
                                             return certify_cad(file, certify);
                                           else
                                             return certify_model(file, certify);
                                         },
                                         files[i]);
    if (!certified) return report_error(certified.error());
    if (options.time)
      certified->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const Report& report = *certified;
    outcome = worse(outcome, report.outcome());
    if (!options.json.empty()) {
      if (i > 0) json << ",\n";
      write_json(json, report);
    }
    if (options.json != "-") {
      if (i > 0) table << '\n';
      write_table(table, report, {options.quiet, isatty(STDOUT_FILENO) != 0});
    }
  }
  if (!options.json.empty()) {
    if (files.size() > 1) json << "]\n";
    if (const int failed = write_output(options.json, std::move(json).str())) return failed;
  }
  if (options.json != "-")
    if (const int failed = write_output("-", std::move(table).str())) return failed;
  return exit_code_of(outcome);
}

}  // namespace

void add_certify(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("certify", "prove, refute or bound every join of a model");
  command->add_option("model", options->models, "files to certify")->type_name("MODEL");
  command->add_option("--require", options->require, "every join must be proven of this class")
      ->check(CLI::IsMember({"C0", "C1", "G1"}))
      ->option_text("C0|C1|G1");
  command->add_option("--gap", options->gap, "largest gap allowed, in the model's units")
      ->check(between(0, 1e300))
      ->option_text("LENGTH");
  command->add_option("--angle", options->angle, "largest normal angle allowed, in degrees")
      ->check(between(0, 180))
      ->option_text("DEGREES");
  command
      ->add_option("--curvature", options->curvature,
                   "models of curves: largest difference of curvature vectors where two join, in 1/the model's units")
      ->check(between(0, 1e300))
      ->option_text("CURVATURE");
  std::vector<std::string> names{"list"};
  for (const Profile& profile : all_profiles()) names.emplace_back(profile.name);
  command
      ->add_option("--profile", options->profile,
                   "thresholds that --gap and --angle do not set: " + CLI::detail::join(names, ", "))
      ->check(CLI::IsMember(names))
      ->option_text("NAME");
  command
      ->add_option("--match", options->match,
                   "which edges are looked at: those within this length of each other [1e-6 of the diagonal]")
      ->check(between(0, 1e300))
      ->option_text("LENGTH");
  command->add_option("--json", options->json, "write the report as JSON ('-': to standard output, nothing else)")
      ->option_text("FILE|-");
  command->add_option("--jobs", options->jobs, "threads; the report does not depend on it [one per processor]")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  command->add_option("--budget", options->budget, "time for one join before it ends undecided [10]")
      ->check(between(0, 1e6))
      ->option_text("SECONDS");
  add_decimals(*command, options->decimals);
  command
      ->add_option(
          "--smooth-below", options->smooth_below,
          "STEP, IGES, BREP: edges above this angle are meant to be sharp, and no tangents are asked of them [5]")
      ->check(between(0, 180))
      ->option_text("DEGREES");
  command->add_flag("--keep-going", options->keep_going,
                    "STEP, IGES, BREP: leave out faces that are not usable, list them and report the rest");
  command->add_flag("--time", options->time, "report how long certifying took, without reading");
  command->add_flag("--quiet", options->quiet, "print the summary only");
  command->callback([options, &exit_code] {
    if (options->profile == "list") {
      exit_code = list_profiles();
    } else {
      if (options->models.empty()) throw CLI::RequiredError("model");
      exit_code = run(*options);
    }
  });
}

}  // namespace patchproof::cli
