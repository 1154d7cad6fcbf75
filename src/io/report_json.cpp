// SPDX-License-Identifier: Apache-2.0
// The report as JSON: one document, written join by join so that its size is not held in memory.
#include <nlohmann/json.hpp>
#include <ostream>

#include "patchproof/io/report.h"
#include "report_curves.h"
#include "report_profile.h"

namespace patchproof {
namespace {

using Json = nlohmann::ordered_json;

// Infinite bounds cannot be written as JSON numbers: "no upper bound" is null.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json place(const Place& p) { return {{"a", p.a}, {"b", p.b}, {"point", p.point}}; }

Json bound(const EnclosedMaximum& m) {
  return {{"lower", number(m.lower)}, {"upper", number(m.upper)}, {"at", place(m.at)}, {"tight", m.converged}};
}

Json side(const Report& r, const ReportedSide& s) {
  return {{"patch", s.patch},
          {"name", r.patch_names[s.patch]},
          {"edge", s.edge},
          {"range", {s.begin, s.end}},
          {"exact_range", {s.exact_begin, s.exact_end}}};
}

Json approximation_json(const Approximation& by) {
  return {{"length", number(by.length)}, {"degrees", number(by.degrees)}};
}

Json checks_json(const Report& r, const ReportedJoin& j) {
  Json checks = Json::array();
  for (const Criterion& c : r.profile->criteria)
    if (const auto outcome = outcome_of(r, j, c))
      checks.push_back({{"code", c.code}, {"verdict", to_string(*outcome)}});
  return checks;
}

Json join_json(const Report& r, const ReportedJoin& j) {
  const Certificate& c = j.certificate;
  Json exact{{"C0", to_string(c.c0.verdict)},
             {"C1", to_string(c.c1.verdict)},
             {"C2", to_string(c.c2.verdict)},
             {"G1", to_string(c.g1.verdict)},
             {"ratio", c.ratio ? Json(*c.ratio) : Json(nullptr)}};
  Json pairing{{"kind", to_string(j.pairing)}};
  if (!j.pairing_nodes.empty()) pairing["nodes"] = j.pairing_nodes;
  if (!j.pairing_ratio.empty()) pairing["ratio"] = j.pairing_ratio;
  Json degenerate = Json::array();
  for (const Degeneracy& d : c.degenerate)
    degenerate.push_back({{"side", std::string(1, d.side)}, {"range", {d.begin, d.end}}, {"what", d.what}});
  Json witness = Json::object(), reasons = Json::object();
  for (const auto& [name, cls] :
       {std::pair<const char*, const ExactClass*>{"C0", &c.c0}, {"C1", &c.c1}, {"C2", &c.c2}, {"G1", &c.g1}}) {
    if (cls->witness)
      witness[name] = {{"quantity", cls->witness->quantity},
                       {"a", cls->witness->a},
                       {"b", cls->witness->b},
                       {"values", cls->witness->values}};
    if (!cls->reason.empty()) reasons[name] = cls->reason;
  }
  Json out{{"id", j.id},
           {"a", side(r, j.a)},
           {"b", side(r, j.b)},
           {"kind", to_string(j.kind)},
           {"reversed", j.reversed},
           {"exact", exact},
           {"gap", bound(c.gap)},
           {"angle_degrees", bound(c.angle)},
           {"tangent_plane_angle_degrees", bound(c.plane_angle)},
           {"orientation", to_string(c.orientation)},
           {"degenerate", degenerate},
           {"rung", c.rung},
           {"pairing", pairing},
           {"verdict", to_string(j.judgement.outcome)},
           {"witness", witness},
           {"reasons", reasons},
           {"reason", j.judgement.reason}};
  if (j.edge_class) out["edge_class"] = to_string(*j.edge_class);
  if (j.approximation.length > 0) out["approximation"] = approximation_json(j.approximation);
  if (r.profile) out["checks"] = checks_json(r, j);
  return out;
}

Json profile_json(const Report& r) {
  const auto text = [](std::string_view t) { return t.empty() ? Json(nullptr) : Json(t); };
  Json criteria = Json::array();
  for (const Criterion& c : r.profile->criteria) {
    Json criterion{{"code", c.code},
                   {"entity", text(c.entity)},
                   {"what", c.what},
                   {"threshold", c.threshold},
                   {"unit", text(c.unit)}};
    const std::optional<double> tolerance = tolerance_of(r, c);
    criterion["checked"] = tolerance.has_value();
    if (tolerance) {
      const CriterionCount count = count_of(r, c);
      criterion["compared_with"] = *tolerance;
      criterion["joins"] = count.joins;
      criterion["pass"] = count.pass;
      criterion["fail"] = count.fail;
      criterion["undecided"] = count.undecided;
    }
    criteria.push_back(std::move(criterion));
  }
  return {{"name", r.profile->name},
          {"title", r.profile->title},
          {"source", r.profile->source},
          {"remark", text(r.profile->remark)},
          {"criteria", criteria}};
}

Json request_json(const Report& r) {
  Json require = nullptr;
  if (r.request.require)
    require = *r.request.require == Continuity::c0 ? "C0" : *r.request.require == Continuity::c1 ? "C1" : "G1";
  const auto optional = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  Json out{{"require", require},
           {"gap", optional(r.request.gap_tolerance)},
           {"angle_degrees", optional(r.request.angle_tolerance)},
           {"match", r.match_length},
           {"budget_seconds", r.request.seconds_per_join}};
  if (r.cad) out["smooth_below_degrees"] = r.cad->smooth_below;
  return out;
}

Json summary_json(const Report& r) {
  int count[3] = {0, 0, 0};
  double gap = 0, angle = 0;
  for (const ReportedJoin& j : r.joins) {
    ++count[static_cast<int>(j.judgement.outcome)];
    gap = std::max(gap, j.certificate.gap.upper);
    angle = std::max(angle, j.certificate.angle.upper);
  }
  Json out{{"pass", count[0]},
           {"fail", count[1]},
           {"undecided", count[2]},
           {"worst_gap", number(gap)},
           {"worst_angle_degrees", number(angle)}};
  if (r.cad) {
    Json classes;
    for (const EdgeClass c :
         {EdgeClass::smooth, EdgeClass::kinked, EdgeClass::sharp, EdgeClass::mixed, EdgeClass::undecided})
      classes[to_string(c)] =
          std::count_if(r.joins.begin(), r.joins.end(), [&](const ReportedJoin& j) { return j.edge_class == c; });
    out["edge_classes"] = std::move(classes);
  }
  return out;
}

// On one line. File names need not be UTF-8; JSON must be.
std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

// The members of a report about a CAD model.
std::string cad_text(const CadReport& cad) {
  std::string out = "\"left_out_faces\":[";
  for (std::size_t i = 0; i < cad.left_out.size(); ++i)
    out += (i ? ",\n" : "\n") + text_of(Json{{"face", cad.left_out[i].label}, {"reason", cad.left_out[i].reason}});
  out += "],\n\"other_edges\":[";
  for (std::size_t i = 0; i < cad.no_joins.size(); ++i)
    out +=
        (i ? ",\n" : "\n") +
        text_of(Json{{"edge", cad.no_joins[i].label}, {"kind", cad.no_joins[i].kind}, {"note", cad.no_joins[i].note}});
  out += "],\n";
  if (cad.approximated.empty()) return out;
  out += "\"approximated_faces\":[";
  for (const ApproximatedFace& face : cad.approximated)
    out += (&face == &cad.approximated.front() ? "\n" : ",\n") +
           text_of(Json{{"patch", face.patch}, {"by", approximation_json(face.by)}});
  return out + "],\n";
}

// What is proved of Gregory patches by themselves.
std::string gregory_text(const Report& r) {
  std::string out = "\"gregory_patches\":[";
  for (const ReportedGregoryPatch& p : r.gregory_patches)
    out += (&p == &r.gregory_patches.front() ? "\n" : ",\n") +
           text_of(Json{{"patch", p.patch},
                        {"c1", p.proof.is_c1() ? "proven" : "refuted"},
                        {"boundary_matched", p.proof.matched},
                        {"corners_agree", p.proof.corners},
                        {"rows_c1", p.proof.c1},
                        {"weights_positive", p.proof.positive},
                        {"regular", to_string(p.proof.regular.verdict)},
                        {"reason", p.proof.regular.reason}});
  return out + "],\n";
}

// The same for an object, without the closing brace.
std::string open_object(const Json& value) {
  std::string text = text_of(value);
  text.pop_back();
  return text;
}

}  // namespace

void write_json(std::ostream& out, const Report& r) {
  Json head{{"tool", "patchproof"},
            {"version", PATCHPROOF_VERSION},
            {"schema", 1},
            {"input",
             {{"file", r.file},
              {"sha256", r.sha256},
              {"format", r.format},
              {"decimals", r.decimals == Decimals::exact ? "exact" : "binary64"},
              {"units", r.units},
              {"patches", r.patch_names.size()},
              {"joins", r.joins.size()},
              {"notes", r.notes}}},
            {"request", request_json(r)}};
  if (r.profile) head["profile"] = profile_json(r);
  out << open_object(head) << ",\n\"joins\":[";
  for (std::size_t i = 0; i < r.joins.size(); ++i) out << (i ? ",\n" : "\n") << text_of(join_json(r, r.joins[i]));
  out << "],\n\"unmatched_edges\":[";
  for (std::size_t i = 0; i < r.unmatched.size(); ++i) {
    const EdgeRange& e = r.unmatched[i];
    out << (i ? ",\n" : "\n")
        << Json{{"patch", e.patch}, {"edge", to_string(e.edge)}, {"range", {e.begin, e.end}}}.dump();
  }
  out << "],\n\"collapsed_edges\":[";
  for (std::size_t i = 0; i < r.collapsed.size(); ++i) {
    const CollapsedEdge& e = r.collapsed[i];
    out << (i ? ",\n" : "\n")
        << Json{{"patch", e.patch},
                {"edge", to_string(e.edge)},
                {"exactly", e.exactly},
                {"tangent_plane", e.tangent_plane}}
               .dump();
  }
  out << "],\n";
  if (!r.gregory_patches.empty()) out << gregory_text(r);
  if (r.cad) out << cad_text(*r.cad);
  if (r.curves) out << curves_json(r);
  if (r.seconds) out << "\"seconds\":" << Json(*r.seconds).dump() << ",\n";
  out << "\"summary\":" << summary_json(r).dump() << ",\n\"verdict\":\"" << to_string(r.outcome()) << "\"}\n";
}

}  // namespace patchproof
