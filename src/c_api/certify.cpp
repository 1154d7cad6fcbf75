// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "c_api/models.h"
#include "c_api/watch.h"
#include "patchproof/io/profile.h"
#include "patchproof/io/report.h"

namespace patchproof::c_api {
namespace {

constexpr std::size_t kClasses = 5;  // by number: PATCHPROOF_CLASS_C0 …

struct ReportContent {
  Report report;
  std::vector<std::array<std::string, kClasses>> witness_values;  // of each join, one to a line
};

const ExactClass& exact_class(const Certificate& c, std::int32_t continuity) {
  switch (continuity) {
    case PATCHPROOF_CLASS_C0: return c.c0;
    case PATCHPROOF_CLASS_C1: return c.c1;
    case PATCHPROOF_CLASS_G1: return c.g1;
    case PATCHPROOF_CLASS_C2: return c.c2;
  }
  bad_argument("continuity", "is none of C0, C1, G1, C2", std::to_string(continuity));
}

ReportContent content_of_report(Report report) {
  ReportContent out{std::move(report), {}};
  for (const ReportedJoin& join : out.report.joins) {
    std::array<std::string, kClasses>& texts = out.witness_values.emplace_back();
    for (const std::int32_t k : {PATCHPROOF_CLASS_C0, PATCHPROOF_CLASS_C1, PATCHPROOF_CLASS_G1, PATCHPROOF_CLASS_C2})
      if (const auto& witness = exact_class(join.certificate, k).witness)
        for (const std::string& value : witness->values) texts[static_cast<std::size_t>(k)] += value + "\n";
  }
  return out;
}

// A number that is not negative; not-a-number is none.
double size_of(double x, const char* name) {
  if (!(x >= 0 && std::isfinite(x))) bad_argument(name, "is no finite number of 0 or more", std::to_string(x));
  return x;
}

CertifyOptions certify_options(const patchproof_certify_options* options, const std::string& units) {
  const patchproof_certify_options o = options_of(options, "options");
  CertifyOptions out;
  if (o.require == PATCHPROOF_CLASS_C2)
    bad_argument("options.require", "is C0, C1 or G1: C2 is reported, and cannot be asked for", "C2");
  require_value(o.require, PATCHPROOF_CLASS_G1, "options.require");
  if (o.require != PATCHPROOF_CLASS_ANY)
    out.request.require = o.require == PATCHPROOF_CLASS_C0   ? Continuity::c0
                          : o.require == PATCHPROOF_CLASS_C1 ? Continuity::c1
                                                             : Continuity::g1;
  require_value(o.has_gap, 1, "options.has_gap");
  require_value(o.has_angle, 1, "options.has_angle");
  require_value(o.has_curvature, 1, "options.has_curvature");
  if (o.has_curvature) out.curvature_tolerance = size_of(o.curvature_tolerance, "options.curvature_tolerance");
  if (o.has_gap) out.request.gap_tolerance = size_of(o.gap_tolerance, "options.gap_tolerance");
  if (o.has_angle) out.request.angle_tolerance = size_of(o.angle_tolerance, "options.angle_tolerance");
  if (o.angle_tolerance > 180) bad_argument("options.angle_tolerance", "is more than 180 degrees");
  if (size_of(o.seconds_per_join, "options.seconds_per_join") > 0) out.request.seconds_per_join = o.seconds_per_join;
  const auto unused = [](std::int32_t has, double tolerance, const char* name) {
    if (has == 0 && tolerance != 0)
      bad_argument(name, "is set, and does not count: its has_… is 0", std::to_string(tolerance));
  };
  unused(o.has_gap, o.gap_tolerance, "options.gap_tolerance");
  unused(o.has_angle, o.angle_tolerance, "options.angle_tolerance");
  unused(o.has_curvature, o.curvature_tolerance, "options.curvature_tolerance");
  out.given = out.request;
  if (o.profile.length > 0) {
    const std::string name(view(o.profile, "options.profile"));
    out.profile = find_profile(name);
    if (out.profile == nullptr) bad_argument("options.profile", "there is no profile of this name", name);
    out.request = take(tolerances_of(*out.profile, units, out.given));
  }
  out.match_length = size_of(o.match_length, "options.match_length");
  require_value(o.jobs, 1024, "options.jobs");
  out.jobs = o.jobs;
  return out;
}

template <class Class>
patchproof_verdict verdict_of(const Class& c) {
  return {c.verdict == Verdict::proven    ? PATCHPROOF_VERDICT_PROVEN
          : c.verdict == Verdict::refuted ? PATCHPROOF_VERDICT_REFUTED
                                          : PATCHPROOF_VERDICT_UNDECIDED,
          borrowed(c.reason)};
}
std::int32_t outcome_of(Outcome outcome) {
  return outcome == Outcome::pass   ? PATCHPROOF_OUTCOME_PASS
         : outcome == Outcome::fail ? PATCHPROOF_OUTCOME_FAIL
                                    : PATCHPROOF_OUTCOME_UNDECIDED;
}
patchproof_maximum maximum_of(const EnclosedMaximum& m) {
  return {m.lower, m.upper, {m.at.point[0], m.at.point[1], m.at.point[2]}, m.converged ? 1 : 0};
}
patchproof_join_side side_of(const ReportedSide& side) {
  return {side.patch, borrowed(side.edge), {borrowed(side.exact_begin), borrowed(side.exact_end)}};
}

patchproof_report_summary summary_of(const Report& report) {
  patchproof_report_summary out{};
  out.outcome = outcome_of(report.outcome());
  out.joins = report.joins.size();
  for (const ReportedJoin& join : report.joins) {
    const Outcome o = join.judgement.outcome;
    ++(o == Outcome::pass ? out.passed : o == Outcome::fail ? out.failed : out.undecided);
    const auto widen = [](double* largest, const EnclosedMaximum& m) {
      largest[0] = std::max(largest[0], m.lower);
      largest[1] = std::max(largest[1], m.upper);
    };
    widen(out.largest_gap, join.certificate.gap);
    widen(out.largest_angle, join.certificate.angle);
  }
  if (report.curves)
    for (const ReportedCurveJoin& join : report.curves->joins) {
      const Outcome o = join.judgement.outcome;
      ++out.curve_joins;
      ++(o == Outcome::pass ? out.curve_passed : o == Outcome::fail ? out.curve_failed : out.curve_undecided);
    }
  out.unmatched_edges = report.unmatched.size();
  out.collapsed_edges = report.collapsed.size();
  out.gregory_patches = report.gregory_patches.size();
  return out;
}

}  // namespace
}  // namespace patchproof::c_api

