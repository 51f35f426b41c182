#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "drivers/output_line.h"

namespace instep::test {

/// A board of output lines in memory, which can be pulled, plugged in again, and hang. Without
/// power its lines are off; what was opened before it left serves no more. Safe from any thread.
class ModelBoard {
 public:
  ModelBoard();

  Result<std::unique_ptr<OutputLine>> open(const std::string& line);

  bool is_on(const std::string& line) const;
  /// Every change of a level, as "name on" or "name off".
  std::vector<std::string> changes() const;
  /// Waits for so many changes; false if that takes longer than 10 s.
  bool wait_for_changes(std::size_t count) const;

  void unplug();
  void plug_in();
  /// Whatever is asked of it waits until it is let go.
  void hang();
  void let_go();

 private:
  struct State;
  class Line;

  /// Shared, so that a thread that is left behind still finds it.
  std::shared_ptr<State> state_;
};

}  // namespace instep::test
