#include "core/fusion/station_region.h"

#include <cmath>

#include "core/fusion/views/working_view.h"

namespace instep {
namespace {

constexpr double kRegionRadiusMm = 600.0;
constexpr double kRegionHeightMm = 500.0;

}  // namespace

bool in_region(const Eigen::Vector3d& point, const FusionSettings& settings) {
  const double height = point.z() - settings.platform_height_mm.value_or(0.0);
  return is_within(point, kRegionRadiusMm) && std::abs(height) <= kRegionHeightMm;
}

}  // namespace instep
