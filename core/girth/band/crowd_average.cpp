#include "core/girth/band/crowd_average.h"

#include <algorithm>

namespace instep {
namespace {

/// Points nearer than this part of the spacing count as one.
constexpr double kDuplicate = 0.02;
/// Stands for no variance at all where variances are divided by.
constexpr double kLeastVariance = 1e-18;

}  // namespace

CrowdAverage average_crowds(const PlaneBand& band) {
  const bool crowded = band.grain > band.spacing;
  const double reach = crowded ? 0.5 * band.grain : kDuplicate * band.spacing;
  CrowdAverage average;
  std::vector<bool> taken(band.points.size(), false);
  for (std::size_t i = 0; i < band.points.size(); ++i) {
    if (taken[i]) continue;
    OrientedPoint mean{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
    double weights = 0.0;
    bool seen = false;
    for (const auto& neighbour : band.index.within(band.points[i].position, reach)) {
      const OrientedPoint& point = band.points[neighbour.index];
      if (taken[neighbour.index] || point.normal.dot(mean.normal) < 0.0) continue;
      taken[neighbour.index] = true;
      const double weight = 1.0 / std::max(point.variance, kLeastVariance);
      mean.position += weight * point.position;
      mean.normal += weight * point.normal;
      weights += weight;
      seen = seen || band.seen[neighbour.index];
    }
    mean.position /= weights;
    mean.normal.normalize();
    mean.variance = 1.0 / weights;
    average.points.push_back(mean);
    average.seen.push_back(seen);
  }
  return average;
}

}  // namespace instep
