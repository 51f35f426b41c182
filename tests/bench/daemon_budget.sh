#!/usr/bin/env bash
# What the daemon costs: processor time and memory at rest, the most memory of a scan of 4 cameras x 15
# frames of 640 x 480, and the time from the last frame to the stored result. Give the folder of the
# programs; build/release/bin if nothing is said.
set -euo pipefail
programs=${1:-"$(dirname "$0")/../../build/release/bin"}
rest_s=10
scans=3

folder=$(mktemp -d "${TMPDIR:-/tmp}/instep-budget-XXXXXX")
cat >"$folder/instep.toml" <<'TOML'
[[camera]]
kind = "simulated"
[pedal]
kind = "none"
[simulation]
truth = false
TOML
export INSTEP_CONFIG="$folder/instep.toml" INSTEP_STORE="$folder/scans" INSTEP_SOCKET="$folder/control.sock"
"$programs/instepd" 2>"$folder/log" &
daemon=$!
stop_daemon() {
  kill -TERM "$daemon" 2>/dev/null && wait "$daemon" || true
  rm -rf "$folder"
}
trap stop_daemon EXIT

memory_mib() { awk -v key="$1:" '$1 == key { printf "%.1f", $2 / 1024 }' "/proc/$daemon/status"; }
processor_ticks() { awk '{ print $14 + $15 }' "/proc/$daemon/stat"; }

begun=$(date +%s%3N)
"$programs/instep" status --wait-ready 60 >"$folder/status"
echo "start to ready        $(($(date +%s%3N) - begun)) ms"

before=$(processor_ticks)
sleep "$rest_s"
after=$(processor_ticks)
awk -v ticks=$((after - before)) -v hz="$(getconf CLK_TCK)" -v s="$rest_s" \
  'BEGIN { printf "processor at rest     %.2f %%\n", 100 * ticks / hz / s }'
echo "memory at rest        $(memory_mib VmRSS) MiB"

for ((scan = 0; scan < scans; ++scan)); do
  "$programs/instep" scan >"$folder/scan"
done
echo "most memory of a scan $(memory_mib VmHWM) MiB"
echo "memory after scans    $(memory_mib VmRSS) MiB"
# The log's own clock: the station measures from its last frame on.
awk '{ split($2, t, ":"); ms = 1000 * (3600 * t[1] + 60 * t[2] + t[3]) }
     /station is measuring/ { from = ms }
     /stored scan/ { printf "last frame to stored  %.0f ms\n", ms - from }' "$folder/log"
