// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gregory_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernels/gregory_kernel.h"
#include "support/batch_results.h"
#include "support/gregory_patches.h"

namespace patchproof::test {
namespace {

using Patch = GregoryPatch<Rational>;

struct Places {
  std::vector<double> u, v;
};

// All pairs, dense at the ends and at the knots of the dyadic patches.
Places places() {
  std::vector<double> one{0, 0x1p-1074, 0x1p-600, 0x1.8p-257, 0x1p-256, 0x1p-100, 1e-9, 0x1p-11, 0.1, 0.5, 1.0 / 3};
  for (const double knot : {0.25, 0.625})
    one.insert(one.end(), {std::nextafter(knot, 0), knot, std::nextafter(knot, 1)});
  for (const double y : {0x1p-9, 0x1p-20, 0x1p-53, 0.0}) one.push_back(1 - y);
  Places out;
  for (const double u : one)
    for (const double v : one) out.u.push_back(u), out.v.push_back(v);
  return out;
}

Places every(std::size_t step, const Places& all) {
  Places out;
  for (std::size_t i = 0; i < all.u.size(); i += step) out.u.push_back(all.u[i]), out.v.push_back(all.v[i]);
  return out;
}

bool is_corner(double u, double v) { return (u == 0 || u == 1) && (v == 0 || v == 1); }

// U and V of the rounded numbers, less the C surface of the patch: up to the first, or to the second derivatives.
std::vector<Vec<Rational, 3>> exact_vectors(const BatchGregory& batch, double u, double v) {
  const Rational at_u = from_double(u), at_v = from_double(v);
  const bool corner = is_corner(u, v);
  const int order = corner ? 1 : 2;
  const auto of_u = rational_derivatives(batch.u_surface(), at_u, at_v, order, order),
             of_v = rational_derivatives(batch.v_surface(), at_u, at_v, order, order);
  std::vector<Vec<Rational, 3>> c;
  if (corner) {
    const SurfaceFrame<Rational> f = frame(batch.patch(), at_u, at_v);  // S^c has the same
    c = {f.point, f.du, f.dv};
  } else {
    using Series = PowerSeries<Rational, 2>;
    const auto h =
        evaluate_c_surface<Series>(batch.patch(), Series::variable(0, at_u, 2), Series::variable(1, at_v, 2));
    const Series w = Series(Rational(1)) / h[3];
    const Vec<Series, 3> s{{h[0] * w, h[1] * w, h[2] * w}};
    for (const auto& k : {std::array{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}})
      c.push_back(detail::derivative_of(s, k));
  }
  constexpr int kOrders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (std::size_t m = 0; m < c.size(); ++m)
    c[m] = of_u.at(kOrders[m][0], kOrders[m][1]) + of_v.at(kOrders[m][0], kOrders[m][1]) - c[m];
  return c;
}

struct NamedPatch {
  std::string name;
  Patch patch;
  bool polynomial;
};
std::vector<NamedPatch> patches() {
  RandomRationals random;
  std::vector<NamedPatch> out;
  for (int k = 0; k < 3; ++k) out.push_back({"dyadic", random_gregory_patch(random, {.dyadic = true}), true});
  out.push_back({"thirds", random_gregory_patch(random), true});
  out.push_back({"rational", random_gregory_patch(random, {.rational = true, .dyadic = true}), false});
  out.push_back({"rational thirds", random_gregory_patch(random, {.rational = true}), false});
  const auto moved = [&](const Patch& p, double factor, double offset) {
    return mapped_patch(p, [&](const Vec<Rational, 4>& q) {
      Vec<Rational, 4> r{{0, 0, 0, q[3]}};
      for (std::size_t c = 0; c < 3; ++c) r[c] = from_double(factor) * q[c] + from_double(offset) * q[3];
      return r;
    });
  };
  out.push_back({"far away", moved(out[0].patch, 1, 0x1p20), true});
  out.push_back({"small", moved(out[1].patch, 0x1p-40, 0), true});
  return out;
}

TEST(GregoryBatch, Law1_Law3_WithinTheBoundEverywhereOnEveryInstructionSet) {
  for (const NamedPatch& one : patches()) {
    SCOPED_TRACE(one.name);
    const Places at = every(one.polynomial ? 1 : 3, places());  // those with weights take long near the corners
    const BatchGregory batch = BatchGregory::make(one.patch).value();
    EXPECT_EQ(batch.is_polynomial(), one.polynomial);
    for (int m = 0; m < 6; ++m)
      EXPECT_EQ(std::isfinite(batch.error_bound(static_cast<SurfaceVector>(m))), m == 0 || one.polynomial);
    for (const InstructionSet set : {InstructionSet::portable, InstructionSet::fastest}) {
      Results r(at.u.size());
      SurfaceBatchOptions options;
      options.instructions = set;
      ASSERT_TRUE(batch.evaluate(at.u, at.v, r.out, options));
      double worst[6] = {};
      for (std::size_t i = 0; i < at.u.size(); ++i) {
        for (int m = 0; m < kVectors; ++m)
          for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(r.numbers[m][3 * i + c])) << at.u[i] << " " << at.v[i];
        if (i % 13 != 0 && !is_corner(at.u[i], at.v[i])) continue;
        const std::vector<Vec<Rational, 3>> exact = exact_vectors(batch, at.u[i], at.v[i]);
        for (std::size_t m = 0; m < exact.size(); ++m) {
          const double bound = batch.error_bound(static_cast<SurfaceVector>(m));
          for (std::size_t c = 0; c < 3; ++c) {
            const Rational error = abs(Rational(from_double(r.numbers[m][3 * i + c]) - exact[m][c]));
            if (std::isfinite(bound)) {
              ASSERT_LE(error, from_double(bound)) << "vector " << m << " at " << at.u[i] << ", " << at.v[i];
              worst[m] = std::max(worst[m], nearest_double(Rational(error / from_double(bound))));
            } else {
              // Not known in advance; and yet no nonsense.
              const double size = 1 + std::fabs(nearest_double(exact[m][c]));
              ASSERT_LE(nearest_double(error), (m < 3 ? 1e-9 : 1e-6) * size)
                  << "vector " << m << " at " << at.u[i] << ", " << at.v[i];
            }
          }
        }
      }
      std::printf("%s: error / bound %.3f %.3f %.3f %.3f %.3f %.3f\n", one.name.c_str(), worst[0], worst[1], worst[2],
                  worst[3], worst[4], worst[5]);
      // With weights from 1/4 to 3 the smallest one speaks for all.
      EXPECT_GT(worst[0], one.polynomial ? 1e-3 : 1e-5) << "a bound that is never approached";
    }
  }
}

// The bound's own steps: the body on Tracked stays below the count of roundings.
TEST(GregoryBatch, Law1_TheCountOfRoundingsCoversTracked) {
  RandomRationals random;
  const BatchGregory batch = BatchGregory::make(random_gregory_patch(random, {.dyadic = true})).value();
  kernels::GregoryNets nets{};
  double m = 0, s = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto &q0 = batch.patch().from_u()[i][j], &q1 = batch.patch().from_v()[i][j];
        nets.q[i][j][c] = nearest_double(q1[c]);
        m = std::max(m, std::fabs(nets.q[i][j][c]));
        if (i % 3 != 0 && j % 3 != 0) nets.inner[i / 2][j / 2][c] = nearest_double(Rational(q0[c] - q1[c]));
      }
  for (std::size_t k = 0; k < 4; ++k) {
    double d = 0;
    for (std::size_t c = 0; c < 3; ++c) d = std::max(d, std::fabs(nets.inner[k / 2][k % 2][c]));
    s += d;
  }
  const double moduli[6] = {m + s / 5, 6 * m + 2 * s, 6 * m + 2 * s, 24 * m + 27 * s, 36 * m + 27 * s, 24 * m + 27 * s};
  const double unit = (kernels::roundings<2, true>() + 1) * 0x1p-53 * (1 + 0x1p-40);
  for (const double u : {0x1p-256, 1e-20, 0.1, 1.0 / 3, 0.7, 1 - 0x1p-53})
    for (const double v : {0x1p-256, 1e-7, 0.5, 0.9}) {
      // Tracked takes 1 − u as rounded here, and so knows of its error.
      const Tracked x(u), y(v), one(1);
      kernels::CSurfaceValues<Tracked> out;
      kernels::c_surface<Tracked, 2, true>(nets, {x, one - x}, {y, one - y}, out);
      for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 3; ++c) EXPECT_LE(out[k][c].error(), unit * moduli[k]) << u << ", " << v << " vector " << k;
    }
}

