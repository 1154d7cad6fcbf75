// SPDX-License-Identifier: Apache-2.0
// How the joins of a report stand against the criteria of its profile.
#pragma once

#include <iosfwd>
#include <optional>

#include "patchproof/io/profile.h"
#include "patchproof/io/report.h"

namespace patchproof {

// Sets the report's request and profile; a note says when the model's units are a guess.
void begin_request(Report& report, const CertifyOptions& options);

// What is asked of one join.
Request request_at(const CertifyOptions& options, JoinKind kind);

// Nothing when the criterion does not speak of the join or cannot be checked.
std::optional<Outcome> outcome_of(const Report& report, const ReportedJoin& join, const Criterion& criterion);

// The tolerance that joins were compared with: the threshold in the model's units, or what the user gave.
std::optional<double> tolerance_of(const Report& report, const Criterion& criterion);

struct CriterionCount {
  int joins = 0, pass = 0, fail = 0, undecided = 0;
};
CriterionCount count_of(const Report& report, const Criterion& criterion);

// For people: one line for each criterion.
void write_profile(std::ostream& out, const Report& report);

}  // namespace patchproof
