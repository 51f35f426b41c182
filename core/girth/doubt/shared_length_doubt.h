#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// What the errors that points share, many of them (PointCloud::shared_errors_mm) or neighbours
/// (LocalErrors), leave open of the lengths of a closed line: half-widths of 95 % intervals, mm.
struct SharedLengthDoubt {
  double contact_u95 = 0.0;    ///< of the line itself
  double stretched_u95 = 0.0;  ///< of a tape round it
};

/// Of a line round a body, in the plane's own coordinates; none for a cloud that knows of no such
/// errors. To first order: a line gains what the skin moves outwards at each corner times what it
/// turns there. Local errors are waves that it follows, too, and is the longer for by half their
/// mean square slope (to second order; S. O. Rice): waves of some 6 mm and more, for shorter ones
/// are smoothed away as noise. Skin that was not seen errs as the seen skin beside it, from which
/// it goes on. The cloud passed check_cloud(). O(n log n), and O(log n + errors) a corner, and two
/// million pairs of corners at most.
SharedLengthDoubt shared_doubt_of(const std::vector<Eigen::Vector2d>& line, const TapePlane& plane,
                                  const PointCloud& cloud);

}  // namespace instep
