#!/usr/bin/env bash
# Whether this machine can have a guest, whose kernel is made if need be: can-boot.sh FOLDER. If not, the
# exit code is 77, and FOLDER/skipped says why.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1

without() {
  echo "$*" | tee "$folder/skipped"
  echo "KERNEL TESTS ARE SKIPPED: nothing was proven against a real kernel." >&2
  exit 77
}
[ -z "${INSTEP_SKIP_KERNEL_TESTS:-}" ] || without "INSTEP_SKIP_KERNEL_TESTS is set"
# A guest has these of its own, so that what lies there on this machine is not found in it.
for place in "$here" "$(cd "$folder" && pwd)"; do
  case $place/ in
    /tmp/* | /run/* | /dev/shm/*) without "the guest does not see $place: put the sources elsewhere" ;;
  esac
done
outcome=0
"$here/prepare.sh" 2>"$folder/preparing" >/dev/null || outcome=$?
cat "$folder/preparing" >&2
[ $outcome != 77 ] || without "$(tail -1 "$folder/preparing")"
exit $outcome
