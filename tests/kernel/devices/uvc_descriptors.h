#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace instep::test {

using Bytes = std::vector<std::uint8_t>;

/// The numbers of USB and UVC are little-endian.
void append16(Bytes& bytes, std::uint32_t value);
void append32(Bytes& bytes, std::uint32_t value);

/// What a camera with one format and one size says of itself (USB 2.0 chapter 9, UVC 1.0 chapter
/// 3).
struct UvcDescription {
  std::string product = "Depth Camera";
  std::string serial;
  std::string four_letters;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t frames_per_second = 0;
  std::uint16_t usb_version = 0x0200;
  std::uint16_t vendor = 0x1209;  ///< pid.codes, for tests

  std::uint32_t frame_bytes() const { return 2 * width * height; }
  /// In units of 100 ns.
  std::uint32_t frame_interval() const { return 10'000'000 / frames_per_second; }
};

inline constexpr std::uint32_t kPayloadBytes = 16384;  ///< of one UVC payload, its header included

Bytes device_descriptor(const UvcDescription& camera);
Bytes configuration_descriptor(const UvcDescription& camera);
/// Empty if there is none of this number.
Bytes string_descriptor(const UvcDescription& camera, int number);
/// The parameters of the stream, of which there is no choice (UVC 1.0, 4.3.1.1).
Bytes probe_parameters(const UvcDescription& camera);

}  // namespace instep::test
