#include "config/devices/v4l2_settings.h"

#include <fmt/format.h>

namespace instep {
namespace {

const char* name_of(V4l2Format format) {
  switch (format) {
    case V4l2Format::kZ16:
      return "Z16";
    case V4l2Format::kY16:
      return "Y16";
    case V4l2Format::kInzi:
      return "INZI";
  }
  return "";
}

}  // namespace

std::string describe(const V4l2Settings& settings) {
  std::string text = settings.placement.name + ", a V4L2 camera";
  if (!settings.serial.empty()) text += ", serial " + settings.serial;
  if (!settings.bus_path.empty()) text += ", at " + settings.bus_path;
  text += fmt::format(", {}, depth in {} mm", name_of(settings.format), settings.depth_unit_mm);
  for (const auto& [control, value] : settings.controls) {
    text += fmt::format(", {} = {}", control, value);
  }
  return text;
}

}  // namespace instep
