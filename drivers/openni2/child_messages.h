#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.h"

namespace instep {

/// What instepd and instep-openni tell each other. Each message is one JSON object in one packet.

inline constexpr std::size_t kLongestChildMessage = 16 * 1024;

/// A way in which a sensor can send depth.
struct DepthMode {
  int width = 0;
  int height = 0;
  int frames_per_second = 0;
  double depth_unit_mm = 0.0;

  bool operator==(const DepthMode&) const = default;
};

/// A sensor as OpenNI2 names it.
struct OpenniDevice {
  std::string serial;  ///< empty where the sensor has none, or where it could not be opened
  std::string uri;     ///< where it is plugged in; another one after each plugging in
  std::string vendor;
  std::string product;
  int usb_vendor = 0;  ///< 0 where it is not on the USB
  int usb_product = 0;
  std::vector<DepthMode> modes;
  std::string trouble;  ///< why it could not be opened; empty if it could
};

/// The sensor is open and set as asked.
struct CameraOpened {
  OpenniDevice device;
  DepthMode mode;
  double horizontal_fov_rad = 0.0;  ///< 0 = the sensor does not say
  double vertical_fov_rad = 0.0;
};
struct CameraStarted {};
struct CameraStopped {};

/// From instep-openni; an Error is the last that it says.
using ChildMessage = std::variant<CameraOpened, CameraStarted, CameraStopped, Error>;

std::string to_text(const ChildMessage& message);
/// Fails with kCorruptData.
Result<ChildMessage> parse_child_message(std::string_view text);

/// What `instep-openni --list` prints: {"devices": [...]}.
std::string to_text(const std::vector<OpenniDevice>& devices);
/// Fails with kCorruptData, or with what the child printed instead.
Result<std::vector<OpenniDevice>> parse_device_list(std::string_view text);

/// To instep-openni.
inline constexpr std::string_view kStartCommand = "start";
inline constexpr std::string_view kStopCommand = "stop";
inline constexpr std::string_view kQuitCommand = "quit";

}  // namespace instep
