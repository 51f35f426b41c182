#!/usr/bin/env bash
# Makes what a guest boots from, once for each kernel and each version of these scripts:
#
#   <cache>/<key>/vmlinux      Debian's own kernel, unpacked so that it starts at once
#   <cache>/<key>/initrd.cpio  busybox, the modules that tests need, and guest/init
#
# and prints the folder. The cache is $XDG_CACHE_HOME/instep-kernel or ~/.cache/instep-kernel.
# Downloads about 225 MB and takes half a minute; when all is there, it takes no time.
# Exit code 77: this machine cannot have it, as stderr says.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/instep-kernel

cannot() {
  echo "No kernel to test against: $*" >&2
  exit 77
}
for program in apt-get dpkg-deb qemu-system-x86_64 busybox cpio depmod modprobe make gcc xz flock; do
  command -v "$program" >/dev/null || PATH=$PATH:/sbin:/usr/sbin command -v "$program" >/dev/null ||
    cannot "$program is not installed (tests/install-dependencies.sh)"
done
PATH=$PATH:/sbin:/usr/sbin
[ "$(dpkg --print-architecture)" = amd64 ] || cannot "it is made for amd64 machines"

scripts=$(cat "$here/prepare.sh" "$here/guest/init" | sha256sum | cut -c1-12)
newest() {
  apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/.*Depends: linux-image-//p' | head -1
}
kernel=$(newest)
if [ -z "$kernel" ] && [ "$(id -u)" = 0 ]; then
  apt-get update -qq >&2 || true
  kernel=$(newest)
fi
if [ -z "$kernel" ]; then
  # Without package lists, a kernel that was made before is as good.
  kernel=$(ls -t "$cache" 2>/dev/null | sed -n "s/-$scripts\$//p" | head -1)
  [ -n "$kernel" ] || cannot "apt knows no linux-image-amd64 (apt-get update, with a network)"
fi

folder=$cache/$kernel-$scripts
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9
if [ -e "$folder/initrd.cpio" ]; then
  touch "$folder"
  echo "$folder"
  exit 0
fi

work=$(mktemp -d "$cache/making.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
version=$(apt-cache show "linux-image-$kernel" | sed -n 's/^Version: //p' | head -1)
flavour=${kernel##*-}
headers=linux-headers-$kernel
common=linux-headers-${kernel%-"$flavour"}-common
series=$(echo "$kernel" | cut -d. -f1,2)
echo "Making a guest of Debian's kernel $kernel in $folder" >&2
# As root, apt wants to download as a user of its own, who may not write here.
apt-get -o APT::Sandbox::User="$(id -un)" download -qq "linux-image-$kernel=$version" \
  "$headers=$version" "$common=$version" "linux-kbuild-$series=$version" \
  "linux-source-$series=$version" >&2 || {
  # The lists may be older than the archive, which keeps the newest only.
  [ "$(id -u)" = 0 ] && [ -z "${LISTS_ARE_NEW:-}" ] || cannot "the download failed"
  apt-get update -qq >&2 || cannot "the download failed"
  rm -rf "$work"
  LISTS_ARE_NEW=1 exec "$here/prepare.sh"
}

# The kernel, without the drivers of machines that a guest does not have.
mkdir tree
dpkg-deb --fsys-tarfile linux-image-*.deb | tar -x -C tree --exclude=./usr \
  --exclude='*/drivers/gpu' --exclude='*/drivers/net' --exclude='*/drivers/infiniband' \
  --exclude='*/drivers/scsi' --exclude='*/drivers/iio' --exclude='*/kernel/sound'
# Uncompressed, it starts 5 s earlier: an emulated processor is slow at xz.
xz_starts=$(LC_ALL=C grep -aobPm1 '\xFD7zXZ\x00' "tree/boot/vmlinuz-$kernel" | head -1 | cut -d: -f1)
# xz complains of what stands behind its data, after all of them are out.
tail -c +$((xz_starts + 1)) "tree/boot/vmlinuz-$kernel" |
  xz -dc --single-stream >vmlinux 2>/dev/null || true
head -c 4 vmlinux | grep -q ELF || cannot "vmlinuz-$kernel holds no kernel in xz"

# gpio-sim is the kernel's own simulated GPIO chip, which Debian does not build. The headers are
# unpacked, not installed: their paths are turned to this folder.
mkdir headers gpio-sim
for package in linux-headers-*.deb linux-kbuild-*.deb; do dpkg-deb -x "$package" headers; done
sed -i "s,/usr/src/,$work/headers/usr/src/," "headers/usr/src/$headers/Makefile"
dpkg-deb --fsys-tarfile linux-source-*.deb |
  tar -xO "./usr/src/linux-source-$series.tar.xz" | xz -dc |
  tar -x -C gpio-sim --transform 's,.*/,,' --wildcards '*/drivers/gpio/gpio-sim.c' \
    '*/drivers/gpio/gpiolib.h' '*/kernel/irq/irq_sim.c'
# Its simulated interrupts are left out of Debian's kernel too: they become a part of the module,
# which may only call what the kernel exports.
mv gpio-sim/gpio-sim.c gpio-sim/gpio-sim-core.c
sed -i 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq(irqnum);/' gpio-sim/irq_sim.c
printf 'obj-m := gpio-sim.o\ngpio-sim-y := gpio-sim-core.o irq_sim.o\n' >gpio-sim/Kbuild
make -s -C "headers/usr/src/$headers" M="$work/gpio-sim" modules >gpio-sim/log 2>&1 || {
  cat gpio-sim/log >&2
  exit 1
}
modules=tree/lib/modules/$kernel
mkdir "$modules/extra"
strip -g -o "$modules/extra/gpio-sim.ko" gpio-sim/gpio-sim.ko
depmod -b tree "$kernel"

# What the guest starts with, and what its tests load by modprobe.
starting=(virtio_pci 9pnet_virtio 9p overlay virtio_rng)
loadable=(configfs autofs4 efi_pstore gpio-sim uinput evdev uvcvideo vhci-hcd vivid)
files_of() {
  local module
  for module in "$@"; do
    modprobe -d tree -S "$kernel" --show-depends "$module" || exit 1
  done | awk '$1 == "insmod" { sub(".*/tree/", "", $2); if (!seen[$2]++) print $2 }'
}
initrd=initrd
mkdir -p $initrd/{bin,proc,sys,dev,lower,upper,new,"lib/modules/$kernel"}
cp /bin/busybox $initrd/bin/busybox
cp "$here/guest/init" $initrd/init
chmod +x $initrd/init
cp "$modules"/modules.{builtin,builtin.modinfo,order} "$initrd/lib/modules/$kernel"
needed=$(files_of "${starting[@]}" "${loadable[@]}")
for module in $needed; do install -D -m 644 "tree/$module" "$initrd/$module"; done
depmod -b $initrd "$kernel"
needed=$(files_of "${starting[@]}")
for module in $needed; do echo "/$module"; done >$initrd/starting
(cd $initrd && find . | cpio --quiet -o -H newc -R 0:0 >../initrd.cpio)

rm -rf "$folder"
mkdir "$folder"
cp vmlinux "$folder"
mv initrd.cpio "$folder" # last: its presence says that all is there
# What nobody has booted for a month is not kept.
find "$cache" -mindepth 1 -maxdepth 1 -type d -mtime +30 -exec rm -rf {} +
echo "$folder"
