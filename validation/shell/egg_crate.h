// SPDX-License-Identifier: Apache-2.0
// A free-form shell of any size whose joins are known: an egg crate of columns × rows bicubic faces
//
//   S(u, v) = (u, v, p(u) + q(v))   on cells of 3 × 3, p and q piecewise cubic, each cell a B-spline of two spans
//
// Within a period of six lines p (and q) is kinked at line 0, from slope −s to +s, smooth at the others, and constant between
// lines 3 and 4. A cell where both are constant has a hole: a quarter of a torus leads over to a cylinder, smoothly. With
// c² = 1 + q'², the normals along a kinked line of p differ by 2 atan(s/c): at most by 2 atan(s/√(1 + min q'²)).
#pragma once

#include <TopoDS_Shape.hxx>

#include <array>
#include <string>

#include "patchproof/io/cad.h"

namespace patchproof::shell {

// One profile: values at the lines, slopes on both sides of them. All are dyadic, so that smooth joins are exact ones.
struct Profile {
  double value(int line) const;
  double slope(int line, bool right) const;
  bool is_constant(int cell) const;
  // The least |slope| within a cell.
  double least_slope(int cell) const;
};

struct EggCrate {
  int columns, rows;
  bool turned = false;  // by an angle that doubles only approximate: joins are smooth up to rounding

  int holes() const;
  int faces() const { return columns * rows + 2 * holes(); }
  int joins() const { return (columns - 1) * rows + columns * (rows - 1) + 4 * holes(); }

  TopoDS_Shape shape() const;
  // ERRORS false when Open CASCADE cannot write the file.
  bool write_step(const std::string& path) const;

  // The largest angle between the normals of a join, in degrees.
  double angle_of(const CadModel& model, const ReportedJoin& join) const;

 private:
  std::array<int, 2> cell_of(const CadFace& face) const;  // {−1, −1}: of a hole
};

}  // namespace patchproof::shell
