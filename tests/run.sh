#!/usr/bin/env bash
# Installs what is missing, builds, and runs all the tests; ends with ctest's own summary.
set -euo pipefail
cd "$(dirname "$0")/.."

tests/install-dependencies.sh
echo "== configure"
cmake --preset release
echo "== build"
cmake --build --preset release
echo "== test"
ctest --preset release --parallel "$(nproc)" --timeout 300 "$@"
