#pragma once

#include <cstddef>
#include <vector>

#include "core/fusion/temporal_fusion.h"
#include "core/fusion/thin.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// A depth image with its camera and pose, borrowed for one call.
struct PosedDepth {
  const CameraIntrinsics* intrinsics = nullptr;
  const FusedDepth* depth = nullptr;
  RigidTransform station_from_camera = RigidTransform::Identity();
};

/// The points, as ascending indices, that no other view contradicts. A view sees through a point if
/// all of its 3 x 3 pixels there lie more than `margin_mm` behind it, and confirms it if one lies
/// within the margin. A point that is seen through and not confirmed floats in the air: a remnant
/// of a silhouette. ViewedCloud::views index `views`. Some 0.1 us a point and view.
std::vector<std::size_t> points_not_seen_through(const ViewedCloud& points,
                                                 const std::vector<PosedDepth>& views,
                                                 double margin_mm);

}  // namespace instep
