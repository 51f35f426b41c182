#!/usr/bin/env bash
# laid_out_as_agreed.sh CLANG_FORMAT FOLDER...: the sources below the folders are as .clang-format
# says.
set -euo pipefail

clang_format="$1"
shift
mapfile -t sources < <(find "$@" -name '*.cpp' -o -name '*.h')
if [ "${#sources[@]}" -eq 0 ]; then
  echo "No source below: $*" >&2
  exit 1
fi
if ! "$clang_format" --dry-run --Werror "${sources[@]}"; then
  echo "Lay them out with: $clang_format -i FILE..." >&2
  exit 1
fi
echo "${#sources[@]} sources are laid out as agreed."
