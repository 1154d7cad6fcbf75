/* SPDX-License-Identifier: Apache-2.0 */
/* A program outside the project, in C: two unit squares with a right angle between them, from arrays. Their join is refuted as
 * G1 and its angle bounded, a point is evaluated, a text that is no model is refused. */
#include <patchproof/c_api.h>
#include <stdio.h>
#include <string.h>

static int failed(const char* what, patchproof_context* context) {
  fprintf(stderr, "%s: %s\n", what, context != NULL ? patchproof_error_text(context) : "no context");
  return 1;
}

static patchproof_surface_data square(const double* knots, const double* points) {
  patchproof_surface_data data;
  memset(&data, 0, sizeof data);
  data.struct_size = sizeof data;
  data.degree_u = data.degree_v = 1;
  data.knots_u = data.knots_v = knots;
  data.knots_u_length = data.knots_v_length = 4;
  data.points = points;
  data.points_length = 12;
  return data;
}

int main(void) {
  const double knots[] = {0, 0, 1, 1};
  const double floor_points[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}; /* z = 0; points along v run fastest */
  const double wall_points[] = {1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1};  /* x = 1 */
  const double u = 0.25, v = 0.5;
  double point[3] = {0, 0, 0};
  patchproof_context* context = NULL;
  patchproof_model *model = NULL, *none = NULL;
  patchproof_report* report = NULL;
  patchproof_surface* surface = NULL;
  patchproof_surface_data patches[2];
  patchproof_model_data data;
  patchproof_join_report join;
  patchproof_derivatives out;
  patchproof_parameters at = {NULL, NULL, 1, 1};

  if (patchproof_abi_version() != PATCHPROOF_ABI_VERSION) return failed("another ABI", NULL);
  if (patchproof_context_create(0, &context) != PATCHPROOF_OK) return failed("context", NULL);
  patches[0] = square(knots, floor_points);
  patches[1] = square(knots, wall_points);
  memset(&data, 0, sizeof data);
  data.struct_size = sizeof data;
  data.patches = patches;
  data.patches_length = 2;
  if (patchproof_model_create(context, &data, &model) != PATCHPROOF_OK) return failed("model", context);
  if (patchproof_certify(context, model, NULL, NULL, &report) != PATCHPROOF_OK) return failed("certify", context);
  memset(&join, 0, sizeof join);
  join.struct_size = sizeof join;
  if (patchproof_report_get_join(context, report, 0, &join) != PATCHPROOF_OK) return failed("join", context);
  printf("patchproof %s: C0 %d, G1 %d, angle in [%.3f, %.3f]\n", patchproof_version(), (int)join.c0.verdict,
         (int)join.g1.verdict, join.angle.lower, join.angle.upper);
  if (join.c0.verdict != PATCHPROOF_VERDICT_PROVEN || join.g1.verdict != PATCHPROOF_VERDICT_REFUTED)
    return failed("verdict", context);
  if (!(join.angle.lower > 89 && join.angle.lower <= 90 && join.angle.upper >= 90 && join.angle.upper < 91))
    return failed("angle", context);

  if (patchproof_surface_of(context, model, 0, &surface) != PATCHPROOF_OK) return failed("surface", context);
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.point.x = point;
  out.point.y = point + 1;
  out.point.z = point + 2;
  out.point.count = 1;
  at.u = &u;
  at.v = &v;
  if (patchproof_surface_evaluate(context, surface, at, NULL, &out) != PATCHPROOF_OK)
    return failed("evaluate", context);
  if (point[0] != 0.25 || point[1] != 0.5 || point[2] != 0) return failed("point", context);

  if (patchproof_model_read_text(context, patchproof_from("no model"), patchproof_from("it"), PATCHPROOF_DECIMALS_EXACT,
                                 &none) != PATCHPROOF_BAD_DATA ||
      none != NULL)
    return failed("a text that is no model", context);
  printf("refused: %s\n", patchproof_error_text(context));

  patchproof_surface_free(surface);
  patchproof_report_free(report);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return 0;
}
