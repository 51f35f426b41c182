#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/task_thread.h"
#include "drivers/output_line.h"

namespace instep {

/// The trouble of one that hangs.
Error silent_output();

/// Keeps one output as it is wanted to be. A line may hang, so it is touched on a thread of its
/// own; what is wanted meanwhile is done after that, the last wish first and only. The level is
/// written again at every refresh: so a board that left is noticed though nothing changes, and its
/// line taken anew, as it is wanted, once it is back.
///
/// Lives on the loop's thread, where no call waits, and longer than the loop runs. At its end the
/// line is put off, and given up if that takes longer than kLastMoment.
class OutputKeeper {
 public:
  static constexpr std::chrono::milliseconds kLastMoment{200};

  struct Pace {
    std::chrono::milliseconds refresh{2000};
    /// A line that has not done what it was told for so long hangs, which is a trouble.
    std::chrono::milliseconds patience{5000};
  };

  /// Opens the line, on the keeper's thread; asked again as long as it fails.
  using Open = std::function<Result<std::unique_ptr<OutputLine>>()>;

  /// `name`: of its thread. `on_change`: trouble() has another cause.
  OutputKeeper(EventLoop& loop, const std::string& name, Open open, std::function<void()> on_change,
               const Pace& pace);
  ~OutputKeeper();
  OutputKeeper(const OutputKeeper&) = delete;
  OutputKeeper& operator=(const OutputKeeper&) = delete;

  void set(bool on);
  bool wanted() const { return wanted_; }
  /// Begins its end, from which kLastMoment counts: several lines can be put off at once. The
  /// loop has ended, and no call but the destructor may follow.
  void put_off();
  /// Waits for that; false if it hangs and had to be left behind.
  bool finish();
  /// Why it is not as wanted; nothing while all is well, and until the first attempt.
  const std::optional<Error>& trouble() const { return trouble_; }

 private:
  void write();
  void written(bool on, const std::optional<Error>& trouble);
  void note(const std::optional<Error>& trouble);

  EventLoop& loop_;
  Open open_;
  std::function<void()> on_change_;
  Pace pace_;
  EventLoop::Timer refresh_timer_;
  EventLoop::Timer patience_timer_;
  bool wanted_ = false;
  bool writing_ = false;
  std::optional<Error> trouble_;
  std::shared_ptr<std::unique_ptr<OutputLine>> line_;  ///< the thread's, to its end
  TaskThread thread_;
  std::optional<std::chrono::steady_clock::time_point> last_moment_;
};

}  // namespace instep
