// SPDX-License-Identifier: Apache-2.0
// Bad data: what a file, a text or a user handed us that cannot be used.
//
// Result<T> holds either a value or an Error. An Error says what is wrong, where, and with which values, so that the
// person who owns the data can mend it. (std::expected does not exist in C++20; the member names are its own.)
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "patchproof/contract.h"

namespace patchproof {

// Each code with an input that provokes it.
enum class ErrorCode {
  cannot_open,       // a directory, a missing file, no permission
  empty_input,       // a file of length 0
  unknown_format,    // a file that no reader recognises
  unsupported,       // a legal file that holds what we do not read, e.g. a trimmed surface in .g2
  syntax,            // truncated file, text where a number should be
  bad_number,        // "1.2.3", "nan", "1/0", a number of 10^6 digits
  wrong_count,       // 3 control points where the degrees and knots need 16
  bad_degree,        // degree 0 or a negative degree
  decreasing_knots,  // 0 0 1 0.5 1 1
  bad_multiplicity,  // one inner knot repeated more often than degree + 1
  empty_domain,      // knots 0 0 0 0
  vanishing_weight,  // the denominator of a rational patch is zero inside its domain
  bad_reference,     // patch 7 of a model with 6 patches
  mixed_roots,       // sqrt(2) and sqrt(3) in one model
  outside_domain,    // parameter 1.5 of a patch over [0, 1], a parameter that is NaN
  domains_differ,    // boundary curves over [0, 1] and over [0, 2] that face each other
  curves_apart,      // boundary curves that do not meet in a corner, curves of a network that do not cross
  twists_differ,     // cross-boundary derivatives whose mixed derivatives disagree in a corner
  usage,             // a request that makes no sense
  // Curve meshes (mesh/curve_mesh.h):
  bad_weight,              // an edge with a weight of 0
  not_c1,                  // an edge whose homogeneous derivatives differ at a knot
  vanishing_tangent,       // an edge whose derivative is zero at a knot or an end
  ends_apart,              // an edge that ends beside its vertex
  bad_t_node,              // a T-node at the end of its edge, or at which no face has a corner
  wrong_side_count,        // a face with three sides
  bad_side,                // a side of a face from 0 to 0
  side_ends_nowhere,       // a side of a face that ends where there is no vertex and no T-node
  open_loop,               // a side of a face that does not begin where the one before ends
  uneven_cover,            // faces on one side of an edge that overlap or leave a part of it free
  unused_edge,             // an edge at which there is no face
  parallel_tangents,       // a face corner of 0 or 180 degrees
  control_vector_outside,  // a control vector at the end of its edge
  control_vector_twice,    // two control vectors at one place
  control_vector_missing,  // a control vector for one side only, on a smooth edge
  control_vectors_bent,    // control vectors of one place that are not opposite
  control_vector_along,    // a control vector along its edge
  control_vector_differs,  // a control vector at a T-node, with another direction than the edge there
  basis_along_edge,        // a basis patch that vanishes or runs along the edge
  // Curves and surfaces that are blended or fitted (spline/gerbs_curve.h, spline/least_squares.h):
  bad_window,    // curves blended over an overlap of 0, or of more than a curve
  not_monotone,  // the B-function t - 4 t^2 (1 - t)
  not_closed,    // a closed surface whose first and last rows differ
  singular_fit,  // eleven samples, all in one span of a spline with eight control points
};

// The name of a code as printed in messages: "wrong_count".
const char* to_string(ErrorCode code);

struct Error {
  ErrorCode code;
  std::string where;    // "teapot.bpt:12", "model.json at /patches/3/knots/0"
  std::string message;  // one sentence
  std::string values;   // the offending values, exactly as read (shortened in the middle when long)

  // "teapot.bpt:12: message [values] (code)"
  std::string text() const;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  // REQUIRES has_value().
  T& value() & {
    PATCHPROOF_REQUIRES(has_value(), "Result::value() called on an error");
    return std::get<0>(state_);
  }
  const T& value() const& {
    PATCHPROOF_REQUIRES(has_value(), "Result::value() called on an error");
    return std::get<0>(state_);
  }
  T&& value() && {
    PATCHPROOF_REQUIRES(has_value(), "Result::value() called on an error");
    return std::get<0>(std::move(state_));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  // REQUIRES !has_value().
  const Error& error() const {
    PATCHPROOF_REQUIRES(!has_value(), "Result::error() called on a value");
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace patchproof
