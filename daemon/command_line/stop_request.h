#pragma once

#include <csignal>

namespace instep {

/// While one is there, the first SIGINT (Ctrl-C) or SIGTERM ends nothing by itself: the command
/// looks at is_made() and returns, so that its destructors leave all as it should be. The
/// second signal ends the program as ever. One at a time in a process.
class StopRequest {
 public:
  StopRequest();
  /// Signals do again what they did before.
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_made() const;

 private:
  struct sigaction interrupted_before_ {};
  struct sigaction terminated_before_ {};
};

}  // namespace instep
