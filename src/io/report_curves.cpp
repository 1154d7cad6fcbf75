// SPDX-License-Identifier: Apache-2.0
#include "report_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "gerbs_splines.h"
#include "patchproof/parallel.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {
namespace {

template <ExactField T>
using Curves = std::vector<CurveOfFile<T>>;

// Curves of several files, one after the other.
template <ExactField T>
struct Together {
  std::vector<const CurveOfFile<T>*> curves;
  std::vector<int> file;
  std::vector<char> is_cad;
};

template <ExactField T>
ReportedCurveSide reported_side(const CurveOfFile<T>& c, const EndOfCurve& of) {
  const KnotVector<T>& knots = c.curve.knots();
  return {of, to_text(of.end == CurveEnd::begin ? knots.domain_begin() : knots.domain_end())};
}

template <ExactField T>
std::array<double, 3> end_point(const BsplineCurve<T, 4>& curve, CurveEnd end) {
  const bool begin = end == CurveEnd::begin;
  const Vec<T, 3> p = evaluate_rational(curve, begin ? curve.knots().domain_begin() : curve.knots().domain_end(),
                                        begin ? Side::right : Side::left);
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}

EdgeClass class_of(const std::optional<Enclosure>& angle, double smooth_below) {
  if (!angle) return EdgeClass::undecided;
  if (angle->upper <= kSmoothDegrees) return EdgeClass::smooth;
  if (angle->lower > smooth_below) return EdgeClass::sharp;
  return angle->lower > kSmoothDegrees && angle->upper <= smooth_below ? EdgeClass::kinked : EdgeClass::undecided;
}

// What is asked of a join: beside patches nothing, and a sharp corner of a CAD model is meant.
Judgement judge_join(const ReportedCurveJoin& join, const CertifyOptions& options, bool beside_patches) {
  if (beside_patches) return {};
  Request request = options.profile ? options.given : options.request;
  std::optional<double> curvature = options.curvature_tolerance;
  if (join.edge_class == EdgeClass::sharp) {
    if (request.require) request.require = Continuity::c0;
    request.angle_tolerance.reset();
    curvature.reset();
  }
  return judge(join.certificate, request, curvature);
}

template <ExactField T>
void certify_into(Report& whole, const Together<T>& all, const CertifyOptions& options) {
  CurveReport& report = *whole.curves;
  const bool beside_patches = !whole.patch_names.empty();
  std::vector<const BsplineCurve<T, 4>*> curves;
  std::vector<std::array<double, 2>> tolerances;
  for (std::size_t i = 0; i < all.curves.size(); ++i) {
    curves.push_back(&all.curves[i]->curve);
    tolerances.push_back(all.curves[i]->tolerance);
    report.curves.push_back({all.file[i], all.curves[i]->name});
  }
  CurveEndMatch match = match_curve_ends(curves, options.match_length, tolerances);
  const auto is_outline = [&](const EndOfCurve& end) { return all.curves[end.curve]->is_outline; };
  report.left_out =
      !beside_patches && std::any_of(all.curves.begin(), all.curves.end(), [](const auto* c) { return c->is_outline; });
  std::erase_if(match.pairs, [&](const auto& pair) { return is_outline(pair.first) || is_outline(pair.second); });
  std::erase_if(match.free, is_outline);
  report.match_length = match.length;
  if (!beside_patches) {
    whole.match_length = match.length;
    whole.diagonal = match.diagonal;
  }
  report.free = std::move(match.free);
  report.crowded = match.crowded;
  if (!beside_patches) report.curvature_tolerance = options.curvature_tolerance;
  report.joins.resize(match.pairs.size());
  const Request& asked = options.profile ? options.given : options.request;
  const CurveTolerances tolerance{asked.gap_tolerance, asked.angle_tolerance, options.curvature_tolerance};
  std::atomic<std::size_t> done{0};
  for_each_item(options.jobs, match.pairs.size(), [&](std::size_t i) {
    const auto& [a, b] = match.pairs[i];
    ReportedCurveJoin& out = report.joins[i];
    out.id = static_cast<int>(i) + 1;
    out.a = reported_side(*all.curves[a.curve], a);
    out.b = reported_side(*all.curves[b.curve], b);
    out.point = end_point(*curves[a.curve], a.end);
    out.certificate = certify_curve_join<T>({curves[a.curve], a.end}, {curves[b.curve], b.end});
    if (all.is_cad[a.curve] && all.is_cad[b.curve])
      out.edge_class = class_of(out.certificate.angle, options.smooth_below);
    out.within = class_within(out.certificate, tolerance);
    out.judgement = judge_join(out, options, beside_patches);
    const std::size_t now = ++done;
    if (options.progress) options.progress(now, match.pairs.size());
  });
}

Quadratic in_quadratic(const Rational& x) { return Quadratic(x); }

CurveOfFile<Quadratic> in_quadratic(const CurveOfFile<Rational>& c) {
  std::vector<Quadratic> knots;
  for (const Rational& t : c.curve.knots().knots()) knots.push_back(in_quadratic(t));
  std::vector<Vec<Quadratic, 4>> points;
  for (const auto& p : c.curve.points())
    points.push_back({{in_quadratic(p[0]), in_quadratic(p[1]), in_quadratic(p[2]), in_quadratic(p[3])}});
  return {c.name,
          BsplineCurve<Quadratic, 4>(KnotVector<Quadratic>::make_unchecked(c.curve.degree(), std::move(knots)),
                                     std::move(points)),
          c.tolerance, c.is_outline};
}

// The square root in a file's numbers; 1: none.
int root_of(const Curves<Quadratic>& curves) {
  for (const CurveOfFile<Quadratic>& c : curves) {
    for (const Quadratic& t : c.curve.knots().knots())
      if (!t.is_rational()) return t.root();
    for (const auto& p : c.curve.points())
      for (const Quadratic& x : p.c)
        if (!x.is_rational()) return x.root();
  }
  return 1;
}

template <ExactField T>
void append(Together<T>& all, const Curves<T>& curves, int file, bool is_cad) {
  for (const CurveOfFile<T>& c : curves) {
    all.curves.push_back(&c);
    all.file.push_back(file);
    all.is_cad.push_back(is_cad);
  }
}

std::string plain_units(const std::string& units) { return units.substr(0, units.find(" (file")); }

}  // namespace

