// SPDX-License-Identifier: Apache-2.0
#define PATCHPROOF_ROOFLINE kRooflinePortable
#define PATCHPROOF_ROOFLINE_SET portable
#define PATCHPROOF_ROOFLINE_LANES 1
#include "validation/bench/roofline_kernels.h"
