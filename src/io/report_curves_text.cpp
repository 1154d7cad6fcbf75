// SPDX-License-Identifier: Apache-2.0
// Joins of curves as JSON and as a table.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "patchproof/spline/smoothness.h"
#include "report_curves.h"
#include "report_text.h"

namespace patchproof {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json bound(const Enclosure& e) { return {{"lower", number(e.lower)}, {"upper", number(e.upper)}}; }
Json bound(const std::optional<Enclosure>& e) { return e ? bound(*e) : Json(nullptr); }
Json order(int n) { return n == kOneFunction ? Json("one function") : Json(n); }

// On one line. File names need not be UTF-8; JSON must be.
std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json side(const CurveReport& r, const ReportedCurveSide& s) {
  const ReportedCurve& curve = r.curves[s.of.curve];
  return {{"curve", s.of.curve},
          {"name", curve.name},
          {"file", r.files[curve.file].path},
          {"end", to_string(s.of.end)},
          {"parameter", s.parameter}};
}

Json join_json(const CurveReport& r, const ReportedCurveJoin& j) {
  const CurveCertificate& c = j.certificate;
  Json exact, witness = Json::object(), reasons = Json::object();
  for (const auto& [name, cls] : {std::pair<const char*, const CurveClass*>{"C0", &c.c0},
                                  {"C1", &c.c1},
                                  {"C2", &c.c2},
                                  {"G1", &c.g1},
                                  {"G2", &c.g2}}) {
    exact[name] = to_string(cls->verdict);
    if (!cls->quantity.empty()) witness[name] = {{"quantity", cls->quantity}, {"values", cls->values}};
    if (!cls->reason.empty()) reasons[name] = cls->reason;
  }
  exact["order"] = order(c.order);
  exact["scaled_order"] = order(c.scaled_order);
  exact["ratio"] = c.ratio ? Json(*c.ratio) : Json(nullptr);
  Json out{{"id", j.id},
           {"a", side(r, j.a)},
           {"b", side(r, j.b)},
           {"point", j.point},
           {"class", class_name(c)},
           {"exact", exact},
           {"gap_squared", c.gap_squared},
           {"gap", bound(c.gap)},
           {"angle_degrees", bound(c.angle)},
           {"speed_ratio", bound(c.speed_ratio)},
           {"first_difference", bound(c.first_difference)},
           {"second_difference", bound(c.second_difference)},
           {"second_angle_degrees", bound(c.second_angle)},
           {"curvature", {bound(c.curvature[0]), bound(c.curvature[1])}},
           {"curvature_difference", bound(c.curvature_difference)},
           {"first_derivative", c.first},
           {"within", j.within.empty() ? Json(nullptr) : Json(j.within)},
           {"verdict", to_string(j.judgement.outcome)},
           {"witness", witness},
           {"reasons", reasons},
           {"reason", j.judgement.reason}};
  if (j.edge_class) out["edge_class"] = to_string(*j.edge_class);
  return out;
}

int rank(const ReportedCurveJoin& j) {
  return j.judgement.outcome == Outcome::fail ? 2 : j.judgement.outcome == Outcome::undecided ? 1 : 0;
}

bool worse(const ReportedCurveJoin* x, const ReportedCurveJoin* y) {
  if (rank(*x) != rank(*y)) return rank(*x) > rank(*y);
  const CurveCertificate &a = x->certificate, &b = y->certificate;
  const double angle_a = a.angle ? a.angle->upper : 181, angle_b = b.angle ? b.angle->upper : 181;
  if (angle_a != angle_b) return angle_a > angle_b;
  if (a.gap.upper != b.gap.upper) return a.gap.upper > b.gap.upper;
  return x->id < y->id;
}

// The paths of the files, without folders where that tells them apart.
std::vector<std::string> file_names(const CurveReport& r) {
  std::vector<std::string> names, paths;
  for (const ReportedFile& f : r.files) {
    paths.push_back(f.path);
    names.push_back(f.path.substr(f.path.find_last_of('/') + 1));
  }
  const bool distinct = std::set<std::string>(names.begin(), names.end()).size() == names.size();
  return distinct ? names : paths;
}

// "wing.brep: edge 1.end"; the file only when there are several.
std::string end_text(const CurveReport& r, const std::vector<std::string>& files, const EndOfCurve& of) {
  const ReportedCurve& curve = r.curves[of.curve];
  const std::string file = r.files.size() > 1 ? escaped(files[curve.file]) + ": " : "";
  const std::string name = curve.name.empty() ? "curve " + std::to_string(of.curve) : escaped(curve.name);
  return file + name + "." + to_string(of.end);
}

std::string bound_text(const std::optional<Enclosure>& e) {
  return e ? patchproof::bound_text(e->lower, e->upper) : "none";
}

bool is_asked(const Report& r) {
  if (!r.patch_names.empty() || r.profile) return false;  // a profile asks nothing of curves
  return r.request.require || r.request.gap_tolerance || r.request.angle_tolerance || r.curves->curvature_tolerance;
}

void write_rows(std::ostream& out, const Report& r, const TableStyle& style) {
  const std::vector<std::string> files = file_names(*r.curves);
  std::vector<const ReportedCurveJoin*> joins;
  for (const ReportedCurveJoin& j : r.curves->joins) joins.push_back(&j);
  std::sort(joins.begin(), joins.end(), worse);
  std::vector<std::vector<std::string>> rows{
      {"join", "a", "b", "exact class", "within", "gap", "tangent angle/deg", "curvature difference", "where"}};
  for (const ReportedCurveJoin* j : joins) {
    const CurveCertificate& c = j->certificate;
    std::string name = class_name(c);
    if (c.ratio && *c.ratio != "1" && c.ratio->size() <= 12) name += " ×" + *c.ratio;
    if (j->edge_class) name += std::string(", ") + to_string(*j->edge_class);
    rows.push_back({std::to_string(j->id), end_text(*r.curves, files, j->a.of), end_text(*r.curves, files, j->b.of),
                    name, j->within, bound_text(c.gap), bound_text(c.angle), bound_text(c.curvature_difference),
                    fmt::format("({:.6g}, {:.6g}, {:.6g})", j->point[0], j->point[1], j->point[2])});
  }
  const bool asked = is_asked(r), within = !r.curves->joins.front().within.empty();
  std::vector<long> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int mark = i == 0 || !asked ? -1 : rank(*joins[i - 1]);
    std::string line = mark == 2 ? "✗ " : mark == 1 ? "? " : mark == 0 ? "✓ " : "  ";
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      if (k != 4 || within) line += rows[i][k] + std::string(widths[k] - width_of(rows[i][k]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    const char* color = !style.color ? "" : mark == 2 ? "\x1b[31m" : i == 0 ? "\x1b[1m" : "";
    out << color << line << (*color ? "\x1b[0m" : "") << '\n';
  }
}

}  // namespace

std::string curves_json(const Report& report) {
  const CurveReport& r = *report.curves;
  Json files = Json::array();
  for (const ReportedFile& f : r.files)
    files.push_back({{"file", f.path},
                     {"sha256", f.sha256},
                     {"format", f.format},
                     {"decimals", f.decimals == Decimals::exact ? "exact" : "binary64"}});
  int count[3] = {0, 0, 0};
  double gap = 0, angle = 0;
  std::string out = "\"curve_files\":" + text_of(files) + ",\n\"curve_joins\":[";
  for (std::size_t i = 0; i < r.joins.size(); ++i) {
    out += (i ? ",\n" : "\n") + text_of(join_json(r, r.joins[i]));
    ++count[static_cast<int>(r.joins[i].judgement.outcome)];
    gap = std::max(gap, r.joins[i].certificate.gap.upper);
    if (const auto& a = r.joins[i].certificate.angle) angle = std::max(angle, a->upper);
  }
  out += "],\n\"free_curve_ends\":[";
  for (std::size_t i = 0; i < r.free.size(); ++i)
    out += (i ? ",\n" : "\n") + text_of({{"curve", r.free[i].curve},
                                         {"name", r.curves[r.free[i].curve].name},
                                         {"file", r.files[r.curves[r.free[i].curve].file].path},
                                         {"end", to_string(r.free[i].end)}});
  const Json summary{{"curves", r.curves.size()},
                     {"match", r.match_length},
                     {"crowded", r.crowded},
                     {"curvature", r.curvature_tolerance ? Json(*r.curvature_tolerance) : Json(nullptr)},
                     {"pass", count[0]},
                     {"fail", count[1]},
                     {"undecided", count[2]},
                     {"worst_gap", number(gap)},
                     {"worst_angle_degrees", number(angle)}};
  return out + "],\n\"curve_summary\":" + text_of(summary) + ",\n";
}

void write_curves(std::ostream& out, const Report& report, const TableStyle& style) {
  const CurveReport& r = *report.curves;
  if (!style.quiet && !r.joins.empty()) {
    out << '\n';
    write_rows(out, report, style);
    out << '\n';
  }
  const std::vector<std::string> files = file_names(r);
  std::map<std::string, int> classes;
  int count[3] = {0, 0, 0};
  for (const ReportedCurveJoin& j : r.joins) {
    ++classes[class_name(j.certificate)];
    ++count[static_cast<int>(j.judgement.outcome)];
  }
  std::string listed;
  for (const auto& [name, n] : classes) listed += fmt::format("{}{} {}", listed.empty() ? ": " : "; ", n, name);
  out << fmt::format("curves   {}, {} joins of their ends{}\n", r.curves.size(), r.joins.size(), listed);
  if (r.crowded)
    out << fmt::format("crowded  more than {} ends meet in a place: further pairs are left out\n", kMostPartners);
  if (!r.free.empty()) {
    out << fmt::format("free     {} ends of curves without a partner within {:.3g}:", r.free.size(), r.match_length);
    constexpr std::size_t kShown = 8;
    for (std::size_t i = 0; i < std::min(kShown, r.free.size()); ++i)
      out << (i ? ", " : " ") << end_text(r, files, r.free[i]);
    out << (r.free.size() > kShown ? " …\n" : "\n");
  }
  if (is_asked(report))
    out << fmt::format("verdict  of curves: {} pass, {} fail, {} undecided; free ends are not judged\n", count[0],
                       count[1], count[2]);
}

}  // namespace patchproof
