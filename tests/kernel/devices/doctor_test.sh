#!/bin/sh
# `instep doctor` names why a pedal or a lamp on a GPIO line cannot serve: no chip, another holder, no
# right; and `instep devices` shows the lines.
set -eu
folder=$(mktemp -d)
chmod 755 "$folder"
export INSTEP_CONFIG="$folder/instep.toml" INSTEP_STORE="$folder/scans" INSTEP_SOCKET="$folder/control.sock"
cat >"$INSTEP_CONFIG" <<'TOML'
[[camera]]
kind = "simulated"
[simulation]
cameras = 1
width_px = 64
height_px = 48
[pedal]
kind = "gpio"
[pedal.gpio]
line = "foot"
[lamp.ready]
line = "lamp"
TOML
says() {
  wanted=$1
  shift
  said=$("$@" 2>&1) || true # doctor fails here: no daemon runs
  case $said in
    *"$wanted"*) echo "ok: $wanted" ;;
    *) echo "it does not say: $wanted" && echo "$said" && exit 1 ;;
  esac
}
says "pedal       there is no GPIO chip" instep doctor
says "output      lamp.ready: there is no GPIO chip" instep doctor

chip=/sys/kernel/config/gpio-sim/doctor
mkdir -p $chip/bank0/line3 $chip/bank0/line4
echo board >$chip/bank0/label
echo 8 >$chip/bank0/num_lines
echo foot >$chip/bank0/line3/name
echo lamp >$chip/bank0/line4/name
echo 1 >$chip/live
udevadm settle --timeout=30
says "pedal       can be opened" instep doctor
says "output      lamp.ready can be opened" instep doctor
says "\"foot\", the pedal" instep devices --format text
says "\"lamp\", the lamp.ready" instep devices --format text

# As udev leaves a chip without the rules of Instep.
node=/dev/$(cat $chip/bank0/chip_name)
chmod 600 "$node"
says "?     pedal       not looked at: this user may not open $node" \
  setpriv --reuid=65534 --clear-groups "$(command -v instep)" doctor
says "$node: you may not open it" \
  setpriv --reuid=65534 --clear-groups "$(command -v instep)" devices --format text

# The old interface of sysfs holds a line as "sysfs".
first=$(cat /sys/class/gpio/gpiochip*/base)
echo $((first + 3)) >/sys/class/gpio/export
says "is held by \"sysfs\"" instep doctor
echo $((first + 3)) >/sys/class/gpio/unexport
says "pedal       can be opened" instep doctor
echo $((first + 4)) >/sys/class/gpio/export
says "lamp.ready: line \"lamp\" ($(basename "$node")) is held by \"sysfs\"" instep doctor
echo $((first + 4)) >/sys/class/gpio/unexport

echo 0 >$chip/live
rmdir $chip/bank0/line3 $chip/bank0/line4 $chip/bank0 $chip
