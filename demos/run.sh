#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Installs what is missing (Debian 12, as root or with sudo), builds the command line tool, renders three scenes
# with every technique, measures them against ray-traced visibility, repeats the papers' own comparisons,
# judges the techniques in scenes that break soft shadows, and writes out/report.html and its images.
#
#   demos/run.sh [OUTPUT FOLDER]        default: out/ beside this checkout's README
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/tests/packages.sh"
install_missing "${halfshadow_packages[@]}"

out=$(realpath -m "${1:-$root/out}")
build=$root/build
if [[ ! -f $build/build.ninja ]]; then
  tests=OFF
  if [[ -f /usr/include/gtest/gtest.h ]]; then tests=ON; fi
  cmake --preset default -S "$root" -B "$build" -DHALFSHADOW_BUILD_TESTS=$tests
fi
cmake --build "$build" --parallel "$(nproc)" --target halfshadow_cli

scenes=()
model=$root/../shared/scenes/CesiumMan.glb
if [[ -f $model ]]; then scenes+=("$model"); else scenes+=(builtin:mannequin); fi
scenes+=(builtin:figure builtin:spheres27)

"$build/bin/halfshadow" report "${scenes[@]}" --papers --stress -o "$out"
echo "Open $out/report.html in a browser."
