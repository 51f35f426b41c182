#include "daemon/command_line/command_output.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "daemon/json/untrusted_json.h"
#include "daemon/report/csv_report.h"

namespace instep {
namespace {

/// As exactly one line.
void print_to_stderr(std::string_view text) {
  std::string line = fmt::format("instep: {}", text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

void print_error(const Error& error) {
  print_to_stderr(error.line());
}

void print_warning(std::string_view text) {
  print_to_stderr(text);
}

Result<void> print_text(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return {};
  if (errno == ENOSPC) {
    return fail(ErrorCode::kNoSpace, "cannot write the result: the disk that it goes to is full",
                "make room there");
  }
  return fail(ErrorCode::kIo,
              fmt::format("cannot write the result ({})", std::generic_category().message(errno)),
              "check where the output goes");
}

Result<void> print_json(const nlohmann::ordered_json& object) {
  return print_text(object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

Result<void> print_table(const nlohmann::json& result) {
  for (const auto& warning : list_at(result, "warnings")) {
    if (warning.is_string()) print_to_stderr(warning.get<std::string>());
  }
  return print_text(result_csv(result));
}

int finish_command(const Result<void>& outcome) {
  if (outcome) return kDone;
  print_error(outcome.error());
  return kNotDone;
}

bool stdout_is_terminal() {
  return ::isatty(STDOUT_FILENO) == 1;
}

bool stderr_is_terminal() {
  return ::isatty(STDERR_FILENO) == 1;
}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(std::string_view stage, double done) {
  if (!stderr_is_terminal()) return;
  fmt::print(stderr, "\r\033[K{:3.0f} % {}", 100.0 * done, stage);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace instep
