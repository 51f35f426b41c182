#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep girth CLOUD --plane ...: the girth of one tape plane.
void add_girth_command(CLI::App& app, int& exit_code);

}  // namespace instep
