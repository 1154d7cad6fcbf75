/* SPDX-License-Identifier: Apache-2.0 */
/* Models: made from arrays, asked what they hold, written exactly, read again. Also how errors are told. */
#include <patchproof/c_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))

static void check(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  fprintf(stderr, "%s\n", patchproof_error_text(context));
  exit(2);
}

/* A quarter of a cylinder, bilinear in v, as a NURBS patch: points along v run fastest. */
static const double arc_knots[] = {0, 0, 0, 1, 1, 1}, line_knots[] = {0, 0, 1, 1};
static const double points[] = {1, 0, 0, 1, 0, 2, 1, 1, 0, 1, 1, 2, 0, 1, 0, 0, 1, 2};
static const double weights[] = {1, 1, 0.7071067811865476, 0.7071067811865476, 1, 1};

static patchproof_surface_data quarter_cylinder(void) {
  patchproof_surface_data data = {.struct_size = sizeof data};
  data.degree_u = 2;
  data.degree_v = 1;
  data.knots_u = arc_knots;
  data.knots_u_length = COUNT(arc_knots);
  data.knots_v = line_knots;
  data.knots_v_length = COUNT(line_knots);
  data.points = points;
  data.points_length = COUNT(points);
  data.weights = weights;
  data.weights_length = COUNT(weights);
  data.name = patchproof_from("quarter");
  return data;
}

int main(void) {
  patchproof_context* context = NULL;
  if (patchproof_abi_version() != PATCHPROOF_ABI_VERSION || patchproof_context_create(0, &context) != PATCHPROOF_OK)
    return 2;

  const patchproof_surface_data patch = quarter_cylinder();
  patchproof_model_data data = {.struct_size = sizeof data, .patches = &patch, .patches_length = 1};
  data.units = patchproof_from("mm");
  patchproof_model* model = NULL;
  check(context, patchproof_model_create(context, &data, &model));

  patchproof_spline_info info = {.struct_size = sizeof info};
  check(context, patchproof_model_patch_get_info(context, model, 0, &info));
  printf("%s: degree (%d, %d), %zu x %zu points, rational: %d, all numbers doubles: %d\n", info.name.data,
         (int)info.degree_u, (int)info.degree_v, info.points_u, info.points_v, (int)info.is_rational,
         (int)info.is_double);

  /* The length first, then the bytes. */
  size_t needed = 0;
  if (patchproof_model_write(context, model, PATCHPROOF_FORMAT_JSON, NULL, 0, &needed) != PATCHPROOF_BUFFER_TOO_SMALL)
    return 1;
  char* json = malloc(needed);
  if (json == NULL) return 2;
  check(context, patchproof_model_write(context, model, PATCHPROOF_FORMAT_JSON, json, needed, &needed));

  patchproof_model* again = NULL;
  const patchproof_text text = {json, needed - 1};
  check(context,
        patchproof_model_read_text(context, text, patchproof_from("again.json"), PATCHPROOF_DECIMALS_EXACT, &again));
  double weight[6];
  patchproof_spline_buffers buffers = {.struct_size = sizeof buffers, .weights = weight, .weights_length = 6};
  check(context, patchproof_model_patch_get_data(context, again, 0, &buffers));
  printf("read again, the weights are the same: %d\n", memcmp(weight, weights, sizeof weight) == 0);

  /* What is wrong, and where. */
  patchproof_model* none = NULL;
  const patchproof_text wrong = patchproof_from("{\"format\":\"patchproof-model\",\"version\":1,\"patches\":7}");
  if (patchproof_model_read_text(context, wrong, patchproof_from("wrong.json"), PATCHPROOF_DECIMALS_EXACT, &none) !=
      PATCHPROOF_BAD_DATA)
    return 1;
  patchproof_error error = {.struct_size = sizeof error};
  patchproof_last_error(context, &error);
  printf("%s: %s (%s)\n", error.where.data, error.message.data, error.code.data);

  free(json);
  patchproof_model_free(again);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return 0;
}
