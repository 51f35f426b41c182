#!/usr/bin/env bash
# Boots one guest and runs all device tests in it: boot-devices.sh FOLDER BIN PROGRAM...
# BIN holds instep and instepd. What was said is left in FOLDER, where outcome.sh finds it. Exit code 0 if all of them were run,
# whatever they said; 77 if this machine cannot have a guest or is told not to.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
shift
rm -rf "$folder"
mkdir -p "$folder"
"$here/can-boot.sh" "$folder"
"$here/run-in-guest.sh" -t 900 -s "$folder" "$here/guest/run-device-tests" "$@"
