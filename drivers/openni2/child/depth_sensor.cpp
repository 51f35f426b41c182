#include "drivers/openni2/child/depth_sensor.h"

#include <OpenNI.h>
#include <PS1080.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "drivers/openni2/child/sensor_events.h"

namespace instep {
namespace {

using openni::OpenNI;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

std::string extended_error() {
  std::string text = OpenNI::getExtendedError();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  text.erase(text.find_last_not_of(" .") + 1);
  text.erase(0, text.find_first_not_of(' '));
  return text.empty() ? "OpenNI2 does not say why" : text;
}

double unit_mm(openni::PixelFormat format) {
  if (format == openni::PIXEL_FORMAT_DEPTH_1_MM) return 1.0;
  if (format == openni::PIXEL_FORMAT_DEPTH_100_UM) return 0.1;
  return 0.0;  // disparities, which are no depth yet
}

DepthMode to_mode(const openni::VideoMode& mode) {
  return {mode.getResolutionX(), mode.getResolutionY(), mode.getFps(),
          unit_mm(mode.getPixelFormat())};
}

std::vector<DepthMode> depth_modes(openni::Device& device) {
  std::vector<DepthMode> modes;
  const auto* sensor = device.getSensorInfo(openni::SENSOR_DEPTH);
  if (sensor == nullptr) return modes;
  const auto& offered = sensor->getSupportedVideoModes();
  for (int i = 0; i < offered.getSize(); ++i) {
    const DepthMode mode = to_mode(offered[i]);
    if (mode.depth_unit_mm > 0.0) modes.push_back(mode);
  }
  return modes;
}

std::string serial_of(const openni::Device& device) {
  std::array<char, ONI_MAX_STR> text{};
  int size = static_cast<int>(text.size());
  const auto status = device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, text.data(), &size);
  text.back() = '\0';
  return status == openni::STATUS_OK ? text.data() : "";
}

/// True if a sensor on the USB, whose place is written vendor/product@bus/number, may not be
/// opened.
bool is_forbidden(const std::string& uri) {
  unsigned vendor = 0;
  unsigned product = 0;
  unsigned bus = 0;
  unsigned number = 0;
  if (std::sscanf(uri.c_str(), "%4x/%4x@%3u/%3u", &vendor, &product, &bus, &number) != 4) {
    return false;
  }
  const std::string node = fmt::format("/dev/bus/usb/{:03}/{:03}", bus, number);
  return ::access(node.c_str(), F_OK) == 0 && ::access(node.c_str(), R_OK | W_OK) != 0;
}

tl::unexpected<Error> not_opened(const std::string& uri, openni::Status status) {
  if (status == openni::STATUS_NO_DEVICE) {
    return fail(ErrorCode::kDeviceGone, "the sensor was unplugged", "plug it in again");
  }
  if (is_forbidden(uri)) {
    return fail(ErrorCode::kPermissionDenied, "this user may not open the sensor at " + uri,
                "install the udev rules of libopenni2-0, plug the sensor in again, and let the "
                "user be in the group plugdev");
  }
  return fail(ErrorCode::kBusy,
              fmt::format("the sensor at {} cannot be opened ({})", uri, extended_error()),
              "close other programs that use it, or plug it in again");
}

Error keeps(const std::string& what) {
  return {ErrorCode::kUnsupported, Remedy::kOperator, "the sensor " + what,
          "use a sensor or a driver that does as it is told"};
}

bool all_within(const std::uint16_t* row, std::size_t count, std::uint16_t largest) {
  std::uint16_t found = 0;
  for (std::size_t i = 0; i < count; ++i) found = std::max(found, row[i]);
  return found <= largest;
}

}  // namespace

struct DepthSensor::Parts {
  explicit Parts(const OpenniDevice& place) : info(place), events(place.uri) {}
  ~Parts() {
    stream.destroy();
    device.close();
  }

  OpenniDevice info;
  SensorEvents events;
  openni::Device device;
  openni::VideoStream stream;
  openni::VideoMode mode;
  std::uint16_t largest = 0xFFFF;  ///< depth that the sensor may send

