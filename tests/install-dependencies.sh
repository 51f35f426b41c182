#!/usr/bin/env bash
# The one list of Debian packages that building, testing and demonstrating Instep needs.
# Quick when all of them are there.
set -euo pipefail

packages=(
  cmake g++ ninja-build pkg-config
  ccache  # no compiling twice; a build without it is the same
  libeigen3-dev libnanoflann-dev libexpected-dev
  libfmt-dev libspdlog-dev libcli11-dev nlohmann-json3-dev libtomlplusplus-dev
  libpng-dev libassimp-dev liblzf-dev libsystemd-dev
  libopenni2-dev
  libgpiod-dev libevdev-dev
  libusb-1.0-0-dev
  libgtest-dev libgmock-dev
  clang-format-14  # of the test that sources are laid out by .clang-format
  qemu-system-x86 busybox-static cpio kmod make libelf1 udev xz-utils systemd  # of the tests against a real kernel
  librsvg2-bin  # a program, not a library: prints a report as PDF
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing: ${missing[*]}. Install them as root: apt-get install ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq >&2
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
