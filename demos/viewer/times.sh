#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# What the viewer takes here, under a virtual display: to its first picture, to switch to each technique, for a whole
# frame of builtin:figure with pcss-mip against `halfshadow measure` (in turn), and at rest. Best of some runs each, since
# others may use this machine.
#
#   demos/viewer/times.sh [FOLDER OF THE PROGRAMS]        default: build/bin
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
bin=${1:-$root/build/bin}
if [[ -z ${HALFSHADOW_TIMES_DISPLAY:-} ]]; then
  HALFSHADOW_TIMES_DISPLAY=1 exec xvfb-run -a -s "-screen 0 1920x1080x24" "${BASH_SOURCE[0]}" "$bin"
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

view() {  # ARGUMENTS...: leaves facts.json; the window leaves 1280x720 pixels to the picture
  "$bin/halfshadow-viewer" builtin:figure --window 1602x720 --size 1280x720 --scale 1 --json facts.json "$@"
}
fact() { sed -n "s/^  \"$1\": \([0-9.]*\),*$/\1/p" facts.json; }
least() { sort -g | head -n 1; }

for _ in 1 2 3 4 5; do view --frames 1 && fact first_picture_ms; done >first
echo "first picture after the start of the process: $(least <first) ms"

echo "switch of technique (until its first picture is done) / a whole frame of it, ms:"
mapfile -t techniques < <("$bin/halfshadow" techniques --json - | sed -n 's/^      "id": "\(.*\)",$/\1/p')
for technique in "${techniques[@]}"; do
  printf 'click tab/Shadows\nclick technique\nclick technique/%s\nwait 2\nclick tab/Cost\nclick measure\nwait 8\n' \
    "$technique" >script
  from=hard
  if [[ $technique == hard ]]; then from=pcf; fi
  for _ in 1 2 3; do view -t $from --script script && echo "$(fact slowest_switch_ms) $(fact window_frame_ms)"; done >switch
  awk -v name="$technique" 'NR == 1 || $1 < s { s = $1 } NR == 1 || $2 < f { f = $2 } END { printf "  %-22s %7.1f %7.1f\n", name, s, f }' switch
done

printf 'click tab/Cost\nclick measure\nwait 40\n' >script
for _ in 1 2 3 4 5; do
  view -t pcss-mip --script script
  shaded=$(fact window_frame_ms)
  view -t pcss-mip --script script --show visibility
  visibility="$(fact window_frame_ms) $(fact engine_frame_ms)"
  "$bin/halfshadow" measure builtin:figure -t pcss-mip --size 1280x720 --samples 4 --frames 25 --json measured.json \
    >/dev/null 2>&1
  measured=$(sed -n '/"time_ms": {/,/}/s/.*"median": \([0-9.]*\).*/\1/p' measured.json)
  echo "$shaded $visibility $measured"
done >frames
# The engine's part of a measured frame is what measure times; in one run both have the same neighbours.
awk '{ ratio[NR] = $2 / $3 } NR == 1 || $1 < s { s = $1 } NR == 1 || $2 < v { v = $2 } NR == 1 || $4 < m { m = $4 } END {
  least = ratio[1]; for (i = 2; i <= NR; ++i) if (ratio[i] < least) least = ratio[i]
  print "a frame of figure, pcss-mip, 1280x720, panels and swap included, against that of measure (" m " ms):"
  printf "  visibility, as measure draws it: %.1f ms, %.2f times (%.2f times the engine'"'"'s in one run)\n", v, v / m, least
  printf "  lit colours: %.1f ms, %.2f times\n", s, s / m
}' frames

# At rest: processor time over ten seconds, behind the first two.
"$bin/halfshadow-viewer" builtin:figure --window 1602x720 --remember none &
viewer=$!
sleep 3
ticks() { awk '{ print $14 + $15 }' "/proc/$viewer/stat"; }
before=$(ticks)
sleep 10
after=$(ticks)
kill "$viewer"
echo "at rest: $(awk -v t=$((after - before)) -v hz="$(getconf CLK_TCK)" 'BEGIN { printf "%.1f", 10 * t / hz }') % of a core"
