#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Installs what is missing (Debian 12, as root or with sudo), builds the viewer and starts it.
#
#   demos/view.sh [SCENE] [OPTIONS]     as halfshadow-viewer takes them; --help lists them
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/tests/packages.sh"
install_missing "${halfshadow_packages[@]}"

build=$root/build
if [[ ! -f $build/build.ninja ]]; then
  tests=OFF
  if [[ -f /usr/include/gtest/gtest.h ]]; then tests=ON; fi
  cmake --preset default -S "$root" -B "$build" -DHALFSHADOW_BUILD_TESTS=$tests
fi
cmake --build "$build" --parallel "$(nproc)" --target halfshadow_viewer
exec "$build/bin/halfshadow-viewer" "$@"
