#include "sim/simulated_pedal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace instep {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr nanoseconds kTapTime = 100ms;
constexpr std::size_t kLongestLine = 64;
/// Of one call: lines that come without end must not keep their reader for ever.
constexpr int kMostReads = 8;
/// Before more lines are read.
constexpr std::size_t kMostEdges = 256;

nanoseconds now() {
  return std::chrono::duration_cast<nanoseconds>(
      std::chrono::steady_clock::now().time_since_epoch());
}

/// What `bounce` does where the script asks for nothing worse.
PedalFaults usual_chatter() {
  PedalFaults faults;
  faults.bounce_edges = 6;
  faults.bounce_time = 8ms;
  return faults;
}

tl::unexpected<Error> system_failure(const std::string& what, const std::string& advice) {
  const int reason = errno;
  const ErrorCode code = reason == EACCES ? ErrorCode::kPermissionDenied : ErrorCode::kIo;
  return fail(code, fmt::format("{}: {}", what, std::strerror(reason)), advice);
}

}  // namespace

SimulatedPedal::SimulatedPedal(const Settings& settings)
    : settings_(settings), pressed_(settings.faults.stuck) {}

Result<std::unique_ptr<SimulatedPedal>> SimulatedPedal::open(const Settings& settings) {
  std::unique_ptr<SimulatedPedal> pedal(new SimulatedPedal(settings));
  if (auto opened = pedal->open_descriptors(); !opened) {
    return tl::make_unexpected(opened.error());
  }
  return pedal;
}

SimulatedPedal::~SimulatedPedal() {
  remove_if_same(settings_.fifo, made_fifo_);
}

Result<void> SimulatedPedal::open_descriptors() {
  if (!waiting_.is_open() || !unread_.is_open()) {
    return system_failure("the simulated pedal cannot be made", "raise the limit of open files");
  }
  if (!settings_.fifo.empty()) {
    if (auto opened = open_fifo(); !opened) return opened;
  }
  const bool is_watched =
      waiting_.add(unread_.descriptor()) && (!fifo_.is_open() || waiting_.add(fifo_.number()));
  if (is_watched) return {};
  return system_failure("the simulated pedal cannot be watched", "look at the system's log");
}

Result<void> SimulatedPedal::open_fifo() {
  const std::string name = settings_.fifo.string();
  const std::string advice = "choose another file for the pedal, or another folder";
  constexpr mode_t kMode = 0660;
  const bool made = mkfifo(name.c_str(), kMode) == 0;
  if (!made && errno != EEXIST) return system_failure("cannot make the FIFO " + name, advice);
  // Open for writing as well: the FIFO then never reports its last writer's leaving.
  fifo_ = Descriptor(::open(name.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!fifo_.is_open()) return system_failure("cannot open the FIFO " + name, advice);
  struct stat status {};
  if (fstat(fifo_.number(), &status) != 0 || !S_ISFIFO(status.st_mode)) {
    return fail(ErrorCode::kInvalidInput, name + " is there, but is no FIFO",
                "delete it, and it is made anew as one; or " + advice);
  }
  if (!made) return {};
  made_fifo_ = FileIdentity::of(fifo_.number());
  // What the umask took away of the group's right to press is given back.
  if (fchmod(fifo_.number(), kMode) != 0) {
    return system_failure("cannot give the group its right to " + name, advice);
  }
  return {};
}

Result<std::vector<PedalEdge>> SimulatedPedal::read_edges() {
  const std::lock_guard lock(mutex_);
  read_fifo();
  if (gone_) return fail(ErrorCode::kDeviceGone, "the pedal left", "plug it in again");
  unread_.clear();
  return std::exchange(edges_, {});
}

Result<bool> SimulatedPedal::is_pressed() {
  const std::lock_guard lock(mutex_);
  read_fifo();
  if (gone_) return fail(ErrorCode::kDeviceGone, "the pedal left", "plug it in again");
  return pressed_;
}

Result<void> SimulatedPedal::reopen() {
  const std::lock_guard lock(mutex_);
  if (!gone_) return {};
  if (!is_back()) return fail(ErrorCode::kNotFound, "the pedal is not there", "plug it in again");
  gone_ = false;
  pressed_ = settings_.faults.stuck;
  edges_.clear();
  unread_.clear();
  return {};
}

void SimulatedPedal::press() {
  const std::lock_guard lock(mutex_);
  chatter(true, now(), settings_.faults);
}

void SimulatedPedal::release() {
  const std::lock_guard lock(mutex_);
  chatter(false, now(), settings_.faults);
}

void SimulatedPedal::tap() {
  const std::lock_guard lock(mutex_);
  tap_with(settings_.faults);
}

void SimulatedPedal::unplug() {
  const std::lock_guard lock(mutex_);
  gone_ = true;
  return_time_.reset();
  unread_.set();
}

void SimulatedPedal::plug_in() {
  const std::lock_guard lock(mutex_);
  return_time_ = now();
}

void SimulatedPedal::read_fifo() {
  if (!fifo_.is_open()) return;
  std::array<char, 512> bytes;
  for (int reads = 0; reads < kMostReads && edges_.size() < kMostEdges; ++reads) {
    const ssize_t count = read(fifo_.number(), bytes.data(), bytes.size());
    if (count <= 0) return;
    for (const char byte : std::string_view(bytes.data(), static_cast<std::size_t>(count))) {
      if (byte != '\n') {
        if (unfinished_line_.size() < kLongestLine) unfinished_line_ += byte;
        continue;
      }
      obey(unfinished_line_);
      unfinished_line_.clear();
    }
  }
}

void SimulatedPedal::obey(std::string_view line) {
  if (line == "press") chatter(true, now(), settings_.faults);
  if (line == "release") chatter(false, now(), settings_.faults);
  if (line == "tap") tap_with(settings_.faults);
  if (line == "bounce") {
    tap_with(settings_.faults.bounce_edges > 0 ? settings_.faults : usual_chatter());
  }
}

void SimulatedPedal::tap_with(const PedalFaults& faults) {
  chatter(true, now() - kTapTime, faults);
  chatter(false, now(), faults);
}

/// The contact comes to rest at `until`, after as many further edges as the script asks for.
void SimulatedPedal::chatter(bool pressed, nanoseconds until, const PedalFaults& faults) {
  if (pressed_ == pressed || faults.stuck) return;
  const auto extra = static_cast<std::int64_t>(faults.bounce_edges / 2 * 2);
  for (std::int64_t i = 0; i < extra; ++i) {
    const nanoseconds before = nanoseconds(faults.bounce_time) * (extra - i) / extra;
    move_contact(i % 2 == 0 ? pressed : !pressed, until - before);
  }
  move_contact(pressed, until);
}

void SimulatedPedal::move_contact(bool pressed, nanoseconds time) {
  if (gone_) return;
  pressed_ = pressed;
  last_edge_ = std::max(time, last_edge_ + 1us);
  edges_.push_back({pressed, last_edge_});
  ++edge_count_;
  const auto& absence = settings_.faults.absence;
  if (absence && edge_count_ == absence->after) {
    gone_ = true;
    if (absence->duration) return_time_ = now() + nanoseconds(*absence->duration);
  }
  unread_.set();
}

bool SimulatedPedal::is_back() const {
  return return_time_ && now() >= *return_time_;
}

}  // namespace instep
