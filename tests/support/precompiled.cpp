// SPDX-License-Identifier: Apache-2.0
// Nothing: this file only carries the precompiled headers that all test programs share (tests/CMakeLists.txt).
