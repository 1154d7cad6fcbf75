// SPDX-License-Identifier: Apache-2.0
// What is to be drawn, in doubles: between the exact model and the page.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "patchproof/io/plot.h"
#include "patchproof/mesh/tessellate.h"

namespace patchproof {

using Point3 = Vec<double, 3>;

// A control point, or, when its weight is 0, a control vector.
struct DrawnControl {
  Point3 at;
  bool is_vector;
};

struct CurveDrawing {
  struct Mark {                // a break of the knots, on the curve
    Point3 at, before, after;  // neighbours on the curve, for the direction
    std::string label;
  };
  struct Component {
    std::vector<std::vector<Point3>> segments;  // Bézier points of degree ≤ 3, or a polyline of 5 and more points
    std::vector<bool> exact;                    // for each segment: Bézier points
    std::vector<Mark> marks;
  };
  std::string name;
  int degree = 0;
  bool is_rational = false, is_plane = false;
  std::vector<Component> components;
  std::vector<DrawnControl> controls;
  std::string kind{};  // what is said of it, in place of its degree and control points
};

struct DrawnNet {
  std::array<int, 2> count{};  // control points along u and v; v runs fastest
  std::vector<DrawnControl> controls;
};

// A unit normal; which side of its line the limit is from.
struct DrawnNormal {
  Point3 at, direction;
  bool from_left;
};

// A patch, or a solid.
struct PatchDrawing {
  bool is_solid = false;
  std::string name;
  std::array<int, 2> degree{}, cells{};  // cells in each span
  bool is_rational = false;
  std::vector<Tessellation<2>> pieces;
  std::array<int, 2> count{};  // control points along u and v; none: a Gregory patch
  std::vector<DrawnNet> nets;
  std::string kind{};  // as of curves
};

// Parameters t stand at (t − first knot)/(last knot − first knot), computed exactly.
struct BasisDrawing {
  struct Knot {
    double at;
    int multiplicity;
    std::string label;
  };
  struct Function {
    std::vector<std::vector<std::array<double, 2>>> components;  // (place of t, value); none: no support
    std::string support;                                         // "[0, 2]"
  };
  std::string title;
  int degree = 0;
  bool is_rational = false;
  std::array<double, 2> domain{};
  std::vector<Knot> knots;
  std::vector<Function> functions;
};

struct Drawing {
  std::vector<CurveDrawing> curves;
  std::vector<PatchDrawing> patches;
  std::vector<DrawnNormal> normals;
  std::vector<double> levels;  // of sections z = …
};

// The curves and patches that the options choose.
template <ExactField T>
Result<Drawing> draw(const Model<T>& model, const PlotOptions& options);

// One for each distinct knot vector among them, and one more for each with weights.
template <ExactField T>
Result<std::vector<BasisDrawing>> draw_basis(const Model<T>& model, const PlotOptions& options);

std::string svg_scene(const Drawing& drawing, const PlotOptions& options);
// One for each, all in the same view.
std::vector<std::string> svg_scenes(const std::vector<Drawing>& drawings, const PlotOptions& options);
std::string svg_basis(const std::vector<BasisDrawing>& panels, const PlotOptions& options);

// The indices of the curves, patches and solids that the options choose: the given ones, or all but the patches that are
// controls of solids (with `basis` those, too).
struct Chosen {
  std::vector<int> curves, patches, solids;
};
template <ExactField T>
Result<Chosen> chosen(const Model<T>& model, const PlotOptions& options);

// The name, or "curve 3".
std::string title_of(const std::string& what, int index, const std::string& name);

}  // namespace patchproof
