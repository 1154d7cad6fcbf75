// SPDX-License-Identifier: Apache-2.0
// All kernels for the instruction set of the including file: its compiler flags choose highway's target.
#pragma once

#include "kernels/bounded_kernels.h"
#include "kernels/compensated_kernels.h"
#include "kernels/grid_kernels.h"

namespace patchproof::kernels::HWY_NAMESPACE {

constexpr KernelTable table() { return {&surface, &grid, &bounded, &curve, &compensated}; }

}  // namespace patchproof::kernels::HWY_NAMESPACE
