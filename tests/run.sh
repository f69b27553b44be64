#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Installs what is missing (Debian 12, as root or with sudo), builds everything and runs all tests.
#
#   tests/run.sh [CTEST OPTION...]      for example: tests/run.sh -L planner
#
# The last line is "N passed, N failed, N skipped"; the exit status is 0 only when nothing failed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/tests/packages.sh"
install_missing "${halfshadow_packages[@]}" "${halfshadow_test_packages[@]}"

build=$root/build
cmake --preset default -S "$root" -B "$build" -DHALFSHADOW_BUILD_DEMOS=ON -DHALFSHADOW_BUILD_TESTS=ON
cmake --build "$build" --parallel "$(nproc)"

# CTest's own summary counts programs; the JUnit file holds what each printed, when the size limits allow it.
results=$build/Testing/results.xml
status=0
ctest --test-dir "$build" --output-on-failure --no-tests=error -j2 --output-junit "$results" \
  --test-output-size-passed 50000000 --test-output-size-failed 50000000 "$@" || status=$?

# Some CTest tests are one GoogleTest case, some a whole program of them: count cases where a test printed
# any, else the test. A case that began and did not end (crash, time limit) failed.
awk -v status="$status" '
  /<testcase .* status="/ {
    run = ok = bad = skip = 0
    failed_here = /status="fail"/
    skipped_here = /status="(notrun|disabled)"/
  }
  /<skipped message="Unable to find executable/ { failed_here = 1 }
  /^\[ RUN      \] / { run++ }
  /^\[       OK \] .*\([0-9]+ ms\)$/ { ok++ }
  /^\[  FAILED  \] .*\([0-9]+ ms\)$/ { bad++ }
  /^\[  SKIPPED \] .*\([0-9]+ ms\)$/ { skip++ }
  /<\/testcase>/ {
    if (run > ok + bad + skip) bad += run - (ok + bad + skip)
    passed += ok; failed += bad; skipped += skip
    if (failed_here) { if (bad == 0) failed++ }
    else if (ok + bad + skip == 0) { if (skipped_here) skipped++; else passed++ }
  }
  END {
    if (status != 0 && failed == 0) failed = 1
    printf "%d passed, %d failed, %d skipped\n", passed, failed, skipped
  }' "$results"
exit "$status"
