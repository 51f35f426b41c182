#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"

namespace instep::test {

/// Both lengths of a section, and what the floor of white noise needs.
struct TrueLengths {
  double stretched_mm = 0.0;
  double contact_mm = 0.0;
  /// Integral of the squared curvature along the stretched tape, 1/mm; of analytic shapes only.
  double bending = 0.0;
};

/// A body that can be sampled at will and whose sections are known.
struct CaseBody {
  std::string name;
  /// Points evenly at random over its surface, with their normals.
  std::function<PointCloud(std::size_t count, std::uint64_t seed)> crowd;
  /// A plane that goes round it, drawn at random.
  std::function<TapePlane(RandomNumbers& random)> plane;
  /// Nothing where the section is not one loop.
  std::function<std::optional<TrueLengths>(const TapePlane& plane)> lengths;
  /// Moves points of the crowd to their exact places, where they are not there yet: it costs too
  /// much for those that are not chosen.
  std::function<void(PointCloud& cloud)> settle = [](PointCloud&) {};
};

/// Eight smooth analytic shapes of about 250 mm girth between z = -30 and 30, their sizes and forms
/// varied by the seed; seed 0 gives the plain ones.
std::vector<CaseBody> smooth_bodies(std::uint64_t seed);

/// A cylinder with two creases along it.
CaseBody creased_body(std::uint64_t seed);

/// The feet of the trial data that are closed meshes; the planes are those of the known sections,
/// shifted and tilted, the lengths those of the cut faces.
std::vector<CaseBody> scanned_feet();

/// The plane through a place, square to a direction.
TapePlane plane_at(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);

/// A direction that differs from `axis` by at most so much, evenly over the cap.
Eigen::Vector3d tilted(const Eigen::Vector3d& axis, double most_degrees, RandomNumbers& random);

/// A plane through z near 0, tilted by at most this.
TapePlane tilted_plane(double most_degrees, RandomNumbers& random);

/// Half the length of the analytic bodies, along z.
inline constexpr double kHalfLengthMm = 30.0;

}  // namespace instep::test
