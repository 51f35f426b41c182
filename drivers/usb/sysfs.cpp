#include "drivers/usb/sysfs.h"

#include <fstream>

namespace instep {

std::string sysfs_line(const std::filesystem::path& file) {
  char line[4096] = "";
  std::ifstream(file).getline(line, sizeof line);
  return line;
}

}  // namespace instep
