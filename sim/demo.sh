#!/usr/bin/env bash
# Shows the whole station with no hardware: installs what is missing, builds, starts the daemon on the
# simulated station, presses the pedal, prints the measures beside their truth, and stops.
set -euo pipefail
cd "$(dirname "$0")/.."
say() { printf '\n== %s\n' "$*"; }

say "install what is missing"
tests/install-dependencies.sh

say "build"
cmake --preset release >/dev/null
cmake --build --preset release --target instepd instep

folder=$(mktemp -d "${TMPDIR:-/tmp}/instep-demo-XXXXXX")
export INSTEP_CONFIG="$PWD/config/instep.toml"
export INSTEP_STORE="$folder/scans" INSTEP_SOCKET="$folder/control.sock" INSTEP_PEDAL="$folder/pedal"
export PATH="$PWD/build/release/bin:$PATH"

say "start the daemon on the simulated station"
instepd 2>"$folder/instepd.log" &
daemon=$!
stop_daemon() {
  kill -TERM "$daemon" 2>/dev/null || return 0
  wait "$daemon" || true
}
end_early() {
  cat "$folder/instepd.log" >&2
  stop_daemon
}
trap end_early EXIT
instep status --wait-ready 30

say "press the pedal"
echo tap >"$INSTEP_PEDAL"
instep watch --until-result 60

say "the measures of the simulated foot, beside its truth"
instep show latest

say "the result, as a shop would find it"
find "$INSTEP_STORE" -type f -printf '%m %s bytes %p\n' | sort -k4

say "stop"
trap - EXIT
stop_daemon
echo "The daemon has stopped; its log is $folder/instepd.log"
