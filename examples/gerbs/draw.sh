#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws what this folder is about: draw.sh PROGRAM [FOLDER]. `./dev pictures` calls it.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$1
out=${2:-$here/pictures}
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
# Splines from control points and from samples.
"$program" plot "$here/bsplines.json" "$out/bspline_from_points.svg"
"$program" fit "$here/samples.txt" "$work/bspline_from_samples.json" --controls 8 >"$work/log"
"$program" plot "$work/bspline_from_samples.json" "$out/bspline_from_samples.svg"
# Blends with an overlap of 1/5, 1/2 and 4/5; with B-functions of order 1 and of order 2.
for order in 1 2; do
  "$program" plot "$here/blends_$order.json" "$out/blends_$order.svg" --cells 32
done
# A closed curve, and the sub-curves that it is blended of after some have moved.
"$program" plot "$here/sub_curves.json" "$out/sub_curves.svg"
# Surfaces: open, closed in one direction (the one closed in both moves below). As far as they move.
for name in plane cylinder; do
  "$program" animate "$here/$name.json" "$here/$name.motion.json" "$work/$name" --frames 2 --cells 3 >"$work/log"
  cp "$work/$name/frame_0002.svg" "$out/$name.svg"
done
# The beating heart, and a torus that moves (coarse: the file holds all its states).
"$program" animate "$here/heart.json" "$here/heart_beat.motion.json" "$work/beat" --frames 12 --seconds 1.2 >"$work/log"
cp "$work/beat/animation.svg" "$out/heart_beat.svg"
"$program" animate "$here/torus.json" "$here/torus.motion.json" "$work/moving" --frames 4 --cells 3 >"$work/log"
cp "$work/moving/animation.svg" "$out/torus_moving.svg"