TEST(GregoryBatch, Law2_SameBits) {
  const Places at = every(4, places());
  for (const NamedPatch& one : patches()) {
    if (one.name != "dyadic" && one.name != "rational") continue;
    SCOPED_TRACE(one.name);
    const BatchGregory batch = BatchGregory::make(one.patch).value();
    const std::size_t n = at.u.size();
    Results all(n), threads(n), points(n, 1), first(n, 3);
    ASSERT_TRUE(batch.evaluate(at.u, at.v, all.out));
    SurfaceBatchOptions four;
    four.threads = 4;
    ASSERT_TRUE(batch.evaluate(at.u, at.v, threads.out, four));
    ASSERT_TRUE(batch.evaluate(at.u, at.v, points.out));
    ASSERT_TRUE(batch.evaluate(at.u, at.v, first.out));
    for (int m = 0; m < kVectors; ++m) EXPECT_EQ(all.numbers[m], threads.numbers[m]);
    EXPECT_EQ(all.numbers[0], points.numbers[0]);
    EXPECT_EQ(all.numbers[1], first.numbers[1]);
    for (const InstructionSet set : available_instruction_sets()) {
      if (fuses_multiply_add(set) != fuses_multiply_add(InstructionSet::fastest)) continue;
      SurfaceBatchOptions options;
      options.instructions = set;
      Results other(n);
      ASSERT_TRUE(batch.evaluate(at.u, at.v, other.out, options));
      for (int m = 0; m < kVectors; ++m) EXPECT_EQ(all.numbers[m], other.numbers[m]) << to_string(set);
    }
    for (const std::size_t begin : {std::size_t{1}, std::size_t{5}, n - 3})
      for (const std::size_t count : {0, 1, 2, 3}) {
        Results part(count);
        ASSERT_TRUE(batch.evaluate({&at.u[begin], count}, {&at.v[begin], count}, part.out));
        for (int m = 0; m < kVectors; ++m)
          for (std::size_t k = 0; k < 3 * count; ++k) EXPECT_EQ(part.numbers[m][k], all.numbers[m][3 * begin + k]);
      }
  }
}

