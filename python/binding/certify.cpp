// SPDX-License-Identifier: Apache-2.0
// Proofs of how patches join, as records of Python.
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>

#include "model.h"

namespace patchproof::python {
namespace {

struct Report {
  explicit Report(ReportHandle made) : handle(std::move(made)) {}
  ReportHandle handle;
  py::object joins, curve_joins;  // tuples, made when they are first asked for
};
using SharedReport = std::shared_ptr<Report>;

constexpr const char* kVerdicts[] = {"proven", "refuted", "undecided"};
constexpr const char* kOutcomes[] = {"pass", "fail", "undecided"};
constexpr const char* kOrientations[] = {"smooth", "cusp", "mixed", "unknown"};

// The classes of records are looked up once for a report and not for each record.
struct Records {
  py::object bounds = member("_values", "Bounds"), verdict = member("_values", "Verdict"),
             witness = member("_values", "Witness"), side = member("_values", "JoinSide"),
             join = member("_values", "Join"), curve_join = member("_values", "CurveJoin"),
             exact = member("_numbers", "exact_or_text");

  py::object maximum(const patchproof_maximum& m) const {
    return bounds(m.lower, m.upper, py::make_tuple(m.point[0], m.point[1], m.point[2]), m.converged != 0);
  }
  py::object exacts(const patchproof_text (&pair)[2]) const {
    return py::make_tuple(exact(to_str(pair[0])), exact(to_str(pair[1])));
  }
  py::object join_side(const patchproof_join_side& s) const { return side(s.patch, to_str(s.edge), exacts(s.range)); }
};

py::object witness_of(const Report& report, std::size_t join, std::int32_t continuity, const Records& records) {
  auto found = sized<patchproof_witness>();
  call([&](patchproof_context* context) {
    return patchproof_report_get_witness(context, report.handle.get(), join, continuity, &found);
  });
  if (found.found == 0) return py::none();
  py::list values;
  for (const auto& line : lines_of(found.values)) values.append(records.exact(line));
  return records.witness(to_str(found.quantity), records.exacts(found.a), records.exacts(found.b), py::tuple(values));
}

py::object join_of(const Report& report, std::size_t number, const Records& records) {
  auto join = sized<patchproof_join_report>();
  call([&](patchproof_context* context) {
    return patchproof_report_get_join(context, report.handle.get(), number, &join);
  });
  const auto verdict = [&](const patchproof_verdict& v, std::int32_t continuity) {
    return records.verdict(kVerdicts[v.verdict], to_str(v.reason), witness_of(report, number, continuity, records));
  };
  return records.join(
      py::arg("id") = join.id, py::arg("a") = records.join_side(join.a), py::arg("b") = records.join_side(join.b),
      py::arg("reversed") = join.reversed != 0, py::arg("c0") = verdict(join.c0, PATCHPROOF_CLASS_C0),
      py::arg("c1") = verdict(join.c1, PATCHPROOF_CLASS_C1), py::arg("c2") = verdict(join.c2, PATCHPROOF_CLASS_C2),
      py::arg("g1") = verdict(join.g1, PATCHPROOF_CLASS_G1),
      py::arg("ratio") = join.ratio.length == 0 ? py::object(py::none()) : records.exact(to_str(join.ratio)),
      py::arg("gap") = records.maximum(join.gap), py::arg("angle") = records.maximum(join.angle),
      py::arg("plane_angle") = records.maximum(join.plane_angle),
      py::arg("orientation") = kOrientations[join.orientation], py::arg("outcome") = kOutcomes[join.outcome],
      py::arg("reason") = to_str(join.reason));
}

patchproof_report_summary summary_of(const Report& report) {
  auto out = sized<patchproof_report_summary>();
  call([&](patchproof_context* context) { return patchproof_report_get_summary(context, report.handle.get(), &out); });
  return out;
}

py::object joins_of(Report& report) {
  if (report.joins) return report.joins;
  const Records records;
  const std::size_t count = summary_of(report).joins;
  py::tuple all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = join_of(report, i, records);
  report.joins = all;
  return report.joins;
}

py::object curve_joins_of(Report& report) {
  if (report.curve_joins) return report.curve_joins;
  const Records records;
  const std::size_t count = summary_of(report).curve_joins;
  py::tuple all(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto join = sized<patchproof_curve_join_report>();
    call([&](patchproof_context* context) {
      return patchproof_report_get_curve_join(context, report.handle.get(), i, &join);
    });
    const auto verdict = [&](const patchproof_verdict& v) {
      return records.verdict(kVerdicts[v.verdict], to_str(v.reason));
    };
    const auto end = [](std::int32_t curve, std::int32_t at_end) {
      return py::make_tuple(curve, at_end != 0 ? "end" : "begin");
    };
    const auto bounds = [&](const double(&b)[2]) { return records.bounds(b[0], b[1]); };
    all[i] = records.curve_join(py::arg("id") = join.id, py::arg("a") = end(join.curve_a, join.end_a),
                                py::arg("b") = end(join.curve_b, join.end_b),
                                py::arg("point") = py::make_tuple(join.point[0], join.point[1], join.point[2]),
                                py::arg("c0") = verdict(join.c0), py::arg("c1") = verdict(join.c1),
                                py::arg("c2") = verdict(join.c2), py::arg("g1") = verdict(join.g1),
                                py::arg("g2") = verdict(join.g2), py::arg("gap") = bounds(join.gap),
                                py::arg("angle") = bounds(join.angle), py::arg("curvature") = bounds(join.curvature),
                                py::arg("outcome") = kOutcomes[join.outcome], py::arg("reason") = to_str(join.reason));
  }
  report.curve_joins = all;
  return report.curve_joins;
}

py::object summary_record(Report& report) {
  const auto s = summary_of(report);
  const py::object bounds = member("_values", "Bounds");
  return member("_values", "ReportSummary")(
      py::arg("outcome") = kOutcomes[s.outcome], py::arg("joins") = s.joins, py::arg("passed") = s.passed,
      py::arg("failed") = s.failed, py::arg("undecided") = s.undecided, py::arg("curve_joins") = s.curve_joins,
      py::arg("curve_passed") = s.curve_passed, py::arg("curve_failed") = s.curve_failed,
      py::arg("curve_undecided") = s.curve_undecided, py::arg("unmatched_edges") = s.unmatched_edges,
      py::arg("collapsed_edges") = s.collapsed_edges, py::arg("gregory_patches") = s.gregory_patches,
      py::arg("largest_gap") = bounds(s.largest_gap[0], s.largest_gap[1]),
      py::arg("largest_angle") = bounds(s.largest_angle[0], s.largest_angle[1]));
}

std::string text_of(const Report& report, std::int32_t format) {
  return written(1 << 15, [&](patchproof_context* context, char* buffer, std::size_t length, std::size_t* needed) {
    return patchproof_report_write(context, report.handle.get(), format, buffer, length, needed);
  });
}

SharedReport certify(const Model& model, const py::object& require, std::optional<double> gap,
                     std::optional<double> angle, std::optional<double> curvature,
                     const std::optional<std::string>& profile, double seconds_per_join, std::optional<double> match,
                     int jobs, const py::object& progress) {
  auto options = sized<patchproof_certify_options>();
  constexpr std::int32_t classes[] = {PATCHPROOF_CLASS_C0, PATCHPROOF_CLASS_C1, PATCHPROOF_CLASS_G1};
  options.require = require.is_none() ? PATCHPROOF_CLASS_ANY : classes[choose(require, {"C0", "C1", "G1"}, "require")];
  if (gap) options.has_gap = 1, options.gap_tolerance = *gap;
  if (angle) options.has_angle = 1, options.angle_tolerance = *angle;
  if (curvature) options.has_curvature = 1, options.curvature_tolerance = *curvature;
  if (profile) options.profile = view(*profile);
  if (!(seconds_per_join > 0) || std::isinf(seconds_per_join))
    throw py::value_error("seconds_per_join: a positive number is needed");
  options.seconds_per_join = seconds_per_join;
  if (match && !(*match > 0)) throw py::value_error("match: a positive length is needed");
  options.match_length = match.value_or(0);
  options.jobs = jobs;
  Progress watch(progress);
  ReportHandle made;
  watch.call([&](patchproof_context* context) {
    patchproof_report* report = nullptr;
    const patchproof_status status =
        patchproof_certify(context, model.handle.get(), &options, watch.callback(), &report);
    made.reset(report);
    return status;
  });
  return std::make_shared<Report>(std::move(made));
}

}  // namespace

void bind_certify(py::module_& module) {
  py::class_<Report, SharedReport> report(module, "Report", py::is_final(), R"(What certify has proved of a model.

It is neither true nor false: ask for .outcome ("pass", "fail" or "undecided" of what was asked) or look at .joins.)");
  forbid_construction(report);
  forbid_pickling(report, "a Report cannot be pickled: keep report.to_json()");
  report.def_property_readonly("joins", &joins_of, "The joins of patches, a tuple of Join.");
  report.def_property_readonly("curve_joins", &curve_joins_of,
                               "The joins of curves, end to end, a tuple of CurveJoin.");
  report.def_property_readonly("summary", &summary_record, "A ReportSummary: counts, largest gap, largest angle.");
  report.def_property_readonly(
      "outcome", [](const Report& r) { return kOutcomes[summary_of(r).outcome]; },
      "\"pass\", \"fail\" or \"undecided\", over everything that was asked; \"pass\" when nothing was.");
  report.def(
      "to_json", [](const Report& r) { return text_of(r, PATCHPROOF_REPORT_JSON); }, R"(to_json(self)
--

The report as a text, the document that docs/formats.md describes ("Report"): exact numbers, reasons, witnesses.)");
  report.def(
      "table", [](const Report& r) { return text_of(r, PATCHPROOF_REPORT_TABLE); }, R"(table(self)
--

The table that people read, worst joins first.)");
  report.def("__bool__", [](const Report&) -> bool {
    throw py::type_error("a Report is neither true nor false: ask for report.outcome");
  });
  report.def("__copy__", [](const py::object& r) { return r; });
  report.def("__deepcopy__", [](const py::object& r, const py::object&) { return r; });
  report.def("__repr__", [](const Report& r) {
    const auto s = summary_of(r);
    const py::object bounds = member("_values", "Bounds");
    const auto shown = [&](const double(&b)[2]) { return std::string(py::repr(bounds(b[0], b[1]))); };
    std::string out = "<patchproof.Report: " + std::string(kOutcomes[s.outcome]) + ", " + std::to_string(s.joins) +
                      " joins, gap " + shown(s.largest_gap) + ", angle " + shown(s.largest_angle) + " degrees";
    if (s.curve_joins > 0) out += ", " + std::to_string(s.curve_joins) + " joins of curves";
    return out + ">";
  });

  module.def(
      "certify", &certify, py::arg("model"), py::arg("require") = py::none(), py::arg("gap") = py::none(),
      py::arg("angle") = py::none(), py::kw_only(), py::arg("curvature") = py::none(), py::arg("profile") = py::none(),
      py::arg("seconds_per_join") = 10.0, py::arg("match") = py::none(), py::arg("jobs") = 0,
      py::arg("progress") = py::none(),
      R"(certify(model, require=None, gap=None, angle=None, *, curvature=None, profile=None, seconds_per_join=10.0, match=None, jobs=0, progress=None)
--

Finds the joins of the patches, or takes the declared ones, and proves, refutes or bounds each: a Report.

require           "C0", "C1" or "G1": every join must be proven of this class
gap               a length that no gap may exceed
angle             degrees that no angle between the normals may exceed
curvature         of joins of curves: largest difference of curvature vectors, 1/length
profile           thresholds for what is not given here, by the name that the program's --profile takes: "vda4955"
seconds_per_join  then a join ends undecided
match             edges within this length are looked at; None: 1e-6 of the model's diagonal
jobs              threads; 0: one for each processor. The report does not depend on it
progress          a function of (done, all) that is called some twenty times a second, `all` None while it is not known. What
                  it raises stops the work and comes out of certify. Ctrl-C stops it too: KeyboardInterrupt.)");
}

}  // namespace patchproof::python
