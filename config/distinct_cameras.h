#pragma once

#include <vector>

#include "config/reading/settings_table.h"
#include "config/settings.h"

namespace instep {

/// Leaves a fault, at its line and naming the other's, for each [[camera]] that has the name of one
/// before it, or means the same device: a device serves one camera only. `lines` holds where each
/// of the cameras stands.
void check_distinct_cameras(const std::vector<CameraSettings>& cameras,
                            const std::vector<unsigned>& lines, SettingsFaults& faults);

}  // namespace instep
