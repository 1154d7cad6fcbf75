// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/report.h"

#include <fmt/format.h>

#include <limits>

#include "gerbs_splines.h"
#include "patchproof/join/certify.h"
#include "patchproof/join/gerbs_join.h"
#include "report_curves.h"
#include "report_profile.h"
#include "report_surfaces.h"

namespace patchproof {
namespace {

template <ExactField T>
ReportedSide reported_side(const BsplinePatch<T, 4>& patch, int index, const IsoLine<T>& line,
                           const std::vector<T>& nodes) {
  ReportedSide side{index,
                    "",
                    nearest_double(nodes.front()),
                    nearest_double(nodes.back()),
                    to_text(nodes.front()),
                    to_text(nodes.back())};
  for (const EdgeName edge : {EdgeName::u_min, EdgeName::u_max, EdgeName::v_min, EdgeName::v_max}) {
    const IsoLine<T> candidate = edge_line(patch, edge);
    if (candidate.constant == line.constant && candidate.value == line.value && candidate.side == line.side)
      side.edge = to_string(edge);
  }
  if (side.edge.empty())
    side.edge = std::string(line.constant == Direction::u ? "u" : "v") + " = " + to_text(line.value) +
                (line.side == Side::left ? "-" : "+");
  return side;
}

// Patches that are outlines of GERBS surfaces: by their number, else null.
template <ExactField T>
using Outlined = std::vector<const GerbsSurface<T, 4>*>;

// Joins at outlines are bounded with the surfaces themselves; over Q(√d) they
// stay undecided.
template <ExactField T>
std::vector<Certificate> certify_all(const std::vector<const BsplinePatch<T, 4>*>& surfaces,
                                     const std::vector<Join<T>>& joins, const Outlined<T>& outlined,
                                     const CertifyOptions& options, const std::function<void(std::size_t)>& progress) {
  const auto gerbs = [&](int surface) {
    return static_cast<std::size_t>(surface) < outlined.size() ? outlined[surface] : nullptr;
  };
  std::vector<Join<T>> of_splines, of_gerbs;
  for (const Join<T>& j : joins) (gerbs(j.patch_a) || gerbs(j.patch_b) ? of_gerbs : of_splines).push_back(j);
  std::vector<Certificate> plain = certify_joins(surfaces, of_splines, options.request, options.jobs, progress),
                           blended;
  if constexpr (std::is_same_v<T, Rational>) {
    std::vector<BlendedSide> sides;
    for (std::size_t i = 0; i < surfaces.size(); ++i) sides.push_back({surfaces[i], gerbs(static_cast<int>(i))});
    blended = certify_blended_joins(sides, of_gerbs, options.request, options.jobs);
  } else {
    Certificate unknown;
    unknown.gap = {0, std::numeric_limits<double>::infinity(), {}, false};
    unknown.angle = {0, 180, {}, false};
    unknown.plane_angle = {0, 90, {}, false};
    unknown.rung = "taylor";
    for (ExactClass* c : {&unknown.c0, &unknown.c1, &unknown.c2, &unknown.g1})
      c->reason = "transcendental GERBS surfaces are bounded in models over Q only";
    blended.assign(of_gerbs.size(), unknown);
  }
  std::vector<Certificate> out;
  auto next_plain = plain.begin(), next_blended = blended.begin();
  for (const Join<T>& j : joins)
    out.push_back(std::move(gerbs(j.patch_a) || gerbs(j.patch_b) ? *next_blended++ : *next_plain++));
  return out;
}

template <ExactField T>
void certify_into(Report& report, const Model<T>& model, const CertifyOptions& options, const Outlined<T>& outlined) {
  for (const ModelPatch<T>& patch : model.patches) report.patch_names.push_back(patch.name);
  for (const ModelGregoryPatch<T>& patch : model.gregory_patches) report.patch_names.push_back(patch.name);
  ReportSurfaces<T> surfaces(model);
  const std::vector<const BsplinePatch<T, 4>*>& patches = surfaces.all();
  report.units = model.units;
  begin_request(report, options);
  EdgeMatch<T> match = match_edges(patches, options.match_length,
                                   [&](int surface, EdgeName edge) { return surfaces.is_edge(surface, edge); });
  surfaces.rename(match);
  if (!model.joins.empty()) {
    // The file says which edges meet; the lines inside patches are looked at
    // all the same.
    std::erase_if(match.joins, [](const Join<T>& j) { return j.kind != JoinKind::knot_line; });
    std::vector<Join<T>> joins;
    for (const DeclaredJoin& d : model.joins)
      joins.push_back(whole_edge_join(patches, surfaces.carrier(d.patch_a, d.edge_a), d.edge_a,
                                      surfaces.carrier(d.patch_b, d.edge_b), d.edge_b, d.reversed));
    joins.insert(joins.end(), match.joins.begin(), match.joins.end());
    match.joins = std::move(joins);
    match.unmatched.clear();
    for (std::size_t p = 0; p < report.patch_names.size(); ++p)
      for (const EdgeName edge : {EdgeName::u_min, EdgeName::u_max, EdgeName::v_min, EdgeName::v_max}) {
        const auto is_edge = [&](int patch, EdgeName name) { return patch == static_cast<int>(p) && name == edge; };
        const bool used = std::any_of(model.joins.begin(), model.joins.end(), [&](const DeclaredJoin& d) {
          return is_edge(d.patch_a, d.edge_a) || is_edge(d.patch_b, d.edge_b);
        });
        const bool collapsed = std::any_of(match.collapsed.begin(), match.collapsed.end(),
                                           [&](const CollapsedEdge& c) { return is_edge(c.patch, c.edge); });
        if (used || collapsed) continue;
        const BsplinePatch<T, 4>& surface = *patches[surfaces.carrier(static_cast<int>(p), edge)];
        const KnotVector<T>& along = surface.knots(other(edge_line(surface, edge).constant));
        match.unmatched.push_back(
            {static_cast<int>(p), edge, nearest_double(along.domain_begin()), nearest_double(along.domain_end())});
      }
  }
  report.match_length = match.length;
  report.diagonal = match.diagonal;
  report.unmatched = std::move(match.unmatched);
  report.collapsed = std::move(match.collapsed);
  std::function<void(std::size_t)> progress;
  if (options.progress) progress = [&](std::size_t done) { options.progress(done, match.joins.size()); };
  std::vector<Certificate> certificates = certify_all(patches, match.joins, outlined, options, progress);
  report.joins.reserve(certificates.size());
  const auto add = [&](const Join<T>& join, Certificate certificate) {
    ReportedJoin out;
    out.id = static_cast<int>(report.joins.size()) + 1;
    out.kind = join.kind;
    out.a = reported_side(*patches[join.patch_a], surfaces.patch_of(join.patch_a), join.line_a, join.pairing.a);
    out.b = reported_side(*patches[join.patch_b], surfaces.patch_of(join.patch_b), join.line_b, join.pairing.b);
    out.reversed = join.pairing.reversed();
    out.pairing = join.pairing.kind;
    if (join.pairing.kind == PairingKind::piecewise_linear)
      for (std::size_t k = 0; k < join.pairing.a.size(); ++k)
        out.pairing_nodes.push_back({to_text(join.pairing.a[k]), to_text(join.pairing.b[k])});
    if (join.pairing.kind == PairingKind::rational_linear) out.pairing_ratio = to_text(join.pairing.ratio);
    out.certificate = std::move(certificate);
    out.judgement = judge(out.certificate, request_at(options, join.kind));
    report.joins.push_back(std::move(out));
  };
  for (std::size_t i = 0; i < certificates.size(); ++i) add(match.joins[i], std::move(certificates[i]));
  if constexpr (std::is_same_v<T, Rational>)
    for (std::size_t p = 0; p < outlined.size(); ++p) {
      if (!outlined[p]) continue;
      for (InnerLine& line : certify_inner_lines(*outlined[p], options.request)) {
        line.join.patch_a = line.join.patch_b = static_cast<int>(p);
        add(line.join, std::move(line.certificate));
      }
    }
  if constexpr (std::is_same_v<T, Rational>) {
    std::vector<const GregoryPatch<Rational>*> gregory;
    for (const ModelGregoryPatch<T>& patch : model.gregory_patches) gregory.push_back(&patch.patch);
    const std::vector<GregoryProof> proofs = prove_patches(gregory, options.jobs);
    for (std::size_t i = 0; i < proofs.size(); ++i)
      report.gregory_patches.push_back({static_cast<int>(model.patches.size() + i), proofs[i]});
  }
}

}  // namespace

Outcome Report::outcome() const {
  // Something was asked and nothing could be looked at: that is no pass.
  const bool asked =
      request.require || request.gap_tolerance || request.angle_tolerance || (curves && curves->curvature_tolerance);
  const bool blind =
      cad && (!cad->left_out.empty() || std::any_of(cad->no_joins.begin(), cad->no_joins.end(),
                                                    [](const ReportedEdge& edge) { return edge.kind == "unusable"; }));
  // A profile asks nothing of curves.
  const bool nothing = joins.empty() && (profile || !curves || curves->joins.empty());
  const bool crowded = curves && (curves->crowded || curves->left_out);
  Outcome worst = asked && (nothing || blind || crowded) ? Outcome::undecided : Outcome::pass;
  for (const ReportedJoin& join : joins) {
    if (join.judgement.outcome == Outcome::fail) return Outcome::fail;
    if (join.judgement.outcome == Outcome::undecided) worst = Outcome::undecided;
  }
  for (std::size_t i = 0; curves && i < curves->joins.size(); ++i) {
    const Outcome outcome = curves->joins[i].judgement.outcome;
    if (outcome == Outcome::fail) return Outcome::fail;
    if (outcome == Outcome::undecided) worst = Outcome::undecided;
  }
  return worst;
}

Report certify_model(const ModelFile& file, const CertifyOptions& options) {
  Report report;
  report.file = file.path;
  report.format = file.format;
  report.sha256 = file.sha256;
  report.decimals = file.decimals;
  report.notes = file.notes;
  std::visit(
      [&]<class T>(const Model<T>& model) {
        if (!has_gerbs(model)) return certify_into(report, model, options, {});
        SplineModel<T> splines = gerbs_to_splines(model);
        report.notes.insert(report.notes.end(), splines.notes.begin(), splines.notes.end());
        Outlined<T> outlined(splines.model.patches.size());
        for (const std::size_t i : splines.outlined_patches) {
          outlined[i] = &model.gerbs_patches[i - model.patches.size()].surface;
          report.notes.push_back(fmt::format("patch {}: GERBS surface with {}, bounded by Taylor models", i,
                                             outlined[i]->b_function().to_string()));
        }
        certify_into(report, splines.model, options, outlined);
      },
      file.model);
  const CurveFile curves = curves_of(file);
  report.notes.insert(report.notes.end(), curves.notes.begin() + static_cast<std::ptrdiff_t>(file.notes.size()),
                      curves.notes.end());
  add_curve_joins(report, curves, options);
  return report;
}

}  // namespace patchproof