CurveFile curves_of(const ModelFile& file) {
  CurveFile out{{file.path, file.format, file.sha256, file.decimals}, "", file.notes, false, {}};
  std::visit(
      [&]<class T>(const Model<T>& model) {
        out.units = model.units;
        Curves<T> curves;
        if (!has_gerbs(model)) {
          for (const ModelCurve<T>& c : model.curves) curves.push_back({c.name, c.curve, {}, false});
        } else {
          const SplineModel<T> splines = gerbs_to_splines(model);
          for (const ModelCurve<T>& c : splines.model.curves) curves.push_back({c.name, c.curve, {}, false});
          for (const std::size_t i : splines.outlined_curves) {
            curves[i].is_outline = true;
            out.notes.push_back(
                fmt::format("curve {}: a GERBS curve that is not expanded to a spline; its ends are not looked at", i));
          }
        }
        out.curves = std::move(curves);
      },
      file.model);
  return out;
}

CurveFile curves_of(const CadModel& model) {
  CurveFile out{{model.path, model.format, model.sha256, Decimals::binary64}, model.units, model.notes, true, {}};
  Curves<Rational> curves;
  for (const CadCurve& c : model.curves) curves.push_back({c.label, c.curve, c.tolerance});
  out.curves = std::move(curves);
  return out;
}

void add_curve_joins(Report& report, const CurveFile& file, const CertifyOptions& options) {
  std::visit(
      [&]<class T>(const Curves<T>& curves) {
        if (curves.empty()) return;
        report.curves.emplace();
        report.curves->files = {file.file};
        Together<T> all;
        append(all, curves, 0, file.is_cad);
        certify_into(report, all, options);
      },
      file.curves);
}

Result<Report> certify_curve_files(const std::vector<CurveFile>& files, const CertifyOptions& options) {
  PATCHPROOF_REQUIRES(!files.empty(), "certify_curve_files: at least one file");
  Report report;
  report.request = options.request;
  report.profile = options.profile;
  report.file = files.front().file.path;
  report.format = files.front().file.format;
  report.sha256 = files.front().file.sha256;
  report.decimals = files.front().file.decimals;
  report.curves = CurveReport{};
  const CurveFile* with_units = nullptr;
  const CurveFile* with_root = nullptr;
  int root = 1;
  for (const CurveFile& f : files) {
    report.curves->files.push_back(f.file);
    for (const std::string& note : f.notes) report.notes.push_back(files.size() > 1 ? f.file.path + ": " + note : note);
    if (!f.units.empty()) {
      if (with_units && plain_units(with_units->units) != plain_units(f.units))
        return Error{ErrorCode::usage, f.file.path, "its units are not those of " + with_units->file.path,
                     plain_units(f.units) + ", " + plain_units(with_units->units)};
      if (!with_units) with_units = &f;
    }
    if (const auto* curves = std::get_if<Curves<Quadratic>>(&f.curves)) {
      const int own = root_of(*curves);
      if (own == 1) continue;
      if (with_root && own != root)
        return Error{ErrorCode::mixed_roots, f.file.path, "its square root is not that of " + with_root->file.path,
                     "sqrt(" + std::to_string(own) + "), sqrt(" + std::to_string(root) + ")"};
      root = own;
      with_root = &f;
    }
  }
  if (with_units) report.units = with_units->units;
  const bool rational = std::all_of(files.begin(), files.end(), [](const CurveFile& f) {
    return std::holds_alternative<Curves<Rational>>(f.curves);
  });
  if (rational) {
    Together<Rational> all;
    for (std::size_t i = 0; i < files.size(); ++i)
      append(all, std::get<Curves<Rational>>(files[i].curves), static_cast<int>(i), files[i].is_cad);
    certify_into(report, all, options);
    return report;
  }
  std::vector<Curves<Quadratic>> lifted(files.size());
  Together<Quadratic> all;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto* own = std::get_if<Curves<Quadratic>>(&files[i].curves);
    if (!own)
      for (const CurveOfFile<Rational>& c : std::get<Curves<Rational>>(files[i].curves))
        lifted[i].push_back(in_quadratic(c));
    append(all, own ? *own : lifted[i], static_cast<int>(i), files[i].is_cad);
  }
  certify_into(report, all, options);
  return report;
}

}  // namespace patchproof
