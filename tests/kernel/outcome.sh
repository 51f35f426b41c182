#!/usr/bin/env bash
# What the guest's one boot said of a device test, shown as if it were run now:
#
#   outcome.sh FOLDER PROGRAM --gtest_filter=Suite.Case    one case of a GoogleTest program
#   outcome.sh FOLDER PROGRAM                              a whole program
#   outcome.sh FOLDER --kernel                             what the kernel complained of
#
# Exit code 0 if it passed. FOLDER is that of boot-devices.sh.
set -euo pipefail
folder=$1
program=$2
asked=${3:-}

# The list of its cases does not depend on where it runs.
case $asked in --gtest_list_tests*) exec "$program" "$asked" ;; esac
if [ -e "$folder/skipped" ]; then
  echo "[  SKIPPED ] $(cat "$folder/skipped")"
  exit 0
fi
if [ "$program" = --kernel ]; then
  cat "$folder/complaints"
  [ ! -s "$folder/complaints" ] || { echo "The kernel complained; see $folder/dmesg" && exit 1; }
  exit 0
fi
log=$folder/$(basename "$program").log
[ -e "$log" ] || { echo "The guest did not come to run it" && exit 1; }
case $asked in
  --gtest_filter=*)
    name=${asked#*=}
    awk -v name="$name" '
      index($0, "[ RUN      ] " name) && $NF == name { inside = 1 }
      inside { print }
      inside && /^\[ +(OK|FAILED|SKIPPED) +\] / && $0 ~ /\([0-9]+ ms\)$/ { exit }' "$log"
    # A program that died in a case ends its log there.
    grep -qE '^\[ +(OK|SKIPPED) +\] '"${name//./\\.} \(" "$log"
    ;;
  *)
    cat "$log"
    exit "$(cat "$folder/$(basename "$program").status")"
    ;;
esac
