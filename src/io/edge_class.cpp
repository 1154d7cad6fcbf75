// SPDX-License-Identifier: Apache-2.0
#include "edge_class.h"

#include <algorithm>
#include <cmath>

namespace patchproof {

const char* to_string(EdgeClass edge_class) {
  switch (edge_class) {
    case EdgeClass::smooth: return "smooth";
    case EdgeClass::kinked: return "kinked";
    case EdgeClass::sharp: return "sharp";
    case EdgeClass::mixed: return "mixed";
    case EdgeClass::undecided: return "undecided";
  }
  return "unknown";
}

EdgeClass edge_class_of(const TrimmedJoin& join, const Certificate& certificate, double smooth_below,
                        DeadlineScope::Clock::time_point deadline) {
  const EnclosedMaximum& angle = certificate.angle;
  const double smooth = std::min(kSmoothDegrees, smooth_below);
  if (angle.upper <= smooth) return EdgeClass::smooth;
  if (angle.lower > smooth && angle.upper <= smooth_below) return EdgeClass::kinked;
  if (!(angle.lower > smooth_below)) return EdgeClass::undecided;
  // With one face turned over, angles become 180° minus themselves, and the largest the smallest.
  TrimmedJoin turned = join;
  turned.b.flipped = !turned.b.flipped;
  Budget budget;
  budget.nodes = 200;
  budget.deadline = deadline;
  const RoundingGuard guard;
  const TrimmedBound largest = bound_trimmed(turned, budget).angle;
  if ((Interval(180) - Interval(largest.upper)).inf() > smooth_below) return EdgeClass::sharp;
  return (Interval(180) - Interval(largest.lower)).sup() <= smooth_below ? EdgeClass::mixed : EdgeClass::undecided;
}

Certificate widened(Certificate certificate, const Approximation& by) {
  if (by.length == 0 && by.degrees == 0) return certificate;
  const auto widen = [](EnclosedMaximum& bound, double by_what, double most) {
    bound.lower = std::max(0.0, bound.lower - by_what);
    bound.upper = std::min(std::max(bound.upper, most), bound.upper + by_what);
  };
  widen(certificate.gap, by.length, HUGE_VAL);
  widen(certificate.angle, by.degrees, 180);
  widen(certificate.plane_angle, by.degrees, 90);
  for (ExactClass* c : {&certificate.c0, &certificate.c1, &certificate.c2, &certificate.g1})
    *c = {Verdict::undecided, "a surface is approximated", std::nullopt};
  return certificate;
}

Judgement judge_edge(const Certificate& certificate, EdgeClass edge_class, double smooth_below, Request request) {
  const Judgement strict = judge(certificate, request);
  const bool perhaps_sharp = edge_class == EdgeClass::undecided && certificate.angle.lower > smooth_below;
  if (edge_class != EdgeClass::sharp && !perhaps_sharp) return strict;
  request.angle_tolerance.reset();
  if (request.require) request.require = Continuity::c0;
  const Judgement lenient = judge(certificate, request);
  if (edge_class == EdgeClass::sharp || lenient.outcome == strict.outcome) return lenient;
  return {Outcome::undecided, "whether the edge is sharp along its whole length is not decided"};
}

}  // namespace patchproof
