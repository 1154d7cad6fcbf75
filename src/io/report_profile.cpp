// SPDX-License-Identifier: Apache-2.0
#include "report_profile.h"

#include "edge_class.h"

#include <fmt/format.h>

#include <ostream>
#include <string>

namespace patchproof {

void begin_request(Report& report, const CertifyOptions& options) {
  report.request = options.request;
  report.profile = options.profile;
  if (report.profile && report.units.empty() && !options.given.gap_tolerance)
    report.notes.push_back("the model names no units: profile " + std::string(report.profile->name) +
                           " takes its lengths for millimetres");
}

Request request_at(const CertifyOptions& options, JoinKind kind) {
  return options.profile ? request_at(*options.profile, kind, options.given, options.request) : options.request;
}

std::optional<double> tolerance_of(const Report& report, const Criterion& criterion) {
  switch (criterion.quantity) {
    case Quantity::gap: return report.request.gap_tolerance;
    case Quantity::angle: return report.request.angle_tolerance;
    case Quantity::unchecked: return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Outcome> outcome_of(const Report& report, const ReportedJoin& join, const Criterion& criterion) {
  const std::optional<double> tolerance = tolerance_of(report, criterion);
  if (!tolerance || !applies(criterion, join.kind)) return std::nullopt;
  if (criterion.quantity == Quantity::angle && join.edge_class == EdgeClass::sharp) return std::nullopt;
  Request only;
  (criterion.quantity == Quantity::gap ? only.gap_tolerance : only.angle_tolerance) = tolerance;
  return judge(widened(join.certificate, join.approximation), only).outcome;
}

CriterionCount count_of(const Report& report, const Criterion& criterion) {
  CriterionCount count;
  for (const ReportedJoin& join : report.joins) {
    const std::optional<Outcome> outcome = outcome_of(report, join, criterion);
    if (!outcome) continue;
    ++count.joins;
    ++(*outcome == Outcome::pass ? count.pass : *outcome == Outcome::fail ? count.fail : count.undecided);
  }
  return count;
}

void write_profile(std::ostream& out, const Report& report) {
  out << fmt::format("profile  {}: {}\n", report.profile->name, report.profile->title);
  for (const Criterion& c : report.profile->criteria) {
    const std::optional<double> tolerance = tolerance_of(report, c);
    const CriterionCount count = count_of(report, c);
    const std::string allowed = fmt::format("{}{}{}", c.threshold, c.unit.empty() || c.unit == "%" ? "" : " ", c.unit);
    out << fmt::format("         {} {}, at most {}", c.code, c.what, allowed);
    if (tolerance && *tolerance != c.threshold) out << fmt::format(" (compared with {})", *tolerance);
    if (!tolerance)
      out << ": NOT CHECKED\n";
    else if (count.joins == 0)
      out << ": no such joins\n";
    else
      out << fmt::format(": {} pass, {} fail, {} undecided\n", count.pass, count.fail, count.undecided);
  }
}

}  // namespace patchproof
