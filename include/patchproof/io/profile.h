// SPDX-License-Identifier: Apache-2.0
// Profiles of thresholds: what standards, programs and car makers allow at a join, by name.
//
// A profile is a list of criteria with their codes in SASIG's guideline on product data quality (PDQ) and the names of their
// entities in ISO 10303-59. Two quantities are judged today: the gap and the angle between the normals along a join. What a
// profile asks beyond (curvature, curves, the edge's distance from its faces) is listed as not checked, never as passed.
//
// Which joins a criterion speaks of: those between faces of a shell, or those between the patches of one surface.
//   trimmed (an edge between two faces)       faces
//   knot-line (inside one patch)              surface
//   seam, isoparametric, t-junction           both: a model of patches does not say which of the two it means
//
// Thresholds are lengths in millimetres and angles in degrees.
//
// ENSURES  (1) names are unique, and every profile has a source and a criterion that is judged;
//          (2) tolerances_of gives each threshold in the model's units, rounded once; of criteria about one quantity the
//          threshold is one; what `asked` has already is kept, and then counts at every join;
//          (3) request_at leaves out a tolerance exactly where no criterion speaks of the join and none was given.
// ERRORS   usage: a unit of length that is not known, when a threshold of length is used.
// SOURCE   each profile's `source`; the lists stand in docs/decisions.md ("Profiles").
// NEIGHBOURS report.h
// TEST     tests/io/profile_test.cpp checks (1)–(3).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "patchproof/error.h"
#include "patchproof/join/certificate.h"
#include "patchproof/join/join.h"

namespace patchproof {

enum class Quantity { gap, angle, unchecked };
enum class JoinedParts { faces, surface };

struct Criterion {
  std::string_view code;    // SASIG PDQ: "G-SH-LG"
  std::string_view entity;  // ISO 10303-59: "gap_between_faces_related_to_an_edge"; "" when it has none
  std::string_view what;    // "gap between faces"
  Quantity quantity;
  JoinedParts parts;
  double threshold;
  std::string_view unit;  // "mm", "degrees", "%"
};

struct Profile {
  std::string_view name, title, source;
  std::string_view remark;  // what to know before it is used, or ""
  std::span<const Criterion> criteria;
};

std::span<const Profile> all_profiles();
const Profile* find_profile(std::string_view name);  // nullptr: none of that name

// How many millimetres one unit has: "mm", "cm", "m", "um", "in", "ft" and their longer names; "mm (file: …)", as readers of
// CAD files say it, is mm.
std::optional<double> millimetres_per(std::string_view unit);

// `asked`, and the profile's thresholds where it asks nothing. A model without units counts as one in millimetres.
Result<Request> tolerances_of(const Profile& profile, std::string_view units, Request asked);

// Whether a criterion speaks of joins of this kind.
bool applies(const Criterion& criterion, JoinKind kind);

// A request as tolerances_of made it, for one join. given: what the user asked, without the profile.
Request request_at(const Profile& profile, JoinKind kind, const Request& given, Request request);

}  // namespace patchproof
