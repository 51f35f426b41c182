#pragma once

#include <string>

#include "core/result.h"

namespace instep {

/// What the errno of a call on a video node means for the station. `doing` completes "failed", as
/// "opening /dev/video0".
Error video_error(int number, const std::string& doing);

}  // namespace instep
