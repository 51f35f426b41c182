#include "daemon/command_line/stop_request.h"

#include <atomic>

namespace instep {
namespace {

std::atomic<bool> made = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler must not wait");

}  // namespace

StopRequest::StopRequest() {
  made = false;
  struct sigaction action {};
  action.sa_handler = [](int) { made = true; };
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(SIGINT, &action, &interrupted_before_);
  sigaction(SIGTERM, &action, &terminated_before_);
  sigaction(SIGHUP, &action, &hung_up_before_);
  // Who started it by nohup wants it to go on.
  if (hung_up_before_.sa_handler == SIG_IGN) sigaction(SIGHUP, &hung_up_before_, nullptr);
}

StopRequest::~StopRequest() {
  sigaction(SIGINT, &interrupted_before_, nullptr);
  sigaction(SIGTERM, &terminated_before_, nullptr);
  sigaction(SIGHUP, &hung_up_before_, nullptr);
}

bool StopRequest::is_made() const {
  return made;
}

}  // namespace instep
