#pragma once

#include <optional>
#include <string>

#include "config/reading/settings_table.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// Reads where a camera stands, the 16 numbers of a 4x4 matrix, row by row, in millimetres:
///
///     station_from_camera = [ 1, 0, 0, 0,   0, -1, 0, 0,   0, 0, -1, 500,   0, 0, 0, 1 ]
///
/// The rounding of decimals is taken out of the rotation; one that is written to the last digit
/// stays as it is, bit by bit. Nothing if the key is not there, or if it leaves a fault: no list of
/// 16 finite numbers, or fault_of_pose().
std::optional<RigidTransform> read_pose_matrix(SettingsTable& table, SettingsFaults& faults,
                                               const std::string& key = "station_from_camera");

}  // namespace instep
