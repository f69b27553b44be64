#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Uses the viewer as a person would, by scripts, under a virtual display, and compares its pictures with those that
# the tool renders with the command line that the viewer copied.
#
#   window_test.sh VIEWER HALFSHADOW CASE FOLDER        status 77: skipped, with the reason
set -euo pipefail
viewer=$1 tool=$2 case=$3 folder=$4
command -v Xvfb >/dev/null || { echo "skipped: no Xvfb (install xvfb)"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
export LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe HOME=$folder
unset WAYLAND_DISPLAY XDG_CONFIG_HOME

if [[ $case == refused ]]; then
  # Without a display it says so, and what to do; and it refuses what it cannot play.
  refuse() {  # STATUS WORDS ARGUMENTS...
    local wanted=$1 words=$2 status=0
    shift 2
    "$viewer" "$@" >out 2>err || status=$?
    if [[ $status != "$wanted" ]] || ! grep -qi -- "$words" err || [[ -s out ]]; then
      echo "viewer $*: status $status, wanted $wanted and \"$words\":"
      cat err out
      exit 1
    fi
  }
  unset DISPLAY
  refuse 1 xvfb --frames 2
  refuse 1 "no_such_script" --script no_such_script
  refuse 2 "softpipe" --driver device --frames 2
  refuse 2 "window" --window 5x5
  refuse 2 "eye" --camera nonsense
  echo "wait 1" >script
  echo "fly away" >>script
  refuse 1 "line 2" --script script
  exit 0
fi

servers=()
trap 'for server in "${servers[@]}"; do kill "$server" 2>/dev/null || true; done' EXIT
serve() {  # OPTIONS...: a virtual display, which DISPLAY names from then on
  rm -f display
  Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp "$@" 3>display >xvfb.log 2>&1 &
  servers+=($!)
  for _ in $(seq 100); do
    [[ -s display ]] && break
    sleep 0.1
  done
  [[ -s display ]] || { echo "skipped: Xvfb does not start here: $(tail -n 1 xvfb.log)"; exit 77; }
  DISPLAY=:$(tr -d '[:space:]' <display)
  export DISPLAY
}
serve

play() {  # ARGUMENTS...: plays `script`, leaves facts.json
  "$viewer" --window "${window:-700x420}" --samples 16 --script script --json facts.json "$@"
}
fact() { sed -n "s/^  \"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p" facts.json; }
fail() {
  echo "FAILED: $*"
  exit 1
}
same() {  # NAME: NAME.png of the viewer and the picture of the command line in NAME.txt
  local command
  command=$(sed "s#^halfshadow#'$tool'#; s#-o picture.png#-o '$1.tool.png'#" "$1.txt")
  env -u __EGL_VENDOR_LIBRARY_FILENAMES bash -c "$command" || fail "the copied command line is refused: $command"
  "$tool" compare "$1.png" "$1.tool.png" --json "$1.json" >/dev/null || fail "compare $1"
  awk -v name="$1" 'BEGIN { worst = 0 } /"rmse"/ { gsub(/[^0-9.e-]/, "", $2); seen = 1; if ($2 + 0 > worst) worst = $2 + 0 }
    END { print name ": RMSE " worst; exit !(seen && worst + 0 <= 0.002) }' "$1.json" || fail "$1 differs: $command"
}
keep() { printf 'wait 2\npicture %s.png\nclick tab/Keep\nclick keep/copy\nwait 1\nclipboard %s.txt\n' "$1" "$1"; }

case $case in
  hands)
    {
      echo "drag 100,300 60 -20"
      echo "drag 100,300 20 10 right"
      echo "scroll 120,300 -15"
      keep camera
      echo "drag 100,300 15 9 left ctrl"
      echo "drag handle/1/center 20 15"
      echo "drag handle/1/aim -14 9"
      echo "drag handle/1/sizeU 12 4"
      echo "drag handle/1/sizeV 3 10"
      keep light
      echo "click tab/Scene"
      echo "click light/add"
      echo "expect lights 2 2"
      echo "drag handle/2/center -15 10"
      keep lights
      echo "key w" && echo "wait 2" && echo "key v" && echo "key v" && echo "key l" && echo "key l"
      keep keys
    } >script
    play builtin:figure --scale 1
    for name in camera light lights keys; do same $name; done
    cmp -s camera.png light.png && fail "dragging the light changed nothing"
    cmp -s light.png lights.png && fail "another light changed nothing"
    ;;
  techniques)
    mapfile -t techniques < <("$tool" techniques --json - | sed -n 's/^      "id": "\(.*\)",$/\1/p')
    [[ ${#techniques[@]} -ge 15 ]] || fail "no list of techniques"
    for technique in "${techniques[@]}"; do
      echo "click tab/Shadows"
      echo "click technique"
      echo "click technique/$technique"
      keep "$technique"
    done >script
    {
      echo "click tab/Shadows"
      echo "click technique" && echo "click technique/pcf"
      echo "click setting/pcf.pattern" && echo "click setting/pcf.pattern/poisson"
      echo "click setting/pcf.taps ctrl" && echo "key a ctrl" && echo "type 9" && echo "key enter"
      keep settings
    } >>script
    window=500x300
    play builtin:box
    for technique in "${techniques[@]}"; do
      grep -q -- "-t $technique " "$technique.txt" || fail "$technique was not chosen"
      same "$technique"
    done
    grep -q -- "--set pcf.pattern=poisson --set pcf.taps=9" settings.txt || fail "settings: $(cat settings.txt)"
    same settings
    ;;
  files)
    # A tetrahedron, then a larger one under the same name.
    solid() {  # BYTES
      cat <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [$1, $1, $1]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,$data"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]}
JSON
    }
    data=$(printf '%b' '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0200\0077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0200\0077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0200\0077' \
      '\0\0\02\0\01\0\0\0\01\0\03\0\0\0\03\0\02\0\01\0\02\0\03\0' | tr -d ' ' | base64 -w 0)
    solid 1 >"a solid.gltf"
    echo '{"asset": {"version": "2.0"' >broken.gltf
    {
      echo "drop a solid.gltf"
      echo "wait 2"
      echo "expect message 0 0"
      keep dropped
      echo "drop broken.gltf"
      echo "wait 2"
      echo "expect message 1 1"
      keep kept
      echo "click message/close"
      echo "wait 1"
      echo "expect message 0 0"
      echo "drop no such file.glb"
      echo "wait 2"
      echo "expect message 1 1"
      echo "screenshot error.png"
    } >script
    play builtin:box
    same dropped
    same kept
    cmp -s dropped.png kept.png || fail "a broken file changed the picture"
    [[ $(fact scene) == "a solid.gltf" ]] || fail "the last good scene was not kept: $(fact scene)"
    # Two animations: the first begins at the file's place, the second one higher.
    key() { printf '{"bufferView": 2, "byteOffset": %s, "componentType": 5126, "count": 2, "type": "%s", "min": %s, "max": %s}' "$@"; }
    moves() { printf '{"name": "%s", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 2, "output": %s}]}' "$@"; }
    more=$(printf '%b' '\0\0\0\0\0\0\0200\0077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0200\0077\0\0\0\0\0\0\0\0\0\0\0200\0077\0\0\0\0' | base64 -w 0)
    solid 1 | sed -e "s#$data#$data$more#" -e 's/"byteLength": 72/"byteLength": 116/' -e 's/"byteLength": 24}]/"byteLength": 24}, {"buffer": 0, "byteOffset": 72, "byteLength": 44}]/' \
      -e "s/\"type\": \"SCALAR\"}]/\"type\": \"SCALAR\"}, $(key 0 SCALAR '[0]' '[1]'), $(key 8 VEC3 '[0, 0, 0]' '[0, 1, 0]'), $(key 20 VEC3 '[0, 1, 0]' '[0, 1, 0]')],/" \
      -e "s/],}\$/], \"animations\": [$(moves lift 3), $(moves high 4)]}/" >moving.gltf
    { keep low && echo "click tab/Scene" && echo "click animation" && echo "click animation/1" && keep high; } >script
    play moving.gltf
    same low
    same high
    grep -q -- "--animation 1" high.txt || fail "the second animation was not chosen: $(cat high.txt)"
    cmp -s low.png high.png && fail "the second animation shows nothing else"
    # Changed while it is shown.
    { echo "wait 3" && echo "picture before.png" && echo "until reloads 1 9" && keep after; } >script
    (
      while [[ ! -e before.png ]]; do sleep 0.1; done
      solid 1.5 >larger.gltf
      mv larger.gltf "a solid.gltf"
    ) &
    play "a solid.gltf"
    same after
    cmp -s before.png after.png && fail "a changed file was not read again"
    ;;
  window)
    {
      for i in $(seq 50); do echo "resize $((300 + (i * 37) % 500)) $((260 + (i * 53) % 300))" && echo "wait 2"; done
      echo "minimise" && echo "wait 5" && echo "restore" && echo "wait 5"
      echo "resize 700 420" && echo "wait 3"
      keep resized
      echo "scroll 100,300 -15"
      for _ in $(seq 12); do echo "drag 100,300 9 4" && echo "drag handle/1/center 3 -2" && echo "wait 4"; done
      echo "wait 300"
    } >script
    play builtin:figure -t pcf --frames 1000
    same resized
    [[ $(fact frames) -ge 1000 ]] || fail "$(fact frames) frames"
    [[ $(fact gl_errors) == 0 ]] || fail "OpenGL errors"
    [[ $(fact gl_objects) -le $(($(fact gl_objects_at_frame_200) + 2)) ]] || fail "GL objects grow: $(cat facts.json)"
    [[ $(fact resident_bytes) -le $(($(fact resident_bytes_at_frame_200) + 32000000)) ]] || fail "memory grows: $(cat facts.json)"
    # Nothing is drawn while nothing moves: only the frames of the 24 drags and the start are.
    [[ $(fact drawn) -le 500 ]] || fail "drawn $(fact drawn) times in vain"
    ;;
  panels)
    {
      for tab in Scene Shadows Compare Inside Cost Device Keep; do echo "click tab/$tab" && echo "wait 2"; done
      echo "key ?" && echo "wait 2" && echo "screenshot keys.png" && echo "click keys/close"
      echo "click tab/Compare" && echo "click compare/a-technique" && echo "click other" && echo "click other/hard"
      echo "wait 2" && echo "drag slider -40 0" && echo "screenshot technique.png"
      echo "click compare/truth" && echo "settle" && echo "wait 2" && echo "screenshot truth.png"
      echo "click heat-map" && echo "settle" && echo "wait 2" && echo "expect rmse 0.0001 0.2" && echo "screenshot heat.png"
      echo "click magnifier" && echo "move 150,250" && echo "wait 2" && echo "screenshot magnifier.png"
      echo "click heat-map" && echo "click compare/nothing" && echo "click magnifier"
      echo "click tab/Inside" && echo "click inside/silhouettes" && echo "click inside/wedges" && echo "wait 2"
      echo "screenshot inside.png" && echo "click inside/from-light" && echo "wait 2" && echo "screenshot light.png"
      echo "click inside/from-light" && echo "click inside/silhouettes" && echo "click inside/wedges"
      echo "click tab/Cost" && echo "click measure" && echo "wait 20" && echo "expect ms 0.01 100000"
      echo "screenshot cost.png" && echo "click measure"
      echo "click tab/Device" && echo "click force/depth-texture" && echo "wait 3" && echo "expect message 0 0"
      keep forced
    } >script
    play builtin:figure
    grep -q -- "--force depth-texture=off" forced.txt || fail "$(cat forced.txt)"
    same forced
    [[ $(fact gl_errors) == 0 ]] || fail "OpenGL errors"
    for name in keys technique truth heat magnifier inside light cost; do
      [[ -s $name.png ]] || fail "$name.png is missing"
    done
    cmp -s truth.png heat.png && fail "the heat map shows nothing"
    ;;
  report)
    # The report's page says how to see each of its pictures in the viewer.
    "$tool" report builtin:figure -o report -t pcf,wedges --size 160x100 --samples 4 --frames 0 --set pcf.size=13 >/dev/null
    sed -n 's#.*<summary>open this view</summary>##; s#<code>halfshadow-viewer \([^<]*\)</code>.*#\1#p' report/report.html >lines
    [[ $(wc -l <lines) == 3 ]] || fail "lines of the page: $(cat lines)"
    { echo "settle" && echo "screenshot window.png" && keep page; } >script
    while read -r words; do
      technique=$(sed 's/.* -t \([^ ]*\) .*/\1/' <<<"$words")
      eval "play $(sed "s/&#39;/'/g" <<<"$words")"
      same page
      "$tool" compare page.png "report/figure-$technique.png" --json page.json >/dev/null
      grep -q '"rmse": 0.0,' page.json || fail "not the report's picture: $words"
    done <lines
    ;;
  contexts)
    keep any >script
    opens() {  # NAME ARGUMENTS...: it opens through NAME, and draws what the tool does
      play builtin:box "${@:2}"
      [[ $(fact context) == "$1" ]] || fail "a context of $(fact context), wanted $1"
      [[ $(fact gl_errors) == 0 ]] || fail "OpenGL errors through $1"
      same any
    }
    refuse() {  # NAMES ARGUMENTS...: it ends, and says why of each way
      local name status=0
      play builtin:box "${@:2}" 2>err || status=$?
      [[ $status == 1 ]] || fail "status $status with $*"
      for name in $1; do grep -q "through $name (" err || fail "nothing of $name in: $(cat err)"; done
      grep -q "install" err || fail "no way out in: $(cat err)"
    }
    opens EGL
    opens EGL --context egl
    opens GLX --context glx
    # The system's EGL without any driver.
    export __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null
    opens GLX
    refuse EGL --context egl
    serve -extension GLX
    refuse "EGL GLX"
    unset __EGL_VENDOR_LIBRARY_FILENAMES
    refuse GLX --context glx
    opens EGL
    ;;
  *) fail "no case $case" ;;
esac
echo "passed: $case"
