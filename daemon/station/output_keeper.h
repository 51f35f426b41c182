#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/task_thread.h"
#include "drivers/output_line.h"

namespace instep {

/// Keeps one output as it is wanted to be. A line may hang, so it is touched on a thread of its
/// own; what is wanted meanwhile is done after that, the last wish first and only. The level is
/// written again every kRefresh: so a board that left is noticed though nothing changes, and its
/// line taken anew, as it is wanted, once it is back.
///
/// Lives on the loop's thread, where no call waits, and longer than the loop runs. At its end the
/// line is put off, and given up if that takes longer than kLastMoment.
class OutputKeeper {
 public:
  static constexpr std::chrono::milliseconds kRefresh{2000};
  static constexpr std::chrono::milliseconds kLastMoment{50};

  /// Opens the line, on the keeper's thread; asked again as long as it fails.
  using Open = std::function<Result<std::unique_ptr<OutputLine>>()>;

  /// `on_change`: trouble() says something new.
  OutputKeeper(EventLoop& loop, Open open, std::function<void()> on_change,
               std::chrono::milliseconds refresh = kRefresh);
  ~OutputKeeper();
  OutputKeeper(const OutputKeeper&) = delete;
  OutputKeeper& operator=(const OutputKeeper&) = delete;

  void set(bool on);
  bool wanted() const { return wanted_; }
  /// Why it is not as wanted; nothing while all is well, and until the first attempt.
  const std::optional<Error>& trouble() const { return trouble_; }

 private:
  void write();
  void written(bool on, const std::optional<Error>& trouble);

  EventLoop& loop_;
  Open open_;
  std::function<void()> on_change_;
  std::chrono::milliseconds refresh_;
  EventLoop::Timer refresh_timer_;
  bool wanted_ = false;
  bool writing_ = false;
  std::optional<Error> trouble_;
  std::shared_ptr<std::unique_ptr<OutputLine>> line_;  ///< the thread's, but for its end
  TaskThread thread_{"output"};
};

}  // namespace instep
