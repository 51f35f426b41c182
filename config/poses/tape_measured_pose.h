#pragma once

#include <Eigen/Core>
#include <optional>

#include "config/reading/settings_table.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// What a camera looks at is farther away; less is metres in place of millimetres, or one place.
inline constexpr double kNearestSight_mm = 50.0;

/// Where a camera stands as a person tells it with a tape measure: some centimetres and degrees
/// off, which is near enough for `instep calibrate` to start from, and too far off to measure by.
/// Both places are in millimetres in the station frame (z up); they are kNearestSight_mm apart at
/// least.
struct TapeMeasuredPose {
  Eigen::Vector3d stands_at_mm = Eigen::Vector3d::Zero();  ///< the camera's lens
  Eigen::Vector3d looks_at_mm = Eigen::Vector3d::Zero();   ///< anything in the middle of its image
  /// How far the camera is turned clockwise, as it itself looks; -360 to 360. 0 = its image is
  /// upright, 180 = it hangs upside down. Of a camera that looks straight up or down (within 0.1
  /// degrees), which has no upright image, 0 has the station's +x at the top of the image.
  double roll_deg = 0.0;
};

/// The pose of that camera, whose own frame has x right, y down, z forward.
RigidTransform station_from_camera(const TapeMeasuredPose& measured);

/// Whether a [[camera]] table has any key of a pose by tape measure.
bool has_tape_measured_pose(const SettingsTable& table);

/// Reads such a pose:
///
///     stands_at_mm = [ 500, 0, 60 ]
///     looks_at_mm = [ 0, 0, 60 ]
///     roll_deg = 180
///
/// Nothing if there is none, or if it leaves a fault: one place without the other, places nearer
/// than kNearestSight_mm to each other or more than kFarthestCameraMm away, a roll out of its
/// range.
std::optional<RigidTransform> read_tape_measured_pose(SettingsTable& table, SettingsFaults& faults);

}  // namespace instep
