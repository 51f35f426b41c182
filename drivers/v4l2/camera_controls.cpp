#include "drivers/v4l2/camera_controls.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "drivers/v4l2/video_call.h"
#include "drivers/v4l2/video_error.h"

namespace instep {
namespace {

constexpr std::size_t kMostControls = 256;

/// "Exposure Time, Absolute" is exposure_time_absolute.
std::string short_name(const v4l2_queryctrl& control) {
  const auto* text = reinterpret_cast<const char*>(control.name);
  std::string name;
  for (std::size_t i = 0; i < sizeof control.name && text[i] != '\0'; ++i) {
    if (std::isalnum(static_cast<unsigned char>(text[i])) != 0) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

Result<std::vector<v4l2_queryctrl>> list_controls(VideoSystem& system, int descriptor) {
  std::vector<v4l2_queryctrl> list;
  v4l2_queryctrl control{};
  while (list.size() < kMostControls) {
    control.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    if (video_call(system, descriptor, VIDIOC_QUERYCTRL, &control) == 0) {
      if ((control.flags & V4L2_CTRL_FLAG_DISABLED) == 0) list.push_back(control);
    } else if (errno == EINVAL || errno == ENOTTY) {
      break;  // the end of the list, or no controls at all
    } else {
      return tl::make_unexpected(video_error(errno, "listing its controls"));
    }
  }
  return list;
}

Result<void> set_control(VideoSystem& system, int descriptor, const v4l2_queryctrl& known,
                         const CameraControl& wanted) {
  if (wanted.value < known.minimum || wanted.value > known.maximum) {
    return fail(ErrorCode::kInvalidInput,
                fmt::format("{} = {} is outside {} to {}", wanted.name, wanted.value, known.minimum,
                            known.maximum),
                "correct it among the camera's controls in the settings");
  }
  v4l2_control control{known.id, wanted.value};
  if (video_call(system, descriptor, VIDIOC_S_CTRL, &control) != 0) {
    return tl::make_unexpected(video_error(errno, "setting " + wanted.name));
  }
  control.value = wanted.value;
  if ((known.flags & V4L2_CTRL_FLAG_WRITE_ONLY) == 0 &&
      video_call(system, descriptor, VIDIOC_G_CTRL, &control) != 0) {
    return tl::make_unexpected(video_error(errno, "reading " + wanted.name));
  }
  if (control.value == wanted.value) return {};
  return fail(
      ErrorCode::kInvalidInput,
      fmt::format("{} took {} instead of {}", wanted.name, control.value, wanted.value),
      fmt::format("give it a value in steps of {}, and the controls that lock it before it in the "
                  "settings",
                  known.step));
}

}  // namespace

Result<void> set_controls(VideoSystem& system, int descriptor,
                          const std::vector<CameraControl>& controls) {
  if (controls.empty()) return {};
  const auto known = list_controls(system, descriptor);
  if (!known) return tl::make_unexpected(known.error());
  for (const auto& wanted : controls) {
    const auto found = std::find_if(known->begin(), known->end(), [&](const auto& control) {
      return short_name(control) == wanted.name;
    });
    if (found == known->end()) {
      std::vector<std::string> names;
      for (const auto& control : *known) names.push_back(short_name(control));
      return fail(ErrorCode::kInvalidInput,
                  fmt::format("it has no control {}, only: {}", wanted.name,
                              names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))),
                  "correct its controls in the settings");
    }
    if (auto set = set_control(system, descriptor, *found, wanted); !set) return set;
  }
  return {};
}

}  // namespace instep
