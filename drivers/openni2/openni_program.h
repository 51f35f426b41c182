#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "drivers/openni2/child_messages.h"
#include "drivers/openni2/child_process.h"

namespace instep {

/// The program that talks to OpenNI2 for us, and the library that it is to use.
struct OpenniProgram {
  std::filesystem::path file;  ///< instep-openni
  /// Folder of libOpenNI2.so.0 and OpenNI2/Drivers, for the makers who bring their own; empty = the
  /// system's.
  std::filesystem::path library_folder;

  /// It with these arguments, ready to be started. Fails with kNotFound if the folder is given but
  /// has no library in it: the system's would be used instead, and find nothing.
  Result<ChildProgram> with(std::vector<std::string> arguments) const;
};

/// The sensors that OpenNI2 sees, each opened for a moment to read its serial number. Those that
/// are in use, or may not be opened, say so in OpenniDevice::trouble.
///
/// Takes a second or more a sensor, and at most `limit`. Fails with kNotFound where the program or
/// every driver is missing, kTimeout at the limit, kDeviceGone if the library crashed.
Result<std::vector<OpenniDevice>> list_openni_devices(const OpenniProgram& program,
                                                      std::chrono::milliseconds limit);

}  // namespace instep
