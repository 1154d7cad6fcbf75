// SPDX-License-Identifier: Apache-2.0
// From a model to a report: find the joins, certify them, judge them against the request, print.
//
// ENSURES  (1) write_json prints the document of docs/formats.md ("Report"), schema 1, one line per join, and the same bytes
//          for the same input and request, whatever the number of jobs (unless a join ran out of its time);
//          (2) write_table prints the same facts for people, worst join first;
//          (3) bounds are rounded outward and printed so that they read back as the same doubles;
//          (4) with a profile each join is judged by the criteria that speak of its kind, under their codes, and the criteria
//          that cannot be checked are listed as such.
#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "patchproof/io/model.h"
#include "patchproof/join/certificate.h"
#include "patchproof/join/curve_join.h"
#include "patchproof/join/edge_match.h"
#include "patchproof/join/gregory_proof.h"

namespace patchproof {

struct Profile;

struct ReportedSide {
  int patch = 0;
  std::string edge;                    // "u_min", or "u = 1/2" for a line inside the patch
  double begin = 0, end = 1;           // parameters, in the order in which the join runs through them
  std::string exact_begin, exact_end;  // the same as exact numbers
};

// Edges of CAD models by the angle between the faces' normals. Below kSmoothDegrees it is not seen in a reflection.
enum class EdgeClass {
  smooth,    // nowhere above kSmoothDegrees
  kinked,    // above that somewhere, and nowhere above CertifyOptions::smooth_below
  sharp,     // everywhere above smooth_below: meant to be an edge
  mixed,     // above smooth_below in one place, not in another
  undecided  // the bounds do not tell
};
inline constexpr double kSmoothDegrees = 0.1;
const char* to_string(EdgeClass edge_class);

// How far B-splines are from the surfaces that they stand for, by figures of Open CASCADE and by samples: no certified bounds.
struct Approximation {
  double length = 0;   // model units; 0: surfaces are taken exactly
  double degrees = 0;  // between normals
};

struct ReportedJoin {
  int id = 0;  // 1-based
  ReportedSide a, b;
  JoinKind kind = JoinKind::isoparametric;
  bool reversed = false;
  PairingKind pairing = PairingKind::identity;
  // Exact parameters on both sides that belong together, for a piecewise linear pairing; else the ranges say it all.
  std::vector<std::array<std::string, 2>> pairing_nodes;
  std::string pairing_ratio;  // exact r of a rational linear pairing, else ""
  Certificate certificate;
  Judgement judgement;
  std::optional<EdgeClass> edge_class;  // of CAD models
  Approximation approximation;          // of both surfaces together along the edge; the bounds do not contain it
};

// An edge of a CAD model that is no join.
struct ReportedEdge {
  std::string label, kind, note;  // kind: "free", "degenerate", "unusable"
};

struct ReportedFace {
  std::string label, reason;
};
struct ApproximatedFace {
  int patch;
  Approximation by;
};

// What only CAD models have.
struct CadReport {
  double smooth_below = 0;             // degrees
  std::vector<ReportedFace> left_out;  // faces that are not usable
  std::vector<ReportedEdge> no_joins;
  std::vector<ApproximatedFace> approximated = {};
};

struct ReportedFile {
  std::string path, format, sha256;
  Decimals decimals = Decimals::exact;
};

struct ReportedCurve {
  int file = 0;  // of CurveReport::files
  std::string name;
};

struct ReportedCurveSide {
  EndOfCurve of;
  std::string parameter;  // exact
};

// Two ends of curves that meet.
struct ReportedCurveJoin {
  int id = 0;  // 1-based
  ReportedCurveSide a, b;
  std::array<double, 3> point{};  // the end of a
  CurveCertificate certificate;
  std::string within;  // class_within the tolerances asked for
  Judgement judgement;
  std::optional<EdgeClass> edge_class;  // of curves of CAD models, by the tangent angle
};

// What only models with curves have.
struct CurveReport {
  std::vector<ReportedFile> files;
  std::vector<ReportedCurve> curves;
  std::vector<ReportedCurveJoin> joins;
  std::vector<EndOfCurve> free;
  bool left_out = false;  // ends of GERBS curves that are no splines
  bool crowded = false;   // some pairs are left out: more than kMostPartners meet at one end
  double match_length = 0;
  std::optional<double> curvature_tolerance;
};

// A Gregory patch by itself.
struct ReportedGregoryPatch {
  int patch = 0;
  GregoryProof proof;
};

struct Report {
  std::string file, format, sha256, units;
  Decimals decimals = Decimals::exact;
  std::vector<std::string> patch_names, notes;
  Request request;                   // with the tolerances of the profile
  const Profile* profile = nullptr;  // one of all_profiles()
  double match_length = 0, diagonal = 0;
  std::vector<ReportedJoin> joins;
  std::vector<EdgeRange> unmatched;
  std::vector<CollapsedEdge> collapsed;
  std::vector<ReportedGregoryPatch> gregory_patches;  // of models over Q
  std::optional<CadReport> cad;
  std::optional<CurveReport> curves;
  std::optional<double> seconds;  // that certifying took, where it is to be reported: no two runs take the same

  // pass, fail or undecided over all joins, those of curves as well; undecided when something was asked and there is no
  // join, or a face or an edge could not be looked at.
  Outcome outcome() const;
};

struct CertifyOptions {
  Request request;
  // With a profile (one of all_profiles()): `request` is tolerances_of(profile, units, given).
  const Profile* profile = nullptr;
  Request given;
  std::optional<double> curvature_tolerance;                        // of joins of curves, 1/model units
  double match_length = 0;                                          // 0: 1e-6 of the diagonal
  double smooth_below = 5;                                          // degrees: see EdgeClass
  int jobs = 0;                                                     // 0: one thread per processor
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread
};

// Declared joins of the model are taken as they are; without any, the geometry decides.
Report certify_model(const ModelFile& file, const CertifyOptions& options = {});

void write_json(std::ostream& out, const Report& report);

struct TableStyle {
  bool quiet = false;  // only the summary
  bool color = false;
};
void write_table(std::ostream& out, const Report& report, const TableStyle& style = {});

}  // namespace patchproof
