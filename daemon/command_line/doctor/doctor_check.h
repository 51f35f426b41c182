#pragma once

#include <string>
#include <utility>

namespace instep {

/// One thing that a station needs, whether it is there, and the command that brings it.
struct DoctorCheck {
  std::string name;
  bool good = true;
  std::string finding;
  std::string remedy;  ///< empty if good
};

inline DoctorCheck good_check(const char* name, std::string finding) {
  return {name, true, std::move(finding), ""};
}

inline DoctorCheck bad_check(const char* name, std::string finding, std::string remedy) {
  return {name, false, std::move(finding), std::move(remedy)};
}

}  // namespace instep
