// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/certificate.h"

#include "patchproof/join/join.h"

namespace patchproof {

const char* to_string(JoinKind kind) {
  switch (kind) {
    case JoinKind::isoparametric: return "isoparametric";
    case JoinKind::t_junction: return "t-junction";
    case JoinKind::seam: return "seam";
    case JoinKind::knot_line: return "knot-line";
    case JoinKind::trimmed: return "trimmed";
  }
  return "unknown";
}

const char* to_string(PairingKind kind) {
  switch (kind) {
    case PairingKind::identity: return "identity";
    case PairingKind::affine: return "affine";
    case PairingKind::rational_linear: return "rational-linear";
    case PairingKind::piecewise_linear: return "piecewise-linear";
  }
  return "unknown";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::proven: return "proven";
    case Verdict::refuted: return "refuted";
    case Verdict::undecided: return "undecided";
  }
  return "unknown";
}

const char* to_string(Orientation orientation) {
  switch (orientation) {
    case Orientation::smooth: return "smooth";
    case Orientation::cusp: return "cusp";
    case Orientation::mixed: return "mixed";
    case Orientation::unknown: return "unknown";
  }
  return "unknown";
}

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::pass: return "pass";
    case Outcome::fail: return "fail";
    case Outcome::undecided: return "undecided";
  }
  return "unknown";
}

Judgement judge(const Certificate& certificate, const Request& request) {
  Judgement judgement;
  const auto lower_to = [&](Outcome outcome, const std::string& reason) {
    if (judgement.outcome == Outcome::fail) return;  // fail outranks undecided outranks pass
    if (outcome == Outcome::undecided && judgement.outcome == Outcome::undecided) return;
    judgement = {outcome, reason};
  };
  if (request.require) {
    const ExactClass& asked = *request.require == Continuity::c0   ? certificate.c0
                              : *request.require == Continuity::c1 ? certificate.c1
                                                                   : certificate.g1;
    if (asked.verdict == Verdict::refuted) lower_to(Outcome::fail, asked.reason);
    if (asked.verdict == Verdict::undecided) lower_to(Outcome::undecided, asked.reason);
  }
  const auto compare = [&](const EnclosedMaximum& bound, const std::optional<double>& tolerance, const char* name) {
    if (!tolerance || bound.upper <= *tolerance) return;
    if (bound.lower > *tolerance)
      lower_to(Outcome::fail, std::string("the ") + name + " exceeds the tolerance");
    else
      lower_to(Outcome::undecided, std::string("the tolerance lies between the bounds of the ") + name);
  };
  compare(certificate.gap, request.gap_tolerance, "gap");
  compare(certificate.angle, request.angle_tolerance, "normal angle");
  return judgement;
}

}  // namespace patchproof
