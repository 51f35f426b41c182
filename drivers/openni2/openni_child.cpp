#include "drivers/openni2/openni_child.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

namespace instep {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Phase = OpenniChild::Phase;

/// The most that passes before a wait looks whether the child is alive.
constexpr milliseconds kLookEvery{100};
constexpr milliseconds kClosingLimit{300};
constexpr milliseconds kReapingLimit{200};

const char* doing(Phase phase) {
  switch (phase) {
    case Phase::kOpening:
      return "opening";
    case Phase::kStarting:
      return "starting";
    case Phase::kStopping:
      return "stopping";
    case Phase::kOpen:
    case Phase::kStreaming:
      return "watching";
  }
  return "watching";
}

tl::unexpected<Error> cancelled() {
  return fail(ErrorCode::kCancelled, "waiting for the sensor was stopped", "");
}

tl::unexpected<Error> no_descriptors() {
  return fail(ErrorCode::kIo, Remedy::kRetry, "there are no descriptors left for a camera",
              "restart instepd");
}

}  // namespace

Result<std::unique_ptr<OpenniChild>> OpenniChild::launch(const OpenniProgram& program,
                                                         const SensorChoice& choice) {
  std::vector<std::string> arguments = {"--capture", "--serial", choice.serial};
  if (choice.size) {
    arguments.insert(arguments.end(),
                     {"--size", fmt::format("{}x{}", choice.size->width, choice.size->height)});
  }
  auto child = program.with(std::move(arguments));
  if (!child) return tl::make_unexpected(child.error());
  auto ring = FrameRing::create();
  if (!ring) return tl::make_unexpected(ring.error());
  auto arrival = std::make_unique<WakeUp>();
  std::array<int, 2> ends{-1, -1};
  if (!arrival->is_open() ||
      ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0) {
    return no_descriptors();
  }
  Descriptor ours(ends[0]);
  const Descriptor theirs(ends[1]);
  child->descriptors = {ring->descriptor(), theirs.number(), arrival->descriptor()};
  auto process = ChildProcess::start(*child);
  if (!process) return tl::make_unexpected(process.error());
  return std::unique_ptr<OpenniChild>(new OpenniChild(std::move(*ring), std::move(ours),
                                                      std::move(*process), std::move(arrival),
                                                      choice.opening_limit));
}

OpenniChild::~OpenniChild() {
  if (!is_well_) return;
  tell(kQuitCommand);
  process_.wait(kClosingLimit);
}

void OpenniChild::start() {
  drop_frames();
  tell(kStartCommand);
  enter(Phase::kStarting);
}

void OpenniChild::drop_frames() {
  ring_.clear();
  arrival_->clear();
}

void OpenniChild::stop() {
  tell(kStopCommand);
  enter(Phase::kStopping);
}

Result<void> OpenniChild::wait_for(Phase phase, Time deadline, const WakeUp& interrupt) {
  while (phase_ != phase) {
    if (steady_clock::now() >= deadline) {
      return fail(ErrorCode::kTimeout, fmt::format("the sensor is still {}", doing(phase_)),
                  "wait a moment");
    }
    if (auto step = wait_once(deadline, &interrupt); !step) return step;
  }
  return {};
}

Result<RingFrame> OpenniChild::next_frame(Time deadline, const WakeUp& interrupt) {
  while (true) {
    if (interrupt.is_set()) return cancelled();
    arrival_->clear();
    if (auto frame = ring_.take()) return std::move(*frame);
    const bool late = steady_clock::now() >= deadline;
    if (auto step = wait_once(deadline, &interrupt); !step)
      return tl::make_unexpected(step.error());
    if (late) {
      return fail(ErrorCode::kTimeout, "the sensor sent no frame in time", "check its cable");
    }
  }
}

Result<void> OpenniChild::look() {
  return wait_once(steady_clock::now(), nullptr);
}

/// Waits for anything to happen, but not for long, and sees to it.
Result<void> OpenniChild::wait_once(Time deadline, const WakeUp* interrupt) {
  const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
  const auto limit = std::clamp(left, milliseconds(0), kLookEvery);
  std::array<pollfd, 3> waited{{{socket_.number(), POLLIN, 0},
                                {arrival_->descriptor(), POLLIN, 0},
                                {interrupt != nullptr ? interrupt->descriptor() : -1, POLLIN, 0}}};
  ::poll(waited.data(), waited.size(), static_cast<int>(limit.count()));
  if (waited[2].revents != 0) return cancelled();
  auto well = read_messages().and_then([this] { return check_life(); });
  is_well_ = is_well_ && well.has_value();
  return well;
}

Result<void> OpenniChild::read_messages() {
  std::array<char, kLongestChildMessage> text;
  while (true) {
    const ssize_t got = ::recv(socket_.number(), text.data(), text.size(), MSG_DONTWAIT);
    // Told of a command that the child has not read any more; its last words come after that.
    if (got < 0 && errno == ECONNRESET) continue;
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return {};
    if (got <= 0) break;
    auto message = parse_child_message({text.data(), static_cast<std::size_t>(got)});
    if (!message) return tl::make_unexpected(message.error());
    if (auto obeyed = obey(*message); !obeyed) return obeyed;
  }
  return fail(ErrorCode::kIo, Remedy::kReopen,
              "instep-openni, which reads the sensor, " +
                  process_.wait(kReapingLimit).value_or("has closed its connection"),
              "if that happens again, plug the sensor into another port");
}

Result<void> OpenniChild::obey(const ChildMessage& message) {
  if (const auto* error = std::get_if<Error>(&message)) return tl::make_unexpected(*error);
  if (const auto* opened = std::get_if<CameraOpened>(&message)) {
    opened_ = *opened;
    enter(Phase::kOpen);
  }
  const bool has_started = std::holds_alternative<CameraStarted>(message);
  if (has_started && phase_ == Phase::kStarting) enter(Phase::kStreaming);
  if (std::holds_alternative<CameraStopped>(message)) enter(Phase::kOpen);
  return {};
}

/// Opening, starting and stopping are calls of the library that give no sign of life; waiting for a
/// turn to open gives some, and may take as long as the others' openings.
Result<void> OpenniChild::check_life() {
  const auto now = steady_clock::now();
  bool hangs = false;
  switch (phase_) {
    case Phase::kOpening:
      hangs = now > std::max(phase_since_, ring_.last_beat()) + opening_limit_;
      break;
    case Phase::kStarting:
    case Phase::kStopping:
      hangs = now > phase_since_ + kChangeLimit;
      break;
    case Phase::kOpen:
    case Phase::kStreaming:
      hangs = now > ring_.last_beat() + kSilenceLimit;
      break;
  }
  if (!hangs) return {};
  return fail(ErrorCode::kIo, Remedy::kReopen,
              fmt::format("OpenNI2 hung while it was {} the sensor", doing(phase_)),
              "if that happens again, unplug the sensor and plug it in again");
}

void OpenniChild::tell(std::string_view command) {
  // What cannot be told was told to a child that has ended, which the next look shows.
  ::send(socket_.number(), command.data(), command.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

void OpenniChild::enter(Phase phase) {
  phase_ = phase;
  phase_since_ = steady_clock::now();
}

}  // namespace instep
