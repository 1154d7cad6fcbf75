// SPDX-License-Identifier: Apache-2.0
// patchproof_peers: CAD kernels against the exact truth, on the corpus of `patchproof validate`. One table for each
// quantity; each cell is a worst error in units of the last place (compare.h).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "validation/peers/compare.h"

namespace {

using namespace patchproof;
using namespace patchproof::peers;

struct Options {
  validation::CorpusOptions corpus;
  unsigned seconds = 60;
  std::vector<std::string> plugins, only;
  std::string json;
};

std::string cell(const Row& r, std::size_t quantity) {
  const CaseScores& s = r.scores;
  const Score& score = s.by_quantity[quantity];
  std::string text;
  if (score.vectors > 0)
    text = std::isinf(score.worst) ? "not finite"
           : score.worst < 1e4     ? fmt::format("{:.3g}", score.worst)
                                   : fmt::format("{:.1e}", score.worst);
  const auto note = [&](int count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  note(s.refused, "refused");
  note(s.crashed, "crashed");
  note(s.timed_out, "timed out");
  return text.empty() ? "-" : text;
}

// The cells of one way to ask, from the first group to the last.
struct Column {
  std::string peer, variant;
  std::vector<std::string> cells;
  int alike = 0;  // further variants of the peer with the same cells
};

std::vector<Column> columns(const std::vector<Row>& rows, Arrangement arrangement, std::size_t quantity) {
  std::vector<Column> all;
  std::vector<bool> offered;
  for (const Row& r : rows) {
    if (r.arrangement != arrangement) continue;
    if (all.empty() || all.back().peer != r.peer || all.back().variant != r.variant) {
      all.push_back({r.peer, r.variant, {}});
      offered.push_back(false);
    }
    all.back().cells.push_back(cell(r, quantity));
    offered.back() = offered.back() || r.scores.by_quantity[quantity].offered > 0;
  }
  std::vector<Column> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!offered[i]) continue;
    const auto twin = std::find_if(out.begin(), out.end(),
                                   [&](const Column& c) { return c.peer == all[i].peer && c.cells == all[i].cells; });
    if (twin == out.end())
      out.push_back(all[i]);
    else
      ++twin->alike;
  }
  return out;
}

// Rows: groups. Columns: peers with their variants that offer the quantity; variants with the same results share one.
std::string table(const std::vector<Row>& rows, Arrangement arrangement, std::size_t quantity) {
  const std::vector<Column> all = columns(rows, arrangement, quantity);
  if (all.empty()) return "";
  std::string text = fmt::format("\n{}, {}: worst error in ulp\n\n| group |", to_string(arrangement),
                                 to_string(kAllQuantities[quantity]));
  for (const Column& c : all)
    text += fmt::format(" {} {}{} |", c.peer, c.variant, c.alike > 0 ? fmt::format(" and {} alike", c.alike) : "");
  text += "\n|---|";
  for (std::size_t i = 0; i < all.size(); ++i) text += "---|";
  for (std::size_t g = 0; g < validation::groups().size(); ++g) {
    text += fmt::format("\n| {} |", validation::groups()[g].name);
    for (const Column& c : all) text += " " + c.cells[g] + " |";
  }
  return text + "\n";
}

nlohmann::ordered_json as_json(const Row& r) {
  nlohmann::ordered_json json{{"peer", r.peer},
                              {"variant", r.variant},
                              {"group", r.group},
                              {"arrangement", to_string(r.arrangement)},
                              {"cases", r.cases},
                              {"refused", r.scores.refused},
                              {"crashed", r.scores.crashed},
                              {"timed_out", r.scores.timed_out}};
  for (std::size_t q = 0; q < kAllQuantities.size(); ++q) {
    const Score& s = r.scores.by_quantity[q];
    if (s.offered == 0) continue;
    nlohmann::ordered_json& entry = json[to_string(kAllQuantities[q])];
    entry = {{"vectors", s.vectors}, {"cases", s.offered}, {"worst_ulp", s.worst}};
    if (std::isinf(s.worst)) entry["worst_ulp"] = "not finite";
  }
  return json;
}

int run(const Options& o) {
  for (const std::string& path : o.plugins)
    if (const Result<const Peer*> loaded = load_peer(path); !loaded) {
      fmt::print(stderr, "patchproof_peers: {}\n", loaded.error().text());
      return 2;
    }
  const Known known{validation::with_truth(validation::surface_cases(o.corpus)),
                    validation::with_truth(validation::curve_cases(o.corpus))};
  std::vector<Row> rows;
  nlohmann::ordered_json json{{"tool", "patchproof_peers"}, {"seed", o.corpus.seed}, {"count", o.corpus.count}};
  json["rows"] = nlohmann::ordered_json::array();
  for (const Peer* peer : registered_peers()) {
    const auto chosen = [&](const std::string& word) { return peer->name().find(word) != std::string::npos; };
    if (!o.only.empty() && std::none_of(o.only.begin(), o.only.end(), chosen)) continue;
    for (Row& r : compare(*peer, known, o.seconds)) {
      json["rows"].push_back(as_json(r));
      rows.push_back(std::move(r));
    }
  }
  if (o.json != "-")
    for (const Arrangement a : {Arrangement::scattered, Arrangement::grid, Arrangement::curve})
      for (std::size_t q = 0; q < kAllQuantities.size(); ++q) fmt::print("{}", table(rows, a, q));
  if (o.json.empty()) return 0;
  std::FILE* file = o.json == "-" ? stdout : std::fopen(o.json.c_str(), "wb");
  const std::string text = json.dump(1) + "\n";
  if (!file || std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0) {
    fmt::print(stderr, "patchproof_peers: {} cannot be written\n", o.json);
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"patchproof_peers: the worst errors of CAD kernels, against exact values", "patchproof_peers"};
  app.add_option("--seed", o.corpus.seed, "another corpus [1]");
  app.add_option("--count", o.corpus.count, "random parameters of each case [12]")->check(CLI::Range(0, 100000));
  app.add_option("--seconds", o.seconds, "limit for one group of cases [60]")->check(CLI::Range(1, 86400));
  app.add_option("--only", o.only, "peers whose name contains this");
  app.add_option("--plugin", o.plugins, "shared objects with more peers (peer.h)");
  app.add_option("--json", o.json, "write JSON")->option_text("FILE|-");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  return run(o);
}
