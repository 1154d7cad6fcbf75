#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws every model of this folder: draw.sh PROGRAM [FOLDER]. `./dev pictures` calls it.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$1
out=${2:-$here/pictures}
mkdir -p "$out"
curves=() patches=() splines=() solids=()
for model in "$here"/*.json; do
  if grep -q '"curves"' "$model"; then
    curves+=("$model")
  elif grep -q '"solids"' "$model"; then
    solids+=("$model")
  elif grep -q '"knots"' "$model"; then
    splines+=("$model")
  else
    patches+=("$model")
  fi
done
"$program" plot "${curves[@]}" "$out" --format svg
"$program" plot "${patches[@]}" "$out" --format svg --cells 16
# The more spans and faces, the fewer cells in each: the files stay below 150 kB.
"$program" plot "${splines[@]}" "$out" --format svg --cells 12
"$program" plot "${solids[@]}" "$out" --format svg --cells 10
for name in bernstein_3 test04 test12 test13; do   # what these are about: their functions
  "$program" plot --basis "$here/$name.json" "$out/${name}_basis.svg"
done
