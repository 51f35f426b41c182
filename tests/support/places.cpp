#include "tests/support/places.h"

namespace instep::test {

std::filesystem::path trial_data() {
  return INSTEP_SHARED_DATA;
}

std::filesystem::path built_programs() {
  return INSTEP_BINARIES;
}

std::filesystem::path source_tree() {
  return INSTEP_SOURCES;
}

}  // namespace instep::test
