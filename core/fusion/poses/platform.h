#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/rigid_transform.h"

namespace instep {

struct PlatformSettings {
  /// Where the standing surface should be (z in the station frame); nothing = anywhere.
  std::optional<double> expected_height_mm;
  double search_mm = 40.0;  ///< how far from there it may be
  double most_tilt_deg = 5.0;
};

/// The plane that people stand on, in the station frame.
struct FoundPlatform {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< middle of its points
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double scatter_mm = 0.0;  ///< standard deviation of its points across it
  std::size_t points = 0;

  double height_mm() const { return centre.z(); }
  double distance(const Eigen::Vector3d& point) const { return normal.dot(point - centre); }

  /// Turns the station frame about `centre` until the platform is level.
  RigidTransform level_from_station() const;
};

/// Finds the platform among points of the station frame: the plane within the limits that most
/// points support (sampled triples from a fixed seed, each scored by a truncated squared
/// distance), refined by least squares on the points within three of its own scatters. A plane is
/// believed only if it stands out: it must hold more points than the layers beside it, within the
/// limits or not.
///
/// No platform is an answer and not a fault: it may be out of view or cut away. Uses an even sample
/// of 40,000 points at most; some 10 ms.
std::optional<FoundPlatform> find_platform(const std::vector<Eigen::Vector3d>& points,
                                           const PlatformSettings& settings);

}  // namespace instep
