#include "tests/kernel/devices/uvc_descriptors.h"

namespace instep::test {
namespace {

constexpr std::uint8_t kInterface = 4;
constexpr std::uint8_t kEndpoint = 5;
constexpr std::uint8_t kAssociation = 11;
constexpr std::uint8_t kClassSpecific = 0x24;
constexpr std::uint8_t kVideoClass = 14;
constexpr std::uint8_t kControl = 1;
constexpr std::uint8_t kStreaming = 2;
constexpr std::uint8_t kStreamEndpoint = 0x81;  // 1, to the host

void append(Bytes& bytes, const Bytes& more) {
  bytes.reserve(bytes.size() + more.size());
  for (const auto byte : more) bytes.push_back(byte);
}

/// A descriptor begins with its length and its kind.
Bytes descriptor(std::uint8_t kind, const Bytes& content) {
  Bytes bytes;
  bytes.push_back(static_cast<std::uint8_t>(content.size() + 2));
  bytes.push_back(kind);
  append(bytes, content);
  return bytes;
}

Bytes interface(std::uint8_t number, std::uint8_t endpoints, std::uint8_t subclass) {
  return descriptor(kInterface, {number, 0, endpoints, kVideoClass, subclass, 0, 0});
}

/// A header tells the length of all class-specific descriptors of its interface, itself included.
Bytes with_header(Bytes before_length, const Bytes& after_length, const Bytes& others) {
  const std::size_t own = 2 + before_length.size() + 2 + after_length.size();
  append16(before_length, static_cast<std::uint32_t>(own + others.size()));
  append(before_length, after_length);
  Bytes all = descriptor(kClassSpecific, before_length);
  append(all, others);
  return all;
}

/// A camera terminal (1) joined to an output terminal (2).
Bytes control_descriptors() {
  Bytes units = descriptor(kClassSpecific, {2, 1, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0});
  append(units, descriptor(kClassSpecific, {3, 2, 1, 1, 0, 1, 0}));
  return with_header({1, 0x00, 1}, {0x00, 0x6C, 0xDC, 0x02, 1, 1}, units);  // a clock of 48 MHz
}

Bytes format_descriptor(const UvcDescription& camera) {
  Bytes format{4, 1, 1};  // uncompressed, format 1, of one size
  append(format, Bytes(camera.four_letters.begin(), camera.four_letters.end()));
  // The rest of the GUID is the same for all formats that are named by four letters.
  append(format, {0, 0, 0x10, 0, 0x80, 0, 0, 0xAA, 0, 0x38, 0x9B, 0x71});
  append(format, {16, 1, 0, 0, 0, 0});  // bits a pixel
  return descriptor(kClassSpecific, format);
}

Bytes frame_descriptor(const UvcDescription& camera) {
  const std::uint32_t bits_per_second = 8 * camera.frame_bytes() * camera.frames_per_second;
  Bytes frame{5, 1, 0};
  append16(frame, camera.width);
  append16(frame, camera.height);
  append32(frame, bits_per_second);  // the least and the most
  append32(frame, bits_per_second);
  append32(frame, camera.frame_bytes());
  append32(frame, camera.frame_interval());
  frame.push_back(1);  // one interval to choose from
  append32(frame, camera.frame_interval());
  return descriptor(kClassSpecific, frame);
}

Bytes streaming_descriptors(const UvcDescription& camera) {
  Bytes formats = format_descriptor(camera);
  append(formats, frame_descriptor(camera));
  return with_header({1, 1}, {kStreamEndpoint, 0, 2, 0, 0, 0, 1, 0}, formats);
}

}  // namespace

void append16(Bytes& bytes, std::uint32_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 0xFF));
}

void append32(Bytes& bytes, std::uint32_t value) {
  append16(bytes, value & 0xFFFF);
  append16(bytes, value >> 16);
}

Bytes device_descriptor(const UvcDescription& camera) {
  Bytes device;
  append16(device, camera.usb_version);
  append(device, {0xEF, 2, 1, 64});  // its interfaces are associated
  append16(device, camera.vendor);
  append16(device, 0x0001);
  append16(device, 0x0100);
  append(device, {1, 2, 3, 1});  // numbers of its strings; one configuration
  return descriptor(1, device);
}

Bytes configuration_descriptor(const UvcDescription& camera) {
  Bytes parts = descriptor(kAssociation, {0, 2, kVideoClass, 3, 0, 2});
  append(parts, interface(0, 0, kControl));
  append(parts, control_descriptors());
  append(parts, interface(1, 1, kStreaming));
  append(parts, streaming_descriptors(camera));
  append(parts, descriptor(kEndpoint, {kStreamEndpoint, 2, 0x00, 0x02, 0}));  // bulk, 512 bytes
  Bytes configuration{9, 2};
  append16(configuration, static_cast<std::uint32_t>(9 + parts.size()));
  append(configuration, {2, 1, 0, 0x80, 250});  // two interfaces, powered by the bus
  append(configuration, parts);
  return configuration;
}

Bytes string_descriptor(const UvcDescription& camera, int number) {
  constexpr std::uint8_t kString = 3;
  if (number == 0) return descriptor(kString, {0x09, 0x04});  // English
  const std::string texts[] = {"Instep", camera.product, camera.serial};
  if (number > 3) return {};
  Bytes text;
  for (const char letter : texts[number - 1]) append16(text, static_cast<unsigned char>(letter));
  return descriptor(kString, text);
}

Bytes probe_parameters(const UvcDescription& camera) {
  Bytes parameters;
  append16(parameters, 1);     // hint: the interval is fixed
  append(parameters, {1, 1});  // format and size
  append32(parameters, camera.frame_interval());
  append(parameters, Bytes(10, 0));  // compression, which there is none of
  append32(parameters, camera.frame_bytes());
  append32(parameters, kPayloadBytes);
  return parameters;
}

}  // namespace instep::test
