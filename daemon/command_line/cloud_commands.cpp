#include <CLI/CLI.hpp>

#include "daemon/command_line/commands.h"
#include "daemon/command_line/girth_command.h"

namespace instep {

void add_cloud_commands(CLI::App& app, int& exit_code) {
  add_girth_command(app, exit_code);
}

}  // namespace instep
