#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run_fuzz.sh PROGRAM SEEDS FOLDER: fuzzes for PATCHPROOF_FUZZ_SECONDS seconds (3); the corpus grows in FOLDER/corpus.
# PATCHPROOF_FUZZ_SEED chooses the random seed (1).
set -eu
program=$1 seeds=$2 folder=$3
mkdir -p "$folder/corpus"
exec "$program" -max_total_time="${PATCHPROOF_FUZZ_SECONDS:-3}" -seed="${PATCHPROOF_FUZZ_SEED:-1}" -timeout=20 \
  -rss_limit_mb=2048 -max_len=8192 -print_final_stats=1 -artifact_prefix="$folder/" "$folder/corpus" "$seeds"
