#pragma once

#include <map>
#include <string>

#include "config/settings.h"

namespace instep {

/// The daemon's log on stderr. Under systemd every line begins with its journal priority; else with
/// its time. No line says anything about a person. Safe from any thread after set_up_log(),
/// which is called once, before there are others.
void set_up_log(LogLevel level);
/// What is said from now on.
void set_log_level(LogLevel level);
/// The stages of a scan: the times of these lines are theirs.
void log_debug(const std::string& line);
void log_info(const std::string& line);
void log_warning(const std::string& line);
void log_error(const std::string& line);

/// Logs each thing once: what is said about a subject again in the same words is passed over.
class ChangeLog {
 public:
  /// True if `line` is news about `subject`; an empty line means that all is well there.
  bool is_news(const std::string& subject, const std::string& line) {
    std::string& last = said_[subject];
    if (last == line) return false;
    last = line;
    return true;
  }

 private:
  std::map<std::string, std::string> said_;
};

}  // namespace instep
