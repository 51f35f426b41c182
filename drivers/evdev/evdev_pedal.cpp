#include "drivers/evdev/evdev_pedal.h"

#include <libevdev/libevdev.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "drivers/evdev/input_device.h"
#include "drivers/files/poll_set.h"
#include "drivers/files/wake_up.h"

namespace instep {
namespace {

/// Most events of one call, more than the kernel keeps: a device that never rests must not keep its
/// reader for ever.
constexpr std::size_t kMostEvents = 4096;

PedalEdge edge_of(const input_event& event) {
  return {event.value != 0, std::chrono::seconds(event.input_event_sec) +
                                std::chrono::microseconds(event.input_event_usec)};
}

}  // namespace

struct EvdevPedal::Connection {
  std::unique_ptr<InputDevice> device;
  /// A device that is gone only hangs up; this becomes readable then.
  PollSet waiting;
  /// Set where a call left events: those that libevdev holds do not make the device readable.
  WakeUp unread;
  const int unopened = waiting.is_open() && unread.is_open() ? 0 : errno;
  bool catching_up = false;  ///< the kernel dropped events, and the state is being asked for

  explicit Connection(std::unique_ptr<InputDevice> opened) : device(std::move(opened)) {}

  /// The errno value of what fails; 0 if all goes well.
  int watch() const {
    if (unopened != 0) return unopened;
    const int failed = libevdev_set_clock_id(device->get(), CLOCK_MONOTONIC);
    if (failed < 0) return -failed;
    return waiting.add(device->descriptor()) && waiting.add(unread.descriptor()) ? 0 : errno;
  }
};

EvdevPedal::EvdevPedal(const Settings& settings, unsigned key) : settings_(settings), key_(key) {}

EvdevPedal::~EvdevPedal() = default;

Result<std::unique_ptr<EvdevPedal>> EvdevPedal::open(const Settings& settings) {
  const int key = libevdev_event_code_from_name(EV_KEY, settings.key.c_str());
  if (key < 0) {
    return fail(ErrorCode::kInvalidInput, "there is no key \"" + settings.key + "\"",
                "write it as evtest shows it when the pedal is pressed, such as KEY_B");
  }
  std::unique_ptr<EvdevPedal> pedal(new EvdevPedal(settings, static_cast<unsigned>(key)));
  if (const auto connected = pedal->connect(); !connected) {
    return tl::make_unexpected(connected.error());
  }
  return pedal;
}

int EvdevPedal::descriptor() const {
  return connection_ ? connection_->waiting.descriptor() : -1;
}

Result<void> EvdevPedal::connect() {
  auto device = InputDevice::find(settings_.devices, settings_.device, key_);
  if (!device) return tl::make_unexpected(device.error());
  auto connection = std::make_unique<Connection>(std::move(*device));
  libevdev* const events = connection->device->get();
  if (const int failed = libevdev_grab(events, LIBEVDEV_GRAB); failed < 0) {
    if (failed == -ENODEV) return gone();
    return fail(ErrorCode::kBusy, Remedy::kOperator,
                "the pedal " + settings_.device + " is held by another program",
                "end what else reads the pedal: sudo fuser -v /dev/input/event*");
  }
  if (const int failed = connection->watch(); failed != 0) {
    if (failed == ENODEV) return gone();
    return fail(ErrorCode::kIo, std::string("the pedal cannot be watched: ") + strerror(failed),
                "raise the limit of open files");
  }
  connection_ = std::move(connection);
  gone_ = false;
  return {};
}

tl::unexpected<Error> EvdevPedal::gone() {
  gone_ = true;
  return fail(ErrorCode::kDeviceGone, "the pedal " + settings_.device + " left",
              "plug it in again");
}

Result<std::vector<PedalEdge>> EvdevPedal::read_edges() {
  if (gone_) return gone();
  std::vector<PedalEdge> edges;
  bool& catching_up = connection_->catching_up;
  connection_->unread.clear();
  for (std::size_t taken = 0;; ++taken) {
    if (taken == kMostEvents) {
      connection_->unread.set();
      break;
    }
    input_event event{};
    const int status = libevdev_next_event(
        connection_->device->get(),
        catching_up ? LIBEVDEV_READ_FLAG_SYNC : LIBEVDEV_READ_FLAG_NORMAL, &event);
    if (status == -EAGAIN && !std::exchange(catching_up, false)) break;
    if (status == -EAGAIN || status == -EINTR) continue;
    if (status < 0) return gone();
    if (status == LIBEVDEV_READ_STATUS_SYNC) catching_up = true;
    constexpr int kRepeated = 2;
    if (event.type == EV_KEY && event.code == key_ && event.value != kRepeated) {
      edges.push_back(edge_of(event));
    }
  }
  return edges;
}

Result<bool> EvdevPedal::is_pressed() {
  if (gone_) return gone();
  return libevdev_get_event_value(connection_->device->get(), EV_KEY, key_) != 0;
}

Result<void> EvdevPedal::reopen() {
  if (connection_ && !gone_) return {};
  gone_ = true;
  connection_.reset();
  return connect();
}

}  // namespace instep
