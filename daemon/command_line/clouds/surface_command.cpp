#include "daemon/command_line/clouds/surface_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/noticed.h"
#include "core/surface/paper/constrained_surface.h"
#include "daemon/cloud_files/mesh_ply_writer.h"
#include "daemon/cloud_files/text_tokens.h"
#include "daemon/command_line/clouds/cloud_options.h"
#include "daemon/command_line/command_output.h"
#include "daemon/command_line/file_ending.h"
#include "daemon/command_line/own_input.h"

namespace instep {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kExamples =
    R"(Reconstructs the surface through the points by local radial basis functions (r^3, one for each
cell of an octree) and writes it as triangles, by marching cubes that end where the points end.
It goes through every point and closes holes about as wide as the points are apart. It needs
points that lie evenly and without noise: where they do not, the surface is torn. For a girth use
'instep girth', which needs no mesh. Examples:
  instep surface foot.ply --out mesh.ply
  instep surface foot.ply --out fine.ply --cube-mm 0.5
Prints what it made as JSON. The file appears whole or not at all.)";

struct SurfaceCommand {
  CloudOptions cloud;
  std::string out;
  std::optional<double> cube_mm;
};

std::string check_cube(const std::string& text) {
  const auto cube = number_in(text);
  return cube && *cube >= 0.001 && *cube <= 1000.0 ? "" : "needs a number from 0.001 to 1000";
}

/// Cubes that are no longer small against the body cut corners and lose what is thin.
std::optional<std::string> doubt_of_cubes(const SurfaceCommand& command, const PointCloud& cloud) {
  constexpr double kLargestShare = 0.1;
  Eigen::AlignedBox3d box;
  for (const auto& position : cloud.positions) box.extend(position);
  const double smallest_mm = box.sizes().minCoeff();
  if (!command.cube_mm || *command.cube_mm <= kLargestShare * smallest_mm) return std::nullopt;
  return fmt::format(
      "the cubes of {:g} mm are too large for a body of {:.0f} mm in its smallest extent, whose "
      "shape they lose: give a --cube-mm of at most a tenth of that",
      *command.cube_mm, smallest_mm);
}

Result<void> run(const SurfaceCommand& command) {
  const auto start = Clock::now();
  if (auto spared = spare_input(command.out, "--out", command.cloud.file, "the cloud"); !spared) {
    return spared;
  }
  const auto file = read_cloud(command.cloud);
  if (!file) return tl::make_unexpected(file.error());
  ConstrainedSurfaceOptions options;
  options.cube_mm = command.cube_mm;
  ProgressLine line;
  const auto mesh = constrained_surface(file->cloud.positions, options, [&](double done) {
    line.show("reconstructing the surface", done);
  });
  if (!mesh) return tl::make_unexpected(with_what_was_noticed(mesh.error(), file->notes));
  if (auto written = write_mesh_ply(*mesh, command.out); !written) return written;
  auto warnings = file->notes;
  if (const auto doubt = doubt_of_cubes(command, file->cloud)) warnings.push_back(*doubt);
  const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
  return print_json({{"file", command.out},
                     {"points", file->cloud.size()},
                     {"corners", mesh->positions.size()},
                     {"triangles", mesh->triangles.size()},
                     {"warnings", warnings},
                     {"elapsed_ms", elapsed.count()}});
}

}  // namespace

void add_surface_command(CLI::App& app, int& exit_code) {
  auto* surface = app.add_subcommand("surface", "Write the surface through a cloud as a mesh");
  surface->footer(kExamples);
  const auto command = std::make_shared<SurfaceCommand>();
  add_cloud_options(*surface, command->cloud);
  surface->add_option("--out", command->out, "PLY file to write; an old one is replaced")
      ->required()
      ->check(FileEnding({".ply"}));
  surface
      ->add_option("--cube-mm", command->cube_mm,
                   "edge of the cubes, which is about that of the triangles; else a hundredth of "
                   "the cloud's length")
      ->check(check_cube);
  surface->callback([command, &exit_code] { exit_code = finish_command(run(*command)); });
}

}  // namespace instep
