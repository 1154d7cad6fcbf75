// SPDX-License-Identifier: Apache-2.0
// The joins of curves in reports.
#pragma once

#include <iosfwd>
#include <string>

#include "patchproof/io/curve_files.h"

namespace patchproof {

// Adds the joins of the file's curves, if it has curves.
void add_curve_joins(Report& report, const CurveFile& file, const CertifyOptions& options);

// The members of the JSON document about curves, each with a comma behind it.
std::string curves_json(const Report& report);

void write_curves(std::ostream& out, const Report& report, const TableStyle& style);

}  // namespace patchproof
