#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Long fuzzing with libFuzzer under the address and undefined-behaviour sanitizers (Debian: clang).
#
#   tests/fuzz/run.sh [--seconds S] [--jobs N] [TARGET...]     for example: tests/fuzz/run.sh --seconds 3600 gltf
#
# Builds the preset "fuzz", then runs each target for S seconds (default 600), N (default 1) at a time. Corpora grow in
# build-fuzz/corpora and are taken up again by the next run; what fails is kept in build-fuzz/failures. The last lines
# are one JSON object a target; the exit status is 0 only when nothing failed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
seconds=600 jobs=1 targets=()
while (($# > 0)); do
  case $1 in
    --seconds) seconds=$2 && shift 2 ;;
    --jobs) jobs=$2 && shift 2 ;;
    -h | --help) sed -n '5,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
    *) targets+=("$1") && shift ;;
  esac
done
((${#targets[@]} > 0)) || targets=(gltf settings profiles mesh frame_graph planner light_plans c_api)

build=$root/build-fuzz
cmake --preset fuzz -S "$root" >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target fuzz
mkdir -p "$build/failures"
export LSAN_OPTIONS=suppressions=$root/tests/leaks_of_drivers.txt:print_suppressions=0 UBSAN_OPTIONS=print_stacktrace=1

run_one() {
  local name=$1 corpus=$build/corpora/$1 log=$build/failures/$1.log status=0
  "$build/bin/fuzz_$name" --write-seeds "$corpus" >/dev/null
  "$build/bin/libfuzzer_$name" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="$build/failures/$name-" "$corpus" >"$log" 2>&1 || status=$?
  local executions
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "{\"target\": \"$name\", \"executions\": ${executions:-0}, \"seconds\": $seconds, \"status\": $status}"
  return "$status"
}

status=0
for name in "${targets[@]}"; do
  while (($(jobs -rp | wc -l) >= jobs)); do wait -n || status=1; done
  run_one "$name" &
done
while (($(jobs -rp | wc -l) > 0)); do wait -n || status=1; done
exit "$status"
