/* SPDX-License-Identifier: Apache-2.0 */
/* How the patches of a model join: proofs, witnesses, certified bounds. With progress, and stopped from the callback on request.
 *     certify MODEL [REPORT.json] */
#include <patchproof/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static void check(patchproof_context* context, patchproof_status status) {
  if (status == PATCHPROOF_OK) return;
  fprintf(stderr, "%s\n", patchproof_error_text(context));
  exit(2);
}

static int32_t count_calls(void* user, uint64_t done, uint64_t all) {
  (void)done;
  (void)all;
  ++*(int*)user;
  return 0; /* anything else stops the work */
}

int main(int argc, char** argv) {
  static const char* const verdicts[] = {"proven", "refuted", "undecided"};
  patchproof_context* context = NULL;
  patchproof_model* model = NULL;
  patchproof_report* report = NULL;
  if (argc < 2 || patchproof_context_create(0, &context) != PATCHPROOF_OK) return 2;
  check(context, patchproof_model_read_file(context, patchproof_from(argv[1]), PATCHPROOF_DECIMALS_EXACT, &model));

  int calls = 0;
  const patchproof_callback callback = {&calls, count_calls};
  patchproof_certify_options options = {.struct_size = sizeof options, .require = PATCHPROOF_CLASS_G1};
  check(context, patchproof_certify(context, model, &options, &callback, &report));

  patchproof_report_summary summary = {.struct_size = sizeof summary};
  check(context, patchproof_report_get_summary(context, report, &summary));
  printf("%zu joins: %zu pass, %zu fail, %zu undecided; the callback was called: %d\n", summary.joins, summary.passed,
         summary.failed, summary.undecided, calls > 0);
  for (size_t i = 0; i < summary.joins; ++i) {
    patchproof_join_report join = {.struct_size = sizeof join};
    check(context, patchproof_report_get_join(context, report, i, &join));
    printf("patch %d %s - patch %d %s: G1 %s, angle in [%g, %g] degrees\n", (int)join.a.patch, join.a.edge.data,
           (int)join.b.patch, join.b.edge.data, verdicts[join.g1.verdict], join.angle.lower, join.angle.upper);
    patchproof_witness witness = {.struct_size = sizeof witness};
    check(context, patchproof_report_get_witness(context, report, i, PATCHPROOF_CLASS_G1, &witness));
    if (witness.found)
      printf("  witness: at (%s, %s) of patch %d %s is\n%s", witness.a[0].data, witness.a[1].data, (int)join.a.patch,
             witness.quantity.data, witness.values.data);
  }

  if (argc > 2) {
    size_t needed = 0;
    patchproof_report_write(context, report, PATCHPROOF_REPORT_JSON, NULL, 0, &needed);
    char* json = malloc(needed);
    if (json == NULL) return 2;
    check(context, patchproof_report_write(context, report, PATCHPROOF_REPORT_JSON, json, needed, &needed));
    FILE* file = fopen(argv[2], "wb");
    if (file == NULL || fwrite(json, 1, needed - 1, file) != needed - 1 || fclose(file) != 0) return 2;
    free(json);
  }
  patchproof_report_free(report);
  patchproof_model_free(model);
  patchproof_context_free(context);
  return summary.outcome;
}
