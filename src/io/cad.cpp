// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/cad.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>

#include "edge_class.h"
#include "patchproof/parallel.h"
#include "patchproof/scalar/parse_scalar.h"
#include "report_curves.h"
#include "report_profile.h"
#include "report_text.h"
#include "source_file.h"

namespace patchproof {
namespace {

struct Pair {
  int edge;
  const CadUse *a, *b;
};

bool is_join(CadEdgeKind kind) {
  return kind == CadEdgeKind::shared || kind == CadEdgeKind::seam || kind == CadEdgeKind::non_manifold;
}

// The joins of a model: neighbours at each edge.
std::vector<Pair> pairs_of(const CadModel& model) {
  std::vector<Pair> out;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    const CadEdge& edge = model.edges[e];
    if (!is_join(edge.kind)) continue;
    for (std::size_t i = 0; i + 1 < edge.uses.size(); ++i)
      out.push_back({static_cast<int>(e), &edge.uses[i], &edge.uses[i + 1]});
  }
  return out;
}

ReportedSide reported_side(const CadUse& use, const std::string& edge) {
  const KnotVector<Rational>& range = use.parameters.knots();
  return {use.face,
          edge,
          nearest_double(range.domain_begin()),
          nearest_double(range.domain_end()),
          to_text(range.domain_begin()),
          to_text(range.domain_end())};
}

}  // namespace

const char* to_string(CadEdgeKind kind) {
  switch (kind) {
    case CadEdgeKind::shared: return "shared";
    case CadEdgeKind::seam: return "seam";
    case CadEdgeKind::free: return "free";
    case CadEdgeKind::non_manifold: return "non-manifold";
    case CadEdgeKind::degenerate: return "degenerate";
    case CadEdgeKind::unusable: return "unusable";
  }
  return "unknown";
}

bool looks_like_cad(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;  // a pipe would be waited for
  std::ifstream in(path, std::ios::binary);
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return begins_cad_file(head);
}

Report certify_cad(const CadModel& model, const CertifyOptions& options) {
  Report report;
  report.file = model.path;
  report.format = model.format;
  report.sha256 = model.sha256;
  report.units = model.units;
  report.decimals = Decimals::binary64;
  report.notes = model.notes;
  begin_request(report, options);
  for (const CadFace& face : model.faces) report.patch_names.push_back(face.label);
  report.cad = CadReport{options.smooth_below, {}, {}, {}};
  for (const LeftOutFace& face : model.left_out) report.cad->left_out.push_back({face.label, face.reason});
  for (const CadEdge& edge : model.edges) {
    if (!is_join(edge.kind)) report.cad->no_joins.push_back({edge.label, to_string(edge.kind), edge.note});
    if (!edge.note.empty()) report.notes.push_back(named("edge", edge.label) + ": " + edge.note);
  }
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    if (const Approximation& by = model.faces[f].approximation; by.length > 0)
      report.cad->approximated.push_back({static_cast<int>(f), by});
  const std::vector<Pair> pairs = pairs_of(model);
  report.joins.resize(pairs.size());
  std::atomic<std::size_t> done{0};
  for_each_item(options.jobs, pairs.size(), [&](std::size_t i) {
    const auto [e, a, b] = pairs[i];
    const CadEdge& edge = model.edges[e];
    // Across a smooth edge one face lies to the left and the other to the right, under equal normals.
    const auto side = [&](const CadUse& use, bool flipped) {
      return TrimmedSide{&model.faces[use.face].surface, use.parameters, flipped};
    };
    ReportedJoin& out = report.joins[i];
    const TrimmedJoin join{side(*a, !a->forward), side(*b, b->forward)};
    out.id = static_cast<int>(i) + 1;
    out.kind = edge.kind == CadEdgeKind::seam ? JoinKind::seam : JoinKind::trimmed;
    out.a = reported_side(*a, edge.label);
    out.b = reported_side(*b, edge.label);
    const auto deadline = seconds_from_now(options.request.seconds_per_join);  // of both together
    out.certificate = certify_trimmed(join, options.request);
    out.approximation = {a->approximation.length + b->approximation.length,
                         a->approximation.degrees + b->approximation.degrees};
    const Certificate wide = widened(out.certificate, out.approximation);
    out.edge_class = edge_class_of(join, wide, options.smooth_below, deadline);
    out.judgement = judge_edge(wide, *out.edge_class, options.smooth_below, request_at(options, out.kind));
    if (out.judgement.outcome == Outcome::undecided && out.approximation.length > 0 &&
        judge_edge(out.certificate, *out.edge_class, options.smooth_below, request_at(options, out.kind)).outcome !=
            Outcome::undecided)
      out.judgement.reason += "; without what the approximation of a surface may add it would be decided";
    const std::size_t now = ++done;
    if (options.progress) options.progress(now, pairs.size());
  });
  add_curve_joins(report, curves_of(model), options);
  return report;
}

}  // namespace patchproof
