// SPDX-License-Identifier: Apache-2.0
// Trimmed edges that run into the pole of a sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "parts.h"

namespace patchproof::test {
namespace {

// Seams of spheres whose parameter curves are not straight, in a file of the ABC data set: each runs into a pole of which
// rounding has left a normal.
TEST_F(CadFiles, SeamsIntoPolesAreSmooth) {
  const std::filesystem::path file = PATCHPROOF_SOURCE_DIR "/../shared/data/step_truck/abc-0000.step";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Report report = certify_cad(read(file.string()));
  int found = 0;
  for (const ReportedJoin& join : report.joins) {
    if (join.a.edge != "edge 15" && join.a.edge != "edge 19") continue;
    SCOPED_TRACE(join.a.edge);
    ++found;
    const Certificate& c = join.certificate;
    EXPECT_LT(c.angle.upper, 1e-3);
    EXPECT_EQ(join.edge_class, EdgeClass::smooth);
    ASSERT_EQ(c.degenerate.size(), 2u);
    EXPECT_TRUE(std::all_of(c.degenerate.begin(), c.degenerate.end(), [](const Degeneracy& d) {
      return d.what == "the normal is rounding errors; left out of the angle" && d.end - d.begin < 1e-6;
    }));
  }
  EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace patchproof::test
