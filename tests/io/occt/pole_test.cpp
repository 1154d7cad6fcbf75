// SPDX-License-Identifier: Apache-2.0
// Trimmed edges that run into the pole of a sphere.
#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>

#include <algorithm>
#include <cmath>
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

// A sector of a body of revolution about its axis: its plane sides stand upright on the round one all along the meridians, up
// to the pole, where the round one has no normal.
class Sectors : public CadFiles {
 protected:
  void expect_upright(const TopoDS_Shape& sector) const {
    const Report report = certify_cad(read(write_brep(sector)));
    int into_pole = 0;
    for (const ReportedJoin& join : report.joins) {
      SCOPED_TRACE(join.a.edge);
      const Certificate& c = join.certificate;
      if (!c.degenerate.empty()) {
        ++into_pole;
        EXPECT_LE(c.angle.lower, 90 + 1e-9);
        EXPECT_GE(c.angle.upper, 90 - 1e-9);
        EXPECT_LT(c.angle.upper - c.angle.lower, 0.9);
      }
      EXPECT_EQ(join.edge_class, EdgeClass::sharp);
    }
    EXPECT_EQ(into_pole, 2);
  }
};

TEST_F(Sectors, OfASphere) {
  expect_upright(BRepPrimAPI_MakeSphere(3.0, 0.0, M_PI / 2, 2.0).Shape());
  expect_upright(BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 3)), 3.0, 0.0, M_PI / 2, 1.0).Shape());
}

TEST_F(Sectors, OfACone) { expect_upright(BRepPrimAPI_MakeCone(3.0, 0.0, 4.0, 1.5).Shape()); }

}  // namespace
}  // namespace patchproof::test
