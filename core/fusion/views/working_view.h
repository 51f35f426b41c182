#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/fusion/views/shared_errors.h"
#include "core/fusion/views/view.h"
#include "core/fusion/views/witness.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// One view on its way to points: its doubtful pixels gone, its pose as good as is known by now.
struct WorkingView {
  std::string id;
  std::shared_ptr<const Deprojector> rays;
  FusedDepth depth;
  RigidTransform station_from_camera;
  std::vector<ErrorField> errors;  ///< that all of it shares, in the camera's frame

  Eigen::Vector3d in_station(std::size_t pixel) const {
    const Eigen::Vector3f own = rays->ray(pixel) * depth.depth_mm[pixel];
    return station_from_camera * own.cast<double>();
  }

  PosedDepth posed() const { return {&rays->intrinsics(), &depth, station_from_camera}; }
};

/// Checks a view, makes its rays if it has none, and drops the pixels that lie on no surface.
Result<WorkingView> open_view(const View& view);

/// Calls `visit(pixel, point in the station)` for pixels with data, `stride` apart both ways, row
/// by row.
template <typename Visit>
void visit_pixels(const WorkingView& view, int stride, const Visit& visit) {
  for (int v = 0; v < view.depth.height; v += stride) {
    for (int u = 0; u < view.depth.width; u += stride) {
      const auto pixel = static_cast<std::size_t>(v * view.depth.width + u);
      if (view.depth.depth_mm[pixel] > 0.0F) visit(pixel, view.in_station(pixel));
    }
  }
}

/// Whether a point lies so near to the station's upright axis.
bool is_within(const Eigen::Vector3d& point, double radius_mm);

/// The points of some pixels, in the station frame.
PointCloud station_cloud(const WorkingView& view, const std::vector<std::uint32_t>& pixels);

}  // namespace instep
