// SPDX-License-Identifier: Apache-2.0
// The text of a BREP file, checked before Open CASCADE reads it: its reader takes 0 for what is no number, and may not come
// to an end with one that is not finite.
//
// ENSURES  (1) every number of the file is finite, every weight is positive, knots increase; where not, it is said of the entity
//          that holds it, with the number as it stands there;  (2) `mended` differs from the file only in damaged entities
//          and numbers, and holds harmless ones in their place, so that the others can be read;  (3) counts, indices and
//          flags are integers in their ranges, else there is no answer.
// ERRORS   syntax (a file that ends early, a word that does not belong there), bad_reference, bad_number (of a placement); the
//          line, the table and the entity stand in `where`.
// COST     linear.
// SOURCE   Open CASCADE Technology, "BRep Format" (its documentation of versions 1 to 3).
// TEST     tests/io/occt/damaged_files_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "patchproof/error.h"

namespace patchproof::occt {

struct Damage {
  ErrorCode code;
  std::string reason;  // "surface 3 (line 12): the weight of control point (1, 2) is not positive: -0.25"
};
using Damages = std::vector<std::optional<Damage>>;

// A curve, a surface: its place in the text.
struct BrepEntity {
  std::size_t begin, end;  // bytes
  long line;
  std::optional<Damage> damage;
};

// A parameter curve of an edge.
struct BrepParameters {
  int curve, surface;  // 1-based
};

// A vertex, an edge, …, in the order of the file. Parts stand before their wholes.
struct BrepShape {
  std::string kind;  // "Ve", "Ed", "Wi", "Fa", "Sh", "So", "CS", "Co"
  std::vector<int> parts;
  std::optional<Damage> damage;            // of its own numbers
  int surface = 0;                         // of a face; 1-based, 0: none
  std::vector<int> curves;                 // of an edge, in space; 1-based
  std::vector<BrepParameters> parameters;  // of an edge
};

struct BrepText {
  std::vector<BrepEntity> curves2d, curves, surfaces;
  std::vector<BrepShape> shapes;
  struct Replacement {
    std::size_t begin, end;
    std::string by;
  };
  std::vector<Replacement> numbers;  // of shapes, in the order of the file

  // Of each shape: the first damage in it or in what it is made of. A parameter curve damages the faces on its surface.
  Damages damages() const;
  // The text that Open CASCADE is to read.
  std::string mended(std::string_view bytes) const;
};

Result<BrepText> check_brep_text(const std::string& path, std::string_view bytes);

}  // namespace patchproof::occt
