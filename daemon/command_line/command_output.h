#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/result.h"

namespace instep {

/// The exit codes of `instep`; a promise to scripts.
inline constexpr int kDone = 0;
inline constexpr int kNotDone = 1;
inline constexpr int kWrongUsage = 2;

/// Prints "instep: message: advice" as exactly one line on stderr, whatever the message holds.
void print_error(const Error& error);

/// Prints "instep: text" as exactly one line on stderr, for what does not stop a command.
void print_warning(std::string_view text);

/// Prints text to stdout. Fails if stdout takes it not: a full disk, a closed pipe.
Result<void> print_text(std::string_view text);

/// Prints one JSON object, in the order of its keys, and a line end to stdout. Names that are no
/// UTF-8 are mended.
Result<void> print_json(const nlohmann::ordered_json& object);

/// Prints the measures of a result as CSV. What is said of the foot as a whole, for which a table
/// has no room, goes to stderr.
Result<void> print_table(const nlohmann::json& result);

/// The exit code for the outcome of a command, whose error is printed.
int finish_command(const Result<void>& outcome);

/// For choosing a default of --format, and whether to show progress.
bool stdout_is_terminal();
bool stderr_is_terminal();

/// Shows how far a long command is, on one line of stderr that is written over and cleared at
/// the end; silent where stderr is no terminal.
class ProgressLine {
 public:
  ProgressLine() = default;
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `done` from 0 to 1.
  void show(std::string_view stage, double done);

 private:
  bool shown_ = false;
};

}  // namespace instep
