// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/profile.h"

#include <algorithm>
#include <array>
#include <string>

namespace patchproof {
namespace {

constexpr auto kFaces = JoinedParts::faces;
constexpr auto kSurface = JoinedParts::surface;
constexpr auto kOther = Quantity::unchecked;

constexpr Criterion face_gap(double mm) {
  return {"G-SH-LG", "gap_between_faces_related_to_an_edge", "gap between faces", Quantity::gap, kFaces, mm, "mm"};
}
constexpr Criterion patch_gap(double mm) {
  return {"G-SU-LG", "", "gap between patches of a surface", Quantity::gap, kSurface, mm, "mm"};
}
constexpr Criterion face_angle(double degrees) {
  return {"G-SH-NT", "g1_discontinuity_between_adjacent_faces", "angle between faces", Quantity::angle, kFaces, degrees,
          "degrees"};
}
constexpr Criterion patch_angle(double degrees) {
  return {
      "G-SU-NT", "g1_discontinuous_surface", "angle between patches of a surface", Quantity::angle, kSurface, degrees,
      "degrees"};
}
constexpr Criterion face_curvature(double percent) {
  return {
      "G-SH-NS", "g2_discontinuity_between_adjacent_faces", "jump of curvature between faces", kOther, kFaces, percent,
      "%"};
}
constexpr Criterion patch_curvature(double threshold, std::string_view unit) {
  return {"G-SU-NS",
          "g2_discontinuous_surface",
          "jump of curvature between patches of a surface",
          kOther,
          kSurface,
          threshold,
          unit};
}
constexpr Criterion curve_gap(double mm) {
  return {"G-CU-LG", "", "gap between segments of a curve", kOther, kFaces, mm, "mm"};
}
constexpr Criterion curve_angle(double degrees) {
  return {"G-CU-NT", "g1_discontinuous_curve", "angle between segments of a curve", kOther, kFaces, degrees, "degrees"};
}
constexpr Criterion edge_from_face(double mm) {
  return {"G-FA-EG", "gap_between_edge_and_base_surface", "distance of an edge from its face", kOther, kFaces, mm,
          "mm"};
}

constexpr std::array kMil{face_gap(0.01), patch_angle(2), curve_gap(0.01), edge_from_face(0.01), curve_angle(2)};
constexpr std::array kVda{face_gap(0.02), patch_gap(0.02), face_angle(0.1), patch_angle(0.1), patch_curvature(10, "")};
constexpr std::array kCatia{face_gap(0.001),   patch_gap(0.001),  face_angle(0.01),
                            patch_angle(0.01), face_curvature(2), patch_curvature(2, "%")};
constexpr std::array kClassA{face_gap(0.01), patch_gap(0.01), face_angle(0.1), patch_angle(0.1)};
constexpr std::array kClassB{face_gap(0.02), patch_gap(0.02), face_angle(0.2), patch_angle(0.2)};
constexpr std::array kClassC{face_gap(0.05), patch_gap(0.05), face_angle(0.5), patch_angle(0.5)};

constexpr std::string_view kCarBody =
    "car body surfaces as designers quote them (an answer on grabcad.com); no standard";

constexpr std::array kProfiles{
    Profile{"mil-std-31000a", "MIL-STD-31000A, Appendix C, native models", "Table 1 of PMC4904719 (NIST)",
            "models translated to ISO 10303 are allowed 3 degrees: --angle 3; the angle between faces is not limited",
            kMil},
    Profile{"vda4955", "VDA 4955, as Creo's GeomIntegrityCHECK has it",
            "Creo help, GeomIntegrityCHECK (support.ptc.com)",
            "the help prints units that cannot be meant; 0.1 is taken for degrees", kVda},
    Profile{"catia", "CATIA, Connect Checker", "CATIA's help, Connect Checker, continuity of surfaces",
            "help of V5 B18 has 0.5 degrees: --angle 0.5", kCatia},
    Profile{"class-a", "car body, class A", kCarBody, "class A also wants continuous curvature, without a figure",
            kClassA},
    Profile{"class-b", "car body, class B", kCarBody, "", kClassB},
    Profile{"class-c", "car body, class C", kCarBody, "", kClassC},
};

struct Unit {
  std::string_view name;
  double millimetres;
};
constexpr Unit kUnits[] = {{"", 1},
                           {"mm", 1},
                           {"millimetre", 1},
                           {"millimeter", 1},
                           {"cm", 10},
                           {"centimetre", 10},
                           {"centimeter", 10},
                           {"m", 1000},
                           {"metre", 1000},
                           {"meter", 1000},
                           {"um", 0.001},
                           {"µm", 0.001},
                           {"micrometre", 0.001},
                           {"micrometer", 0.001},
                           {"in", 25.4},
                           {"inch", 25.4},
                           {"ft", 304.8},
                           {"foot", 304.8}};

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

const Criterion* criterion_of(const Profile& profile, Quantity quantity) {
  const auto it = std::find_if(profile.criteria.begin(), profile.criteria.end(),
                               [&](const Criterion& c) { return c.quantity == quantity; });
  return it == profile.criteria.end() ? nullptr : &*it;
}

}  // namespace

std::span<const Profile> all_profiles() { return kProfiles; }

const Profile* find_profile(std::string_view name) {
  const auto it = std::find_if(kProfiles.begin(), kProfiles.end(), [&](const Profile& p) { return p.name == name; });
  return it == kProfiles.end() ? nullptr : &*it;
}

std::optional<double> millimetres_per(std::string_view unit) {
  if (unit.starts_with("mm (file: ")) return 1;
  std::string name = lower_case(unit);
  if (name == "inches") name = "inch";
  if (name == "feet") name = "foot";
  for (const Unit& known : kUnits)
    if (name == known.name || (name.size() > 4 && name == std::string(known.name) + "s")) return known.millimetres;
  return std::nullopt;
}

Result<Request> tolerances_of(const Profile& profile, std::string_view units, Request asked) {
  if (const Criterion* gap = criterion_of(profile, Quantity::gap); gap && !asked.gap_tolerance) {
    const std::optional<double> scale = millimetres_per(units);
    if (!scale)
      return Error{ErrorCode::usage, "--profile " + std::string(profile.name),
                   "its lengths are in mm, and the model's unit is not known: give --gap in the model's units",
                   std::string(units)};
    asked.gap_tolerance = gap->threshold / *scale;
  }
  if (const Criterion* angle = criterion_of(profile, Quantity::angle); angle && !asked.angle_tolerance)
    asked.angle_tolerance = angle->threshold;
  return asked;
}

bool applies(const Criterion& criterion, JoinKind kind) {
  switch (kind) {
    case JoinKind::trimmed: return criterion.parts == JoinedParts::faces;
    case JoinKind::knot_line: return criterion.parts == JoinedParts::surface;
    default: return true;
  }
}

Request request_at(const Profile& profile, JoinKind kind, const Request& given, Request request) {
  const auto speaks_of = [&](Quantity quantity) {
    return std::any_of(profile.criteria.begin(), profile.criteria.end(),
                       [&](const Criterion& c) { return c.quantity == quantity && applies(c, kind); });
  };
  if (!given.gap_tolerance && !speaks_of(Quantity::gap)) request.gap_tolerance.reset();
  if (!given.angle_tolerance && !speaks_of(Quantity::angle)) request.angle_tolerance.reset();
  return request;
}

}  // namespace patchproof
