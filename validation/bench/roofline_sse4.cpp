// SPDX-License-Identifier: Apache-2.0
#define PATCHPROOF_ROOFLINE kRooflineSse4
#define PATCHPROOF_ROOFLINE_SET sse4
#define PATCHPROOF_ROOFLINE_LANES 2
#include "validation/bench/roofline_kernels.h"