  Result<void> set_mode(const DepthMode& wanted);
  Result<void> set_straight();
  RingRecord judge(const openni::VideoFrameRef& frame) const;
};

Result<void> load_openni() {
  if (OpenNI::initialize() == openni::STATUS_OK) return {};
  return fail(ErrorCode::kUnsupported,
              fmt::format("OpenNI2 finds no driver for any sensor ({})", extended_error()),
              "install libopenni2-0, or name the folder of the maker's libOpenNI2.so.0, which has "
              "OpenNI2/Drivers in it");
}

std::vector<OpenniDevice> plugged_in_sensors() {
  openni::Array<openni::DeviceInfo> infos;
  OpenNI::enumerateDevices(&infos);
  std::vector<OpenniDevice> found;
  for (int i = 0; i < infos.getSize(); ++i) {
    OpenniDevice device;
    device.uri = infos[i].getUri();
    device.vendor = infos[i].getVendor();
    device.product = infos[i].getName();
    device.usb_vendor = infos[i].getUsbVendorId();
    device.usb_product = infos[i].getUsbProductId();
    found.push_back(std::move(device));
  }
  return found;
}

DepthSensor::DepthSensor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
DepthSensor::~DepthSensor() = default;

Result<std::unique_ptr<DepthSensor>> DepthSensor::open(const OpenniDevice& place) {
  auto parts = std::make_unique<Parts>(place);
  const auto status = parts->device.open(place.uri.c_str());
  if (status != openni::STATUS_OK) return not_opened(place.uri, status);
  parts->info.serial = serial_of(parts->device);
  parts->info.modes = depth_modes(parts->device);
  return std::unique_ptr<DepthSensor>(new DepthSensor(std::move(parts)));
}

const OpenniDevice& DepthSensor::device() const {
  return parts_->info;
}

Result<CameraOpened> DepthSensor::set_up(const std::optional<ImageSize>& size) {
  const auto mode = choose_mode(parts_->info.modes, size);
  if (!mode) return tl::make_unexpected(mode.error());
  if (parts_->stream.create(parts_->device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    return fail(ErrorCode::kBusy,
                fmt::format("the sensor's depth cannot be had ({})", extended_error()),
                "close other programs that use it, or plug it in again");
  }
  if (auto set = parts_->set_mode(*mode); !set) return tl::make_unexpected(set.error());
  if (auto set = parts_->set_straight(); !set) return tl::make_unexpected(set.error());
  const int largest = parts_->stream.getMaxPixelValue();
  if (largest > 0 && largest < 0xFFFF) parts_->largest = static_cast<std::uint16_t>(largest);
  CameraOpened opened;
  opened.device = parts_->info;
  opened.mode = *mode;
  opened.horizontal_fov_rad = static_cast<double>(parts_->stream.getHorizontalFieldOfView());
  opened.vertical_fov_rad = static_cast<double>(parts_->stream.getVerticalFieldOfView());
  return opened;
}

Result<void> DepthSensor::Parts::set_mode(const DepthMode& wanted) {
  mode.setResolution(wanted.width, wanted.height);
  mode.setFps(wanted.frames_per_second);
  mode.setPixelFormat(wanted.depth_unit_mm < 0.5 ? openni::PIXEL_FORMAT_DEPTH_100_UM
                                                 : openni::PIXEL_FORMAT_DEPTH_1_MM);
  if (stream.setVideoMode(mode) != openni::STATUS_OK ||
      !(to_mode(stream.getVideoMode()) == wanted)) {
    return tl::make_unexpected(keeps("keeps its own image size, rate or depth unit"));
  }
  return {};
}

/// Turns off what makes the image another one than the depth sensor sees.
Result<void> DepthSensor::Parts::set_straight() {
  if (device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR)) {
    device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_OFF);
    if (device.getImageRegistrationMode() != openni::IMAGE_REGISTRATION_OFF) {
      return tl::make_unexpected(keeps("goes on projecting its depth into the colour camera"));
    }
  }
  stream.setMirroringEnabled(false);
  if (stream.getMirroringEnabled()) {
    return tl::make_unexpected(keeps("goes on mirroring its image"));
  }
  constexpr int kHoleFilter = static_cast<int>(XN_STREAM_PROPERTY_HOLE_FILTER);
  if (stream.isPropertySupported(kHoleFilter)) {
    std::uint64_t filter = 0;
    stream.setProperty(kHoleFilter, filter);
    if (stream.getProperty(kHoleFilter, &filter) != openni::STATUS_OK || filter != 0) {
      return tl::make_unexpected(keeps("goes on filling holes with depth that it has not seen"));
    }
  }
  constexpr int kCloseRange = static_cast<int>(XN_STREAM_PROPERTY_CLOSE_RANGE);
  if (stream.isPropertySupported(kCloseRange)) {
    // Old firmware has the property, but refuses it, and serves all the same.
    const std::uint64_t close = 1;
    stream.setProperty(kCloseRange, close);
  }
  return {};
}

