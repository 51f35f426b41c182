#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "drivers/pedal.h"

namespace instep {

enum class PedalSignal {
  kPressed,  ///< a foot went down: one per press, however the contact bounced
  kHeld,     ///< and stayed down for the hold time
  kReleased,
  kStuck,       ///< down at start-up, or for kStuckAfter: not a foot, or no contact that works
  kChattering,  ///< no level has lasted the debounce time for kChatteringAfter: a loose contact
};

/// Makes presses of edges, on the edges' own time stamps. The contact counts as changed once it has
/// kept its new level for the debounce time. No clock, no input or output; times must come from one
/// clock, and one that runs backwards is taken to stand still.
///
/// A contact that chattered has lost its credit: closed when it comes to rest, it is stuck; open,
/// it is released. Neither is a press.
class PedalDebouncer {
 public:
  using Time = std::chrono::nanoseconds;
  static constexpr std::chrono::seconds kStuckAfter{30};
  static constexpr std::chrono::seconds kChatteringAfter{3};

  /// A contact that is closed from the start does not trigger: take_signals() then gives kStuck.
  PedalDebouncer(Time debounce, Time hold, bool pressed_at_start, Time now);

  /// Other times, from now on.
  void set_times(Time debounce, Time hold);

  /// An edge, in the order they came. Two in a row of the same direction mean that one was lost.
  void on_edge(const PedalEdge& edge);

  /// The contact as it is now. Call at next_deadline(): it settles what lost edges leave open.
  void on_level(bool pressed, Time now);

  /// When on_level() should be called next; nothing while the contact rests open. After any edge
  /// the level is wanted once, even where it seems known: a burst may have lost its last edges.
  std::optional<Time> next_deadline() const;

  /// What has been recognised since the last call, in order.
  std::vector<PedalSignal> take_signals();

 private:
  void advance(Time now);
  void come_to_rest();
  void change(bool pressed, Time since);

  Time debounce_;
  Time hold_;
  Time now_;
  bool raw_ = false;                    ///< the contact as last seen
  Time raw_since_{0};                   ///< its last edge
  std::optional<Time> restless_since_;  ///< its first edge since it last kept a level
  bool chattering_ = false;             ///< kChattering has been given for this unrest
  bool pressed_ = false;                ///< the contact as believed
  Time pressed_since_{0};
  bool held_ = false;   ///< kHeld has been given for this press
  bool stuck_ = false;  ///< kStuck has been given for this press
  std::vector<PedalSignal> signals_;
};

}  // namespace instep
