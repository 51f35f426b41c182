#include "daemon/command_line/clouds/cloud_options.h"

#include <CLI/CLI.hpp>

namespace instep {

void add_cloud_options(CLI::App& command, CloudOptions& options) {
  command.add_option("CLOUD", options.file, "PLY, XYZ or CSV text, PCD, OBJ or STL")->required();
  command
      .add_option("--unit", options.unit,
                  "unit of the file's coordinates; auto decides by the body's size and says so")
      ->check(CLI::IsMember({"mm", "cm", "m", "auto"}))
      ->capture_default_str();
}

Result<CloudFile> read_cloud(const CloudOptions& options) {
  const auto unit = length_unit_from_string(options.unit);
  return read_cloud_file(options.file, unit.value_or(LengthUnit::kMillimetre));
}

}  // namespace instep
