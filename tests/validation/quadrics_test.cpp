// SPDX-License-Identifier: Apache-2.0
// The exact quadrics and tori of examples/ lie on the surfaces that their names say, identically.
//
// An implicit equation F = 0, homogeneous of degree k, becomes on each polynomial piece of degrees (p, q) a polynomial of
// degrees at most (k p, k q). It vanishes identically when it vanishes on a grid of (k p + 1) × (k q + 1) parameters.
#include <gtest/gtest.h>

#include "patchproof/io/read.h"

namespace patchproof {
namespace {

template <class T>
T sphere(const Vec<T, 4>& p) {
  return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - p[3] * p[3];
}
template <class T>
T cylinder(const Vec<T, 4>& p) {
  return p[0] * p[0] + p[1] * p[1] - T(9) * p[3] * p[3];
}
// (x² + y² + z² + R² − r²)² = 4 R² (x² + y²) with R = 3, r = 1.
template <class T>
T torus(const Vec<T, 4>& p) {
  const T around = p[0] * p[0] + p[1] * p[1], w = p[3] * p[3], s = around + p[2] * p[2] + T(8) * w;
  return s * s - T(36) * around * w;
}

// Begin, …, end in `steps` equal steps.
template <class T>
std::vector<T> grid(const T& begin, const T& end, int steps) {
  std::vector<T> out;
  for (int i = 0; i <= steps; ++i) out.push_back(begin + T(i) / T(steps) * (end - begin));
  return out;
}

// On how many pieces does F vanish identically, and on how many not?
template <class T, class F>
std::pair<int, int> count_pieces(const BsplinePatch<T, 4>& patch, int degree, F equation) {
  std::pair<int, int> count{0, 0};
  const KnotVector<T>&u = patch.knots(Direction::u), &v = patch.knots(Direction::v);
  const std::vector<T> us = u.breaks(), vs = v.breaks();
  for (std::size_t i = 0; i + 1 < us.size(); ++i)
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      bool zero = true;
      for (const T& s : grid(us[i], us[i + 1], degree * u.degree()))
        for (const T& t : grid(vs[j], vs[j + 1], degree * v.degree()))
          zero = zero && equation(evaluate_in_span(patch, u.find_span(us[i]), v.find_span(vs[j]), s, t)) == T(0);
      ++(zero ? count.first : count.second);
    }
  return count;
}

template <class T, class F>
void expect_on_surface(const char* name, int degree, int pieces, F equation) {
  const Result<ModelFile> file = read_model(std::string(PATCHPROOF_SOURCE_DIR "/examples/") + name);
  ASSERT_TRUE(file) << file.error().text();
  const Model<T>* model = std::get_if<Model<T>>(&file->model);
  ASSERT_NE(model, nullptr) << name << " has other numbers than expected";
  int on = 0, off = 0;
  for (const ModelPatch<T>& patch : model->patches) {
    const auto [zero, other] = count_pieces(patch.surface, degree, equation);
    on += zero, off += other;
  }
  EXPECT_EQ(on, pieces) << name;
  EXPECT_EQ(off, 0) << name;

  // The test can fail: one homogeneous coordinate moved by 10^-30.
  const BsplinePatch<T, 4>& first = model->patches[0].surface;
  std::vector<Vec<T, 4>> net = first.net();
  net[0][0] = net[0][0] + embed<T>(*parse_scalar<Rational>("1e-30"));
  const BsplinePatch<T, 4> moved(first.knots(Direction::u), first.knots(Direction::v), std::move(net));
  EXPECT_EQ(count_pieces(moved, degree, equation).second, 1) << name;
}

TEST(Quadrics, SphereOverRootTwo) { expect_on_surface<Quadratic>("sphere_octants.json", 2, 8, sphere<Quadratic>); }
TEST(Quadrics, SphereOverQ) { expect_on_surface<Rational>("sphere_q.json", 2, 8, sphere<Rational>); }
TEST(Quadrics, TorusOverRootTwo) { expect_on_surface<Quadratic>("torus.json", 4, 16, torus<Quadratic>); }
TEST(Quadrics, TorusOverQ) { expect_on_surface<Rational>("torus_q.json", 4, 16, torus<Rational>); }
TEST(Quadrics, CylinderOverRootTwo) { expect_on_surface<Quadratic>("cylinder.json", 2, 4, cylinder<Quadratic>); }
TEST(Quadrics, CylinderOverQ) { expect_on_surface<Rational>("cylinder_q.json", 2, 4, cylinder<Rational>); }

}  // namespace
}  // namespace patchproof
