#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws every model of this folder: draw.sh PROGRAM [FOLDER]. `./dev pictures` calls it.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$1
out=${2:-$here/pictures}
mkdir -p "$out"
curves=() patches=() larger=()
for model in "$here"/*.json; do
  if grep -q '"curves"' "$model"; then
    curves+=("$model")
  elif grep -q '"solids"\|"knots"' "$model"; then
    larger+=("$model")
  else
    patches+=("$model")
  fi
done
"$program" plot "${curves[@]}" "$out" --format svg
"$program" plot "${patches[@]}" "$out" --format svg --cells 16
"$program" plot "${larger[@]}" "$out" --format svg --cells 10   # of many spans and faces: files of 150 kB at most
for name in bernstein_3 test04 test12 test13; do   # what these are about: their functions
  "$program" plot --basis "$here/$name.json" "$out/${name}_basis.svg"
done
