// SPDX-License-Identifier: Apache-2.0
// patchproof_verdicts: shapes about which Open CASCADE is wrong, and controls about which it is not; its answers beside
// ours. Exit 1 when patchproof is wrong, 2 when the cases cannot be read.
#include <algorithm>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "validation/verdicts/table.h"

int main(int argc, char** argv) {
  using namespace patchproof;
  using namespace patchproof::verdicts;
  CaseOptions options;
  std::string json, cases_path = PATCHPROOF_SOURCE_DIR "/validation/verdicts/cases.json";
  std::vector<std::string> only;
  CLI::App app("Joins that a CAD kernel misjudges: the truth, its answer, and patchproof's.");
  app.add_option("--seed", options.seed, "Of the random shapes")->capture_default_str();
  app.add_option("--count", options.count, "Of random shapes in each family")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--only", only, "Names of cases");
  app.add_option("--json", json, "File for the results as JSON (- is the standard output, without the table)");
  app.add_option("--cases", cases_path, "The cases")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }

  Result<std::vector<Case>> cases = read_cases(cases_path, options);
  if (!cases) return std::cerr << "patchproof_verdicts: " << cases.error().text() << '\n', 2;
  std::vector<Row> rows;
  bool wrong = false;
  for (Case& c : *cases) {
    if (!only.empty() && std::find(only.begin(), only.end(), c.id) == only.end()) continue;
    rows.push_back(examine(std::move(c)));
    wrong = wrong || !rows.back().complaints.empty();
  }
  if (rows.empty()) return std::cerr << "patchproof_verdicts: no case has such a name\n", 2;
  if (json != "-") {
    write_table(std::cout, rows);
    std::cout << "\nRandom shapes: seed " << options.seed << ", " << options.count << " in each family.\n";
  }
  if (json == "-") {
    write_json(std::cout, rows, options);
  } else if (!json.empty()) {
    std::ofstream file(json);
    write_json(file, rows, options);
    if (!file.flush()) return std::cerr << "patchproof_verdicts: " << json << ": cannot be written\n", 2;
  }
  return wrong ? 1 : 0;
}
