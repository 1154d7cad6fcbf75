// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/describe_model.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof::cli {
namespace {

std::string plural(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

int run_info(const std::string& path, Decimals decimals) {
  const Result<ModelFile> file = read_model(path, decimals);
  if (!file) return report_error(file.error());
  std::string text = fmt::format("{}: {}, sha256 {}\n", file->path, file->format, file->sha256);
  std::visit(
      [&](const auto& model) {
        text += fmt::format("{}, {}{}, numbers in {}\n", plural(model.patches.size(), "patch", "patches"),
                            plural(model.curves.size(), "curve", "curves"),
                            model.units.empty() ? "" : ", units " + model.units,
                            std::holds_alternative<Model<Rational>>(file->model) ? "Q" : "Q(√d)");
        for (const std::string& note : file->notes) text += "note: " + note + "\n";
        text += describe(model);
      },
      file->model);
  return write_output("-", text);
}

int run_convert(const std::string& from, const std::string& to, Decimals decimals) {
  const Result<ModelFile> file = read_model(from, decimals);
  if (!file) return report_error(file.error());
  std::error_code ignored;
  if (to != "-" && std::filesystem::equivalent(from, to, ignored))
    return report_error({ErrorCode::usage, "convert", "would overwrite its input", to});
  return write_output(to, std::visit([](const auto& model) { return write_model_json(model); }, file->model));
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  const auto path = std::make_shared<std::string>();
  const auto decimals = std::make_shared<Decimals>(Decimals::exact);
  CLI::App* command = app.add_subcommand("info", "what a model holds: knots, exact smoothness, denominators");
  command->add_option("model", *path, "file to read")->required()->type_name("MODEL");
  add_decimals(*command, *decimals);
  command->callback([=, &exit_code] { exit_code = run_info(*path, *decimals); });
}

void add_convert(CLI::App& app, int& exit_code) {
  const auto from = std::make_shared<std::string>(), to = std::make_shared<std::string>();
  const auto decimals = std::make_shared<Decimals>(Decimals::exact);
  CLI::App* command = app.add_subcommand("convert", "write a model as patchproof JSON, every number exact");
  command->add_option("in", *from, "file to read")->required()->type_name("IN");
  command->add_option("out", *to, "file to write, '-' for standard output")->required()->type_name("OUT");
  add_decimals(*command, *decimals);
  command->callback([=, &exit_code] { exit_code = run_convert(*from, *to, *decimals); });
}

}  // namespace patchproof::cli
