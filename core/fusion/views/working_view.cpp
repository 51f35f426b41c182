#include "core/fusion/views/working_view.h"

#include "core/fusion/frames/camera_limits.h"
#include "core/fusion/views/surface_points.h"

namespace instep {

using Eigen::Vector3d;

Result<WorkingView> open_view(const View& view) {
  const auto& [geometry, depth, rays] = view;
  if (fault_of_pose(geometry.station_from_camera.matrix())) {
    return fail(ErrorCode::kInvalidInput, "the pose of camera " + geometry.id + " is not sound",
                "correct it, or have it found: instep calibrate");
  }
  WorkingView working{geometry.id, rays, depth, geometry.station_from_camera, {}};
  if (!working.rays) {
    auto made = Deprojector::create(geometry.intrinsics);
    if (!made) {
      auto error = made.error();
      error.message = "camera " + geometry.id + ": " + error.message;
      return tl::make_unexpected(error);
    }
    working.rays = std::make_shared<const Deprojector>(std::move(*made));
  }
  const auto& lens = working.rays->intrinsics();
  const auto pixels = static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height);
  if (depth.width != lens.width || depth.height != lens.height || depth.depth_mm.size() != pixels ||
      depth.sigma_mm.size() != pixels) {
    return fail(ErrorCode::kCorruptData,
                "the depth image of camera " + geometry.id + " does not have the camera's size",
                "check the camera's resolution in the configuration");
  }
  drop_flying_pixels(lens, working.depth);
  return working;
}

bool is_within(const Vector3d& point, double radius_mm) {
  return point.head<2>().squaredNorm() <= radius_mm * radius_mm;
}

PointCloud station_cloud(const WorkingView& view, const std::vector<std::uint32_t>& pixels) {
  return transformed(view.station_from_camera, surface_points(*view.rays, view.depth, pixels));
}

}  // namespace instep
