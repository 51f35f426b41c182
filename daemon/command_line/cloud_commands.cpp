#include "daemon/command_line/commands.h"
#include "daemon/command_line/girth_command.h"
#include "daemon/command_line/measure_command.h"
#include "daemon/command_line/surface_command.h"

namespace instep {

void add_cloud_commands(CLI::App& app, int& exit_code) {
  add_girth_command(app, exit_code);
  add_measure_command(app, exit_code);
  add_surface_command(app, exit_code);
}

}  // namespace instep
