#!/bin/sh
# The guest is what the device tests take it for: Debian's kernel, not this machine's own, with the
# simulated devices at hand, and a host that cannot be written to.
set -eu
grep -q ' first=/guest/run-command' /proc/cmdline
for place in /sys/kernel/config/gpio-sim /dev/uinput /sys/devices/platform/vhci_hcd.0/attach; do
  [ -e "$place" ] || { echo "$place is missing" && exit 1; }
done
udevadm control --ping --timeout=20
[ "$(findmnt -no FSTYPE /)" = overlay ]
echo "Linux $(uname -r)"
