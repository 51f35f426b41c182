#include "daemon/command_line/commands.h"
#include "daemon/command_line/recordings/calibrate_command.h"
#include "daemon/command_line/recordings/record_command.h"
#include "daemon/command_line/recordings/replay_command.h"
#include "daemon/command_line/recordings/simulate_command.h"

namespace instep {

void add_recording_commands(CLI::App& app, int& exit_code) {
  add_replay_command(app, exit_code);
  add_simulate_command(app, exit_code);
  add_record_command(app, exit_code);
  add_calibrate_command(app, exit_code);
}

}  // namespace instep
