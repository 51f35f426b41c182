#pragma once

#include <string>
#include <utility>

namespace instep {

/// One thing that a station needs, whether it is there, and the command that brings it.
struct DoctorCheck {
  std::string name;
  bool good = true;
  std::string finding;
  std::string remedy;   ///< empty if good
  bool unseen = false;  ///< whoever asks may not look: neither good nor known to be wrong

  bool is_wrong() const { return !good && !unseen; }
};

inline DoctorCheck good_check(const char* name, std::string finding) {
  return {name, true, std::move(finding), ""};
}

inline DoctorCheck bad_check(const char* name, std::string finding, std::string remedy) {
  return {name, false, std::move(finding), std::move(remedy)};
}

/// `remedy`: how to look.
inline DoctorCheck unseen_check(const char* name, std::string finding, std::string remedy) {
  return {name, false, std::move(finding), std::move(remedy), true};
}

}  // namespace instep
