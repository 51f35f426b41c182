#pragma once

#include <string>
#include <vector>

namespace instep {

/// One thing that a station needs, whether it is there, and the command that brings it.
struct DoctorCheck {
  std::string name;
  bool good = true;
  std::string finding;
  std::string remedy;  ///< empty if good
};

/// Looks at this machine: settings, results' folder, daemon, cameras, pedal, libraries. Changes
/// nothing. Takes up to some seconds: if no daemon runs, the cameras are opened.
std::vector<DoctorCheck> examine_machine();

}  // namespace instep