struct patchproof_report : patchproof::c_api::Handle<patchproof::c_api::ReportContent> {
  using Handle::Handle;
};

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

patchproof_status patchproof_certify(patchproof_context* context, const patchproof_model* model,
                                     const patchproof_certify_options* options, const patchproof_callback* callback,
                                     patchproof_report** out) noexcept {
  return call(context, [&] {
    require_place(out, "out");
    const ModelFile& file = content_of(model, "model").file;
    CertifyOptions certify = certify_options(options, std::visit([](const auto& m) { return m.units; }, file.model));
    Progress progress;
    certify.progress = [&](std::size_t done, std::size_t all) {
      progress.all = all;
      progress.done = done;
    };
    std::optional<Report> report;
    watch(callback, progress, [&] { report = certify_model(file, certify); });
    hand_over(context, content_of_report(std::move(*report)), out);
  });
}

patchproof_status patchproof_report_free(patchproof_report* report) noexcept { return free_handle(report); }

patchproof_status patchproof_report_get_summary(patchproof_context* context, const patchproof_report* report,
                                                patchproof_report_summary* out) noexcept {
  return call(context, [&] { write_struct(out, summary_of(content_of(report, "report").report), "out"); });
}

patchproof_status patchproof_report_get_join(patchproof_context* context, const patchproof_report* report, size_t join,
                                             patchproof_join_report* out) noexcept {
  return call(context, [&] {
    const Report& r = content_of(report, "report").report;
    require_index(join, r.joins.size(), "join");
    const ReportedJoin& j = r.joins[join];
    const Certificate& c = j.certificate;
    patchproof_join_report value{};
    value.id = j.id;
    value.a = side_of(j.a);
    value.b = side_of(j.b);
    value.reversed = j.reversed ? 1 : 0;
    value.c0 = verdict_of(c.c0);
    value.c1 = verdict_of(c.c1);
    value.c2 = verdict_of(c.c2);
    value.g1 = verdict_of(c.g1);
    value.ratio = c.ratio ? borrowed(*c.ratio) : kNoText;
    value.gap = maximum_of(c.gap);
    value.angle = maximum_of(c.angle);
    value.plane_angle = maximum_of(c.plane_angle);
    value.orientation = static_cast<std::int32_t>(c.orientation);
    value.outcome = outcome_of(j.judgement.outcome);
    value.reason = borrowed(j.judgement.reason);
    write_struct(out, value, "out");
  });
}

