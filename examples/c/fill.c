/* SPDX-License-Identifier: Apache-2.0 */
/* A mesh of curves filled with Gregory patches, and what was proved of them.
 *     fill CURVEMESH MODEL.json */
#include <patchproof/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static void check(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  fprintf(stderr, "%s\n", patchproof_error_text(context));
  exit(2);
}

int main(int argc, char** argv) {
  static char bytes[1 << 20];
  patchproof_context* context = NULL;
  patchproof_model* model = NULL;
  FILE* file = argc == 3 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL || patchproof_context_create(0, &context) != PATCHPROOF_OK) return 2;
  const patchproof_text mesh = {bytes, fread(bytes, 1, sizeof bytes, file)};
  fclose(file);

  patchproof_fill_summary summary = {.struct_size = sizeof summary};
  check(context, patchproof_fill(context, mesh, patchproof_from(argv[1]), NULL, NULL, &model, &summary));
  printf("%zu faces, %zu smooth edges\nG1: %zu proven, %zu refuted, %zu undecided\n", summary.faces,
         summary.smooth_edges, summary.g1[PATCHPROOF_VERDICT_PROVEN], summary.g1[PATCHPROOF_VERDICT_REFUTED],
         summary.g1[PATCHPROOF_VERDICT_UNDECIDED]);
  printf("%s", summary.findings.data); /* what is not proven */

  size_t needed = 0;
  patchproof_model_write(context, model, PATCHPROOF_FORMAT_JSON, NULL, 0, &needed);
  char* json = malloc(needed);
  if (json == NULL) return 2;
  check(context, patchproof_model_write(context, model, PATCHPROOF_FORMAT_JSON, json, needed, &needed));
  file = fopen(argv[2], "wb");
  if (file == NULL || fwrite(json, 1, needed - 1, file) != needed - 1 || fclose(file) != 0) return 2;

  free(json);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return 0;
}
