#include <Driver/OniDriverAPI.h>
#include <PS1080.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

#include "sim/openni2_module/frame_store.h"
#include "sim/openni2_module/module_parts.h"
#include "sim/openni2_module/sensor_modes.h"

namespace instep {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::microseconds kPeriod{33333};
constexpr std::chrono::microseconds kSlowPeriod{300000};
constexpr std::chrono::milliseconds kSlowStart{1200};
constexpr int kRegistrationShift_px = 4;
constexpr std::uint16_t kLargestDepth_100um = 65534;
constexpr std::uint16_t kLargestDepth_mm = 10000;

template <typename T>
OniStatus give(const T& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  return ONI_STATUS_OK;
}

template <typename T>
OniStatus take(T& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof(T));
  return ONI_STATUS_OK;
}

class DepthStream final : public oni::driver::StreamBase {
 public:
  DepthStream(std::shared_ptr<const Plug> plug, const std::atomic<bool>& registered)
      : plug_(std::move(plug)),
        registered_(registered),
        device_(plug_->device()),
        store_(device_.frames,
               static_cast<std::size_t>(device_.width) * static_cast<std::size_t>(device_.height)),
        mode_(sensor_modes(device_).front()) {}

  ~DepthStream() override { stop(); }

  OniStatus start() override {
    if (plug_->has("hang-start")) hang();
    if (plug_->has("slow-start")) std::this_thread::sleep_for(kSlowStart);
    if (store_.is_empty() || !plug_->is_in()) return ONI_STATUS_ERROR;
    stopping_ = false;
    thread_ = std::thread([this] { run(); });
    return ONI_STATUS_OK;
  }

  void stop() override {
    if (plug_->has("hang-stop")) hang();
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  OniBool isPropertySupported(int id) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_CROPPING:
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
      case ONI_STREAM_PROPERTY_MAX_VALUE:
      case ONI_STREAM_PROPERTY_MIN_VALUE:
      case ONI_STREAM_PROPERTY_STRIDE:
      case ONI_STREAM_PROPERTY_MIRRORING:
      case static_cast<int>(XN_STREAM_PROPERTY_HOLE_FILTER):
      case static_cast<int>(XN_STREAM_PROPERTY_CLOSE_RANGE):
        return TRUE;
      default:
        return FALSE;
    }
  }

  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(OniCropping{}, data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(device_.hfov_rad, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(device_.vfov_rad, data, size);
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode_, data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(static_cast<int>(largest_depth()), data, size);
      case ONI_STREAM_PROPERTY_MIN_VALUE:
        return give(0, data, size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return give(mode_.resolutionX * static_cast<int>(sizeof(OniDepthPixel)), data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(mirrored_, data, size);
      case static_cast<int>(XN_STREAM_PROPERTY_HOLE_FILTER):
        return give(hole_filter_, data, size);
      case static_cast<int>(XN_STREAM_PROPERTY_CLOSE_RANGE):
        return give(close_range_, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }

  OniStatus setProperty(int id, const void* data, int size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return set_mode(data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return plug_->has("keep-mirror") ? ONI_STATUS_OK : take(mirrored_, data, size);
      case static_cast<int>(XN_STREAM_PROPERTY_HOLE_FILTER):
        return plug_->has("keep-holes") ? ONI_STATUS_OK : take(hole_filter_, data, size);
      case static_cast<int>(XN_STREAM_PROPERTY_CLOSE_RANGE):
        return take(close_range_, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }

 private:
  [[noreturn]] static void hang() {
    while (true) std::this_thread::sleep_for(std::chrono::hours(1));
  }

  bool in_mm() const { return mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_1_MM; }
  std::uint16_t largest_depth() const { return in_mm() ? kLargestDepth_mm : kLargestDepth_100um; }

  OniStatus set_mode(const void* data, int size) {
    if (thread_.joinable()) return ONI_STATUS_OUT_OF_FLOW;
    OniVideoMode wanted{};
    const OniStatus taken = take(wanted, data, size);
    if (taken != ONI_STATUS_OK) return taken;
    const auto modes = sensor_modes(device_);
    const bool offered = std::any_of(modes.begin(), modes.end(), [&](const OniVideoMode& mode) {
      return std::memcmp(&mode, &wanted, sizeof mode) == 0;
    });
    if (!offered) return ONI_STATUS_NOT_SUPPORTED;
    if (!plug_->has("keep-mode")) mode_ = wanted;
    return ONI_STATUS_OK;
  }

  void run() {
    const auto begin = steady_clock::now();
    auto due = begin;
    int sent = 0;
    std::unique_lock lock(mutex_);
    while (!stopping_) {
      due += plug_->has("slow") ? kSlowPeriod : kPeriod;
      if (changed_.wait_until(lock, due, [this] { return stopping_; })) return;
      if (!plug_->is_in() || plug_->has("stall")) continue;
      if (plug_->has("crash")) std::abort();
      lock.unlock();
      send(++sent, std::chrono::duration_cast<std::chrono::microseconds>(due - begin));
      lock.lock();
    }
  }

  void send(int number, std::chrono::microseconds time) {
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    frame->sensorType = ONI_SENSOR_DEPTH;
    frame->frameIndex = number;
    frame->timestamp = static_cast<std::uint64_t>(time.count());
    frame->videoMode = mode_;
    frame->width = plug_->has("wrong-size") ? mode_.resolutionX / 2 : mode_.resolutionX;
    frame->height = mode_.resolutionY;
    frame->stride = frame->width * static_cast<int>(sizeof(OniDepthPixel));
    frame->dataSize = frame->stride * frame->height;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = 0;
    frame->cropOriginY = 0;
    auto* pixels = static_cast<OniDepthPixel*>(frame->data);
    const std::uint16_t* image = store_.image(static_cast<std::uint64_t>(number - 1));
    for (int row = 0; row < frame->height; ++row) {
      fill_row(image, row, pixels + static_cast<std::ptrdiff_t>(row) * frame->width, frame->width);
    }
    if (plug_->has("corrupt")) {
      std::fill(pixels, pixels + frame->width, static_cast<OniDepthPixel>(0xFFFF));
    }
    if (plug_->has("short")) frame->dataSize -= frame->dataSize / 3;
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

  void fill_row(const std::uint16_t* image, int row, OniDepthPixel* out, int width) const {
    const int step = device_.width / mode_.resolutionX;
    const std::uint16_t* source = image + static_cast<std::ptrdiff_t>(row) * step * device_.width;
    const int shift = registered_ ? kRegistrationShift_px : 0;
    const int divisor = in_mm() && device_.unit_um == 100 ? 10 : 1;
    for (int column = 0; column < width; ++column) {
      const int from = (column + shift) % mode_.resolutionX * step;
      const int value = source[from] / divisor;
      out[column] = static_cast<OniDepthPixel>(value > largest_depth() ? 0 : value);
    }
    for (int column = 1; hole_filter_ != 0 && column < width; ++column) {
      if (out[column] == 0) out[column] = out[column - 1];
    }
    if (mirrored_ != 0) std::reverse(out, out + width);
  }

  const std::shared_ptr<const Plug> plug_;
  const std::atomic<bool>& registered_;
  const BusDevice device_;
  const FrameStore store_;
  OniVideoMode mode_;
  OniBool mirrored_ = TRUE;
  std::uint64_t hole_filter_ = 1;
  std::uint64_t close_range_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<oni::driver::StreamBase> make_depth_stream(std::shared_ptr<const Plug> plug,
                                                           const std::atomic<bool>& registered) {
  return std::make_unique<DepthStream>(std::move(plug), registered);
}

}  // namespace instep
