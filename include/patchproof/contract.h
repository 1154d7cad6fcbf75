// SPDX-License-Identifier: Apache-2.0
// Contracts: what the caller must guarantee. A broken contract is a programmer's error, never bad data and never an
// undecided proof (those are Result<T> in error.h and Verdict in join/certificate.h).
#pragma once

#include <stdexcept>

namespace patchproof {

// Thrown by PATCHPROOF_REQUIRES; the C API turns it into a status.
class contract_error : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace patchproof

// REQUIRES: `condition` holds; otherwise throws contract_error with `sentence`.
#define PATCHPROOF_REQUIRES(condition, sentence)                    \
  do {                                                              \
    if (!(condition)) throw ::patchproof::contract_error(sentence); \
  } while (false)
