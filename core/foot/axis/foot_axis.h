#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/foot/axis/outline_axis.h"
#include "core/foot/measuring_rules.h"
#include "core/foot/side.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// The axis of a foot in floor projection, and its ends along it.
struct FootAxis {
  RigidTransform foot_from_standing = RigidTransform::Identity();
  Eigen::Vector3d pternion = Eigen::Vector3d::Zero();    ///< foot frame, as all here
  Eigen::Vector3d acropodion = Eigen::Vector3d::Zero();  ///< tip of the longest toe
  std::optional<Eigen::Vector3d> toe2_tip;               ///< nothing where the front has no border
  bool is_second_toe_resolved = false;
  bool is_heel_seen = true;  ///< otherwise the pternion lies midway between the heel's borders
  AxisRule rule = AxisRule::kSecondToe;
};

/// Turns the outline's axis until it runs as the rule has it, such as from the rearmost point of
/// the heel (or where that was not seen, midway between its borders) to the second toe; both depend
/// on the axis, so this is repeated until it stands still. Where the points do not show what a rule
/// needs, the axis is that of the second toe, and where they show no toes that of the outline;
/// `rule` says so.
FootAxis find_foot_axis(const std::vector<Eigen::Vector3d>& standing_points,
                        const OutlineAxis& start, Side side, AxisRule rule = AxisRule::kSecondToe);

}  // namespace instep
