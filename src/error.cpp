// SPDX-License-Identifier: Apache-2.0
#include "patchproof/error.h"

namespace patchproof {

const char* to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::cannot_open: return "cannot_open";
    case ErrorCode::empty_input: return "empty_input";
    case ErrorCode::unknown_format: return "unknown_format";
    case ErrorCode::unsupported: return "unsupported";
    case ErrorCode::syntax: return "syntax";
    case ErrorCode::bad_number: return "bad_number";
    case ErrorCode::wrong_count: return "wrong_count";
    case ErrorCode::bad_degree: return "bad_degree";
    case ErrorCode::decreasing_knots: return "decreasing_knots";
    case ErrorCode::bad_multiplicity: return "bad_multiplicity";
    case ErrorCode::empty_domain: return "empty_domain";
    case ErrorCode::vanishing_weight: return "vanishing_weight";
    case ErrorCode::bad_reference: return "bad_reference";
    case ErrorCode::mixed_roots: return "mixed_roots";
    case ErrorCode::outside_domain: return "outside_domain";
    case ErrorCode::domains_differ: return "domains_differ";
    case ErrorCode::curves_apart: return "curves_apart";
    case ErrorCode::twists_differ: return "twists_differ";
    case ErrorCode::usage: return "usage";
    case ErrorCode::bad_weight: return "bad_weight";
    case ErrorCode::not_c1: return "not_c1";
    case ErrorCode::vanishing_tangent: return "vanishing_tangent";
    case ErrorCode::ends_apart: return "ends_apart";
    case ErrorCode::bad_t_node: return "bad_t_node";
    case ErrorCode::wrong_side_count: return "wrong_side_count";
    case ErrorCode::bad_side: return "bad_side";
    case ErrorCode::side_ends_nowhere: return "side_ends_nowhere";
    case ErrorCode::open_loop: return "open_loop";
    case ErrorCode::uneven_cover: return "uneven_cover";
    case ErrorCode::unused_edge: return "unused_edge";
    case ErrorCode::parallel_tangents: return "parallel_tangents";
    case ErrorCode::control_vector_outside: return "control_vector_outside";
    case ErrorCode::control_vector_twice: return "control_vector_twice";
    case ErrorCode::control_vector_missing: return "control_vector_missing";
    case ErrorCode::control_vectors_bent: return "control_vectors_bent";
    case ErrorCode::control_vector_along: return "control_vector_along";
    case ErrorCode::control_vector_differs: return "control_vector_differs";
    case ErrorCode::basis_along_edge: return "basis_along_edge";
    case ErrorCode::bad_window: return "bad_window";
    case ErrorCode::not_monotone: return "not_monotone";
    case ErrorCode::not_closed: return "not_closed";
    case ErrorCode::singular_fit: return "singular_fit";
  }
  return "unknown";
}

std::string Error::text() const {
  constexpr std::size_t kShown = 160;  // long offending values are cut in the middle
  std::string shown = values;
  if (shown.size() > kShown) shown = values.substr(0, kShown / 2) + " … " + values.substr(values.size() - kShown / 4);
  std::string out = where.empty() ? message : where + ": " + message;
  if (!shown.empty()) out += " [" + shown + "]";
  return out + " (" + to_string(code) + ")";
}

}  // namespace patchproof
