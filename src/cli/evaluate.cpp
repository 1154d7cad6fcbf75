// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "patchproof/io/read.h"
#include "patchproof/patch/rational_patch.h"

namespace patchproof::cli {
namespace {

struct Options {
  std::string model, at, scalar = "rational", json;
  int patch = 0, derivatives = 0;
  bool left = false;
  Decimals decimals = Decimals::exact;
};

// All derivatives of total order up to the one asked, as texts.
struct Evaluation {
  struct Row {
    int k, l;  // ∂^(k+l) / ∂u^k ∂v^l
    std::array<std::string, 3> value;
  };
  std::vector<Row> rows;
};

template <Ring T>
Evaluation texts(const PartialDerivatives<T, 3>& derivatives, int order) {
  Evaluation out;
  for (int total = 0; total <= order; ++total)
    for (int l = 0; l <= total; ++l) {
      const Vec<T, 3>& x = derivatives.at(total - l, l);
      out.rows.push_back({total - l, l, {to_text(x[0]), to_text(x[1]), to_text(x[2])}});
    }
  return out;
}

template <ExactField T>
Result<Evaluation> evaluate_model(const Model<T>& model, const Options& o) {
  if (o.patch < 0 || o.patch >= static_cast<int>(model.patches.size()))
    return Error{ErrorCode::bad_reference, "--patch",
                 fmt::format("the model has patches 0 to {}", model.patches.size() - 1), std::to_string(o.patch)};
  const BsplinePatch<T, 4>& surface = model.patches[o.patch].surface;
  const std::size_t comma = o.at.find(',');
  if (comma == std::string::npos) return Error{ErrorCode::usage, "--at", "two parameters U,V are needed", o.at};
  const Result<T> u = parse_scalar<T>(o.at.substr(0, comma)), v = parse_scalar<T>(o.at.substr(comma + 1));
  for (const Result<T>* x : {&u, &v})
    if (!*x) return Error{x->error().code, "--at", x->error().message, x->error().values};
  for (const auto& [name, x, d] : {std::tuple{"u", *u, Direction::u}, std::tuple{"v", *v, Direction::v}})
    if (!surface.knots(d).in_domain(x))
      return Error{ErrorCode::usage, "--at",
                   fmt::format("{} lies outside the domain [{}, {}]", name, to_text(surface.knots(d).domain_begin()),
                               to_text(surface.knots(d).domain_end())),
                   to_text(x)};
  const int k = o.derivatives;
  const Side side = o.left ? Side::left : Side::right;
  if (o.scalar == "rational") return texts(rational_derivatives(surface, *u, *v, k, k, side, side), k);
  const int span_u = surface.knots(Direction::u).find_span(*u, side),
            span_v = surface.knots(Direction::v).find_span(*v, side);
  if (o.scalar == "interval") {
    const RoundingGuard guard;
    return texts(rational_derivatives(partial_derivatives_in_span<Interval>(
                     surface, span_u, span_v, embed<Interval>(*u), embed<Interval>(*v), k, k)),
                 k);
  }
  return texts(rational_derivatives(partial_derivatives_in_span<double>(surface, span_u, span_v, nearest_double(*u),
                                                                        nearest_double(*v), k, k)),
               k);
}

int run(const Options& o) {
  const Result<ModelFile> file = read_model(o.model, o.decimals);
  if (!file) return report_error(file.error());
  const auto evaluate = [&](const auto& model) -> Result<Evaluation> {
    try {
      return evaluate_model(model, o);
    } catch (const contract_error& e) {  // another root than the model's, or doubles that overflow
      return Error{ErrorCode::usage, "evaluate", e.what(), o.at};
    }
  };
  const Result<Evaluation> result = std::visit(evaluate, file->model);
  if (!result) return report_error(result.error());
  std::string text;
  if (!o.json.empty()) {
    nlohmann::ordered_json json{{"tool", "patchproof"}, {"version", PATCHPROOF_VERSION},
                                {"file", o.model},      {"sha256", file->sha256},
                                {"patch", o.patch},     {"at", o.at},
                                {"scalar", o.scalar}};
    for (const auto& row : result->rows) json["values"].push_back({{"du", row.k}, {"dv", row.l}, {"value", row.value}});
    text = json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  } else {
    for (const auto& row : result->rows) {
      const std::string name = row.k + row.l == 0 ? "S" : "S_" + std::string(row.k, 'u') + std::string(row.l, 'v');
      text += fmt::format("{:<8}{}  {}  {}\n", name, row.value[0], row.value[1], row.value[2]);
    }
  }
  return write_output(o.json.empty() ? "-" : o.json, text);
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("evaluate", "points and derivatives of one patch, exactly or enclosed");
  command->add_option("model", o->model, "file to read")->required()->type_name("MODEL");
  command->add_option("--patch", o->patch, "which patch, from 0 [0]")->option_text("I");
  command->add_option("--at", o->at, "parameters in the patch's own domain, e.g. 1/3,0.25")
      ->required()
      ->option_text("U,V");
  command->add_option("--derivatives", o->derivatives, "all partial derivatives up to this order [0]")
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
