// SPDX-License-Identifier: Apache-2.0
// What every reader produces, one curve or patch at a time: the texts of its numbers, as views into the file, and where
// they stand.
// The step from texts to exact numbers is shared (model_builder.h), so no reader knows a number type.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "patchproof/io/model.h"
#include "source_file.h"

namespace patchproof {

inline constexpr int kMaxDegree = 64;

enum class Weights {
  none,         // every weight is 1
  separate,     // in `weights`; the coordinates are those of the points in space
  homogeneous,  // last number of every point; the coordinates are already multiplied by it
};

// How a JSON pointer to a number is spelt.
enum class JsonLayout {
  none,
  model,
  geomdl,
  tinyspline,  // coordinates in one list
  point,       // of our model: the whole is one point, [x, y, z]
};

// A curve (one direction) or a patch (two: u and v).
struct RawSpline {
  int directions = 2;
  std::string name;
  std::array<long, 2> degree{};
  bool has_knots = false;  // false: Bézier knots on [0, 1]
  std::array<std::vector<std::string_view>, 2> knots;
  std::array<long, 2> count{};  // control points along u and v; of a curve, count[0]
  int per_point = 3;            // numbers per point: 2 or 3, and one more when homogeneous
  Weights weight_form = Weights::none;
  bool u_fastest = false;  // the order of the points in the file
  std::vector<std::string_view> coordinates, weights;

  std::string_view at;  // where it begins
  JsonLayout layout = JsonLayout::none;
  std::string pointer;  // of the whole, JSON only

  bool is_curve() const { return directions == 1; }
  int dimension() const { return per_point - (weight_form == Weights::homogeneous ? 1 : 0); }
  // " along u" in messages; a curve has but one direction, "".
  std::string_view along(int direction) const;
  // JSON pointers (empty in text formats), to a member and to one number. Points are numbered in the order of the file.
  std::string degree_pointer(int direction) const;
  std::string knots_pointer(int direction) const;
  std::string knot_pointer(int direction, std::size_t k) const;
  std::string points_pointer() const;
  std::string coordinate_pointer(std::size_t point, int component) const;
  std::string weights_pointer() const;
  std::string weight_pointer(std::size_t point) const;

 private:
  std::string member_pointer(std::string_view member) const;
  std::string element_pointer(std::string_view array, std::size_t point) const;
};

// A patch that is not given by a net but made from curves. Keys are those of our JSON model; a curve of layout `point` is
// shrunk to a point.
struct RawConstruction {
  enum class Kind { coons, transfinite, gordon };
  Kind kind = Kind::coons;
  std::string name;
  std::string_view at;
  std::string pointer;
  std::map<std::string, std::vector<RawSpline>> curves;             // "v_min": one curve; "controls": a list
  std::map<std::string, std::vector<std::string_view>> parameters;  // gordon: "u" and "v"
  RawSpline blending;                                               // transfinite: degree and knots only
  bool along_u = true;                                              // transfinite: the direction of the blending
};

// A NURBS boundary Gregory patch.
struct RawGregory {
  std::string name;
  std::string_view at;
  std::string pointer;
  RawSpline u_surface, v_surface;
};

// A local curve or patch of a GERBS.
struct RawLocal {
  RawSpline spline;                     // in a trigonometric direction its degree is the number of harmonics
  std::array<bool, 2> trigonometric{};  // in t, or in u and v
  std::string_view same_as;             // the number of an earlier one of the same GERBS, instead; or ""
  std::vector<std::string_view> map;    // twelve numbers, row by row, or none
  std::string_view at;
  std::string pointer;
};

// A GERBS curve (one direction) or patch (two), or the blend of two curves.
struct RawGerbs {
  int directions = 1;
  std::string name;
  std::string_view at;
  std::string pointer;
  std::string b_function;
  std::array<std::vector<std::string_view>, 2> knots;  // t_1 … t_N of each direction
  std::array<bool, 2> closed{};
  std::vector<RawLocal> locals;             // of patches row by row
  std::map<std::string, RawLocal> blended;  // "first" and "second"
  std::string_view overlap;

  bool is_blend() const { return !blended.empty(); }
};

// A solid made from patches of the model and points.
struct RawSolid {
  struct Control {
    std::string_view patch;  // its index, or "" for a point
    RawSpline point;
  };
  std::string name;
  std::string_view at;
  std::string pointer;  // of the construction
  RawSpline blending;   // degree and knots only
  std::vector<Control> controls;
};

// Where readers deliver. The first error ends the reading.
class ModelSink {
 public:
  virtual ~ModelSink() = default;
  virtual std::optional<Error> add(const RawSpline& spline) = 0;
  virtual std::optional<Error> add(const RawConstruction& construction) = 0;
  virtual std::optional<Error> add(const RawGregory& patch) = 0;
  virtual std::optional<Error> add(const RawGerbs& curve_or_patch) = 0;
  // After all patches.
  virtual std::optional<Error> add(const RawSolid& solid) = 0;
  // The first text among the numbers that is none: what a reader asks when a file ends inside a spline, because two
  // numbers run together make a file seem too short.
  virtual std::optional<Error> first_bad_number(const RawSpline& spline) = 0;
  virtual std::size_t patch_count() const = 0;
  virtual std::size_t gregory_patch_count() const = 0;
  virtual std::size_t gerbs_count() const = 0;  // patches and curves
  virtual std::size_t gerbs_patch_count() const = 0;
  virtual std::size_t curve_count() const = 0;

  std::vector<DeclaredJoin> joins;
  std::string units;
  std::vector<std::string> notes;
};

// One reader per format; each either delivers the whole file or returns an error.
using Reader = std::optional<Error> (*)(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_newell(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_bpt(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_bez(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_g2(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_gismo(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_json_model(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_geomdl(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_tinyspline(const SourceFile& source, ModelSink& sink);
std::optional<Error> read_obj(const SourceFile& source, ModelSink& sink);

}  // namespace patchproof
