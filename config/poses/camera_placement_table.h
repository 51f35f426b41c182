#pragma once

#include "config/poses/camera_placement.h"
#include "config/reading/settings_table.h"

namespace instep {

/// Reads the placement's keys of a [[camera]] table:
///
///     name = "left"
///     station_from_camera = [ 1, 0, 0, 0,   0, -1, 0, 0,   0, 0, -1, 500,   0, 0, 0, 1 ]
///     [camera.intrinsics]
///     width = 640
///     height = 480
///     fx = 575.8
///     fy = 575.8
///     cx = 319.5
///     cy = 239.5
///     distortion = [ 0, 0, 0, 0, 0 ]
///
/// The name and the pose must be there, the pose as a matrix (pose_matrix.h) or by tape measure
/// (tape_measured_pose.h), not both; the intrinsics, and in them the distortion (k1, k2, p1, p2,
/// k3), may be left out. What cannot be right leaves a fault.
CameraPlacement read_camera_placement(SettingsTable& table, SettingsFaults& faults);

}  // namespace instep
