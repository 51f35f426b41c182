#include "tests/bench/scaling/peak_memory.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace instep::bench {
namespace {

/// A line of /proc/self/status, in bytes; 0 if there is none.
std::size_t status(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(name + ":")) continue;
    std::size_t kilobytes = 0;
    std::istringstream(line.substr(name.size() + 1)) >> kilobytes;
    return 1024 * kilobytes;
  }
  return 0;
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts again from what is in use
  before_ = status("VmRSS");
}

std::size_t PeakMemory::bytes_more() const {
  return std::max(status("VmHWM"), before_) - before_;
}

}  // namespace instep::bench
