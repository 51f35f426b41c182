#pragma once

#include <string>

#include "core/result.h"
#include "daemon/cloud_files/cloud_file.h"

namespace CLI {
class App;
}

namespace instep {

/// What all commands have that take a cloud out of a file.
struct CloudOptions {
  std::string file;
  std::string unit = "mm";
};

/// Adds CLOUD and --unit to a command.
void add_cloud_options(CLI::App& command, CloudOptions& options);

/// Reads the cloud that the options name.
Result<CloudFile> read_cloud(const CloudOptions& options);

}  // namespace instep
