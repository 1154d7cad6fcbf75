// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/evaluate_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "patchproof/io/read.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string model, at, scalar = "rational", json;
  std::optional<int> patch, curve, solid;
  int derivatives = 0;
  bool left = false;
  Decimals decimals = Decimals::exact;
};

// The part asked for: else the first patch, or the only curve of a model without patches.
Result<ModelPart> choose_part(const ModelFile& file, const Options& o) {
  if (o.solid) return ModelPart{PartKind::solid, *o.solid};
  const int curves = part_count(file, PartKind::curve);
  if (o.curve || (!o.patch && part_count(file, PartKind::patch) == 0)) {
    if (!o.curve && curves > 1)
      return Error{ErrorCode::usage, "evaluate",
                   fmt::format("the model has curves 0 to {}: --curve says which", curves - 1), ""};
    return ModelPart{PartKind::curve, o.curve.value_or(0)};
  }
  return ModelPart{PartKind::patch, o.patch.value_or(0)};
}

// "U,V" of a patch, "T" of a curve, "U,V,W" of a solid.
PlaceText place_of(PartKind kind, const Options& o) {
  PlaceText out;
  std::string rest = o.at;
  const std::size_t most = kind == PartKind::curve ? 1 : kind == PartKind::patch ? 2 : std::string::npos;
  for (std::size_t comma; out.at.size() + 1 < most && (comma = rest.find(',')) != std::string::npos;) {
    out.at.push_back(rest.substr(0, comma));
    rest.erase(0, comma + 1);
  }
  out.at.push_back(rest);
  if (o.left) out.sides.assign(kind == PartKind::curve ? 1 : kind == PartKind::patch ? 2 : 3, Side::left);
  return out;
}

// The library's error in terms of options.
Error in_options(Error error) {
  if (error.where == "scalar")
    error.message = "the values of this GERBS are transcendental: --scalar interval encloses them";
  error.where = error.where.empty() ? "evaluate" : "--" + error.where;
  return error;
}

int run(const Options& o) {
  const Result<ModelFile> file = read_model(o.model, o.decimals);
  if (!file) return report_error(file.error());
  const Result<ModelPart> part = choose_part(*file, o);
  if (!part) return report_error(part.error());
  const ValueScalar scalar = o.scalar == "rational"   ? ValueScalar::rational
                             : o.scalar == "interval" ? ValueScalar::interval
                                                      : ValueScalar::binary64;
  const Result<std::vector<DerivativeText>> result =
      evaluate_model(*file, *part, place_of(part->kind, o), o.derivatives, scalar);
  if (!result) return report_error(in_options(result.error()));
  std::string text;
  if (!o.json.empty()) {
    nlohmann::ordered_json json{{"tool", "patchproof"},   {"version", PATCHPROOF_VERSION},       {"file", o.model},
                                {"sha256", file->sha256}, {to_string(part->kind), part->number}, {"at", o.at},
                                {"scalar", o.scalar}};
    const std::string parameters = part->kind == PartKind::curve ? "t" : part->kind == PartKind::patch ? "uv" : "uvw";
    for (const DerivativeText& row : *result) {
      nlohmann::ordered_json entry;
      for (std::size_t s = 0; s < parameters.size(); ++s) entry[std::string("d") + parameters[s]] = row.order[s];
      entry["value"] = row.value;
      json["values"].push_back(std::move(entry));
    }
    text = json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  } else {
    for (const DerivativeText& row : *result) text += fmt::format("{:<8}{}\n", row.name, fmt::join(row.value, "  "));
  }
  return write_output(o.json.empty() ? "-" : o.json, text);
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("evaluate",
                                         "points and derivatives of one patch, "
                                         "curve or solid, exactly or enclosed");
  command->add_option("model", o->model, "file to read")->required()->type_name("MODEL");
  CLI::Option* patch = command->add_option("--patch", o->patch, "which patch, from 0 [0]")->option_text("I");
  CLI::Option* curve =
      command->add_option("--curve", o->curve, "which curve, from 0 [the only one of a model without patches]");
  curve->excludes(patch)->option_text("I");
  command->add_option("--solid", o->solid, "which solid, from 0")->excludes(patch)->excludes(curve)->option_text("I");
  command
      ->add_option("--at", o->at,
                   "parameters in the own domain of the patch, e.g. 1/3,0.25, "
                   "of the curve or of the solid")
      ->required()
      ->option_text("U,V|T|U,V,W");
  command->add_option("--derivatives", o->derivatives, "all derivatives up to this order [0]")
      ->check(CLI::Range(0, 20))
      ->option_text("K");
  command->add_option("--scalar", o->scalar, "number type [rational]")
      ->check(CLI::IsMember({"rational", "double", "interval"}))
      ->option_text("rational|double|interval");
  command->add_flag("--left", o->left, "at a knot, the limit from the left instead of the right");
  command->add_option("--json", o->json, "write JSON")->option_text("FILE|-");
  add_decimals(*command, o->decimals);
  command->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace patchproof::cli
