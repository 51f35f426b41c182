#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep record --out DIR: what the cameras see, as a recording.
void add_record_command(CLI::App& app, int& exit_code);

}  // namespace instep
