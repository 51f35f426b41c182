#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

struct ThinSettings {
  double spacing_mm = 1.0;
  /// Share of a point's sigma that its neighbours in the same view have too, so that averaging
  /// them does not lower it.
  double correlated_share = 0.4;
  /// What views lie apart by that neither noise nor what is known of their poses explains: common
  /// to neighbours of a view, averaged only with those of other views.
  double view_sigma_mm = 0.0;
};

/// A cloud whose points remember which view each came from.
struct ViewedCloud {
  PointCloud cloud;                  ///< with normals, sigma and view directions
  std::vector<std::uint16_t> views;  ///< one a point
};

ViewedCloud subset(const ViewedCloud& points, const std::vector<std::size_t>& indices);

struct ThinnedCloud {
  PointCloud cloud;
  Eigen::MatrixXd shares;  ///< how much each view (row) counts in each point (column); sum 1
};

/// Fewer points of so many views, each standing for the disc of radius `spacing_mm` round it: of
/// the given points some are chosen that keep this distance on the surface, and each takes the mean
/// of the points nearest to it. Heights are averaged along the mean of both normals, which follows
/// the curvature instead of cutting it; sheets that lie further apart than their noise stay
/// separate.
///
/// Sigma is what is left after averaging: within a view the independent part only, then the views
/// by inverse variance; where they disagree by more than twice what their sigmas say, half of what
/// their disagreement tells. Deterministic; some 1 us a point.
ThinnedCloud thin(const ViewedCloud& points, std::size_t views, const ThinSettings& settings);

}  // namespace instep
