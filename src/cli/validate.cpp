// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "validation/check/check.h"

namespace patchproof::cli {
namespace {

using validation::Tallies;
using validation::Tally;
using validation::TallyKey;

struct Options {
  validation::CheckOptions check;
  std::string instructions, json, junit;
};

// A bound that no error comes within this of says little.
constexpr double kTight = 1e-3;

// The others only agree or do not.
bool has_errors(const std::string& kernel) { return kernel != "same bits" && !kernel.starts_with("decide"); }

bool is_ordinary(const std::string& group) { return group == "random" || group == "bezier"; }

// One kernel on one instruction set: all groups together, and the ordinary ones.
struct Line {
  Tally all, ordinary;
};

std::vector<std::pair<TallyKey, Line>> lines(const Tallies& tallies) {
  std::vector<std::pair<TallyKey, Line>> out;
  for (const std::string& kernel : validation::kernel_names()) {
    std::map<InstructionSet, Line> sets;
    for (const auto& [key, tally] : tallies) {
      if (key.kernel != kernel) continue;
      merge(sets[key.set].all, tally);
      if (is_ordinary(key.group)) merge(sets[key.set].ordinary, tally);
    }
    for (const auto& [set, line] : sets) out.push_back({{kernel, set, ""}, line});
  }
  return out;
}

long violations(const Tallies& tallies) {
  long sum = 0;
  for (const auto& [key, tally] : tallies) sum += tally.violations;
  return sum;
}

std::string short_number(double x) {
  constexpr double kNoDigit = 1e16;  // ulp: not even the first one is right
  return std::isinf(x)   ? "not finite"
         : x >= kNoDigit ? "no digit"
         : x == 0        ? "0"
         : x < 1e4       ? fmt::format("{:.3g}", x)
                         : fmt::format("{:.0e}", x);
}

std::string table(const Tallies& tallies, const Options& o) {
  std::string text = fmt::format("{:<12} {:<9} {:>9}  {:>12}  {:>12}  {:>11}  {:>9}  {}\n", "kernel", "set", "numbers",
                                 "worst ulp", "everywhere", "error/bound", "unbounded", "violations");
  for (const auto& [key, line] : lines(tallies)) {
    const auto error = [&, &kernel = key.kernel](double x) { return has_errors(kernel) ? short_number(x) : "-"; };
    text += fmt::format("{:<12} {:<9} {:>9}  {:>12}  {:>12}  {:>11}  {:>9}  {}\n", key.kernel, to_string(key.set),
                        line.all.numbers, error(line.ordinary.worst_vector_ulp), error(line.all.worst_vector_ulp),
                        error(line.all.worst_ratio), line.all.without_bound, line.all.violations);
    if (has_errors(key.kernel) && line.all.worst_ratio < kTight)
      text += "             its bound is never reached within 1000\n";
  }
  for (const auto& [key, tally] : tallies)
    if (tally.violations > 0)
      text += fmt::format("violated: {} on {}, {} times in {}, first: {}\n", key.kernel, to_string(key.set),
                          tally.violations, key.group, tally.violation);
  text += fmt::format(
      "worst ulp: in units of the last place of the vector's largest coordinate, in the groups random and bezier;\n"
      "everywhere: in all groups. unbounded: numbers whose a-priori bound is infinite. Seed {}, count {}: {}\n",
      o.check.corpus.seed, o.check.corpus.count,
      violations(tallies) == 0 ? "every bound holds" : fmt::format("{} VIOLATIONS", violations(tallies)));
  return text;
}

// Finite numbers as they are; JSON has no others.
nlohmann::ordered_json json_number(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json("not finite");
}

nlohmann::ordered_json as_json(const Tally& t) {
  nlohmann::ordered_json json{{"numbers", t.numbers},
                              {"violations", t.violations},
                              {"without_bound", t.without_bound},
                              {"worst_ulp", json_number(t.worst_ulp)},
                              {"worst_vector_ulp", json_number(t.worst_vector_ulp)},
                              {"worst_error_over_bound", json_number(t.worst_ratio)}};
  if (!t.worst_place.empty()) json["worst_at"] = t.worst_place;
  if (!t.violation.empty()) json["first_violation"] = t.violation;
  return json;
}

std::string json_text(const Tallies& tallies, const Options& o) {
  nlohmann::ordered_json json{
      {"tool", "patchproof"},  {"version", PATCHPROOF_VERSION}, {"schema", 1},
      {"command", "validate"}, {"seed", o.check.corpus.seed},   {"count", o.check.corpus.count}};
  if (!o.check.corpus.group.empty()) json["group"] = o.check.corpus.group;
  for (const InstructionSet set : o.check.sets) json["instruction_sets"].push_back(to_string(set));
  for (const auto& [key, line] : lines(tallies)) {
    nlohmann::ordered_json entry{{"kernel", key.kernel}, {"instruction_set", to_string(key.set)}};
    entry.update(as_json(line.all));
    if (has_errors(key.kernel)) entry["bound_reached_within_1000"] = line.all.worst_ratio >= kTight;
    for (const auto& [each, tally] : tallies)
      if (each.kernel == key.kernel && each.set == key.set) entry["groups"][each.group] = as_json(tally);
    json["kernels"].push_back(entry);
  }
  json["violations"] = violations(tallies);
  json["verdict"] = violations(tallies) == 0 ? "pass" : "fail";
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

// One test case for each kernel, instruction set and group.
std::string junit_text(const Tallies& tallies) {
  std::size_t failures = 0;
  std::string cases;
  for (const auto& [key, t] : tallies) {
    cases += fmt::format("  <testcase classname=\"validate.{}.{}\" name=\"{}\"", xml(key.kernel), to_string(key.set),
                         key.group);
    if (t.violations == 0) {
      cases += "/>\n";
      continue;
    }
    ++failures;
    cases += fmt::format(">\n    <failure message=\"{} of {} numbers\">{}</failure>\n  </testcase>\n", t.violations,
                         t.numbers, xml(t.violation));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"patchproof validate\" tests=\"{}\" "
      "failures=\"{}\">\n{}</testsuite>\n",
      tallies.size(), failures, cases);
}

int run(Options o) {
  if (!o.instructions.empty())
    std::erase_if(o.check.sets, [&](InstructionSet set) { return o.instructions != to_string(set); });
  if (o.check.sets.empty()) {
    std::string names;
    for (const InstructionSet set : available_instruction_sets()) names += std::string(" ") + to_string(set);
    return report_error(
        {ErrorCode::usage, "--instructions", "this machine has no such instruction set, but" + names, o.instructions});
  }
  if (o.json == "-" && o.junit == "-")
    return report_error({ErrorCode::usage, "--junit", "only one report can go to standard output", "-"});
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "patchproof: computing exact values, about half a minute\n");
  const Tallies tallies = check_all(o.check);
  int failed = 0;
  if (!o.json.empty()) failed = write_output(o.json, json_text(tallies, o));
  if (!failed && !o.junit.empty()) failed = write_output(o.junit, junit_text(tallies));
  if (!failed && o.json != "-" && o.junit != "-") failed = write_output("-", table(tallies, o));
  return failed ? failed : violations(tallies) == 0 ? kProven : kRefuted;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  const auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("validate", "hold every kernel on every instruction set against exact values");
  command->add_option("--seed", o->check.corpus.seed, "another corpus of surfaces and curves [1]")->option_text("N");
  command->add_option("--count", o->check.corpus.count, "random parameters of each, besides the special ones [12]")
      ->check(CLI::Range(0, 1'000'000))
      ->option_text("N");
  std::vector<std::string> groups;
  for (const validation::Group& g : validation::groups()) groups.push_back(g.name);
  command->add_option("--group", o->check.corpus.group, "only this group of surfaces and curves")
      ->check(CLI::IsMember(groups))
      ->option_text("NAME");
  command->add_option("--instructions", o->instructions, "only this instruction set")->option_text("NAME");
  command->add_option("--json", o->json, "write JSON")->option_text("FILE|-");
  command->add_option("--junit", o->junit, "write JUnit's XML")->option_text("FILE|-");
  // A kernel that lies must be noticed: for tests.
  command->add_option("--break", o->check.broken_kernel)->check(CLI::IsMember(validation::kernel_names()))->group("");
  command->add_option("--break-by", o->check.broken_by)->check(CLI::Range(0, 1'000'000))->group("");
  command->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace patchproof::cli
