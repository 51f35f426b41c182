#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/noise/scattered_places.h"
#include "core/surface/noise/uneven_noise.h"

namespace instep {

/// How far the surface wanders round one place: the variogram of its height, once curvature is
/// taken out, is roughness * distance^3. A crease is rough, an even curve is not.
struct LocalRoughness {
  Eigen::Vector3d place;
  double roughness = 0.0;
};

/// How much of the unevenness of a cloud is noise and how much is shape.
struct NoiseEstimate {
  double sigma = 0.0;       ///< standard deviation of a point along its normal: the one to use
  double shown = 0.0;       ///< the one that the points show, whatever is told of them
  double told_scale = 1.0;  ///< by which what was told has to be raised; 1 where it can be believed
  /// Against that, or where nothing is told against `sigma`, where one for all cannot be.
  std::vector<LocalNoise> uneven;
  /// Where points that are exact elsewhere scatter, beside the places where they do not; nothing
  /// where they scatter nowhere.
  std::vector<ScatteredPlace> scattered;
  std::vector<LocalRoughness> roughness;
};

/// Estimates both from the neighbourhoods of some of the points (asked_places() of `places`, or
/// every third of those where these are all of exact points), each taken as heights over its own
/// tangent plane: restricted maximum likelihood with the kernel r^3, which tells white noise from
/// wandering shape by its scale. The noise is the middle one over the neighbourhoods, so that
/// creases and a few stray ones do not count. Where they plainly contradict one noise for all
/// (uneven_noise()), each has its own, and the one to use for all is their root mean square; so
/// where an exact part that was seen from near has most of them. That needs `places` in the order
/// in which they lie round the body.
///
/// Of a crowd that is exact as a rule a single neighbourhood can tell that its points are not; more
/// of them are asked then (scattered_places()).
///
/// `told`: a standard deviation for each point, > 0, or none; a neighbourhood is held against the
/// mean square of those of its points. It is used as it is, even where the points show less, for
/// part of their noise may be common to neighbours; but where three quarters of the neighbourhoods
/// show plainly more, all of it is raised to what the middle one of them shows, and where beside
/// each other a few still do, theirs is raised further (noise_beyond_told()).
///
/// The index holds the points of a band round a tape plane, about their middle, the third axis
/// square to the plane, in a unit in which the body is about one long: how wide a patch may be to
/// look flat is told in it, and `sigma`, `shown` and `told` are in it too.
NoiseEstimate estimate_noise(const PointIndex& index, const std::vector<std::size_t>& places,
                             const std::vector<double>& told);

/// What the same points show, as NoiseEstimate::shown: in whatever order the places come, and
/// whichever way the points lie. Zero if no place tells.
double shown_noise(const PointIndex& index, const std::vector<std::size_t>& places);

/// The estimate of points of which nothing is told, if all of the places that may be used are of
/// exact points; nothing as soon as one is not. Round a ring of points their neighbourhoods leave
/// less than a fiftieth of it unseen in one piece. Where a polynomial passes through the points
/// round a place that costs little.
std::optional<NoiseEstimate> estimate_if_exact(const PointIndex& index,
                                               const std::vector<std::size_t>& places);

/// The roughness at a place, from the nearest ones; a small positive number if there are none.
double roughness_at(const std::vector<LocalRoughness>& known, const Eigen::Vector3d& place);

}  // namespace instep
