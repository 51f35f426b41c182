#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep measure CLOUD: everything an unmarked foot gives.
void add_measure_command(CLI::App& app, int& exit_code);

}  // namespace instep
