#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Renders with two builds of the tool and compares byte by byte: for changes that must not change a picture.
#
#   tests/pictures_equal.sh BEFORE AFTER [PATTERN]      two halfshadow binaries; PATTERN: only matching lines of the list
#
# Every technique over scenes that take each of its ways; every route, preset and filter; every capability forced
# off; three frames of a moving light and camera. What differs is listed with the command that renders it; what
# both refuse must be refused in the same words. Status 0 only when nothing differs.
set -euo pipefail
before=$(realpath "${1:?the tool before}") after=$(realpath "${2:?the tool after}") pattern=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

mapfile -t techniques < <("$after" techniques --json - | sed -n 's/^      "id": "\(.*\)",$/\1/p')
mapfile -t capabilities < <("$after" info --json - | sed -n 's/^ *"name": "\([a-z0-9-]*\)",\{0,1\}$/\1/p')
[[ ${#techniques[@]} -ge 15 && ${#capabilities[@]} -ge 10 ]] || { echo "no list of techniques or capabilities" >&2; exit 2; }

scenes=(builtin:box builtin:bars builtin:fence builtin:leaves builtin:figure@light=2 builtin:spheres27@light=.3
        builtin:contact builtin:room builtin:tiny builtin:large-world)
settings=(
  pcf.pattern=poisson pcf.size=9 pcf-masked.mask=minmax pcf-masked.mask=laplacian5 pcf-masked.mask=laplacian9
  pcf-masked.skip=branch pcf-masked.skip=loop pcf-masked.skip=stencil pcf-masked.pattern=poisson
  pcf-quantized.preset=paper pcf-quantized.bands=6 pcss.search=3 pcss-mip.size=5 vsm.storage=8
  occlusion-textures.preset=paper occlusion-textures.filter=sat occlusion-textures.filter=mipmap
  occlusion-textures.combine=max occlusion-textures.combine=product occlusion-textures.slices=16
  occlusion-textures.projection=orthographic occlusion-textures.center=behind
  shadow-width.preset=paper shadow-width.build=cpu shadow-width.neighbours=6
  wedges.route=screen wedges.route=receivers wedges-probabilistic.route=screen wedges-probabilistic.route=receivers
  wedges-blended.merge=core wedges-blended.merge=minmax wedges-blended.merge=fetch wedges-blended.cog=off
  wedges-cells.route=scatter wedges-cells.route=fetch wedges-cells.bytes=4 wedges-cells.bytes=32 wedges-cells.tiles=16
  sampled.samples=300 map_size=333 bias=3 filter_skip=loop filter_skip=branch)

list() {
  local technique scene setting capability motion
  for technique in "${techniques[@]}"; do
    for scene in "${scenes[@]}"; do echo "$scene -t $technique"; done
    for capability in "${capabilities[@]}"; do
      echo "builtin:figure -t $technique --force $capability=off"
      echo "builtin:room -t $technique --force $capability=off"
    done
    for motion in light camera; do echo "builtin:figure -t $technique --frames 3 --animate $motion"; done
  done
  for setting in "${settings[@]}"; do
    technique=${setting%%.*}
    [[ $setting == *.*=* && $technique != *=* ]] || technique=pcf-masked
    for scene in builtin:bars builtin:figure@light=2 builtin:room; do echo "$scene -t $technique --set $setting"; done
  done
}
picture() {  # TOOL FOLDER LINE
  mkdir "$2"
  local outputs=(-o "$2/shaded.png")
  [[ $3 == *--frames* ]] || outputs+=(--visibility "$2/visibility.exr")
  # shellcheck disable=SC2086
  "$1" render $3 "${outputs[@]}" --size 96x72 --device-profile none >"$2/said" 2>&1 || echo "status $?" >>"$2/status"
  # Messages may name the output.
  sed -i "s#$2/##g; /ms/d; / of /d; / %/d" "$2/said"
  # Of an EXR file the header holds the time of writing.
  if [[ -e $2/visibility.exr ]]; then sed -i 's/[0-9]\{4\}:[0-9][0-9]:[0-9][0-9] [0-9:]\{8\}//' "$2/visibility.exr"; fi
}
compare() {  # NUMBER LINE
  picture "$before" "$1.before" "$2"
  picture "$after" "$1.after" "$2"
  if ! diff -rq "$1.before" "$1.after" >/dev/null; then
    echo "differs: render $2"
  elif [[ -e $1.after/status ]]; then
    echo refused
  else
    echo equal
  fi
  rm -rf "$1.before" "$1.after"
}
export -f picture compare
export before after
list | { [[ -n $pattern ]] && grep -e "$pattern" || cat; } | awk '{ print NR "\t" $0 }' |
  xargs -P "$(nproc)" -d '\n' -I{} bash -c 'IFS=$'"'\t'"' read -r number line <<<"$1"; compare "$number" "$line"' _ {} |
  tee "$folder/results" | grep '^differs' || true
count() { grep -c "^$1" results || true; }
equal=$(count equal) differ=$(count differs)
echo "$equal equal, $(count refused) refused by both, $differ differ"
[[ $differ == 0 && $equal -gt 0 ]]
