#pragma once

#include <csignal>

namespace instep {

/// While one is there, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone) ends
/// nothing by itself: the command looks at is_made() and returns, so that its destructors leave all
/// as it should be. The second signal ends the program as ever. A SIGHUP that was ignored before
/// stays so. One at a time in a process.
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
  struct sigaction hung_up_before_ {};
};

}  // namespace instep
