#pragma once

#include <string>

#include "core/geometry/point_cloud.h"
#include "core/result.h"

namespace instep {

/// A cloud as a binary little-endian PLY: x y z and nx ny nz as float64 and float32, sigma_mm as
/// float32, origin as uchar (0 seen, 1 platform), shared_error_1_mm and so on, local_error_mm
/// and local_error_reach_mm as float32, each but the first only if the cloud knows it. Coordinates
/// come back bit by bit. The cloud must be consistent (kInvalidInput).
Result<std::string> cloud_to_ply(const PointCloud& cloud);

}  // namespace instep
