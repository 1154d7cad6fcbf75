// SPDX-License-Identifier: Apache-2.0
#include "validation/verdicts/table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "validation/verdicts/occt.h"

namespace patchproof::verdicts {
namespace {

using Certificates = std::vector<Certificate>;

template <class Word>
std::string counted(const Certificates& all, Word word) {
  std::map<std::string, int> tally;
  for (const Certificate& c : all) ++tally[word(c)];
  if (tally.size() == 1 && all.size() == 1) return tally.begin()->first;
  std::string text;
  for (const auto& [name, times] : tally) text += fmt::format("{}{} ×{}", text.empty() ? "" : "; ", name, times);
  return text;
}

// Curvature is decided by C2 alone, or by there being no common tangent plane.
bool leaves_g2_open(const Certificate& c) { return c.g1.verdict == Verdict::proven && c.c2.verdict != Verdict::proven; }

std::string verdict_in_words(const Row& row) {
  std::string words = counted(row.ours.exact, classes_in_words);
  if (row.ours.one_polynomial > 0) {
    const int count = row.ours.one_polynomial;
    words += count == 1 && row.about.shapes.size() == 1 ? "; C∞ proven" : fmt::format("; C∞ proven ×{}", count);
  }
  if (std::any_of(row.ours.exact.begin(), row.ours.exact.end(), leaves_g2_open)) words += "; G2 not decided";
  return words;
}

// Six digits, rounded away from the other end.
std::string outward(double x, bool up) {
  std::string text = fmt::format("{:.6g}", x);
  const double rounded = std::stod(text);
  if (!std::isfinite(x) || (up ? x <= rounded : rounded <= x)) return text;
  const double unit = std::pow(10, std::floor(std::log10(std::fabs(x))) - 5);
  return fmt::format("{:.6g}", up ? rounded + unit : rounded - unit);
}

std::string range(const std::array<double, 2>& r) {
  const std::string lower = outward(r[0], false), upper = outward(r[1], true);
  return lower == upper ? lower : fmt::format("[{}, {}]", lower, upper);
}

// What the bounds of the shape in doubles are shown as: the CAD shape's where there is one.
const Certificates& shown(const Row& row) { return row.cad ? *row.cad : row.ours.rounded; }

std::string marked(const std::string& answer, bool wrong) { return wrong ? "**" + answer + "**" : answer; }

std::string breplib(const Row& row) {
  if (!row.occt) return "";
  const Answers& a = *row.occt;
  const std::string both =
      a.continuity_of_faces + (a.encoded == a.continuity_of_faces ? "" : " (on the edge: " + a.encoded + ")");
  return marked(both, row.about.wrong[0] && row.about.recorded == row.occt);
}

std::string local_analysis(const Row& row) {
  return row.occt ? marked(row.occt->local_analysis, row.about.wrong[1] && row.about.recorded == row.occt) : "";
}

std::size_t width(const std::string& text) {  // code points
  return std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
}

nlohmann::json json_of(const Certificates& all) {
  const auto verdicts = [&](ExactClass Certificate::*which) {
    std::map<std::string, int> tally;
    for (const Certificate& c : all) ++tally[to_string((c.*which).verdict)];
    return tally;
  };
  const auto bound = [&](EnclosedMaximum Certificate::*what) {
    const auto [lower, upper] = largest(all, what);
    return nlohmann::json{{"lower", lower}, {"upper", std::isfinite(upper) ? nlohmann::json(upper) : nlohmann::json()}};
  };
  std::map<std::string, int> rungs, orientations;
  for (const Certificate& c : all) {
    ++rungs[c.rung];
    ++orientations[to_string(c.orientation)];
  }
  return {{"C0", verdicts(&Certificate::c0)}, {"C1", verdicts(&Certificate::c1)},
          {"C2", verdicts(&Certificate::c2)}, {"G1", verdicts(&Certificate::g1)},
          {"orientation", orientations},      {"rung", rungs},
          {"gap", bound(&Certificate::gap)},  {"angle_degrees", bound(&Certificate::angle)}};
}

nlohmann::json json_of(const Answers& a) {
  return {{"ContinuityOfFaces", a.continuity_of_faces},
          {"EncodeRegularity", a.encoded},
          {"LocalAnalysis", a.local_analysis}};
}

}  // namespace

std::array<double, 2> largest(const Certificates& all, EnclosedMaximum Certificate::*what) {
  std::array<double, 2> out{0, 0};
  for (const Certificate& c : all) {
    out[0] = std::max(out[0], (c.*what).lower);
    out[1] = std::max(out[1], (c.*what).upper);
  }
  return out;
}

Row examine(Case c) {
  Row row;
  row.about = std::move(c);
  row.ours = certify_case(row.about);
  row.complaints = complaints(row.about, row.ours);
  const auto version = occt_version();
  if (!version) return row;
  if (Result<Answers> answers = ask_occt(row.about))
    row.occt = std::move(*answers);
  else
    row.notes.push_back(answers.error().text());
  if (row.occt && row.about.recorded && version->rfind("7.6", 0) == 0 && !(*row.occt == *row.about.recorded))
    row.notes.push_back("Open CASCADE answers otherwise than recorded in cases.json");
  if (Result<Certificates> cad = certify_as_cad(row.about)) {
    row.cad = std::move(*cad);
    for (std::string& text : disagreements(row.ours.rounded, *row.cad)) row.complaints.push_back(std::move(text));
  } else {
    row.complaints.push_back(cad.error().text());
  }
  return row;
}

void write_table(std::ostream& out, const std::vector<Row>& rows) {
  const auto version = occt_version();
  std::vector<std::vector<std::string>> lines{{"case", "true state"}};
  if (version) {
    lines[0].push_back("Open CASCADE " + *version + ": BRepLib");
    lines[0].push_back("LocalAnalysis");
  }
  for (const char* title :
       {"patchproof: the exact shape", "its doubles: largest gap", "largest angle, degrees", "rung"})
    lines[0].push_back(title);
  for (const Row& row : rows) {
    std::vector<std::string> line{row.about.id, row.about.state};
    if (version) {
      line.push_back(breplib(row));
      line.push_back(local_analysis(row));
    }
    line.push_back(verdict_in_words(row));
    line.push_back(range(largest(shown(row), &Certificate::gap)));
    line.push_back(range(largest(shown(row), &Certificate::angle)));
    line.push_back(counted(row.ours.exact, [](const Certificate& c) { return c.rung; }));
    lines.push_back(std::move(line));
  }
  std::vector<std::size_t> widths(lines[0].size());
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i]));
  const auto print = [&](const std::vector<std::string>& line) {
    for (std::size_t i = 0; i < line.size(); ++i)
      out << "| " << line[i] << std::string(widths[i] - width(line[i]), ' ') << ' ';
    out << "|\n";
  };
  print(lines[0]);
  for (const std::size_t w : widths) out << '|' << std::string(w + 2, '-');
  out << "|\n";
  for (std::size_t i = 1; i < lines.size(); ++i) print(lines[i]);
  for (const Row& row : rows)
    if (!row.about.note.empty()) out << "\n" << row.about.id << ": " << row.about.note << '\n';
  for (const Row& row : rows) {
    for (const std::string& text : row.notes) out << row.about.id << ": " << text << '\n';
    for (const std::string& text : row.complaints) out << row.about.id << ": WRONG: " << text << '\n';
  }
}

void write_json(std::ostream& out, const std::vector<Row>& rows, const CaseOptions& options) {
  nlohmann::json document{{"seed", options.seed}, {"count", options.count}};
  if (const auto version = occt_version()) document["open_cascade"] = *version;
  for (const Row& row : rows) {
    nlohmann::json patchproof{{"exact", json_of(row.ours.exact)},
                              {"rounded", json_of(row.ours.rounded)},
                              {"one_polynomial", row.ours.one_polynomial},
                              {"complaints", row.complaints}};
    if (row.cad) patchproof["as_cad_file"] = json_of(*row.cad);
    nlohmann::json line{{"id", row.about.id},
                        {"title", row.about.title},
                        {"state", row.about.state},
                        {"shapes", row.about.shapes.size()},
                        {"true", row.about.truth.classes},
                        {"patchproof", std::move(patchproof)},
                        {"note", row.about.note},
                        {"notes", row.notes}};
    if (row.occt) line["open_cascade"] = json_of(*row.occt);
    if (row.about.recorded) line["open_cascade_recorded"] = json_of(*row.about.recorded);
    document["cases"].push_back(std::move(line));
  }
  out << document.dump(2) << '\n';
}

}  // namespace patchproof::verdicts
