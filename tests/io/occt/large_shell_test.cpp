// SPDX-License-Identifier: Apache-2.0
// A generated shell whose joins are known (validation/shell/), small enough for a test. shell_bench does thousands of faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "parts.h"
#include "validation/shell/egg_crate.h"

namespace patchproof::test {
namespace {

class LargeShell : public CadFiles {
 protected:
  CadModel made(const shell::EggCrate& crate) const {
    EXPECT_TRUE(crate.write_step(path("crate.step")));
    return read(path("crate.step"));
  }
};

struct Counted {
  int smooth = 0, kinked = 0, exact = 0;
};

// Every join holds the angle that is known: smooth ones below 1e-3°, kinked ones within 1 %.
Counted expect_truth(const shell::EggCrate& crate, const CadModel& model, const Report& report) {
  constexpr double kRounding = 1e-9;  // degrees: of the file's decimals, and of the doubles in the known angle
  Counted out;
  for (const ReportedJoin& join : report.joins) {
    SCOPED_TRACE(join.id);
    const double truth = crate.angle_of(model, join);
    const EnclosedMaximum& angle = join.certificate.angle;
    EXPECT_LE(angle.lower, truth + kRounding);
    EXPECT_GE(angle.upper, truth - kRounding);
    if (truth == 0) {
      ++out.smooth;
      EXPECT_LT(angle.upper, 1e-3);
      EXPECT_EQ(join.edge_class, EdgeClass::smooth);
    } else {
      ++out.kinked;
      EXPECT_LE(angle.upper - angle.lower, angle.upper / 100);
      EXPECT_EQ(join.edge_class, truth > 5 ? EdgeClass::sharp : truth > 0.01 ? EdgeClass::kinked : EdgeClass::smooth);
    }
    EXPECT_LT(join.certificate.gap.upper, 1e-6);
    out.exact += join.certificate.g1.verdict == Verdict::proven;
  }
  return out;
}

TEST_F(LargeShell, EveryVerdictIsTheKnownOne) {
  const shell::EggCrate crate{14, 13};
  const CadModel model = made(crate);
  EXPECT_EQ(static_cast<int>(model.faces.size()), crate.faces());
  EXPECT_EQ(crate.holes(), 2 * 2);
  const Report report = certify_cad(model);
  ASSERT_EQ(static_cast<int>(report.joins.size()), crate.joins());
  const Counted counted = expect_truth(crate, model, report);
  EXPECT_EQ(counted.kinked, 2 * 13 + 2 * 14);  // the lines 6 and 12 of each direction
  EXPECT_EQ(counted.smooth + counted.kinked, crate.joins());
  // Exactly: all smooth ones between cells, whose numbers are dyadic, and the seams of the cylinders.
  EXPECT_EQ(counted.exact, 11 * 13 + 14 * 10 + crate.holes());
}

TEST_F(LargeShell, TurnedAwayFromTheAxesItIsSmoothUpToRounding) {
  shell::EggCrate crate{7, 7};
  crate.turned = true;
  const CadModel model = made(crate);
  const Report report = certify_cad(model);
  ASSERT_EQ(static_cast<int>(report.joins.size()), crate.joins());
  expect_truth(crate, model, report);
}

TEST_F(LargeShell, TheJobsDoNotChangeTheReport) {
  const CadModel model = made({5, 5});
  std::array<std::string, 2> reports;
  for (const int jobs : {1, 4}) {
    CertifyOptions options;
    options.jobs = jobs;
    std::ostringstream out;
    write_json(out, certify_cad(model, options));
    reports[jobs == 1 ? 0 : 1] = out.str();
  }
  EXPECT_EQ(reports[0], reports[1]);
}

TEST(LargeShellProfile, LeastSlopes) {
  const shell::Profile profile;
  for (int cell = 0; cell < 12; ++cell) {
    double sampled = 1e9;  // by differences of the cubic
    const double p0 = profile.value(cell), p3 = profile.value(cell + 1), p1 = p0 + profile.slope(cell, true),
                 p2 = p3 - profile.slope(cell + 1, false);
    for (int i = 0; i <= 10000; ++i) {
      const double t = i / 1e4, s = 1 - t;
      sampled = std::min(sampled, std::fabs(s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2)));
    }
    EXPECT_NEAR(profile.least_slope(cell), sampled, 1e-3);
    EXPECT_LE(profile.least_slope(cell), sampled + 1e-12);
  }
}

}  // namespace
}  // namespace patchproof::test
