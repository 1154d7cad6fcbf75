// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

namespace patchproof::cli {
namespace {

template <ExactField T>
std::string describe(const Model<T>& model) {
  std::string text;
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const ModelPatch<T>& p = model.patches[i];
    const auto direction = [&](Direction d) {
      const KnotVector<T>& k = p.surface.knots(d);
      return fmt::format("degree {}, {} points, domain [{}, {}], {} spans", k.degree(), k.control_count(),
                         to_text(k.domain_begin()), to_text(k.domain_end()), k.breaks().size() - 1);
    };
    text += fmt::format("patch {}{}{}\n  u: {}\n  v: {}\n", i, p.name.empty() ? "" : " " + p.name,
                        p.is_rational ? ", rational" : "", direction(Direction::u), direction(Direction::v));
  }
  if (!model.joins.empty()) text += fmt::format("{} joins declared in the file\n", model.joins.size());
  return text;
}

int run_info(const std::string& path, Decimals decimals) {
  const Result<ModelFile> file = read_model(path, decimals);
  if (!file) return report_error(file.error());
  std::string text = fmt::format("{}: {}, sha256 {}\n", file->path, file->format, file->sha256);
  std::visit(
      [&](const auto& model) {
        text += fmt::format("{} patches{}, numbers in {}\n", model.patches.size(),
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
  CLI::App* command = app.add_subcommand("info", "what a model holds");
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
