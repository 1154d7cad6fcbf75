// SPDX-License-Identifier: Apache-2.0
// What certify says about one join. Plain data: numbers that were proved are texts ("p/q"), bounds are doubles rounded
// outward.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace patchproof {

enum class Verdict { proven, refuted, undecided };

// A point of the join in terms of both patches.
struct Place {
  std::array<double, 2> a{}, b{};  // (u, v) on patch A and on patch B
  std::array<double, 3> point{};   // on patch A, in model units
};

// Exact numbers that refute a class: at these parameters, this quantity is not zero (or has the wrong sign).
struct Witness {
  // "x - y", "x_s + y_s", "x_ss - y_ss", "det(x_t, x_s, y_s)", "(x_t × x_s) · (y_t × y_s)": t is the parameter of line A
  // (y_t through the pairing), s the parameter distance into each patch.
  std::string quantity;
  std::array<std::string, 2> a, b;  // exact (u, v) on patch A and patch B
  std::vector<std::string> values;  // exact components
};

// proven: holds identically along the whole join.  refuted: with a witness.  undecided: with a reason.
struct ExactClass {
  Verdict verdict = Verdict::undecided;
  std::string reason;
  std::optional<Witness> witness;
};

// sup over the whole join lies in [lower, upper]; lower is attained at `at`. Both are exactly 0 when that was proved.
struct EnclosedMaximum {
  double lower = 0, upper = 0;
  Place at;
  bool converged = true;  // upper − lower is at most 1 % of upper (trimmed edges: or upper is at the rounding errors)
};

// On which side of the edge the second patch lies: smooth (it goes on across the edge, normals less than 90° apart
// everywhere), cusp (it folds back, more than 90° everywhere), or mixed.
enum class Orientation { smooth, cusp, mixed, unknown };

// A place or range where the first-order normal of one side vanishes, or where there is no tangent plane.
struct Degeneracy {
  char side = 'a';            // 'a' or 'b'
  double begin = 0, end = 0;  // enclosure in the parameter along line A
  std::string what;           // "the normal vanishes; its limit is used", "no tangent plane up to second order"
};

struct Certificate {
  ExactClass c0, c1, c2, g1;
  std::optional<std::string> ratio;  // exact λ > 0 with y_s = −λ x_s; "1" when C1
  EnclosedMaximum gap;               // largest distance of paired points, in model units
  EnclosedMaximum angle;             // largest angle between the oriented normals, degrees in [0, 180]; 180 is a cusp
  EnclosedMaximum plane_angle;  // largest angle between the tangent planes, degrees in [0, 90], blind to orientation
  Orientation orientation = Orientation::unknown;
  std::vector<Degeneracy> degenerate;
  std::string rung;  // what decided: "interval", "integer", "quadratic"
};

const char* to_string(Verdict verdict);
const char* to_string(Orientation orientation);

// What is asked of every join. Nothing asked: everything is reported, nothing fails.
enum class Continuity { c0, c1, g1 };
struct Request {
  std::optional<Continuity> require;
  std::optional<double> gap_tolerance;    // model units
  std::optional<double> angle_tolerance;  // degrees
  double seconds_per_join = 10;           // then the join ends undecided
};

enum class Outcome { pass, fail, undecided };
const char* to_string(Outcome outcome);

// pass: everything asked is proven or within (upper ≤ tolerance).  fail: something is refuted or exceeds (lower > tolerance).
// undecided: the rest; `reason` says why.
struct Judgement {
  Outcome outcome = Outcome::pass;
  std::string reason;
};
Judgement judge(const Certificate& certificate, const Request& request);

}  // namespace patchproof
