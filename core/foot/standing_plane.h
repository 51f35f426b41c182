#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// The plane that a foot stands on: up . p = height_mm, in the cloud's own frame.
struct StandingPlane {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit length, out of the floor
  double height_mm = 0.0;

  /// Turns `up` into z, by the shortest way, and puts the plane at z = 0.
  RigidTransform standing_from_input() const;
};

/// The plane under a body whose `up` is known: through its lowest points, of which the outermost
/// half per mille are taken for strays. `points` must not be empty.
StandingPlane plane_below(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& up);

/// Finds the plane that the body stands on when nothing is known of its pose.
///
/// Every direction of the frame's axes, and then of the body's own principal axes, is tried as
/// `up`; the one whose footprint (the hull of what lies within a fortieth of the body's size above
/// the plane) is largest wins, and the axes of the frame win over the principal ones unless these
/// are clearly better. A sole is by far the largest flat support of a foot. A principal axis is
/// only near the true one, so its plane is then fitted to the footprint.
///
/// Fails with kInvalidInput where no footprint is as large as a foot's.
Result<StandingPlane> find_standing_plane(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
