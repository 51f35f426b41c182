#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/moments.h"
#include "core/geometry/point_index.h"

namespace instep {

/// Of the neighbours that an index found, round a place near them, which is the moments' origin:
/// their flattest direction is the normal of the skin there. O(neighbours).
inline Moments moments_round(const PointIndex& index, const Eigen::Vector3d& place,
                             const std::vector<PointIndex::Neighbour>& neighbours) {
  Moments moments;
  for (const auto& neighbour : neighbours) moments.add(index.points()[neighbour.index] - place);
  return moments;
}

}  // namespace instep
