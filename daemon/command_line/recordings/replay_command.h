#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep replay RECORDING [--out DIR]: the whole chain on recorded frames.
void add_replay_command(CLI::App& app, int& exit_code);

}  // namespace instep
