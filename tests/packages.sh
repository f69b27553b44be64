# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
# shellcheck shell=bash
#
# The Debian 12 packages that Halfshadow needs, and the one function that installs what is missing.
# Sourced by tests/run.sh and demos/run.sh.

# Compiler, build tools, libraries of the command line tool and the viewer, Mesa's software drivers.
halfshadow_packages=(
  g++ cmake ninja-build ccache pkg-config
  libglm-dev nlohmann-json3-dev libcli11-dev libtinygltf-dev libembree-dev libopenimageio-dev libimath-dev
  libglfw3-dev libimgui-dev libegl-dev libgles-dev
  libegl1 libgles2 libegl-mesa0 libgl1-mesa-dri
)

# Decoders of compressed geometry, which the build takes where they are.
halfshadow_packages+=(libdraco-dev libmeshoptimizer-dev)

# Only the tests need these; without them the tests that use them say that they skip.
halfshadow_test_packages=(libgtest-dev glslang-tools clang-format xvfb)

# install_missing PACKAGE...: installs those that dpkg does not list as installed; asks nothing.
install_missing() {
  if ! command -v dpkg-query >/dev/null; then
    echo "This is not a Debian system: install what tests/packages.sh lists, if the build asks for it." >&2
    return 0
  fi
  local missing=() package
  for package in "$@"; do
    if [[ "$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | head -n 1)" != installed ]]; then
      missing+=("$package")
    fi
  done
  if ((${#missing[@]} == 0)); then return 0; fi
  local as_root=()
  if [[ $EUID -ne 0 ]]; then
    if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
      echo "Packages are missing and this is neither root nor sudo without a password. Install them with:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo -n)
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o Dpkg::Use-Pty=0 "${missing[@]}" >/dev/null
}
