#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fills the meshes of this folder and draws them: draw.sh PROGRAM [FOLDER]. `./dev pictures` calls it.
# two_faces_former and two_faces_normals show normals from both sides of the line v = 1/3: doubled with the former method.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$1
out=${2:-$here/pictures}
mkdir -p "$out"
filled=$(mktemp -d)
trap 'rm -rf "$filled"' EXIT
for mesh in football mixed_faces two_faces; do
  "$program" fill "$here/$mesh.json" "$filled/$mesh.json" --quiet >&2
done
"$program" fill "$here/two_faces.json" "$filled/two_faces_former.json" --method former --quiet >&2 || [ $? = 1 ]  # kinked
"$program" plot "$filled/football.json" "$out/football.svg" --cells 2
"$program" plot "$filled/mixed_faces.json" "$out/mixed_faces.svg" --cells 1
"$program" plot "$filled/two_faces.json" "$out/two_faces.svg" --cells 8 --control
for name in two_faces two_faces_former; do
  "$program" plot "$filled/$name.json" "$out/${name}_normals.svg" --cells 6 --normals
done
"$program" plot "$filled/two_faces.json" "$out/two_faces_sections.svg" --cells 6 --sections 12
