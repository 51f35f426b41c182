#pragma once

#include <string>

struct libevdev_uinput;

namespace instep::test {

/// A foot switch in software (uinput): a keyboard with the keys B and C. Plugged in while it lives.
class FootSwitch {
 public:
  explicit FootSwitch(int product = 0x7403);
  ~FootSwitch() { unplug(); }
  FootSwitch(const FootSwitch&) = delete;
  FootSwitch& operator=(const FootSwitch&) = delete;

  void plug_in();
  void unplug();
  /// Value 1 presses the key, 0 releases it, 2 repeats it.
  void send(unsigned key, int value) const;
  std::string node() const;

 private:
  int product_;
  libevdev_uinput* device_ = nullptr;
};

}  // namespace instep::test
