#!/usr/bin/env bash
# Boots one guest and runs all device tests in it: boot-devices.sh FOLDER PROGRAM...
# What they said is left in FOLDER, where outcome.sh finds it. Exit code 0 if all of them were run,
# whatever they said; 77 if this machine cannot have a guest or is told not to.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
shift
rm -rf "$folder"
mkdir -p "$folder"

without() {
  echo "$*" | tee "$folder/skipped"
  echo "KERNEL TESTS ARE SKIPPED: nothing was proven against a real kernel." >&2
  exit 77
}
[ -z "${INSTEP_SKIP_KERNEL_TESTS:-}" ] || without "INSTEP_SKIP_KERNEL_TESTS is set"
outcome=0
"$here/prepare.sh" 2>"$folder/preparing" >/dev/null || outcome=$?
cat "$folder/preparing" >&2
[ $outcome != 77 ] || without "$(tail -1 "$folder/preparing")"
[ $outcome = 0 ] || exit $outcome

"$here/run-in-guest.sh" -t 420 -s "$folder" "$here/guest/run-device-tests" "$@"
