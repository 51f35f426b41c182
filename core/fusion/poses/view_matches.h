#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/point_index.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// What a view shows, in the station frame, by the pose that its camera is said to have.
struct PosedCloud {
  PointCloud cloud;
  RigidTransform station_from_camera = RigidTransform::Identity();
};

/// A view as register_views() matches it, in the given station frame, and what corrects it, as it
/// stands: first it is stretched about its centroid along the line of sight and across it, then
/// moved.
struct MovingView {
  PointCloud queries;
  PointCloud targets;
  std::unique_ptr<PointIndex> index;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d towards_camera = Eigen::Vector3d::Zero();
  RigidTransform station_from_camera = RigidTransform::Identity();  ///< as given
  RigidTransform pose_correction = RigidTransform::Identity();
  double deeper = 0.0;  ///< share by which depths are stretched
  double wider = 0.0;   ///< and what lies across them
  bool taking_part = false;

  Eigen::Vector3d corrected_centroid() const { return pose_correction * centroid; }
  Eigen::Vector3d optical_axis() const { return station_from_camera.linear().col(2); }
  /// Of what lies about the centroid.
  Eigen::Matrix3d stretch() const;
  /// All that corrects it together.
  Eigen::Affine3d correction() const;
};

/// One surface, seen by two views.
struct ViewMatch {
  std::size_t view;
  std::size_t other;
  std::size_t query;      ///< of `view`
  std::size_t target;     ///< of `other`
  Eigen::Vector3d point;  ///< of `view`, corrected
  Eigen::Vector3d normal;
  double distance;  ///< along the normal, mm
  double variance;  ///< of that, by the noise of both points, mm^2
};

/// Clouds with normals, sigma and view directions, thinned to so many points; others take no part.
std::vector<MovingView> moving_views(const std::vector<PosedCloud>& views, std::size_t queries,
                                     std::size_t targets);

/// One query in `stride` of every view, with the surface of each other view within `reach` of it.
std::vector<ViewMatch> match_views(const std::vector<MovingView>& views, double reach,
                                   std::size_t stride = 1);

/// Median distance.
double median_residual(const std::vector<ViewMatch>& matches);

/// How far the views lie apart beyond what the noise of their points explains, one sigma.
double unexplained(const std::vector<ViewMatch>& matches);

/// What the corrections of poses took away from the distances by the given poses: root mean square
/// over the matches where it is more than their noise, each counting by as much. Where a view slid
/// along the platform most matches tell nothing; the few at the skin do.
double taken_away(const std::vector<MovingView>& views, const std::vector<ViewMatch>& matches);

std::vector<ViewMatch> matches_of(std::size_t view, const std::vector<ViewMatch>& all);

}  // namespace instep
