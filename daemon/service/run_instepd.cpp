#include "daemon/service/run_instepd.h"

#include <fmt/format.h>
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "config/capture_time.h"
#include "config/settings_description.h"
#include "config/settings_file.h"
#include "config/settings_search.h"
#include "config/shared_paths.h"
#include "daemon/build_facts.h"
#include "daemon/command_line/command_output.h"
#include "daemon/loop/caught.h"
#include "daemon/scan/scan_pipeline.h"
#include "daemon/service/log.h"
#include "daemon/service/station_service.h"
#include "daemon/station/devices.h"
#include "drivers/recording/recording_reader.h"

namespace instep {
namespace {

Result<Settings> read_settings(const std::filesystem::path& file) {
  auto settings = load_settings(file);
  if (settings) override_paths(*settings, process_environment);
  return settings;
}

int complain(const Error& error) {
  fmt::print(stderr, "instepd: {}\n", error.line());
  return 1;
}

int print(const std::string& text) {
  const auto printed = print_text(text);
  return printed ? 0 : complain(printed.error());
}

/// The event loop takes signals from a descriptor, so no thread may take them otherwise.
void keep_signals_for_the_loop() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
}

/// The C library gives each new thread a heap of its own and, but for the first heap, never returns
/// the free top of one. A scan's threads come and go, and left some 80 MiB behind that way. With a
/// single heap malloc_trim() returns it all; the threads hardly ever allocate at the same time.
void keep_to_one_heap() {
  ::mallopt(M_ARENA_MAX, 1);
}

/// What the settings alone do not show, each a line.
std::string doubts(const Settings& settings) {
  std::string lines;
  const auto add = [&](const std::string& doubt) {
    if (!doubt.empty()) lines += "but " + doubt + "\n";
  };
  add(warning_of_short_deadline(settings));
  add(warning_of_shared_paths(settings));
  const auto faults = check_fault_script(settings);
  if (!faults) add(faults.error().line());
  for (const auto& camera : settings.cameras) {
    if (camera.kind != CameraKind::kRecording) continue;
    const auto recording = read_recording(camera.path);
    if (!recording) add(recording.error().line());
  }
  return lines;
}

int check(const std::filesystem::path& file, const Settings& settings) {
  return print(
      fmt::format("settings {}\n{}{}", file.string(), describe(settings), doubts(settings)));
}

int serve(const std::filesystem::path& file, const Settings& settings) {
  ::umask(0027);
  keep_to_one_heap();
  keep_signals_for_the_loop();
  set_up_log(settings.log.level);
  log_info(fmt::format("instepd {} with {}", program_version(), file.string()));
  auto service = StationService::create(
      settings, [file] { return read_settings(file); }, measure_capture);
  if (!service) return complain(service.error());
  const auto left_cleanly = caught("the daemon", [&] { return (*service)->run(); });
  const int code = left_cleanly ? 0 : complain(left_cleanly.error());
  // A thread that hangs cannot be waited for, and what it uses must not be torn down under it. The
  // log has no buffer.
  if (!left_cleanly || !*left_cleanly) ::_exit(code);
  return code;
}

}  // namespace

int run_instepd(int argc, char** argv) {
  CLI::App app(
      "The daemon of an Instep scanning station: waits for the pedal, reads the cameras, "
      "measures, stores.",
      "instepd");
  app.set_version_flag("--version", program_version());
  app.footer(std::string(kEnvironmentHelp) +
             "\nSignals: TERM ends it within a second, HUP reads the settings again.");
  std::string asked;
  bool only_check = false;
  app.add_option("--config", asked, "Settings file (TOML)")->type_name("FILE");
  app.add_flag("--check", only_check, "Say what the settings mean, or every error, and end");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    std::ostringstream text;  // of --help or --version
    app.exit(success, text, text);
    return print(text.str());
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "instepd: {}: see instepd --help\n", error.what());
    return 2;
  }
  if (app.count("--config") > 0 && asked.empty()) {
    fmt::print(stderr, "instepd: --config needs the name of a file: see instepd --help\n");
    return 2;
  }
  SettingsPlaces places{std::nullopt, running_program_folder(), source_folder()};
  if (!asked.empty()) places.asked = asked;
  const auto file = find_settings(places, process_environment);
  if (!file) return complain(file.error());
  const auto settings = read_settings(*file);
  if (!settings) return complain(settings.error());
  return only_check ? check(*file, *settings) : serve(*file, *settings);
}

}  // namespace instep
