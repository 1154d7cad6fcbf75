// SPDX-License-Identifier: Apache-2.0
// Reading models. The formats are described in docs/formats.md.
//
// ENSURES  (1) decimal text is read exactly (Decimals::exact) or as the nearest doubles (Decimals::binary64);
//          (2) either a complete, valid model comes back or an Error, never a part of one;
//          (3) the denominators of all rational curves and patches are certified to have no zero on their domains;
//          (4) every coordinate is below 2^1000 in size, so that bounds are finite doubles;
//          (5) a patch that the file makes from curves (Coons, transfinite, Gordon) is the B-spline patch that is the same
//          function, and a note says so.
// ERRORS   every ErrorCode; `where` is file:line, or file at a JSON pointer. Never throws on bad data, never hangs.
#pragma once

#include <string>
#include <string_view>

#include "patchproof/error.h"
#include "patchproof/io/model.h"

namespace patchproof {

// Reads a file; the format is recognised from the content, helped by the extension.
Result<ModelFile> read_model(const std::string& path, Decimals decimals = Decimals::exact);

// Reads bytes as if they stood in a file of that name.
Result<ModelFile> read_model_text(std::string_view bytes, const std::string& path, Decimals decimals = Decimals::exact);

}  // namespace patchproof
