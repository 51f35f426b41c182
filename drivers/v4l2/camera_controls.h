#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "drivers/v4l2/video_system.h"

namespace instep {

/// A control of the camera by the name that `v4l2-ctl --list-ctrls` shows, such as
/// "exposure_time_absolute" or "laser_power".
struct CameraControl {
  std::string name;
  int value = 0;  ///< in the control's own unit
};

/// Sets them in the order given, since some are locked until another has its value
/// (exposure_time_absolute waits for auto_exposure). Fails with kInvalidInput on a name that the
/// camera does not have or a value outside its range, and if it did not take a value as given.
Result<void> set_controls(VideoSystem& system, int descriptor,
                          const std::vector<CameraControl>& controls);

}  // namespace instep
