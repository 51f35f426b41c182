#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// What hangs together near a tape plane.
struct BodyApart {
  std::vector<std::size_t> points;  ///< their numbers in the cloud, ascending
  double area = 0.0;                ///< that a tape round those at the plane encloses, mm^2
};

/// What lies near a tape plane taken apart where nothing joins it, in several ways: a body from a
/// wall, a floor or another body beside it, which as one cloud share their noise, their spacing and
/// the normals that neighbours agree on. First in thick slabs, in which much is joined, then in
/// thinner ones; in each by wide gaps, then by narrower ones. Each way lists bodies of more than a
/// few points, that round the largest area first; what is left strays. Those that are nearly as one
/// of the way before are left out, and ways without others, so that a plain cloud has none. The
/// cloud has passed check_cloud(). O(n), and m log m for the m near the plane.
std::vector<std::vector<BodyApart>> bodies_apart(const PointCloud& cloud, const TapePlane& plane);

}  // namespace instep
