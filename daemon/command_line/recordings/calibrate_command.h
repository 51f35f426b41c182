#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep calibrate [RECORDING]: where the cameras stand, by what they see of one object.
void add_calibrate_command(CLI::App& app, int& exit_code);

}  // namespace instep
