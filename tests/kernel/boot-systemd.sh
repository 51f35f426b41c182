#!/usr/bin/env bash
# Boots one guest whose first process is systemd, with Instep installed there from BUILD, and runs
# guest/test-unit in it: boot-systemd.sh FOLDER BUILD. Exit code 0 if it passed; 77 if this machine
# cannot have a guest or is told not to. What was said is left in FOLDER, with the journal.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
build=$2
rm -rf "$folder"
mkdir -p "$folder"
"$here/can-boot.sh" "$folder"
[ -x /lib/systemd/systemd ] || { echo "systemd is not installed" >&2 && exit 1; }

DESTDIR=$folder/files cmake --install "$build" --prefix /usr --strip >"$folder/installed"
# A target of its own: the services of this machine stay out of the guest.
units=$folder/files/etc/systemd/system
mkdir -p "$units/instep-test.target.wants"
cat >"$units/instep-test.target" <<'UNIT'
[Unit]
Requires=basic.target
After=basic.target
AllowIsolate=yes
UNIT
cat >"$units/instep-test.service" <<'UNIT'
[Unit]
After=basic.target systemd-udev-trigger.service
FailureAction=poweroff-immediate
[Service]
Type=oneshot
ExecStart=/guest/run-command
StandardOutput=tty
StandardError=tty
TTYPath=/dev/ttyS0
TimeoutStartSec=infinity
UNIT
ln -s ../instep-test.service "$units/instep-test.target.wants/instep-test.service"
for unneeded in timers.target paths.target systemd-timesyncd.service systemd-hwdb-update.service \
  systemd-machine-id-commit.service systemd-update-utmp.service systemd-binfmt.service; do
  ln -s /dev/null "$units/$unneeded"
done

KERNEL_OPTIONS="systemd.unit=instep-test.target systemd.show_status=0 systemd.log_target=kmsg \
systemd.firstboot=off" \
  "$here/run-in-guest.sh" -t 420 -s "$folder" -i /lib/systemd/systemd "$here/guest/test-unit"
[ ! -s "$folder/complaints" ] || { cat "$folder/complaints" && exit 1; }
