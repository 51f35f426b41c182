#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fusion/poses/view_matches.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// How the depths of the cameras are bent, beyond what poses and lenses explain: neighbouring
/// pixels err alike, and frame after frame does, so that neither frames nor neighbours average it
/// out; only other cameras do. As if all cameras were alike: one that is worse than the others is
/// told as better than it is, and they as worse.
struct BentDepths {
  double sigma_mm = 0.0;  ///< along the line of sight; 0 where the views show none
  double reach_mm = 0.0;  ///< on the skin, as that of LocalErrors

  bool is_any() const { return sigma_mm > 0.0; }
};

/// By how far apart two cameras, fitted to each other as well as can be, see the same skin: as far
/// as neighbours do alike, which noise does not, however much of it there is (the products of the
/// distances of two matches over how far these lie apart, as a variogram has them: Cressie,
/// Statistics for Spatial Data, 1993, 2.4). None where that is no more than chance may make it.
/// What all cameras have in common does not show. Some 15 ms, of however many views.
BentDepths bent_depths(const std::vector<MovingView>& views, const std::vector<ViewMatch>& matches);

/// What these do to a cloud in the station frame, with normals. `shares`: how much each view (row)
/// counts in each point (column), one row a view, whose camera is at one of `cameras`. Less where
/// more views count, and where the skin is seen aslant, which moves little along its normal.
LocalErrors local_errors_of(const PointCloud& cloud, const Eigen::MatrixXd& shares,
                            const std::vector<Eigen::Vector3d>& cameras, const BentDepths& bent);

}  // namespace instep
