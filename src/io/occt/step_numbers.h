// SPDX-License-Identifier: Apache-2.0
// Numbers of a STEP file that are none, or not finite. Open CASCADE puts zeros there, or works on with infinity, and may not
// come to an end.
//
// ENSURES  (1) names, comments and everything outside the data sections are not looked at;  (2) the first such number of each
//          entity is listed, as it stands in the file.
// COST     linear.
// SOURCE   ISO 10303-21:2016, clauses 6 and 7 (tokens).
// TEST     tests/io/occt/damaged_files_test.cpp
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace patchproof::occt {

struct BadNumber {
  long line;
  std::string value;
};
// By the numbers of entities: 12 of #12.
using BadNumbers = std::map<long, BadNumber>;

BadNumbers bad_step_numbers(std::string_view bytes);

}  // namespace patchproof::occt
