/* SPDX-License-Identifier: Apache-2.0 */
/* Knot insertion, elevation and extraction, exactly: the surface stays the same, and that is proved.
 *     refine MODEL */
#include <patchproof/c_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  fprintf(stderr, "%s\n", patchproof_error_text(context));
  exit(2);
}

/* The exact point of patch 0 at (1/7, 5/7). */
static void point_of(patchproof_context* context, const patchproof_model* model, char text[512]) {
  const patchproof_text uv[] = {patchproof_from("1/7"), patchproof_from("5/7")};
  size_t needed = 0;
  check(context, patchproof_model_patch_evaluate_exact(context, model, 0, uv, 2, NULL, PATCHPROOF_SCALAR_RATIONAL, 0,
                                                       text, 512, &needed));
}

int main(int argc, char** argv) {
  patchproof_context* context = NULL;
  patchproof_model *model = NULL, *finer = NULL, *higher = NULL, *pieces = NULL;
  if (argc != 2 || patchproof_context_create(0, &context) != PATCHPROOF_OK) return 2;
  check(context, patchproof_model_read_file(context, patchproof_from(argv[1]), PATCHPROOF_DECIMALS_EXACT, &model));

  const patchproof_text knots[] = {patchproof_from("1/3"), patchproof_from("2/3"), patchproof_from("2/3")};
  check(context, patchproof_model_patch_insert_knots(context, model, 0, PATCHPROOF_DIRECTION_U, knots, 3, &finer));
  check(context, patchproof_model_patch_elevate(context, finer, 0, PATCHPROOF_DIRECTION_V, 2, &higher));
  check(context, patchproof_model_patch_extract_bezier(context, higher, 0, &pieces));

  patchproof_spline_info before = {.struct_size = sizeof before}, after = {.struct_size = sizeof after};
  patchproof_model_info parts = {.struct_size = sizeof parts};
  check(context, patchproof_model_patch_get_info(context, model, 0, &before));
  check(context, patchproof_model_patch_get_info(context, higher, 0, &after));
  check(context, patchproof_model_get_info(context, pieces, &parts));
  printf("knots along u: %zu, then %zu; degree along v: %d, then %d; Bezier pieces: %zu\n", before.knots_u,
         after.knots_u, (int)before.degree_v, (int)after.degree_v, parts.patches);

  char a[512], b[512];
  point_of(context, model, a);
  point_of(context, higher, b);
  printf("the same exact point at (1/7, 5/7): %d\n", strcmp(a, b) == 0);

  patchproof_model_free(pieces);
  patchproof_model_free(higher);
  patchproof_model_free(finer);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return 0;
}
