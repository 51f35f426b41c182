#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/fusion/views/witness.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// The points of one view as an image: which point each pixel sees, and how far each is trusted.
/// Borrows the lens and the points.
struct SeenSurface {
  const CameraIntrinsics* intrinsics = nullptr;
  const PointCloud* points = nullptr;
  RigidTransform camera_from_station = RigidTransform::Identity();
  std::vector<std::int32_t> point_at;  ///< pixel by pixel; -1 = no point
  /// Of each point, 0 to 1: the cosine of its incidence, less within a matching window of the rim.
  std::vector<float> trust;
};

/// `points`: of that view, in the station frame, with normals, sigma and view directions. About
/// 5 ms for an image of 640x480.
SeenSurface seen_surface(const PosedDepth& view, const PointCloud& points);

/// The points of one view, as ascending indices, that stand against the others. Where another
/// view's surface faces the same way but lies elsewhere by more than the noise of both, one of them
/// errs, or its pose does; a point is overruled where such a view is trusted more than its own and
/// all views that agree with it together. So two sheets become one, and the tails that stereo
/// matching draws out beyond a silhouette go. Some 0.05 us a point and view.
std::vector<std::size_t> points_not_overruled(const std::vector<SeenSurface>& views,
                                              std::size_t number);

}  // namespace instep
