#include "core/foot/skin/skin_noise.h"

#include "core/surface/noise/noise_estimate.h"

namespace instep {
namespace {

/// About what a section of a foot spans, which is the unit that noise is told in: a patch of skin
/// is looked at that bends little over it.
constexpr double kUnitMm = 120.0;

std::vector<Eigen::Vector3d> in_unit(std::vector<Eigen::Vector3d> points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : points) middle += point / static_cast<double>(points.size());
  for (auto& point : points) point = (point - middle) / kUnitMm;
  return points;
}

}  // namespace

SkinNoise::SkinNoise(const std::vector<Eigen::Vector3d>& points_mm) : index_(in_unit(points_mm)) {}

double SkinNoise::deviation_mm(const std::vector<std::size_t>& places) const {
  return kUnitMm * shown_noise(index_, places);
}

}  // namespace instep
