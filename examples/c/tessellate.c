/* SPDX-License-Identifier: Apache-2.0 */
/* Triangles with a proved error, closed along the joins.
 *     tessellate MODEL CHORD OUT.stl */
#include <patchproof/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static void check(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  fprintf(stderr, "%s\n", patchproof_error_text(context));
  exit(2);
}

int main(int argc, char** argv) {
  patchproof_context* context = NULL;
  patchproof_model* model = NULL;
  patchproof_mesh* mesh = NULL;
  if (argc != 4 || patchproof_context_create(0, &context) != PATCHPROOF_OK) return 2;
  check(context, patchproof_model_read_file(context, patchproof_from(argv[1]), PATCHPROOF_DECIMALS_EXACT, &model));

  patchproof_tessellate_options options = {.struct_size = sizeof options, .chord = atof(argv[2])};
  check(context, patchproof_tessellate(context, model, &options, NULL, &mesh));
  patchproof_mesh_info info = {.struct_size = sizeof info};
  check(context, patchproof_mesh_get_info(context, mesh, &info));
  printf("%zu vertices, %zu triangles, chord error at most %g, proved for all of them: %d\n", info.vertices,
         info.triangles, info.chord, info.chord_misses == 0);
  printf("watertight: %d, closed: %d\n", info.cracks + info.branching_edges == 0,
         info.cracks + info.branching_edges + info.free_edges == 0);

  double* vertices = malloc(3 * info.vertices * sizeof *vertices);
  int32_t* triangles = malloc(3 * info.triangles * sizeof *triangles);
  if (vertices == NULL || triangles == NULL) return 2;
  check(context,
        patchproof_mesh_get_data(context, mesh, vertices, 3 * info.vertices, triangles, 3 * info.triangles, NULL, 0));
  for (size_t i = 0; i < 3 * info.triangles; ++i)
    if (triangles[i] < 0 || (size_t)triangles[i] >= info.vertices) return 1;

  size_t needed = 0;
  patchproof_mesh_write(context, mesh, PATCHPROOF_MESH_STL, NULL, 0, &needed);
  char* bytes = malloc(needed);
  if (bytes == NULL) return 2;
  check(context, patchproof_mesh_write(context, mesh, PATCHPROOF_MESH_STL, bytes, needed, &needed));
  FILE* file = fopen(argv[3], "wb");
  if (file == NULL || fwrite(bytes, 1, needed - 1, file) != needed - 1 || fclose(file) != 0) return 2;

  free(bytes);
  free(triangles);
  free(vertices);
  patchproof_mesh_free(mesh);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return 0;
}
