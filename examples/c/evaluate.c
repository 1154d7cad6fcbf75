/* SPDX-License-Identifier: Apache-2.0 */
/* Evaluation in batches: points and derivatives in double, with bounds, correctly rounded, and exact.
 *     evaluate MODEL */
#include <math.h>
#include <patchproof/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static void check(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  fprintf(stderr, "%s\n", patchproof_error_text(context));
  exit(2);
}

enum { COUNT = 1000 };

int main(int argc, char** argv) {
  patchproof_context* context = NULL;
  patchproof_model* model = NULL;
  patchproof_surface* surface = NULL;
  if (argc != 2 || patchproof_context_create(0, &context) != PATCHPROOF_OK) return 2;
  check(context, patchproof_model_read_file(context, patchproof_from(argv[1]), PATCHPROOF_DECIMALS_EXACT, &model));
  check(context, patchproof_surface_of(context, model, 0, &surface));

  patchproof_spline_info info = {.struct_size = sizeof info};
  check(context, patchproof_model_patch_get_info(context, model, 0, &info));
  static double uv[2 * COUNT], point[3 * COUNT], du[3 * COUNT], bound[COUNT], rounded[3 * COUNT];
  for (int i = 0; i < COUNT; ++i) { /* along the diagonal of the domain */
    const double s = (double)i / (COUNT - 1);
    uv[2 * i] = info.domain[0] + s * (info.domain[1] - info.domain[0]);
    uv[2 * i + 1] = info.domain[2] + s * (info.domain[3] - info.domain[2]);
  }
  const patchproof_parameters at = {uv, uv + 1, COUNT, 2};

  /* The library reads u v u v … and writes x y z x y z … where they are. */
  patchproof_derivatives out = {.struct_size = sizeof out};
  out.point = (patchproof_vectors){point, point + 1, point + 2, COUNT, 3};
  out.du = (patchproof_vectors){du, du + 1, du + 2, COUNT, 3};
  check(context, patchproof_surface_evaluate(context, surface, at, NULL, &out));
  double everywhere = 0;
  check(context, patchproof_surface_error_bound(context, surface, PATCHPROOF_VECTOR_POINT, &everywhere));
  printf("%d points, each coordinate within %.3g of the exact one\n", COUNT, everywhere);

  const patchproof_vectors points = {point, point + 1, point + 2, COUNT, 3};
  const patchproof_vectors nearest = {rounded, rounded + 1, rounded + 2, COUNT, 3};
  check(context, patchproof_surface_evaluate_bounded(context, surface, at, NULL, points, bound, COUNT));
  check(context, patchproof_surface_evaluate_rounded(context, surface, at, NULL, nearest));
  for (int i = 0; i < 3 * COUNT; ++i) /* the nearest double is half a unit in its last place off */
    if (fabs(point[i] - rounded[i]) > bound[i / 3] + fabs(rounded[i]) * 0x1p-53) return 1;

  /* Exact numbers come as texts: a point, S_u and S_v in the middle. */
  const patchproof_text middle[] = {patchproof_from("1/2"), patchproof_from("0.5")};
  char text[4096];
  size_t needed = 0;
  check(context, patchproof_model_patch_evaluate_exact(context, model, 0, middle, 2, NULL, PATCHPROOF_SCALAR_RATIONAL,
                                                       1, text, sizeof text, &needed));
  printf("%s", text);

  patchproof_surface_free(surface);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return 0;
}
