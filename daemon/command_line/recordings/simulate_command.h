#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep simulate --out DIR: a synthetic recording with its truth.
void add_simulate_command(CLI::App& app, int& exit_code);

}  // namespace instep
