// SPDX-License-Identifier: Apache-2.0
// A model: a set of patches, curves and solids as read from a file, exact, plus the joins that the file declares (if any).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "patchproof/patch/boundary.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/patch/gerbs_surface.h"
#include "patchproof/patch/gregory_patch.h"
#include "patchproof/patch/transfinite.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

// A patch with homogeneous control points (w·x, w·y, w·z, w). is_rational is false when every weight is 1.
// ENSURES (for patches that a reader returns) the denominator is certified to have no zero on the domain.
template <ExactField T>
struct ModelPatch {
  std::string name;  // as in the file, or "" when it has none
  BsplinePatch<T, 4> surface;
  bool is_rational = false;
};

// A curve with homogeneous control points (w·x, w·y, w·z, w). is_rational is false when every weight is 1.
// ENSURES (for curves that a reader returns) the denominator is certified to have no zero on the domain.
template <ExactField T>
struct ModelCurve {
  std::string name;  // as in the file, or "" when it has none
  BsplineCurve<T, 4> curve;
  bool is_rational = false;
  int dimension = 3;  // 2: the file gives x and y only, and z = 0
};

// A NURBS boundary Gregory patch. As one of the model's patches its number comes after those of all others.
// ENSURES (for patches that a reader returns) the corners agree and no denominator has a zero.
template <ExactField T>
struct ModelGregoryPatch {
  std::string name;  // as in the file, or "" when it has none
  GregoryPatch<T> patch;
};

// A GERBS surface, with homogeneous points. As one of the model's patches its number comes after those of `patches` and before
// those of Gregory patches.
// ENSURES (for patches that a reader returns) no denominator of a local surface has a zero.
template <ExactField T>
struct ModelGerbsPatch {
  std::string name;  // as in the file, or "" when it has none
  GerbsSurface<T, 4> surface;
};

// A GERBS curve, with homogeneous points. As one of the model's curves its number comes after those of all others.
// ENSURES (for curves that a reader returns) no denominator of a local curve has a zero.
template <ExactField T>
struct ModelGerbsCurve {
  std::string name;  // as in the file, or "" when it has none
  GerbsCurve<T, 4> curve;
  int dimension = 3;  // 2: all local curves have z = 0
};

// A solid over a box of (u, v, w), mapped to homogeneous points. Read from a file it is Σ N_k(w) C_k(u,v) with patches of the
// model and points as controls.
template <ExactField T>
struct ModelSolid {
  struct Control {
    int patch = -1;  // 0-based, or −1: a point
    Vec<T, 3> point{};
  };
  std::string name;
  TransfiniteMap<T, 3, 4> map;
  std::optional<KnotVector<T>> knots = std::nullopt;  // empty: not read from a file, and no format holds it
  std::vector<Control> controls = {};
};

// A join that the file declares: the first edge, the second edge, and whether their directions are opposite.
struct DeclaredJoin {
  int patch_a, patch_b;  // 0-based
  EdgeName edge_a, edge_b;
  bool reversed;
};

template <ExactField T>
struct Model {
  std::vector<ModelPatch<T>> patches;
  std::vector<ModelGregoryPatch<T>> gregory_patches;
  std::vector<ModelGerbsPatch<T>> gerbs_patches;
  std::vector<ModelCurve<T>> curves;
  std::vector<ModelGerbsCurve<T>> gerbs_curves;
  std::vector<ModelSolid<T>> solids;
  std::vector<DeclaredJoin> joins;  // empty: joins are found from the geometry
  std::string units;                // "" when the file names none
};

// What a reader hands over: the numbers decide whether Q is enough.
struct ModelFile {
  std::string path;
  std::string format;  // "patchproof-model", "newell", "bpt", "bez", "g2", "gismo", "geomdl", "tinyspline", "obj"
  std::string sha256;  // of the bytes read, 64 lower-case hexadecimal digits
  Decimals decimals = Decimals::exact;
  std::variant<Model<Rational>, Model<Quadratic>> model;
  std::vector<std::string> notes;  // what the reader left out or noticed, e.g. "patch 0: Coons patch, expanded exactly"
};

}  // namespace patchproof
