#include "daemon/command_line/clouds/girth_command.h"
#include "daemon/command_line/clouds/measure_command.h"
#include "daemon/command_line/clouds/surface_command.h"
#include "daemon/command_line/commands.h"

namespace instep {

void add_cloud_commands(CLI::App& app, int& exit_code) {
  add_girth_command(app, exit_code);
  add_measure_command(app, exit_code);
  add_surface_command(app, exit_code);
}

}  // namespace instep
