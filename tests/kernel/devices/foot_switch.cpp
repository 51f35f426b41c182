#include "tests/kernel/devices/foot_switch.h"

#include <libevdev/libevdev-uinput.h>
#include <libevdev/libevdev.h>

#include <initializer_list>
#include <stdexcept>

namespace instep::test {

FootSwitch::FootSwitch(int product) : product_(product) {
  plug_in();
}

void FootSwitch::plug_in() {
  libevdev* description = libevdev_new();
  libevdev_set_name(description, "Foot switch of the tests");
  libevdev_set_id_bustype(description, BUS_USB);
  libevdev_set_id_vendor(description, 0x0c45);
  libevdev_set_id_product(description, product_);
  for (const unsigned key : std::initializer_list<unsigned>{KEY_B, KEY_C}) {
    libevdev_enable_event_code(description, EV_KEY, key, nullptr);
  }
  const int failed =
      libevdev_uinput_create_from_device(description, LIBEVDEV_UINPUT_OPEN_MANAGED, &device_);
  libevdev_free(description);
  if (failed != 0) throw std::runtime_error("no uinput device can be made");
}

void FootSwitch::unplug() {
  if (device_ != nullptr) libevdev_uinput_destroy(device_);
  device_ = nullptr;
}

void FootSwitch::send(unsigned key, int value) const {
  libevdev_uinput_write_event(device_, EV_KEY, key, value);
  libevdev_uinput_write_event(device_, EV_SYN, SYN_REPORT, 0);
}

std::string FootSwitch::node() const {
  return libevdev_uinput_get_devnode(device_);
}

}  // namespace instep::test
