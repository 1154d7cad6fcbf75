// SPDX-License-Identifier: Apache-2.0
#define PATCHPROOF_ROOFLINE kRooflineAvx2
#define PATCHPROOF_ROOFLINE_SET avx2
#define PATCHPROOF_ROOFLINE_LANES 4
#include "validation/bench/roofline_kernels.h"
