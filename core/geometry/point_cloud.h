#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// Where a point comes from. Only `kSeen` points are evidence; the others stand for surface that
/// no camera saw, and a girth that runs over them says so.
enum class PointOrigin : std::uint8_t {
  kSeen,      ///< measured by a camera or read from a file
  kPlatform,  ///< put under a foot where no camera saw it: on the platform, or close above it
};

/// Errors that each point shares with its neighbours, such as those of a camera whose depths are
/// bent: along the normals, and of two points that lie `d` apart and whose normals make an angle
/// `a` correlated by exp(-(d / reach_mm)^2) (1 + cos a) / 2, for other cameras see the other side
/// of a thin part. Independent of the shared errors; sigma_mm of fused clouds holds them once more,
/// so that a surface through the points is smoothed for them too.
struct LocalErrors {
  std::vector<double> sigma_mm;  ///< one standard deviation, 0 to kLargestSigmaMm; one a point
  double reach_mm = 0.0;         ///< kLeastReachMm to kLargestCoordinateMm if there are any

  bool empty() const { return sigma_mm.empty(); }
};

/// Points on a surface, in millimetres. Every list but `positions` is either empty (not known) or
/// as long as `positions`; is_consistent() checks it.
///
/// A plain value: copying copies the points. Safe to read from many threads.
struct PointCloud {
  std::vector<Eigen::Vector3d> positions;

  /// Unit length, pointing out of the body.
  std::vector<Eigen::Vector3d> normals;

  /// Standard deviation of a point's position along its normal, > 0, at most kLargestSigmaMm.
  std::vector<double> sigma_mm;

  /// Unit vector from the point towards the camera that saw it. It orients normals without
  /// guessing: a surface is only ever seen from outside.
  std::vector<Eigen::Vector3d> view_directions;

  /// Empty means that all points were seen.
  std::vector<PointOrigin> origins;

  /// Errors that many points share, such as what is unknown of a camera's pose: one list for each,
  /// of how far it moves the points along their normals, one sigma. They are independent of each
  /// other and of the noise that sigma_mm tells of. Only clouds with normals have any.
  std::vector<std::vector<double>> shared_errors_mm;

  /// Empty where none are known. Only clouds with normals have any.
  LocalErrors local_errors;

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
  bool has_normals() const { return !normals.empty(); }
  bool has_sigma() const { return !sigma_mm.empty(); }
  bool was_seen(std::size_t index) const {
    return origins.empty() || origins[index] == PointOrigin::kSeen;
  }
  /// Whether points were put under it where it stands, unseen. O(n).
  bool stands_on_platform() const;

  bool is_consistent() const;

  /// Adds the points of `other`. A list that only one of the two knows is dropped, but not
  /// `origins`, whose absence has a meaning, nor shared and local errors: points that none are
  /// known of have none. Local ones then reach as far as those of the two that reach further.
  void append(const PointCloud& other);

  /// Without normals there is nothing that shared and local errors lie along.
  void drop_normals();
  void drop_errors_along_normals();

  /// The points at `indices`, in that order, with all that is known of them.
  PointCloud subset(const std::vector<std::size_t>& indices) const;
};

/// Moves positions, and turns normals and view directions.
PointCloud transformed(const RigidTransform& target_from_source, const PointCloud& cloud);

/// The largest coordinate, in millimetres, that a cloud may hold: 100 m. Beyond it the numbers are
/// damage or another unit, never a foot.
inline constexpr double kLargestCoordinateMm = 1e5;

/// The largest standard deviation, in millimetres, that a point may have: as large as a foot.
inline constexpr double kLargestSigmaMm = 100.0;

/// The shortest reach, in millimetres, of local errors: what reaches less far is noise.
inline constexpr double kLeastReachMm = 0.1;

/// The gate through which every cloud from outside passes: consistent lists, finite numbers,
/// coordinates within kLargestCoordinateMm, unit normals, sigma above 0 and up to kLargestSigmaMm,
/// shared and local errors within it. The first fault is reported with the index of its point.
/// Cost: one pass.
Result<void> check_cloud(const PointCloud& cloud);

}  // namespace instep
