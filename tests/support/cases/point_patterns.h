#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep::test {

/// Ways in which points can lie on a surface. All but the first choose from a crowd of points that
/// is several times as large as what is wanted.
enum class Pattern {
  kRandom,  ///< evenly at random
  kEven,    ///< at about the same distance from each other (blue noise)
  kGraded,  ///< six times as dense at one end as at the other
  kLines,   ///< close together along lines, three times as far from line to line
};

const char* name_of(Pattern pattern);

/// About `count` points of a crowd that lies evenly at random on a surface; all if it has fewer.
PointCloud chosen(const PointCloud& crowd, std::size_t count, Pattern pattern, std::uint64_t seed);

/// Without the points round a place of the section, drawn by the seed.
PointCloud with_hole(const PointCloud& cloud, const TapePlane& plane, double diameter_mm,
                     std::uint64_t seed);

/// Moves each point along its normal by white noise.
PointCloud with_noise(PointCloud cloud, double sigma_mm, std::uint64_t seed);

/// Moves each point in all directions alike.
PointCloud with_isotropic_noise(PointCloud cloud, double sigma_mm, std::uint64_t seed);

}  // namespace instep::test