patchproof_status patchproof_report_get_curve_join(patchproof_context* context, const patchproof_report* report,
                                                   size_t join, patchproof_curve_join_report* out) noexcept {
  return call(context, [&] {
    const Report& r = content_of(report, "report").report;
    require_index(join, r.curves ? r.curves->joins.size() : 0, "join");
    const ReportedCurveJoin& j = r.curves->joins[join];
    const CurveCertificate& c = j.certificate;
    patchproof_curve_join_report value{};
    value.id = j.id;
    value.curve_a = static_cast<std::int32_t>(j.a.of.curve);
    value.end_a = j.a.of.end == CurveEnd::end ? 1 : 0;
    value.curve_b = static_cast<std::int32_t>(j.b.of.curve);
    value.end_b = j.b.of.end == CurveEnd::end ? 1 : 0;
    std::copy(j.point.begin(), j.point.end(), value.point);
    value.c0 = verdict_of(c.c0);
    value.c1 = verdict_of(c.c1);
    value.c2 = verdict_of(c.c2);
    value.g1 = verdict_of(c.g1);
    value.g2 = verdict_of(c.g2);
    const auto enclose = [](const std::optional<Enclosure>& x, double(&to)[2]) {
      to[0] = x ? x->lower : 0;
      to[1] = x ? x->upper : std::numeric_limits<double>::infinity();
    };
    enclose(c.gap, value.gap);
    enclose(c.angle, value.angle);
    enclose(c.curvature_difference, value.curvature);
    value.outcome = outcome_of(j.judgement.outcome);
    value.reason = borrowed(j.judgement.reason);
    write_struct(out, value, "out");
  });
}

patchproof_status patchproof_report_get_witness(patchproof_context* context, const patchproof_report* report,
                                                size_t join, int32_t continuity, patchproof_witness* out) noexcept {
  return call(context, [&] {
    const ReportContent& content = content_of(report, "report");
    require_index(join, content.report.joins.size(), "join");
    const std::optional<Witness>& w = exact_class(content.report.joins[join].certificate, continuity).witness;
    patchproof_witness value{0, 0, kNoText, {kNoText, kNoText}, {kNoText, kNoText}, kNoText};
    if (w) {
      value.found = 1;
      value.quantity = borrowed(w->quantity);
      for (std::size_t i = 0; i < 2; ++i) {
        value.a[i] = borrowed(w->a[i]);
        value.b[i] = borrowed(w->b[i]);
      }
      value.values = borrowed(content.witness_values[join][static_cast<std::size_t>(continuity)]);
    }
    write_struct(out, value, "out");
  });
}

patchproof_status patchproof_report_write(patchproof_context* context, const patchproof_report* report, int32_t format,
                                          char* buffer, size_t length, size_t* needed) noexcept {
  return call(context, [&] {
    const Report& r = content_of(report, "report").report;
    require_value(format, PATCHPROOF_REPORT_TABLE, "format");
    std::ostringstream text;
    text.exceptions(std::ios::badbit);  // or a text would end where memory did
    text.imbue(std::locale::classic());
    if (format == PATCHPROOF_REPORT_JSON)
      write_json(text, r);
    else
      write_table(text, r);
    write_text(std::move(text).str(), buffer, length, needed);
  });
}

static_assert(static_cast<int>(Orientation::smooth) == PATCHPROOF_ORIENTATION_SMOOTH &&
              static_cast<int>(Orientation::cusp) == PATCHPROOF_ORIENTATION_CUSP &&
              static_cast<int>(Orientation::mixed) == PATCHPROOF_ORIENTATION_MIXED &&
              static_cast<int>(Orientation::unknown) == PATCHPROOF_ORIENTATION_UNKNOWN);
static_assert(static_cast<int>(EdgeName::u_min) == PATCHPROOF_EDGE_U_MIN &&
              static_cast<int>(EdgeName::u_max) == PATCHPROOF_EDGE_U_MAX &&
              static_cast<int>(EdgeName::v_min) == PATCHPROOF_EDGE_V_MIN &&
              static_cast<int>(EdgeName::v_max) == PATCHPROOF_EDGE_V_MAX);