TEST(GregoryBatch, Law3_CornersAreThePointsAndTangentsOfTheEdges) {
  for (const NamedPatch& one : patches()) {
    const BatchGregory batch = BatchGregory::make(one.patch).value();
    const std::vector<double> u{0, 1, 1, 0}, v{0, 0, 1, 1};
    Results r(4);
    const auto done = batch.evaluate(u, v, r.out);
    ASSERT_TRUE(done);
    for (std::size_t i = 0; i < 4; ++i) {
      const SurfaceFrame<Rational> f = frame(batch.patch(), from_double(u[i]), from_double(v[i]));
      double length = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double size = 1e-12 * (1 + std::fabs(nearest_double(f.point[c])));
        EXPECT_NEAR(r.numbers[0][3 * i + c], nearest_double(f.point[c]), size);
        length += r.numbers[6][3 * i + c] * r.numbers[6][3 * i + c];
      }
      EXPECT_NEAR(length, 1, 1e-12);
    }
  }
}

TEST(GregoryBatch, Law4_TheSideChoosesTheLimit) {
  RandomRationals random;
  for (int k = 0; k < 8; ++k) {
    const Patch patch = random_gregory_patch(random, {.dyadic = true});
    const auto breaks = patch.v_surface().knots(Direction::u).breaks();
    if (breaks.size() < 3) continue;
    const BatchGregory batch = BatchGregory::make(patch).value();
    const std::vector<double> u{nearest_double(breaks[1])}, v{0.4};
    for (const Side side : {Side::left, Side::right}) {
      Results r(1);
      SurfaceBatchOptions options;
      options.side_u = side;
      ASSERT_TRUE(batch.evaluate(u, v, r.out, options));
      const SecondDerivatives<Rational> d = second_derivatives(patch, breaks[1], from_double(0.4), side);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(r.numbers[3][c], nearest_double(d.duu[c]), batch.error_bound(SurfaceVector::duu));
    }
    return;
  }
  FAIL() << "no patch with a knot";
}

TEST(GregoryBatch, Law5_OutsideIsAnErrorThatNamesTheIndex) {
  RandomRationals random;
  const BatchGregory batch = BatchGregory::make(random_gregory_patch(random)).value();
  for (const double bad : {-0x1p-1074, std::nextafter(1.0, 2), std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
    std::vector<double> u(700, 0.5), v(700, 0.25);
    v[513] = bad;
    Results r(700, 1);
    const auto done = batch.evaluate(u, v, r.out);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::outside_domain);
    EXPECT_EQ(done.error().where, "parameter 513");
  }
}

TEST(GregoryBatch, Law6_PolynomialAndNumbersThatAreNoDoubles) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.dyadic = true});
  const Rational huge = pow(Integer(10), 400);
  const auto far = mapped_patch(patch, [&](const Vec<Rational, 4>& p) {
    return Vec<Rational, 4>{{p[0] * huge, p[1], p[2], p[3]}};
  });
  const auto made = BatchGregory::make(far);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::bad_number);
  for (const NamedPatch& one : patches())
    EXPECT_EQ(BatchGregory::make(one.patch).value().is_polynomial(), one.polynomial);
}

}  // namespace
}  // namespace patchproof::test
