// SPDX-License-Identifier: Apache-2.0
// What bench.cpp's main registers besides its own benchmarks.
#pragma once

namespace patchproof::bench {

// Our kernels and the peers: WORKLOAD/ARRANGEMENT/QUANTITY|PEER/VARIANT. PATCHPROOF_PLUGINS names more peers (peer.h),
// separated by colons.
void register_kernel_benchmarks();
// Points with bounds, enclosures, doubled precision: SURFACE/accurate/points|PEER/METHOD.
void register_accuracy_benchmarks();
// Gregory patches beside one of their surfaces: gregory/WHAT|KIND.
void register_gregory_benchmarks();
// The limits of the machine: roofline/WHAT|SET.
void register_roofline_benchmarks();

}  // namespace patchproof::bench