Result<void> DepthSensor::start() {
  if (auto well = look(); !well) return well;
  if (parts_->stream.start() == openni::STATUS_OK) return {};
  if (auto well = parts_->events.look_after_failure(); !well) return well;
  return fail(ErrorCode::kIo, Remedy::kReopen,
              fmt::format("the sensor does not start ({})", extended_error()),
              "unplug it and plug it in again");
}

void DepthSensor::stop() {
  parts_->stream.stop();
}

Result<void> DepthSensor::look() const {
  return parts_->events.look();
}

Result<bool> DepthSensor::wait_for_frame(milliseconds limit, FrameRing& ring) {
  openni::VideoStream* stream = &parts_->stream;
  int ready = 0;
  const auto status = OpenNI::waitForAnyStream(&stream, 1, &ready, static_cast<int>(limit.count()));
  const auto now = steady_clock::now();
  if (auto well = look(); !well) return tl::make_unexpected(well.error());
  // Reading a frame that is not there blocks for ever.
  if (status != openni::STATUS_OK) return false;
  openni::VideoFrameRef frame;
  if (parts_->stream.readFrame(&frame) != openni::STATUS_OK || !frame.isValid()) return false;
  RingRecord record = parts_->judge(frame);
  record.host_time_ns = std::chrono::nanoseconds(now.time_since_epoch()).count();
  return ring.put(record, static_cast<const std::uint16_t*>(frame.getData()),
                  static_cast<std::size_t>(frame.getStrideInBytes()) / sizeof(std::uint16_t));
}

/// What is to be said of a frame; its pixels are passed on as far as they make sense.
RingRecord DepthSensor::Parts::judge(const openni::VideoFrameRef& frame) const {
  RingRecord record;
  record.sequence = static_cast<std::uint64_t>(std::max(frame.getFrameIndex(), 0));
  record.device_time_us = static_cast<std::int64_t>(frame.getTimestamp());
  record.width = mode.getResolutionX();
  record.height = mode.getResolutionY();
  const int stride = frame.getStrideInBytes();
  const auto pixel_bytes = static_cast<int>(sizeof(std::uint16_t));
  if (frame.getWidth() != record.width || frame.getHeight() != record.height ||
      frame.getVideoMode().getPixelFormat() != mode.getPixelFormat() ||
      frame.getCroppingEnabled() || stride < record.width * pixel_bytes ||
      stride % pixel_bytes != 0) {
    record.status = FrameStatus::kCorrupt;
    return record;
  }
  const int rows = std::clamp(frame.getDataSize() / stride, 0, record.height);
  if (rows < record.height) record.status = FrameStatus::kIncomplete;
  record.pixels = static_cast<std::uint32_t>(rows * record.width);
  const auto* pixels = static_cast<const std::uint16_t*>(frame.getData());
  for (int row = 0; row < rows; ++row) {
    const auto* begin = pixels + static_cast<std::ptrdiff_t>(row) * (stride / pixel_bytes);
    if (!all_within(begin, static_cast<std::size_t>(record.width), largest)) {
      record.status = FrameStatus::kCorrupt;
    }
  }
  return record;
}

}  // namespace instep
