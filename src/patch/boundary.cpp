// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/boundary.h"

namespace patchproof {

const char* to_string(EdgeName edge) {
  switch (edge) {
    case EdgeName::u_min: return "u_min";
    case EdgeName::u_max: return "u_max";
    case EdgeName::v_min: return "v_min";
    case EdgeName::v_max: return "v_max";
  }
  return "unknown";
}

}  // namespace patchproof
