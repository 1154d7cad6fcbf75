// SPDX-License-Identifier: Apache-2.0
// The report for people: worst join first, then what was counted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <ostream>

#include "patchproof/io/report.h"
#include "report_curves.h"
#include "report_profile.h"
#include "report_text.h"

namespace patchproof {
namespace {

// "C2", "C1", "G1 (ratio 3/2)", "C0 only", "no join": the strongest class that is proven.
std::string class_text(const Certificate& c) {
  const auto proven = [](const ExactClass& e) { return e.verdict == Verdict::proven; };
  if (!proven(c.c0)) return c.c0.verdict == Verdict::refuted ? "gap" : "undecided";
  const std::string tangent = proven(c.g1)                         ? ""
                              : c.g1.verdict == Verdict::undecided ? ", G1 undecided"
                              : c.angle.lower >= 180               ? ", cusp"
                                                                   : ", not G1";
  if (proven(c.c2)) return "C2" + tangent;
  if (proven(c.c1)) return "C1" + tangent;
  if (proven(c.g1)) return "G1";
  return c.angle.lower >= 180 ? "C0, cusp" : c.g1.verdict == Verdict::undecided ? "C0, G1 undecided" : "C0";
}

std::string bound_text(const EnclosedMaximum& m) { return patchproof::bound_text(m.lower, m.upper); }

// "wall.u_max", with the range where only a part of the edge joins: "wall.u_max[0, 0.5]".
std::string side_text(const Report& r, const ReportedSide& s, bool part) {
  const std::string name = escaped(r.patch_names[s.patch]);
  const std::string edge = (name.empty() ? std::to_string(s.patch) : name) + "." + s.edge;
  return part ? fmt::format("{}[{:.6g}, {:.6g}]", edge, std::min(s.begin, s.end), std::max(s.begin, s.end)) : edge;
}

// That of the angle, but of a gap that exceeds what is allowed.
std::string place_text(const Certificate& c, const Request& request) {
  const bool wide = request.gap_tolerance && c.gap.lower > *request.gap_tolerance;
  const Place& p = c.angle.upper > 0 && !wide ? c.angle.at : c.gap.at;
  if (c.angle.upper == 0 && c.gap.upper == 0) return "";
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.point[0], p.point[1], p.point[2]);
}

// Failing before undecided before passing; then the larger gap class, angle and gap.
bool worse(const ReportedJoin& x, const ReportedJoin& y) {
  const auto rank = [](const ReportedJoin& j) {
    return j.judgement.outcome == Outcome::fail ? 2 : j.judgement.outcome == Outcome::undecided ? 1 : 0;
  };
  if (rank(x) != rank(y)) return rank(x) > rank(y);
  const Certificate &a = x.certificate, &b = y.certificate;
  if (a.angle.upper != b.angle.upper) return a.angle.upper > b.angle.upper;
  if (a.gap.upper != b.gap.upper) return a.gap.upper > b.gap.upper;
  return x.id < y.id;
}

void write_rows(std::ostream& out, const Report& r, const TableStyle& style) {
  const bool asked = r.request.require || r.request.gap_tolerance || r.request.angle_tolerance;
  std::vector<std::array<std::string, 7>> rows{
      {"join", "a", "b", "exact class", "largest gap", "largest angle/deg", "where"}};
  std::vector<const ReportedJoin*> order;
  for (const ReportedJoin& j : r.joins) order.push_back(&j);
  std::sort(order.begin(), order.end(), [](const auto* x, const auto* y) { return worse(*x, *y); });
  for (const ReportedJoin* j : order) {
    const Certificate& c = j->certificate;
    const bool part = j->kind == JoinKind::t_junction;
    std::string cls = class_text(c);
    if (c.ratio && *c.ratio != "1" && c.ratio->size() <= 12) cls += " ×" + *c.ratio;
    if (j->edge_class) cls += std::string(", ") + to_string(*j->edge_class);
    rows.push_back({std::to_string(j->id), side_text(r, j->a, part),
                    side_text(r, j->b, part) + (j->reversed ? " ↔" : ""), cls, bound_text(c.gap),
                    bound_text(c.angle) + (c.angle.upper > 90 ? " (planes " + bound_text(c.plane_angle) + ")" : ""),
                    place_text(c, r.request)});
  }
  std::array<long, 7> widths{};
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max<long>(widths[k], width_of(row[k]));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string line;
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      line += rows[i][k] + std::string(k + 1 < rows[i].size() ? widths[k] - width_of(rows[i][k]) + 2 : 0, ' ');
    const char* mark = "  ";
    if (i > 0 && asked) {
      const Outcome o = order[i - 1]->judgement.outcome;
      mark = o == Outcome::fail ? "✗ " : o == Outcome::undecided ? "? " : "✓ ";
    }
    line = mark + line;
    line.erase(line.find_last_not_of(' ') + 1);
    const bool fail = i > 0 && order[i - 1]->judgement.outcome == Outcome::fail;
    out << (style.color && fail     ? "\x1b[31m"
            : style.color && i == 0 ? "\x1b[1m"
                                    : "")
        << line << (style.color && (fail || i == 0) ? "\x1b[0m" : "") << '\n';
  }
}

}  // namespace

