#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "drivers/files/wake_up.h"
#include "drivers/openni2/child_messages.h"
#include "drivers/openni2/child_process.h"
#include "drivers/openni2/frame_ring.h"
#include "drivers/openni2/mode_choice.h"
#include "drivers/openni2/openni_program.h"

namespace instep {

/// What instep-openni is to read.
struct SensorChoice {
  std::string serial;             ///< empty = the only sensor there is
  std::optional<ImageSize> size;  ///< of the image; see choose_mode()
  /// Opening a sensor, with its firmware and those before it in the search, takes seconds; from its
  /// turn on, see SearchTurn.
  std::chrono::milliseconds opening_limit{10000};
};

/// One instep-openni, seen from the daemon: it lives as long as its sensor is open. Everything that
/// goes wrong with it, the end of the process and its hanging included, is an Error, after which
/// the object is good for nothing but to be deleted. Nothing here tries again.
class OpenniChild {
 public:
  enum class Phase { kOpening, kOpen, kStarting, kStreaming, kStopping };
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::milliseconds kChangeLimit{3000};  ///< for starting and stopping
  /// A child that gave no sign of life for this long hangs.
  static constexpr std::chrono::milliseconds kSilenceLimit{800};

  /// Returns at once, in Phase::kOpening. Fails as ChildProcess::start() or with kIo.
  static Result<std::unique_ptr<OpenniChild>> launch(const OpenniProgram& program,
                                                     const SensorChoice& choice);
  /// Lets it close its sensor, for 0.3 s, if it is well; then kills and reaps it.
  ~OpenniChild();

  Phase phase() const { return phase_; }
  bool is_well() const { return is_well_; }  ///< false once anything went wrong with it
  const CameraOpened& opened() const { return opened_; }  ///< once it has left Phase::kOpening

  void start();        ///< in Phase::kOpen
  void drop_frames();  ///< those that wait, in Phase::kStreaming
  void stop();         ///< in Phase::kStreaming, or kStarting: as soon as it streams

  /// Fails with kTimeout if the phase has not come by `deadline`, kCancelled if `interrupt` is set,
  /// with what happened to the sensor, mostly kDeviceGone, and with kIo and Remedy::kReopen if the
  /// child crashed or hangs: the sensor may be plugged in still, and be in need of a reset.
  Result<void> wait_for(Phase phase, Time deadline, const WakeUp& interrupt);
  /// The same for a frame, in Phase::kStreaming.
  Result<RingFrame> next_frame(Time deadline, const WakeUp& interrupt);
  /// Looks, without waiting, whether all is well.
  Result<void> look();

 private:
  OpenniChild(FrameRing ring, Descriptor socket, ChildProcess process,
              std::unique_ptr<WakeUp> arrival, std::chrono::milliseconds opening_limit)
      : opening_limit_(opening_limit),
        ring_(std::move(ring)),
        arrival_(std::move(arrival)),
        socket_(std::move(socket)),
        process_(std::move(process)),
        phase_since_(std::chrono::steady_clock::now()) {}

  Result<void> wait_once(Time deadline, const WakeUp* interrupt);
  Result<void> read_messages();
  Result<void> obey(const ChildMessage& message);
  Result<void> check_life();
  void tell(std::string_view command);
  void enter(Phase phase);

  std::chrono::milliseconds opening_limit_;
  FrameRing ring_;
  std::unique_ptr<WakeUp> arrival_;
  Descriptor socket_;
  ChildProcess process_;
  Phase phase_ = Phase::kOpening;
  Time phase_since_;
  CameraOpened opened_;
  bool is_well_ = true;
};

}  // namespace instep
