#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/fusion/views/working_view.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// Where an object that cameras are placed by is looked for, in the station frame. Points further
/// from the station's origin, in plan, are background; wide enough for what rough poses put
/// elsewhere.
inline constexpr double kObjectRegionMm = 700.0;
/// Above the platform.
inline constexpr double kLeastObjectHeightMm = 8.0;
inline constexpr double kMostObjectHeightMm = 250.0;

/// The pixels, one in nine, by which a level view shows what stands on the platform.
std::vector<std::uint32_t> object_pixels(const WorkingView& view, double platform_height_mm);

/// Their points in the station.
std::vector<Eigen::Vector3d> object_points(const WorkingView& view, double platform_height_mm);

/// By how much the sides of an object hold it from turning about an upright axis, about the one
/// where they hold least: root mean square of how far their normals pass by it, mm. Of a round
/// object nothing but the noise of the normals is left: a cylinder of 60 mm gives 0.9, drawn feet
/// and lasts 25 to 53. Needs normals; 0 where nothing stands upright.
double turning_lever_mm(const PointCloud& object);

}  // namespace instep