void write_table(std::ostream& out, const Report& r, const TableStyle& style) {
  const auto heading = [&](const ReportedFile& f, std::size_t count, const char* what) {
    out << fmt::format("{}: {}, {} {}, decimals {}, sha256 {}…\n", f.path, f.format, count, what,
                       f.decimals == Decimals::exact ? "exact" : "binary64", f.sha256.substr(0, 16));
  };
  const bool only_curves = r.curves && r.patch_names.empty() && !(r.cad && !r.cad->left_out.empty());
  if (!only_curves) heading({r.file, r.format, r.sha256, r.decimals}, r.patch_names.size(), "patches");
  for (std::size_t i = 0; only_curves && i < r.curves->files.size(); ++i) {
    const auto& curves = r.curves->curves;
    const auto count = std::count_if(curves.begin(), curves.end(),
                                     [&](const ReportedCurve& c) { return c.file == static_cast<int>(i); });
    heading(r.curves->files[i], count, count == 1 ? "curve" : "curves");
  }
  for (const std::string& note : r.notes) out << "note: " << escaped(note) << '\n';
  if (r.cad)
    for (const ReportedFace& face : r.cad->left_out)
      out << "left out: " << escaped(named("face", face.label)) << ": " << escaped(face.reason) << '\n';
  if (!style.quiet && !r.joins.empty()) {
    out << '\n';
    write_rows(out, r, style);
    out << '\n';
  }
  std::map<std::string, int> classes, kinds, edges;
  EnclosedMaximum gap, angle;
  int undecided = 0;
  for (const ReportedJoin& j : r.joins) {
    const Certificate& c = j.certificate;
    ++classes[class_text(c)];
    ++kinds[to_string(j.kind)];
    if (j.edge_class) ++edges[to_string(*j.edge_class)];
    gap.lower = std::max(gap.lower, c.gap.lower), gap.upper = std::max(gap.upper, c.gap.upper);
    angle.lower = std::max(angle.lower, c.angle.lower), angle.upper = std::max(angle.upper, c.angle.upper);
    undecided += j.judgement.outcome == Outcome::undecided;
  }
  const auto listed = [](const std::map<std::string, int>& counts) {
    std::string text;
    for (const auto& [name, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
    return text;
  };
  if (r.curves) write_curves(out, r, style);
  if (!only_curves) out << fmt::format("{} joins{}{}\n", r.joins.size(), r.joins.empty() ? "" : ": ", listed(kinds));
  if (!r.joins.empty()) {
    out << fmt::format("classes  {}\n", listed(classes));
    if (r.cad) out << fmt::format("edges    {} (sharp: above {:g} degrees)\n", listed(edges), r.cad->smooth_below);
    out << fmt::format("gap      largest {}{}\n", bound_text(gap), r.units.empty() ? "" : " " + escaped(r.units));
    out << fmt::format("angle    largest {} degrees\n", bound_text(angle));
    Approximation most;
    int approximated = 0;
    for (const ReportedJoin& j : r.joins) {
      approximated += j.approximation.length > 0;
      most.length = std::max(most.length, j.approximation.length);
      most.degrees = std::max(most.degrees, j.approximation.degrees);
    }
    if (approximated > 0)
      out << fmt::format(
          "approximated surfaces at {} joins: not in the bounds, and by figures that are no bounds, add up to {:.3g}{} "
          "and {:.3g} degrees\n",
          approximated, most.length, r.units.empty() ? "" : " " + escaped(r.units), most.degrees);
  }
  const auto with = [&](auto is_meant) {
    return std::count_if(r.joins.begin(), r.joins.end(), [&](const ReportedJoin& j) {
      return std::any_of(j.certificate.degenerate.begin(), j.certificate.degenerate.end(), is_meant);
    });
  };
  const auto is_left_out = [](const Degeneracy& d) { return d.what.find("left out") != std::string::npos; };
  const auto degenerate =
      with([&](const Degeneracy& d) { return !is_left_out(d) && (d.begin != d.end || d.what.find("no normal") == 0); });
  if (degenerate > 0)
    out << fmt::format("normals  vanish inside or along {} joins; their limits are used (see --json)\n", degenerate);
  if (const auto left_out = with(is_left_out); left_out > 0)
    out << fmt::format(
        "normals  are rounding errors at an end of {} joins: 2^-24 of the edge is left out of the angle\n", left_out);
  if (!r.collapsed.empty()) {
    const auto planes =
        std::count_if(r.collapsed.begin(), r.collapsed.end(), [](const auto& c) { return c.tangent_plane; });
    out << fmt::format("poles    {} collapsed edges, {} with a proven tangent plane\n", r.collapsed.size(), planes);
  }
  if (!r.gregory_patches.empty()) {
    std::map<std::string, int> c1, regular;
    for (const ReportedGregoryPatch& p : r.gregory_patches) {
      ++c1[p.proof.is_c1() ? "proven" : "refuted"];
      ++regular[to_string(p.proof.regular.verdict)];
    }
    out << fmt::format("inside   Gregory patches: C1 {}; normal nowhere zero {}\n", listed(c1), listed(regular));
  }
  if (r.cad && !r.cad->no_joins.empty()) {
    std::map<std::string, int> others;
    for (const ReportedEdge& edge : r.cad->no_joins) ++others[edge.kind];
    out << fmt::format("others   edges that are no joins: {}\n", listed(others));
  }
  if (!r.unmatched.empty()) {
    out << fmt::format("free     {} edges without a partner within {:.3g}:", r.unmatched.size(), r.match_length);
    constexpr std::size_t kShown = 8;
    for (std::size_t i = 0; i < std::min(kShown, r.unmatched.size()); ++i)
      out << ' ' << side_text(r, {r.unmatched[i].patch, to_string(r.unmatched[i].edge), 0, 1, "", ""}, false);
    out << (r.unmatched.size() > kShown ? " …\n" : "\n");
  }
  if (!only_curves && (r.request.require || r.request.gap_tolerance || r.request.angle_tolerance)) {
    int pass = 0, fail = 0;
    for (const ReportedJoin& j : r.joins) {
      pass += j.judgement.outcome == Outcome::pass;
      fail += j.judgement.outcome == Outcome::fail;
    }
    out << fmt::format("verdict  {}: {} pass, {} fail, {} undecided", to_string(r.outcome()), pass, fail, undecided);
    if (r.joins.empty())
      out << (r.cad ? std::string("; no edge is shared by faces")
                    : fmt::format("; no edges meet within {:.3g}", r.match_length))
          << ", nothing was judged";
    if (!r.joins.empty() && !r.unmatched.empty()) out << "; free edges are not judged";
    const auto sharp = std::count_if(r.joins.begin(), r.joins.end(),
                                     [](const ReportedJoin& j) { return j.edge_class == EdgeClass::sharp; });
    if (sharp > 0 && (r.request.angle_tolerance || r.request.require))
      out << fmt::format("; no tangents are asked of {} sharp edges", sharp);
    if (r.profile) {
      const auto& criteria = r.profile->criteria;
      const auto checked = std::count_if(criteria.begin(), criteria.end(),
                                         [&](const Criterion& c) { return tolerance_of(r, c).has_value(); });
      out << fmt::format("; {} of {} criteria are checked", checked, criteria.size());
    }
    out << '\n';
  }
  if (r.seconds) {
    const std::size_t joins = r.joins.size() + (r.curves ? r.curves->joins.size() : 0);
    out << fmt::format("time     {:.3g} s", *r.seconds);
    if (joins > 0) out << fmt::format(", {:.3g} ms for each join", 1000 * *r.seconds / static_cast<double>(joins));
    out << '\n';
  }
  if (r.profile) write_profile(out, r);
}

}  // namespace patchproof
