// SPDX-License-Identifier: Apache-2.0
#define PATCHPROOF_ROOFLINE kRooflineAvx512
#define PATCHPROOF_ROOFLINE_SET avx512
#define PATCHPROOF_ROOFLINE_LANES 8
#include "validation/bench/roofline_kernels.h"
