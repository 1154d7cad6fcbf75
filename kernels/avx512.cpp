// SPDX-License-Identifier: Apache-2.0
#include "kernels/table_of_target.h"

namespace patchproof::kernels {
constinit const KernelTable kAvx512 = HWY_NAMESPACE::table();  // no code of this set runs before it is asked for
}
