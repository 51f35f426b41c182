#include "drivers/openni2/child/capture_service.h"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <thread>

#include "drivers/openni2/child/depth_sensor.h"
#include "drivers/openni2/child/sensor_search.h"

namespace instep {
namespace {

using std::chrono::milliseconds;

/// Between two signs of life, with a stream and without; see OpenniChild::kSilenceLimit.
constexpr milliseconds kBeat{50};
constexpr milliseconds kIdleBeat{200};
/// For this one to be opened; it shows all the while that it lives.
constexpr std::chrono::minutes kLongestTurn{1};

constexpr int kDone = 0;
constexpr int kFailed = 1;

class CaptureService {
 public:
  CaptureService(FrameRing& ring, const WakeUp& arrival, const Descriptor& connection)
      : ring_(ring), arrival_(arrival), connection_(connection) {}

  Result<void> run(const SensorChoice& choice) {
    auto sensor = open(choice);
    if (!sensor) return tl::make_unexpected(sensor.error());
    while (!quit_) {
      ring_.beat();
      auto step = streaming_ ? read_frame(**sensor) : (*sensor)->look();
      if (step) step = obey(**sensor);
      if (!step) {
        leave_open(*sensor);
        return step;
      }
    }
    return {};
  }

  void say(const ChildMessage& message) {
    ring_.beat();
    const std::string text = to_text(message);
    ::send(connection_.number(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }

 private:
  Result<std::unique_ptr<DepthSensor>> open(const SensorChoice& choice) {
    auto turn = SearchTurn::wait(kLongestTurn, [this] { ring_.beat(); });
    if (!turn) return tl::make_unexpected(turn.error());
    auto sensor = find_sensor(choice.serial);
    if (!sensor) return sensor;
    auto opened = (*sensor)->set_up(choice.size);
    if (!opened) {
      leave_open(*sensor);
      return tl::make_unexpected(opened.error());
    }
    say(*opened);
    return sensor;
  }

  /// To close a sensor that has gone or is ill may crash or hang; the end of the process does it.
  static void leave_open(std::unique_ptr<DepthSensor>& sensor) {
    static_cast<void>(sensor.release());
  }

  Result<void> read_frame(DepthSensor& sensor) {
    return sensor.wait_for_frame(kBeat, ring_).map([this](bool came) {
      if (came) arrival_.set();
    });
  }

  /// Does what it is told; while nothing streams, it waits for that.
  Result<void> obey(DepthSensor& sensor) {
    pollfd waited{connection_.number(), POLLIN, 0};
    ::poll(&waited, 1, streaming_ ? 0 : static_cast<int>(kIdleBeat.count()));
    if (waited.revents == 0) return {};
    std::array<char, 64> text;
    const ssize_t got = ::recv(connection_.number(), text.data(), text.size(), MSG_DONTWAIT);
    if (got < 0 && errno == EAGAIN) return {};
    const std::string_view command(text.data(),
                                   static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (command == kStartCommand && !streaming_) return start(sensor);
    if (command == kStopCommand && streaming_) stop(sensor);
    if (command == kQuitCommand || got <= 0) quit_ = true;
    return {};
  }

  Result<void> start(DepthSensor& sensor) {
    if (auto started = sensor.start(); !started) return started;
    streaming_ = true;
    say(CameraStarted{});
    return {};
  }

  void stop(DepthSensor& sensor) {
    sensor.stop();
    streaming_ = false;
    say(CameraStopped{});
  }

  FrameRing& ring_;
  const WakeUp& arrival_;
  const Descriptor& connection_;
  bool streaming_ = false;
  bool quit_ = false;
};

/// Ends this process soon after the one at the other end, whatever the library does.
void follow_to_the_end(int connection) {
  constexpr milliseconds kClosing{1000};
  pollfd waited{connection, 0, 0};
  while ((waited.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0) ::poll(&waited, 1, -1);
  std::this_thread::sleep_for(kClosing);
  ::_exit(kFailed);
}

}  // namespace

int serve_captures(const SensorChoice& choice, FrameRing& ring, const WakeUp& arrival,
                   const Descriptor& connection) {
  // Those who end the daemon mean all its processes; this one ends after it, and closes its sensor.
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_IGN);
  // OpenNI2 keeps one frame of a sensor and drops it for the next one, 33 ms later: being late
  // costs frames. Where this is not allowed, it goes without.
  constexpr int kAheadOfOthers = -10;
  ::setpriority(PRIO_PROCESS, 0, kAheadOfOthers);
  std::thread(follow_to_the_end, connection.number()).detach();
  CaptureService service(ring, arrival, connection);
  auto done = load_openni().and_then([&] { return service.run(choice); });
  if (done) return kDone;
  service.say(done.error());
  return kFailed;
}

}  // namespace instep
