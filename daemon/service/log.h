#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <vector>

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

/// Of things that last, several at a time: logs each once for as long as it does.
class LastingLines {
 public:
  /// Which of them did not last already. What is not among them is over: it would be news again.
  std::vector<std::string> news(const std::vector<std::string>& lines) {
    std::vector<std::string> news;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(news),
                 [&](const auto& line) { return !holds(line); });
    lines_ = lines;
    return news;
  }
  /// Told by other means.
  void add(const std::string& line) { lines_.push_back(line); }
  bool empty() const { return lines_.empty(); }

 private:
  bool holds(const std::string& line) const {
    return std::find(lines_.begin(), lines_.end(), line) != lines_.end();
  }

  std::vector<std::string> lines_;
};

}  // namespace instep
