#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/point_index.h"
#include "core/girth/band/slab_source.h"
#include "core/result.h"
#include "core/surface/noise/noise_estimate.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// The points near a tape plane, made ready for a surface: seen from the plane (x and y on it, z
/// above it), in a unit of their own so that results scale exactly with the cloud, in an order that
/// the cloud's does not change, copies and strays gone, normals pointing outwards.
struct PlaneBand {
  double unit_mm = 1.0;       ///< length of the unit: the diagonal of the section
  Eigen::Vector2d middle_mm;  ///< in the plane's coordinates; the origin of the band's
  std::vector<OrientedPoint> points;
  PointIndex index;                       ///< of their positions
  std::vector<std::size_t> sources;       ///< their places in the cloud
  std::vector<double> shares;             ///< as PlaneSlab has them
  std::vector<double> errors_mm;          ///< as PlaneSlab has them
  double usual_share = 1.0;               ///< the middle one of these
  std::vector<bool> seen;                 ///< whether a camera saw them
  double spacing = 0.0;                   ///< between points, in the unit
  double grain = 0.0;                     ///< finest detail that they tell, in the unit
  double sigma = 0.0;                     ///< noise of the places, in the unit: the usual one
  double shown_sigma = 0.0;               ///< the one that they show, whatever is told of them
  double stray_share = 0.0;               ///< of the points, before thinning or after: left out
  std::size_t thinned_out = 0;            ///< exact points of a crowd that tell nothing more
  bool own_sigma = false;                 ///< each point counts by what the cloud tells of it
  double told_scale = 1.0;                ///< by which the noise that is told was raised, as a rule
  bool normals_dropped = false;           ///< those that were told contradict each other
  double copies_within = 0.0;             ///< points so near to another were left out; 0 if none
  std::vector<LocalNoise> uneven;         ///< where noise differs, untold, from place to place
  std::vector<ScatteredPlace> scattered;  ///< where points scatter that are exact elsewhere
  std::vector<LocalRoughness> roughness;  ///< in the unit

  Eigen::Vector2d to_plane(const Eigen::Vector2d& place) const {
    return middle_mm + unit_mm * place;
  }

  /// With those that were thinned out.
  std::size_t points_taken() const { return points.size() + thinned_out; }
  /// Of points as they came, not of averages of them: the usual noise, or its mean over parts that
  /// scatter.
  double noise_mm() const;

  double share_of(std::size_t point) const { return shares.empty() ? 1.0 : shares[point]; }
  double error_of(std::size_t point) const { return errors_mm.empty() ? 0.0 : errors_mm[point]; }

  /// Noise of any point of the cloud that the band was made of, near the plane or not, in the unit.
  /// `place`: its own, as the band has it, with its `share` of the point's noise. `error_mm` > 0:
  /// of what stays of a pile, whatever points beside it show; at least that where more is told.
  double sigma_of(const PointCloud& cloud, std::size_t source, double share, double error_mm,
                  const Eigen::Vector3d& place) const;
};

/// The grain is the spacing of the points, or more: twice the noise, or where points crowd so that
/// they tell no more than fewer would, a part of the section.
///
/// Of a crowd of which nothing is told and which shows no noise, wherever it is looked at, nor
/// strays, as many points are kept as the finest grain needs (core/geometry/cell_crowds.h).
/// Where some parts hold many times as many as others do, as many there as elsewhere
/// (core/geometry/piles/piled_points.h). Of points on lines that are far apart, as many on each as
/// the lines beside it can be seen with, or averages of them (core/girth/band/thinned_lines.h).
///
/// The noise is the `sigma_mm` of `slabs`, or what the cloud tells of each point, or what the
/// points show (core/surface/noise/noise_estimate.h): one for all, or where they contradict that,
/// one for each place, or none but in parts that scatter. Where they plainly show more than they
/// are told to have, what is told of points that were seen is raised to that, everywhere or in
/// those places that do.
///
/// Points that stand alone are left out; of many such also those that have others of their kind for
/// neighbours, and those that rise from the skin near it. `strays_near_skin`: there are known to be
/// many of the latter, whether others stand alone or not.
///
/// The cloud of `slabs` has passed check_cloud(). Fails with kInsufficientData for too few points
/// or none that form a surface, kInvalidInput for a plane that has none near it or all on one side.
/// O(points of the cloud), and m log m for the m near the plane.
Result<PlaneBand> band_at(SlabSource& slabs, bool strays_near_skin = false);

/// What is to be said where what came with the points was not believed: noise that they contradict,
/// unless what they show is too little to matter, and normals that contradict each other.
std::vector<std::string> disbelief_of(const PlaneBand& band);

}  // namespace instep
