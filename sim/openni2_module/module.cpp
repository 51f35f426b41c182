// A driver module of OpenNI2, loaded by the stock library from <root>/OpenNI2/Drivers: sensors that
// are plugged in by files in <root>/bus (bus_folder.h) and fail on command, while they run, by
// `fault` lines in those files:
//
//     stall           no image comes                  slow      an image every 0.3 s
//     corrupt         values beyond the sensor's      short     a third of the data is missing
//     wrong-size      half the width                  overheat  the device says that it is too hot
//     crash           ends the process (abort)        busy      cannot be opened
//     slow-open       takes 50 ms to open             slow-start  takes 1.2 s to begin its stream
//     hang-open, hang-start, hang-stop                never come back
//     keep-mirror, keep-holes, keep-mode, keep-registration
//                     takes the setting, but does not do it

#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

#include <Driver/OniDriverAPI.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "drivers/files/wake_up.h"
#include "drivers/openni2/simulated_vendor.h"
#include "sim/openni2_module/module_parts.h"

namespace instep {
namespace {

constexpr int kHotDeviceState = ONI_DEVICE_STATE_NOT_READY;

/// <root>/bus. The library changes into the folder of its drivers, <root>/OpenNI2/Drivers, while it
/// loads them; the path of the module itself does not help, for links to it are followed.
std::filesystem::path bus_folder() {
  return std::filesystem::current_path().parent_path().parent_path() / "bus";
}

OniDeviceInfo info_of(const BusDevice& device) {
  OniDeviceInfo info{};
  std::snprintf(info.uri, sizeof info.uri, "%s", device.uri.c_str());
  std::snprintf(info.vendor, sizeof info.vendor, "%s", kSimulatedVendor);
  std::snprintf(info.name, sizeof info.name, "simulated depth sensor");
  return info;
}

class Module final : public oni::driver::DriverBase {
 public:
  explicit Module(OniDriverServices* services) : DriverBase(services), folder_(bus_folder()) {}
  ~Module() override { shutdown(); }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    changes_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
    ::inotify_add_watch(changes_, folder_.c_str(),
                        IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE);
    look_at_bus();
    watcher_ = std::thread([this] { watch(); });
    return ONI_STATUS_OK;
  }

  void shutdown() override {
    if (!watcher_.joinable()) return;
    end_.set();
    watcher_.join();
    ::close(changes_);
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    const auto plug = plug_of(uri);
    if (!plug) return nullptr;
    if (plug->has("hang-open")) {
      while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    auto device = plug->has("busy") ? nullptr : make_device(plug);
    if (plug->has("slow-open")) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (!device) getServices().errorLoggerAppend("the simulated sensor is held by somebody else");
    return device.release();
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

 private:
  std::shared_ptr<Plug> plug_of(const std::string& uri) {
    const std::lock_guard lock(mutex_);
    for (const auto& [file, plug] : plugs_) {
      if (plug->device().uri == uri) return plug;
    }
    return nullptr;
  }

  void watch() {
    while (true) {
      std::array<pollfd, 2> waited{{{changes_, POLLIN, 0}, {end_.descriptor(), POLLIN, 0}}};
      ::poll(waited.data(), waited.size(), -1);
      if (waited[1].revents != 0) return;
      alignas(inotify_event) std::array<char, 4096> events;
      while (::read(changes_, events.data(), events.size()) > 0) continue;
      look_at_bus();
    }
  }

  /// Tells the library, outside of the lock, what has come and gone.
  void look_at_bus() {
    const auto there = read_bus(folder_);
    for (const auto& gone : take_gone(there)) {
      const OniDeviceInfo info = info_of(gone->device());
      gone->pull();
      deviceStateChanged(&info, ONI_DEVICE_STATE_ERROR);
      deviceDisconnected(&info);
    }
    for (const auto& [file, device] : there) {
      const OniDeviceInfo info = info_of(device);
      if (const auto known = known_plug(file)) {
        const bool heated = device.has("overheat") && !known->has("overheat");
        known->change(device);
        if (heated) deviceStateChanged(&info, kHotDeviceState);
        continue;
      }
      {
        const std::lock_guard lock(mutex_);
        plugs_.emplace(file, std::make_shared<Plug>(device));
      }
      deviceConnected(&info);
    }
  }

  /// A file that names another URI is another plugging in.
  std::vector<std::shared_ptr<Plug>> take_gone(const std::map<std::string, BusDevice>& there) {
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<Plug>> gone;
    for (auto plug = plugs_.begin(); plug != plugs_.end();) {
      const auto found = there.find(plug->first);
      if (found != there.end() && found->second.uri == plug->second->device().uri) {
        ++plug;
        continue;
      }
      gone.push_back(plug->second);
      plug = plugs_.erase(plug);
    }
    return gone;
  }

  std::shared_ptr<Plug> known_plug(const std::string& file) {
    const std::lock_guard lock(mutex_);
    const auto found = plugs_.find(file);
    return found == plugs_.end() ? nullptr : found->second;
  }

  const std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Plug>> plugs_;  ///< by the file that plugs it in
  int changes_ = -1;
  WakeUp end_;
  std::thread watcher_;
};

}  // namespace
}  // namespace instep

ONI_EXPORT_DRIVER(instep::Module)
