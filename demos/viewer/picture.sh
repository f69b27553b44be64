#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Makes the README's picture of the viewer, demos/viewer/viewer.png, under a virtual display.
#
#   demos/viewer/picture.sh [VIEWER]        default: build/bin/halfshadow-viewer
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
viewer=${1:-$root/build/bin/halfshadow-viewer}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/script" <<'SCRIPT'
drag 80,420 -130 -70
scroll 80,420 -4
click tab/Compare
click compare/a-technique
click other
click other/hard
drag slider -20 0
click tab/Shadows
move 100,500
wait 3
SCRIPT
xvfb-run -a -s "-screen 0 1400x900x24" "$viewer" builtin:figure -t pcss-mip --window 960x540 --scale 1 \
  --script "$folder/script" --screenshot "$root/demos/viewer/viewer.png"
