// SPDX-License-Identifier: Apache-2.0
// Points and normals of a NURBS surface at many parameters: each point with a proven bound of its error, and the same
// points correctly rounded.
#include <cmath>
#include <cstdio>
#include <vector>

#include "patchproof/patch/evaluate_batch.h"

int main() {
  // A quarter of a cylinder of radius 2: quadratic with weights along u, linear along v.
  const double root = std::sqrt(0.5);
  const std::vector<double> knots_u = {0, 0, 0, 1, 1, 1}, knots_v = {0, 0, 1, 1};
  const std::vector<double> points = {2, 0, 0, 2, 0, 5, 2, 2, 0, 2, 2, 5, 0, 2, 0, 0, 2, 5};
  const std::vector<double> weights = {1, 1, root, root, 1, 1};
  const auto surface = patchproof::BatchSurface::make({2, 1, knots_u, knots_v, points, weights});
  if (!surface) return std::fprintf(stderr, "%s\n", surface.error().text().c_str()), 2;

  const std::size_t n = 100000;
  std::vector<double> u(n), v(n, 0.25), xyz(3 * n), normal(3 * n), bound(n), exact(3 * n);
  for (std::size_t i = 0; i < n; ++i) u[i] = static_cast<double>(i) / (n - 1);

  patchproof::SurfaceOutput out;  // what is wanted, and where it goes
  out.point = patchproof::VectorArray::interleaved(xyz.data());
  out.normal = patchproof::VectorArray::interleaved(normal.data());
  patchproof::SurfaceBatchOptions options;
  options.threads = 0;  // all processors
  const auto done = surface->evaluate(u, v, out, options);
  const auto bounded = surface->evaluate_bounded(u, v, out.point, bound.data());
  const auto rounded = surface->evaluate_correctly_rounded(u, v, patchproof::VectorArray::interleaved(exact.data()));
  if (!done || !bounded || !rounded) return 2;

  double worst = 0, largest_bound = 0;
  for (std::size_t i = 0; i < n; ++i) {
    largest_bound = std::fmax(largest_bound, bound[i]);
    for (int k = 0; k < 3; ++k) worst = std::fmax(worst, std::fabs(xyz[3 * i + k] - exact[3 * i + k]));
  }
  std::printf("%s kernels: point (%.17g, %.17g, %.17g), normal (%.6f, %.6f, %.6f)\n",
              to_string(resolve(patchproof::InstructionSet::fastest)), xyz[150], xyz[151], xyz[152], normal[150],
              normal[151], normal[152]);
  std::printf("largest distance from the correctly rounded points %.3g, largest proven bound %.3g\n", worst,
              largest_bound);
  return worst <= largest_bound ? 0 : 1;
}
