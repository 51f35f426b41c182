#!/usr/bin/env bash
# own_header_first.sh FOLDER...: each source below the folders that has a header beside it includes
# that header before all else. So the header compiles alone wherever its source compiles.
set -euo pipefail

found=0
wrong=0
while IFS= read -r header; do
  source="${header%.h}.cpp"
  [ -f "$source" ] || continue
  found=$((found + 1))
  first="$(grep -m1 '^ *# *include' "$source" || true)"
  if [ "$first" != "#include \"$header\"" ]; then
    echo "$source: its first include is not \"$header\": move that one to the top" >&2
    wrong=$((wrong + 1))
  fi
done < <(find "$@" -name '*.h')

if [ "$found" -eq 0 ]; then
  echo "No source with a header of its own below: $*" >&2
  exit 1
fi
echo "$found sources include their own header first, $wrong do not."
[ "$wrong" -eq 0 ]
