#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "drivers/pedal.h"

namespace instep {

/// A USB foot switch that acts as a keyboard: one of its keys is the pedal. The device is taken for
/// this program alone (EVIOCGRAB), so that a press does not type into whatever window is open. Time
/// stamps are the kernel's (CLOCK_MONOTONIC, to the microsecond). Holding the key down repeats
/// nothing here.
class EvdevPedal final : public Pedal {
 public:
  struct Settings {
    /// Its USB ids, "0c45:7403", or its link in /dev/input/by-id, where the serial number of two
    /// like pedals tells them apart: "usb-PCsensor_FootSwitch-event-kbd".
    std::string device;
    std::string key;  ///< as the kernel calls it: "KEY_B"
    std::filesystem::path devices = "/dev/input";
  };

  /// Fails with kNotFound if the device is away or has no such key, kPermissionDenied if it cannot
  /// be opened, kBusy if another program has grabbed it, kInvalidInput if the key's name is unknown
  /// or several devices answer. Worth another try later.
  static Result<std::unique_ptr<EvdevPedal>> open(const Settings& settings);

  ~EvdevPedal() override;

  int descriptor() const override;
  Result<std::vector<PedalEdge>> read_edges() override;
  /// The key after all edges that have been read: the kernel says itself when it dropped some, and
  /// read_edges() then asks for the key's state.
  Result<bool> is_pressed() override;
  Result<void> reopen() override;

 private:
  struct Connection;

  EvdevPedal(const Settings& settings, unsigned key);
  Result<void> connect();
  tl::unexpected<Error> gone();

  Settings settings_;
  unsigned key_;
  std::unique_ptr<Connection> connection_;  ///< null between a reopen() that failed and the next
  bool gone_ = false;
};

}  // namespace instep
