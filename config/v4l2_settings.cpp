#include "config/v4l2_settings.h"

#include <fmt/format.h>

namespace instep {

std::string describe(const V4l2Settings& settings) {
  std::string text = settings.placement.name + ", a V4L2 camera";
  if (!settings.serial.empty()) text += ", serial " + settings.serial;
  if (!settings.bus_path.empty()) text += ", at " + settings.bus_path;
  return text + fmt::format(", depth in {} mm", settings.depth_unit_mm);
}

}  // namespace instep
