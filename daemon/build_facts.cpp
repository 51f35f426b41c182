#include "daemon/build_facts.h"

namespace instep {

const char* program_version() {
  return INSTEP_VERSION;
}

std::filesystem::path source_folder() {
  return INSTEP_SOURCE_DIR;
}

}  // namespace instep
