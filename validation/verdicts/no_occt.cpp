// SPDX-License-Identifier: Apache-2.0
#include "patchproof/contract.h"
#include "validation/verdicts/occt.h"

namespace patchproof::verdicts {

std::optional<std::string> occt_version() { return std::nullopt; }

Result<Answers> ask_occt(const Case&) { return Error{ErrorCode::unsupported, "", "Open CASCADE is not installed", ""}; }

Result<std::vector<Certificate>> certify_as_cad(const Case&) {
  return Error{ErrorCode::unsupported, "", "Open CASCADE is not installed", ""};
}

}  // namespace patchproof::verdicts
