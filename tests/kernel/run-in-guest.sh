#!/usr/bin/env bash
# Runs one command in a guest: Debian's kernel on an emulated processor, with this machine's files.
#
#   run-in-guest.sh [-t SECONDS] [-s SHARE] [-i FIRST] COMMAND...
#
# The command sees the files of this machine where they are; what it writes is lost, but for what it
# writes into /guest, which is the folder SHARE of this machine (a temporary one if none is given).
# SHARE/files, if there, is laid over the guest's files. FIRST is its first process: by default
# guest/run-command; /lib/systemd/systemd has to start /guest/run-command by itself.
#
# Exit code: the command's own, or 77 if this machine cannot have a guest, 124 if the time was up
# (default 300 s), 125 if the guest died. In SHARE: dmesg, and complaints (kernel bugs and warnings).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
limit=300
share=
first=/guest/run-command
while getopts t:s:i: option; do
  case $option in
    t) limit=$OPTARG ;;
    s) share=$OPTARG ;;
    i) first=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))

kernel=$("$here/prepare.sh") || exit $?
if [ -z "$share" ]; then
  share=$(mktemp -d)
  trap 'rm -rf "$share"' EXIT
fi
mkdir -p "$share"
rm -f "$share"/{status,dmesg,complaints,journal}
install -m 755 "$here/guest/run-command" "$share/run-command"
{
  printf 'cd %q 2>/dev/null || cd /\nexec' "$PWD"
  printf ' %q' "$@"
  echo
} >"$share/command"

# The guest's clock counts its own instructions, 2 ns each (-icount shift=1), so that a busy host
# does not run its time limits out; sleep=on lets it idle in real time.
outcome=0
timeout --foreground -k 5 "$limit" qemu-system-x86_64 \
  -M q35 -accel tcg -icount shift=1,sleep=on -cpu qemu64 -smp 1 -m 1024 \
  -nodefaults -no-user-config -display none -no-reboot -serial stdio -monitor none \
  -kernel "$kernel/vmlinux" -initrd "$kernel/initrd.cpio" \
  -append "console=ttyS0 quiet panic=-1 oops=panic mitigations=off nokaslr audit=0 \
random.trust_bootloader=on first=$first ${KERNEL_OPTIONS:-}" \
  -fsdev local,id=host,path=/,security_model=none,readonly=on,multidevs=remap \
  -device virtio-9p-pci,fsdev=host,mount_tag=host \
  -fsdev local,id=share,path="$share",security_model=none \
  -device virtio-9p-pci,fsdev=share,mount_tag=share \
  -object rng-random,id=random,filename=/dev/urandom -device virtio-rng-pci,rng=random \
  </dev/null || outcome=$?

# 6.1 itself warns when a GPIO chip goes while a line of it is watched; that one is expected.
grep -E 'BUG:|Oops|WARNING: CPU|general protection|hung_task|blocked for more than' \
  "$share/dmesg" 2>/dev/null | grep -v remove_proc_entry >"$share/complaints" || true
if [ -e "$share/status" ]; then exit "$(cat "$share/status")"; fi
if [ $outcome = 124 ]; then
  echo "The guest did not come to its end within $limit s" >&2
  exit 124
fi
echo "The guest died" >&2
exit 125
