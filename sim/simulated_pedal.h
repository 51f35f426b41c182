#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "drivers/files/descriptor.h"
#include "drivers/files/file_identity.h"
#include "drivers/files/poll_set.h"
#include "drivers/files/wake_up.h"
#include "drivers/pedal.h"
#include "sim/fault_script.h"

namespace instep {

/// A pedal pressed by the program itself, or by anyone who writes lines to a FIFO:
///
///     press      the contact closes          release    the contact opens
///     tap        closes for 100 ms           bounce     a tap whose edges chatter
///
///     echo tap > /run/instep/pedal
///
/// Unknown lines are ignored. Edges that a line or a call brings at once (a tap, chatter) lie in
/// the past, as if the program had been busy, and the last of them is now.
///
/// press(), release(), tap(), unplug() and plug_in() are safe from any thread; the calls
/// of Pedal belong to one thread.
class SimulatedPedal final : public Pedal {
 public:
  struct Settings {
    PedalFaults faults;
    /// Made (mode 0660) if absent, and removed at the end if it is the one made here; empty = none.
    std::filesystem::path fifo;
  };

  /// Fails with kIo or kPermissionDenied if the FIFO cannot be made or opened, kInvalidInput if
  /// something else has its name.
  static Result<std::unique_ptr<SimulatedPedal>> open(const Settings& settings);

  /// Removes its FIFO.
  ~SimulatedPedal() override;
  SimulatedPedal(const SimulatedPedal&) = delete;
  SimulatedPedal& operator=(const SimulatedPedal&) = delete;

  int descriptor() const override { return waiting_.descriptor(); }
  Result<std::vector<PedalEdge>> read_edges() override;
  Result<bool> is_pressed() override;
  Result<void> reopen() override;

  void press();
  void release();
  void tap();
  void unplug();
  void plug_in();

 private:
  explicit SimulatedPedal(const Settings& settings);
  Result<void> open_descriptors();
  Result<void> open_fifo();
  void read_fifo();
  void obey(std::string_view line);
  void move_contact(bool pressed, std::chrono::nanoseconds time);
  void chatter(bool pressed, std::chrono::nanoseconds until, const PedalFaults& faults);
  void tap_with(const PedalFaults& faults);
  bool is_back() const;

  Settings settings_;
  WakeUp unread_;  ///< set where edges_ holds some, or the pedal left
  Descriptor fifo_;
  PollSet waiting_;                        ///< for both
  std::optional<FileIdentity> made_fifo_;  ///< nothing if it was there
  std::string unfinished_line_;

  std::mutex mutex_;
  std::vector<PedalEdge> edges_;
  bool pressed_ = false;
  bool gone_ = false;
  std::uint64_t edge_count_ = 0;
  std::chrono::nanoseconds last_edge_{0};
  std::optional<std::chrono::nanoseconds> return_time_;
};

}  // namespace instep
