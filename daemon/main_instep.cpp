#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>

#include "daemon/build_facts.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/commands.h"
#include "daemon/standard_streams.h"

namespace {

constexpr const char* kDescription =
    "Measures feet: the girths that a tape gives, from clouds, meshes and depth cameras.";

constexpr const char* kExamples = R"(Examples:
  instep girth foot.ply --plane 160,-5,22,160,-5,62,170,-44,22   one girth of a cloud
  instep measure foot.ply                                       all measures of a foot
  instep simulate --out visit && instep replay visit            the whole chain, no hardware
  instep scan                                                   measure who stands on the station
  instep repeat scans/*                                         how well repeated scans agree
  instep devices                                                what is plugged in
  instep doctor                                                 what is wrong with this machine
  instep girth --help                                           all about one command

scan, cancel, status, watch, list, show, export and delete ask the station's daemon, instepd; the
others need none. Results go to stdout, as JSON for programs; errors go to stderr, one line that
says what to do. Exit codes: 0 done, 1 it could not be done, 2 wrong usage.)";

/// Prints what --help or --version ask for.
int print_asked(const CLI::App& app, const CLI::Success& asked) {
  std::ostringstream text;
  app.exit(asked, text, text);
  return instep::finish_command(instep::print_text(text.str()));
}

/// What a wrong usage is answered with: one line that says where help is.
int explain_wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = "instep";
  for (const auto* chosen : app.get_subcommands()) command += " " + chosen->get_name();
  std::string what = error.what();
  // Of an unknown command the parser says only that it found none.
  const auto unknown = app.remaining();
  if (app.get_subcommands().empty() && !unknown.empty()) {
    what = "there is no command or option " + unknown.front();
  }
  instep::print_error({instep::ErrorCode::kInvalidInput, instep::Remedy::kOperator, what,
                       "see " + command + " --help"});
  return instep::kWrongUsage;
}

}  // namespace

int main(int argc, char** argv) {
  instep::fill_closed_standard_streams();
  int exit_code = instep::kDone;
  CLI::App app(kDescription, "instep");
  try {
    app.footer(kExamples);
    app.set_version_flag("--version", std::string("instep ") + instep::program_version());
    app.require_subcommand(1);
    instep::add_cloud_commands(app, exit_code);
    instep::add_recording_commands(app, exit_code);
    instep::add_station_commands(app, exit_code);
    instep::add_repeat_command(app, exit_code);
    instep::add_devices_command(app, exit_code);
    instep::add_doctor_command(app, exit_code);
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return print_asked(app, success);
  } catch (const CLI::ParseError& error) {
    return explain_wrong_usage(app, error);
  } catch (const std::exception& error) {
    instep::print_error(
        {instep::ErrorCode::kInternal, instep::Remedy::kBug, error.what(), "report this"});
    return instep::kNotDone;
  }
  return exit_code;
}
