// SPDX-License-Identifier: Apache-2.0
#include "kernels/refine/banded_product.h"

namespace patchproof::kernels::refine {
constinit const Table kSse4 = HWY_NAMESPACE::table();
}
