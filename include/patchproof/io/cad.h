// SPDX-License-Identifier: Apache-2.0
// CAD models: faces with trimmed surfaces, and the edges where they meet, from STEP, IGES and BREP files.
//
// Numbers are the doubles that Open CASCADE delivers, taken exactly. Every surface becomes a B-spline (rational where it
// must be): planes, cylinders, cones, spheres, tori, extrusions and revolutions exactly as Open CASCADE's conversion of
// surfaces and parameter curves together has it; what it approximates is said in a note.
//
// read_cad_model stands in the optional target patchproof::occt; certify_cad needs no Open CASCADE.
//
// ENSURES  (1) every edge of the file is listed once, as what it is: shared, seam, free, more than two faces, degenerate, a
//          curve by itself when no face uses it, or unusable with a reason;  (2) what Open CASCADE's readers deliver is taken as it is: no gap closed, no tolerance
//          changed, no edge merged;  (3) the denominators of all surfaces are certified to have no zero; a face that is not
//          usable is refused, or left out, listed with the reason, and its edges are unusable;  (4) a face that stands in
//          several places of an assembly is as many faces, each in its place;  (5) certify_cad's report does not depend on
//          the number of jobs;  (6) where a surface is approximated, that is said with its figures, and a tolerance is
//          passed or failed only if it is with what they may add or take;  (7) any number of threads may read: Open CASCADE
//          keeps settings of the process, so they wait for each other, and std::cout and std::cerr are silent meanwhile.
// ERRORS   of read_cad_model: cannot_open, empty_input, syntax (Open CASCADE cannot read the file, or a part of a face; in BREP
//          files with the line), bad_reference (BREP: an index of nothing), wrong_count (neither faces nor edges); of the first face
//          that is not usable, whose label stands in `where`: unsupported, vanishing_weight, bad_number and those of knots.
// TEST     tests/io/cad_test.cpp; tests/io/occt/read_threads_test.cpp (7)
#pragma once

#include <array>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/report.h"
#include "patchproof/join/trimmed_join.h"

namespace patchproof {

struct CadFace {
  std::string label;  // "#123" in STEP files, "face 7"; with the name if there is one
  std::string kind;   // of the surface in the file: "plane", "cylinder", …
  BsplinePatch<Rational, 4> surface;
  Approximation approximation = {};
};

enum class CadEdgeKind {
  shared,        // by two faces
  seam,          // twice of one face
  free,          // of one face
  non_manifold,  // of more than two
  degenerate,    // shrunk to a point, as in the pole of a sphere
  unusable       // see the note
};
const char* to_string(CadEdgeKind kind);

// Normals at an edge are compared by the side on which the faces lie, so that faces of one shell that are turned
// differently do not look folded.
struct CadUse {
  int face;
  bool forward;                          // the face lies to the left of its parameter curve in the (u, v) plane
  BsplineCurve<Rational, 3> parameters;  // homogeneous (w·u, w·v, w), over the edge's range
  Approximation approximation = {};      // along the edge
};

struct CadEdge {
  std::string label;  // "#45", "edge 12"
  CadEdgeKind kind;
  std::vector<CadUse> uses;
  double tolerance = 0;  // of the file, model units
  std::string note;      // why it is unusable, or what is odd
};

// A face of the file that cannot be used.
struct LeftOutFace {
  std::string label;
  ErrorCode code;
  std::string reason;
};

// An edge of no face, over its range.
struct CadCurve {
  std::string label;
  std::string kind;                      // of the curve in the file: "line", "circle", …
  BsplineCurve<Rational, 4> curve;       // homogeneous, run through as its curve in the file
  std::array<double, 2> tolerance = {};  // of the file at its begin and its end, model units
};

struct CadModel {
  std::string path, format, sha256, units;
  std::vector<CadFace> faces;
  std::vector<LeftOutFace> left_out;
  std::vector<CadEdge> edges;
  std::vector<CadCurve> curves;
  std::vector<std::string> notes;
};

// By extension (.step .stp .iges .igs .brep .rle) or content.
bool looks_like_cad(const std::string& path);

// Only in the target patchproof::occt.
enum class UnusableFaces { refuse, leave_out };
Result<CadModel> read_cad_model(const std::string& path, UnusableFaces unusable = UnusableFaces::refuse);

// Every shared edge and seam, each pair of neighbours at an edge of more than two faces, and the ends of curves that meet.
Report certify_cad(const CadModel& model, const CertifyOptions& options = {});

}  // namespace patchproof
