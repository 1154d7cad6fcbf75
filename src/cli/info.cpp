// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/describe_model.h"
#include "patchproof/io/read.h"

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
        text += fmt::format("{}, {}{}, numbers in {}\n",
                            plural(model.patches.size() + model.gerbs_patches.size() + model.gregory_patches.size(),
                                   "patch", "patches"),
                            plural(model.curves.size() + model.gerbs_curves.size(), "curve", "curves"),
                            model.units.empty() ? "" : ", units " + model.units,
                            std::holds_alternative<Model<Rational>>(file->model) ? "Q" : "Q(√d)");
        for (const std::string& note : file->notes) text += "note: " + note + "\n";
        text += describe(model);
      },
      file->model);
  return write_output("-", text);
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

}  // namespace patchproof::cli
