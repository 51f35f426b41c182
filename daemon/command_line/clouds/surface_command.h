#pragma once

namespace CLI {
class App;
}

namespace instep {

/// instep surface CLOUD --out MESH: the surface through a cloud, as triangles.
void add_surface_command(CLI::App& app, int& exit_code);

}  // namespace instep
