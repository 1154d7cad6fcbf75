// SPDX-License-Identifier: Apache-2.0
#include "kernels/table_of_target.h"

namespace patchproof::kernels {
const KernelTable kNeon = HWY_NAMESPACE::table();
}
