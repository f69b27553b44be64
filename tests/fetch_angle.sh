#!/bin/sh
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
#
# Fetches ANGLE over SwiftShader, a second OpenGL ES 2.0 implementation to test against.
#
#   tests/fetch_angle.sh [VERSION]
#
# The npm package @sparticuz/chromium carries prebuilt libraries for x86-64 Linux. This unpacks libEGL.so,
# libGLESv2.so, libvk_swiftshader.so, libvulkan.so.1 and vk_swiftshader_icd.json into HALFSHADOW_ANGLE_DIR
# (default ~/.cache/halfshadow/angle), where `--driver angle` looks for them. Needs npm, node and tar; about
# 70 MB are downloaded and deleted again. Afterwards:
#
#   HALFSHADOW_TEST_DRIVER=angle build/bin/test_gl
set -eu

version=${1:-147.0.0}
target=${HALFSHADOW_ANGLE_DIR:-${HOME}/.cache/halfshadow/angle}

for tool in npm node tar; do
  if ! command -v "$tool" >/dev/null 2>&1; then
    echo "fetch_angle.sh: $tool is not installed; install the packages nodejs, npm and tar" >&2
    exit 1
  fi
done
if [ "$(uname -sm)" != "Linux x86_64" ]; then
  echo "fetch_angle.sh: the package has libraries for x86-64 Linux only, this is $(uname -sm)" >&2
  exit 1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm pack --silent "@sparticuz/chromium@$version" >/dev/null
tar -xzf ./*.tgz package/bin/swiftshader.tar.br
node -e '
  const fs = require("fs"), zlib = require("zlib");
  fs.writeFileSync("swiftshader.tar", zlib.brotliDecompressSync(fs.readFileSync("package/bin/swiftshader.tar.br")));
'
mkdir -p "$target"
tar -xf swiftshader.tar -C "$target"
for file in libEGL.so libGLESv2.so libvk_swiftshader.so libvulkan.so.1 vk_swiftshader_icd.json; do
  if [ ! -f "$target/$file" ]; then
    echo "fetch_angle.sh: @sparticuz/chromium $version has no $file; try another version" >&2
    exit 1
  fi
done
echo "ANGLE is in $target"
