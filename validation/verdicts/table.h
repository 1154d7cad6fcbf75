// SPDX-License-Identifier: Apache-2.0
// One row for each case: what is true, what Open CASCADE says, what patchproof says.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "validation/verdicts/case.h"
#include "validation/verdicts/ours.h"

namespace patchproof::verdicts {

struct Row {
  Case about;
  Ours ours;
  std::optional<Answers> occt;                  // where Open CASCADE is installed
  std::optional<std::vector<Certificate>> cad;  // the shapes certified as a CAD file, likewise
  std::vector<std::string> complaints;          // what patchproof says and is not true
  std::vector<std::string> notes;               // Open CASCADE refused, or answers otherwise than recorded
};

// Everything is asked; complaints of all kinds are collected.
Row examine(Case c);

// The largest of all the certificates' gaps (angles) lies between these.
std::array<double, 2> largest(const std::vector<Certificate>& all, EnclosedMaximum Certificate::*what);

// A Markdown table with aligned columns, bounds rounded outward to six digits; Open CASCADE's wrong answers are bold.
// Complaints and notes follow.
void write_table(std::ostream& out, const std::vector<Row>& rows);
void write_json(std::ostream& out, const std::vector<Row>& rows, const CaseOptions& options);

}  // namespace patchproof::verdicts
