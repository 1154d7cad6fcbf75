// SPDX-License-Identifier: Apache-2.0
// A Coons patch of four curves: made exactly, proved to contain them, expanded to a B-spline patch and written as a model.
#include <iostream>

#include "patchproof/io/write.h"
#include "patchproof/patch/coons_patch.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/patch/transfinite_expand.h"

int main() {
  using namespace patchproof;
  using Surface = TransfiniteMap<Rational, 2, 3>;
  const auto point = [](Rational x, Rational y, Rational z) { return Surface(Vec<Rational, 3>{{x, y, z}}); };
  // Bézier curves in the parameter u (0) or v (1).
  const auto curve = [](int parameter, std::vector<Surface> points) { return *Surface::bezier(parameter, points); };
  const FourSides<Rational, 3> boundary{
      curve(0, {point(0, 0, 0), point(10, 0, 0)}),                                       // v = 0
      curve(0, {point(0, 10, 0), point(3, 10, 5), point(7, 10, -5), point(10, 10, 0)}),  // v = 1
      curve(1, {point(0, 0, 0), point(0, 5, 6), point(0, 10, 0)}),                       // u = 0
      curve(1, {point(10, 0, 0), point(10, 3, 0), point(10, 7, 3), point(10, 10, 0)})};  // u = 1

  const auto surface = coons_patch(boundary);
  if (!surface) {
    std::cerr << surface.error().text() << "\n";  // names the corner where two curves do not meet
    return 2;
  }
  std::cerr << "contains its four curves, at every parameter: " << (interpolates(*surface, boundary) ? "proved" : "no")
            << "\n";
  Model<Rational> model;
  model.patches.push_back({"coons", to_homogeneous(to_bspline_patch(*surface)), false});
  std::cout << write_model_json(model);
}
