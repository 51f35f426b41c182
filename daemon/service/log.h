#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
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

/// A thing that lasts. Its line may change meanwhile, its name does not.
struct LastingThing {
  std::string name;
  std::string line;
};

/// Of things that last, several at a time: logs each once for as long as it does.
class LastingThings {
 public:
  /// The lines of those that did not last already. What is not among them is over: it would be news
  /// again.
  std::vector<std::string> news(const std::vector<LastingThing>& things) {
    std::vector<std::string> lines;
    std::vector<std::string> names;
    for (const auto& [name, line] : things) {
      if (!holds(name)) lines.push_back(line);
      names.push_back(name);
    }
    names_ = std::move(names);
    return lines;
  }
  /// Told by other means.
  void add(const std::string& name) { names_.push_back(name); }
  bool empty() const { return names_.empty(); }

 private:
  bool holds(const std::string& name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
  }

  std::vector<std::string> names_;
};

}  // namespace instep
