#include "drivers/openni2/child/sensor_events.h"

#include <OpenNI.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace instep {
namespace {

using std::chrono::steady_clock;

/// States as the PS1080 driver numbers them; it also reports the first when a sensor is unplugged.
constexpr int kProjectorFault = 1;
constexpr int kOverheat = 2;

/// How long a fault may turn out to be the first sign of an unplugged cable.
constexpr std::chrono::milliseconds kUnplugging{200};

}  // namespace

/// The callbacks only note what they are told: they run under the locks of the library.
struct SensorEvents::Listener final : openni::OpenNI::DeviceDisconnectedListener,
                                      openni::OpenNI::DeviceStateChangedListener {
  explicit Listener(std::string its_uri) : uri(std::move(its_uri)) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
    openni::OpenNI::addDeviceStateChangedListener(this);
  }
  ~Listener() {
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    openni::OpenNI::removeDeviceStateChangedListener(this);
  }

  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (uri == info->getUri()) gone = true;
  }
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState changed) override {
    if (uri != info->getUri()) return;
    since = steady_clock::now().time_since_epoch().count();
    state = static_cast<int>(changed);
  }

  const std::string uri;
  std::atomic<bool> gone = false;
  std::atomic<int> state = 0;
  std::atomic<steady_clock::rep> since = 0;
};

SensorEvents::SensorEvents(const std::string& uri) : listener_(std::make_unique<Listener>(uri)) {}
SensorEvents::~SensorEvents() = default;

Result<void> SensorEvents::look() const {
  if (listener_->gone) {
    return fail(ErrorCode::kDeviceGone, "the sensor was unplugged", "plug it in again");
  }
  const int state = listener_->state;
  const steady_clock::time_point since{steady_clock::duration(listener_->since)};
  if (state == 0 || steady_clock::now() < since + kUnplugging) return {};
  if (state == kProjectorFault) {
    return fail(ErrorCode::kIo, "the sensor says that its projector fails",
                "unplug it and plug it in again; if it says so still, replace it");
  }
  if (state == kOverheat) {
    return fail(ErrorCode::kIo, "the sensor says that it is too hot", "let it cool down");
  }
  return {};
}

Result<void> SensorEvents::look_after_failure() const {
  const auto last = steady_clock::now() + kUnplugging;
  while (!listener_->gone && steady_clock::now() < last) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return look();
}

}  // namespace instep
