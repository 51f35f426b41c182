#include <Driver/OniDriverAPI.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cstring>

#include "sim/openni2_module/module_parts.h"
#include "sim/openni2_module/sensor_modes.h"

namespace instep {
namespace {

class Device final : public oni::driver::DeviceBase {
 public:
  Device(std::shared_ptr<const Plug> plug, int hold)
      : plug_(std::move(plug)), hold_(hold), modes_(sensor_modes(plug_->device())) {
    sensor_.sensorType = ONI_SENSOR_DEPTH;
    sensor_.numSupportedVideoModes = static_cast<int>(modes_.size());
    sensor_.pSupportedVideoModes = modes_.data();
  }

  ~Device() override { ::close(hold_); }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = &sensor_;
    *count = 1;
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType type) override {
    if (type != ONI_SENSOR_DEPTH) return nullptr;
    return make_depth_stream(plug_, registered_).release();
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }

  OniStatus getProperty(int id, void* data, int* size) override {
    if (id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER) {
      const std::string serial = plug_->device().serial;
      if (*size <= static_cast<int>(serial.size())) return ONI_STATUS_BAD_PARAMETER;
      std::memcpy(data, serial.c_str(), serial.size() + 1);
      *size = static_cast<int>(serial.size()) + 1;
      return ONI_STATUS_OK;
    }
    if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
      const auto mode =
          registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
      if (*size != static_cast<int>(sizeof mode)) return ONI_STATUS_BAD_PARAMETER;
      std::memcpy(data, &mode, sizeof mode);
      return ONI_STATUS_OK;
    }
    return ONI_STATUS_NOT_SUPPORTED;
  }

  OniStatus setProperty(int id, const void* data, int size) override {
    OniImageRegistrationMode mode{};
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
    if (size != static_cast<int>(sizeof mode)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(&mode, data, sizeof mode);
    if (!plug_->has("keep-registration")) {
      registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    }
    return ONI_STATUS_OK;
  }

  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }

 private:
  const std::shared_ptr<const Plug> plug_;
  const int hold_;
  std::vector<OniVideoMode> modes_;
  OniSensorInfo sensor_{};
  std::atomic<bool> registered_ = true;
};

}  // namespace

std::unique_ptr<oni::driver::DeviceBase> make_device(std::shared_ptr<const Plug> plug) {
  // The kernel lets go of it when the process ends, as it does of a sensor.
  const auto hold = plug->device().frames.string() + ".in-use";
  const int descriptor = ::open(hold.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    return nullptr;
  }
  return std::make_unique<Device>(std::move(plug), descriptor);
}

}  // namespace instep
