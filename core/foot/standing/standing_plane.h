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
/// A sole is by far the largest support of a foot: a plane that leaves all of the body on one side
/// and is touched all round. Tried as `up` are the axes of the frame, z also as a body that is put
/// down so tips until it stands still (an open sole has no surface along its floor), and the
/// normals of the surface at places spread over it, each plane settled on what it touches; of these
/// only the one on which the largest flat face rests. The support of a plane is the area of the
/// hull of what lies near it, times the squared share of the hull's border that is touched; the
/// largest wins, but the axes of the frame win over the other direction unless this is clearly
/// better. Where the touched part is flat and closed, the plane goes through the middle of its
/// points, not under the lowest: their noise does not lower the floor. An open sole (a ring of
/// lowest points) stands on them.
///
/// Fails with kInvalidInput where no support is as large as a foot's. O(n) and some 20 ms.
Result<StandingPlane> find_standing_plane(const std::vector<Eigen::Vector3d>& points);

/// The same plane, tilted by up to 8 degrees and shifted to the flat sole that rests on it, if
/// there is one.
StandingPlane settled_on_sole(const std::vector<Eigen::Vector3d>& points,
                              const StandingPlane& plane);

}  // namespace instep
